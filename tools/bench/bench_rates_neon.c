/* bench_rates_neon.c: the loops of bench_rates.inl by AArch64's NEON. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"

#if LMB_HAVE_NEON
#include "../../src/lane/lane_neon.h"

#define BACKEND "neon"
#define KERNEL(name) name##_neon
#define CHAINS 5
#include "bench_rates.inl"
#endif
