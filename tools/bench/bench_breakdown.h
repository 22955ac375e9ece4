/* bench_breakdown.h: the share of a picture's error that each stage adds. */
#ifndef BENCH_BREAKDOWN_H
#define BENCH_BREAKDOWN_H

#include "bench_results.h"

/* bench_breakdown_sum: squared steps from picture[0] to picture[out->rows], which is the truth: row i is the step from
 * i to i + 1. The steps sum to the whole error, so its square is the sum of their squares plus twice the product of
 * each pair. That second part is the interaction, `total - sum`: errors of stages that cancel or add up.
 *
 *   picture  3 floats per pixel
 *   counts   1 per pixel: whether it counts. Like `trim`, this leaves out the hundredth of them that is farthest from
 *            the truth. It leaves out the same pixels in all pictures: the worst of any of them. So sqrt(total) is
 *            slightly below that figure.
 * Returns 1, or 0 if no pixel counts, the truth is black or memory is short. */
int bench_breakdown_sum(bench_breakdown *inout, const float *const *picture, const uint8_t *counts, size_t pixels);

#endif
