/* bounced.c: the bounced light of a tile, from cuts of the trees or from groups. Floor 10. */
#include "stages.h"
#include "wants.h"

/* What the light's maps bounce, and what elements send. */
static lmb_status gather_cuts(lmb_irradiance *inout, lmb_gloss *gloss, const lmb_render *r, lmb_band_scratch *s,
                              const lmb_tile *tile, const lmb_irradiance *direct)
{
    const lmb_frame *f = &r->frame;
    lmb_cutting cutting = cutting_of(f, &s->counts);
    cutting.gloss = gloss;
    cutting.direct = direct;
    lmb_status status = lmb_gather_cut(inout, f->kernels, &s->gather.cut, tile, &f->tree, &cutting);
    if (status == LMB_OK && wants_elements(r)) {
        cutting.beside = inout;
        status = lmb_gather_cut(inout, f->kernels, &s->gather.cut, tile, &f->elements.tree, &cutting);
    }
    return status;
}

lmb_status lmb_render_gather(lmb_irradiance *inout, lmb_gloss *gloss, const lmb_render *r, lmb_band_scratch *s,
                             const lmb_tile *tile, const lmb_irradiance *direct)
{
    const lmb_frame *f = &r->frame;
    lmb_occluder occluder;
    if (omits(r, LMB_OMIT_BOUNCE)) {
        return LMB_OK;
    }
    if (wants_cut(f)) {
        return gather_cuts(inout, gloss, r, s, tile, direct);
    }
    if (!wants_groups(f)) {
        return LMB_OK;
    }
    occluder.view = &f->view;
    occluder.depth = occluding_depth(f);
    occluder.kind = f->occlusion;
    occluder.steps = f->steps;
    return lmb_gather_tile(inout, f->kernels, &s->gather.groups, tile, f->groups, &f->points, &occluder);
}
