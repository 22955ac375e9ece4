/* eye.c: depth and ids of the view: the whole frame by steps or in parts, or one band. Layer 10. */
#include <string.h>

#include "../bounce/points.h"
#include "../raster/target.h"
#include "stages.h"
#include "requires.h"

/* The whole frame's depth: with ids where the eye holds them all, else depth alone for the occlusion. */
static int view_target(lmb_target *out, const lmb_frame *f)
{
    *out = f->eye;
    if (is_whole(&f->eye.depth, &f->view)) {
        return 1;
    }
    const lmb_surface *map = occluding_depth(f);
    memset(out, 0, sizeof *out);
    if (map != NULL) {
        out->depth = *map;
    }
    return map != NULL;
}

static void clear_target(const lmb_target *t)
{
    lmb_surface_clear(&t->depth);
    if (t->id.data != NULL) {
        lmb_surface_clear(&t->id);
    }
}

lmb_status lmb_render_view(lmb_render *r, int32_t units)
{
    lmb_frame *f = &r->frame;
    lmb_target whole;
    if (reuses(r, LMB_REUSE_VIEW) || !view_target(&whole, f)) {
        return LMB_OK;
    }
    if (r->progress == 0) {
        clear_target(&whole);
    }
    lmb_status status = lmb_draw(&whole, f->kernels, &f->view, f->scene, r->progress + 1,
                                 (uint32_t)units * UNIT_TRIANGLES, LMB_CULL_BACK, f->stats);
    r->progress += (uint32_t)units * UNIT_TRIANGLES;
    return status != LMB_OK ? status : r->progress >= r->triangles ? LMB_OK : LMB_MORE;
}

lmb_status lmb_render_view_part(const lmb_render *r, int32_t part, int32_t parts, lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    lmb_target whole, window;
    int64_t first, past;
    share_out(&first, &past, band_count(&f->view), part, parts);
    if (first >= past || !view_target(&whole, f)) {
        return LMB_OK;
    }
    lmb_target_rows(&window, &whole, (int32_t)first, (int32_t)(past - first));
    clear_target(&window);
    return lmb_draw(&window, f->kernels, &f->view, f->scene, 1, UINT32_MAX - 1, LMB_CULL_BACK,
                    first == 0 ? stats : NULL);
}

lmb_status lmb_render_view_band(const lmb_render *r, lmb_target *eye, int32_t band)
{
    const lmb_frame *f = &r->frame;
    if (is_whole(&eye->depth, &f->view)) {
        return LMB_OK;
    }
    eye->y0 = band * LMB_TILE;
    lmb_surface_clear(&eye->depth);
    lmb_surface_clear(&eye->id);
    return lmb_draw(eye, f->kernels, &f->view, f->scene, 1, r->triangles, LMB_CULL_BACK, NULL);
}
