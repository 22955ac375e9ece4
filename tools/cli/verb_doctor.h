/* verb_doctor.h: `lambent doctor`: checks that this build works here. */
#ifndef VERB_DOCTOR_H
#define VERB_DOCTOR_H

int verb_doctor(int argc, char **argv);

#endif
