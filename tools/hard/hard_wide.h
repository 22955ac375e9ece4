/* hard_wide.h: exact sums of products of 64-bit integers in 128 bits, for references without rounding. */
#ifndef HARD_WIDE_H
#define HARD_WIDE_H

#include <stdint.h>

/* Two's complement. */
typedef struct hard_wide {
    uint64_t high, low;
} hard_wide;

static inline void hard_wide_add(hard_wide *sum, uint64_t high, uint64_t low)
{
    sum->low += low;
    sum->high += high + (sum->low < low);
}

/* sum += a x b. */
static inline void hard_wide_multiply_add(hard_wide *sum, int64_t a, int64_t b)
{
    const int turned = (a < 0) != (b < 0);
    const uint64_t x = a < 0 ? 0 - (uint64_t)a : (uint64_t)a, y = b < 0 ? 0 - (uint64_t)b : (uint64_t)b;
    const uint64_t x0 = x & 0xffffffffu, x1 = x >> 32, y0 = y & 0xffffffffu, y1 = y >> 32;
    const uint64_t low = x0 * y0, middle = x1 * y0 + (low >> 32), other = x0 * y1 + (middle & 0xffffffffu);
    const uint64_t l = (other << 32) | (low & 0xffffffffu), h = x1 * y1 + (middle >> 32) + (other >> 32);
    if (turned) {
        hard_wide_add(sum, ~h + (l == 0), 0 - l);
    } else {
        hard_wide_add(sum, h, l);
    }
}

static inline double hard_wide_to_double(hard_wide w)
{
    const int turned = w.high >> 63 != 0;
    const uint64_t h = turned ? ~w.high + (w.low == 0) : w.high, l = turned ? 0 - w.low : w.low;
    const double v = (double)h * 18446744073709551616.0 + (double)l;
    return turned ? -v : v;
}

#endif
