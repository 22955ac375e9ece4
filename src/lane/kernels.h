/* kernels.h: the table of kernels that a backend fills in: the only way into isa/. Layer 2.
 *
 * A kernel is a pure function over public structs and the plain jobs below. Same inputs, same bytes, by every
 * backend. */
#ifndef LMB_LANE_KERNELS_H
#define LMB_LANE_KERNELS_H

#include <lambent/draw.h>
#include <lambent/bounce.h>
#include <lambent/compose.h>
#include <lambent/transfer.h>
#include <lambent/tree.h>
#include <lambent/live.h>
#include <lambent/many_lights.h>
#include <lambent/probe.h>
#include <lambent/voxel.h>
#include <lambent/relief.h>

#include "../base/light_kind.h"
#include "backends.h"

/* A tile's rays, relative to the eye. Of pixel (x, y):
 *   origin + ox x + oy y  +  w (direction + rx x + ry y)   with w along the view axis.
 * Perspective: the first part is 0; orthographic: the direction is constant. */
typedef struct lmb_rays {
    lmb_vec3 origin, ox, oy;
    lmb_vec3 direction, rx, ry;
    lmb_vec3 eye, back;
    float near_m;
    int32_t perspective;
} lmb_rays;

/* What lies in a tile's `work`: up to LMB_SLOTS triangles of one instance that a tile shows. Slot k of every array is
 * one of them. What comes from the mesh is turned in place into what pixels are made of. Corners' values become the
 * first and the others' differences from it, so that three equal ones give exactly their value. */
typedef struct lmb_resolve_batch {
    lmb_rays rays;
    const lmb_instance *instance;
    const lmb_mesh *mesh;
    const lmb_material *material;
    int16_t albedo_only;               /* of the pixels: uv and albedo, nothing else */
    int16_t is_first;                  /* of the tile: old values of its planes count as 0 */
    int32_t count;                     /* slots in use; the others hold numbers */
    uint32_t id[LMB_SLOTS];
    int32_t slot[LMB_TILE_PIXELS];     /* of each pixel; -1: another's */
    float corner[3][3][LMB_SLOTS];     /* in: [corner][axis], model space. Out: corner 0 relative to the eye, then g1
                                          and g2, which give barycentrics: b1 = (p - corner).g1, b2 = (p - corner).g2 */
    float normal[3][3][LMB_SLOTS];     /* in: octahedral codes as [corner][0 .. 1]. Out: world, [corner][axis] */
    uint32_t colour[3][LMB_SLOTS];     /* in: of each corner, four codes 0 .. 255, red in the low bits */
    float uv[3][2][LMB_SLOTS];         /* [corner][u, v] */
    float plane[3][LMB_SLOTS];         /* out: unit normal */
    float face[3][LMB_SLOTS];          /* out: the same, turned to the viewer; of albedo alone, of rays from the eye by wide
                                          kernels: face[0] the plane's height over the eye */
    float w_min[LMB_SLOTS], w_max[LMB_SLOTS]; /* out: of the corners, along the view axis */
    float albedo[3][3][LMB_SLOTS];     /* out: reflectance, [corner][channel] */
} lmb_resolve_batch;

/* Planes of the numbers by which nodes are bounded; vectors are three planes. */
enum {
    LMB_BOUNDS_CENTRE = 0,
    LMB_BOUNDS_NORMAL = 3,
    LMB_BOUNDS_MIDDLE = 6,
    LMB_BOUNDS_ACROSS = 9,
    LMB_BOUNDS_HALF = 12,
    LMB_BOUNDS_FLUX = 15, /* R + G + B */
    LMB_BOUNDS_AREA = 16,
    LMB_BOUNDS_COSINE = 17,
    LMB_BOUNDS_RADIUS = 18,
    LMB_BOUNDS_AGREEMENT = 19,
    LMB_BOUNDS_PLANES = 20
};

/* What lies in a cut's `bounds_of_nodes`: nodes side by side, and the light of each on the tile: value and upper as in
 * lmb_cut, and error. */
typedef struct lmb_node_bounds {
    float node[LMB_BOUNDS_PLANES][LMB_BOUNDS_NODES];
    float value[LMB_BOUNDS_NODES], upper[LMB_BOUNDS_NODES], error[LMB_BOUNDS_NODES];
} lmb_node_bounds;

