/* cube.h: directions and texels of a cube's faces, in GL order. Layer 5. */
#ifndef LMB_PROBE_CUBE_H
#define LMB_PROBE_CUBE_H

#include "../base/vec.h"

/* -1 .. 1: centre of texel i of n. */
static inline float cube_coordinate(int32_t i, int32_t n) { return (float)(2 * i + 1 - n) / (float)n; }

/* On the cube with faces at distance 1 from the centre, or on the plane of a face. */
static inline lmb_vec3 cube_point(int32_t face, float s, float t)
{
    switch (face) {
    case 0: return vec3(1.0f, -t, -s);
    case 1: return vec3(-1.0f, -t, s);
    case 2: return vec3(s, 1.0f, t);
    case 3: return vec3(s, -1.0f, -t);
    case 4: return vec3(s, -t, 1.0f);
    default: return vec3(-s, -t, -1.0f);
    }
}

/* Unit vector to texel (x, y) of faces with n x n. */
static inline lmb_vec3 cube_direction(int32_t face, int32_t x, int32_t y, int32_t n)
{
    return normalize3(cube_point(face, cube_coordinate(x, n), cube_coordinate(y, n)));
}

/* The point of the cube in a direction: s and t in -1 .. 1. If axes are equal, x goes before y before z. */
static inline int32_t cube_face(float *s, float *t, lmb_vec3 d)
{
    const float x = absf(d.x), y = absf(d.y), z = absf(d.z);
    if (x >= y && x >= z) {
        *s = (d.x > 0.0f ? -d.z : d.z) / x;
        *t = -d.y / x;
        return d.x > 0.0f ? 0 : 1;
    }
    if (y >= z) {
        *s = d.x / y;
        *t = (d.y > 0.0f ? d.z : -d.z) / y;
        return d.y > 0.0f ? 2 : 3;
    }
    *s = (d.z > 0.0f ? d.x : -d.x) / z;
    *t = -d.y / z;
    return d.z > 0.0f ? 4 : 5;
}

typedef struct cube_place {
    int32_t face, x, y;
} cube_place;

/* Texel i of 6 n^2, row by row and face by face, and the direction to its centre. */
static inline cube_place cube_nth(int32_t i, int32_t n)
{
    const cube_place p = {i / (n * n), i % n, i / n % n};
    return p;
}

static inline lmb_vec3 cube_nth_direction(int32_t i, int32_t n)
{
    const cube_place p = cube_nth(i, n);
    return cube_direction(p.face, p.x, p.y, n);
}

/* The texel that a direction meets, for faces with n x n. */
static inline cube_place cube_texel_of(lmb_vec3 d, int32_t n)
{
    float s, t;
    cube_place p;
    p.face = cube_face(&s, &t, d);
    p.x = mini((int32_t)((s + 1.0f) * 0.5f * (float)n), n - 1);
    p.y = mini((int32_t)((t + 1.0f) * 0.5f * (float)n), n - 1);
    return p;
}

/* The texel that replaces a border texel: the one in the same direction. */
static inline cube_place cube_border(int32_t face, int32_t x, int32_t y, int32_t n)
{
    return cube_texel_of(cube_point(face, cube_coordinate(x, n), cube_coordinate(y, n)), n);
}

#endif
