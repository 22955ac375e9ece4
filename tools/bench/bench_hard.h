/* bench_hard.h: `lambent bench hard`: the gallery of hard cases as a table. */
#ifndef BENCH_HARD_H
#define BENCH_HARD_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* bench_hard: the cases of a room, or of all where it is NULL; a line each. 1, or 0 with `r` set: no such room, no
 * memory, or a figure past its bound. */
int bench_hard(const lmb_kernels *kernels, const char *room, int json, report *r);

#endif
