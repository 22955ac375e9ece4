/* any.h: for Frama-C's Eva: all values of a range at once; lane verbs without wraparound. */
#ifndef ANY_H
#define ANY_H

#include "../../src/lane/kernels.h"

/*@ requires low <= high;
    assigns \result \from low, high;
    ensures low <= \result <= high; */
int any_between(int low, int high);

/*@ assigns \result \from \nothing;
    ensures \is_finite(\result) && 0.0 <= \result <= 1.0; */
float any_share(void);

/* Numbers, infinities and NaN. */
/*@ assigns \result \from \nothing; */
float any_float(void);

/* One lane in plain C. Sums and products of registers wrap (lane_scalar.h); here they are C's, so that
 * leaving 32 bits is an alarm. */
#define LANE_ONE 1
#define lanei_add lanei_add_round
#define lanei_sub lanei_sub_round
#define lanei_mul lanei_mul_round
#include "../../src/lane/lane_scalar.h"
#undef lanei_add
#undef lanei_sub
#undef lanei_mul
static inline lanei lanei_add(lanei a, lanei b) { a.v[0] = a.v[0] + b.v[0]; return a; }
static inline lanei lanei_sub(lanei a, lanei b) { a.v[0] = a.v[0] - b.v[0]; return a; }
static inline lanei lanei_mul(lanei a, lanei b) { a.v[0] = a.v[0] * b.v[0]; return a; }
#include "../../src/lane/lane.h"

#define KERNEL(name) name##_any

#endif
