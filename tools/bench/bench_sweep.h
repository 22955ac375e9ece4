/* bench_sweep.h: settings one after the other, measured and held against the truth. */
#ifndef BENCH_SWEEP_H
#define BENCH_SWEEP_H

#include "bench_options.h"

/* bench_sweep: measure all and find the front and the breakdowns. `out` is zero before; bench_results_free releases it.
 * 1, or 0 with `r` set. Tells how far it is where someone watches. */
int bench_sweep(bench_results *out, const bench_options *o, report *r);

#endif
