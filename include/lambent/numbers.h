/* numbers.h: sines, cosines and roots with the same bits on every target, so that a mesh that your program makes has
 * the same bytes, and so the same pixels, everywhere. libm's own sinf and cosf differ in the last bit.
 *
 * Arithmetic around them is yours: compile it with -ffp-contract=off, or some compilers fuse products.
 *
 * Stability: stable. */
#ifndef LMB_NUMBERS_H
#define LMB_NUMBERS_H

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_sin, lmb_cos: of x radians, |x| <= 64; any other x, also NaN, counts as 0.
 * Absolute error < 6e-8 up to |x| = pi/4, < 8e-8 up to 64. Cost: some 20 operations. */
float lmb_sin(float x);
float lmb_cos(float x);

/* lmb_sqrt: the float nearest to the root of x >= 0, as in IEEE 754, also for denormals; 0 for x < 0 and NaN; infinity
 * for infinity. */
float lmb_sqrt(float x);

#ifdef __cplusplus
}
#endif

#endif
