/* bench_picture.h: pictures for a report: small, in display codes. */
#ifndef BENCH_PICTURE_H
#define BENCH_PICTURE_H

#include "../picture/image.h"
#include "bench_results.h"

/* Both make pictures of at most 320 pixels per side. Larger ones are averaged over squares. If memory is short, `out`
 * is empty, and a report that shows it is not written.
 *
 * bench_picture_of    the picture at this exposure, stops
 * bench_picture_heat  relative error by pixel, |a - b| / (b + 0.01 mean of b) of the grey, by metrics_ramp: white from
 *                     BENCH_HEAT on; dark grey outside `surface` (see bench_shot) */
#define BENCH_HEAT 0.2
void bench_picture_of(bench_picture *out, const image *linear, float exposure_ev);
void bench_picture_heat(bench_picture *out, const image *test, const image *truth, const float *surface,
                        double truth_mean);

#endif
