/* occlusion.h: occlusion between two points, by the viewer's depth map, or exactly by a BVH. [V25]
 *
 * The viewer's depth map (lmb_occluder) holds only visible surfaces; lmb_bvh holds every triangle. A tile's pixels are
 * tested together: their 64 segments to one point make a thin pyramid, so one traversal serves them all.
 *
 * Stability: experimental. Tags like [V25] are requirements in src/SOURCES.md. */
#ifndef LMB_OCCLUSION_H
#define LMB_OCCLUSION_H

#include "raster.h"

/* Occlusion by the viewer's depth map: a segment from an emitter to a pixel is blocked if it crosses a visible surface
 * [V25]. */
typedef struct lmb_occluder {
    const lmb_view *view;     /* the viewer's */
    const lmb_surface *depth; /* depth of that view over the whole frame [V24] */
    int32_t kind;             /* LMB_OCCLUSION_* */
    int32_t steps;            /* samples along a segment, 1 .. 64 */
} lmb_occluder;
/* NONE: no occlusion. VIEW: the segment marches through the depth map in map space. VIEW_WORLD: in equal steps of world
 * space [V26]. A crossing is a change of side on a continuous surface. A segment that passes behind a silhouette and
 * comes out again is blocked if it came nearer to the surface that hid it than half its hidden length: objects are
 * assumed to be about as deep as they are wide. Both only know visible occluders: surfaces off screen or hidden do not
 * block (a wall seen edge-on is the worst case). */
enum { LMB_OCCLUSION_NONE = 0, LMB_OCCLUSION_VIEW = 1, LMB_OCCLUSION_VIEW_WORLD = 2,
       LMB_OCCLUSION_EXACT = 3 /* lmb_render with LMB_GROUP_CUT: all of the scene, by the BVH */ };

/* A triangle in the world. 52 bytes. */
typedef struct lmb_bvh_triangle {
    lmb_vec3 corner[3], normal; /* m; unit */
    uint32_t id;                /* the scene's; LMB_BVH_MASKED if it may have holes */
} lmb_bvh_triangle;
#define LMB_BVH_MASKED 0x80000000u

#define LMB_BOXES 16

/* Sixteen boxes, m, a little wider than their contents. count > 0: the triangles first .. first + count - 1; 0: the
 * sixteen boxes of node `first`. Unused boxes are empty: low > high. 512 bytes. */
typedef struct lmb_boxes {
    float low[3][LMB_BOXES], high[3][LMB_BOXES];
    uint32_t first[LMB_BOXES], count[LMB_BOXES];
} lmb_boxes;

/* Planes with all of a scene in front of them: a convex room, in which no surface blocks any segment. count 0: the
 * scene is no such room, or has more planes. */
typedef struct lmb_hull {
    int32_t count;
    lmb_vec3 middle;
    float reach, slack; /* m: the farthest corner from `middle`; largest distance behind a plane that rounding may
                           cause */
    lmb_vec3 normal[LMB_HULL_PLANES], at[LMB_HULL_PLANES];
} lmb_hull;

/* A small node: a box, and what is in it. count > 0: the triangles small_id[first] .. [first + count - 1]; 0: the next
 * node and node `first`. 16 bytes. */
typedef struct lmb_small_node {
    uint16_t low[3], high[3]; /* steps of a grid over the scene */
    uint16_t first, count;
} lmb_small_node;

/* The BVH, in your memory. node[0] is the root; node_count 0: nothing blocks. `small`, if not NULL, replaces `node` and
 * `triangle`. */
typedef struct lmb_bvh {
    lmb_bvh_triangle *triangle;
    lmb_boxes *node;
    uint32_t triangle_cap, triangle_count, node_cap, node_count;
    float noise; /* m: lower bound of the rounding that tests allow for: 0, but more in a convex room */
    float margin; /* m: tests widen no triangle by more than this */
    const lmb_scene *scene; /* for the holes of masked triangles */
    lmb_hull hull;
    lmb_small_node *small; /* depth first; small[0] is the root */
    uint16_t *small_id;    /* the scene's ids of the triangles */
    uint32_t small_count;  /* nodes */
    float small_low[3], small_step[3]; /* m: the grid */
} lmb_bvh;

/* A tile's segments from a point, for box tests: 1 / (pixel - at) along each axis, clamped to 1e20 if that is 0. */
typedef struct lmb_segments {
    lmb_vec3 at;
    float per[3][LMB_TILE_PIXELS];
} lmb_segments;

