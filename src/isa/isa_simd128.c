/* isa_simd128.c: every kernel by WebAssembly's simd128, four pixels at a time. Layer 9. */
#include "../base/exact.h"
#include "../lane/backends.h"

#if LMB_HAVE_SIMD128
#include "../lane/lane_simd128.h"

#define BACKEND "simd128"
#define KERNEL(name) name##_simd128
#include "all_kernels.inl"
#endif
