/* bench_state.h: what a sweep and its breakdowns have at hand. */
#ifndef BENCH_STATE_H
#define BENCH_STATE_H

#include "bench_task.h"
#include "bench_truth.h"

/* What a sweep has at hand; its pictures are kept for the breakdowns. */
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

/* sweep_line: the words of a setting, behind what was given. */
int sweep_line(bench_line *out, const sweep *s, const char *words, report *r);

#endif
