/* gl_wide.h: a primitive's pixels by the lane verbs of draw.h's kernels: colours, 2D textures, secondary colours, fog.
 * Values equal those of gl_fragment.c's single pixels. */
#ifndef LAMBENT_GL_WIDE_H
#define LAMBENT_GL_WIDE_H

#include "gl_context.h"

/* A value of the primitive's vertices: that of vertex 0, and the differences of the others. */
typedef struct gl_wide_value {
    float at, more1, more2;
} gl_wide_value;

/* A texture unit. */
typedef struct gl_wide_unit {
    const gl_texture *texture;
    const gl_unit *unit;
    gl_wide_value s, t, q;
    GLenum base;
    float bias;         /* added to the level */
    int32_t has_levels; /* 1: minified pixels differ from magnified ones: by_x and by_y are set */
    int32_t divides;    /* 1: q is not 1 everywhere */
    int32_t number;     /* of the unit */
} gl_wide_unit;

typedef struct gl_wide_job {
    const gl_context *context;
    gl_wide_unit unit[GL_UNITS]; /* those that are on, in order */
    int32_t units;
    int32_t combines; /* 1: a unit has GL_COMBINE, so all texels are sampled first */
    int32_t adds, fogs; /* 1: a secondary colour that is not 0; fog */
    gl_wide_value colour[4], second[3], fog;
    float share[2][64], by_x[2][64], by_y[2][64]; /* as in lmb_draw_fragment_at */
} gl_wide_job;

/* Writes the colours of the pixels `mask`, and any colours of others. */
typedef void (*gl_wide_shader)(uint8_t out[64][4], const gl_wide_job *job, uint64_t mask);

/* The shader by a back end's verbs; NULL: none. */
gl_wide_shader gl_wide_pick(const struct lmb_kernels *kernels);

void gl_wide_avx512(uint8_t out[64][4], const gl_wide_job *job, uint64_t mask);
void gl_wide_avx2(uint8_t out[64][4], const gl_wide_job *job, uint64_t mask);
void gl_wide_sse2(uint8_t out[64][4], const gl_wide_job *job, uint64_t mask);
void gl_wide_neon(uint8_t out[64][4], const gl_wide_job *job, uint64_t mask);
void gl_wide_simd128(uint8_t out[64][4], const gl_wide_job *job, uint64_t mask);
void gl_wide_scalar(uint8_t out[64][4], const gl_wide_job *job, uint64_t mask);

#endif
