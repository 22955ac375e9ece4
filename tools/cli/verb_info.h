/* verb_info.h: `lambent info`, for the program and for tests. */
#ifndef VERB_INFO_H
#define VERB_INFO_H

#include <stdio.h>

enum { INFO_OK = 0, INFO_FAILED = 1, INFO_USAGE = 2 };

/* verb_info: argv[0] is "info". Returns the exit status. */
int verb_info(int argc, char **argv);

/* info_to: the same, with output on `out` and error messages on `err`. */
int info_to(FILE *out, FILE *err, int argc, char **argv);

#endif
