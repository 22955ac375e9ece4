/* target_avx2.h: from here to target_end.h functions are compiled for AVX2, regardless of the command line. Layer 2.
 *
 * System headers come before the pragma, so their functions are compiled as everywhere else. */
#include <immintrin.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
