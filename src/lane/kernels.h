/* kernels.h: the table of kernels that a backend fills in: the only way into isa/. Layer 2.
 *
 * A kernel is a pure function over public structs and the plain jobs below. Every backend returns the same bytes for
 * the same inputs. */
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

/* The rays of a tile, relative to the eye. For pixel (x, y):
 *   origin + ox x + oy y  +  w (direction + rx x + ry y)   with w along the view axis.
 * If the view is perspective, the first part is 0; if it is orthographic, the direction is constant. */
typedef struct lmb_rays {
    lmb_vec3 origin, ox, oy;
    lmb_vec3 direction, rx, ry;
    lmb_vec3 eye, back;
    float near_m;
    int32_t perspective;
} lmb_rays;

/* Contents of lmb_tile `work`: up to LMB_SLOTS triangles of one instance that the tile shows. Slot k of each array is
 * one triangle. resolve_setup turns mesh values in place into the values that pixels need: corner 0, and the
 * differences of the other corners from it, so three equal corners give exactly that value. */
typedef struct lmb_resolve_batch {
    lmb_rays rays;
    const lmb_instance *instance;
    const lmb_mesh *mesh;
    const lmb_material *material;
    int16_t albedo_only;               /* pixels need uv and albedo, nothing else */
    int16_t is_first;                  /* first batch of the tile: old values of the planes count as 0 */
    int32_t count;                     /* slots in use; unused slots hold valid numbers */
    uint32_t id[LMB_SLOTS];
    int32_t slot[LMB_TILE_PIXELS];     /* slot of each pixel; -1: in another batch */
    float corner[3][3][LMB_SLOTS];     /* in: [corner][axis], model space. Out: corner 0 relative to the eye, then g1
                                          and g2 for barycentrics: b1 = (p - corner).g1, b2 = (p - corner).g2 */
    float normal[3][3][LMB_SLOTS];     /* in: octahedral codes as [corner][0 .. 1]. Out: world, [corner][axis] */
    uint32_t colour[3][LMB_SLOTS];     /* in: four codes 0 .. 255 per corner, red in the low bits */
    float uv[3][2][LMB_SLOTS];         /* [corner][u, v] */
    float plane[3][LMB_SLOTS];         /* out: unit normal */
    float face[3][LMB_SLOTS];          /* out: `plane` turned to the viewer. If albedo_only, kernels of several
                                          lanes put the plane's height above the eye into face[0] for
                                          perspective views */
    float w_min[LMB_SLOTS], w_max[LMB_SLOTS]; /* out: range of the corners along the view axis */
    float albedo[3][3][LMB_SLOTS];     /* in: colours in LMB_COLOUR_RGBA16, decoded. Out: reflectance,
                                          [corner][channel] */
} lmb_resolve_batch;

/* Planes of lmb_node_bounds::node; a vector takes three. */
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

/* Contents of lmb_cut `with.nodes.bounds`: nodes in structure-of-arrays form, and the light of each node on the tile.
 * value and upper: as in lmb_cut. */
typedef struct lmb_node_bounds {
    float node[LMB_BOUNDS_PLANES][LMB_BOUNDS_NODES];
    float value[LMB_BOUNDS_NODES], upper[LMB_BOUNDS_NODES], error[LMB_BOUNDS_NODES];
} lmb_node_bounds;

/* Both live in arrays of public structs, which only give the size. */
typedef char lmb_resolve_batch_fits[sizeof(lmb_resolve_batch) <= sizeof(((lmb_tile *)0)->work) ? 1 : -1];
typedef char lmb_node_bounds_fits[sizeof(lmb_node_bounds) == sizeof(((lmb_cut *)0)->with.nodes.bounds) ? 1 : -1];

/* One tile of a target in rows of 8. Steps are in elements. */
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

/* Transform of all triangles of an instance to a window. Rows give metres along right, up and the view axis, from the
 * eye. */
typedef struct lmb_setup_job {
    float row[3][4];
    float scale_x, scale_y; /* to half width 1 */
    float guard_x, guard_y; /* how far the 24.8 range reaches past the edge of the frame, in units of w */
    float snap_x, snap_y;   /* x / w -> 24.8 */
    float near_m, far_m, depth_scale;
    int32_t orthographic;
    int32_t cull;                /* 0: none; -1: counter-clockwise triangles; 1: clockwise ones */
    int32_t origin_x, origin_y;  /* sample of the frame's pixel (0, 0), in 24.8 from the centre of the frame */
    int32_t x0, y0, x1, y1;      /* first and last pixels of the window, in the frame */
} lmb_setup_job;

/* Triangles per setup batch: the lanes of the widest backend of the build, or twice four. A triangle takes 120 bytes of
 * lmb_draw's stack. */
#if LMB_HAVE_AVX512
#define LMB_BATCH 16
#elif LMB_PLAIN_LANES == 1
#define LMB_BATCH 4
#else
#define LMB_BATCH 8
#endif

/* A value that is linear in the picture: at the viewport's centre, and per px. */
typedef struct lmb_draw_plane {
    double origin, x, y;
} lmb_draw_plane;

/* 1: draws have SIMD kernels. */
#define LMB_DRAW_LANES (LMB_DRAW_KERNELS && LMB_PLAIN_LANES > 1)
#if LMB_DRAW_LANES
/* A linear value: at the first pixel of a tile, and per px. */
typedef struct lmb_draw_slope {
    float at, x, y;
} lmb_draw_slope;

enum { LMB_DRAW_VALUES = 9 /* R G B A, u v of two stages, fog */ };

/* A shape over a tile that lies entirely in the target. Values are at + (b1 more1 + b2 more2), with b1 = n1 / q and b2
 * = n2 / q. */
