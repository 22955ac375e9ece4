/* isa_avx2.c: every kernel by AVX2, eight pixels at a time. Layer 9. */
#include "../base/exact.h"
#include "../lane/backends.h"

#if LMB_HAVE_AVX2
#include "../lane/target_avx2.h"
#include "../lane/lane_avx2.h"

#define BACKEND "avx2"
#define KERNEL(name) name##_avx2
#include "all_kernels.inl"

#if LMB_DRAW_LANES
uint32_t lmb_draw_small_avx2(lmb_draw_small *inout) { return draw_small_avx2(inout); }
#endif
#include "../lane/target_end.h"
#endif
