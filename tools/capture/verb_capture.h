/* verb_capture.h: `lambent capture`. */
#ifndef VERB_CAPTURE_H
#define VERB_CAPTURE_H

/* argv[0] is the verb. Returns the exit status: 0 done, 1 failed, 2 bad usage. */
int verb_capture(int argc, char **argv);

#endif
