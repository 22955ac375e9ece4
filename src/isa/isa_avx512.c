/* isa_avx512.c: every kernel by AVX-512, sixteen pixels at a time. Layer 9. */
#include "../base/exact.h"
#include "../lane/backends.h"

#if LMB_HAVE_AVX512
#include "../lane/target_avx512.h"
#include "../lane/lane_avx512.h"

#define BACKEND "avx512"
#define KERNEL(name) name##_avx512
#include "all_kernels.inl"
#include "../lane/target_end.h"
#endif
