/* plan_sample.c: samples tiles of a solved frame: the work of settings, and differences between them. Layer 8. */
#include "plan_sample.h"

#include <string.h>

#include "../base/vec.h"
#include "stages.h"
#include "requires.h"
#include "plan_model.h"

#if LMB_PLAN && LMB_TREES

enum { BINS = 128, MIN = 40 /* biased exponent of the first bin: 2^-87 */, MIN_PLACES = 4 };

int lmb_can_sample(const lmb_render *r)
{
    return r != NULL && r->failed == LMB_OK && r->stage >= LMB_STAGE_BANDS && requires_cut(&r->frame) &&
           is_whole(&r->frame.eye.depth, &r->frame.view);
}

/* Stores the light of the tile at frame pixel (x, y). */
static lmb_status take_tile(float (*out)[3], const lmb_render *r, lmb_band_scratch *s, int32_t x, int32_t y)
{
    const lmb_frame *f = &r->frame;
    lmb_status status = lmb_resolve_tile(&s->tile, f->kernels, &f->view, f->scene, &f->eye, x, y);
    status = status != LMB_OK ? status : lmb_render_direct(r, NULL, s, &s->tile, &f->view);
    memset(&s->indirect, 0, sizeof s->indirect);
    if (status == LMB_OK) {
        lmb_render_onto_triangles(&s->tile, f);
        status = lmb_render_gather(&s->indirect, NULL, r, s, &s->tile, requires_direct(f) ? &s->direct : NULL);
    }
    for (int k = 0; k < LMB_TILE_PIXELS && status == LMB_OK; ++k) {
        for (int c = 0; c < 3; ++c) {
            out[k][c] = s->tile.id[k] != 0 ? s->indirect.rgb[c][k] : -1.0f;
        }
    }
    return status;
}

/* Work of the samples so far plus one more place of mean cost. */
static double next_work(const lmb_tile_sample *out)
{
    const double work = out->pairs * (double)lmb_model.units[LMB_OP_PAIRS] +
                        out->segments * (double)lmb_model.units[LMB_OP_SEGMENTS];
    return out->places > 0 ? work * (double)(out->places + 1) / (double)out->places : 0.0;
}

lmb_status lmb_render_sample(lmb_tile_sample *out, const lmb_render *r, lmb_band_scratch *scratch,
                             const lmb_survey *places, double max)
{
    lmb_status status = LMB_OK;
    if (out == NULL || scratch == NULL || places == NULL || !lmb_can_sample(r) || r->frame.gather_step > 1) {
        return LMB_ERR_ARG;
    }
    out->places = 0;
    out->pairs = out->segments = 0.0;
    while (out->places < places->count && status == LMB_OK && (!(max > 0.0) || next_work(out) < max)) {
        const int32_t i = out->places++;
        memset(&scratch->counts, 0, sizeof scratch->counts);
        status = take_tile(out->light + i * LMB_TILE_PIXELS, r, scratch, places->x[i], places->y[i]);
        out->pairs += (double)scratch->counts.pairs;
        out->segments += (double)scratch->counts.segments;
    }
    return status;
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
    return clampi((int)(bits >> 23 & 0xffu) - MIN, 0, BINS - 1);
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
    d->places = mini(a->places, b->places);
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

float lmb_tile_sample_error(const lmb_tile_sample *a, const lmb_tile_sample *b, float deviations)
{
    difference d;
    if (!compare(&d, a, b) || d.places < MIN_PLACES) {
        return -1.0f;
    }
    const double places = (double)d.places, mean = d.square / places;
    double spread = 0.0;
    for (int32_t i = 0; i < d.places; ++i) {
        const double off = place_square(&d, i) - mean;
        spread += off * off;
    }
    const double deviation = (double)sqrtf((float)(spread * places / (places - 1.0)));
    return difference_share(&d, d.square + (double)deviations * deviation);
}

#endif
