/* gl_wide_neon.c: gl_wide.h by AArch64's NEON. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"
#include "gl_wide.h"

#if LMB_HAVE_NEON
#include "../../src/lane/lane_neon.h"

#define WIDE_NAME gl_wide_neon
#include "gl_wide.inl"
#endif
