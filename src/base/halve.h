/* halve.h: finds the texels that a texel of the next mip level covers. Layer 1.
 *
 * A side of n texels becomes n / 2, rounded down; a side of 1 stays 1. If n = 2 m + 1 is odd, texel i covers n / m
 * texels from i n / m on, which are parts of three texels. So every texel of the finer level has the same weight in the
 * coarser level. */
#ifndef LMB_HALVE_H
#define LMB_HALVE_H

#include <stdint.h>

enum { HALVE_MOST = 3 };

/* Texels of one axis from `first` on, and the weight of each in units of 1 / whole. */
typedef struct {
    int32_t first, count, whole, part[HALVE_MOST];
} halve_taps;

/* For texel i of 0 .. side / 2 - 1; i = 0 if side = 1. */
static inline halve_taps halve_axis(int32_t side, int32_t i)
{
    const int32_t m = side / 2;
    const halve_taps one = {0, 1, 1, {1, 0, 0}}, even = {2 * i, 2, 2, {1, 1, 0}},
                     odd = {2 * i, 3, side, {m - i, m, i + 1}};
    return side == 1 ? one : side % 2 == 0 ? even : odd;
}

#endif
