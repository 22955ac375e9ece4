/* kernels.h: the table of kernels that a machine fills in: the only door to isa/. Floor 2.
 *
 * A kernel is a pure function over public structs and the plain jobs below. Same inputs, same bytes, every machine. */
#ifndef LMB_LANE_KERNELS_H
#define LMB_LANE_KERNELS_H

#include <lambent/bounce.h>
#include <lambent/compose.h>

#include "machines.h"

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

/* One triangle's attributes over a tile, everything relative to the eye.
 *   ray of pixel (x, y):  origin + ox x + oy y  +  w (direction + rx x + ry y)   with w along the view axis.
 * Perspective: the first part is 0; orthographic: the direction is constant. */
typedef struct lmb_resolve_job {
    lmb_vec3 origin, ox, oy;
    lmb_vec3 direction, rx, ry;
    lmb_vec3 eye;
    lmb_vec3 corner;         /* vertex 0, relative to the eye */
    lmb_vec3 plane;          /* normal of the triangle, any length */
    float w_min, w_max;      /* of the triangle's corners */
    lmb_vec3 g1, g2;         /* barycentrics: b1 = (p - corner).g1, b2 = (p - corner).g2 */
    lmb_vec3 face;           /* unit normal, turned to the viewer */
    lmb_vec3 normal[3];      /* at the corners */
    float albedo[3][3];      /* [channel][corner] */
    float uv[2][3];          /* [u, v][corner] */
    uint32_t id;
    int32_t smooth;          /* normal[] differs from face */
} lmb_resolve_job;

/* One light over a tile. */
typedef struct lmb_direct_job {
    lmb_vec3 position, direction;
    float intensity[3];
    float cos_outer, cone_scale; /* fall-off t = (cos - cos_outer) * cone_scale */
    int32_t kind;
} lmb_direct_job;

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

struct lmb_kernels {
    const char *name;
    int32_t lanes;
    void (*fill)(const lmb_fill_tile *tile, const lmb_fill_job *job);
    void (*resolve)(lmb_tile *out, const lmb_resolve_job *job);
    /* W/m2 at each pixel if nothing shadowed it. */
    void (*direct)(lmb_irradiance *out, const lmb_tile *tile, const lmb_direct_job *job);
    /* Far pairs are added; near ones flagged in near_pixels, one bit a pixel. */
    void (*gather)(lmb_irradiance *inout, uint64_t *near_pixels, const lmb_tile *tile, const lmb_groups *groups,
                   const lmb_march_job *march);
    /* The flagged pixels of one near group, through its discs. */
    void (*gather_near)(lmb_irradiance *inout, uint64_t pixels, const lmb_tile *tile, const lmb_point *discs,
                        uint32_t count, const lmb_march_job *march);
    void (*blend)(lmb_radiance *out, const lmb_tile *tile, const lmb_irradiance *direct,
                  const lmb_irradiance *indirect);
    /* (1 + 2^-12)^2 - (1 + 2^-11) by this machine's verbs: 0, or 2^-24 where the compiler fused it. */
    float (*probe)(float one_and_bit);
};

/* Those of this build: see machines.h. */
extern const lmb_kernels lmb_kernels_scalar, lmb_kernels_sse2, lmb_kernels_avx2, lmb_kernels_avx512, lmb_kernels_neon,
    lmb_kernels_simd128;

#endif
