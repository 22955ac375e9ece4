/* isa_neon.c: every kernel by AArch64's NEON, four pixels at a time. Layer 9. */
#include "../base/exact.h"
#include "../lane/backends.h"

#if LMB_HAVE_NEON
#include "../lane/lane_neon.h"

#define BACKEND "neon"
#define KERNEL(name) name##_neon
#include "all_kernels.inl"
#endif