typedef struct lmb_draw_patch {
    const lmb_draw_state *state;
    lmb_draw_slope d, n1, n2, q;
    float at[LMB_DRAW_VALUES], more1[LMB_DRAW_VALUES], more2[LMB_DRAW_VALUES];
    float d_min, d_max, d_add;
    int32_t is_even; /* 1: q is 1 */
    int32_t varies;  /* 1: the corners have different colours */
    int32_t swaps;   /* 1: blue is the first byte in memory */
    float *depth;    /* pixel 0; rows are depth_step floats apart */
    int32_t depth_step;
    uint8_t *colour; /* pixel 0; rows are colour_stride bytes apart */
    int32_t colour_stride;
} lmb_draw_patch;

/* An upright rectangle of two triangles in tiles that lie entirely in the target. Distances count from pixel 0 of the
 * first tile. */
typedef struct lmb_draw_sheet {
    lmb_draw_patch half[2]; /* n1, n2 and q without values at pixel 0 */
    const lmb_draw_plane *plane[2][3]; /* n1, n2 and q of each half */
    double x, y;            /* pixel 0 from the viewport's centre, px */
    int64_t edge;           /* at pixel 0; pixels where edge >= 0 belong to half 0 */
    int32_t edge_x, edge_y; /* per px */
    int32_t x0, y0, x1, y1; /* first and last pixels */
    uint8_t *colour;        /* pixel 0 */
} lmb_draw_sheet;

/* Pixels of a tile that lies entirely in the target. */
typedef struct lmb_draw_put {
    const lmb_draw_state *state;
    uint8_t *colour; /* pixel 0; rows are `stride` bytes apart */
    int32_t stride, swaps; /* swaps: blue is the first byte in memory */
} lmb_draw_put;

/* Pixels of a line: n1 and q at the first pixel of each pixel's tile; columns and rows in the tiles. */
enum { LMB_DRAW_DOTS = 32 };
typedef struct lmb_draw_dots {
    float n1[LMB_DRAW_DOTS], q[LMB_DRAW_DOTS];
    int32_t column[LMB_DRAW_DOTS], row[LMB_DRAW_DOTS];
    int32_t codes[LMB_DRAW_DOTS]; /* of the target, before and after */
} lmb_draw_dots;

/* A triangle in tiles that lie entirely in the target. Distances count from pixel 0 of the first tile. */
typedef struct lmb_draw_area {
    lmb_draw_patch pixels;          /* without values at pixel 0; plane: d, n1, n2 and q */
    const lmb_draw_plane *plane[4];
    double x, y;                    /* pixel 0 from the viewport's centre, px */
    int64_t edge[3];                /* at pixel 0; pixels with all edges >= 0 are inside */
    int32_t edge_x[3], edge_y[3];   /* per px */
    int32_t x0, y0, x1, y1;         /* first and last pixels */
    int32_t tests;                  /* 1: depth test */
    float *depth;                   /* pixel 0 */
    uint8_t *colour;                /* pixel 0 */
} lmb_draw_area;

/* Small triangles in order, with at most one texture, without fog, opaque or blended by alpha. Pixels count in the
 * frame. */
enum { LMB_DRAW_SMALLS = 8 /* of a batch */ };
typedef struct lmb_draw_small {
    const lmb_draw_state *state;
    const float *positions;
    int32_t floats;         /* of a position: 3 or 4 */
    const uint8_t *colours; /* R G B A of a vertex; NULL: the state's */
    const float *uvs;       /* of the first stage's texture; NULL: there is none */
    int32_t middle_x, middle_y; /* viewport's centre, 24.8 */
    float snap_x, snap_y, guard_x, guard_y;
    int32_t x0, y0, x1, y1; /* pixels that may be drawn */
    int32_t right; /* the last column that may be read, and written as it was; at least seven more than the first */
    int32_t target_x, target_y; /* the target's first pixel */
    float *depth; /* NULL: no depth test; rows are depth_step floats apart */
    uint8_t *colour;
    int32_t depth_step, colour_stride;
    int32_t swaps; /* 1: blue is the first byte in memory */
    uint32_t count, drawn; /* triangles, and those of them that may show so far */
    int32_t at[4][LMB_DRAW_SMALLS]; /* vertices, and the one whose colour is that of a flat triangle; all are valid */
} lmb_draw_small;
#endif

enum { LMB_SMALL_24_8 = 64 * 256 /* box sides below this let edges fit 32 bits */ };

#if LMB_PLAIN_LANES == 1
/* A transformed corner. */
typedef struct lmb_batch_corner {
    int32_t x, y; /* 24.8 */
    float d;
    uint32_t vertex, is_out; /* vertex + 1, or 0: none; nonzero: unusable as it is, with a bit per reason */
} lmb_batch_corner;
enum { LMB_BATCH_CORNERS = 32 };
#endif

/* Outcome for up to LMB_BATCH triangles of one instance. Bit k is triangle k. */
typedef struct lmb_batch_sets {
    uint32_t in;      /* present, with all indices inside the mesh */
    uint32_t small, other, dropped; /* the rest of `in` is invisible; other: clipped or large, drawn one by one by
                                       setup.c */
    uint32_t drawn;   /* neither other nor dropped, with area, not culled */
#if LMB_PLAIN_LANES == 1
    lmb_batch_corner kept[LMB_BATCH_CORNERS]; /* vertex cache of the instance, indexed by the low bits of a vertex */
#endif
} lmb_batch_sets;

