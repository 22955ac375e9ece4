/* test_verbs_simd128.c: every verb of the simd128 lanes equals scalar's. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"
#include "verbs.h"

void test_verbs_simd128(void);

#if LMB_HAVE_SIMD128
#include "../../src/lane/lane_simd128.h"

#define VERBS_RUN verbs_simd128
#include "verbs.inl"

void test_verbs_simd128(void) { verbs_compare("simd128", verbs_simd128); }
#else
void test_verbs_simd128(void) {} /* not in this build */
#endif
