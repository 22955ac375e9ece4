/* bench_gather.h: `lambent-bench gather`: the far gather's speed, absolute and relative to the processor's bound. */
#ifndef BENCH_GATHER_H
#define BENCH_GATHER_H

#include <lambent/lambent.h>

#include "../common/report.h"

typedef struct gather_options {
    const lmb_kernels *kernels; /* NULL: all backends that this processor has, in turn */
    double seconds;             /* per backend */
    int json, is_quiet;
} gather_options;

/* bench_gather: prints one line per backend. Returns 1, or 0 with `r` set. */
int bench_gather(const gather_options *o, report *r);

#endif
