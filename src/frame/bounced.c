/* bounced.c: the bounced light of a tile, from cuts of the trees or from groups. Layer 8. */
#include "../base/vec.h"
#include "../raster/tile.h"
#include "../raster/triangle.h"
#include "stages.h"
#include "requires.h"

/* The samples of a pack are spread out, so a cut that fits the nearest sample is too fine for the others. The errors of
 * samples are smaller than those of the interpolation between them. */
#define SPREAD_VISIBILITY 1.5f /* times the limit for adjacent pixels */

/* Direct light of many lights. Samples of a pack are spread out, so each tests every shadow separately. */
NOINLINE lmb_status gather_many_lights(lmb_irradiance *inout, const lmb_render *r, lmb_band_scratch *s,
                                     const lmb_tile *tile)
{
    const lmb_frame *f = &r->frame;
    const lmb_many_lights_query query = {f->many_lights, f->bvh.triangle != NULL ? &f->bvh : NULL, f->many_lights_error,
                                         tile != &s->tile, 1, &s->counts};
    return lmb_many_lights_direct_tile(inout, f->kernels, &s->many_lights, tile, &query);
}

#if LMB_LIVE

lmb_status lmb_render_live(float light[3], const lmb_render *r, lmb_band_scratch *s, const lmb_live_receiver *at)
{
    const lmb_frame *f = &r->frame;
    const lmb_status status = lmb_live_receive(light, f->kernels, s->live, f->live, live_bvh(f), at);
    count_live(&s->counts, s->live);
    return status;
}

/* Lights each pixel separately. */
NOINLINE lmb_status gather_live(lmb_irradiance *inout, const lmb_render *r, lmb_band_scratch *s, const lmb_tile *tile)
{
    lmb_status status = LMB_OK;
    for (int k = 0; k < LMB_TILE_PIXELS && status == LMB_OK; ++k) {
        if (tile->id[k] != 0) {
            const lmb_live_receiver at = {tile_vec(tile->position, k), tile_vec(tile->face, k),
                                          tile_vec(tile->normal, k), tile->id[k],
                                          lmb_place_noise(tile_vec(tile->position, k), absf(tile->depth[k])),
                                          view_to_eye(&r->frame.view, tile_vec(tile->position, k))};
            float light[3];
            status = lmb_render_live(light, r, s, &at);
            for (int c = 0; c < 3 && status == LMB_OK; ++c) {
                inout->rgb[c][k] += light[c];
            }
        }
    }
    return status;
}

#else
#define gather_live(...) LMB_ERR_ARG /* never requested in this build */
#endif

void lmb_render_onto_triangles(lmb_tile *inout, const lmb_frame *f)
{
#if LMB_TREES
    if (requires_cut(f)) {
        (void)lmb_tile_onto_triangles(inout, f->scene);
    }
#else
    (void)inout;
    (void)f;
#endif
}

/* Gathers light that the shadow maps reflect and that elements send. */
static lmb_status gather_cuts(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *s,
                              const lmb_tile *tile, const lmb_irradiance *direct)
{
    const lmb_frame *f = &r->frame;
    lmb_cut_params cut_params = cut_params_of(f, &s->counts);
    cut_params.glossy = glossy;
    cut_params.view = &f->view;
    cut_params.direct = direct;
    cut_params.beside = gathers_many_lights(f) ? inout : NULL;
    if (takes_lattice(f->gather_step) && tile == &s->sparse.together) {
        cut_params.visibility *= SPREAD_VISIBILITY;
        cut_params.spread = 1;
    }
    lmb_status status = requires_live(f) && glossy == NULL
                            ? gather_live(inout, r, s, tile)
                            : lmb_gather_cut(inout, f->kernels, &s->gather.cut, tile, &f->tree, &cut_params);
    if (status == LMB_OK && requires_elements(r) && !(requires_live(f) && glossy == NULL)) {
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
    if (gathers_many_lights(f)) {
        const lmb_status status = gather_many_lights(inout, r, s, tile);
        if (status != LMB_OK) {
            return status;
        }
    }
    if (requires_transfer(f)) {
        return lmb_transfer_tile(inout, glossy, f->kernels, &s->gather.transfer, &f->transfer_light, f->transfer,
                                 f->scene, tile);
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
