/* plan_sample.h: tiles of a frame that are sampled together. Layer 11. */
#ifndef LMB_PLAN_SAMPLE_H
#define LMB_PLAN_SAMPLE_H

#include <lambent/plan.h>

#include <string.h>

#include "../frame/stages.h"

/* Pairs and segments of all the frame's pixels by `facts`, for a frame's settings. */
void lmb_facts_count(double *pairs, double *segments, const lmb_facts *facts, const lmb_frame *frame);

/* May a frame be looked at? NULL: no. */
int lmb_can_sample(const lmb_render *r);

/* Of a tile's pixels, those with a surface. */
uint64_t lmb_shown(const lmb_tile *tile);

/* Of tiles side by side from frame pixel (x, y) on: which of their pixels have a surface; where every pixel is
 * gathered, their light to scratch->sparse.light, and added to scratch->counts what that took. */
lmb_status lmb_render_tiles(uint64_t *shown, const lmb_render *r, lmb_band_scratch *scratch, int32_t x, int32_t y,
                            int32_t tiles);

/* The same by any gather_step, of up to LMB_SPARSE_TILES tiles: 0 are shown past the frame's right end. In the caller's
 * own frame: what gathers blocks is deep. */
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
