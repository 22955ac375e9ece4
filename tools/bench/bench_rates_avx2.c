/* bench_rates_avx2.c: the loops of bench_rates.inl by AVX2. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"

#if LMB_HAVE_AVX2
#include "../../src/lane/target_avx2.h"
#include "../../src/lane/lane_avx2.h"

#define BACKEND "avx2"
#define KERNEL(name) name##_avx2
#define CHAINS 5
#include "bench_rates.inl"
#include "../../src/lane/target_end.h"
#endif
