/* ladder_sample.c: picks the tiles of a frame to sample, and compares samples of two settings. */
#include "ladder.h"

#include <math.h>
#include <string.h>

enum { BINS = 128, MIN = 40 /* biased exponent of the first bin: 2^-87 */, MIN_PLACES = 4 };

/* --- places ------------------------------------------------------------------------------------------------------- */

static uint32_t even_bits(uint32_t v)
{
    uint32_t out = 0;
    for (int i = 0; i < 16; ++i) {
        out |= (v >> (2 * i) & 1u) << i;
    }
    return out;
}

/* The i-th position to visit, of `all` along the curve: any number of first positions is evenly spread. */
static uint32_t spread(uint32_t i, uint32_t all)
{
    uint64_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) {
        reversed |= (uint64_t)(i >> bit & 1u) << (31 - bit);
    }
    return (uint32_t)(reversed * all >> 32);
}

void ladder_places(lmb_survey *out, const lmb_view *v, int32_t wanted)
{
    const uint32_t across = ((uint32_t)v->frame_width + LMB_TILE - 1) / LMB_TILE,
                   down = ((uint32_t)v->frame_height + LMB_TILE - 1) / LMB_TILE, all = across * down;
    memset(out, 0, sizeof *out);
    out->count = (uint32_t)wanted < all / 2 ? wanted : (int32_t)((all + 1) / 2); /* so that no two are equal */
    uint32_t met = 0;
    for (uint32_t code = 0; met < all; ++code) {
        const uint32_t x = even_bits(code), y = even_bits(code >> 1);
        for (int32_t i = 0; x < across && y < down && i < out->count; ++i) {
            if (spread((uint32_t)i, all) == met) {
                out->x[i] = (uint16_t)(x * LMB_TILE);
                out->y[i] = (uint16_t)(y * LMB_TILE);
            }
        }
        met += x < across && y < down;
    }
}

/* --- errors ------------------------------------------------------------------------------------------------------- */

/* Histogram of squared errors, a bin per octave. */
typedef struct bins {
    double sum[BINS], count[BINS];
} bins;

/* Compares the places that two samples share. */
typedef struct difference {
    const lmb_tile_sample *a, *b;
    int32_t places;
    double mean, count, square; /* of b's channels: sum; pixels; differences without the worst: sum of squares */
    double max;                 /* limit of a pixel's square, except the worst */
} difference;

static int bin_of(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    const int bin = (int)(bits >> 23 & 0xffu) - MIN;
    return bin < 0 ? 0 : bin < BINS ? bin : BINS - 1;
}

/* A pixel's squared error; negative: no surface. */
static float square_at(const difference *d, int32_t i)
{
    const float *p = d->a->light[i], *q = d->b->light[i];
    const float x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
    return p[0] >= 0.0f && q[0] >= 0.0f ? x * x + y * y + z * z : -1.0f;
}

static void bin_pixels(bins *all, difference *d)
{
    memset(all, 0, sizeof *all);
    for (int32_t i = 0; i < d->places * LMB_TILE_PIXELS; ++i) {
        const float e = square_at(d, i), *q = d->b->light[i];
        if (e >= 0.0f) {
            all->sum[bin_of(e)] += (double)e;
            all->count[bin_of(e)] += 1.0;
            d->mean += (double)(q[0] + q[1] + q[2]);
            d->count += 1.0;
        }
    }
}

/* Returns 0 if the places are dark or empty. */
static int compare(difference *d, const lmb_tile_sample *a, const lmb_tile_sample *b)
{
    bins all;
    memset(d, 0, sizeof *d);
    if (a == NULL || b == NULL) {
        return 0;
    }
    d->a = a;
    d->b = b;
    d->places = a->places < b->places ? a->places : b->places;
    bin_pixels(&all, d);
    double worst = 0.01 * d->count;
    for (int i = BINS - 1; i >= 0; --i) {
        const double n = all.count[i], kept = n > worst ? n - worst : 0.0;
        d->square += n > 0.0 ? all.sum[i] * (kept / n) : 0.0;
        d->max = kept > 0.0 && d->max <= 0.0 ? all.sum[i] / n : d->max;
        worst -= n - kept;
    }
    return d->mean > 0.0;
}

static float difference_share(const difference *d, double square)
{
    return (float)((double)sqrtf((float)(square / (0.99 * 3.0 * d->count))) / (d->mean / (3.0 * d->count)));
}

/* Sum of the squared errors of a place's pixels. */
static double place_square(const difference *d, int32_t place)
{
    double sum = 0.0;
    for (int32_t i = place * LMB_TILE_PIXELS; i < (place + 1) * LMB_TILE_PIXELS; ++i) {
        const double e = (double)square_at(d, i);
        sum += e > d->max ? d->max : e > 0.0 ? e : 0.0;
    }
    return sum;
}

float ladder_error(const lmb_tile_sample *a, const lmb_tile_sample *b, float deviations)
{
    difference d;
    if (!compare(&d, a, b) || d.places < MIN_PLACES) {
        return -1.0f;
    }
    const double places = (double)d.places, mean = d.square / places;
    double variance = 0.0;
    for (int32_t i = 0; i < d.places; ++i) {
        const double off = place_square(&d, i) - mean;
        variance += off * off;
    }
    const double deviation = (double)sqrtf((float)(variance * places / (places - 1.0)));
    return difference_share(&d, d.square + (double)deviations * deviation);
}