/* LMB_BATCH triangles side by side. All fields are valid for the triangles in `small`. */
typedef struct lmb_batch {
    int32_t e[3][LMB_BATCH], ex[3][LMB_BATCH], ey[3][LMB_BATCH]; /* at the first pixel of the box's first tile */
    int32_t x0[LMB_BATCH], y0[LMB_BATCH], x1[LMB_BATCH], y1[LMB_BATCH]; /* box: pixels of the frame, clamped to the
                                                                           window */
    double d[LMB_BATCH], dx[LMB_BATCH], dy[LMB_BATCH]; /* depth at the centre of the frame, and per px */
    float d_min[LMB_BATCH], d_max[LMB_BATCH];
    uint32_t id[LMB_BATCH]; /* set by the caller if the window has ids */
    lmb_batch_sets sets;
} lmb_batch;

#if LMB_CULLING
/* Small triangles as bins store them, 32 bytes each: corner a, in 24.8 from the centre of the frame; the offsets of b
 * and c from a, as x + 65536 y; depths; ids. */
typedef struct lmb_bin_block {
    int32_t x[LMB_BATCH], y[LMB_BATCH], to_b[LMB_BATCH], to_c[LMB_BATCH];
    float d[3][LMB_BATCH];
    uint32_t id[LMB_BATCH];
} lmb_bin_block;

/* A batch on the way into bins. `block` holds the `small` triangles, without ids. For the other triangles in `whole`,
 * which no plane cuts, x, y and d of the block, and b and c, hold the corners. */
typedef struct lmb_bin_batch {
    lmb_bin_block block;
    int32_t b[2][LMB_BATCH], c[2][LMB_BATCH]; /* x, y, 24.8 */
    int32_t y0[LMB_BATCH], y1[LMB_BATCH];     /* `small` only: first and last rows of the frame */
    uint32_t whole;
    lmb_batch_sets sets;
} lmb_bin_batch;
#endif

/* Edge i is e >= 0 inside, in units of 1/256 px x px: e(x + 1) = e(x) + ex. */
typedef struct lmb_setup {
    int32_t ex[3], ey[3];
    int64_t e_origin[3]; /* at the frame's centre + (0, 0) in 24.8, with the fill rule, not yet divided by 256 */
    double d_origin, d_x, d_y; /* depth at the centre; per px */
    float d_min, d_max;
    int32_t x_min, x_max, y_min, y_max; /* box, 24.8 */
    int32_t back;        /* back face: clockwise in the picture */
} lmb_setup;

#if LMB_CULLING
/* How small triangles use tile bounds: not at all; skip hidden triangles; skip hidden triangles and raise the
 * bounds. */
enum { LMB_BOUNDS_IDLE, LMB_BOUNDS_READ, LMB_BOUNDS_RAISED };

/* First and last tiles of a window. */
typedef struct lmb_tile_box {
    int32_t x0, x1, y0, y1;
} lmb_tile_box;
#endif

