/* plan_look.h: places of a frame: tiles side by side that are looked at together. Floor 8. */
#ifndef LMB_PLAN_LOOK_H
#define LMB_PLAN_LOOK_H

#include <lambent/plan.h>

/* May a frame be looked at? NULL: no. */
int lmb_can_look(const lmb_render *r);

/* Of a tile's pixels, those with a surface. */
uint64_t lmb_shown(const lmb_tile *tile);

/* Up to LMB_SPARSE_TILES tiles from frame pixel (x, y) on: their light to scratch->sparse.light, which of their pixels
 * have a surface (0 past the frame's right end), and added to scratch->counts what that took. */
lmb_status lmb_render_place(uint64_t *shown, const lmb_render *r, lmb_band_scratch *scratch, int32_t x, int32_t y,
                            int32_t tiles);

#endif
