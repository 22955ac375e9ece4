/* target_avx512.h: from here to target_end.h functions are compiled for AVX-512 F, BW, DQ and VL. Layer 2.
 *
 * AVX-512 has fused multiply-adds, and gcc uses them by default. The pragma turns contraction off even in builds
 * without the Makefile's -ffp-contract=off. System headers come before the pragma. */
#include <immintrin.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512bw,avx512dq,avx512vl"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl")
#pragma GCC optimize("fp-contract=off")
#endif
