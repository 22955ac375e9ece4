/* bench_operations.h: the operations that the kernels do. */
#ifndef BENCH_OPERATIONS_H
#define BENCH_OPERATIONS_H

#include <lambent/lambent.h>

#include "bench_rates.h"

/* bench_operations_gather: `counts` of each operation, the mean over the tile's vectors and the groups. */
void bench_operations_gather(double counts[BENCH_OPS], const lmb_tile *tile, const lmb_groups *groups);

/* bench_operations_begin: kernels that count, to draw a frame with; then bench_operations_end: `counts` of each
 * operation on one lane, and the depths that were read, tested and written. */
const lmb_kernels *bench_operations_begin(void);
double bench_operations_end(double counts[BENCH_OPS]);

/* bench_operations_reads: how often lanes read four floats, or one, from a place of their own since
 * bench_operations_begin. */
double bench_operations_reads(void);

#endif
