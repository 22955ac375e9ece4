/* bench_threads.h: `lambent-bench threads`: the speed-up of threads, compared with independent processes. */
#ifndef BENCH_THREADS_H
#define BENCH_THREADS_H

#include <lambent/lambent.h>

#include "../common/report.h"

typedef struct threads_options {
    const char *folder; /* of bunny.mesh and sponza.mesh; NULL: an error */
    const lmb_kernels *kernels;
    int threads;    /* 2 .. POOL_MAX */
    double seconds; /* per case */
    int is_quiet;
} threads_options;

/* bench_threads: prints one line per case. Returns 1, or 0 with `r` set. */
int bench_threads(const threads_options *o, report *r);

#endif
