/* bench_sweep.h: measures settings one after the other, and compares them with the truth. */
#ifndef BENCH_SWEEP_H
#define BENCH_SWEEP_H

#include "bench_options.h"

/* bench_sweep: measures all settings, and finds the front and the breakdowns. Zero `out` before the call; release it
 * with bench_results_free. Returns 1, or 0 with `r` set. Shows progress on a terminal. */
int bench_sweep(bench_results *out, const bench_options *o, report *r);

#endif
