/* gl_wide_avx2.c: gl_wide.h by AVX2. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"
#include "gl_wide.h"

#if LMB_HAVE_AVX2
#include "../../src/lane/target_avx2.h"
#include "../../src/lane/lane_avx2.h"

#define WIDE_NAME gl_wide_avx2
#include "gl_wide.inl"
#include "../../src/lane/target_end.h"
#endif
