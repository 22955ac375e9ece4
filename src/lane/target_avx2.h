/* target_avx2.h: from here to target_end.h functions are compiled for AVX2, whatever the command line says. Layer 2.
 *
 * System headers come before the pragma: their functions stay what they are everywhere else. */
#include <immintrin.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
