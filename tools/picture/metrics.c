/* metrics.c: error metrics of one image against another, and an image of the errors.
 *
 * Sums run in double, pixels in row order and squared errors from the largest down, so that the results are the same on
 * all machines. */
#include "metrics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct sample {
    double error2; /* mean of the channels' squared differences */
    double test, truth;
    int finite;
} sample;

static size_t pixel_count(const metrics_input *in) { return (size_t)in->width * (size_t)in->height; }

static const float *pixel_at(const metrics_input *in, const float *picture, size_t i)
{
    return picture + i * (size_t)in->channels;
}

/* A mask that is NaN keeps the pixel: a broken mask must not hide an error. */
static int is_compared(const metrics_input *in, size_t i)
{
    return !in->surface || !(in->surface[3 * i + 2] <= 0.5f);
}

static int is_finite3(const float *p) { return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]); }

static double square(double v) { return v * v; }

static sample sample_at(const metrics_input *in, size_t i)
{
    const float *b = pixel_at(in, in->truth, i), *a = pixel_at(in, in->test, i);
    static const float black[3] = {0.0f, 0.0f, 0.0f};
    sample s;
    s.finite = is_finite3(a);
    if (!s.finite)
        a = black;
    s.test = ((double)a[0] + (double)a[1] + (double)a[2]) / 3.0;
    s.truth = ((double)b[0] + (double)b[1] + (double)b[2]) / 3.0;
    s.error2 = (square((double)a[0] - (double)b[0]) + square((double)a[1] - (double)b[1]) +
                square((double)a[2] - (double)b[2])) / 3.0;
    return s;
}

/* Error relative to the truth, plus a hundredth of the mean truth so that dark pixels do not dominate. A negative truth
 * counts as black, so the error is never negative. */
static double relative_error(sample s, double truth_mean)
{
    double apart = fabs(s.test - s.truth);
    return apart == 0.0 ? 0.0 : apart / ((s.truth > 0.0 ? s.truth : 0.0) + 0.01 * truth_mean);
}

static int ascending(const void *a, const void *b)
{
    double x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return (x > y) - (x < y);
}

/* Squared errors of all compared pixels into `errors`, with the counts and means on the way. */
static int gather(metrics *out, double *errors, const metrics_input *in, report *r)
{
    size_t n = pixel_count(in), bad = 0, first_bad = 0;
    double test_sum = 0.0, truth_sum = 0.0;
    for (size_t i = 0; i < n; ++i) {
        if (!is_compared(in, i))
            continue;
        if (!is_finite3(pixel_at(in, in->truth, i)) && bad++ == 0)
            first_bad = i;
        sample s = sample_at(in, i);
        errors[out->pixels++] = s.error2;
        out->nonfinite += !s.finite;
        test_sum += s.test;
        truth_sum += s.truth;
    }
    if (out->pixels == 0)
        return report_fail(r, "the mask leaves no pixel to compare; give the depth file of this picture");
    if (bad)
        return report_fail(r, "%.0f pixels of the truth are not finite, the first at %d,%d; nothing can be measured "
                           "against them", (double)bad, (int)(first_bad % (size_t)in->width),
                           (int)(first_bad / (size_t)in->width));
    out->truth_mean = truth_sum / (double)out->pixels;
    if (!(out->truth_mean > 0.0))
        out->truth_mean = METRICS_BLACK;
    out->mean = test_sum / (double)out->pixels / out->truth_mean;
    return 1;
}

/* `errors` ascending; sums run from the largest down. */
static void square_figures(metrics *out, const double *errors)
{
    size_t n = (size_t)out->pixels, worst = n / 100;
    double total = 0.0, kept = 0.0, run = 0.0;
    for (size_t i = n; i-- > 0;)
        total += errors[i];
    for (size_t i = n - worst; i-- > 0;)
        kept += errors[i];
    for (size_t i = n; i-- > 0 && run < 0.9 * total;) {
        run += errors[i];
        ++out->n90;
    }
    out->rmse = sqrt(total / (double)n) / out->truth_mean;
    out->trim = sqrt(kept / (double)(n - worst)) / out->truth_mean;
}