/* Test budget of a bounded tile: the tests it starts with, and those that each call adds, once and for each of its
 * pixels. So the many small calls of a tile with a different triangle at every pixel add about as much as few large
 * ones. On top of 2^20 tests, ordinary scenes need up to 32 for each pixel of their calls at default quality, and 34 at
 * best; 2,000 needles through one point need 66. When no tests are left, a call adds none, and uses
 * LMB_TRAVERSAL_COARSE at most. */
#define LMB_TRAVERSAL_FIRST  1048576
#define LMB_TRAVERSAL_EACH   48
#define LMB_TRAVERSAL_COARSE 64

/* The same for rays to points at infinity, counted apart. If a tile starts with 2^17 tests, dense lawns and bushes are
 * coarser. */
#define LMB_TRAVERSAL_SUN_FIRST 1048576
#define LMB_TRAVERSAL_SUN_EACH  64

/* State of traversals, one for each thread. It remembers the triangles that blocked most recently, because they often
 * block the next segments too. Initialize it to 0. */
enum { LMB_LAST_OCCLUDERS = 4 };
typedef struct lmb_traversal {
    uint32_t last[LMB_LAST_OCCLUDERS]; /* index in lmb_bvh + 1, the latest first; 0: none */
    uint32_t asked;                    /* nodes and leaves tested so far: the cost of traversals; wraps */
    uint32_t first;                    /* yours: a triangle to test first, as in `last` */
    uint32_t blocker;                  /* the triangle that blocked a pixel last, as in `last` */
    uint32_t alone;                    /* number of further tiles with segments that are traced one by one */
    uint32_t spent;                    /* tests so far: of nodes, leaves, triangles, and of pixels against holes;
                                          wraps */
    uint32_t end;                      /* value of `spent` at which this call ends */
    int32_t bounded;                   /* 1: `left` limits the tests; 0: no limit */
    int32_t left;                      /* tests left to this tile: each call adds some */
    uint32_t coarse;                   /* calls with a coarse answer, because too few tests were left */
    int32_t sun_spent;                 /* tests of rays to points at infinity, minus those that calls added */
    uint64_t sun_asked, sun_dark;      /* pixels of the last such call that was traced, and the occluded ones */
    int32_t eye_kind;                  /* LMB_EYE_*: kind of `eye` */
    lmb_vec3 eye;                      /* position of the eye that sees the pixels, or direction towards it */
    lmb_segments segments;
} lmb_traversal;
/* If the eye is known, a pixel within rounding of a triangle's plane counts as on the eye's side of the plane. The
 * triangle is widened by rounding, within the boxes. So no light from behind a wall reaches pixels on its edge. */
enum { LMB_EYE_NONE = 0, LMB_EYE_PLACE = 1, LMB_EYE_FAR = 2 };

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_bvh_bytes: memory for n triangles; 0 if that is impossible. 116 bytes each and 4 KiB. */
size_t lmb_bvh_bytes(uint32_t n);

/* lmb_bvh_init: lay out a BVH in `memory`. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY (bytes). */
lmb_status lmb_bvh_init(lmb_bvh *out, uint32_t n, void *memory, size_t bytes);

/* lmb_bvh_small_bytes: memory for n <= 65,535 triangles with small nodes; 0 for other numbers. 10 bytes each and 2 KiB.
 * lmb_bvh_small_init: lay out such a BVH. Frames of LMB_GATHER_LIVE and lmb_live_receive take it; other calls find
 * nothing that blocks. Bounced light is that of large nodes in scenes up to 1 km from the origin. Frames do not trace
 * lit pixels that shadow maps leave unsure, so sealed rooms may show lit pixels. lmb_bvh_build takes an eighth of the
 * instructions. With many lanes segments are slower, because triangles are read from the scene. Returns LMB_OK,
 * LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY (bytes). Both are missing in builds without live.h. */
size_t lmb_bvh_small_bytes(uint32_t n);
lmb_status lmb_bvh_small_init(lmb_bvh *out, uint32_t n, void *memory, size_t bytes);

/* lmb_bvh_build: build the BVH over all triangles of a checked scene, by the surface-area heuristic in 16 bins; the
 * same tree on every target.
 *
 * Triangles that lmb_draw would drop, and those without area, are left out. If nodes run out, as with thousands of
 * clumps of five to eight triangles on a grid, the remaining triangles lie in large boxes: up to twice as slow, with
 * the same answers. Returns LMB_OK, LMB_ERR_ARG, or LMB_ERR_CAPACITY if the scene has more triangles than there is room
 * for: then nothing blocks.
 * Cost: about 0.3 us a triangle. Stack: under 4 KiB. */
lmb_status lmb_bvh_build(lmb_bvh *inout, const lmb_scene *scene);

