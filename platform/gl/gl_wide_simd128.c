/* gl_wide_simd128.c: gl_wide.h by WebAssembly's simd128. */
#include "../../src/base/exact.h"
#include "../../src/lane/backends.h"
#include "gl_wide.h"

#if LMB_HAVE_SIMD128
#include "../../src/lane/lane_simd128.h"

#define WIDE_NAME gl_wide_simd128
#include "gl_wide.inl"
#endif
