/* isa_scalar.c: every kernel in plain C, LANES pixels at a time. Floor 9. */
#include "../lane/lane_scalar.h"

#define KERNEL(name) name##_scalar
#include "all_kernels.inl"

const lmb_kernels lmb_kernels_scalar = {
    "scalar",    LANES,         fill_scalar,        resolve_scalar, direct_scalar,
    gather_scalar, gather_near_scalar, blend_scalar, probe_scalar,
};
