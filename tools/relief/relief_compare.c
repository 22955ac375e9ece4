/* relief_compare.c: compares a picture of a relief with one of the complex model. */
#include "relief_compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREES 57.295779513082323

/* --- outlines ----------------------------------------------------------------------------------------------------- */

/* Covered pixels with an uncovered neighbour. */
static size_t outline(int32_t *at, const relief_frame *f)
{
    const int32_t w = f->width, h = f->height;
    size_t n = 0;
    for (int32_t y = 0; y < h; ++y) {
        for (int32_t x = 0; x < w; ++x) {
            const int32_t i = y * w + x;
            if (f->depth[i] > 0.0f && (x == 0 || y == 0 || x + 1 == w || y + 1 == h || f->depth[i - 1] == 0.0f ||
                                       f->depth[i + 1] == 0.0f || f->depth[i - w] == 0.0f || f->depth[i + w] == 0.0f)) {
                at[n++] = i;
            }
        }
    }
    return n;
}

static size_t distances(float *out, const int32_t *from, size_t n, const int32_t *to, size_t m, int32_t width)
{
    for (size_t i = 0; i < n; ++i) {
        int32_t best = INT32_MAX;
        for (size_t k = 0; k < m; ++k) {
            const int32_t dx = from[i] % width - to[k] % width, dy = from[i] / width - to[k] / width;
            best = dx * dx + dy * dy < best ? dx * dx + dy * dy : best;
        }
        out[i] = sqrtf((float)best);
    }
    return m > 0 ? n : 0;
}

static int rising(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static double percentile(float *values, size_t n, double share)
{
    if (n == 0) {
        return -1.0;
    }
    qsort(values, n, sizeof *values, rising);
    return (double)values[(size_t)(share * (double)(n - 1) + 0.5)];
}

static int measure_outlines(relief_figures *out, const relief_frame *a, const relief_frame *b, report *r)
{
    const size_t pixels = (size_t)a->width * (size_t)a->height;
    int32_t *of_a = malloc(pixels * sizeof *of_a), *of_b = malloc(pixels * sizeof *of_b);
    float *d = malloc(2 * pixels * sizeof *d);
    const int ok = of_a != NULL && of_b != NULL && d != NULL;
    if (ok) {
        const size_t n = outline(of_a, a), m = outline(of_b, b);
        size_t count = distances(d, of_a, n, of_b, m, a->width);
        count += distances(d + count, of_b, m, of_a, n, a->width);
        out->silhouette_px = percentile(d, count, 0.5);
    }
    free(of_a);
    free(of_b);
    free(d);
    return ok || report_fail(r, "not enough memory to compare");
}

/* --- surfaces ----------------------------------------------------------------------------------------------------- */

static double angle(const float *a, const float *b)
{
    double dot = 0.0;
    for (int c = 0; c < 3; ++c) {
        dot += (double)a[c] * (double)b[c];
    }
    return acos(dot < -1.0 ? -1.0 : dot > 1.0 ? 1.0 : dot) * DEGREES;
}

double relief_squared(const float *a, const float *b)
{
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double d = (double)lmb_srgb_encode(a[c]) - (double)lmb_srgb_encode(b[c]);
        sum += d * d;
    }
    return sum;
}

static double decibel(double sum, size_t n)
{
    return n == 0 ? -1.0 : sum > 0.0 ? 10.0 * log10(255.0 * 255.0 * 3.0 * (double)n / sum) : 99.0;
}

/* Difference to a neighbour in one channel, sRGB codes. */
static int off(const relief_frame *f, const float *own, int32_t x, int32_t y, size_t c)
{
    return (int)lmb_srgb_encode(own[c]) -
           (int)lmb_srgb_encode(f->rgb[3 * ((size_t)y * (size_t)f->width + (size_t)x) + c]);
}

int relief_isolated(const relief_frame *f, int32_t x, int32_t y)
{
    const float *own = f->rgb + 3 * ((size_t)y * (size_t)f->width + (size_t)x);
    int above = 7, below = 7; /* a bit per channel that holds for all neighbours */
    for (int32_t k = 0; k < 9; ++k) {
        const int32_t nx = x + k % 3 - 1, ny = y + k / 3 - 1;
        if (k == 4 || nx < 0 || ny < 0 || nx >= f->width || ny >= f->height) {
            continue;
        }
        for (size_t c = 0; c < 3; ++c) {
            const int d = off(f, own, nx, ny, c);
            above &= d < RELIEF_UNLIKE ? ~(1 << c) : 7;
            below &= d > -RELIEF_UNLIKE ? ~(1 << c) : 7;
        }
    }
    return (above | below) != 0;
}

/* Over pixels that either covers. */
static double share_isolated(const relief_frame *test, const relief_frame *truth)
{
    long long isolated = 0, all = 0;
    for (int32_t i = 0; i < test->width * test->height; ++i) {
        if (test->depth[i] > 0.0f || truth->depth[i] > 0.0f) {
            const int32_t x = i % test->width, y = i / test->width;
            ++all;
            isolated += relief_isolated(test, x, y) && !relief_isolated(truth, x, y);
        }
    }
    return all > 0 ? (double)isolated / (double)all : 0.0;
}

