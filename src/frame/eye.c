/* eye.c: depth and ids of the view: the whole frame by steps or in parts, a strip of bands, or one band. Layer 8. */
#include <string.h>

#include "../base/vec.h"
#include "../bounce/points.h"
#include "../raster/target.h"
#include "stages.h"
#include "requires.h"

/* The target for the whole frame: with ids if the eye holds all of them, otherwise only the depth, for occlusion. */
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
                                 (uint32_t)units * UNIT_TRIANGLES, LMB_CULL_BACK | LMB_BLEND, f->stats);
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
    return lmb_draw(&window, f->kernels, &f->view, f->scene, 1, UINT32_MAX - 1, LMB_CULL_BACK | LMB_BLEND,
                    first == 0 ? stats : NULL);
}

/* Draws `bands` bands from `first` into the first rows of an eye that is smaller than the frame. */
static lmb_status draw_bands(const lmb_render *r, lmb_target *out, const lmb_target *eye, int32_t first, int32_t bands)
{
    lmb_target_rows(out, eye, 0, bands);
    out->y0 = first * LMB_TILE;
    clear_target(out);
    return lmb_draw(out, r->frame.kernels, &r->frame.view, r->frame.scene, 1, r->triangles, LMB_CULL_BACK | LMB_BLEND,
                    NULL);
}

lmb_status lmb_render_view_band(const lmb_render *r, lmb_target *out, const lmb_target *eye, int32_t band)
{
    *out = *eye;
    return is_whole(&eye->depth, &r->frame.view) ? LMB_OK : draw_bands(r, out, eye, band, 1);
}

lmb_status lmb_render_view_strip(const lmb_render *r, lmb_target *out, int32_t band)
{
    const lmb_target *eye = &r->frame.eye;
    if (is_whole(&eye->depth, &r->frame.view)) {
        *out = *eye;
        return LMB_OK;
    }
    const int32_t bands = eye->depth.height / LMB_TILE, first = band - band % bands; /* the eye holds only some bands */
    lmb_status status = LMB_OK;
    if (band == first) {
        status = draw_bands(r, out, eye, first, mini(bands, band_count(&r->frame.view) - first));
    }
    lmb_target_rows(out, eye, band - first, 1);
    out->y0 = band * LMB_TILE;
    return status;
}
