/* sparse.h: bounced light of a tile, or of a block of tiles side by side from some of their pixels. Floor 8. */
#ifndef LMB_PLAN_SPARSE_H
#define LMB_PLAN_SPARSE_H

#include <lambent/render.h>

/* Add the bounced light of a tile's pixels. LMB_OK, or what the gather returns. */
lmb_status lmb_render_gather(lmb_irradiance *inout, const lmb_render *render, lmb_band_scratch *scratch,
                             const lmb_tile *tile);

/* Set scratch->sparse.light[0 .. tiles - 1]: that of the tiles from frame pixel (x, y) on. render->frame.gather_step is 2 or 4.
 * scratch->tile is written. */
lmb_status lmb_render_block(const lmb_render *render, lmb_band_scratch *scratch, const lmb_target *target, int32_t x,
                            int32_t y, int32_t tiles);

#endif
