/* plan_sample.h: samples of a frame's tiles, taken in groups. Layer 8. */
#ifndef LMB_PLAN_SAMPLE_H
#define LMB_PLAN_SAMPLE_H

#include <lambent/plan.h>

#include <string.h>

#include "stages.h"

/* Estimates pairs and segments of the whole frame from `facts`, for a frame's settings. */
void lmb_facts_count(double *pairs, double *segments, const lmb_facts *facts, const lmb_frame *frame);

/* Can you sample this frame? Not if r is NULL. */
int lmb_can_sample(const lmb_render *r);

/* Mask of a tile's pixels with a surface. */
uint64_t lmb_shown(const lmb_tile *tile);

/* Resolves adjacent tiles from frame pixel (x, y) on and sets masks of their pixels with a surface. If every pixel is
 * gathered, also sets scratch->sparse.light, and adds the work to scratch->counts. */
lmb_status lmb_render_tiles(uint64_t *shown, const lmb_render *r, lmb_band_scratch *scratch, int32_t x, int32_t y,
                            int32_t tiles);

/* The same for any gather_step and up to LMB_SPARSE_TILES tiles; tiles past the frame's right end have empty masks.
 * Inline, because the gather of blocks already uses much stack. */
static inline lmb_status place_light(uint64_t *shown, const lmb_render *r, lmb_band_scratch *scratch, int32_t x,
                                     int32_t y, int32_t tiles)
{
    const lmb_frame *f = &r->frame;
    const int32_t left = (f->view.frame_width - x + LMB_TILE - 1) / LMB_TILE, here = tiles < left ? tiles : left;
    lmb_status status = f->gather_step > 1 ? lmb_render_block(r, scratch, &f->eye, x, y, here) : LMB_OK;
    memset(shown, 0, LMB_SPARSE_TILES * sizeof *shown);
    return status == LMB_OK ? lmb_render_tiles(shown, r, scratch, x, y, here) : status;
}

#endif
