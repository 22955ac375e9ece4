/* bench_sweep.h: settings one after the other, measured and held against the truth. */
#ifndef BENCH_SWEEP_H
#define BENCH_SWEEP_H

#include "bench_options.h"
#include "bench_truth.h"

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

/* bench_sweep: measure all and find the front and the ledgers. `out` is zero before; bench_report_free releases it.
 * 1, or 0 with `r` set. Tells how far it is where someone watches. */
int bench_sweep(bench_report *out, const bench_options *o, report *r);

/* What a sweep has at hand; its pictures are kept for the ledgers. */
typedef struct sweep {
    const bench_options *o;
    bench_report *b;
    bench_task task[BENCH_POINTS];
    int tasks;
    bench_truth truth;
    float exposure_ev;
    image kept[BENCH_POINTS]; /* by point */
    double done, all, start;  /* weights; s */
} sweep;

/* bench_progress: the line about how far it is, where someone watches; NULL: wipe it. */
void bench_progress(const sweep *s, const char *what);

/* sweep_line: the words of a setting, behind what was given. */
int sweep_line(bench_line *out, const sweep *s, const char *words, report *r);

/* bench_ledgers: of some settings, into the report. */
int bench_ledgers(sweep *s, report *r);
double bench_ledgers_weight(const bench_options *o);

#endif
