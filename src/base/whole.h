/* whole.h: integer helpers and inlining macros, without floats, for all sources. Layer 1. */
#ifndef LMB_BASE_WHOLE_H
#define LMB_BASE_WHOLE_H

#include <stdint.h>

/* NOINLINE: for rare or slow code, so that its stack frame is not part of the caller's. ALWAYS_INLINE: for code that
 * you want compiled separately for each caller. */
#if defined(__GNUC__)
#define NOINLINE static __attribute__((noinline))
#define ALWAYS_INLINE static inline __attribute__((always_inline))
#else
#define NOINLINE static
#define ALWAYS_INLINE static inline
#endif

static inline int32_t mini(int32_t a, int32_t b) { return a < b ? a : b; }
static inline int32_t maxi(int32_t a, int32_t b) { return a > b ? a : b; }

#endif
