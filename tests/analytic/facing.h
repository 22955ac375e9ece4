/* facing.h: Howell's closed form factor of a surface element to a parallel rectangle (B-3). */
#ifndef TEST_FACING_H
#define TEST_FACING_H

#include "../world.h"

/* Below a corner of a parallel rectangle a x b at distance c, with A = a/c, B = b/c:
 *   F = 1/(2 pi) (A/sqrt(1+A2) atan(B/sqrt(1+A2)) + B/sqrt(1+B2) atan(A/sqrt(1+B2))) */
static inline double parallel_corner(double a, double b, double c)
{
    double x = a / c, y = b / c, u = sqrt(1 + x * x), v = sqrt(1 + y * y);
    return (x / u * atan(y / u) + y / v * atan(x / v)) / (2 * PI);
}

/* From (x, z) to the unit square at height h; negative sides are subtracted, because atan is odd. */
static inline double parallel_factor(double x, double z, double h)
{
    return parallel_corner(x, z, h) + parallel_corner(1 - x, z, h) + parallel_corner(x, 1 - z, h) +
           parallel_corner(1 - x, 1 - z, h);
}

#endif
