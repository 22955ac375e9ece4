/* test_verbs_neon.c: every verb of the NEON lanes equals scalar's. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"
#include "verbs.h"

void test_verbs_neon(void);

#if LMB_HAVE_NEON
#include "../../src/lane/lane_neon.h"

#define VERBS_RUN verbs_neon
#include "verbs.inl"

void test_verbs_neon(void) { verbs_compare("neon", verbs_neon); }
#else
void test_verbs_neon(void) {} /* not in this build */
#endif
