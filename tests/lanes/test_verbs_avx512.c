/* test_verbs_avx512.c: every verb of the AVX-512 lanes equals scalar's. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"
#include "verbs.h"

void test_verbs_avx512(void);

#if LMB_HAVE_AVX512
#include "../../src/lane/target_avx512.h"
#include "../../src/lane/lane_avx512.h"

#define VERBS_RUN verbs_avx512
#include "verbs.inl"
#include "../../src/lane/target_end.h"

void test_verbs_avx512(void) { verbs_compare("avx512", verbs_avx512); }
#else
void test_verbs_avx512(void) {} /* not in this build */
#endif
