/* bench_mix.h: the operations that the far gather does on a vector of pixels with one group. */
#ifndef BENCH_MIX_H
#define BENCH_MIX_H

#include <lambent/lambent.h>

#include "bench_rates.h"

/* bench_mix_gather: `counts` of each operation, the mean over the tile's vectors and the groups. */
void bench_mix_gather(double counts[BENCH_OPS], const lmb_tile *tile, const lmb_groups *groups);

#endif
