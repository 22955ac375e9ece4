/* raster.h: triangles -> depth + id (a visibility buffer), then attributes of one tile at a time.
 *
 * A draw fills a *window* of a frame: a target's origin (x0, y0) is the position of its first pixel in the frame. A
 * frame drawn in any set of windows has the bytes of the frame drawn whole.
 *
 * Stability: stable. */
#ifndef LMB_RASTER_H
#define LMB_RASTER_H

#include "scene.h"
#include "surface.h"

/* One backend's kernels (plain C, SSE2, AVX2, NEON ...): functions that compute the same bytes on every backend.
 * src/isa defines them; you pass them to calls. */
typedef struct lmb_kernels lmb_kernels;

/* The target of draws. `id` is optional (data NULL): a depth-only map needs no ids. Both surfaces have the same
 * size. */
typedef struct lmb_target {
    lmb_surface depth; /* LMB_DEPTH32F or LMB_DEPTH16, tiled or linear */
    lmb_surface id;    /* LMB_ID16 or LMB_ID32, or data NULL */
    int32_t x0, y0;    /* position in the frame, px: multiples of LMB_TILE, >= 0 */
} lmb_target;

/* Attributes of 8x8 pixels, planar: kernels read whole vectors. Pixel k is (k % 8, k / 8). 4 KiB, and 3.2 KiB of
 * scratch (1.1 in the tiny configuration). */
typedef struct lmb_tile {
    float position[3][LMB_TILE_PIXELS]; /* world, m: on the plane of the pixel's own triangle */
    float face[3][LMB_TILE_PIXELS];     /* unit normal of the triangle, facing the viewer */
    float normal[3][LMB_TILE_PIXELS];   /* unit shading normal, on the same side as `face` */
    float albedo[3][LMB_TILE_PIXELS];
    float depth[LMB_TILE_PIXELS]; /* along the view's axis, m; 0: nothing */
    float uv[2][LMB_TILE_PIXELS];
    uint32_t id[LMB_TILE_PIXELS]; /* 0: nothing; all planes are then 0 */
    int32_t x, y;                 /* position of pixel 0 in the frame, px */
    int32_t hits;                 /* pixels with a surface */
    union { /* scratch, private to src/raster; undefined between calls */
        const void *align;
        unsigned char bytes[368 + 3 * sizeof(void *) + 180 * LMB_SLOTS];
    } work;
} lmb_tile;

enum { LMB_CULL_BACK = 1, /* drop back faces of single-sided materials (cameras); lights see both sides */
       LMB_BLEND = 2      /* LMB_ALPHA_BLEND by samples (cameras); for lights, alpha_cutoff applies */ };

#if LMB_CULLING
enum { LMB_CLUSTER = 64 /* triangles of a cluster; the last one of a mesh may have fewer */ };

/* A box around consecutive triangles of a mesh, m in model space. */
typedef struct lmb_cluster {
    lmb_vec3 low, high;
} lmb_cluster;

/* Bounds by which lmb_draw_culled finds hidden triangles. Each array is optional (NULL).
 *
 * A tile's bound is at most every depth in it, in the depth surface's own values. Set all bounds to 0 when you clear
 * the surface. Other draws, which leave nearer depths, may come between; if you reset depths, reset the bounds too.
 * Bounds belong to one window. */
typedef struct lmb_culling {
    float *farthest; /* lmb_culling_tiles bounds, by tile, row by row */
    const lmb_cluster *clusters; /* of the scene's meshes: lmb_clusters_build */
    uint32_t tiles, cluster_count; /* lengths of the arrays, at least as many as are needed */
} lmb_culling;
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_kernels_pick: the best backend of this build that this processor runs. Never NULL.
 * lmb_kernels_at: backend i, from 0, the best first and "scalar" last; NULL past the last and for i < 0.
 * lmb_kernels_named: "scalar", "sse2", "avx2", "avx512", "neon" or "simd128"; NULL if the build, the processor or the
 * system lacks it.
 * lmb_kernels_name: that name.
 * lmb_kernels_built: the name of backend i of this build, the best first, whether or not this processor runs it; NULL
 * past the last and for i < 0. */
const lmb_kernels *lmb_kernels_pick(void);
const lmb_kernels *lmb_kernels_at(int32_t i);
const lmb_kernels *lmb_kernels_named(const char *name);
const char *lmb_kernels_name(const lmb_kernels *kernels);
const char *lmb_kernels_built(int32_t i);

