/* verb_compare.h: `lambent compare`, for the program and for tests. */
#ifndef VERB_COMPARE_H
#define VERB_COMPARE_H

#include <stdio.h>

enum { COMPARE_OK = 0, COMPARE_FAILED = 1, COMPARE_USAGE = 2, COMPARE_SIZES = 3 };

/* verb_compare: argv[0] is "compare". Returns the exit status. */
int verb_compare(int argc, char **argv);

/* compare_to: the same, with metrics on `out` and error messages on `err`. */
int compare_to(FILE *out, FILE *err, int argc, char **argv);

#endif
