/* vec.h: scalar maths on three-vectors and 4x4 matrices. Layer 1.
 *
 * Every function is one fixed sequence of binary32 operations; sums run left to right. */
#ifndef LMB_BASE_VEC_H
#define LMB_BASE_VEC_H

#include <lambent/types.h>

#include "exact.h"
#include "whole.h"

#ifdef __cplusplus
extern "C" {
#endif
float sqrtf(float);  /* the only two libm functions in src/: both correctly rounded everywhere */
float floorf(float);
#ifdef __cplusplus
}
#endif

static inline lmb_vec3 vec3(float x, float y, float z)
{
    lmb_vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

static inline lmb_vec3 add3(lmb_vec3 a, lmb_vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline lmb_vec3 sub3(lmb_vec3 a, lmb_vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline lmb_vec3 mul3(lmb_vec3 a, float s) { return vec3(a.x * s, a.y * s, a.z * s); }
static inline float dot3(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static inline lmb_vec3 cross3(lmb_vec3 a, lmb_vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline float length3(lmb_vec3 a) { return sqrtf(dot3(a, a)); }

/* Unit vector along a; a itself if the length is too small. */
static inline lmb_vec3 normalize3(lmb_vec3 a)
{
    float d2 = dot3(a, a);
    return d2 > 1e-37f ? mul3(a, 1.0f / sqrtf(d2)) : a;
}

static inline float minf(float a, float b) { return a < b ? a : b; }
static inline float maxf(float a, float b) { return a > b ? a : b; }
static inline float clampf(float v, float lo, float hi) { return v < lo ? lo : v > hi ? hi : v; }
/* A single instruction on compilers with the builtin; both versions give 0 for -0. */
#if defined(__GNUC__)
static inline float absf(float a) { return __builtin_fabsf(a); }
#else
static inline float absf(float a) { return a <= 0.0f ? 0.0f - a : a; }
#endif
static inline lmb_vec3 min3(lmb_vec3 a, lmb_vec3 b) { return vec3(minf(a.x, b.x), minf(a.y, b.y), minf(a.z, b.z)); }
static inline lmb_vec3 max3(lmb_vec3 a, lmb_vec3 b) { return vec3(maxf(a.x, b.x), maxf(a.y, b.y), maxf(a.z, b.z)); }
static inline float largest3(lmb_vec3 v) { return maxf(maxf(absf(v.x), absf(v.y)), absf(v.z)); }
static inline int32_t clampi(int32_t v, int32_t lo, int32_t hi) { return v < lo ? lo : v > hi ? hi : v; }

/* Finite and within the scene limit of 2^20 m; false for NaN. */
static inline int is_sane(float v) { return v > -1048576.0f && v < 1048576.0f; }
static inline int is_place(lmb_vec3 at) { return is_sane(at.x) && is_sane(at.y) && is_sane(at.z); }

/* Index of the lowest set bit; bits must not be 0. */
static inline int lowest_bit(uint32_t bits)
{
#if defined(__GNUC__)
    return __builtin_ctz(bits);
#else
    int n = 0;
    for (; (bits & 1u) == 0; bits >>= 1) {
        ++n;
    }
    return n;
#endif
}

/* Index of the highest set bit; bits must not be 0. */
static inline int highest_bit(uint32_t bits)
{
#if defined(__GNUC__)
    return 31 - __builtin_clz(bits);
#else
    int n = 0;
    for (; bits > 1u; bits >>= 1) {
        ++n;
    }
    return n;
#endif
}

static inline int lowest_bit_64(uint64_t bits)
{
    const uint32_t low = (uint32_t)bits;
    return low != 0 ? lowest_bit(low) : 32 + lowest_bit((uint32_t)(bits >> 32));
}

/* Counts the set bits of 16. */
static inline uint32_t count_bits_16(uint32_t bits)
{
    bits -= (bits >> 1) & 0x5555u;
    bits = (bits & 0x3333u) + ((bits >> 2) & 0x3333u);
    bits = (bits + (bits >> 4)) & 0x0f0fu;
    return (bits + (bits >> 8)) & 31u;
}

static inline int32_t count_bits_64(uint64_t bits)
{
    uint32_t n = 0;
    for (; bits != 0; bits >>= 16) {
        n += count_bits_16((uint32_t)bits & 0xffffu);
    }
    return (int32_t)n;
}

/* Affine point transform: columns times coordinates, summed x, y, z, translation. */
static inline lmb_vec3 transform_point(const lmb_mat4 *t, lmb_vec3 p)
{
    const float *m = t->m;
    return vec3(m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]);
}

/* Does the transform mirror, and so turn the front of a triangle into the back? */
static inline int is_mirrored(const lmb_mat4 *t)
{
    const float *m = t->m;
    return dot3(cross3(vec3(m[0], m[1], m[2]), vec3(m[4], m[5], m[6])), vec3(m[8], m[9], m[10])) < 0.0f;
}

/* 0 .. 5: dominant axis and sign of a vector. */
static inline uint32_t side_of3(lmb_vec3 v)
{
    const float x = absf(v.x), y = absf(v.y), z = absf(v.z);
    if (x >= y && x >= z) {
        return v.x < 0.0f;
    }
    return y >= z ? 2u + (v.y < 0.0f) : 4u + (v.z < 0.0f);
}

/* Direction from a position towards the viewer, of any length. */
static inline lmb_vec3 view_to_eye(const lmb_view *v, lmb_vec3 at)
{
    return v->kind == LMB_PERSPECTIVE ? sub3(v->eye, at) : v->back;
}

/* A position that a view sees. If it is within `noise` (m) of a plane, the position is moved to the eye's side of the
 * plane, because otherwise the eye could not see it. So a pixel on the edge of a room gets the light of the other
 * wall's inner side, not of the outer side. */
static inline lmb_vec3 before_plane(lmb_vec3 at, float noise, lmb_vec3 on_plane, lmb_vec3 axis, lmb_vec3 to_eye)
{
    const float height = dot3(axis, sub3(at, on_plane)), eye = dot3(axis, to_eye);
    return absf(height) <= noise && eye != 0.0f ? add3(at, mul3(axis, eye > 0.0f ? 2.0f * noise : -2.0f * noise)) : at;
}

#endif