/* lmb_draw: draw triangles with ids first_id .. first_id + count - 1 into a window.
 *
 *   target   cleared or drawn before; depth keeps the nearer surface, equal depth keeps the earlier draw.
 *   view     the frame's camera or light face.
 *   scene    checked by lmb_scene_check. ids past the end are ignored.
 *   first_id at least 1: id 0 means no triangle.
 *   flags    LMB_CULL_BACK, LMB_BLEND, both or 0.
 *   stats    counts triangles; may be NULL.
 *
 * Returns LMB_OK, LMB_ERR_ARG (null, id 0, window outside the frame or not on tiles, bad view or stride) or
 * LMB_ERR_FORMAT, and then nothing was drawn; LMB_ERR_CAPACITY if ids do not fit an LMB_ID16 surface.
 * Triangles with a non-finite vertex, a vertex over 2^20 m away, or an index outside the mesh are dropped and counted.
 * Coverage: pixel centres, top-left rule, vertices snapped to 1/256 px: exact integers, no crack, no overlap.
 * Stack: 2.5 to 3.8 KiB, by backend; 1.9 in the tiny configuration. Cost: vertices + covered tiles. Draws into
 * different targets may run at once. */
lmb_status lmb_draw(const lmb_target *target, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                    uint32_t first_id, uint32_t count, uint32_t flags, lmb_stats *stats);

#if LMB_CULLING
/* lmb_draw_culled: lmb_draw without triangles that are hidden by the bounds: the same pixels, and ids, to the byte.
 *
 *   clear    1: first reset depths, ids and bounds of the window.
 *   culling  `farthest` is read and raised. Backends of under eight lanes test only whole clusters; the others also
 *            test each tile of small triangles, while clusters are found hidden. May be NULL.
 * Returns LMB_OK or an error as lmb_draw; LMB_ERR_CAPACITY also if one of the culling's arrays is too short. After an
 * error nothing was reset or drawn. Triangles of a culled cluster are not counted as drawn; a cluster with a triangle
 * that would be dropped is never culled.
 * Stack: as lmb_draw. Cost: a test for each cluster, and for each tile that is tested. Culling pays if much is hidden;
 * if nothing is, a draw takes 1 to 7 % longer. */
lmb_status lmb_draw_culled(const lmb_target *target, const lmb_kernels *kernels, const lmb_view *view,
                           const lmb_scene *scene, uint32_t first_id, uint32_t count, uint32_t flags, int32_t clear,
                           const lmb_culling *culling, lmb_stats *stats);

/* lmb_culling_tiles: floats of a window's bounds: more than it has tiles, because they are read and written in vectors,
 * and windows must share none; 0 for a target that cannot be drawn into.
 * lmb_culling_clusters: clusters of all of a scene's meshes. */
uint32_t lmb_culling_tiles(const lmb_target *target);
uint32_t lmb_culling_clusters(const lmb_scene *scene);

/* lmb_clusters_build: the clusters of a scene's meshes, in the meshes' order: a box around every LMB_CLUSTER triangles.
 * They are valid while positions and indices do not change; instances may move.
 *
 *   scene  checked by lmb_scene_check.
 * Returns LMB_OK; LMB_ERR_ARG (null) or LMB_ERR_CAPACITY (count under lmb_culling_clusters), and then `out` is
 * unchanged. Cost: each triangle's corners are read once. */
lmb_status lmb_clusters_build(lmb_cluster *out, uint32_t count, const lmb_scene *scene);
#endif

/* lmb_resolve_tile: attributes of the tile with its first pixel at (x, y) of the frame.
 *
 *   target  holds the tile, with ids.
 * Returns LMB_OK or LMB_ERR_ARG (null, no ids, tile outside the window or not on tiles): then `out` is unchanged.
 * Stack: 0.9 to 2.3 KiB, by backend: the triangles are stored in `out`. Cost: 64 pixels, and the set-up of the
 * triangles that they show, sixteen at a time. */
lmb_status lmb_resolve_tile(lmb_tile *out, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                            const lmb_target *target, int32_t x, int32_t y);

/* lmb_resolve_albedo: the same for pictures without light: only id, x, y, hits, uv and albedo are set, the other planes
 * are undefined. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_resolve_albedo(lmb_tile *out, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                              const lmb_target *target, int32_t x, int32_t y);

#ifdef __cplusplus
}
#endif
#endif