static void measure_pixels(relief_figures *out, float *depth, float *normal, const relief_frame *a,
                           const relief_frame *b, double diagonal)
{
    const size_t pixels = (size_t)a->width * (size_t)a->height;
    size_t n = 0, either = 0, same = 0, of_a = 0, of_b = 0;
    double rgb = 0.0, open = 0.0, albedo = 0.0;
    for (size_t i = 0; i < pixels; ++i) {
        of_a += a->depth[i] > 0.0f;
        of_b += b->depth[i] > 0.0f;
        if (a->depth[i] > 0.0f && b->depth[i] > 0.0f) {
            depth[n] = (float)(fabs((double)a->depth[i] - (double)b->depth[i]) / diagonal);
            normal[n] = (float)angle(a->normal + 3 * i, b->normal + 3 * i);
            open += relief_squared(a->open + 3 * i, b->open + 3 * i);
            rgb += relief_squared(a->rgb + 3 * i, b->rgb + 3 * i);
            albedo += relief_squared(a->albedo + 3 * i, b->albedo + 3 * i);
            same += a->lit[i] == b->lit[i];
            ++n;
        }
    }
    either = of_a + of_b - n;
    out->iou = either > 0 ? (double)n / (double)either : -1.0;
    out->lost = of_b > 0 ? (double)(of_b - n) / (double)of_b : 0.0;
    out->added = of_b > 0 ? (double)(of_a - n) / (double)of_b : 0.0;
    out->depth_50 = percentile(depth, n, 0.5);
    out->depth_95 = percentile(depth, n, 0.95);
    out->normal_50 = percentile(normal, n, 0.5);
    out->normal_95 = percentile(normal, n, 0.95);
    out->psnr_db = decibel(open, n);
    out->shadowed_db = decibel(rgb, n);
    out->albedo_db = decibel(albedo, n);
    out->lit = n > 0 ? (double)same / (double)n : -1.0;
    out->isolated = share_isolated(a, b);
}

int relief_measure(relief_figures *out, const relief_frame *test, const relief_frame *truth, double diagonal,
                   report *r)
{
    const size_t pixels = (size_t)test->width * (size_t)test->height;
    float *depth = malloc(pixels * sizeof *depth), *normal = malloc(pixels * sizeof *normal);
    const int ok = depth != NULL && normal != NULL && measure_outlines(out, test, truth, r);
    if (ok) {
        measure_pixels(out, depth, normal, test, truth, diagonal);
    }
    free(depth);
    free(normal);
    return ok || report_fail(r, "not enough memory to compare");
}

/* --- as text ------------------------------------------------------------------------------------------------------ */

static void tell_compared(const relief_frame *f, const relief_frame *truth, const relief_figures *e)
{
    report_say("%-22s %12s %12s\n", "", "relief", "direct");
    report_say("%-22s %12.2f %12.2f\n", "shadow map, ms", 1e3 * f->light_s, 1e3 * truth->light_s);
    report_say("%-22s %12.2f %12.2f\n", "triangles, ms", 1e3 * f->draw_s, 1e3 * truth->draw_s);
    report_say("%-22s %12.2f %12.2f\n", "pixels, ms", 1e3 * f->band_s, 1e3 * truth->band_s);
    report_say("outline %.2f px (median), covered by both %.2f %%\n", e->silhouette_px, 100.0 * e->iou);
    report_say("depth %.4f %% of the diagonal (median), %.4f %% (95 of 100)\n", 100.0 * e->depth_50,
               100.0 * e->depth_95);
    report_say("normals %.2f degrees (median), %.1f (95 of 100)\n", e->normal_50, e->normal_95);
    report_say("light %.2f dB, without cast shadows %.2f; reflectance %.2f dB; lit or not as it should %.2f %%\n",
           e->shadowed_db, e->psnr_db, e->albedo_db, 100.0 * e->lit);
}

static double diagonal(const lmb_scene *s)
{
    const double x = (double)(s->bounds_max.x - s->bounds_min.x), y = (double)(s->bounds_max.y - s->bounds_min.y),
                 z = (double)(s->bounds_max.z - s->bounds_min.z);
    return sqrt(x * x + y * y + z * z);
}

int relief_tell(const relief_frame *f, relief_shot shot, const lmb_scene *complex, report *r)
{
    relief_frame truth;
    relief_figures e;
    shot.relief = NULL;
    shot.scene = complex;
    if (!relief_shoot(&truth, &shot, r)) {
        return 0;
    }
    const int ok = relief_measure(&e, f, &truth, diagonal(complex), r);
    if (ok) {
        tell_compared(f, &truth, &e);
    }
    relief_frame_free(&truth);
    return ok;
}
