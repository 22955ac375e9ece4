/* piece.h: a piece of a triangle: place in the order of elements, mean albedo and emission. Layer 6. */
#ifndef LMB_TREE_PIECE_H
#define LMB_TREE_PIECE_H

#include <lambent/elements.h>

#include "../raster/triangle.h"

enum { PIECE_Z_BITS = 9 };

/* A triangle with the data that all pieces share. */
typedef struct piece_source {
    lmb_triangle triangle;
    const lmb_scene *scene;
    lmb_vec3 normal; /* of the front, unit */
    float area;
    float uv[3][2], colour[3][4];
    float texels; /* of the colour texture, over the whole triangle; 0: none */
} piece_source;

/* Part of a triangle: corners, and their barycentrics in the triangle. */
typedef struct surface_piece {
    lmb_vec3 corner[3];
    float b1[3], b2[3];
} surface_piece;

static inline lmb_vec3 piece_across(const lmb_vec3 corner[3])
{
    return cross3(sub3(corner[1], corner[0]), sub3(corner[2], corner[0]));
}

static inline lmb_vec3 piece_middle(const lmb_vec3 corner[3])
{
    const lmb_vec3 d = add3(sub3(corner[1], corner[0]), sub3(corner[2], corner[0]));
    return add3(corner[0], mul3(d, 1.0f / 3.0f));
}

static inline float piece_mix(float a, float b, float c, float b1, float b2)
{
    return a + ((b - a) * b1 + (c - a) * b2);
}

static inline float piece_uv_at(const piece_source *s, int c, float b1, float b2)
{
    return piece_mix(s->uv[0][c], s->uv[1][c], s->uv[2][c], b1, b2);
}

/* Moves bits 0, 1, 2, .. to 0, 3, 6, .. */
static inline uint32_t piece_spread_bits(uint32_t v)
{
    uint32_t out = 0;
    for (int i = 0; i < PIECE_Z_BITS; ++i) {
        out |= ((v >> i) & 1u) << (3 * i);
    }
    return out;
}

/* Index along a Z curve of 2^PIECE_Z_BITS steps per axis, which start at `low`; `per` steps per metre. */
static inline uint32_t piece_place(lmb_vec3 at, lmb_vec3 low, float per)
{
    const float last = (float)((1 << PIECE_Z_BITS) - 1);
    const uint32_t x = (uint32_t)clampf((at.x - low.x) * per, 0.0f, last),
                   y = (uint32_t)clampf((at.y - low.y) * per, 0.0f, last),
                   z = (uint32_t)clampf((at.z - low.z) * per, 0.0f, last);
    return piece_spread_bits(x) | piece_spread_bits(y) << 1 | piece_spread_bits(z) << 2;
}

/* Like lmb_elements_rest; `sent`: flux of each channel that the last bounce received from senders other than elements,
 * W. */
lmb_status lmb_elements_rest_of(lmb_elements *inout, const double sent[3], int32_t bounces);

/* Returns 1 if the triangle has an area. */
int lmb_source_open(piece_source *out, const lmb_scene *scene, uint32_t id);

/* Sets the mean albedo of a piece and returns its opaque share, both from four points. `share`: of the triangle's
 * area. */
float lmb_source_albedo(float albedo[3], const piece_source *s, const surface_piece *p, float share);

/* Sets the mean albedo around a place on the triangle's plane, over `area`, m2, at most 1 a channel. */
void lmb_source_albedo_at(float out[3], const piece_source *s, lmb_vec3 at, float area);

/* Mean radiance that a piece emits, W/(sr m2): sampled at the middles of up to 32 x 32 congruent triangles, over the
 * opaque ones. */
void lmb_source_emission(float out[3], const piece_source *s, const surface_piece *p);

#endif
