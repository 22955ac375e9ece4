/* bench_rates_simd128.c: the loops of bench_rates.inl by WebAssembly's simd128. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"

#if LMB_HAVE_SIMD128
#include "../../src/lane/lane_simd128.h"

#define BACKEND "simd128"
#define KERNEL(name) name##_simd128
#define CHAINS 5
#include "bench_rates.inl"
#endif
