/* bins.h: triangles that are set up once for a frame, into bins by the rows of it that they lie in, and drawn from there.
 *
 * Several threads set up ranges of a scene's triangles side by side; then each draws windows of its own, and nothing is
 * fetched or set up again. One thread gains where a surface is larger than its second cache, as each bin's rows stay there
 * while they are cleared and drawn, and where many back faces are culled, as what is seen is drawn in full vectors.
 *
 * Stability: experimental. */
#ifndef LMB_BINS_H
#define LMB_BINS_H

#include "raster.h"

#if LMB_CULLING
/* A range of a scene's triangles as a view sees them. It refers to the scene, which is not to change meanwhile. */
typedef struct lmb_bins {
    void *memory; /* the caller's; of any alignment */
    size_t bytes; /* any number: what does not fit is set up anew by each draw */
    const lmb_scene *scene; /* this and what follows: set by lmb_bins_build */
    lmb_view view;
    uint32_t first_id, past_id; /* triangles that are set up: first_id .. past_id - 1 */
    uint32_t end_id;            /* and those that did not fit: past_id .. end_id - 1 */
    uint32_t flags;
} lmb_bins;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_bins_rows: rows of pixels of a view's frame that go into a bin, a multiple of LMB_TILE; 0 for a bad view. Windows that
 * share no bin set up no edge twice.
 * lmb_bins_bytes: memory for `triangles` of which each lies in two bins, as most lie in one: 64 bytes each, and some for
 * the bins. 0 for a bad view, and for more than size_t holds. */
int32_t lmb_bins_rows(const lmb_view *view);
size_t lmb_bins_bytes(const lmb_view *view, uint32_t triangles);

/* lmb_bins_build: set up triangles with ids first_id .. first_id + count - 1, and keep those that the frame may show.
 *
 *   bins      `memory` and `bytes` are set; the rest becomes what was set up. A triangle takes 32 bytes in each bin that
 *             it lies in; up to 64 if it is large or has holes, and for each part that the near plane or the guard band
 *             leaves of it.
 *   view, scene, first_id, count, flags  as lmb_draw's.
 *   culling   its `clusters` outside the frame are left out; may be NULL.
 *   stats     counts the triangles as lmb_draw does, those that did not fit too; may be NULL.
 *
 * Returns LMB_OK, also where not all fit; LMB_ERR_ARG (null, id 0, bad view) or LMB_ERR_CAPACITY (too few clusters), and
 * then nothing was set up. Stack: 2.4 to 3.8 KiB, by backend. Cost: vertices. Builds may run at once, each with bins of
 * its own. */
lmb_status lmb_bins_build(lmb_bins *bins, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                          uint32_t first_id, uint32_t count, uint32_t flags, const lmb_culling *culling,
                          lmb_stats *stats);

/* lmb_bins_draw: draw bins into a window: the bytes that lmb_draw leaves of the same triangles, by every backend.
 *
 *   target   a window of the bins' frame.
 *   bins     `count` of them, of one view, as they were built: their order is the order of draws.
 *   clear    1: depths, ids and bounds of the window are set back first, each bin's just before it is drawn.
 *   culling  its bounds are read and raised as lmb_draw_culled does; may be NULL.
 *
 * Returns what lmb_draw does; LMB_ERR_ARG also where bins are of different frames or count < 1; LMB_ERR_CAPACITY where the
 * culling's arrays are too short, though everything was set up. Stack: as lmb_draw. Cost: edges of what lies in the window's bins, and covered tiles.
 * Draws into different windows may run at once. */
lmb_status lmb_bins_draw(const lmb_target *target, const lmb_kernels *kernels, const lmb_bins *bins, int32_t count,
                         int32_t clear, const lmb_culling *culling);

#ifdef __cplusplus
}
#endif
#endif
#endif
