/* raster.h: triangles -> depth + id (a visibility buffer), then attributes of one tile at a time.
 *
 * A draw fills a *window* of a frame: a target's origin (x0, y0) says where in the frame its first pixel lies. A frame
 * drawn in any set of windows has the bytes of the frame drawn whole.
 *
 * Stability: stable. */
#ifndef LMB_RASTER_H
#define LMB_RASTER_H

#include "scene.h"
#include "surface.h"

/* One backend's kernels (plain C, SSE2, AVX2, NEON ...): functions that compute the same bytes on every backend.
 * src/isa defines them, the caller hands them in. */
typedef struct lmb_kernels lmb_kernels;

/* Where draws go. `id` is optional (data NULL): a depth-only map costs no ids. Both surfaces have the same size. */
typedef struct lmb_target {
    lmb_surface depth; /* LMB_DEPTH32F or LMB_DEPTH16, tiled or linear */
    lmb_surface id;    /* LMB_ID16 or LMB_ID32, or data NULL */
    int32_t x0, y0;    /* px in the frame, multiples of LMB_TILE, >= 0 */
} lmb_target;

/* Attributes of 8x8 pixels, planar: kernels read whole vectors of them. Pixel k is (k % 8, k / 8). 4 KiB, and 3.2 KiB
 * of scratch (1.1 in the tiny configuration). */
typedef struct lmb_tile {
    float position[3][LMB_TILE_PIXELS]; /* world, m: on the plane of the pixel's own triangle */
    float face[3][LMB_TILE_PIXELS];     /* unit normal of the triangle, turned to the viewer */
    float normal[3][LMB_TILE_PIXELS];   /* unit shading normal, on the same side as `face` */
    float albedo[3][LMB_TILE_PIXELS];
    float depth[LMB_TILE_PIXELS]; /* along the view's axis, m; 0: nothing */
    float uv[2][LMB_TILE_PIXELS];
    uint32_t id[LMB_TILE_PIXELS]; /* 0: nothing; then every plane holds 0 */
    int32_t x, y;                 /* px in the frame of pixel 0 */
    int32_t hits;                 /* pixels with a surface */
    union { /* scratch of src/raster; its contents are private and mean nothing between calls */
        const void *align;
        unsigned char bytes[368 + 3 * sizeof(void *) + 180 * LMB_SLOTS];
    } work;
} lmb_tile;

enum { LMB_CULL_BACK = 1, /* drop back faces of single-sided materials (cameras); lights see both sides */
       LMB_BLEND = 2      /* LMB_ALPHA_BLEND shows by sample (cameras); lights see it by alpha_cutoff */ };

#if LMB_CULLING
enum { LMB_CLUSTER = 64 /* triangles of a cluster; the last one of a mesh may have fewer */ };

/* A box around triangles that follow each other in a mesh, m in model space. */
typedef struct lmb_cluster {
    lmb_vec3 low, high;
} lmb_cluster;

/* What tells lmb_draw_culled that something is hidden. Each array is optional (NULL).
 *
 * A tile's bound is at most every depth in it, in the depth surface's own values: set all to 0 where the surface is
 * cleared. Draws by others, which leave nearer depths, may come between; where depths are set back, so must be bounds.
 * Bounds belong to one window. */
typedef struct lmb_culling {
    float *farthest; /* by tile, row by row: lmb_culling_tiles of them */
    const lmb_cluster *clusters; /* of the scene's meshes: lmb_clusters_build */
    uint32_t tiles, cluster_count; /* how many there are, at least as many as are needed */
} lmb_culling;
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_kernels_pick: the best backend of this build that this processor runs. Never NULL.
 * lmb_kernels_at: all of them, i from 0, the best first and "scalar" last; NULL past the last and for i < 0.
 * lmb_kernels_named: "scalar", "sse2", "avx2", "avx512", "neon" or "simd128"; NULL where the build, the processor or
 * the system lacks it.
 * lmb_kernels_name: that name. */
const lmb_kernels *lmb_kernels_pick(void);
const lmb_kernels *lmb_kernels_at(int32_t i);
const lmb_kernels *lmb_kernels_named(const char *name);
const char *lmb_kernels_name(const lmb_kernels *kernels);

/* lmb_draw: draw triangles with ids first_id .. first_id + count - 1 into a window.
 *
 *   target   cleared or drawn before; depth keeps the nearer surface, equal depth keeps the earlier draw.
 *   view     the frame's camera or light face.
 *   scene    checked by lmb_scene_check. ids past its end are ignored.
 *   first_id at least 1: id 0 is nothing.
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
/* lmb_draw_culled: lmb_draw without what bounds show to be hidden: the same pixels, and ids, to the byte.
 *
 *   culling  `farthest` is read and raised. Backends of under eight lanes ask it for whole clusters and for nothing else;
 *            the others also ask for each tile of small triangles, while clusters are found hidden.
 * Returns what lmb_draw does; LMB_ERR_ARG also where culling is NULL, LMB_ERR_CAPACITY where one of its arrays is too
 * short. Triangles of a cluster that is left out count as drawn nowhere; one with a triangle that would be dropped is
 * never left out.
 * Stack: as lmb_draw. Cost: a test for each cluster, and one for each tile that is asked for. It pays where much is
 * hidden; where nothing is, it takes 1 to 7 % longer. */
lmb_status lmb_draw_culled(const lmb_target *target, const lmb_kernels *kernels, const lmb_view *view,
                           const lmb_scene *scene, uint32_t first_id, uint32_t count, uint32_t flags,
                           const lmb_culling *culling, lmb_stats *stats);

/* lmb_culling_tiles: floats of a window's bounds, some more than it has tiles, as they are read and written by
 * vectors, so that windows share none of them; 0 for a target that nothing can be drawn into.
 * lmb_culling_clusters: clusters of all of a scene's meshes. */
uint32_t lmb_culling_tiles(const lmb_target *target);
uint32_t lmb_culling_clusters(const lmb_scene *scene);

/* lmb_clusters_build: the clusters of a scene's meshes, in the meshes' order: of each one a box around every
 * LMB_CLUSTER triangles. They hold while positions and indices do; instances may move.
 *
 *   scene  checked by lmb_scene_check.
 * Returns LMB_OK; LMB_ERR_ARG (null) or LMB_ERR_CAPACITY (count under lmb_culling_clusters), and then `out` is
 * untouched. Cost: each triangle's corners are read once. */
lmb_status lmb_clusters_build(lmb_cluster *out, uint32_t count, const lmb_scene *scene);
#endif

/* lmb_resolve_tile: attributes of the tile whose first pixel is (x, y) of the frame.
 *
 *   target  holds the tile, with ids.
 * Returns LMB_OK or LMB_ERR_ARG (null, no ids, tile outside the window or not on tiles): `out` is then untouched.
 * Stack: 0.9 to 2.3 KiB, by backend: the triangles lie in `out`. Cost: 64 pixels, and the set-up of the triangles that
 * they show, sixteen at a time. */
lmb_status lmb_resolve_tile(lmb_tile *out, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                            const lmb_target *target, int32_t x, int32_t y);

/* lmb_resolve_albedo: the same for pictures without light: only id, x, y, hits, uv and albedo are set, the other planes
 * mean nothing. LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_resolve_albedo(lmb_tile *out, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                              const lmb_target *target, int32_t x, int32_t y);

#ifdef __cplusplus
}
#endif
#endif
