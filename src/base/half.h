/* half.h: binary16 codes of non-negative numbers. Layer 1. */
#ifndef LMB_BASE_HALF_H
#define LMB_BASE_HALF_H

#include <string.h>

#include "exact.h"

#include <stdint.h>

#define HALF_MAX 65504.0f
#define HALF_ONE 0x3c00u

/* The nearest code; ties go to the even one. Negative values and NaN give 0, values over 65504 give 65504. */
static inline uint16_t half_encode(float v)
{
    uint32_t bits;
    if (!(v > 0.0f)) {
        return 0;
    }
    if (v >= HALF_MAX) {
        return 0x7bff;
    }
    if (v < 6.103515625e-05f) { /* 2^-14: codes are multiples of 2^-24, as are floats from 0.5 on: adding rounds */
        v += 0.5f;
        memcpy(&bits, &v, sizeof bits);
        return (uint16_t)(bits - 0x3f000000u);
    }
    memcpy(&bits, &v, sizeof bits);
    bits += 0xfffu + (bits >> 13 & 1u);
    return (uint16_t)((bits >> 13) - (112u << 10));
}

static inline float half_decode(uint16_t code)
{
    const uint32_t low = (uint32_t)code & 0x7fffu;
    float v;
    uint32_t bits = (low << 13) + (112u << 23);
    if (low < 0x400u) {
        return (float)low * 5.9604644775390625e-08f; /* 2^-24 */
    }
    memcpy(&v, &bits, sizeof v);
    return v;
}

#endif
