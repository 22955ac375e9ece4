/* voxel.h: a scene's surfaces and their light as a sparse octree, and cones that are traced through it.
 *                                                                                               [M6-M8 M11-M13 M20-M22]
 *     lmb_voxels_init(&v, cap, LMB_VOXELS_THREE, memory, bytes);    once
 *     lmb_voxels_build(&v, &low, &high, depth, parts, count);       when geometry changes
 *     lmb_voxels_inject(&v, field, texels, count);                 when light changes: first points of the shadow maps
 *     lmb_voxels_filter(&v, field);  lmb_voxels_delta(&v);
 *     lmb_cones_init(&cones, &v, 19);                               once a build
 *     per tile: lmb_cones_diffuse(..), lmb_cones_glossy(..)
 *
 * A voxel holds no colour and alpha, but sums over the surfaces in it, by the six directions that they face. So a
 * parent is exactly the mean of the children, and no light is lost on the way up. A thin wall lets no light through
 * from the back, and covers the same share of wide and narrow cones.
 *
 * Stability: experimental. Tags like [M6] are requirements in src/SOURCES.md. */
#ifndef LMB_VOXEL_H
#define LMB_VOXEL_H

#include "env.h"
#include "tree.h"

enum { LMB_VOXEL_WITHOUT = 0, LMB_VOXEL_WITH = 1, /* worlds: without and with the virtual object; and fields of light */
       LMB_VOXEL_DELTA = 2                        /* a field of light only: with - without [M11 M12] */ };
enum { LMB_VOXELS_ONE = 1,  /* world WITHOUT and its light */
       LMB_VOXELS_THREE = 3 /* both worlds, and three fields of light */ };
enum { LMB_VOXEL_MIN_DEPTH = 4, LMB_VOXEL_MAX_DEPTH = 10 }; /* leaves a side: 2^depth */

#define LMB_VOXEL_COVER 12 /* floats of a voxel's geometry: coverage by direction, +x -x +y -y +z -z 0 0; then x y z 0
                              of the normal of double-sided surfaces */
#define LMB_VOXEL_LIGHT 24 /* floats of a voxel's light: R G B 0 by direction, +x -x +y -y +z -z */

/* The octree, in your memory. Voxels 0 .. 7 are empty space; then follow all voxels of 1, 2^3, 4^3, 8^3 and 16^3 a
 * side, x first; then eight at a time (x + 2 y + 4 z) the children of voxels that have some. Areas are in units of a
 * leaf's face; the area of a voxel n leaves wide is the mean over its leaves: a wall through it has coverage 1 / n. */
typedef struct lmb_voxels {
    float *child;     /* of each voxel the first of eight, a whole number; 0: empty, or a leaf */
    float *cover[2];  /* LMB_VOXEL_COVER x cap, by world. Coverage: the area visible from that direction. For
                         double-sided surfaces: the larger of both sides; normal: the difference of both sides */
    float *light[3];  /* LMB_VOXEL_LIGHT x cap, by field: radiance x area visible from that direction, W/sr */
    uint32_t cap, count;
    int32_t worlds;   /* 1 or 2 */
    lmb_vec3 low;     /* m: the cube's corner */
    float leaf;       /* m: a leaf's side */
    int32_t depth, asked; /* depth < asked: the pool was too small, and leaves are larger */
    double area;      /* m2 of all surfaces */
    double flux[2], lost[2]; /* W, R + G + B, by world: injected; and lost for want of a leaf */
} lmb_voxels;

/* Triangles first_id .. first_id + count - 1 of a scene, and the worlds that they are part of. */
typedef struct lmb_voxel_part {
    const lmb_scene *scene;
    uint32_t first_id, count;
    int32_t in[2];
} lmb_voxel_part;

enum { LMB_CONE_STEPS = 256, LMB_CONE_MAX = 37, LMB_CONE_WIDTHS = 4 };

/* One sample of a cone: the same distance in all cones of one width. */
typedef struct lmb_cone_step {
    float at, length; /* m along the axis; leaves */
    float apart;      /* 1 / distance in leaves if voxels are seen along their own rays, not the axis; else 0 */
    float finer;      /* share of `level`; the rest is of the next */
    int32_t level;    /* 0: leaves */
} lmb_cone_step;

typedef struct lmb_cone_width {
    float tangent; /* of half the opening */
    int32_t count;
    lmb_cone_step step[LMB_CONE_STEPS];
} lmb_cone_width;

/* Cones over a hemisphere, each with the same share of the cosine-weighted total. 20.6 KiB. */
typedef struct lmb_cones {
    int32_t count;
    lmb_cone_width width[LMB_CONE_WIDTHS];   /* of each ring of cones */
    int32_t ring[LMB_CONE_MAX];
    float direction[LMB_CONE_MAX][3];       /* along two tangents and the normal */
} lmb_cones;

/* Results of 64 cones. */
typedef struct lmb_cone_seen {
    float rgb[3][LMB_TILE_PIXELS]; /* radiance, W/(m2 sr): the mean over the cone */
    float open[LMB_TILE_PIXELS];   /* share of the cone that no surface covers, 0 .. 1 */
} lmb_cone_seen;

/* Cone directions of one thread. 2.5 KiB; undefined before and after. */
typedef struct lmb_cone_scratch {
    float tangent[3][LMB_TILE_PIXELS], direction[3][LMB_TILE_PIXELS];
    lmb_cone_seen seen;
} lmb_cone_scratch;

