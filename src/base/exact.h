/* exact.h: refuses compilers and flags that would change bytes; lmb_build_check tests the rest at run time. Layer 1. */
#ifndef LMB_BASE_EXACT_H
#define LMB_BASE_EXACT_H

#include <float.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "lambent: -ffast-math changes pixels; build without it"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "lambent: this target computes float with excess precision; build with SSE2 (-mfpmath=sse -msse2) or -std=gnu99"
#endif
#if FLT_RADIX != 2 || FLT_MANT_DIG != 24 || FLT_MAX_EXP != 128
#error "lambent: float is not IEEE-754 binary32"
#endif

/* The part of lmb_build_check that needs no kernel: 1 if this target's plain C computes the same as all others. */
int lmb_base_is_exact(void);

/* No fused multiply-adds, even if you forget -ffp-contract=off. In its own dialects (-std=gnu17 by default) gcc fuses
 * on each processor that can, such as a Cortex-M4F. With -std=c99 it fuses only with -ffp-contract=fast. No macro shows
 * this option, but lmb_build_check detects it. gcc ignores the standard's pragma; clang honours it, except with
 * -ffp-contract=fast. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__) && !defined(__STRICT_ANSI__)
#pragma GCC optimize("fp-contract=off")
#endif

#endif