/* A window in memory. Strides are bytes from tile to tile and from one row of tiles to the next. */
typedef struct lmb_fill_window {
    lmb_fill_tile first;
    int32_t depth_tile, depth_row, id_tile, id_row;
    int32_t x0, y0;             /* first pixel of the first tile, px in the frame */
    int32_t tiles_x, tiles_y;
    int32_t origin_x, origin_y; /* as in lmb_setup_job */
    float d_scale, d_bias;
#if LMB_CULLING
    float *farthest; /* per tile, row by row: a lower bound of the tile's depths; not read if LMB_BOUNDS_IDLE */
    int32_t bounds;  /* LMB_BOUNDS_*, for small triangles */
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

/* 1: kernels test tiles against shadow maps. With one lane a loop over pixels is faster. */
#define LMB_SHADOW_LANES (LMB_FACETS && LMB_PLAIN_LANES > 1)

/* One face of a shadow map. */
typedef struct lmb_shadow_job {
    const lmb_view *view;
    const void *id;
    int32_t row, tile, step; /* ids from a row of tiles, a tile and a row of texels to the next one */
    int32_t is_16;           /* 1: LMB_ID16 */
    int32_t face;            /* of a cube; -1: the map has one face */
    lmb_vec3 light;          /* position, for the faces of a cube */
    float size;              /* texels */
} lmb_shadow_job;

enum { LMB_SHADOW_PIXELS = 16, LMB_SHADOW_PAIRS = 16 }; /* at least the lanes of each backend */

/* Pixels of a tile, and triangles that may shadow them. */
typedef struct lmb_shadow_pairs {
    float corner[3][3][LMB_SHADOW_PAIRS]; /* [corner][axis], world */
    int32_t pixel[LMB_SHADOW_PAIRS];
    int32_t count;
    int32_t is_far, is_wide; /* the light is directional; the map is perspective */
    lmb_vec3 light, eye;     /* light: its position, or the direction to it */
} lmb_shadow_pairs;

/* One bit for each pair. through: the triangle's plane contains the pixel's place; the other bits are then wrong.
 * shadows: an opaque triangle shadows the pixel. over: the triangle covers the pixel in the map, but does not
 * shadow the pixel. */
typedef struct lmb_shadow_answers {
    uint32_t through, shadows, over;
} lmb_shadow_answers;

/* Rounding of a pixel's place: shares of the distance from the eye, and of the coordinates. */
#define SHADOW_NOISE_PIXEL 3.0517578e-5f
#define SHADOW_NOISE_PLACE 2.3841858e-7f

/* The pixels of a tile that share a cut of the light tree. */
typedef struct lmb_many_lights_job {
    lmb_vec3 middle, half; /* m: box of the pixels */
    lmb_vec3 normal;       /* of the first pixel, unit */
    float bend;            /* largest difference of a pixel's normal from it, as vectors */
} lmb_many_lights_job;

#define LMB_MANY_LIGHTS_NEAR 1e30f /* error of a node too near for a bound: it is split first */

/* The pixels of one surface in a tile. */
typedef struct lmb_pixel_cluster {
    uint64_t pixels;
    lmb_vec3 centre;  /* of the box of the positions */
    lmb_vec3 axis[3]; /* unit directions of the box sides, at right angles; the first is the mean face normal */
    float half[3];    /* half sides, m */
    lmb_vec3 normal;  /* mean of the pixels' normals */
    float thick;      /* m: largest distance of a position from the centre along `normal` */
    float sine;       /* of the widest angle between a normal and the mean; 1: over 90 degrees */
    float face_sine;  /* the same, for normals and face normals */
    float noise;      /* m: largest rounding error of a position */
} lmb_pixel_cluster;

/* The viewer's depth map for the gather. */
typedef struct lmb_march_job {
    const float *depth_32;    /* one of depth_32 and depth_16 is set */
    const uint16_t *depth_16;
    int32_t tiled, row_step;  /* values from one row of tiles (or pixels) to the next */
    float last_x, last_y;     /* px */
    lmb_vec3 eye, right, up, back;
    float scale_x, scale_y;   /* px per unit of x / w, from the centre */
    float middle_x, middle_y; /* px */
    float near_m, far_m;
    float d16_scale, d16_bias; /* 16-bit code -> d */
    float slack;               /* of d: the error from rounding or from 16 bits */
    int32_t kind, steps, perspective;
} lmb_march_job;

/* A triangle seen from the point `at`. A segment from `at` along d crosses the triangle if every edge . d >= -slack and
 * normal . d > beyond. */
typedef struct lmb_cross_job {
    lmb_vec3 at, edge[3], normal;
    float beyond; /* distance of `at` from the plane, plus noise, m */
    float slack;  /* m3 */
} lmb_cross_job;

/* Asks for a cache line that is needed soon. A macro: gcc drops calls of functions that do nothing else. */
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define LIVE_SOON(p) __builtin_prefetch(p)
#else
#define LIVE_SOON(p) ((void)(p))
#endif

/* A receiver of live light. */
typedef struct lmb_live_job {
    lmb_vec3 position, face, normal;
    int32_t is_bent; /* 1: the shading normal differs from the face normal */
    int32_t can_move; /* 1: a receiver in a concave edge may be moved beside it */
    float split;     /* as in lmb_live */
} lmb_live_job;

/* Nodes that strata of equal light select: 16 times a chunk plus a lane, and the light from there to the node's end. */
typedef struct lmb_live_picks {
    uint16_t node[LMB_LIVE_STRATA];
    float rest[LMB_LIVE_STRATA];
    int32_t count;
} lmb_live_picks;

/* A plane with a triangle, for places in a map. */
typedef struct lmb_live_surface {
    const lmb_view *view;
    lmb_vec3 corner, normal, side[2], along[2]; /* along: give barycentrics */
} lmb_live_surface;

#define LIVE_INSIDE (1.0f / 512.0f) /* min barycentric of a point that was moved onto a triangle */

/* Sixteen points in a map. */
typedef struct lmb_live_spots {
    float sx[LMB_LIVE_NODES], sy[LMB_LIVE_NODES]; /* in the view */
    float place[3][LMB_LIVE_NODES], normal[3][LMB_LIVE_NODES];
} lmb_live_spots;

/* A pixel lit on its own. */
typedef struct lmb_live_sample {
    lmb_vec3 position, face, normal; /* as in lmb_tile */
    float light[3];                  /* irradiance, W/m2 */
    float slope[2][3];               /* gradient of light along columns and rows, W/m2 per px; before that, [0] holds
                                        the unshadowed bounced light, and [1] that of a sky */
    uint32_t id;                     /* the triangle */
    uint8_t is_lit[2];               /* by bounced light and a sky; 0: no light to shade */
    uint16_t seen[2][3];             /* unshadowed share of each channel, 0 .. LIVE_STEPS and 0 .. LIVE_SKY_STEPS */
} lmb_live_sample;

#define LIVE_STEPS     254.0f   /* full values of `seen`; a sky may be seen through small holes */
#define LIVE_SKY_STEPS 65024.0f

#define LIVE_SAME_COS  0.95f /* places share light only if the cosine between their normals is at least this, */
#define LIVE_SAME_LIFT 1e-3f /* and (height over the other's plane / distance)^2 at most this, at equal normals */

/* A cell between four samples, and the pixels of a tile in it. */
typedef struct lmb_live_cell {
    const lmb_live_sample *corner[4]; /* NULL: unknown */
    float x[2], y[2], per_x, per_y;   /* x, y: px in the tile; per_x, per_y: 1 / sides of the cell */
    int32_t even;                     /* 1: all corners have full weight at all pixels */
    uint64_t pixels;                  /* to light, one bit each */
} lmb_live_cell;

/* A triangle for rays to infinity. A ray from `at` + d crosses the triangle if every edge . d + offset >= 0 and normal
 * . d > beyond. */
typedef struct lmb_sun_job {
    lmb_vec3 at, edge[3], normal;
    float offset[3], beyond;
} lmb_sun_job;

/* A box that moves towards a light at infinity. per: 1 / direction along each axis, not 0. */
typedef struct lmb_sun_sweep {
    float low[3], high[3], per[3];
} lmb_sun_sweep;

/* All segments from a point to a box: 1 / distance to the upper and the lower end of the box along each axis, not 0. */
typedef struct lmb_pyramid {
    float at[3], per_high[3], per_low[3];
} lmb_pyramid;

/* A segment from a point. per: 1 / distance to the far end along each axis, or 1e20 if the distance is 0. enter, leave:
 * offsets in lmb_boxes, in floats, of the box sides through which the segment enters and leaves. */
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
    int32_t means;              /* 1: average rays over texels; 0: interpolate each ray */
    int32_t side, cube_at;      /* level and first texel of the cube */
    lmb_vec3 centre, middle;    /* of the cube; of the sphere */
    float radius2, reach;       /* of the sphere, squared; limit of places inside, from the sphere's centre */
    lmb_vec3 low, high;         /* the box */
    lmb_vec3 reach_low, reach_high; /* limits of places inside the box */
    float ray_width;            /* rad */
    int32_t ground_levels, ground_from; /* 0: no ground; first texel of the ground */
    lmb_vec3 ground;            /* corner of the ground with the least x and z, at ground height */
    float ground_width_m, ground_depth_m, ground_per_x, ground_per_z;
    float ground_columns[16], ground_rows[16]; /* by level */
    int32_t ground_at[16];      /* offset from the first texel of the ground */
    float ground_limit[16];     /* rays wider than this, in m, read the next level */
} lmb_world_job;