static void relative_figures(metrics *out, double *errors, const metrics_input *in)
{
    size_t n = pixel_count(in), c = 0;
    for (size_t i = 0; i < n; ++i) {
        if (is_compared(in, i))
            errors[c++] = relative_error(sample_at(in, i), out->truth_mean);
    }
    qsort(errors, c, sizeof *errors, ascending);
    out->e50 = errors[c / 2];
    out->e95 = errors[(size_t)((double)c * 0.95)];
    out->e99 = errors[(size_t)((double)c * 0.99)];
}

static void leak_figure(metrics *out, const metrics_input *in)
{
    size_t n = pixel_count(in);
    double test_sum = 0.0, truth_sum = 0.0;
    for (size_t i = 0; i < n; ++i) {
        if (!is_compared(in, i))
            continue;
        sample s = sample_at(in, i);
        if (in->classes ? in->classes[i] == METRICS_DARK : s.truth < 0.01 * out->truth_mean) {
            test_sum += s.test;
            truth_sum += s.truth;
            ++out->dark;
        }
    }
    out->has_leak = out->dark >= METRICS_MIN_DARK;
    double floor_sum = 1e-4 * out->truth_mean * (double)out->dark; /* avoids a division by 0 for a black truth */
    if (out->has_leak)
        out->leak = (test_sum + floor_sum) / (truth_sum + floor_sum);
}

int metrics_measure(metrics *out, const metrics_input *in, report *r)
{
    static const metrics empty;
    size_t n = pixel_count(in);
    double *errors = n > SIZE_MAX / sizeof *errors ? NULL : malloc(n ? n * sizeof *errors : 1);
    *out = empty;
    if (!errors)
        return report_fail(r, "memory is short for %d x %d pixels", (int)in->width, (int)in->height);
    int ok = gather(out, errors, in, r);
    if (ok) {
        qsort(errors, (size_t)out->pixels, sizeof *errors, ascending);
        square_figures(out, errors);
        relative_figures(out, errors, in);
        leak_figure(out, in);
    }
    free(errors);
    return ok;
}

/* Returns the mean of the truth over the compared pixels among the 5 x 5 around a pixel. */
static double local_mean(const metrics_input *in, size_t at)
{
    const int32_t x = (int32_t)(at % (size_t)in->width), y = (int32_t)(at / (size_t)in->width);
    double sum = 0.0;
    int count = 0;
    for (int32_t j = y - 2; j <= y + 2; ++j) {
        for (int32_t i = x - 2; i <= x + 2; ++i) {
            const size_t k = (size_t)j * (size_t)in->width + (size_t)i;
            if (i >= 0 && j >= 0 && i < in->width && j < in->height && is_compared(in, k)) {
                sum += sample_at(in, k).truth;
                ++count;
            }
        }
    }
    return sum / count; /* count > 0: the pixel itself is compared */
}

/* Error of a compared pixel relative to the truth around it. */
static double local_error(const metrics *m, const metrics_input *in, size_t i)
{
    sample s = sample_at(in, i), around = s;
    around.truth = local_mean(in, i);
    around.test = around.truth + fabs(s.test - s.truth);
    return relative_error(around, m->truth_mean);
}

double metrics_worst(const metrics *m, const metrics_input *in)
{
    size_t n = pixel_count(in), c = 0;
    double *errors = malloc(n * sizeof *errors), worst = (double)INFINITY;
    for (size_t i = 0; errors && i < n; ++i) {
        if (is_compared(in, i))
            errors[c++] = local_error(m, in, i);
    }
    if (c > 0) {
        qsort(errors, c, sizeof *errors, ascending);
        worst = errors[(size_t)((double)c * 0.999)];
    }
    free(errors);
    return worst;
}

