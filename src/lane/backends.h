/* backends.h: which backends this build has. Layer 2.
 *
 * Each LMB_HAVE_x may be defined as 0 or 1 on the command line; left alone, it is found out here. "Has" means compiled
 * in: whether the processor can run it is isa_pick.c's question. The scalar kernels are always there; the tiny
 * configuration has nothing else. */
#ifndef LMB_LANE_BACKENDS_H
#define LMB_LANE_BACKENDS_H

#include <lambent/config.h>

#if defined(LMB_CONFIG_TINY)
#define LMB_TARGET_X86  0
#define LMB_TARGET_NEON 0
#define LMB_TARGET_WASM 0
#else
/* gcc and clang: their intrinsics, and a target for a part of a file. gcc's headers of intrinsics want a libc. */
#if defined(__SSE2__) && (defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 5 && __STDC_HOSTED__))
#define LMB_TARGET_X86 1
#else
#define LMB_TARGET_X86 0
#endif
/* ARMv7's NEON flushes denormals: it takes the scalar lanes, as does the big-endian order of AArch64. */
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

/* Lanes of plain C's kernels. Four where the compiler has vectors to join them in: twice as fast at depths, slower at
 * colours and light (x86-64). Else one: four written out are spilled, and cost a Cortex-M4F 14 KiB of ROM and 2.5 times
 * the time, a PowerPC 1.5 KiB of stack, and Windows, whose functions keep ten vectors for their callers, as much.
 * Pixels are the same: a lane never meets another. */
#if defined(LMB_PLAIN_LANES)
/* The builder's: kernels of two kinds that are joined to one program want one layout. */
#elif (LMB_TARGET_X86 && !defined(_WIN32)) || LMB_TARGET_NEON || LMB_TARGET_WASM
#define LMB_PLAIN_LANES 4
#else
#define LMB_PLAIN_LANES 1
#endif

#ifndef LMB_HAVE_SSE2
#define LMB_HAVE_SSE2 LMB_TARGET_X86
#endif
/* Wider than the command line asks for? Not with gcc for Windows, which aligns the stack to 16 bytes and still spills
 * wide vectors by aligned moves (its bug 54412); nor where clang plays Microsoft's or Sony's compiler: its headers then
 * hide what the command line has not. */
#if defined(_WIN32) && !defined(__clang__)
#define LMB_TARGET_AVX2   0
#define LMB_TARGET_AVX512 0
#elif defined(__i386__)
/* Eight registers hold eight vectors, however wide. The others are spilled: 5 KiB of stack by AVX2, 7.5 by AVX-512. */
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

/* Every backend, the fastest first: X(what LMB_HAVE_ is followed by, name). */
#define LMB_BACKENDS(X) \
    X(AVX512, avx512) X(AVX2, avx2) X(SSE2, sse2) X(NEON, neon) X(SIMD128, simd128) X(SCALAR, scalar)

/* LMB_IF(LMB_HAVE_x, text): the text where the build has it. */
#define LMB_IF_0(...)
#define LMB_IF_1(...)            __VA_ARGS__
#define LMB_IF_NOW(have, ...)    LMB_IF_##have(__VA_ARGS__)
#define LMB_IF(have, ...)        LMB_IF_NOW(have, __VA_ARGS__)

#endif