/* Both lie in public structs, as room whose size alone is told there. */
typedef char lmb_resolve_batch_fits[sizeof(lmb_resolve_batch) <= sizeof(((lmb_tile *)0)->work) ? 1 : -1];
typedef char lmb_node_bounds_fits[sizeof(lmb_node_bounds) == sizeof(((lmb_cut *)0)->bounds_of_nodes) ? 1 : -1];

/* One tile of a target, by rows of 8: steps are in elements. */
typedef struct lmb_fill_tile {
    void *depth, *id;
    int32_t depth_step, id_step;
    int32_t depth_format, id_format; /* id_format LMB_FORMAT_NONE: no ids */
} lmb_fill_tile;

/* One triangle over one tile. Edge i at pixel (x, y) of the tile is e[i] + ex[i] x + ey[i] y; inside is >= 0 for all.
 * |e| < 2^30 over the tile. Depth is (d + dy y) + dx x, clamped to [d_min, d_max]; 16-bit depth then becomes
 * floor(d * d_scale + d_bias). */
typedef struct lmb_fill_job {
    int32_t e[3], ex[3], ey[3];
    float d, dx, dy, d_min, d_max;
    float d_scale, d_bias;
    uint32_t id;
} lmb_fill_job;

/* What every triangle of an instance goes through on its way to a window. Rows give metres along right, up and the
 * view's axis, from the eye. */
typedef struct lmb_setup_job {
    float row[3][4];
    float scale_x, scale_y; /* to half width 1 */
    float guard_x, guard_y; /* how far past the frame's edge 24.8 reaches, in units of w */
    float snap_x, snap_y;   /* x / w -> 24.8 */
    float near_m, far_m, depth_scale;
    int32_t orthographic;
    int32_t cull;                /* 0: neither; -1: counter-clockwise triangles go, 1: clockwise ones */
    int32_t origin_x, origin_y;  /* where the frame's pixel (0, 0) is seen, 24.8 from its middle */
    int32_t x0, y0, x1, y1;      /* the window's first and last pixels, in the frame */
} lmb_setup_job;

/* Triangles that are set up side by side: as many as the widest backend of the build has lanes, or twice four. A
 * triangle takes 120 bytes of lmb_draw's stack. */
#if LMB_HAVE_AVX512
#define LMB_BATCH 16
#elif LMB_PLAIN_LANES == 1
#define LMB_BATCH 4
#else
#define LMB_BATCH 8
#endif

/* Draws by lanes. */
#define LMB_DRAW_LANES (LMB_DRAW_KERNELS && LMB_PLAIN_LANES > 1)
#if LMB_DRAW_LANES
/* A linear value at a tile's first pixel, and per px. */
typedef struct lmb_draw_slope {
    float at, x, y;
} lmb_draw_slope;

enum { LMB_DRAW_VALUES = 9 /* R G B A, u v of two stages, fog */ };

/* A shape over a tile whose 64 pixels are all in the target. Values are at + (b1 more1 + b2 more2), where b1 and b2 are
 * n1 / q and n2 / q. */
typedef struct lmb_draw_patch {
    const lmb_draw_state *state;
    lmb_draw_slope d, n1, n2, q;
    float at[LMB_DRAW_VALUES], more1[LMB_DRAW_VALUES], more2[LMB_DRAW_VALUES];
    float d_min, d_max, d_add;
    int32_t is_even; /* 1: q is 1 */
    int32_t varies;  /* 1: colours of the corners differ */
    int32_t swaps;   /* 1: blue comes first in memory */
    float *depth;    /* of pixel 0, rows depth_step floats apart */
    int32_t depth_step;
    uint8_t *colour; /* of pixel 0, rows colour_stride bytes apart */
    int32_t colour_stride;
} lmb_draw_patch;
#endif

enum { LMB_SMALL_24_8 = 64 * 256 /* sides of a box under which edges fit 32 bits */ };

#if LMB_PLAIN_LANES == 1
/* A corner that was transformed. */
typedef struct lmb_batch_corner {
    int32_t x, y; /* 24.8 */
    float d;
    uint32_t vertex, is_out; /* vertex + 1, 0: none; why it cannot be used as it is */
} lmb_batch_corner;
enum { LMB_BATCH_CORNERS = 32 };
#endif

