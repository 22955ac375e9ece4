/* whole.h: what all sources share that needs no float: whole numbers, and what is not inlined. Layer 1. */
#ifndef LMB_BASE_WHOLE_H
#define LMB_BASE_WHOLE_H

#include <stdint.h>

/* For what is rarely or slowly done, so that its frame is not part of its caller's; and for what is made once for each of
 * its callers. */
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
