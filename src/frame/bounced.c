/* bounced.c: the bounced light of a tile, from cuts of the trees or from groups. Layer 10. */
#include "stages.h"
#include "requires.h"

/* What the light's shadow maps bounce, and what elements send. */
static lmb_status gather_cuts(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *s,
                              const lmb_tile *tile, const lmb_irradiance *direct)
{
    const lmb_frame *f = &r->frame;
    lmb_cut_params cut_params = cut_params_of(f, &s->counts);
    cut_params.glossy = glossy;
    cut_params.direct = direct;
    lmb_status status = lmb_gather_cut(inout, f->kernels, &s->gather.cut, tile, &f->tree, &cut_params);
    if (status == LMB_OK && requires_elements(r)) {
        cut_params.beside = inout;
        status = lmb_gather_cut(inout, f->kernels, &s->gather.cut, tile, &f->elements.tree, &cut_params);
    }
    return status;
}

lmb_status lmb_render_gather(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *s,
                             const lmb_tile *tile, const lmb_irradiance *direct)
{
    const lmb_frame *f = &r->frame;
    lmb_occluder occluder;
    if (skips(r, LMB_SKIP_BOUNCE)) {
        return LMB_OK;
    }
    if (requires_transfer(f)) {
        return lmb_transfer_tile(inout, f->kernels, &s->gather.transfer, &f->transfer_light, f->transfer, f->scene,
                                 tile);
    }
    if (requires_cut(f)) {
        return gather_cuts(inout, glossy, r, s, tile, direct);
    }
    if (!requires_groups(f)) {
        return LMB_OK;
    }
    occluder.view = &f->view;
    occluder.depth = occluding_depth(f);
    occluder.kind = f->occlusion;
    occluder.steps = f->steps;
    return lmb_gather_tile(inout, f->kernels, &s->gather.groups, tile, f->groups, &f->points, &occluder);
}
