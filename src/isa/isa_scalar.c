/* isa_scalar.c: every kernel in plain C, LANES pixels at a time. Layer 9. */
#include "../lane/lane_scalar.h"

#define BACKEND "scalar"
#define KERNEL(name) name##_scalar
#include "all_kernels.inl"
