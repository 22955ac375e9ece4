/* bench_gather.h: `lambent bench gather`: the far gather's speed, and its share of what the processor can do. */
#ifndef BENCH_GATHER_H
#define BENCH_GATHER_H

#include <lambent/lambent.h>

#include "../common/report.h"

typedef struct gather_options {
    const lmb_kernels *kernels; /* NULL: each backend that this processor has, in turn */
    double seconds;             /* of each backend */
    int json, is_quiet;
} gather_options;

/* bench_gather: a line a backend. 1, or 0 with `r` set. */
int bench_gather(const gather_options *o, report *r);

#endif
