/* isa_avx2.c: every kernel by AVX2, eight pixels at a time. Layer 9. */
#include "../base/exact.h"
#include "../lane/backends.h"

#if LMB_HAVE_AVX2
#include "../lane/target_avx2.h"
#include "../lane/lane_avx2.h"

#define BACKEND "avx2"
#define KERNEL(name) name##_avx2
#include "all_kernels.inl"
#include "../lane/target_end.h"
#endif
