/* bands.c: tiles of a band to the picture, and bands to the caller. Layer 8. */
#include <float.h>
#include <string.h>

#include "../base/poly.h"
#include "../base/vec.h"
#include "../live/live_part.h"
#include "stages.h"
#include "requires.h"

#define BAND_UNITS 8

/* With several samples per pixel, a display clips each sample at white before the mean. */
static float white_of(const lmb_frame *f, const lmb_surface *out)
{
    return out->format == LMB_RGB32F ? FLT_MAX : lmb_exp2(-f->exposure_ev);
}

/* Direct and bounced light of the current tile. `indirect` is the bounced light, or NULL if it is gathered here. Tiles
 * with lobes always gather it. */
NOINLINE lmb_status light_pixels(const lmb_render *r, lmb_band_scratch *s, const lmb_irradiance *indirect,
                                 const lmb_surface *out, int32_t band)
{
    const lmb_frame *f = &r->frame;
    const int many = requires_multisample(f);
    lmb_glossy *glossy =
        requires_glossy(r) && lmb_glossy_tile(&s->glossy, &s->tile, &f->view, f->scene) ? &s->glossy : NULL;
    const int gathers = indirect == NULL || glossy != NULL;
    lmb_status status = LMB_OK;
    if (!many || gathers) {
        status = lmb_render_direct(r, many ? NULL : glossy, s, &s->tile, &f->view);
    }
    if (gathers && status == LMB_OK) {
        indirect = &s->indirect;
        memset(&s->indirect, 0, sizeof s->indirect);
        lmb_render_onto_triangles(&s->tile, f);
        status = lmb_render_gather(&s->indirect, glossy, r, s, &s->tile, requires_direct(f) ? &s->direct : NULL);
    }
    if (status == LMB_OK && many) {
        return lmb_multisample_light(r, s, indirect, glossy, band, white_of(f, out));
    }
    return status == LMB_OK ? lmb_render_radiance(r, glossy, s, &s->tile, &f->view, indirect) : status;
}

/* Bounced light from samples of the resolved tile's frame; NULL: it is gathered at each pixel. */
static lmb_status sampled_light(const lmb_irradiance **out, const lmb_render *r, lmb_band_scratch *s)
{
    *out = requires_samples(r) ? &s->between : NULL;
    return requires_samples(r) ? lmb_render_live_tile(&s->between, r, s) : LMB_OK;
}

/* Lights a band from the depth and ids in `window`. */
static lmb_status light_band(const lmb_render *r, lmb_band_scratch *scratch, const lmb_target *window,
                             const lmb_surface *out, int32_t band)
{
    const lmb_frame *f = &r->frame;
    const int32_t out_y0 = is_whole(out, &f->view) ? 0 : band * LMB_TILE;
    lmb_status status = requires_multisample(f) ? lmb_multisample_draw(r, scratch, band) : LMB_OK;
    if (requires_transfer(f)) {
        memset(&scratch->gather.transfer.met, 0, sizeof scratch->gather.transfer.met);
    }
    if (requires_live(f)) {
        lmb_live_forget(scratch->live);
    }
    if (LMB_TREES) {
        scratch->saved_tests = 0;
    }
    for (int32_t x = 0; x < f->view.frame_width && status == LMB_OK; x += LMB_TILE) {
        const lmb_irradiance *indirect;
        status = lmb_resolve_tile(&scratch->tile, f->kernels, &f->view, f->scene, window, x, band * LMB_TILE);
        if (status == LMB_OK) {
            status = sampled_light(&indirect, r, scratch);
        }
        if (status == LMB_OK) {
            status = light_pixels(r, scratch, indirect, out, band);
        }
        if (status == LMB_OK) {
            status = lmb_store_tile(out, f->kernels, 0, out_y0, &scratch->radiance, x, band * LMB_TILE, f->exposure_ev);
        }
    }
    return status;
}

lmb_status lmb_render_band(const lmb_render *r, lmb_band_scratch *scratch, const lmb_target *eye,
                           const lmb_surface *out, int32_t band)
{
    lmb_target window;
    if (r == NULL || scratch == NULL || eye == NULL || eye->depth.data == NULL || eye->id.data == NULL || out == NULL ||
        r->stage < LMB_STAGE_BANDS || band < 0 || band >= band_count(&r->frame.view) ||
        lacks_live(&r->frame, scratch)) {
        return LMB_ERR_ARG;
    }
    lmb_status status = lmb_render_check_out(out, &r->frame.view);
    if (status == LMB_OK) {
        status = r->failed;
    }
    if (status == LMB_OK) {
        status = lmb_multisample_check(&r->frame, scratch);
    }
    if (status == LMB_OK) {
        status = lmb_render_view_band(r, &window, eye, band);
    }
    return status == LMB_OK ? light_band(r, scratch, &window, out, band) : status;
}

/* Returns 1 to continue. */
NOINLINE int hand_over(const lmb_frame *f, int32_t band)
{
    lmb_surface rows = f->out;
    int32_t y = band * LMB_TILE;
    if (f->callback == NULL) {
        return 1;
    }
    if (is_whole(&f->out, &f->view)) {
        rows.data = (uint8_t *)rows.data + (ptrdiff_t)y * rows.stride_bytes;
    }
    rows.height = mini(LMB_TILE, f->view.frame_height - y);
    return f->callback(f->user, &rows, y) == 0;
}

lmb_status lmb_render_bands(lmb_render *r, int32_t units)
{
    const int32_t bands = band_count(&r->frame.view);
    for (int32_t n = 0; (n == 0 || n + BAND_UNITS <= units) && r->progress < (uint32_t)bands; n += BAND_UNITS) {
        int32_t band = (int32_t)r->progress++;
        memset(&r->frame.scratch->counts, 0, sizeof r->frame.scratch->counts);
        lmb_target window;
        lmb_status status = lmb_render_view_strip(r, &window, band);
        if (status == LMB_OK) {
            status = light_band(r, r->frame.scratch, &window, &r->frame.out, band);
        }
        if (status != LMB_OK) {
            return status;
        }
        if (r->frame.stats != NULL) {
            ++r->frame.stats->bands;
        }
        add_counts(r->frame.stats, &r->frame.scratch->counts);
        if (!hand_over(&r->frame, band)) {
            return LMB_OK;
        }
    }
    return r->progress < (uint32_t)bands ? LMB_MORE : LMB_OK;
}
