/* types.h: the common types: status, vectors, views, surfaces, statistics.
 *
 * Conventions (glTF 2.0's): metres, right-handed, +Y up, a camera looks down -Z, counter-clockwise front faces, linear
 * RGB, column-major matrices. Pixel (x, y) has its centre at (x + 0.5, y + 0.5); y = 0 is the top row.
 *
 * Glossary
 *   first point  a lit surface element of the shadow map: one texel, or several                     [V4]
 *   disc         a first point joined with its neighbours                                           [V12]
 *   group        discs gathered into one emitter                                                    [V19]
 *   flux         outgoing Lambertian power of an emitter, W: reflectance x incident power
 *   tile, band   8x8 pixels; 8 rows of the frame. The band is the unit of work
 *   window       the part of a frame that a surface holds
 *   near         a pixel so close to an emitter that the emitter's parts and shape count
 *
 * Stability: stable. Tags like [V4] are requirements in src/SOURCES.md. */
#ifndef LMB_TYPES_H
#define LMB_TYPES_H

#include <stddef.h>
#include <stdint.h>

#include "config.h"

/* 0 is success, a positive status is success with more to do, a negative one is an error.
 *
 * You may pass any call NULL, structs of zeros and numbers out of range. Calls that return a status then return
 * LMB_ERR_ARG or another error, or LMB_OK if zeros mean that there is nothing to do. All others return 0 or NULL, set
 * their outputs to 0 if they can, and write nothing else. No call can check that your arrays and memory are as large as
 * the sizes that you pass. */
typedef enum lmb_status {
    LMB_OK = 0,
    LMB_MORE = 1,          /* lmb_render_step: call again */
    LMB_ERR_ARG = -1,      /* a null pointer, a size, a range */
    LMB_ERR_CAPACITY = -2, /* a caller's array or a configured capacity is too small */
    LMB_ERR_ALIGN = -3,    /* scene data not 4-byte aligned */
    LMB_ERR_FORMAT = -4,   /* the call does not take this format of surface or stream */
    LMB_ERR_SCENE = -5,    /* an index that points outside the scene */
    LMB_ERR_BUILD = -6     /* compiled so that bytes would differ: see lmb_build_check */
} lmb_status;

typedef struct lmb_vec3 {
    float x, y, z;
} lmb_vec3;

typedef struct lmb_mat4 {
    float m[16]; /* column-major: m[4 * column + row] */
} lmb_mat4;

/* The view of a camera, or of one face of a shadow map. The axes are orthonormal: right x up = back.
 * Depth is d = z_clip / w_clip of a reversed projection: larger is nearer, 0 is nothing, affine in screen space.
 *   perspective   d = near_m / w, no far plane          orthographic   d = (far_m - w) / (far_m - near_m)
 * with w the distance along -back, in metres. */
enum { LMB_PERSPECTIVE = 0, LMB_ORTHOGRAPHIC = 1 };
typedef struct lmb_view {
    lmb_vec3 eye;
    lmb_vec3 right, up, back;
    float half_width, half_height;     /* perspective: tangents of the half angles; orthographic: metres */
    float near_m, far_m;               /* near_m and the half sizes > 1e-30; orthographic: near_m < far_m, and near_m <
                                          -1e-30 if it is behind the eye. far_m: orthographic views, 16-bit depth */
    int32_t kind;                      /* LMB_PERSPECTIVE or LMB_ORTHOGRAPHIC */
    int32_t frame_width, frame_height; /* px of the whole frame, <= LMB_MAX_FRAME */
    int32_t sample_x, sample_y; /* the sample's position in each pixel, from the centre to the right and down, 1/256 px:
                                   -128 .. 127; 0 in builds without LMB_MULTISAMPLE */
} lmb_view;

/* Pixel formats. Depth and id surfaces hold whole tiles: lmb_surface_bytes gives their size. */
typedef enum lmb_format {
    LMB_FORMAT_NONE = 0,
    LMB_RGB565,    /* 16 bit in native byte order, red in the high bits */
    LMB_RGB555,    /* the same, top bit 0 */
    LMB_RGB565_BE, /* bytes RRRRRGGG GGGBBBBB on every processor: as SPI displays take them */
    LMB_RGBA8,     /* bytes R G B A */
    LMB_BGRA8,     /* bytes B G R A */
    LMB_R32F,
    LMB_RGB32F,
    LMB_DEPTH32F,
    LMB_DEPTH16, /* 0 nothing, else 1 + 65534 (d - d_far) / (1 - d_far): occlusion only */
    LMB_ID16,
    LMB_ID32
} lmb_format;

/* LINEAR: rows. TILED: 8x8 tiles of 64 values, tile rows from the top (depth and id only); stride_bytes is then the
 * step from one row of tiles to the next. */
enum { LMB_LINEAR = 0, LMB_TILED = 1 };