/* What becomes of up to LMB_BATCH triangles of one instance. Bit k of a set is triangle k. */
typedef struct lmb_batch_sets {
    uint32_t in;      /* there, and every index inside the mesh */
    uint32_t small, other, dropped; /* the others of `in` are invisible; other: clipped or large, one by one, by setup.c */
    uint32_t drawn;   /* of neither of the latter, with area and not culled */
#if LMB_PLAIN_LANES == 1
    lmb_batch_corner kept[LMB_BATCH_CORNERS]; /* of the instance, for batches to come: by a vertex's lowest bits */
#endif
} lmb_batch_sets;

/* LMB_BATCH triangles side by side; those in `small` have all of this. */
typedef struct lmb_batch {
    int32_t e[3][LMB_BATCH], ex[3][LMB_BATCH], ey[3][LMB_BATCH]; /* at the first pixel of the box's first tile */
    int32_t x0[LMB_BATCH], y0[LMB_BATCH], x1[LMB_BATCH], y1[LMB_BATCH]; /* pixels of the frame, in the window */
    double d[LMB_BATCH], dx[LMB_BATCH], dy[LMB_BATCH]; /* depth at the frame's middle; per px */
    float d_min[LMB_BATCH], d_max[LMB_BATCH];
    uint32_t id[LMB_BATCH]; /* set by who calls, where the window has ids */
    lmb_batch_sets sets;
} lmb_batch;

#if LMB_CULLING
/* Small triangles side by side as bins hold them, 32 bytes each: corner a, 24.8 from the frame's middle; where b and c lie
 * from there, x + 65536 y; depths; ids. */
typedef struct lmb_bin_block {
    int32_t x[LMB_BATCH], y[LMB_BATCH], to_b[LMB_BATCH], to_c[LMB_BATCH];
    float d[3][LMB_BATCH];
    uint32_t id[LMB_BATCH];
} lmb_bin_block;

/* A batch on its way into bins: `small` ones lie in `block`, without ids. Of others in `whole`, which no plane cuts, x, y
 * and d of the block and b and c hold the corners. */
typedef struct lmb_bin_batch {
    lmb_bin_block block;
    int32_t b[2][LMB_BATCH], c[2][LMB_BATCH]; /* x, y, 24.8 */
    int32_t y0[LMB_BATCH], y1[LMB_BATCH];     /* of `small` ones: first and last rows of the frame */
    uint32_t whole;
    lmb_batch_sets sets;
} lmb_bin_batch;
#endif

/* Edge i is e >= 0 inside, in units of 1/256 px x px: e(x + 1) = e(x) + ex. */
typedef struct lmb_setup {
    int32_t ex[3], ey[3];
    int64_t e_origin[3]; /* at the frame's middle + (0, 0) in 24.8, fill rule included, not yet divided by 256 */
    double d_origin, d_x, d_y; /* depth at the middle; per px */
    float d_min, d_max;
    int32_t x_min, x_max, y_min, y_max; /* box, 24.8 */
    int32_t back;        /* back face: clockwise in the picture */
} lmb_setup;

#if LMB_CULLING
/* Small triangles leave bounds alone; are left out where they are hidden; and raise them, too. */
enum { LMB_BOUNDS_IDLE, LMB_BOUNDS_READ, LMB_BOUNDS_RAISED };

/* First and last tiles of a window. */
typedef struct lmb_tile_box {
    int32_t x0, x1, y0, y1;
} lmb_tile_box;
#endif

/* A window in memory: bytes from tile to tile and from one row of tiles to the next. */
typedef struct lmb_fill_window {
    lmb_fill_tile first;
    int32_t depth_tile, depth_row, id_tile, id_row;
    int32_t x0, y0;             /* px in the frame, of the first tile */
    int32_t tiles_x, tiles_y;
    int32_t origin_x, origin_y; /* as in lmb_setup_job */
    float d_scale, d_bias;
#if LMB_CULLING
    float *farthest; /* of each tile, row by row: at most every depth in it; where no bounds are asked for, not read */
    int32_t bounds;  /* LMB_BOUNDS_*: what small triangles do with them */
#endif
} lmb_fill_window;

/* One light over a tile. */
typedef struct lmb_direct_job {
    lmb_vec3 position, direction;
    float intensity[3];
    float cos_outer, cone_scale; /* fall-off t = (cos - cos_outer) * cone_scale */
    float range2;                /* light_range2 */
    int32_t kind;
} lmb_direct_job;

