/* bench_breakdowns.h: where some settings' errors come from. */
#ifndef BENCH_BREAKDOWNS_H
#define BENCH_BREAKDOWNS_H

#include "bench_state.h"

/* bench_breakdowns: of some settings, into the report. */
int bench_breakdowns(sweep *s, report *r);
double bench_breakdowns_weight(const bench_options *o);

#endif
