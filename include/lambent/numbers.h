/* numbers.h: sines, cosines, roots and sRGB codes with the same bits on every target, so that a mesh that your program
 * makes has the same bytes, and so the same pixels, everywhere. libm's own sinf and cosf differ in the last bit.
 *
 * Arithmetic around them is yours: compile it with -ffp-contract=off, or some compilers fuse products.
 *
 * Stability: stable. */
#ifndef LMB_NUMBERS_H
#define LMB_NUMBERS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_sin, lmb_cos: of x radians, |x| <= 64; any other x, also NaN, counts as 0.
 * Absolute error < 6e-8 up to |x| = pi/4, < 8e-8 up to 64. Cost: some 20 operations. */
float lmb_sin(float x);
float lmb_cos(float x);

/* lmb_tan: lmb_sin(x) / lmb_cos(x), the same domain. Relative error < 2.5e-7, near the poles too: no float is a
 * pole. */
float lmb_tan(float x);

/* lmb_acos: 0 .. pi, for x clamped to -1 .. 1; NaN counts as 1. Absolute error < 2.6e-7; at -1, 0 and 1 the nearest
 * float. */
float lmb_acos(float x);

/* lmb_sqrt: the float nearest to the root of x >= 0, as in IEEE 754, also for denormals; 0 for x < 0 and NaN; infinity
 * for infinity. */
float lmb_sqrt(float x);

/* lmb_srgb_encode: the sRGB code (IEC 61966-2-1), 0 .. 255, nearest to a linear value 0 .. 1. Values below 0 and NaN
 * give 0, values above 1 give 255. Cost: a search in a table of 1 KiB. */
uint8_t lmb_srgb_encode(float linear);

#ifdef __cplusplus
}
#endif

#endif
