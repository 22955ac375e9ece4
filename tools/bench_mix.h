/* bench_mix.h: the operations that the kernels do. */
#ifndef BENCH_MIX_H
#define BENCH_MIX_H

#include <lambent/lambent.h>

#include "bench_rates.h"

/* bench_mix_gather: `counts` of each operation, the mean over the tile's vectors and the groups. */
void bench_mix_gather(double counts[BENCH_OPS], const lmb_tile *tile, const lmb_groups *groups);

/* bench_mix_begin: kernels that count, to draw a frame with; then bench_mix_end: `counts` of each operation on one
 * lane, and the depths that were read, tested and written. */
const lmb_kernels *bench_mix_begin(void);
double bench_mix_end(double counts[BENCH_OPS]);

/* bench_mix_reads: how often lanes read four floats, or one, from a place of their own since bench_mix_begin. */
double bench_mix_reads(void);

#endif
