/* occlusion.h: what stands between two points: the scene's triangles in a tree of boxes, asked exactly. [V25, ours]
 *
 * The viewer's depth map knows only what the viewer sees; this knows every triangle. A tile of pixels asks at once: its
 * 64 segments to one point make a thin pyramid, one walk through the tree serves them all. */
#ifndef LMB_OCCLUSION_H
#define LMB_OCCLUSION_H

#include "raster.h"

/* A triangle in the world. 52 bytes. */
typedef struct lmb_blocker {
    lmb_vec3 corner[3], normal; /* m; unit */
    uint32_t id;                /* the scene's; LMB_BLOCKER_MASKED where it may have holes */
} lmb_blocker;
#define LMB_BLOCKER_MASKED 0x80000000u

#define LMB_BOXES 16

/* Sixteen boxes, m, wider than what they hold by the noise. count > 0: the triangles first .. first + count - 1; 0: the
 * sixteen of node `first`. Those past the last hold nothing: low > high. 512 bytes. */
typedef struct lmb_boxes {
    float low[3][LMB_BOXES], high[3][LMB_BOXES];
    uint32_t first[LMB_BOXES], count[LMB_BOXES];
} lmb_boxes;

/* The tree, in the caller's memory. node[0] is the root; node_count 0: nothing blocks. */
typedef struct lmb_blockers {
    lmb_blocker *triangle;
    lmb_boxes *node;
    uint32_t triangle_cap, triangle_count, node_cap, node_count;
    float noise; /* m: how far rounding may lift a point of a surface off its plane */
    const lmb_scene *scene; /* for the holes of masked triangles */
} lmb_blockers;

/* Triangles that blocked much when asked last: what blocks a segment often blocks the next. All 0 to begin with. */
enum { LMB_LAST_BLOCKERS = 4 };
typedef struct lmb_last_blockers {
    uint32_t triangle[LMB_LAST_BLOCKERS]; /* number in lmb_blockers + 1, the latest first; 0: none */
} lmb_last_blockers;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_blockers_bytes: memory for n triangles; 0 where that cannot be. 116 bytes each and 4 KiB. */
size_t lmb_blockers_bytes(uint32_t n);

/* lmb_blockers_init: share out `memory`. LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY (bytes). */
lmb_status lmb_blockers_init(lmb_blockers *out, uint32_t n, void *memory, size_t bytes);

/* lmb_blockers_build: the tree over all triangles of a checked scene, by the surface-area heuristic in 16 bins.
 *
 * Triangles that lmb_draw would drop, and those without area, are left out. Where nodes run out, as by thousands of
 * clumps of five to eight on a grid, the rest lies in large boxes: up to twice as slow, with the same answers. Returns
 * LMB_OK, LMB_ERR_ARG, or LMB_ERR_CAPACITY where the scene has more triangles than there is room for: then nothing
 * blocks.
 * Cost: about 0.5 us a triangle. Stack: under 3 KiB. */
lmb_status lmb_blockers_build(lmb_blockers *inout, const lmb_scene *scene);

/* lmb_blocked_tile: which of a tile's pixels do not see a point.
 *
 *   pixels  those that ask, a bit each; others' bits come back 0. They need a position.
 *   at      the point: on a surface, or a light's place.
 *   last    asked first, and kept up; for the same blockers only. NULL: none. The answer does not depend on it.
 *
 * A triangle blocks where the segment crosses it with both ends farther than `noise` from its plane: so none blocks
 * points of its own, and nothing is tuned. Triangles that share an edge leave no gap. The segments' own tests decide;
 * the walk only leaves out what none can meet. Null: nothing blocks. Cost: 0.1 to 1 us.                     [V25] */
uint64_t lmb_blocked_tile(const lmb_blockers *blockers, const lmb_kernels *kernels, const lmb_tile *tile,
                          uint64_t pixels, lmb_vec3 at, lmb_last_blockers *last);

#ifdef __cplusplus
}
#endif
#endif