/* One row of a blur. */
typedef struct lmb_blur_job {
    const float *map;     /* one plane, height rows of width */
    const float *column;  /* weights of the rows; `over` of them lie past a pole, half a turn on */
    const float *row;     /* weights by lag, a full turn */
    int32_t width, height, over;
} lmb_blur_job;

/* Cones of one width through a voxel tree. */
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
    const lmb_relief_view *view[LMB_RELIEF_TILE_VIEWS]; /* views that the pixels sample; ranking does not read it */
    int32_t count, format;
    int32_t aligned;     /* this many views, first in the list, are closest to the eye's direction */
    int32_t steps, pick, sampling, keep;
    int32_t as_is;       /* 1: place hits at the winner's own position, even off the ray */
    int32_t outside;     /* 1: a view is orthographic: it shows the whole model, and rays beside the model miss */
    lmb_vec3 eye, back;  /* of the eye, not of a view */
    int32_t perspective;
    float pixel;         /* side of a pixel, m; perspective: at 1 m */
} lmb_relief_job;

/* Result per pixel, one bit each. Pixels with neither bit are unchanged. */
typedef struct lmb_relief_found {
    uint64_t hit, missed;
} lmb_relief_found;

/* A row of texels of a shadow map. */
typedef struct lmb_texel_row {
    lmb_vec3 right, up, back;    /* of the view */
    lmb_vec3 direction;          /* of the light; cone: difference of the cosines of the cone angles */
    float cos_outer, cone;
    float side_x, side_y, sy;    /* sides of a texel and the row's centre, at distance 1 (m for suns) */
    float finer_x, finer_half;   /* if finer_half > 0, a finer face shows the texels within finer_half of finer_x */
    int32_t is_far, is_coned;    /* as in light_kind.h */
} lmb_texel_row;

/* A leaf of a triangle's bisections. At weights b1 and b2 of the triangle's corners, leaf corner k has the weight
 * weight[0][k] + weight[1][k] b1 + weight[2][k] b2. */
typedef struct lmb_transfer_leaf {
    const float (*weight)[3];
    float corner[3][9]; /* light at the corner: R, G, B; if is_directed, each along x, y, z */
    int32_t is_directed;
} lmb_transfer_leaf;

#if LMB_TREES
/* A triangle with a mask over a tile: the plane, as in raster/plane.h, and values at the corners. */
typedef struct lmb_masked_job {
    const lmb_rays *rays;
    lmb_vec3 corner, plane, g1, g2;
    float w_min, w_max;
    float alpha[3], u[3], v[3];
    float cutoff;
    int32_t hole, solid; /* samples of texels with codes under `hole` are holes, of codes from `solid` on are opaque */
    float behind; /* factor of depths, at most 1 */
    int is_solid; /* 1: the tile has no hole; for the caller */
    const lmb_texture *texture; /* RGBA8 */
} lmb_masked_job;

/* Pairs of a tile's rows, one bit for each pixel. */
typedef struct lmb_masked_parts {
    uint64_t hole, solid;
    int32_t gain; /* pairs that are one of both, less 1 */
} lmb_masked_parts;
#endif

