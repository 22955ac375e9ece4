/* bench_rates_sse2.c: the loops of bench_rates.inl by SSE2. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"

#if LMB_HAVE_SSE2
#include "../../src/lane/lane_sse2.h"

#define BACKEND "sse2"
#define KERNEL(name) name##_sse2
#define CHAINS 5
#include "bench_rates.inl"
#endif
