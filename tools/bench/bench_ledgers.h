/* bench_ledgers.h: where some settings' errors come from. */
#ifndef BENCH_LEDGERS_H
#define BENCH_LEDGERS_H

#include "bench_state.h"

/* bench_ledgers: of some settings, into the report. */
int bench_ledgers(sweep *s, report *r);
double bench_ledgers_weight(const bench_options *o);

#endif
