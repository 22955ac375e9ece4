/* metrics.h: error metrics of one image against another, and an image of the errors. */
#ifndef METRICS_H
#define METRICS_H

#include <stdint.h>

#include "../common/report.h"

#define METRICS_DARK 3.0f /* the class of pixels with indirect light under 1 % of the mean */
#define METRICS_BLACK 1e-30 /* mean of a truth without light, so that nothing is divided by 0 */
#define METRICS_MIN_DARK 21 /* fewest dark pixels for leak; a mean of fewer is meaningless */

/* The images to compare: equal size, rows from the top. Nothing here is owned or written. */
typedef struct metrics_input {
    const float *test, *truth; /* `channels` floats per pixel: red, green, blue and perhaps alpha */
    const float *surface;      /* 3 floats per pixel; if the third is <= 0.5, the pixel is ignored; NULL: all count */
    const float *classes;      /* 1 float per pixel, METRICS_DARK: dark; NULL: dark is truth < 1 % of its mean */
    int32_t width, height;
    int32_t channels;          /* 3 or 4; the fourth is only used for equality */
} metrics_input;

/* Relative errors; a test pixel that is not finite counts as black. Grey is the mean of the three channels. */
typedef struct metrics {
    double rmse;         /* over all channels / mean truth */
    double trim;         /* the same without the worst 1 % of pixels */
    double e50, e95, e99; /* percentiles of |a - b| / (b + 0.01 mean truth), grey */
    double mean;         /* mean test / mean truth, grey */
    double leak;         /* the same over dark pixels, both sums raised by 1e-4 mean truth per pixel; see has_leak */
    double truth_mean;   /* grey; METRICS_BLACK for a truth without light */
    uint64_t n90;        /* the fewest pixels that have 90 % of the squared error */
    uint64_t pixels, dark, nonfinite;
    int has_leak;        /* 0: fewer than METRICS_MIN_DARK dark pixels; leak is 0 and has no meaning */
} metrics;

/* The difference of the stored values. */
typedef struct metrics_equality {
    double psnr_db;           /* over red, green, blue; infinite for equal values */
    double peak, max_abs;
    uint64_t pixels, exact;   /* exact: all channels have equal bits */
    int32_t max_x, max_y;     /* the first pixel with max_abs; -1 if all values are equal */
    int32_t first_x, first_y; /* the first pixel, row by row, that is not exact; -1 for none */
} metrics_equality;

/* metrics_measure: computes the metrics above. Uses 8 bytes of memory per pixel while it runs. Returns 1, or 0 with
 * `r` set: no pixel to compare, a truth that is not finite, or memory is short. */
int metrics_measure(metrics *out, const metrics_input *in, report *r);

/* metrics_worst: the 99.9th percentile of |a - b| / (mean of b over the 5 x 5 pixels around + 0.01 mean truth), grey:
 * it finds dark or bright specks, which trim ignores. `m` holds the figures of the same input. Memory as above;
 * infinite if memory runs out. */
double metrics_worst(const metrics *m, const metrics_input *in);

/* metrics_worst_pixel: the largest of those errors, with the first such pixel; -1 and 0 if all grey values are
 * equal. */
double metrics_worst_pixel(int32_t *x, int32_t *y, const metrics *m, const metrics_input *in);

/* metrics_compare: `peak` is the full scale of PSNR; 0 uses the largest value of the truth. */
void metrics_compare(metrics_equality *out, const metrics_input *in, double peak);

/* metrics_heat: the relative grey error of each pixel as colour, 3 bytes per pixel: metrics_ramp of the error that
 * e50 to e99 use; dark grey (64, 64, 64) if the mask excludes a pixel, green (0, 255, 0) if the test is not finite.
 * Neither is on the ramp. */
void metrics_heat(uint8_t *rgb, const metrics_input *in, double truth_mean);

/* metrics_ramp: 0 black, blue, purple, orange, yellow, white 1 (and beyond). CIE lightness rises with t, within 3 of
 * 100 t, so that equal steps of error look like equal steps. */
void metrics_ramp(uint8_t rgb[3], double t);

#endif
