/* plan_look.c: a look at some tiles of a solved frame: what a setting costs and how far it is from another. Floor 8. */
#include <lambent/plan.h>

#include <string.h>

#include "../base/vec.h"
#include "stages.h"
#include "wants.h"

#if LMB_PLAN && LMB_TREES

enum { BLOCK = LMB_SPARSE_TILES * LMB_TILE, BLOCK_PIXELS = LMB_SPARSE_TILES * LMB_TILE_PIXELS, BINS = 256 };
#define GOLDEN 0.6180340f

/* How many blocks there are, side by side and in all. */
static int32_t across(const lmb_view *v) { return (v->frame_width + BLOCK - 1) / BLOCK; }
static int32_t block_count(const lmb_view *v) { return mini(LMB_LOOK_BLOCKS, across(v) * band_count(v)); }

/* Block i's first tile: spread along the frame's bands, at places of a golden-ratio sequence within them; of small
 * frames each once. */
static void place_block(int32_t *x, int32_t *band, const lmb_view *v, int32_t i)
{
    const int32_t bands = band_count(v), all = block_count(v);
    const float along = (float)i * GOLDEN;
    *band = mini((int32_t)(((float)i + 0.5f) / (float)all * (float)bands), bands - 1);
    *x = mini((int32_t)((along - floorf(along)) * (float)across(v)), across(v) - 1) * BLOCK;
    if (all == across(v) * bands) {
        *band = i / across(v);
        *x = i % across(v) * BLOCK;
    }
}

/* One tile's light into `out`. */
static lmb_status put_tile(float (*out)[3], lmb_look *look, const lmb_irradiance *light, const lmb_tile *tile)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        for (int c = 0; c < 3; ++c) {
            out[k][c] = tile->id[k] != 0 ? light->rgb[c][k] : -1.0f;
        }
        look->pixels += tile->id[k] != 0 ? 1.0 : 0.0;
    }
    return LMB_OK;
}

static lmb_status take_tile(float (*out)[3], lmb_look *look, const lmb_render *r, lmb_band_scratch *s, int32_t x,
                            int32_t y, int32_t part)
{
    const lmb_frame *f = &r->frame;
    lmb_status status = lmb_resolve_tile(&s->tile, f->kernels, &f->view, f->scene, &f->eye, x + part * LMB_TILE, y);
    if (status != LMB_OK || f->gather_step > 1) {
        return status != LMB_OK ? status : put_tile(out, look, &s->sparse.light[part], &s->tile);
    }
    memset(&s->indirect, 0, sizeof s->indirect);
    status = lmb_render_gather(&s->indirect, NULL, r, s, &s->tile);
    return status != LMB_OK ? status : put_tile(out, look, &s->indirect, &s->tile);
}

static lmb_status take_block(float (*out)[3], lmb_look *look, const lmb_render *r, lmb_band_scratch *s, int32_t i)
{
    const lmb_frame *f = &r->frame;
    int32_t x, band;
    lmb_status status = LMB_OK;
    place_block(&x, &band, &f->view, i);
    const int32_t tiles = mini(LMB_SPARSE_TILES, (f->view.frame_width - x + LMB_TILE - 1) / LMB_TILE);
    if (f->gather_step > 1) {
        status = lmb_render_block(r, s, &f->eye, x, band * LMB_TILE, tiles);
    }
    for (int32_t part = 0; part < tiles && status == LMB_OK; ++part) {
        status = take_tile(out + part * LMB_TILE_PIXELS, look, r, s, x, band * LMB_TILE, part);
    }
    return status;
}

/* Of the frame's pixels, by bands resolved: what has an id. */
static float share_shown(const lmb_render *r, lmb_tile *tile)
{
    const lmb_frame *f = &r->frame;
    double n = 0.0;
    for (int32_t y = 0; y < f->view.frame_height; y += LMB_TILE) {
        for (int32_t x = 0; x < f->view.frame_width; x += LMB_TILE) {
            if (lmb_resolve_tile(tile, f->kernels, &f->view, f->scene, &f->eye, x, y) == LMB_OK) {
                for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                    n += tile->id[k] != 0 ? 1.0 : 0.0;
                }
            }
        }
    }
    return (float)(n / ((double)f->view.frame_width * (double)f->view.frame_height));
}

lmb_status lmb_render_look(lmb_look *out, const lmb_render *r, lmb_band_scratch *scratch)
{
    lmb_status status = LMB_OK;
    if (out == NULL || r == NULL || scratch == NULL || r->failed != LMB_OK || r->stage < LMB_STAGE_BANDS ||
        !wants_cut(&r->frame) || !is_whole(&r->frame.eye.depth, &r->frame.view)) {
        return LMB_ERR_ARG;
    }
    memset(&scratch->counts, 0, sizeof scratch->counts);
    out->pixels = 0.0;
    out->shown = share_shown(r, &scratch->tile);
    for (int32_t i = 0; i < LMB_LOOK_PIXELS; ++i) {
        out->light[i][0] = out->light[i][1] = out->light[i][2] = -1.0f;
    }
    for (int32_t i = 0; i < block_count(&r->frame.view) && status == LMB_OK; ++i) {
        status = take_block(out->light + i * BLOCK_PIXELS, out, r, scratch, i);
    }
    out->pairs = (double)scratch->counts.pairs;
    out->segments = (double)scratch->counts.segments;
    return status;
}

/* --- errors ------------------------------------------------------------------------------------------------------- */

/* Square errors by size: a bin an octave. */
typedef struct bins {
    double sum[BINS];
    uint32_t count[BINS];
} bins;

static double floor_of(double v) { return (double)(int32_t)v; }

static int bin_of(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    return (int)(bits >> 23) & (BINS - 1);
}

float lmb_look_error(const lmb_look *a, const lmb_look *b)
{
    bins all;
    double mean = 0.0, square = 0.0, count = 0.0;
    memset(&all, 0, sizeof all);
    for (int32_t i = 0; i < LMB_LOOK_PIXELS; ++i) {
        const float *p = a->light[i], *q = b->light[i];
        if (p[0] >= 0.0f && q[0] >= 0.0f) {
            const float x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2], e = x * x + y * y + z * z;
            all.sum[bin_of(e)] += (double)e;
            ++all.count[bin_of(e)];
            mean += (double)(q[0] + q[1] + q[2]);
            count += 1.0;
        }
    }
    double worst = floor_of(0.01 * count);
    for (int i = BINS - 1; i >= 0; --i) {
        const double n = (double)all.count[i], kept = n > worst ? n - worst : 0.0;
        square += n > 0.0 ? all.sum[i] * (kept / n) : 0.0;
        worst -= n - kept;
    }
    const double per = count - floor_of(0.01 * count);
    return mean > 0.0 && per > 0.0 ? (float)((double)sqrtf((float)(square / (3.0 * per))) / (mean / (3.0 * count)))
                                   : 0.0f;
}

#endif
