/* numbers.h: sines, cosines and roots with the same bits on every machine, so that a mesh that a program makes has the same
 * bytes, and so the same pixels, wherever it runs. libm's own sinf and cosf differ in the last bit.
 *
 * Arithmetic around them is the caller's: compile it with -ffp-contract=off, or products fuse on some machines.
 *
 * Stability: stable. */
#ifndef LMB_NUMBERS_H
#define LMB_NUMBERS_H

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_sin, lmb_cos: of x radians, |x| <= 64; anything else, NaN too, counts as 0.
 * Absolute error < 6e-8 up to |x| = pi/4, < 8e-8 up to 64. Cost: some 20 operations. */
float lmb_sin(float x);
float lmb_cos(float x);

/* lmb_sqrt: the float nearest to the root of x >= 0, as IEEE 754 has it, of denormals too; 0 for x < 0 and NaN; infinity
 * of infinity. */
float lmb_sqrt(float x);

#ifdef __cplusplus
}
#endif

#endif
