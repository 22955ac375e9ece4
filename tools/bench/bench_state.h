/* bench_state.h: the state shared by a sweep and the breakdowns. */
#ifndef BENCH_STATE_H
#define BENCH_STATE_H

#include "bench_task.h"
#include "bench_truth.h"

/* The state of a sweep; it keeps the pictures for the breakdowns. */
typedef struct sweep {
    const bench_options *o;
    bench_results *b;
    bench_task task[BENCH_POINTS];
    int tasks;
    bench_truth truth;
    float exposure_ev;
    image kept[BENCH_POINTS]; /* by point */
    double done, all, start;  /* weights; s */
} sweep;

/* sweep_line: the options of a setting, after the given ones. */
int sweep_line(bench_line *out, const sweep *s, const char *words, report *r);

#endif
