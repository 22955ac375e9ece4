/* gl_four.h: four floats at a time, or one if the compiler has no vectors. Values equal those of single floats. */
#ifndef LAMBENT_GL_FOUR_H
#define LAMBENT_GL_FOUR_H

#include <float.h>

#include "gl_context.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

/* FOUR_PICK: a where the mask of a comparison is set, else b. */
#ifdef __GNUC__
enum { FOUR = 4 };
typedef float four __attribute__((vector_size(16)));
typedef int32_t four_int __attribute__((vector_size(16)));
typedef uint32_t four_bits __attribute__((vector_size(16)));
#define FOUR_PICK(mask, a, b) ((four)(((four_int)(a) & (mask)) | ((four_int)(b) & ~(mask))))
static inline four four_splat(float v) { return (four){v, v, v, v}; }
static inline four_int four_to_int(four v) { return __builtin_convertvector(v, four_int); }
static inline four four_of_int(four_int v) { return __builtin_convertvector(v, four); }
#else
enum { FOUR = 1 };
typedef float four;
typedef int32_t four_int;
typedef uint32_t four_bits;
#define FOUR_PICK(mask, a, b) ((mask) ? (a) : (b))
static inline four four_splat(float v) { return v; }
static inline four_int four_to_int(four v) { return (int32_t)v; }
static inline four four_of_int(four_int v) { return (float)v; }
#endif

static inline four four_load(const float *v)
{
    four r;
    memcpy(&r, v, sizeof r);
    return r;
}

/* The codes are bytes of words, the first one lowest. */
static inline void four_save_codes(uint8_t (*out)[4], four_bits codes, int count)
{
    uint32_t code[FOUR];
    memcpy(code, &codes, sizeof code);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    memcpy(out, code, 4 * (size_t)count);
#else
    for (int i = 0; i < count; ++i) {
        for (int n = 0; n < 4; ++n) {
            out[i][n] = (uint8_t)(code[i] >> 8 * n);
        }
    }
#endif
}

/* 1: all comparisons are true. */
static inline int four_all(four_int mask)
{
    int32_t of[FOUR], all = ~0;
    memcpy(of, &mask, sizeof of);
    for (int i = 0; i < FOUR; ++i) {
        all &= of[i];
    }
    return all != 0;
}

/* gl_unit_range. */
static inline four four_range(four v)
{
    const four zero = four_splat(0.0f), one = four_splat(1.0f);
#if defined(__GNUC__) && defined(__SSE2__)
    return (four)_mm_min_ps(_mm_max_ps((__m128)v, (__m128)zero), (__m128)one); /* the second one, if v is no number */
#else
    const four high = FOUR_PICK(v > zero, v, zero);
    return FOUR_PICK(high < one, high, one);
#endif
}

/* A value 0 .. 1 as a code in byte n. */
static inline four_bits four_code(four v, int n) { return (four_bits)four_to_int(v * 255.0f + 0.5f) << 8 * n; }

/* lmb_sqrt */
static inline four four_sqrt(four v)
{
    float of[FOUR];
#if defined(__GNUC__) && defined(__SSE2__)
    return FOUR_PICK(v > four_splat(0.0f), (four)_mm_sqrt_ps((__m128)v), four_splat(0.0f));
#endif
    memcpy(of, &v, sizeof of);
    for (int i = 0; i < FOUR; ++i) {
        of[i] = lmb_sqrt(of[i]);
    }
    return four_load(of);
}

/* lmb_exp2 */
static inline four four_exp2(four v)
{
    const four low = four_splat(-126.0f), high = four_splat(127.99f), held = FOUR_PICK(v >= low, v, low);
    const four x = FOUR_PICK(held < high, held, high), to = x + 0.5f, whole = four_of_int(four_to_int(to));
    const four k = FOUR_PICK(whole > to, whole - 1.0f, whole), f = x - k;
    four p = 0x1.c6af7ap-5f + f * (0x1.3b2dd2p-7f + f * (0x1.5f0946p-10f + f * 0x1.417a5cp-13f));
    four_int bits;
    p = 1.0f + f * (0x1.62e43p-1f + f * (0x1.ebfbdcp-3f + f * p));
    memcpy(&bits, &p, sizeof bits);
    bits += four_to_int(k) * 0x800000;
    memcpy(&p, &bits, sizeof p);
    return p;
}

/* lmb_log2 */
static inline four four_log2(four v)
{
    const four low = four_splat(FLT_MIN), x = FOUR_PICK(v >= low, v, low);
    four_int u, e;
    four f;
    memcpy(&u, &x, sizeof u);
    e = (u - 0x3f3504f3) >> 23;
    u -= e * 0x800000;
    memcpy(&f, &u, sizeof f);
    f = f - 1.0f;
    const four s = f / (2.0f + f), z = s * s;
    const four q = s * (f - z * (0x1.55557ap-1f + z * (0x1.995ed8p-2f + z * 0x1.31e03cp-2f)));
    return four_of_int(e) + (f + (0x1.c551dap-2f * (f - q) - q));
}

/* gl_pow */
static inline four four_pow(four a, four b)
{
    const four zero = four_splat(0.0f), p = four_exp2(b * four_log2(a)), some = FOUR_PICK(a <= zero, zero, p);
    return FOUR_PICK(b == zero, four_splat(1.0f), some);
}

static inline four four_dot(const four a[3], const four b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* A vector of length 1, or 0. Returns the old length. */
static inline four four_normalise(four v[3])
{
    const four square = four_dot(v, v), length = four_sqrt(square), zero = four_splat(0.0f);
    const four by = FOUR_PICK(square > zero, 1.0f / length, zero);
    for (int i = 0; i < 3; ++i) {
        v[i] *= by;
    }
    return length;
}

#endif
