/* poly.h: the elementary functions, each one fixed sequence of binary32 operations. Layer 1.
 *
 * libm differs from system to system in the last bit, and that bit moves pixels. These functions use + - * /, sqrtf and
 * floorf, all correctly rounded everywhere, and our own minimax polynomials. The stated errors are the largest found
 * against double over every fifth to seventh float of the domain (log2, tan: every one if it matters), rounded up;
 * tests/unit/test_base.c sweeps some millions. No argument gives NaN or infinity. */
#ifndef LMB_BASE_POLY_H
#define LMB_BASE_POLY_H

#include <lambent/numbers.h>
#include <stdint.h>
#include <string.h>

#include "exact.h"

#define LMB_PI 3.14159274f          /* the float nearest to pi, and */
#define LMB_PI_REST -8.74227766e-8f /* the rest of pi */
#define LMB_INVERSE_PI 0.31830989f

static inline uint32_t float_bits(float v)
{
    uint32_t u;
    memcpy(&u, &v, sizeof u);
    return u;
}

static inline float bits_float(uint32_t u)
{
    float v;
    memcpy(&v, &u, sizeof v);
    return v;
}

/* lmb_atan2: the angle of the point (x, y), -pi .. pi. Absolute error < 2e-7; on the axes and diagonals the nearest
 * float. The signs of zeros are ignored: (0, -1) gives +pi, (0, 0) gives 0. A NaN gives 0; two infinities count as
 * equal. */
float lmb_atan2(float y, float x);

/* lmb_log2: for normal x > 0, relative error < 1.4e-7. Zero, denormals, negatives and NaN count as 2^-126: -126;
 * infinity gives 128. Exact at powers of two. */
float lmb_log2(float x);

/* lmb_exp2: 2^x for x clamped to -126 .. 127.99, relative error < 9.5e-8; NaN counts as -126. Exact at integers. */
float lmb_exp2(float x);

#endif
