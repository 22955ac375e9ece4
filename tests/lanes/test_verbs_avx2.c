/* test_verbs_avx2.c: every verb of the AVX2 lanes equals scalar's. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"
#include "verbs.h"

void test_verbs_avx2(void);

#if LMB_HAVE_AVX2
#include "../../src/lane/target_avx2.h"
#include "../../src/lane/lane_avx2.h"

#define VERBS_RUN verbs_avx2
#include "verbs.inl"
#include "../../src/lane/target_end.h"

void test_verbs_avx2(void) { verbs_compare("avx2", verbs_avx2); }
#else
void test_verbs_avx2(void) {} /* not in this build */
#endif
