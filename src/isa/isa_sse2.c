/* isa_sse2.c: every kernel by SSE2, four pixels at a time. Layer 9. */
#include "../base/exact.h"
#include "../lane/backends.h"

#if LMB_HAVE_SSE2
#include "../lane/lane_sse2.h"

#define BACKEND "sse2"
#define KERNEL(name) name##_sse2
#include "all_kernels.inl"
#endif
