/* bench_rates_scalar.c: the loops of bench_rates.inl in plain C. */
#include "../../src/lane/lane_scalar.h"

#define BACKEND "scalar"
#define KERNEL(name) name##_scalar
/* Four lanes are four values in registers. */
#define CHAINS (LANES == 1 ? 5 : 1)
#include "bench_rates.inl"
