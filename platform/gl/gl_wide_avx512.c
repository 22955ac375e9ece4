/* gl_wide_avx512.c: gl_wide.h by AVX-512. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"
#include "gl_wide.h"

#if LMB_HAVE_AVX512
#include "../../src/lane/target_avx512.h"
#include "../../src/lane/lane_avx512.h"

#define WIDE_NAME gl_wide_avx512
#include "gl_wide.inl"
#include "../../src/lane/target_end.h"
#endif
