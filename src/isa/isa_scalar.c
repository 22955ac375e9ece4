/* isa_scalar.c: every kernel in plain C, LANES pixels at a time. Floor 12. */
#include "../lane/lane_scalar.h"

#define MACHINE "scalar"
#define KERNEL(name) name##_scalar
#include "all_kernels.inl"
