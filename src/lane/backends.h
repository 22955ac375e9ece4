/* backends.h: which backends this build has. Layer 2.
 *
 * You can define each LMB_HAVE_x as 0 or 1 on the command line. If it is undefined, this header detects it. 1 means
 * compiled in: isa_pick.c checks whether the processor can run the backend. The scalar kernels are always present; the
 * tiny configuration has no others. */
#ifndef LMB_LANE_BACKENDS_H
#define LMB_LANE_BACKENDS_H

#include <lambent/config.h>

#if defined(LMB_CONFIG_TINY)
#define LMB_TARGET_X86  0
#define LMB_TARGET_NEON 0
#define LMB_TARGET_WASM 0
#else
/* gcc and clang have the intrinsics and per-function targets. gcc's intrinsics headers need a libc. */
#if defined(__SSE2__) && (defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 5 && __STDC_HOSTED__))
#define LMB_TARGET_X86 1
#else
#define LMB_TARGET_X86 0
#endif
/* ARMv7 NEON flushes denormals, so it uses the scalar lanes, as does big-endian AArch64. */
#if defined(__aarch64__) && defined(__ARM_NEON) && !defined(__AARCH64EB__)
#define LMB_TARGET_NEON 1
#else
#define LMB_TARGET_NEON 0
#endif
#if defined(__wasm_simd128__)
#define LMB_TARGET_WASM 1
#else
#define LMB_TARGET_WASM 0
#endif
#endif

/* Lanes of the plain C kernels. Four if the compiler has vectors to merge them into: twice as fast at depths, slower at
 * colours and light (x86-64). Otherwise one, because four unrolled lanes are spilled. On a Cortex-M4F that costs 14 KiB
 * of ROM and 2.5 times the time. On PowerPC it costs 1.5 KiB of stack, and as much on Windows, where functions preserve
 * ten vectors for the caller. Pixels are the same, because lanes never interact. */
#if defined(LMB_PLAIN_LANES)
/* Set by the builder: kernels of two kinds in one program need one layout. */
#elif (LMB_TARGET_X86 && !defined(_WIN32)) || LMB_TARGET_NEON || LMB_TARGET_WASM
#define LMB_PLAIN_LANES 4
#else
#define LMB_PLAIN_LANES 1
#endif

#ifndef LMB_HAVE_SSE2
#define LMB_HAVE_SSE2 LMB_TARGET_X86
#endif
/* Wider than the command line allows? Not with gcc for Windows, which aligns the stack to 16 bytes but spills wide
 * vectors with aligned moves (gcc bug 54412). Not if clang emulates Microsoft's or Sony's compiler: clang's headers
 * then hide the intrinsics of targets that the command line does not enable. */
#if defined(_WIN32) && !defined(__clang__)
#define LMB_TARGET_AVX2   0
#define LMB_TARGET_AVX512 0
#elif defined(__i386__)
/* Only eight vector registers, however wide. The rest is spilled: 5 KiB of stack with AVX2, 7.5 with AVX-512. */
#define LMB_TARGET_AVX2   0
#define LMB_TARGET_AVX512 0
#elif (defined(_MSC_VER) || defined(__SCE__)) && !defined(__AVX2__)
#define LMB_TARGET_AVX2   0
#define LMB_TARGET_AVX512 0
#elif (defined(_MSC_VER) || defined(__SCE__)) && \
    !(defined(__AVX512BW__) && defined(__AVX512DQ__) && defined(__AVX512VL__))
#define LMB_TARGET_AVX2   LMB_TARGET_X86
#define LMB_TARGET_AVX512 0
#else
#define LMB_TARGET_AVX2   LMB_TARGET_X86
#define LMB_TARGET_AVX512 LMB_TARGET_X86
#endif
#ifndef LMB_HAVE_AVX2
#define LMB_HAVE_AVX2 LMB_TARGET_AVX2
#endif
#ifndef LMB_HAVE_AVX512
#define LMB_HAVE_AVX512 LMB_TARGET_AVX512
#endif
#ifndef LMB_HAVE_NEON
#define LMB_HAVE_NEON LMB_TARGET_NEON
#endif
#ifndef LMB_HAVE_SIMD128
#define LMB_HAVE_SIMD128 LMB_TARGET_WASM
#endif
#define LMB_HAVE_SCALAR 1

/* All backends, fastest first: X(suffix of LMB_HAVE_, name). */
#define LMB_BACKENDS(X) \
    X(AVX512, avx512) X(AVX2, avx2) X(SSE2, sse2) X(NEON, neon) X(SIMD128, simd128) X(SCALAR, scalar)

/* LMB_IF(LMB_HAVE_x, text): expands to the text if the build has the backend. */
#define LMB_IF_0(...)
#define LMB_IF_1(...)            __VA_ARGS__
#define LMB_IF_NOW(have, ...)    LMB_IF_##have(__VA_ARGS__)
#define LMB_IF(have, ...)        LMB_IF_NOW(have, __VA_ARGS__)

#endif
