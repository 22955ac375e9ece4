/* sparse.c: bounced light of every second or fourth pixel, and of pixels that these cannot represent. Layer 8.
 *
 * Most of a gather's cost is per tile: selecting nodes and testing their visibility. So the sparse pixels of several
 * tiles are gathered as one tile. Tiles are resolved again for each pass: storing one takes 4 KiB, resolving one takes
 * microseconds. */
#include <string.h>

#include "../raster/tile.h"
#include "stages.h"
#include "requires.h"

/* Gathers the collected pixels, and distributes their light. Their tile has no corner pixels to test first, so `hits`
 * is 0. */
static lmb_status gather_together(const lmb_render *r, lmb_band_scratch *s)
{
    lmb_sparse *sparse = &s->sparse;
    memset(&s->indirect, 0, sizeof s->indirect);
    const lmb_status status =
        sparse->count > 0 ? lmb_render_gather(&s->indirect, NULL, r, s, &sparse->together, NULL) : LMB_OK;
    for (int32_t i = 0; i < sparse->count; ++i) {
        lmb_irradiance *light = &sparse->light[sparse->pixel[i] / LMB_TILE_PIXELS];
        for (int c = 0; c < 3; ++c) {
            light->rgb[c][sparse->pixel[i] % LMB_TILE_PIXELS] = s->indirect.rgb[c][i];
        }
    }
    sparse->count = 0;
    memset(&sparse->together, 0, sizeof sparse->together);
    return status;
}

/* Adds pixels of one tile, which stay together. */
static lmb_status put_together(const lmb_render *r, lmb_band_scratch *s, int32_t part, uint64_t pixels)
{
    lmb_sparse *sparse = &s->sparse;
    lmb_status status = LMB_OK;
    if (sparse->count + count_bits_64(pixels) > LMB_TILE_PIXELS) {
        status = gather_together(r, s);
    }
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        tile_put_pixel(&sparse->together, sparse->count, &s->tile, k);
        sparse->pixel[sparse->count++] = (uint16_t)(part * LMB_TILE_PIXELS + k);
    }
    return status;
}

lmb_status lmb_render_block(const lmb_render *r, lmb_band_scratch *s, const lmb_target *target, int32_t x, int32_t y,
                            int32_t tiles)
{
    const lmb_frame *f = &r->frame;
    lmb_sparse *sparse = &s->sparse;
    lmb_status status = LMB_OK;
    memset(sparse, 0, sizeof *sparse);
    for (int pass = 0; pass < 2 && status == LMB_OK; ++pass) {
        for (int32_t part = 0; part < tiles && status == LMB_OK; ++part) {
            uint64_t pixels;
            status = lmb_resolve_tile(&s->tile, f->kernels, &f->view, f->scene, target, x + part * LMB_TILE, y);
            if (status != LMB_OK) {
                return status;
            }
            lmb_render_onto_triangles(&s->tile, f);
            if (requires_glossy(r) && lmb_glossy_tile(&s->glossy, &s->tile, &f->view, f->scene)) {
                continue;
            }
            pixels = lmb_sparse_pixels(&s->tile, f->gather_step);
            if (pass > 0) {
                pixels = lmb_upsample_tile(&sparse->light[part], &s->tile, pixels, f->gather_step);
            }
            status = put_together(r, s, part, pixels);
        }
        status = status == LMB_OK ? gather_together(r, s) : status;
    }
    return status;
}
