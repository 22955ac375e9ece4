/* bench_task.h: which settings a sweep measures. */
#ifndef BENCH_TASK_H
#define BENCH_TASK_H

#include "bench_options.h"

/* A setting that is to be measured. */
typedef struct bench_task {
    char option[32], words[BENCH_NAME];
    double weight;
    int flags; /* BENCH_OTHER ... */
} bench_task;

/* bench_tasks: all of them, at most BENCH_POINTS: the subject's own, or each value of --sweep with each. Returns how
 * many, or 0 with `r` set. */
int bench_tasks(bench_task *out, const bench_options *o, report *r);

/* bench_check: what was given makes sense, and so does each value of --sweep. 1, or 0 with `r` set: bad usage. */
int bench_check(const bench_options *o, report *r);

#endif
