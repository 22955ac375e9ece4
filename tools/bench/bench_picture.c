/* bench_picture.c: pictures for a report: small, in display codes. */
#include "bench_picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../picture/metrics.h"
#include "../picture/picture.h"

enum { SIDE = 320 };

static int32_t square_side(int32_t width, int32_t height)
{
    const int32_t max = width > height ? width : height;
    return (max + SIDE - 1) / SIDE;
}

/* Averages n x n pixels; drops the remainder at the right and bottom. */
static int shrink(image *out, const image *in, int32_t n)
{
    out->width = in->width / n;
    out->height = in->height / n;
    out->channels = 3;
    out->pixels = calloc((size_t)out->width * (size_t)out->height * 3 + 1, sizeof *out->pixels);
    for (int32_t i = 0; out->pixels != NULL && i < out->width * n * out->height * n; ++i) {
        const int32_t x = i % (out->width * n), y = i / (out->width * n);
        const float *from = in->pixels + 3 * ((size_t)y * (size_t)in->width + (size_t)x);
        float *to = out->pixels + 3 * ((size_t)(y / n) * (size_t)out->width + (size_t)(x / n));
        for (int c = 0; c < 3; ++c) {
            to[c] += from[c] / (float)(n * n);
        }
    }
    return out->pixels != NULL;
}

void bench_picture_of(bench_picture *out, const image *linear, float exposure_ev)
{
    image small;
    memset(out, 0, sizeof *out);
    if (shrink(&small, linear, square_side(linear->width, linear->height))) {
        out->rgb = picture_codes(&small, exposure_ev, PICTURE_CLIPPED);
        out->width = small.width;
        out->height = small.height;
    }
    image_free(&small);
}

static double grey(const float *p) { return ((double)p[0] + (double)p[1] + (double)p[2]) / 3.0; }

static void heat_of(uint8_t *rgb, const image *test, const image *truth, const float *surface, double truth_mean)
{
    for (size_t i = 0; i < (size_t)truth->width * (size_t)truth->height; ++i) {
        const double a = grey(test->pixels + 3 * i), b = grey(truth->pixels + 3 * i);
        metrics_ramp(rgb + 3 * i, a == b ? 0.0 : fabs(a - b) / (b + 0.01 * truth_mean) / BENCH_HEAT);
        if (surface != NULL && surface[3 * i + 2] <= 0.5f) {
            memset(rgb + 3 * i, 64, 3);
        }
    }
}

void bench_picture_heat(bench_picture *out, const image *test, const image *truth, const float *surface,
                        double truth_mean)
{
    const int32_t n = square_side(truth->width, truth->height);
    image a, b;
    memset(out, 0, sizeof *out);
    const int ok = shrink(&a, test, n) & shrink(&b, truth, n);
    out->rgb = ok ? malloc((size_t)b.width * (size_t)b.height * 3 + 1) : NULL;
    if (out->rgb != NULL) {
        out->width = b.width;
        out->height = b.height;
        heat_of(out->rgb, &a, &b, n == 1 ? surface : NULL, truth_mean);
    }
    image_free(&a);
    image_free(&b);
}