/* The pixels of a tile that take a cut of the lights' tree together. */
typedef struct lmb_many_lights_job {
    lmb_vec3 middle, half; /* m: their box */
    lmb_vec3 normal;       /* the first one's, unit */
    float bend;            /* the others' normals differ from it by at most this, as vectors */
} lmb_many_lights_job;

#define LMB_MANY_LIGHTS_NEAR 1e30f /* the error of a node too near for a bound: it is parted first */

/* The pixels of one surface in a tile. */
typedef struct lmb_pixel_cluster {
    uint64_t pixels;
    lmb_vec3 centre;  /* of the box of their positions */
    lmb_vec3 axis[3]; /* its sides' directions: unit, at right angles; the first is their faces' mean normal */
    float half[3];    /* half its sides, m */
    lmb_vec3 normal;  /* mean */
    float thick;      /* m: how far the positions reach along it from the centre */
    float sine;       /* of the widest angle between theirs and the mean; 1 over 90 degrees */
    float face_sine;  /* of the widest between these, their faces' and the mean */
    float noise;      /* m: how far rounding may have moved a position */
} lmb_pixel_cluster;

/* The viewer's depth map as the gather reads it. */
typedef struct lmb_march_job {
    const float *depth_32;    /* one of the two */
    const uint16_t *depth_16;
    int32_t tiled, row_step;  /* values from one row of tiles (or of pixels) to the next */
    float last_x, last_y;     /* px */
    lmb_vec3 eye, right, up, back;
    float scale_x, scale_y;   /* px a unit of x / w, from the middle */
    float middle_x, middle_y; /* px */
    float near_m, far_m;
    float d16_scale, d16_bias; /* 16-bit code -> d */
    float slack;               /* of d: what rounding (or 16 bits) may hide */
    int32_t kind, steps, perspective;
} lmb_march_job;

/* A triangle as seen from the point `at`: a segment from there along d crosses it if every edge . d >= -slack and
 * normal . d > beyond. */
typedef struct lmb_cross_job {
    lmb_vec3 at, edge[3], normal;
    float beyond; /* of `at` from the plane and the noise, m */
    float slack;  /* m3 */
} lmb_cross_job;

/* A receiver of live light. */
typedef struct lmb_live_job {
    lmb_vec3 position, face, normal;
    int32_t is_bent; /* 1: the normal is not the face's */
    int32_t can_move; /* 1: a receiver in an inner edge is to be lit beside it */
    float split;     /* as in lmb_live */
} lmb_live_job;

/* A pixel that is lit by itself. */
typedef struct lmb_live_sample {
    lmb_vec3 position, face, normal; /* as of lmb_tile */
    float light[3];                  /* irradiance, W/m2 */
    float slope[2][3];               /* of it along columns and rows, W/m2 a px; first [0] is light without shadows */
    uint32_t id;                     /* the triangle */
    uint8_t seen[3], is_lit;         /* the share that shadows leave of each channel, 0 .. 254; 0: no light to shade */
} lmb_live_sample;

#define LIVE_SAME_COS  0.95f /* least cosine between the normals of places that share light, */
#define LIVE_SAME_LIFT 1e-3f /* and most that either lies over the other's plane, of the distance, squared, if flat */

/* A cell between four samples, and pixels of a tile in it. */
typedef struct lmb_live_cell {
    const lmb_live_sample *corner[4]; /* NULL: not known */
    float x[2], y[2], per_x, per_y;   /* px in the tile, and one by the cell's sides */
    int32_t even;                     /* 1: all corners count in full at all pixels */
    uint64_t pixels;                  /* to light, a bit each */
} lmb_live_cell;

/* A triangle as rays to infinity see it: one from `at` + d crosses it where every edge . d + offset >= 0 and
 * normal . d > beyond. */
typedef struct lmb_sun_job {
    lmb_vec3 at, edge[3], normal;
    float offset[3], beyond;
} lmb_sun_job;

/* A box that moves towards a light at infinity: 1 / the direction along each axis, not 0. */
typedef struct lmb_sun_sweep {
    float low[3], high[3], per[3];
} lmb_sun_sweep;

/* The segments from a point to all of a box: 1 / distance to its upper and its lower end along each axis; not 0. */
typedef struct lmb_pyramid {
    float at[3], per_high[3], per_low[3];
} lmb_pyramid;

/* A segment from a point: 1 / the distance to its other end along each axis, at most 1e20 where that is 0; and where in
 * lmb_boxes the sides lie by which it enters and leaves them, in floats. */
