/* bench_breakdown.c: the share of a picture's error that each stage adds. */
#include "bench_breakdown.h"

#include <stdlib.h>
#include <string.h>

/* Mean over the channels. */
static double square_of(const float *a, const float *b)
{
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double apart = (double)a[c] - (double)b[c];
        sum += apart * apart;
    }
    return sum / 3.0;
}

static int ascending(const void *a, const void *b)
{
    double x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return (x > y) - (x < y);
}

/* Squared errors of the pixels that count; returns the number of pixels. */
static size_t errors_of(double *squares, const float *test, const float *truth, const uint8_t *counts, size_t pixels)
{
    size_t n = 0;
    for (size_t i = 0; i < pixels; ++i) {
        if (counts[i]) {
            squares[n++] = square_of(test + 3 * i, truth + 3 * i);
        }
    }
    return n;
}

/* Leaves out the worst hundredth. */
static void trim(uint8_t *kept, double *squares, const float *test, const float *truth, const uint8_t *counts,
                 size_t pixels)
{
    const size_t n = errors_of(squares, test, truth, counts, pixels);
    qsort(squares, n, sizeof *squares, ascending);
    const double max = squares[n - n / 100 - 1];
    for (size_t i = 0; i < pixels; ++i) {
        kept[i] &= (uint8_t)(square_of(test + 3 * i, truth + 3 * i) <= max);
    }
}

/* Mean square difference of two pictures. */
static double step(const float *a, const float *b, const uint8_t *kept, size_t pixels)
{
    double sum = 0.0;
    size_t n = 0;
    for (size_t i = 0; i < pixels; ++i) {
        if (kept[i]) {
            sum += square_of(a + 3 * i, b + 3 * i);
            ++n;
        }
    }
    return n > 0 ? sum / (double)n : 0.0;
}

/* Mean of the truth; 0 if no pixel counts. */
static double mean_of(const float *truth, const uint8_t *counts, size_t pixels)
{
    double sum = 0.0;
    size_t n = 0;
    for (size_t i = 0; i < pixels; ++i) {
        if (counts[i]) {
            sum += ((double)truth[3 * i] + (double)truth[3 * i + 1] + (double)truth[3 * i + 2]) / 3.0;
            ++n;
        }
    }
    return n > 0 ? sum / (double)n : 0.0;
}

static void sum_up(bench_breakdown *l, const float *const *picture, const uint8_t *kept, size_t pixels, double mean)
{
    l->total = step(picture[0], picture[l->rows], kept, pixels) / (mean * mean);
    l->sum = 0.0;
    for (int i = 0; i < l->rows; ++i) {
        l->row[i].square = step(picture[i], picture[i + 1], kept, pixels) / (mean * mean);
        l->sum += l->row[i].square;
    }
}

int bench_breakdown_sum(bench_breakdown *l, const float *const *picture, const uint8_t *counts, size_t pixels)
{
    const float *truth = picture[l->rows];
    const double mean = mean_of(truth, counts, pixels);
    double *squares = malloc((pixels > 0 ? pixels : 1) * sizeof *squares);
    uint8_t *kept = malloc(pixels > 0 ? pixels : 1);
    const int ok = squares != NULL && kept != NULL && mean > 0.0;
    if (ok) {
        memcpy(kept, counts, pixels);
        for (int i = 0; i < l->rows; ++i) {
            trim(kept, squares, picture[i], truth, counts, pixels);
        }
        sum_up(l, picture, kept, pixels, mean);
    }
    free(squares);
    free(kept);
    return ok;
}
