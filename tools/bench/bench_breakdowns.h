/* bench_breakdowns.h: error breakdowns of some settings. */
#ifndef BENCH_BREAKDOWNS_H
#define BENCH_BREAKDOWNS_H

#include "bench_state.h"

/* bench_breakdowns: adds the breakdowns of some settings to the results. */
int bench_breakdowns(sweep *s, report *r);
double bench_breakdowns_weight(const bench_options *o);

#endif
