/* bench_front.h: which points nothing beats, and where more time stops to pay. */
#ifndef BENCH_FRONT_H
#define BENCH_FRONT_H

#include "bench_results.h"

/* What is smaller than this is as good as this, s and error: logarithms want an end. */
#define BENCH_MIN_S     1e-7
#define BENCH_MIN_ERROR 1e-5

/* bench_front: mark the points that no other is both at most as slow and at most as wrong as, nor better in one (of
 * equal ones the first), and the front's knee. Points without figures, that failed, or on several threads are on none.
 * Returns how many are on the front.
 *
 * The knee: of the points under the line from the front's fastest to its slowest, in logarithms of time and error that
 * each run from 0 to 1 over the front, the one farthest from it; none where all lie on or above it. */
int bench_front(bench_results *b);

/* bench_front_order: those points from the fastest up; `order` holds BENCH_POINTS. Returns how many. */
int bench_front_order(int *order, const bench_results *b);

#endif
