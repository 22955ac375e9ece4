/* relief.h: a complex model's surface on a simple one, from reference views that are looked up pixel by pixel. [P1-P12]
 *
 *     lmb_relief_open(&relief, file, bytes);            in place: a .lmr in flash or RAM, made by `lambent relief bake`
 *     lmb_relief_scene(&scene, &relief);                the simple model, to draw
 *     lmb_draw, lmb_resolve_tile                        as usual
 *     lmb_relief_tile(&tile, ...);                      position, normal, albedo, depth of the complex surface
 *     direct light, gathers, lmb_compose_tile           as usual
 *
 * A .lmr, version 1. All but the texels is in the byte order that word 1 shows; offsets are bytes from the file's
 * start, multiples of 4; no two arrays share a byte.
 *   word  0  the bytes L M R 1            word  8  offset of positions, 3 floats a vertex
 *         1  0x01020304                         9  of normals, octahedral, 2 int16 a vertex
 *         2  bytes of the file                 10  of colours, RGBA8 linear; 0: none
 *         3  LMB_RELIEF_FULL or _PACKED        11  of indices, 3 a triangle
 *         4  views, 1 .. LMB_RELIEF_VIEWS      12  LMB_INDEX_U16 or LMB_INDEX_U32
 *         5  offset of their records           13  0
 *         6  vertices of the simple model      14  0
 *         7  triangles                         15  FNV-1a, 32 bits, of all other bytes; 0: none
 * A view's record, 20 words: eye, right, up, back (3 floats each), half_width, half_height, near_m, far_m, as in
 * lmb_view; LMB_PERSPECTIVE or LMB_ORTHOGRAPHIC; width, height, texels, 2 .. 4096; offset of the texels.
 * An orthographic view shows all of the model. Texels, row by row from the top, the low byte first on every target:
 *   FULL    three planes: depth code 1 .. 2^24 - 1, 0 nothing; R G B (sRGB) and 255; normal, two int16
 *   PACKED  two planes: 16 bits of depth, then B5 G6 R5 above them; normal, two int8, in a plane of 16-bit words that
 *           ends on a multiple of 4 bytes                                                                       [P10]
 * Normals are octahedral (of int8: code / 127), world axes. Depth d of lmb_view is min + code (1 - min) / max; min is 0
 * (orthographic) or near_m / far_m (perspective), and max is the largest code.
 *
 * Stability: experimental. Tags like [P1] are requirements in src/SOURCES.md. */
#ifndef LMB_RELIEF_H
#define LMB_RELIEF_H

#include "map.h"

enum { LMB_RELIEF_FULL = 0, LMB_RELIEF_PACKED = 1 };
enum { LMB_RELIEF_HEADER_WORDS = 16, LMB_RELIEF_VIEW_WORDS = 20 };

/* A reference view, prepared for lookups. Texel (i, j) has its centre at (i, j). */
typedef struct lmb_relief_view {
    const uint8_t *texels;
    int32_t width, height, perspective;
    float to_view[4][4];  /* times (x, y, z, 1): u w, v w, d w, w, in texels; orthographic: w is 1 */
    lmb_vec3 corner, per_u, per_v; /* position of a texel: corner + u per_u + v per_v; perspective: the ray's
                                      direction */
    lmb_vec3 eye, back;   /* a point m along the ray from the eye's plane: position - m back; perspective: eye + m
                             ray */
    float min, per_code; /* d of a depth code */
    float z_at_0, z_per_d; /* m along the axis: orthographic z_at_0 + z_per_d d; perspective near_m / d */
    float near_m;
    float texel;          /* m of a texel's side; perspective: at 1 m */
} lmb_relief_view;

typedef struct lmb_relief {
    lmb_relief_view view[LMB_RELIEF_VIEWS];
    int32_t views, format;
    lmb_mesh mesh;        /* the simple model; the streams lie in the file */
    lmb_material material;
    lmb_instance instance;
    lmb_vec3 low, high;   /* bounds of the simple model */
} lmb_relief;

enum { LMB_RELIEF_NEAREST_P = 0, LMB_RELIEF_EYE_RAY = 1 };

/* Parameters of lookups in reference views. Zeros select the defaults. */
typedef struct lmb_relief_how {
    int32_t steps;    /* lookups along a pixel's ray, 1 .. 32; 0: 6; 1: one, at the simple surface */
    int32_t pick;     /* the candidate to use: the one nearest to P, or to the eye's ray [P5] */
    int32_t sampling; /* 0: interpolate texels; 1: use the nearest texel */
    int32_t views;    /* views read for one pixel: 1 .. 8; 0: 6 */
    int32_t keep;     /* views that are blended, the best of those: 1 .. 3; 0: 3 */
} lmb_relief_how;