typedef struct lmb_segment {
    lmb_vec3 at, per;
    int32_t enter[3], leave[3];
} lmb_segment;

/* The world, for rays of one width. */
typedef struct lmb_world_job {
    const void *texels;
    const float *log8, (*log16)[256];
    int32_t format, blend, shape;
    int32_t has_floor;          /* at ground.y */
    int32_t means;              /* 1: rays are averaged over texels; else each by itself, smoothly */
    int32_t side, cube_at;      /* the cube's level, and its first texel */
    lmb_vec3 centre, middle;    /* of the cube; of the sphere */
    float radius2, reach;       /* of the sphere, squared; of places inside it, from its middle */
    lmb_vec3 low, high;         /* the box */
    lmb_vec3 reach_low, reach_high; /* of places inside it */
    float ray_width;            /* rad */
    int32_t ground_levels, ground_from; /* 0: no ground; its first texel */
    lmb_vec3 ground;            /* its corner of least x and z, at its height */
    float ground_width_m, ground_depth_m, ground_per_x, ground_per_z;
    float ground_columns[16], ground_rows[16]; /* by level */
    int32_t ground_at[16];      /* from the ground's first texel */
    float ground_limit[16];     /* rays wider than this read the next level, m */
} lmb_world_job;

/* One row of a blur. */
typedef struct lmb_blur_job {
    const float *map;     /* a plane, height rows of width */
    const float *column;  /* weights of the rows; over: of those past a pole too, half a turn on */
    const float *row;     /* by lag, a full turn */
    int32_t width, height, over;
} lmb_blur_job;

/* Cones of one width through a tree of voxels. */
typedef struct lmb_cone_job {
    const float *child, *cover, *light; /* as in lmb_voxels */
    const lmb_cone_step *step;
    int32_t steps, depth;
    lmb_vec3 low;
    float per_leaf, leaf; /* 1 / m, m */
    int32_t faced;        /* as in lmb_cone_trace */
} lmb_cone_job;

/* One tile over a relief. */
typedef struct lmb_relief_job {
    const lmb_relief_view *view[LMB_RELIEF_TILE_VIEWS]; /* that its pixels look at; ranking: not read */
    int32_t count, format;
    int32_t aligned;     /* the first of them look most as the eye does */
    int32_t steps, pick, sampling, keep;
    int32_t as_is;       /* the winner's own place, whether or not it is on the ray */
    int32_t outside;     /* some view is orthographic: it shows all of the model, and what is beside that is open */
    lmb_vec3 eye, back;  /* the eye's, not a view's */
    int32_t perspective;
    float pixel;         /* m of a pixel's side; perspective: at 1 m */
} lmb_relief_job;

/* What became of its pixels, a bit each; those of neither are as they were. */
typedef struct lmb_relief_found {
    uint64_t hit, missed;
} lmb_relief_found;

/* A row of a shadow map's texels. */
typedef struct lmb_texel_row {
    lmb_vec3 right, up, back;    /* the view's */
    lmb_vec3 direction;          /* the light's; cone: between the cosines of its angles */
    float cos_outer, cone;
    float side_x, side_y, sy;    /* a texel's sides, and where the row's middle lies, at distance 1 (m for suns) */
    float finer_x, finer_half;   /* half over 0: texels so near to finer_x are shown by a finer face */
    int32_t is_far, is_coned;    /* as light_kind.h has it */
} lmb_texel_row;

/* A leaf of a triangle's halvings. At weights b1 and b2 of the triangle's corners that of its own corner k is
 * weight[0][k] + weight[1][k] b1 + weight[2][k] b2. */
typedef struct lmb_transfer_leaf {
    const float (*weight)[3];
    float corner[3][9]; /* light there: R, G, B; by direction each along x, y, z */
    int32_t is_directed;
} lmb_transfer_leaf;

