/* metrics.h: the error figures of one picture against another, and a picture of where the error is. */
#ifndef METRICS_H
#define METRICS_H

#include <stdint.h>

#include "../common/report.h"

#define METRICS_DARK 3.0f /* the class of pixels whose indirect light is under 1 % of its mean */
#define METRICS_MIN_DARK 21 /* dark pixels that leak needs; the mean of fewer says nothing */

/* What is compared: pictures of one size, rows from the top. Nothing here is owned or written. */
typedef struct metrics_input {
    const float *test, *truth; /* `channels` floats a pixel: red, green, blue and perhaps alpha */
    const float *surface;      /* 3 floats a pixel; the third at or under 0.5 leaves the pixel out; NULL: all count */
    const float *classes;      /* 1 float a pixel, METRICS_DARK: dark; NULL: dark is truth < 1 % of its mean */
    int32_t width, height;
    int32_t channels;          /* 3 or 4; the fourth counts for equality alone */
} metrics_input;

/* Relative errors; a test pixel that is not finite counts as black. Grey is the mean of the three channels. */
typedef struct metrics {
    double rmse;         /* over all channels / mean truth */
    double trim;         /* the same without the worst 1 % of pixels */
    double e50, e95, e99; /* percentiles of |a - b| / (b + 0.01 mean truth), grey */
    double mean;         /* mean test / mean truth, grey */
    double leak;         /* the same over dark pixels, both sums raised by 1e-4 mean truth a pixel; see has_leak */
    double truth_mean;   /* grey; 1e-30 for an all-black truth */
    uint64_t n90;        /* the fewest pixels that carry 90 % of the squared error */
    uint64_t pixels, dark, nonfinite;
    int has_leak;        /* 0: fewer than METRICS_MIN_DARK dark pixels, leak is 0 and means nothing */
} metrics;

/* How far the stored values are apart. */
typedef struct metrics_equality {
    double psnr_db;           /* over red, green, blue; infinite for equal values */
    double peak, max_abs;
    uint64_t pixels, exact;   /* exact: all channels have equal bits */
    int32_t max_x, max_y;     /* the first pixel with max_abs; -1 where all values are equal */
    int32_t first_x, first_y; /* the first pixel, row by row, that is not exact; -1 for none */
} metrics_equality;

/* metrics_measure: the figures above. Takes 8 bytes of memory a pixel while it runs.
 *
 * Returns 1, or 0 with `r` set: no pixel left to compare, a truth that is not finite, or memory is short. */
int metrics_measure(metrics *out, const metrics_input *in, report *r);

/* metrics_worst: the 99.9th percentile of |a - b| / (mean of b over the 5 x 5 pixels around + 0.01 mean truth), grey:
 * it finds dark or bright specks, which trim ignores. `m` holds the figures of the same input. Memory as above;
 * infinite if memory runs out. */
double metrics_worst(const metrics *m, const metrics_input *in);

/* metrics_worst_pixel: the largest of those errors, with its first pixel; -1 and 0 where all grey values are equal. */
double metrics_worst_pixel(int32_t *x, int32_t *y, const metrics *m, const metrics_input *in);

/* metrics_compare: `peak` is the PSNR's full scale; 0 takes the truth's largest value. */
void metrics_compare(metrics_equality *out, const metrics_input *in, double peak);

/* metrics_heat: relative grey error of each pixel as colour, 3 bytes a pixel: metrics_ramp of the error that e50 to
 * e99 are taken of; dark grey (64, 64, 64) where the mask leaves a pixel out, green (0, 255, 0) where the test is not
 * finite. Neither is on the ramp. */
void metrics_heat(uint8_t *rgb, const metrics_input *in, double truth_mean);

/* metrics_ramp: 0 black, blue, purple, orange, yellow, white 1 (and beyond). CIE lightness rises with t, within 3 of
 * 100 t, so that equal steps of error look like equal steps. */
void metrics_ramp(uint8_t rgb[3], double t);

#endif
