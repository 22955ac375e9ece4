/* bench_hard.h: `lambent-bench hard`: the gallery of hard cases as a table. */
#ifndef BENCH_HARD_H
#define BENCH_HARD_H

#include <lambent/lambent.h>

#include "../common/report.h"

typedef struct hard_options {
    const lmb_kernels *kernels;
    int group; /* of hard_groups; under 0: all */
    int json, is_quiet;
} hard_options;

/* bench_hard: prints one line per case. Returns 1, or 0 with `r` set if memory is short or a figure exceeds its
 * bound. */
int bench_hard(const hard_options *o, report *r);

#endif
