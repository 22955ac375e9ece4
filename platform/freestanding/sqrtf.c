/* sqrtf.c: the square root, rounded to nearest and ties to even, digit by digit, for processors
 * with an FPU that has none. */
#include <stdint.h>
#include <string.h>

float sqrtf(float x);

float sqrtf(float x)
{
    uint32_t bits, root = 0, rest = 0;
    memcpy(&bits, &x, sizeof bits);
    if (bits << 1 == 0 || bits == 0x7f800000u)
        return x; /* -0, 0, infinity */
    if (bits > 0x7f800000u) {
        bits = 0x7fc00000u; /* negative, or NaN */
        memcpy(&x, &bits, sizeof x);
        return x;
    }
    int32_t exponent = (int32_t)(bits >> 23) - 127;
    uint32_t digits = bits & 0x7fffffu;
    if (exponent == -127)
        for (exponent = -126; !(digits & 0x800000u); --exponent) /* a denormal number */
            digits <<= 1;
    digits |= 0x800000u;
    if (exponent & 1)
        digits <<= 1, --exponent;
    /* 25 digits of the root of digits * 2^25: one more than needed, for rounding. */
    uint64_t left = (uint64_t)digits << 25;
    for (int i = 0; i < 25; ++i) {
        rest = rest << 2 | (uint32_t)(left >> 48 & 3u);
        left <<= 2;
        const uint32_t trial = root << 2 | 1u;
        root <<= 1;
        if (rest >= trial)
            rest -= trial, root |= 1u;
    }
    /* A tie is impossible: the square of such a number has 50 digits, and the last is not 0. */
    root = (root + 1) >> 1;
    bits = (uint32_t)((exponent / 2 + 127) << 23) + (root - 0x800000u);
    memcpy(&x, &bits, sizeof x);
    return x;
}
