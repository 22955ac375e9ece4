/* bounced.c: the bounced light of a tile, by the solver of the frame. Layer 8. */
#include "../raster/triangle.h"
#include "requires.h"
#include "solver.h"
#include "stages.h"

/* Direct light of many lights. The pixels of `together` lie apart, so each tests every shadow separately. */
NOINLINE lmb_status gather_many_lights(lmb_irradiance *inout, const lmb_render *r, lmb_band_scratch *s,
                                     const lmb_tile *tile)
{
    const lmb_frame *f = &r->frame;
    const lmb_many_lights_query query = {f->many_lights, f->bvh.triangle != NULL ? &f->bvh : NULL, f->many_lights_error,
                                         tile != &s->tile, 1, &s->counts};
    return lmb_many_lights_direct_tile(inout, f->kernels, &s->many_lights, tile, &query);
}

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

lmb_status lmb_render_gather(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *s,
                             const lmb_tile *tile, const lmb_irradiance *direct)
{
    const lmb_frame *f = &r->frame;
    const frame_solver *solver = lmb_solver_of(f);
    if (skips(r, LMB_SKIP_BOUNCE)) {
        return LMB_OK;
    }
    if (gathers_many_lights(f) && (glossy != NULL || !gathers_live_sky(f))) {
        const lmb_status status = gather_many_lights(inout, r, s, tile);
        if (status != LMB_OK) {
            return status;
        }
    }
    return solver != NULL ? solver->tile(inout, glossy, r, s, tile, direct) : LMB_OK;
}
