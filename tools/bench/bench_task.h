/* bench_task.h: the settings that a sweep measures. */
#ifndef BENCH_TASK_H
#define BENCH_TASK_H

#include "bench_options.h"

/* A setting to measure. */
typedef struct bench_task {
    char option[32], words[BENCH_NAME];
    double weight;
    int flags; /* BENCH_OTHER ... */
} bench_task;

/* bench_tasks: lists all settings, at most BENCH_POINTS: the subject's defaults, or all combinations of --sweep values.
 * Returns their number, or 0 with `r` set. */
int bench_tasks(bench_task *out, const bench_options *o, report *r);

/* bench_check: checks the given options and each value of --sweep. Returns 1, or 0 with `r` set: bad usage. */
int bench_check(const bench_options *o, report *r);

#endif