double metrics_worst_pixel(int32_t *x, int32_t *y, const metrics *m, const metrics_input *in)
{
    const size_t n = pixel_count(in);
    double worst = 0.0;
    *x = *y = -1;
    for (size_t i = 0; i < n; ++i) {
        const double error = is_compared(in, i) ? local_error(m, in, i) : 0.0;
        if (error > worst) {
            worst = error;
            *x = (int32_t)(i % (size_t)in->width);
            *y = (int32_t)(i / (size_t)in->width);
        }
    }
    return worst;
}

/* Largest difference of the three colour channels; a test pixel that is not finite counts as black. */
static double farthest_channel(const metrics_input *in, size_t i)
{
    const float *b = pixel_at(in, in->truth, i), *a = pixel_at(in, in->test, i);
    int finite = is_finite3(a);
    double max = 0.0;
    for (int k = 0; k < 3; ++k) {
        double apart = fabs((finite ? (double)a[k] : 0.0) - (double)b[k]);
        max = apart > max ? apart : max;
    }
    return max;
}

static double largest_channel(const float *p, double max)
{
    for (int k = 0; k < 3; ++k)
        max = (double)p[k] > max ? (double)p[k] : max;
    return max;
}

static void place(int32_t *x, int32_t *y, const metrics_input *in, size_t i)
{
    *x = (int32_t)(i % (size_t)in->width);
    *y = (int32_t)(i / (size_t)in->width);
}

void metrics_compare(metrics_equality *out, const metrics_input *in, double peak)
{
    static const metrics_equality empty;
    size_t n = pixel_count(in), pixel_bytes = (size_t)in->channels * sizeof(float);
    double error2 = 0.0, largest = 0.0;
    *out = empty;
    out->max_x = out->max_y = out->first_x = out->first_y = -1;
    for (size_t i = 0; i < n; ++i) {
        if (!is_compared(in, i))
            continue;
        ++out->pixels;
        if (memcmp(pixel_at(in, in->test, i), pixel_at(in, in->truth, i), pixel_bytes) == 0)
            ++out->exact;
        else if (out->first_x < 0)
            place(&out->first_x, &out->first_y, in, i);
        double apart = farthest_channel(in, i);
        if (apart > out->max_abs) {
            out->max_abs = apart;
            place(&out->max_x, &out->max_y, in, i);
        }
        error2 += sample_at(in, i).error2;
        largest = largest_channel(pixel_at(in, in->truth, i), largest);
    }
    out->peak = peak > 0.0 ? peak : largest;
    double mean_error2 = out->pixels ? error2 / (double)out->pixels : 0.0;
    out->psnr_db = mean_error2 > 0.0 ? 10.0 * log10(square(out->peak) / mean_error2) : (double)INFINITY;
}

/* Knots at CIE lightness 0, 20, 40, 60, 80, 100 (within 0.2): hue and chroma were chosen, green solved for. sRGB
 * codes are linear between knots, which changes lightness by at most 2.8. */
void metrics_ramp(uint8_t rgb[3], double t)
{
    static const uint8_t knots[6][3] = {{0, 0, 0},      {30, 24, 145},  {165, 38, 140},
                                        {240, 101, 50}, {250, 188, 45}, {255, 255, 255}};
    double s = t > 0.0 ? (t < 1.0 ? 5.0 * t : 5.0) : 0.0;
    int i = s < 4.0 ? (int)s : 4;
    for (int k = 0; k < 3; ++k) {
        double lo = (double)knots[i][k], hi = (double)knots[i + 1][k];
        rgb[k] = (uint8_t)(lo + (hi - lo) * (s - (double)i) + 0.5);
    }
}

void metrics_heat(uint8_t *rgb, const metrics_input *in, double truth_mean)
{
    static const uint8_t left_out[3] = {64, 64, 64}, not_finite[3] = {0, 255, 0};
    size_t n = pixel_count(in);
    for (size_t i = 0; i < n; ++i) {
        sample s = sample_at(in, i);
        if (!is_compared(in, i))
            memcpy(rgb + 3 * i, left_out, 3);
        else if (!s.finite)
            memcpy(rgb + 3 * i, not_finite, 3);
        else
            metrics_ramp(rgb + 3 * i, relative_error(s, truth_mean));
    }
}
