/* bench_breakdown.h: how much of a picture's error each stage adds. */
#ifndef BENCH_BREAKDOWN_H
#define BENCH_BREAKDOWN_H

#include "bench_results.h"

/* bench_breakdown_sum: squares of the steps from picture[0] to picture[out->rows], which is the truth: row i is the
 * step from i to i + 1. The steps' sum is the whole way, so the whole's square is the sum of theirs and of twice each
 * two's product: the interaction, `total - sum`, which is what one stage's error hides or adds to another's.
 *
 *   picture  3 floats a pixel
 *   counts   1 a pixel: where it counts. Of those, the hundredth where a picture is farthest from the truth is left
 *            out, as `trim` does, and for all pictures the same ones: what is among the worst of any of them. So
 *            sqrt(total) is a little under that figure.
 * Returns 1, or 0 where nothing counts, the truth is black or memory is short. */
int bench_breakdown_sum(bench_breakdown *inout, const float *const *picture, const uint8_t *counts, size_t pixels);

#endif
