/* gl_wide_sse2.c: gl_wide.h by SSE2. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"
#include "gl_wide.h"

#if LMB_HAVE_SSE2
#include "../../src/lane/lane_sse2.h"

#define WIDE_NAME gl_wide_sse2
#include "gl_wide.inl"
#endif
