/* fvec.h: vectors of three floats, for tools that compute in the library's precision.
 *
 * Every function is one fixed sequence of binary32 operations, so files and pictures are equal on every machine. */
#ifndef FVEC_H
#define FVEC_H

#include <lambent/types.h>
#include <math.h>

static inline lmb_vec3 vec3(float x, float y, float z)
{
    lmb_vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

static inline float minf(float a, float b) { return a < b ? a : b; }
static inline float maxf(float a, float b) { return a > b ? a : b; }
static inline float clampf(float v, float lo, float hi) { return v < lo ? lo : v > hi ? hi : v; }
static inline float absf(float a) { return fabsf(a); }

static inline lmb_vec3 add3(lmb_vec3 a, lmb_vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline lmb_vec3 sub3(lmb_vec3 a, lmb_vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline lmb_vec3 mul3(lmb_vec3 a, float s) { return vec3(a.x * s, a.y * s, a.z * s); }
static inline lmb_vec3 min3(lmb_vec3 a, lmb_vec3 b) { return vec3(minf(a.x, b.x), minf(a.y, b.y), minf(a.z, b.z)); }
static inline lmb_vec3 max3(lmb_vec3 a, lmb_vec3 b) { return vec3(maxf(a.x, b.x), maxf(a.y, b.y), maxf(a.z, b.z)); }
static inline float dot3(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline float length3(lmb_vec3 a) { return sqrtf(dot3(a, a)); }
static inline float largest3(lmb_vec3 v) { return maxf(maxf(absf(v.x), absf(v.y)), absf(v.z)); }

static inline lmb_vec3 cross3(lmb_vec3 a, lmb_vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* Unit vector along a; a itself if the length is too small. */
static inline lmb_vec3 normalize3(lmb_vec3 a)
{
    const float d2 = dot3(a, a);
    return d2 > 1e-37f ? mul3(a, 1.0f / sqrtf(d2)) : a;
}

/* Finite and within the scene limit of 2^20 m; false for NaN. */
static inline int is_sane(float v) { return v > -1048576.0f && v < 1048576.0f; }
static inline int is_place(lmb_vec3 at) { return is_sane(at.x) && is_sane(at.y) && is_sane(at.z); }

/* 1 if the transform mirrors, and so turns the front of a triangle into the back. */
static inline int is_mirrored(const lmb_mat4 *t)
{
    const float *m = t->m;
    return dot3(cross3(vec3(m[0], m[1], m[2]), vec3(m[4], m[5], m[6])), vec3(m[8], m[9], m[10])) < 0.0f;
}

/* Index of the lowest set bit; bits must not be 0. */
static inline int lowest_bit(uint64_t bits)
{
#if defined(__GNUC__)
    return __builtin_ctzll(bits);
#else
    int n = 0;
    for (; (bits & 1u) == 0; bits >>= 1) {
        ++n;
    }
    return n;
#endif
}

static inline int32_t count_bits(uint64_t bits)
{
    int32_t n = 0;
    for (; bits != 0; bits &= bits - 1) {
        ++n;
    }
    return n;
}

#endif
