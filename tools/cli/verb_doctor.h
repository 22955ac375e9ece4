/* verb_doctor.h: `lambent doctor`: does this build do here what it should? */
#ifndef VERB_DOCTOR_H
#define VERB_DOCTOR_H

int verb_doctor(int argc, char **argv);

#endif
