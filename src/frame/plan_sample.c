/* plan_sample.c: samples tiles of a solved frame: the light, and the work that it took. Layer 8. */
#include <lambent/plan.h>

#include <string.h>

#include "../base/vec.h"
#include "stages.h"
#include "requires.h"
#include "plan_model.h"

#if LMB_PLAN && LMB_TREES

static int can_sample(const lmb_render *r)
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
    s->saved_tests = 0;
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
    if (out == NULL || scratch == NULL || places == NULL || !can_sample(r) || r->frame.gather_step > 1) {
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

#endif