struct lmb_kernels {
    const char *name;
    int32_t lanes;
    /* `count` triangles, up to LMB_BATCH, from the mesh's triangle `first` on. */
    void (*setup)(lmb_batch *out, const lmb_setup_job *job, const lmb_mesh *mesh, uint32_t first, uint32_t count);
    /* The batch's small triangles among `bits`, in order. */
    void (*fill_small)(const lmb_fill_window *window, const lmb_batch *batch, uint32_t bits);
    /* One triangle of any size into the whole window. */
    void (*fill_large)(const lmb_fill_window *window, const lmb_setup *setup, uint32_t id);
    /* Pixels whose id is not 0, a bit each. */
    uint64_t (*resolve_shown)(const uint32_t id[LMB_TILE_PIXELS]);
    /* Slots for the first LMB_SLOTS different ids of the batch's instance among the pixels of `left`, one bit a pixel,
     * which has all pixels of an id or none; returns the pixels that got one. */
    uint64_t (*resolve_slots)(lmb_resolve_batch *out, const uint32_t id[LMB_TILE_PIXELS], uint64_t left);
    void (*resolve_setup)(lmb_resolve_batch *inout);
    /* The batch's pixels. Of a tile's first batch the others become 0, in every plane that is wanted, by kernels of
     * LMB_TILE lanes or more. */
    void (*resolve)(lmb_tile *out, const lmb_resolve_batch *batch);
    /* The albedo of pixels that have a slot times the texture's finest level, nearest or bilinear. */
    void (*texture)(lmb_tile *inout, const lmb_resolve_batch *batch, const lmb_texture *texture);
    /* W/m2 at each pixel if nothing shadowed it. */
    void (*direct)(lmb_irradiance *out, const lmb_tile *tile, const lmb_direct_job *job);
    /* Far pairs are added; near ones flagged in scratch->near_pixels, one bit a pixel. */
    void (*gather)(lmb_irradiance *inout, lmb_gather_scratch *scratch, const lmb_tile *tile, const lmb_groups *groups,
                   const lmb_march_job *march);
    /* The flagged pixels of one near group, through its discs. */
    void (*gather_near)(lmb_irradiance *inout, uint64_t pixels, const lmb_tile *tile, const lmb_point *discs,
                        uint32_t count, const lmb_march_job *march);
    void (*blend)(lmb_radiance *out, const lmb_tile *tile, const lmb_irradiance *direct,
                  const lmb_irradiance *indirect);
    /* sRGB codes 0 .. 255 of radiance x gain: red in the low bits, then green, blue, and 255. */
    void (*encode)(uint32_t out[LMB_TILE_PIXELS], const lmb_radiance *in, float gain);
    /* (1 + 2^-12)^2 - (1 + 2^-11) by this backend's verbs: 0, or 2^-24 where the compiler fused it. */
    float (*probe)(float one_and_bit);
#if LMB_CULLING
    /* fill_small and fill_large where the window has bounds, which they use and raise. */
    void (*culled_small)(const lmb_fill_window *window, const lmb_batch *batch, uint32_t bits);
    void (*culled_large)(const lmb_fill_window *window, const lmb_setup *setup, uint32_t id);
    /* 1 where each tile of the box is at least as near as `nearest` throughout. A bound that is under it is made anew. */
    int (*culled_box)(const lmb_fill_window *window, const lmb_tile_box *box, float nearest);
    /* The first half of setup. */
    void (*bin_snap)(lmb_bin_batch *out, const lmb_setup_job *job, const lmb_mesh *mesh, uint32_t first, uint32_t count);
    /* The other half: the first `count` triangles of a block, and their ids. The job tells of the window alone. */
    void (*bin_setup)(lmb_batch *out, const lmb_setup_job *job, const lmb_bin_block *block, uint32_t count);
    /* The tiles of a window that triangles of a full block may show in, and the nearest depth of their corners. */
    float (*bin_box)(lmb_tile_box *out, const lmb_setup_job *job, const lmb_bin_block *block);
#endif
#if LMB_TREES
    /* Emitters that some pixels see: added. `pairs` is scratch. */
    void (*gather_cut)(lmb_irradiance *inout, float (*pairs)[LMB_GATHER_PAIRS], const lmb_tile *tile,
                       const lmb_emitter *emitters, int32_t count);
    /* Nodes 0 .. count - 1 at the pixel cluster: sets their light, its upper bound, and their errors. Returns those
     * that do not face away, a bit each; what is set for the others means nothing. conservative: see node_bounds.inl.
     * Writes whole vectors. */
    uint32_t (*node_bounds)(lmb_node_bounds *inout, int32_t count, const lmb_pixel_cluster *cluster,
                            int32_t conservative);
    /* Of `pixels`, one bit each, those whose segment to the point crosses the triangle. */
    uint64_t (*crossed)(const lmb_tile *tile, uint64_t pixels, const lmb_cross_job *job);
    void (*segments)(lmb_segments *out, const lmb_tile *tile, lmb_vec3 at);
    /* Of `pixels`, those whose segment meets box i. */
    uint64_t (*through)(const lmb_segments *segments, uint64_t pixels, const lmb_boxes *boxes, int i);
    /* The boxes that the pyramid may meet, a bit each. */
    uint32_t (*meets)(const lmb_pyramid *pyramid, const lmb_boxes *boxes);
    /* Those that one segment meets. */
    uint32_t (*meets_one)(const lmb_segment *segment, const lmb_boxes *boxes);
    /* `crossed` and `meets` for a light at infinity. */
    uint64_t (*sun_crossed)(const lmb_tile *tile, uint64_t pixels, const lmb_sun_job *job);
    uint32_t (*sun_meets)(const lmb_sun_sweep *sweep, const lmb_boxes *boxes);
    /* Of `count` <= 8 nodes of one kind from `first`: a bound of what one may be off for its lights (< 0: they light no
     * pixel; LMB_MANY_LIGHTS_NEAR), about what it gives, and what it gives if it is a cone's that all of its lights
     * have; all without shadows, W/m2. Writes up to 16 values each. */
    void (*many_lights_bounds)(float error[16], float light[16], float inside[16], const lmb_many_lights *many_lights,
                               uint32_t first, uint32_t count, const lmb_many_lights_job *job);
    /* What lobes make of emitters that some pixels see: added. */
    void (*glossy_cut)(lmb_glossy *inout, const lmb_tile *tile, const lmb_emitter *emitters, int32_t count);
    /* The lights' light on `pixels` is added. */
    void (*many_lights_irradiance)(lmb_irradiance *inout, const lmb_tile *tile, uint64_t pixels,
                                   const lmb_active_light *active_lights, int32_t count);
#endif
#if LMB_LOBES
    /* What the lobes make of one light that brings `lit`: added. */
    void (*glossy_direct)(lmb_glossy *inout, const lmb_tile *tile, const lmb_irradiance *lit, const lmb_light *light);
#endif
#if LMB_TRANSFER
    /* Sums of R, G and B of what the links' nodes send times their weights; the fourth value of each node is 0. Links
     * are those of lmb_transfer's receivers, and of its clusters, along x, y and z. */
    void (*transfer_links)(int32_t out[3], const uint32_t *link, uint32_t count, uint16_t (*node)[4]);
    void (*transfer_directed_links)(int32_t out[3][3], const uint32_t *link, uint32_t count, uint16_t (*node)[4]);
    /* The power through texels whose middles lie at sx[0 .. count - 1], at 1 W/sr (1 W/m2 of suns). Whole vectors are
     * read and written. */
    void (*texel_powers)(float *out, const float *sx, int32_t count, const lmb_texel_row *row);
    /* Shares of triangles in the `cells` x `cells` cells of a block whose first cell is `at` of the face; others may be
     * written. An id 0 stands for what lies behind all. */
    void (*transfer_share)(float out[LMB_TRANSFER_SHARING][LMB_TRANSFER_BLOCK_CELLS], const lmb_transfer_shown *shown,
                           int32_t count, const float at[2], int32_t cells);
    /* Blocks' light in `rows`, a bit each, parted by a line, line[0] + line[1] column + line[2] row = 0: `light` keeps the
     * second half's. Other rows are not read; they may be written. Returns a bit for each row where the first half has
     * some, and from bit 8 on where the second has. Light: whole numbers up to 2^24. */
    uint32_t (*transfer_halve)(float first[LMB_TILE_PIXELS], float light[LMB_TILE_PIXELS], const float line[3],
                               uint32_t rows);
    /* Of the tile's pixels `left`, at least one, those of the first one's triangle on the same side of it, a bit each;
     * b1 and b2 of these are set, of others they may be. */
    uint64_t (*transfer_side)(float weight[2][LMB_TILE_PIXELS], const lmb_tile *tile, uint64_t left,
                              const lmb_transfer_triangle *triangle);
    /* Of such pixels those on the leaf, as which the first counts: they get its light, which is never under 0; and
     * `glossy`, where it is not NULL, what their lobes make of it. */
    uint64_t (*transfer_leaf)(lmb_irradiance *inout, lmb_glossy *glossy, float weight[2][LMB_TILE_PIXELS],
                              const lmb_tile *tile, uint64_t left, const lmb_transfer_leaf *leaf);
#endif
#if LMB_PROBES
    /* Radiance of each of `count` directions from one place, 3 planes; `direction`: as lmb_probe_table's. */
    void (*remap)(float *out, const uint16_t *direction, int32_t count, lmb_vec3 at, const lmb_world_job *job);
    /* Of one ray a pixel; directions are of unit length. */
    void (*see)(float out[3][LMB_TILE_PIXELS], float origin[3][LMB_TILE_PIXELS], float direction[3][LMB_TILE_PIXELS],
                const lmb_world_job *job);
    /* What the job's cube alone shows along a direction of any length. */
    void (*world_radiance)(float out[3][LMB_TILE_PIXELS], float direction[3][LMB_TILE_PIXELS],
                           const lmb_world_job *job);
    /* A map's light, added to lmb_probe_lights' `shared`. */
    void (*share)(float (*shared)[4], const float *map, const lmb_probe_table *table);
    /* Irradiance by normal; `direction`: of the lights, 3 planes. */
    void (*cosine)(float out[3][LMB_TILE_PIXELS], float normal[3][LMB_TILE_PIXELS], const lmb_probe_lights *lights,
                   const float *direction);
    /* Added to a row; `line`: scratch, 4 x width. */
    void (*blur)(float *inout, float *line, const lmb_blur_job *job);
#endif
#if LMB_VOXELS
    /* A cone from each pixel of the tile, along `direction`; what pixels without a surface see means nothing. */
    void (*cone)(lmb_cone_seen *out, const lmb_cone_job *job, const lmb_tile *tile,
                 float direction[3][LMB_TILE_PIXELS]);
#endif
#if LMB_RELIEF
    /* The three views that suit each pixel best get a vote each, added. */
    void (*relief_rank)(uint8_t votes[LMB_RELIEF_VIEWS], const lmb_tile *tile, const lmb_relief *relief,
                        const lmb_relief_job *job);
    /* The pixels that hit the complex surface get it; no other changes. */
    void (*relief_warp)(lmb_relief_found *out, lmb_tile *inout, const lmb_relief_job *job);
#endif
#if LMB_LIVE
    /* Values of the cut's chunks from inout->done on, with those that near nodes ask for. */
    void (*live_values)(lmb_live_scratch *inout, const lmb_live *live, const lmb_live_job *job);
    /* Sums of the cut's chunks, and the cut's light. Returns the sum of all. */
    float (*live_sums)(float light[3], lmb_live_scratch *inout);
    /* A target from each of `strata` strata of the cut, at `place` of it: inout->rays. `all`: over 0, what live_sums
     * returned. Writes whole vectors. */
    void (*live_targets)(lmb_live_scratch *inout, const lmb_live *live, int32_t strata, float place, float all);
    /* Of the targets, those that may light the receiver; and sums of colours, added: of all, and of those `seen`. */
    uint64_t (*live_ahead)(const lmb_live_rays *rays, int32_t targets, const lmb_live_receiver *at);
    void (*live_share)(float all[3], float some[3], const lmb_live_rays *rays, int32_t targets, uint64_t seen);
    /* Of the segments `asked`, those that meet each of a node's boxes, and those that cross a triangle. */
    void (*live_boxes)(uint64_t out[LMB_BOXES], const lmb_segments *segments, uint64_t asked, const lmb_boxes *boxes);
    uint64_t (*live_crossed)(float (*to)[LMB_TILE_PIXELS], uint64_t asked, const lmb_cross_job *job);
    /* The light of a cell's pixels; no other changes. Returns those that no corner explains. */
    uint64_t (*live_fill)(lmb_irradiance *inout, const lmb_tile *tile, const lmb_live_cell *cell);
#endif
#if LMB_DRAW_LANES
    /* The tile's pixels where all three e + ex x + ey y >= 0. */
    uint64_t (*draw_cover)(const int32_t e[3], const int32_t ex[3], const int32_t ey[3]);
    /* Those of `mask` that pass the depth test; their depths are stored. */
    uint64_t (*draw_test)(const lmb_draw_patch *pixels, uint64_t mask);
    /* Colours of `mask`. */
    void (*draw_paint)(const lmb_draw_patch *pixels, uint64_t mask);
#endif
};

/* Those of this build: see backends.h. */
#define LMB_KERNELS_OF(upper, lower) extern const lmb_kernels lmb_kernels_##lower;
LMB_BACKENDS(LMB_KERNELS_OF)
#undef LMB_KERNELS_OF

#endif
