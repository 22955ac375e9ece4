/* bench_mix.c: counts the far gather's operations by running the kernel itself over verbs that count. */
#include "bench_mix.h"

#include <string.h>

#include "../src/lane/kernels.h"
#include "../src/lane/lane_scalar.h"

static double done[BENCH_OPS];

/* Multiplying by what belongs to a group alone counts as well. */
#define COUNTED(result, verb, op, arguments, values) \
    static inline result counted_##verb arguments \
    { \
        done[op] += 1.0; \
        return verb values; \
    }
#define COUNTED_2(result, verb, op) COUNTED(result, verb, op, (lane a, lane b), (a, b))

COUNTED_2(lane, lane_mul, BENCH_MUL)
COUNTED_2(lane, lane_add, BENCH_ADD)
COUNTED_2(lane, lane_sub, BENCH_ADD)
COUNTED_2(lane, lane_min, BENCH_MAX)
COUNTED_2(lane, lane_max, BENCH_MAX)
COUNTED_2(lane_mask, lane_lt, BENCH_CMP)
COUNTED_2(lane_mask, lane_le, BENCH_CMP)
COUNTED_2(lane, lane_div, BENCH_DIV)
COUNTED(lane, lane_pick, BENCH_PICK, (lane_mask m, lane a, lane b), (m, a, b))
COUNTED(lane, lane_keep, BENCH_PICK, (lane_mask m, lane a), (m, a))
COUNTED(lane, lane_sqrt, BENCH_SQRT, (lane a), (a))

#define lane_mul counted_lane_mul
#define lane_add counted_lane_add
#define lane_sub counted_lane_sub
#define lane_min counted_lane_min
#define lane_max counted_lane_max
#define lane_lt counted_lane_lt
#define lane_le counted_lane_le
#define lane_div counted_lane_div
#define lane_pick counted_lane_pick
#define lane_keep counted_lane_keep
#define lane_sqrt counted_lane_sqrt

#define KERNEL(name) name##_counted
#include "../src/lane/lane.h"
#include "../src/bounce/gather.inl"

void bench_mix_gather(double counts[BENCH_OPS], const lmb_tile *tile, const lmb_groups *groups)
{
    static lmb_irradiance sums;
    static lmb_gather_scratch scratch;
    memset(&sums, 0, sizeof sums);
    memset(done, 0, sizeof done);
    gather_counted(&sums, &scratch, tile, groups, NULL);
    for (int op = 0; op < BENCH_OPS; ++op) {
        counts[op] = done[op] / (LMB_TILE_PIXELS / LANES) / groups->count;
    }
    (void)gather_near_counted;
}
