/* bench_gather.h: `lambent bench gather`: the far gather's speed, and its share of what the machine can do. */
#ifndef BENCH_GATHER_H
#define BENCH_GATHER_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* bench_gather: a line for `kernels`, or for each machine that is here where it is NULL. 1, or 0 with `r` set. */
int bench_gather(const lmb_kernels *kernels, double seconds, int json, report *r);

#endif