struct lmb_kernels {
    const char *name;
    int32_t lanes;
    /* Sets up `count` <= LMB_BATCH triangles of the mesh, from triangle `first` on. */
    void (*setup)(lmb_batch *out, const lmb_setup_job *job, const lmb_mesh *mesh, uint32_t first, uint32_t count);
    /* Draws the batch's small triangles among `bits`, in order. */
    void (*fill_small)(const lmb_fill_window *window, const lmb_batch *batch, uint32_t bits);
    /* Draws one triangle of any size into the whole window. */
    void (*fill_large)(const lmb_fill_window *window, const lmb_setup *setup, uint32_t id);
    /* Returns the pixels with an id other than 0, one bit each. */
    uint64_t (*resolve_shown)(const uint32_t id[LMB_TILE_PIXELS]);
    /* Assigns slots to the first LMB_SLOTS different ids of the batch's instance among the pixels of `left`, one bit a
     * pixel. `left` has all pixels of an id or none. Returns the pixels that got a slot. */
    uint64_t (*resolve_slots)(lmb_resolve_batch *out, const uint32_t id[LMB_TILE_PIXELS], uint64_t left);
    void (*resolve_setup)(lmb_resolve_batch *inout);
    /* Resolves the batch's pixels. In a tile's first batch, kernels of LMB_TILE lanes or more set all other pixels to 0
     * in every plane that is needed. */
    void (*resolve)(lmb_tile *out, const lmb_resolve_batch *batch);
    /* Multiplies the albedo of pixels that have a slot by the texture's finest level, nearest or bilinear. */
    void (*texture)(lmb_tile *inout, const lmb_resolve_batch *batch, const lmb_texture *texture);
    /* Unshadowed irradiance of each pixel, W/m2. */
    void (*direct)(lmb_irradiance *out, const lmb_tile *tile, const lmb_direct_job *job);
#if LMB_SHADOW_LANES
    /* Tests LMB_SHADOW_PIXELS pixels from `first` on. Returns the pixels that are certainly lit. *in: the pixels in
     * the face. seen: ids of the four texels around each pixel. */
    uint32_t (*shadow_own)(uint32_t *in, uint32_t (*seen)[LMB_SHADOW_PIXELS], const lmb_tile *tile, int first,
                           uint32_t asked, const lmb_shadow_job *job);
    void (*shadow_ask)(lmb_shadow_answers *out, const lmb_shadow_pairs *pairs, const lmb_tile *tile);
    /* Pixels with a surface and light. */
    uint64_t (*direct_shown)(const lmb_irradiance *light, const lmb_tile *tile);
    /* Adds the light of some pixels. */
    void (*direct_add)(lmb_irradiance *inout, const lmb_irradiance *light, uint64_t some);
#endif
#if LMB_BOUNCE
    /* Adds far pairs. Flags near pairs in scratch->near_pixels, one bit a pixel. */
    void (*gather)(lmb_irradiance *inout, lmb_gather_scratch *scratch, const lmb_tile *tile, const lmb_groups *groups,
                   const lmb_march_job *march);
    /* Adds the discs of one near group to the flagged pixels. */
    void (*gather_near)(lmb_irradiance *inout, uint64_t pixels, const lmb_tile *tile, const lmb_point *discs,
                        uint32_t count, const lmb_march_job *march);
#endif
    void (*blend)(lmb_radiance *out, const lmb_tile *tile, const lmb_irradiance *direct,
                  const lmb_irradiance *indirect);
    /* sRGB codes 0 .. 255 of radiance x gain: red in the low bits, then green, blue, and 255. */
    void (*encode)(uint32_t out[LMB_TILE_PIXELS], const lmb_radiance *in, float gain);
    /* (1 + 2^-12)^2 - (1 + 2^-11) with this backend's verbs: 0, or 2^-24 if the compiler fused it. */
    float (*probe)(float one_and_bit);
#if LMB_CULLING
    /* fill_small and fill_large for windows with bounds: they use and raise the bounds. */
    void (*culled_small)(const lmb_fill_window *window, const lmb_batch *batch, uint32_t bits);
    void (*culled_large)(const lmb_fill_window *window, const lmb_setup *setup, uint32_t id);
    /* Returns 1 if each tile of the box is at least as near as `nearest` throughout. Recomputes bounds below
     * `nearest`. */
    int (*culled_box)(const lmb_fill_window *window, const lmb_tile_box *box, float nearest);
    /* The first half of setup. */
    void (*bin_snap)(lmb_bin_batch *out, const lmb_setup_job *job, const lmb_mesh *mesh, uint32_t first,
                     uint32_t count);
    /* The second half of setup, for the first `count` triangles of a block, with ids. Reads only the window of the
     * job. */
    void (*bin_setup)(lmb_batch *out, const lmb_setup_job *job, const lmb_bin_block *block, uint32_t count);
    /* The tiles of a window that triangles of a full block may show in. Returns the nearest depth of the corners. */
    float (*bin_box)(lmb_tile_box *out, const lmb_setup_job *job, const lmb_bin_block *block);
#endif
#if LMB_TREES
    /* Returns the pixels of a tile that a triangle with a mask covers, and that are nearer than the tile's depths.
     * Reads only `behind` of the last argument. NULL in plain C, as are the next two: they would save nothing. */
    uint64_t (*masked_seen)(const lmb_fill_tile *tile, const lmb_fill_job *job, const lmb_masked_job *masked);
    /* Finds pairs of rows of a tile inside all edges that are all hole or all solid, among those with pixels in `seen`,
     * by the texels that they can sample. */
    void (*masked_parts)(lmb_masked_parts *out, const lmb_masked_job *masked, uint64_t seen);
    /* Draws the pixels in `seen`. solid: those of whole pairs of rows that need no test of alpha. */
    void (*fill_masked)(const lmb_fill_tile *tile, const lmb_fill_job *job, const lmb_masked_job *masked,
                        uint64_t seen, uint64_t solid);
    /* Adds the light of emitters that some pixels see. `pairs` is scratch. */
    void (*gather_cut)(lmb_irradiance *inout, float (*pairs)[LMB_GATHER_PAIRS], const lmb_tile *tile,
                       const lmb_emitter *emitters, int32_t count);
    /* Sets the light, the upper bound and the error of nodes 0 .. count - 1 for the pixel cluster. Returns the nodes
     * that do not face away, one bit each; values of other nodes are undefined. conservative: see node_bounds.inl.
     * Writes whole vectors. */
    uint32_t (*node_bounds)(lmb_node_bounds *inout, int32_t count, const lmb_pixel_cluster *cluster,
                            int32_t conservative);
    /* Returns those of `pixels`, one bit each, with a segment to the point that crosses the triangle. */
    uint64_t (*crossed)(const lmb_tile *tile, uint64_t pixels, const lmb_cross_job *job);
    void (*segments)(lmb_segments *out, const lmb_tile *tile, lmb_vec3 at);
    /* Returns those of `pixels` with a segment that meets box i. */
    uint64_t (*through)(const lmb_segments *segments, uint64_t pixels, const lmb_boxes *boxes, int i);
    /* Returns the boxes that the pyramid may meet, one bit each. */
    uint32_t (*meets)(const lmb_pyramid *pyramid, const lmb_boxes *boxes);
    /* Returns the boxes that one segment meets. */
    uint32_t (*meets_one)(const lmb_segment *segment, const lmb_boxes *boxes);
    /* `crossed` and `meets` for a light at infinity. */
    uint64_t (*sun_crossed)(const lmb_tile *tile, uint64_t pixels, const lmb_sun_job *job);
    uint32_t (*sun_meets)(const lmb_sun_sweep *sweep, const lmb_boxes *boxes);
    /* For `count` <= 8 nodes of one kind from `first`: error is an upper bound of the error of one light in place of
     * the node (< 0: no pixel is lit; or LMB_MANY_LIGHTS_NEAR). light is the estimate. inside is the estimate without
     * cone fall-off. All are unshadowed, W/m2. Writes up to 16 values each. */
    void (*many_lights_bounds)(float error[16], float light[16], float inside[16], const lmb_many_lights *many_lights,
                               uint32_t first, uint32_t count, const lmb_many_lights_job *job);
    /* Adds what lobes reflect of emitters that some pixels see. */
    void (*glossy_cut)(lmb_glossy *inout, const lmb_tile *tile, const lmb_emitter *emitters, int32_t count);
    /* Adds the light of the lights on `pixels`. */
    void (*many_lights_irradiance)(lmb_irradiance *inout, const lmb_tile *tile, uint64_t pixels,
                                   const lmb_active_light *active_lights, int32_t count);
#endif
#if LMB_LOBES
    /* Adds what lobes reflect of one light with the irradiance `lit`. */
    void (*glossy_direct)(lmb_glossy *inout, const lmb_tile *tile, const lmb_irradiance *lit, const lmb_light *light);
#endif
#if LMB_TRANSFER
    /* Sums R, G and B of the nodes times the weights of the links; the fourth value of each node is 0. The links are
     * those of lmb_transfer's receivers, or of its clusters, along x, y and z. */
    void (*transfer_links)(int32_t out[3], const uint32_t *link, uint32_t count, uint16_t (*node)[4]);
    void (*transfer_directed_links)(int32_t out[3][3], const uint32_t *link, uint32_t count, uint16_t (*node)[4]);
    /* The power through texels with centres at sx[0 .. count - 1], for 1 W/sr (1 W/m2 of suns). Reads and writes whole
     * vectors. */
    void (*texel_powers)(float *out, const float *sx, int32_t count, const lmb_texel_row *row);
    /* Shares of triangles in the `cells` x `cells` cells of a block with its first cell at `at` of the face. May write
     * other cells. Id 0 is the background. */
    void (*transfer_share)(float out[LMB_TRANSFER_SHARING][LMB_TRANSFER_BLOCK_CELLS], const lmb_transfer_shown *shown,
                           int32_t count, const float at[2], int32_t cells);
    /* Splits the light of blocks in `rows`, one bit each, by the line line[0] + line[1] column + line[2] row = 0.
     * `light` keeps the second half. Other rows are not read but may be written. Returns a bit for each row that has
     * light in the first half, and from bit 8 on, in the second half. Light: whole numbers up to 2^24. */
    uint32_t (*transfer_halve)(float first[LMB_TILE_PIXELS], float light[LMB_TILE_PIXELS], const float line[3],
                               uint32_t rows);
    /* Returns those of the tile's pixels `left`, at least one, that show the first one's triangle from the same side,
     * one bit each. Sets b1 and b2 for these pixels, and may set them for others. */
    uint64_t (*transfer_side)(float weight[2][LMB_TILE_PIXELS], const lmb_tile *tile, uint64_t left,
                              const lmb_transfer_triangle *triangle);
    /* Returns those of such pixels that are on the leaf; the first always counts as on it. Adds the leaf's light,
     * clamped to 0 from below. If `glossy` is not NULL, adds what lobes reflect of it. */
    uint64_t (*transfer_leaf)(lmb_irradiance *inout, lmb_glossy *glossy, float weight[2][LMB_TILE_PIXELS],
                              const lmb_tile *tile, uint64_t left, const lmb_transfer_leaf *leaf);
#endif
#if LMB_PROBES
    /* Radiance of `count` directions from one place, 3 planes. `direction`: as in lmb_probe_table. */
    void (*remap)(float *out, const uint16_t *direction, int32_t count, lmb_vec3 at, const lmb_world_job *job);
    /* Radiance of one ray a pixel. Directions are unit vectors. */
    void (*see)(float out[3][LMB_TILE_PIXELS], float origin[3][LMB_TILE_PIXELS], float direction[3][LMB_TILE_PIXELS],
                const lmb_world_job *job);
    /* Radiance of the job's cube only, along directions of any length. */
    void (*world_radiance)(float out[3][LMB_TILE_PIXELS], float direction[3][LMB_TILE_PIXELS],
                           const lmb_world_job *job);
    /* Adds the light of a map to `shared` of lmb_probe_lights. */
    void (*share)(float (*shared)[4], const float *map, const lmb_probe_table *table);
    /* Irradiance by normal. `direction`: of the lights, 3 planes. */
    void (*cosine)(float out[3][LMB_TILE_PIXELS], float normal[3][LMB_TILE_PIXELS], const lmb_probe_lights *lights,
                   const float *direction);
    /* Adds to a row. `line`: scratch, 4 x width. */
    void (*blur)(float *inout, float *line, const lmb_blur_job *job);
#endif
#if LMB_VOXELS
    /* Traces a cone from each pixel of the tile along `direction`. Results of pixels without a surface are
     * undefined. */
    void (*cone)(lmb_cone_seen *out, const lmb_cone_job *job, const lmb_tile *tile,
                 float direction[3][LMB_TILE_PIXELS]);
#endif
#if LMB_RELIEF
    /* Adds a vote for each of the three views that suit a pixel best. */
    void (*relief_rank)(uint8_t votes[LMB_RELIEF_VIEWS], const lmb_tile *tile, const lmb_relief *relief,
                        const lmb_relief_job *job);
    /* Writes the complex surface to pixels that hit it; leaves all others. */
    void (*relief_warp)(lmb_relief_found *out, lmb_tile *inout, const lmb_relief_job *job);
#endif
#if LMB_LIVE
    /* Values of the cut's chunks from inout->done on, and those that near nodes need. */
    void (*live_values)(lmb_live_scratch *inout, const lmb_live *live, const lmb_live_job *job);
    /* Sets place and normal of the points of the mask `asked` on a plane. Returns those that exist. */
    uint32_t (*live_places)(lmb_live_spots *inout, const lmb_live_surface *plane, uint32_t asked);
    /* Sums of the cut's chunks, and the cut's light. Returns the sum of all. */
    float (*live_sums)(float light[3], lmb_live_scratch *inout);
    /* Samples a target from each of `strata` strata of the cut, at `place` of each, into inout->rays. `all` > 0: the
     * result of live_sums. Writes whole vectors. */
    void (*live_targets)(lmb_live_scratch *inout, const lmb_live *live, int32_t strata, float place, float all);
    /* For light from infinity: live_sky sets the values and sums of the sky's chunks, and their light, and returns the
     * sum of all. live_picks selects nodes as live_targets does. live_above completes scratch->rays, returns the
     * targets above the receiver's horizon and clears the colours of the others. */
    float (*live_sky)(float light[3], lmb_live_scratch *inout, const lmb_live_sky *sky, const lmb_live_job *job);
    void (*live_picks)(lmb_live_picks *out, const lmb_live_scratch *scratch, int32_t strata, float place, float all);
    uint64_t (*live_above)(lmb_live_scratch *inout, const lmb_live_receiver *at);
    /* live_ahead returns the targets that may light the receiver. live_share adds the colours of all targets to `all`
     * and of those `seen` to `some`. */
    uint64_t (*live_ahead)(const lmb_live_rays *rays, int32_t targets, const lmb_live_receiver *at);
    void (*live_share)(float all[3], float some[3], const lmb_live_rays *rays, int32_t targets, uint64_t seen);
    /* Find the segments of `asked` that meet each box of a node, returning the mask of boxes that any meets, whose
     * entries are set: segments 0 .. 31, then 32 .. 63; those that end beyond a triangle's plane; and of these those
     * that cross the triangle. */
    uint32_t (*live_boxes)(uint32_t out[2][LMB_BOXES], const lmb_segments *segments, uint64_t asked,
                           const lmb_boxes *boxes);
    uint64_t (*live_beyond)(float (*to)[LMB_TILE_PIXELS], uint64_t asked, const lmb_cross_job *job);
    uint64_t (*live_crossed)(float (*to)[LMB_TILE_PIXELS], uint64_t asked, const lmb_cross_job *job);
    /* Lights the pixels of a cell and no others. Returns the pixels that no corner explains. */
    uint64_t (*live_fill)(lmb_irradiance *inout, const lmb_tile *tile, const lmb_live_cell *cell);
#endif
#if LMB_DRAW_LANES
    /* Returns the pixels of the tile with e + ex x + ey y >= 0 for all three edges. */
    uint64_t (*draw_cover)(const int32_t e[3], const int32_t ex[3], const int32_t ey[3]);
    /* Returns the pixels of `mask` that pass the depth test, and stores their depths. */
    uint64_t (*draw_test)(const lmb_draw_patch *pixels, uint64_t mask);
    /* Colours the pixels of `mask`. */
    void (*draw_paint)(const lmb_draw_patch *pixels, uint64_t mask);
    /* Colours all pixels of the sheet, without fog and with at most one texture; changes its halves. Plain C: NULL. */
    void (*draw_sheet)(lmb_draw_sheet *sheet);
    /* Draws the pixels of a triangle with at most one texture; changes `pixels`. Plain C: NULL. */
    void (*draw_area)(lmb_draw_area *area);
    /* Draws triangles up to the first that needs another path. Returns that, or the count. Plain C: NULL. */
    uint32_t (*draw_small)(lmb_draw_small *inout);
    /* Values 0 and 1 of the pixels of `mask`, and any values of others. Plain C: NULL. */
    void (*draw_shares)(float out[2][LMB_TILE_PIXELS], const lmb_draw_patch *pixels, uint64_t mask);
    /* Changes of the same values per px. Plain C: NULL. */
    void (*draw_steps)(float by_x[2][LMB_TILE_PIXELS], float by_y[2][LMB_TILE_PIXELS], const lmb_draw_patch *pixels,
                       uint64_t mask);
    /* Colours `count` pixels of a line without texture and fog, opaque or blended by alpha. Plain C: NULL. */
    void (*draw_dots)(lmb_draw_dots *inout, const lmb_draw_patch *pixels, int32_t count);
    /* Writes codes R G B A of the pixels of `mask`, opaque or blended by alpha. Plain C: NULL. */
    void (*draw_put)(const lmb_draw_put *to, const uint8_t (*codes)[4], uint64_t mask);
    /* Blends R G B A, in the order of the pixels' bytes, onto rows `stride` bytes apart: over them by the share
     * A, or added. */
    void (*draw_fill)(uint8_t *row, int32_t stride, int32_t width, int32_t height, uint32_t codes, int adds);
#endif
};

/* The kernels of this build: see backends.h. */
#define LMB_KERNELS_OF(upper, lower) extern const lmb_kernels lmb_kernels_##lower;
LMB_BACKENDS(LMB_KERNELS_OF)
#undef LMB_KERNELS_OF
#if LMB_DRAW_LANES
uint32_t lmb_draw_small_avx2(lmb_draw_small *inout); /* AVX-512 uses it too */
#endif

#endif