/* Input of a trace: light of one field through one world. */
typedef struct lmb_cone_trace {
    const lmb_kernels *kernels;
    const lmb_voxels *voxels;
    int32_t field;      /* field of the light: LMB_VOXEL_WITHOUT, _WITH or _DELTA */
    int32_t world;      /* world of the surfaces: LMB_VOXEL_WITHOUT or _WITH */
    const lmb_env *env; /* visible where no surface covers; NULL: darkness [M22] */
    lmb_cone_scratch *scratch; /* one a thread */
    int32_t faced;      /* 1: pixels' faces are fronts of their triangles, never backs of double-sided ones. The
                           surfaces that they touch then hide those behind: cones do not see through a floor from under
                           an object on it */
} lmb_cone_trace;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_voxels_bytes: memory of a pool of `cap` voxels; fields: LMB_VOXELS_ONE (148 bytes each) or LMB_VOXELS_THREE
 * (388). 0 if that is impossible: `cap` is at least 4,689 and at most 2^24. */
size_t lmb_voxels_bytes(uint32_t cap, int32_t fields);

/* lmb_voxels_init: lay out the pool in `memory`. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
lmb_status lmb_voxels_init(lmb_voxels *out, uint32_t cap, int32_t fields, void *memory, size_t bytes);

/* lmb_voxels_build: the surfaces of checked scenes as voxels of a cube around the box low .. high; light is 0. [M6 M8]
 *
 *   depth  2^depth leaves along the cube's side, which is 1.2 times the box's longest side
 *   parts  triangles; those outside the cube are left out, like those that lmb_draw would drop. Single-sided triangles
 *          cover and emit only at the front: right for closed meshes, which otherwise count twice from afar
 *
 * Triangles are cut by the leaves' faces, so areas are exact; they are added in units of 2^-18 of a leaf's face, so the
 * order of triangles does not matter. Empty space takes no voxels. When the pool is full, the build starts again with
 * leaves twice as wide, until it fits, as 16 a side always do: see out->depth. Holes of masked materials count by four
 * points a triangle.
 * Returns LMB_OK or LMB_ERR_ARG. Cost: 0.1 us a pair of triangle and leaf that intersect. */
lmb_status lmb_voxels_build(lmb_voxels *inout, const lmb_vec3 *low, const lmb_vec3 *high, int32_t depth,
                            const lmb_voxel_part *parts, int32_t count);

/* lmb_voxels_dark: set a field's light to 0, to inject other lights. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_voxels_dark(lmb_voxels *inout, int32_t field);

/* lmb_voxels_inject: add first points' flux to the leaves that they lie in.                                    [M7 M10]
 *
 *   field   LMB_VOXEL_WITHOUT or LMB_VOXEL_WITH
 *   texels  of a tree (lmb_tree_texels), one face after the other, or filled in by you; flux 0 is no first point
 *
 * The flux is added, as outgoing radiance x area, to the three directions that the point's normal faces. A point
 * without a leaf uses a neighbouring leaf; if there is none, the flux counts as lost. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_voxels_inject(lmb_voxels *inout, int32_t field, const lmb_texel *texels, size_t count);

/* lmb_voxels_filter: sum a field's light from the leaves upward: each voxel is the mean of the eight children. Returns
 * LMB_OK or LMB_ERR_ARG. [M13] */
lmb_status lmb_voxels_filter(lmb_voxels *inout, int32_t field);

/* lmb_voxels_delta: with - without, of both filtered fields, exactly 0 if they are equal. Returns LMB_OK or
 * LMB_ERR_ARG. [M11 M12] */
lmb_status lmb_voxels_delta(lmb_voxels *inout);

/* lmb_cones_init: cones for one build's leaves; count: 7, 19 or 37. Returns LMB_OK or LMB_ERR_ARG. [M21]
 * lmb_cone_width_init: the steps of cones by the tangent of their half opening, 0.01 .. 2. Returns LMB_OK or
 * LMB_ERR_ARG. */
lmb_status lmb_cones_init(lmb_cones *out, const lmb_voxels *voxels, int32_t count);
lmb_status lmb_cone_width_init(lmb_cone_width *out, const lmb_voxels *voxels, float tangent);

/* lmb_cone_tangent: half opening of the narrow cone that holds half of a lobe of this roughness (scene.h). Reflection
 * turns twice as fast as a normal, and half of GGX's normals are within atan(alpha): 2 alpha / (1 - alpha^2), at most
 * 1. */
float lmb_cone_tangent(float roughness);

/* lmb_cones_trace: trace one cone from each pixel of a tile that has a surface (tile->depth > 0), along `direction`,
 * unit, 3 planes. The result of other pixels is dark. Any threads at once. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_cones_trace(lmb_cone_seen *out, const lmb_cone_trace *trace, const lmb_cone_width *width,
                           const lmb_tile *tile, float direction[3][LMB_TILE_PIXELS]);

/* lmb_cones_diffuse: add the light of all cones to a tile: irradiance, W/m2, by shading normals.              [M21 M22]
 *
 *   open  NULL, or set to the uncovered share of the cosine-weighted hemisphere, for each pixel
 * Pixels without a surface are unchanged. Doubling all light doubles the result. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_cones_diffuse(lmb_irradiance *inout, float open[LMB_TILE_PIXELS], const lmb_cone_trace *trace,
                             const lmb_cones *cones, const lmb_tile *tile);

/* lmb_cones_glossy: the radiance in one narrow cone along the mirrored view.                                  [M20 M22]
 *
 *   eye    position that the tile is seen from, m
 *   width  with lmb_cone_tangent of the roughness
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_cones_glossy(lmb_cone_seen *out, const lmb_cone_trace *trace, const lmb_cone_width *width,
                            const lmb_tile *tile, lmb_vec3 eye);

#ifdef __cplusplus
}
#endif
#endif
