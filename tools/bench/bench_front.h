/* bench_front.h: the front of unbeaten points, and the knee, beyond which more time hardly reduces the error. */
#ifndef BENCH_FRONT_H
#define BENCH_FRONT_H

#include "bench_results.h"

/* Lower limits for logarithms, s and error. */
#define BENCH_MIN_S     1e-7
#define BENCH_MIN_ERROR 1e-5

/* bench_front: marks the points that no other beats, and the front's knee. A point is beaten by one that is no worse in
 * time and error and better in one of them; of equal points the first stays. Points without figures, failed ones and
 * those with several threads are excluded. Returns the number of points on the front.
 *
 * The knee is the point farthest below the line from the front's fastest to the slowest point, in logarithms of time
 * and error that each run from 0 to 1 over the front. If all points lie on or above the line, there is no knee. */
int bench_front(bench_results *b);

/* bench_front_order: the points of the front from the fastest on; `order` must hold BENCH_POINTS. Returns their
 * number. */
int bench_front_order(int *order, const bench_results *b);

#endif
