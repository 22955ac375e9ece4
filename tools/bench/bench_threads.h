/* bench_threads.h: `lambent bench threads`: what threads gain, beside processes that know nothing of each other. */
#ifndef BENCH_THREADS_H
#define BENCH_THREADS_H

#include <lambent/lambent.h>

#include "../common/report.h"

typedef struct threads_options {
    const char *folder; /* of bunny.mesh and sponza.mesh; NULL: not known, an error */
    const lmb_kernels *kernels;
    int threads;    /* 2 .. POOL_MAX */
    double seconds; /* of each case */
    int is_quiet;
} threads_options;

/* bench_threads: a line a case. 1, or 0 with `r` set. */
int bench_threads(const threads_options *o, report *r);

#endif