/* Your pixels. The library owns no memory: lmb_frame and lmb_render hold your pointers. */
typedef struct lmb_surface {
    void *data;            /* first row (LINEAR), first tile (TILED); NULL: no surface */
    int32_t width, height; /* px, <= LMB_MAX_SIDE */
    int32_t stride_bytes;  /* may be negative for colour (bottom-up pictures) */
    uint8_t format;        /* lmb_format */
    uint8_t layout;        /* LMB_LINEAR or LMB_TILED */
    uint16_t reserved;     /* 0 */
} lmb_surface;

/* Counts of work done and input dropped: bad data is counted, never an error. Counters only grow: zero them
 * yourself. */
typedef struct lmb_stats {
    uint32_t triangles;         /* read */
    uint32_t triangles_drawn;   /* reached the fill */
    uint32_t triangles_dropped; /* a vertex not finite or too far away, or an index outside the mesh */
    uint32_t first_points;
    uint32_t discs;
    uint32_t groups;
    uint32_t regroups; /* times grouping restarted because LMB_MAX_GROUPS was reached */
    uint32_t bands;
    uint64_t pairs, segments; /* LMB_GROUP_CUT: pixels x nodes that light them; segments tested for visibility */
    uint64_t corner_segments; /* segments to a light from pixels whose shadow map may not show the corner of a room */
    uint64_t full_cuts;       /* pixel clusters lit by too few nodes because LMB_MAX_CUT was reached; and points of
                                 lmb_live for which LMB_LIVE_CUT or LMB_LIVE_NEAR was reached */
    uint32_t tiles;           /* tiles lit by cuts of many lights or of trees, once for each */
    uint32_t coarse_tiles;    /* of these, tiles with coarser visibility because tests ran out: see lmb_occluded_tile */
    double flux_lit;          /* W: outgoing power of all first points, sum of R, G, B */
    double flux_grouped;      /* W: the same over the groups; less only if strict zones drop some [V20] */
} lmb_stats;

/* Stability between versions. The first comment of each header states its stability:
 *
 *                     patch   minor                                       major
 *   stable, before 1.0  no    may change or go; listed in NEWS.md         -
 *   stable, from 1.0    no    additions only                              may change or go
 *   experimental        no    may change or go; listed in NEWS.md         may change or go
 *   pixels              no    may change; NEWS.md lists which, and why    may change
 *   .lmp files          no    files of older versions stay readable       may be refused
 *   .lmt, .lmr files    no    may be refused, with LMB_ERR_FORMAT         may be refused
 *
 * Members of structs that their header does not describe are experimental, and so are structs of experimental headers
 * inside stable ones. All builds of one version and configuration draw the same pixels: with every compiler, processor,
 * back end and number of threads. */
#define LMB_VERSION_MAJOR 0
#define LMB_VERSION_MINOR 1
#define LMB_VERSION_PATCH 0
/* As one number, for #if: 100 is 0.1.0. */
#define LMB_VERSION (LMB_VERSION_MAJOR * 10000 + LMB_VERSION_MINOR * 100 + LMB_VERSION_PATCH)

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_status_name: "LMB_OK", "LMB_ERR_ARG", ...; "?" for any other number. Never NULL. */
const char *lmb_status_name(lmb_status status);

/* lmb_build_check: check that this build draws the same bytes as all other builds.
 *
 * Tests at run time that floats are IEEE binary32 without excess precision, that no backend's kernels contract a
 * multiply and an add, that denormals are not flushed, that shifts are arithmetic, and that none of the known compiler
 * faults is present (clang 14 for 32-bit MIPS, tcc 0.9.27). Returns LMB_OK or LMB_ERR_BUILD. Call it once at start. */
lmb_status lmb_build_check(void);

/* lmb_view_sample: set sample_x and sample_y to sample i of `samples` (1, 4, 8 or 16) a pixel. The patterns are the
 * standard ones of Direct3D 11 and Vulkan: nearly horizontal and nearly vertical edges meet each sample of 4 or 8 at
 * another place. Returns LMB_OK or LMB_ERR_ARG. Missing in builds without LMB_MULTISAMPLE. */
lmb_status lmb_view_sample(lmb_view *inout, int32_t samples, int32_t i);

/* lmb_view_look_at: a perspective view from `eye` towards `target`.
 *
 *   vfov_rad  vertical angle of view, 1e-29 < vfov_rad < pi.   width, height  the frame, px; pixels are square.
 * Returns LMB_OK, or LMB_ERR_ARG (target at eye, up along the view, sizes outside): then `out` is unchanged. */
lmb_status lmb_view_look_at(lmb_view *out, lmb_vec3 eye, lmb_vec3 target, lmb_vec3 up, float vfov_rad, int32_t width,
                            int32_t height);

#ifdef __cplusplus
}
#endif
#endif