/* lmb_occluded_tile: the pixels of a tile that do not see a point, a bit each.
 *
 *   traversal  the `last` triangles are tested first, and updated; use it with this BVH only. The answer does not
 *              depend on them.
 *   pixels     those to test, a bit each; bits of others are 0 in the result. They need a position.
 *   at         the point: on a surface, or a light's position.
 *   noise      m: lmb_tile_noise of the pixels plus lmb_place_noise of `at`: how far rounding may have moved the two
 *              ends off their surfaces.
 *
 * A triangle blocks if the segment crosses it with both ends farther from its plane than `noise` and than a millionth
 * of the corners' distance from `at`. So no triangle blocks its own points, there is no bias to tune, and distant
 * triangles do not change results here. Triangles that share an edge leave no gap. The segments' own tests decide; the
 * traversal only skips boxes that no segment can hit. NULL: nothing blocks. Cost: 0.1 to 1 us.                    [V25]
 *
 * If the traversal is bounded and no tests are left, the answer is coarser, to the end of the tile: the middle one of
 * `pixels` answers for all, after at most LMB_TRAVERSAL_COARSE tests. A call that begins with tests left ends at most
 * LMB_TRAVERSAL_FIRST tests past them; pixels that nothing blocked by then count as visible. So n calls for m pixels
 * take at most about 2 FIRST + (n + m) EACH + n COARSE tests in any scene, usually far fewer, and the same ones on
 * every target. To bound a tile, set `bounded` to 1, `left` to LMB_TRAVERSAL_FIRST, and all else to 0. */
uint64_t lmb_occluded_tile(const lmb_kernels *kernels, lmb_traversal *traversal, const lmb_bvh *bvh,
                           const lmb_tile *tile, uint64_t pixels, lmb_vec3 at, float noise);

/* lmb_occluded_again: the same answer, for calls with points that lie close together and pixels that lie far apart:
 * tests for pixel k first the triangle that blocked it last.
 *
 *   own  of pixel k: that triangle, as in lmb_traversal; updated. Begin with zeros, for this BVH. NULL: as
 *        lmb_occluded_tile. */
uint64_t lmb_occluded_again(const lmb_kernels *kernels, lmb_traversal *traversal, uint32_t own[LMB_TILE_PIXELS],
                            const lmb_bvh *bvh, const lmb_tile *tile, uint64_t pixels, lmb_vec3 at, float noise);

/* lmb_place_noise: how far, m, rounding may have moved a point off its surface, if a ray from `distance` m away found
 * it: a millionth of the distance plus a quarter of a millionth of the largest coordinate. distance 0: the mean of a
 * triangle's corners.
 * lmb_tile_noise: the maximum over a tile's `pixels`, by their depth. */
float lmb_place_noise(lmb_vec3 at, float distance);
float lmb_tile_noise(const lmb_tile *tile, uint64_t pixels);

/* lmb_occluded_sun: the pixels of a tile that do not see a point at infinity; `to`: unit, towards it. Like
 * lmb_occluded_tile, but a triangle blocks if the ray crosses it, and the pixel is farther off its plane than rounding
 * may cause, given the pixel's position and depth, and the distance of the triangle's corners.
 *
 * A bounded traversal has LMB_TRAVERSAL_SUN_FIRST tests for such rays, and each call adds LMB_TRAVERSAL_SUN_EACH, once
 * and for each of its pixels. While none are left, a call traces no ray and repeats the answers of the last call that
 * traced rays. A pixel that was not traced there gets the answer of the next pixel that was. Ask similar directions one
 * after another. */
uint64_t lmb_occluded_sun(const lmb_kernels *kernels, lmb_traversal *traversal, const lmb_bvh *bvh,
                          const lmb_tile *tile, uint64_t pixels, lmb_vec3 to);

/* lmb_hull_find: find the hull of a checked scene in which all triangles lie on planes of the hull and face inwards;
 * else out->count is 0. lmb_bvh_build calls it too. Cost: four passes over the triangles, but the search stops at more
 * than LMB_HULL_PLANES different normals.
 * lmb_hull_holds: 1 if a point is inside the hull; 0 also if there is no hull.
 * lmb_hull_pixels: those of a tile's `pixels` that are inside. Between two such points lmb_occluded_tile never finds an
 * occluder, bit for bit: src/occlusion/hull.c has the proof. */
void lmb_hull_find(lmb_hull *out, const lmb_scene *scene);
int lmb_hull_holds(const lmb_hull *hull, lmb_vec3 at);
uint64_t lmb_hull_pixels(const lmb_hull *hull, const lmb_tile *tile, uint64_t pixels);

#ifdef __cplusplus
}
#endif
#endif
