/* bench_operations.c: counts the kernels' operations by running the kernels with counting verbs. */
#include "bench_operations.h"

#include <string.h>

#include "../../src/lane/kernels.h"
#include "../../src/lane/lane_scalar.h"

/* Counts mask operations as instructions. */
#undef LANE_PLAIN

static double done[BENCH_OPS], touched, reads;

/* Counts multiplications by group constants, too. */
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

/* Depths are counted by rows: filling writes each depth that it has read and tested. */
static inline void counted_lane_store_rows(float *p, int32_t step, lane a)
{
    touched += LANES;
    lane_store_rows(p, step, a);
}

static inline lane counted_lane_gather_f32(const float *p, lanei at)
{
    reads += LANES;
    return lane_gather_f32(p, at);
}

#define lane_gather_f32 counted_lane_gather_f32

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

#define lane_store_rows counted_lane_store_rows

#define KERNEL(name) name##_counted
#include "../../src/lane/lane.h"

#include "../../src/raster/setup.inl"
#include "../../src/raster/fill.inl"
#include "../../src/raster/fill_small.inl"
#include "../../src/raster/fill_large.inl"
#include "../../src/raster/culled.inl"
#include "../../src/raster/resolve.inl"
#include "../../src/raster/texture.inl"
#include "../../src/bounce/gather.inl"
#include "../../src/frame/encode.inl"

/* Those that the raster workload and the gather measurement use. */
static const lmb_kernels kernels_counted = {
    .name = "counted",
    .lanes = LANES,
    .setup = setup_counted,
    .fill_small = fill_small_counted,
    .fill_large = fill_large_counted,
    .culled_small = culled_small_counted,
    .culled_large = culled_large_counted,
    .culled_box = culled_box_counted,
    .resolve_shown = resolve_shown_counted,
    .resolve_slots = resolve_slots_counted,
    .resolve_setup = resolve_setup_counted,
    .resolve = resolve_counted,
    .texture = texture_counted,
    .gather = gather_counted,
    .gather_near = gather_near_counted,
    .encode = encode_counted,
};

static void begin(void)
{
    memset(done, 0, sizeof done);
    touched = reads = 0.0;
}

void bench_operations_gather(double counts[BENCH_OPS], const lmb_tile *tile, const lmb_groups *groups)
{
    static lmb_irradiance sums;
    static lmb_gather_scratch scratch;
    memset(&sums, 0, sizeof sums);
    begin();
    gather_counted(&sums, &scratch, tile, groups, NULL);
    for (int op = 0; op < BENCH_OPS; ++op) {
        counts[op] = done[op] / (LMB_TILE_PIXELS / LANES) / groups->count;
    }
}

const lmb_kernels *bench_operations_begin(void)
{
    begin();
    return &kernels_counted;
}

double bench_operations_end(double counts[BENCH_OPS])
{
    for (int op = 0; op < BENCH_OPS; ++op) {
        counts[op] = done[op] * LANES;
    }
    return touched;
}

double bench_operations_reads(void) { return reads; }
