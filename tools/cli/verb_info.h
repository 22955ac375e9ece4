/* verb_info.h: `lambent info`, for the program and its tests. */
#ifndef VERB_INFO_H
#define VERB_INFO_H

#include <stdio.h>

enum { INFO_OK = 0, INFO_FAILED = 1, INFO_USAGE = 2 };

/* verb_info: argv[0] is "info". Returns the exit status. */
int verb_info(int argc, char **argv);

/* info_to: the same, with the figures on `out` and the line of an error on `err`. */
int info_to(FILE *out, FILE *err, int argc, char **argv);

#endif