/* Pixel counts, added up. */
typedef struct lmb_relief_stats {
    uint64_t pixels;  /* of the simple model, including mended gaps in it */
    uint64_t hits;    /* pixels that show the complex surface */
    uint64_t missed;  /* pixels with rays that miss the complex surface: cleared */
    uint64_t holes;   /* pixels that no view shows: they keep the simple model's surface [P12] */
} lmb_relief_stats;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_relief_open: check a .lmr and find the parts. Nothing is copied: keep `data` as long as you use `out`.
 *
 * Returns LMB_OK, LMB_ERR_ARG (null), LMB_ERR_ALIGN (data not on 4 bytes), LMB_ERR_FORMAT (no .lmr of version 1, cut
 * off, the other byte order: lmb_relief_swap; an invalid view or offset, arrays that overlap), LMB_ERR_CAPACITY (more
 * views than LMB_RELIEF_VIEWS): then `out` is unchanged. Every accepted file is safe to draw, because draws check each
 * index. */
lmb_status lmb_relief_open(lmb_relief *out, const void *data, size_t bytes);

/* lmb_relief_swap: convert a file of the other byte order to this target's, in RAM. Files in native order are
 * unchanged. Returns LMB_OK, or an error as lmb_relief_open; then the contents of `data` are undefined. */
lmb_status lmb_relief_swap(void *data, size_t bytes);

/* lmb_relief_scene: the simple model as a scene without lights. Points into `relief`. */
void lmb_relief_scene(lmb_scene *out, const lmb_relief *relief);

/* lmb_relief_tile: replace the simple surface by the complex one.                                  [P2 P3 P4 P5 P6 P12]
 *
 *   inout  resolved for `view` from a target that holds only the simple model. Position, face, normal, albedo and depth
 *          become the complex surface's; pixels with rays that miss it are cleared.
 *   stats  added to; may be NULL.
 *   how    NULL: the default.
 * A tile reads the views that see the simple surface best. At a point of the eye's ray each view gives the surface that
 * it shows there; the nearest of these surfaces gives the step along the ray to the next lookup [P5]; texels beyond a
 * jump of depth do not count [P12]. When the point no longer moves, the best three views are blended. A point that some
 * view sees through is no surface. Rays can slip between two views' texels: a pixel that differs from its neighbours in
 * the tile (a hole, a speck, another depth) takes the surface that most of them show.
 * Returns LMB_OK or LMB_ERR_ARG. Cost: 64 pixels x views x steps, independent of the complex model. */
lmb_status lmb_relief_tile(lmb_tile *inout, const lmb_kernels *kernels, const lmb_relief *relief,
                           const lmb_view *view, const lmb_relief_how *how, lmb_relief_stats *stats);

/* lmb_relief_nearer: write the nearer surface of each pixel of two tiles at one place into `inout`. [P11]
 * Ids of `other` become LMB_MAX_TRIANGLES, so that they match no scene's triangles. */
void lmb_relief_nearer(lmb_tile *inout, const lmb_tile *other);

/* lmb_relief_shadow_rows: the shadow map of a relief: tile rows `first` .. `past` - 1, with faces below each other as
 * in lmb_shadow_map_rows. First fill the map with the simple model by lmb_shadow_map_draw; float depth becomes the
 * complex surface's.                                                                                               [P7]
 *   tile   scratch
 * Cost is per warped texel; texels finer than about 3/4 of the views' texels show no more detail.
 * Returns LMB_OK, LMB_ERR_ARG or LMB_ERR_FORMAT (16-bit depth). */
lmb_status lmb_relief_shadow_rows(const lmb_shadow_map *map, const lmb_kernels *kernels, lmb_tile *tile,
                                  const lmb_relief *relief, const lmb_relief_how *how, int32_t first, int32_t past);

/* lmb_relief_lit: the pixels of a tile, a bit each, that nothing in such a map shadows: pixels of the relief and of
 * other surfaces.                                                                                               [P8 P9]
 * A pixel is tested against the four texels around its position in the map: each against the pixel's own plane there,
 * with a margin of a texel for the plane's error. The majority of the four, weighted bilinearly, decides. If a pixel
 * has at least three neighbours in the tile and differs from all of them, it takes their result. */
uint64_t lmb_relief_lit(const lmb_shadow_map *map, const lmb_light *light, const lmb_tile *tile);

#ifdef __cplusplus
}
#endif
#endif
