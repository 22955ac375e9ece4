/* test_verbs_sse2.c: every verb of the SSE2 lanes equals scalar's. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"
#include "verbs.h"

void test_verbs_sse2(void);

#if LMB_HAVE_SSE2
#include "../../src/lane/lane_sse2.h"

#define VERBS_RUN verbs_sse2
#include "verbs.inl"

void test_verbs_sse2(void) { verbs_compare("sse2", verbs_sse2); }
#else
void test_verbs_sse2(void) {} /* not in this build */
#endif
