/* plan_survey.c: what a frame's tiles take by one setting, and which of them are looked at. Floor 8.
 *
 * A few tiles, at edges and where things touch, take most of the segments: tiles spread evenly miss them or find too
 * many. So all are asked by a cheap setting, and a tile's chance to be looked at goes by what it took (three quarters
 * of it, the rest is even), with a weight that makes up for it. They are met along a Z curve, one for every so much
 * taken, so that neighbours share one. */
#include <lambent/plan.h>

#include <string.h>

#include "../base/vec.h"
#include "plan_look.h"
#include "stages.h"
#include "wants.h"

#if LMB_PLAN && LMB_TREES

#define BY_TAKEN 0.75
enum { TURNS = 8 /* of finding how much is taken by one place that is looked at: 2 to 5 settle it */ };

static uint32_t even_bits(uint32_t v)
{
    uint32_t out = 0;
    for (int i = 0; i < 16; ++i) {
        out |= (v >> (2 * i) & 1u) << i;
    }
    return out;
}

/* What a place takes: 0 where nothing is seen. */
static lmb_status take_place(lmb_survey *out, const lmb_render *r, lmb_band_scratch *s, int32_t x, int32_t y)
{
    uint64_t shown[LMB_SPARSE_TILES];
    lmb_stats *n = &s->counts;
    double pixels = 0.0;
    memset(n, 0, sizeof *n);
    const lmb_status status = place_light(shown, r, s, x, y, out->tiles);
    for (int part = 0; part < out->tiles; ++part) {
        pixels += (double)count_bits_64(shown[part]);
    }
    out->pixels += pixels;
    out->x[out->surveyed] = (uint16_t)x;
    out->y[out->surveyed] = (uint16_t)y;
    out->take[out->surveyed] = pixels > 0.0 ? (float)(1.0 + (double)n->pairs + (double)n->segments) : 0.0f;
    ++out->surveyed;
    return status;
}

/* All places, or as many as there is room for, evenly along the curve. */
static lmb_status take_all(lmb_survey *out, const lmb_render *r, lmb_band_scratch *s)
{
    const lmb_view *v = &r->frame.view;
    const uint32_t wide = (uint32_t)(LMB_TILE * out->tiles);
    const uint32_t across = ((uint32_t)v->frame_width + wide - 1) / wide, down = (uint32_t)band_count(v);
    const uint64_t all = (uint64_t)across * down, most = LMB_SURVEY / (uint64_t)out->tiles;
    const uint64_t wanted = all < most ? all : most;
    lmb_status status = LMB_OK;
    uint64_t met = 0;
    for (uint32_t code = 0; met < all && status == LMB_OK; ++code) {
        const uint32_t x = even_bits(code), y = even_bits(code >> 1);
        if (x < across && y < down) {
            ++met;
            if (met * wanted / all > (met - 1) * wanted / all) {
                status = take_place(out, r, s, (int32_t)(x * wide), (int32_t)(y * LMB_TILE));
            }
        }
    }
    return status;
}

/* How large a place is to the choice among them. */
static double size_of(const lmb_survey *s, int32_t i, double even)
{
    return s->take[i] > 0.0f ? BY_TAKEN * (double)s->take[i] + even : 0.0;
}

static double least(double a, double b) { return a < b ? a : b; }

/* Of `wanted` places one is met every `step`; a place that is larger is as large as that: it is met once. */
static double find_step(const lmb_survey *s, double even, double wanted)
{
    double step = 1e300;
    for (int turn = 0; turn < TURNS; ++turn) {
        double sum = 0.0;
        for (int32_t i = 0; i < s->surveyed; ++i) {
            sum += least(size_of(s, i, even), step);
        }
        step = sum / wanted;
    }
    return step;
}

/* In place: those met are moved to the front. */
static void choose_places(lmb_survey *s)
{
    const double wanted = s->tiles == 1 ? (double)LMB_LOOK_TILES : (double)LMB_LOOK_BLOCKS;
    double sum = 0.0, seen = 0.0, along = 0.0;
    for (int32_t i = 0; i < s->surveyed; ++i) {
        sum += (double)s->take[i];
        seen += s->take[i] > 0.0f ? 1.0 : 0.0;
    }
    const double even = seen > 0.0 ? (1.0 - BY_TAKEN) * sum / seen : 0.0;
    const double step = find_step(s, even, wanted);
    double next = 0.5 * step;
    for (int32_t i = 0; i < s->surveyed; ++i) {
        const double size = seen > wanted ? least(size_of(s, i, even), step) : size_of(s, i, even);
        along += size;
        if (size > 0.0 && (seen <= wanted || (along > next && (double)s->count < wanted))) {
            s->x[s->count] = s->x[i];
            s->y[s->count] = s->y[i];
            s->weight[s->count++] = seen > wanted ? (float)(step / size) : 1.0f;
            next += step;
        }
    }
}

/* Of the pixels of the frame's tiles, in whole tiles: what has an id. */
static float share_shown(const lmb_render *r, lmb_tile *tile)
{
    const lmb_frame *f = &r->frame;
    double n = 0.0, all = 0.0;
    for (int32_t y = 0; y < f->view.frame_height; y += LMB_TILE) {
        for (int32_t x = 0; x < f->view.frame_width; x += LMB_TILE) {
            if (lmb_resolve_tile(tile, f->kernels, &f->view, f->scene, &f->eye, x, y) == LMB_OK) {
                n += (double)count_bits_64(lmb_shown(tile));
            }
            all += LMB_TILE_PIXELS;
        }
    }
    return (float)(n / all);
}

lmb_status lmb_render_survey(lmb_survey *out, const lmb_render *r, lmb_band_scratch *scratch)
{
    if (out == NULL || scratch == NULL || !lmb_can_look(r)) {
        return LMB_ERR_ARG;
    }
    out->tiles = r->frame.gather_step > 1 ? LMB_SPARSE_TILES : 1;
    out->count = out->surveyed = 0;
    out->pixels = 0.0;
    out->shown = share_shown(r, &scratch->tile);
    const lmb_status status = take_all(out, r, scratch);
    choose_places(out);
    return status;
}

#endif
