/* bins.h: triangles that are set up once for a frame, sorted into bins by rows of pixels, and drawn from the bins.
 *
 * Several threads set up ranges of a scene's triangles side by side; then each draws windows of its own, and no
 * triangle is fetched or set up again. One thread gains if a surface is larger than the second-level cache, because
 * each bin's rows stay in the cache while they are cleared and drawn. One thread also gains if many back faces are
 * culled, because the remaining triangles are drawn in full vectors.
 *
 * Stability: experimental. */
#ifndef LMB_BINS_H
#define LMB_BINS_H

#include "raster.h"

#if LMB_CULLING
/* A range of a scene's triangles in a view. It refers to the scene: do not change the scene while you use the bins. */
typedef struct lmb_bins {
    void *memory; /* yours; of any alignment */
    size_t bytes; /* any number: triangles that do not fit are set up again by each draw */
    const lmb_scene *scene; /* this and the following members are set by lmb_bins_build */
    lmb_view view;
    uint32_t first_id, past_id; /* triangles that are set up: first_id .. past_id - 1 */
    uint32_t end_id;            /* triangles that did not fit: past_id .. end_id - 1 */
    uint32_t flags;
} lmb_bins;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_bins_rows: rows of pixels in a bin of a view's frame, a multiple of LMB_TILE; 0 for a bad view. Windows that
 * share no bin set up no edge twice.
 * lmb_bins_bytes: memory for `triangles` if each lies in two bins; most lie in one. 64 bytes each, and some for the
 * bins. 0 for a bad view, and for more than size_t holds. */
int32_t lmb_bins_rows(const lmb_view *view);
size_t lmb_bins_bytes(const lmb_view *view, uint32_t triangles);

/* lmb_bins_build: set up triangles with ids first_id .. first_id + count - 1, and store those that the frame may show.
 *
 *   bins      set `memory` and `bytes`; the rest is overwritten. A triangle takes 32 bytes in each bin that it lies in;
 *             up to 64 if it is large or has holes, and for each part that remains after clipping at the near plane or
 *             the guard band.
 *   view, scene, first_id, count, flags  as for lmb_draw.
 *   culling   `clusters` outside the frame are left out; may be NULL.
 *   stats     counts triangles as lmb_draw does, also those that did not fit; may be NULL.
 *
 * Returns LMB_OK, also if not all fit; LMB_ERR_ARG (null, id 0, bad view) or LMB_ERR_CAPACITY (too few clusters), and
 * then nothing was set up. Stack: 2.4 to 3.8 KiB, by backend. Cost: vertices. Builds may run at once, each with its own
 * bins. */
lmb_status lmb_bins_build(lmb_bins *bins, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                          uint32_t first_id, uint32_t count, uint32_t flags, const lmb_culling *culling,
                          lmb_stats *stats);

/* lmb_bins_draw: draw bins into a window: the bytes are those of lmb_draw with the same triangles, on every backend.
 *
 *   target   a window of the bins' frame.
 *   bins     `count` of them, of one view, as they were built: their order is the order of draws.
 *   clear    1: first reset depths, ids and bounds of the window, each bin's just before it is drawn.
 *   culling  bounds are read and raised as by lmb_draw_culled; may be NULL.
 *
 * Returns LMB_OK or an error as lmb_draw; LMB_ERR_ARG also if bins are of different frames or count < 1;
 * LMB_ERR_CAPACITY if the culling's arrays are too short, even if everything was set up. Stack: as lmb_draw. Cost:
 * edges of the triangles in the window's bins, and covered tiles. Draws into different windows may run at once. */
lmb_status lmb_bins_draw(const lmb_target *target, const lmb_kernels *kernels, const lmb_bins *bins, int32_t count,
                         int32_t clear, const lmb_culling *culling);

#ifdef __cplusplus
}
#endif
#endif
#endif
