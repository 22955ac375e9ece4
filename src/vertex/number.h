/* number.h: integers in place of floats: reciprocals, powers of lengths, sRGB codes. Layer 8. */
#ifndef LMB_VERTEX_NUMBER_H
#define LMB_VERTEX_NUMBER_H

#include <stdint.h>

#include "../base/exact.h"
#include "../base/whole.h"

/* For loops that need all registers, on processors with few. */
#if defined(__GNUC__) && (defined(__arm__) || defined(__i386__))
#define LOOP_APART static __attribute__((noinline))
#else
#define LOOP_APART static
#endif

/* Keeps two loop-carried sums sequential. Otherwise compilers compute later iterations' sums from the first one's, in
 * so many registers that short loops take longer. */
#if defined(__GNUC__)
#define ONE_BY_ONE(a, b) __asm__ volatile("" : "+r"(a), "+r"(b) : : "memory")
#else
#define ONE_BY_ONE(a, b) ((void)0)
#endif

/* Keeps a number in a register, so that compilers do not recompute it. */
#if defined(__GNUC__)
#define KEEP(a) __asm__("" : "+r"(a))
#else
#define KEEP(a) ((void)0)
#endif

/* The high half of a product. */
static inline uint32_t high_of(uint32_t a, uint32_t b) { return (uint32_t)(((uint64_t)a * b) >> 32); }
static inline int32_t signed_high_of(int32_t a, int32_t b) { return (int32_t)(((int64_t)a * b) >> 32); }

static inline int32_t within(int32_t v, int32_t low, int32_t high) { return v < low ? low : v > high ? high : v; }

/* Leading zeros of a nonzero number. Uses an instruction if the processor has one. */
static inline int32_t zeros_above(uint32_t v)
{
#if defined(__GNUC__) && !(defined(__arm__) && (!defined(__ARM_ARCH) || __ARM_ARCH < 5)) && \
    !defined(__ARM_ARCH_6M__) && !(defined(__mips) && __mips < 32)
    return __builtin_clz((unsigned)v) - (int32_t)(8 * sizeof(unsigned) - 32);
#else
    int32_t n = 0;
    if ((v & 0xffff0000u) == 0) {
        n += 16, v <<= 16;
    }
    if ((v & 0xff000000u) == 0) {
        n += 8, v <<= 8;
    }
    if ((v & 0xf0000000u) == 0) {
        n += 4, v <<= 4;
    }
    if ((v & 0xc0000000u) == 0) {
        n += 2, v <<= 2;
    }
    return n + (int32_t)(~v >> 31);
#endif
}

extern const uint16_t lmb_fixed_reciprocals[256];
extern const uint16_t lmb_fixed_cubes[194];
extern const uint16_t lmb_fixed_srgb[2][65];

/* 2^62 / v for v >= 2^31: at most 2^-17 below and 2^-29 above it; less than 2^31. */
static inline uint32_t reciprocal(uint32_t v)
{
    const uint32_t r = (uint32_t)lmb_fixed_reciprocals[(v >> 23) & 255u] << 15;
    return high_of(r, 0x80000000u - high_of(v, r)) << 2;
}

/* (v / 2^28)^-1.5 for 2^28 <= v < 2^30, in 1/65536, within 2^-12. */
static inline uint32_t inverse_cube(uint32_t v)
{
    const uint32_t at = (v >> 22) - 64u, low = lmb_fixed_cubes[at];
    return low - (((low - lmb_fixed_cubes[at + 1]) * ((v >> 10) & 4095u)) >> 12);
}

/* A linear 14-bit number -> an sRGB code in 1/256. */
static inline uint32_t srgb_of(uint32_t v)
{
    const uint16_t *t;
    v = v > 16383u ? 16383u : v;
    if (v < 1024u) {
        t = &lmb_fixed_srgb[0][v >> 4];
        return t[0] + (((t[1] - (uint32_t)t[0]) * (v & 15u)) >> 4);
    }
    t = &lmb_fixed_srgb[1][v >> 8];
    return t[0] + (((t[1] - (uint32_t)t[0]) * (v & 255u)) >> 8);
}

#endif
