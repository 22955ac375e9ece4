/* bench_rates_avx512.c: the loops of bench_rates.inl by AVX-512. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"

#if LMB_HAVE_AVX512
#include "../../src/lane/target_avx512.h"
#include "../../src/lane/lane_avx512.h"

#define BACKEND "avx512"
#define KERNEL(name) name##_avx512
#define CHAINS 5
#include "bench_rates.inl"
#include "../../src/lane/target_end.h"
#endif
