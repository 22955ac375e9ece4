/* bench_operations.h: counts the operations of the kernels. */
#ifndef BENCH_OPERATIONS_H
#define BENCH_OPERATIONS_H

#include <lambent/lambent.h>

#include "bench_rates.h"

/* bench_operations_gather: sets `counts` of each operation to the mean over the tile's vectors and the groups. */
void bench_operations_gather(double counts[BENCH_OPS], const lmb_tile *tile, const lmb_groups *groups);

/* bench_operations_begin: returns kernels that count; draw a frame with them. Then call bench_operations_end: it sets
 * `counts` of each operation per lane, and returns the number of depths read, tested and written. */
const lmb_kernels *bench_operations_begin(void);
double bench_operations_end(double counts[BENCH_OPS]);

/* bench_operations_reads: returns the number of gathers by lanes, of four floats or one, since
 * bench_operations_begin. */
double bench_operations_reads(void);

#endif
