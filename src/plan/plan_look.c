/* plan_look.c: a look at some tiles of a solved frame: what a setting costs and how far it is from another. Floor 8. */
#include "plan_look.h"

#include <string.h>

#include "../base/vec.h"
#include "stages.h"
#include "wants.h"

#if LMB_PLAN && LMB_TREES

enum { BINS = 128, LEAST = 40 /* octaves: from 2^-87 on */ };

int lmb_can_look(const lmb_render *r)
{
    return r != NULL && r->failed == LMB_OK && r->stage >= LMB_STAGE_BANDS && wants_cut(&r->frame) &&
           is_whole(&r->frame.eye.depth, &r->frame.view);
}

uint64_t lmb_shown(const lmb_tile *tile)
{
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        out |= (uint64_t)(tile->id[k] != 0) << k;
    }
    return out;
}

lmb_status lmb_render_tiles(uint64_t *shown, const lmb_render *r, lmb_band_scratch *s, int32_t x, int32_t y,
                            int32_t tiles)
{
    const lmb_frame *f = &r->frame;
    lmb_status status = LMB_OK;
    for (int32_t part = 0; part < tiles && status == LMB_OK; ++part) {
        status = lmb_resolve_tile(&s->tile, f->kernels, &f->view, f->scene, &f->eye, x + part * LMB_TILE, y);
        if (status == LMB_OK) {
            shown[part] = lmb_shown(&s->tile);
        }
        if (status == LMB_OK && f->gather_step == 1) {
            memset(&s->sparse.light[part], 0, sizeof s->sparse.light[part]);
            status = lmb_render_direct(r, NULL, s);
            status = status != LMB_OK ? status
                                      : lmb_render_gather(&s->sparse.light[part], NULL, r, s, &s->tile,
                                                          wants_direct(f) ? &s->direct : NULL);
        }
    }
    return status;
}

/* One tile's light. */
static void put_tile(float (*out)[3], const lmb_irradiance *light, uint64_t shown)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        for (int c = 0; c < 3; ++c) {
            out[k][c] = shown >> k & 1u ? light->rgb[c][k] : -1.0f;
        }
    }
}

static lmb_status take_place(lmb_look *out, const lmb_render *r, lmb_band_scratch *s, const lmb_survey *places,
                             int32_t i)
{
    uint64_t shown[LMB_SPARSE_TILES];
    const double weight = (double)places->weight[i];
    memset(&s->counts, 0, sizeof s->counts);
    const lmb_status status = place_light(shown, r, s, places->x[i], places->y[i], places->tiles);
    for (int32_t part = 0; part < places->tiles; ++part) {
        const int32_t at = i * places->tiles + part;
        put_tile(out->light + at * LMB_TILE_PIXELS, &s->sparse.light[part], shown[part]);
        out->weight[at] = places->weight[i];
    }
    out->pairs += weight * (double)s->counts.pairs;
    out->segments += weight * (double)s->counts.segments;
    return status;
}

lmb_status lmb_render_look(lmb_look *out, const lmb_render *r, lmb_band_scratch *scratch, const lmb_survey *places)
{
    lmb_status status = LMB_OK;
    if (out == NULL || scratch == NULL || places == NULL || !lmb_can_look(r) ||
        (r->frame.gather_step > 1 && places->tiles == 1)) {
        return LMB_ERR_ARG;
    }
    out->tiles = places->count * places->tiles;
    out->pixels = places->pixels;
    out->pairs = out->segments = 0.0;
    for (int32_t i = 0; i < places->count && status == LMB_OK; ++i) {
        status = take_place(out, r, scratch, places, i);
    }
    return status;
}

/* --- errors ------------------------------------------------------------------------------------------------------- */

/* Square errors by size: a bin an octave. */
typedef struct bins {
    double sum[BINS], count[BINS];
} bins;

static int bin_of(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    return clampi((int)(bits >> 23 & 0xffu) - LEAST, 0, BINS - 1);
}

float lmb_look_error(const lmb_look *a, const lmb_look *b)
{
    bins all;
    double mean = 0.0, square = 0.0, count = 0.0;
    memset(&all, 0, sizeof all);
    for (int32_t i = 0; a != NULL && b != NULL && i < b->tiles * LMB_TILE_PIXELS; ++i) {
        const float *p = a->light[i], *q = b->light[i];
        if (p[0] >= 0.0f && q[0] >= 0.0f) {
            const float x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2], e = x * x + y * y + z * z;
            const double weight = (double)b->weight[i / LMB_TILE_PIXELS];
            all.sum[bin_of(e)] += weight * (double)e;
            all.count[bin_of(e)] += weight;
            mean += weight * (double)(q[0] + q[1] + q[2]);
            count += weight;
        }
    }
    double worst = 0.01 * count;
    for (int i = BINS - 1; i >= 0; --i) {
        const double n = all.count[i], kept = n > worst ? n - worst : 0.0;
        square += n > 0.0 ? all.sum[i] * (kept / n) : 0.0;
        worst -= n - kept;
    }
    const double per = 0.99 * count;
    return mean > 0.0 && per > 0.0 ? (float)((double)sqrtf((float)(square / (3.0 * per))) / (mean / (3.0 * count)))
                                   : 0.0f;
}

#endif
