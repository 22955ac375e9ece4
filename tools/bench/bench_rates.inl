/* bench_rates.inl: part of `lambent-bench` (tools/bench): loops that keep an execution unit busy with one operation and
 * add a little of another. Each bench_rates_BACKEND.c compiles it for one backend.
 *
 * The including file defines KERNEL(name), BACKEND and CHAINS, half of the operations in flight. Inputs are read from
 * memory, so that compilers cannot evaluate anything; values stay between 1 and 2. */
#include <lambent/types.h>

#include "../../src/lane/lane.h"
#include "bench_rates.h"

/* One operation on x. z is another changing value, some and other are masks: each step depends on the previous one. */
#define BENCH_STEP_MUL(x, z, s)  x = lane_mul(x, one);
#define BENCH_STEP_ADD(x, z, s)  x = lane_add(x, min);
#define BENCH_STEP_MAX(x, z, s)  x = (s) & 1 ? lane_min(x, z) : lane_max(x, z);
#define BENCH_STEP_CMP(x, z, s)  seen = mask_or(seen, lane_lt(x, z));
#define BENCH_STEP_KEEP(x, z, s) \
    x = lane_keep(lane_lt(min, x), x); /* a comparison, if x changes by nothing else */
#define BENCH_STEP_PICK(x, z, s) x = (s) & 1 ? lane_pick(some, x, z) : lane_pick(other, x, z);
#define BENCH_STEP_DIV(x, z, s)  x = lane_div(high, x);
#define BENCH_STEP_SQRT(x, z, s) x = lane_sqrt(lane_add(x, one)); /* the sum keeps x from converging to 1 */

#if CHAINS == 1
#define BENCH_EACH(A, s) A(x0, y0, s) A(y0, x0, s)
#else
#define BENCH_EACH(A, s) \
    A(x0, x1, s) A(y0, y1, s) A(x1, x2, s) A(y1, y2, s) A(x2, x3, s) A(y2, y3, s) \
    A(x3, x4, s) A(y3, y4, s) A(x4, x0, s) A(y4, y0, s)
#endif

/* The operations of one round: of the busy unit, and the added ones; see BENCH_BUSY, BENCH_BESIDE. */
#define BENCH_ROUND_FAST(A, B) \
    BENCH_EACH(A, 0) B(v, x0, 0) BENCH_EACH(A, 1) BENCH_EACH(A, 2) B(w, y0, 1) BENCH_EACH(A, 3)
#define BENCH_ROUND_SLOW(A, B) \
    BENCH_EACH(A, 0) B(v, x0, 0) B(w, y0, 1) B(v, x1, 1) B(w, y1, 0)
#define BENCH_NOTHING(x, z, s)

#define BENCH_ROW(i) lane_load(in + 16 * (i))

#define BENCH_LOOP(name, ROUND, A, B) \
    static void KERNEL(name)(float *out, uint32_t rounds, const float *in) \
    { \
        const lane one = BENCH_ROW(0), min = BENCH_ROW(1), high = BENCH_ROW(3); \
        const lane_mask some = lane_lt(BENCH_ROW(4), BENCH_ROW(5)), other = lane_lt(BENCH_ROW(6), BENCH_ROW(7)); \
        lane x0 = BENCH_ROW(2), x1 = BENCH_ROW(8), x2 = BENCH_ROW(9), x3 = BENCH_ROW(10), x4 = BENCH_ROW(11); \
        lane y0 = BENCH_ROW(3), y1 = BENCH_ROW(12), y2 = BENCH_ROW(13), y3 = BENCH_ROW(14), y4 = BENCH_ROW(15); \
        lane v = BENCH_ROW(16), w = BENCH_ROW(17); \
        lane_mask seen = other; \
        for (; rounds != 0; --rounds) { \
            ROUND(A, B) \
        } \
        x0 = lane_add(lane_add(lane_add(x0, x1), lane_add(x2, x3)), x4); \
        y0 = lane_add(lane_add(lane_add(y0, y1), lane_add(y2, y3)), y4); \
        lane_store(out, lane_add(lane_add(x0, y0), lane_add(v, lane_keep(seen, w)))); \
        (void)one, (void)min, (void)high, (void)some, (void)other; /* for other operations */ \
    }

#define BENCH_UNIT(A, ROUND, P) \
    P(A, ROUND, MUL) P(A, ROUND, ADD) P(A, ROUND, MAX) P(A, ROUND, DIV) \
    P(A, ROUND, CMP) P(A, ROUND, PICK) P(A, ROUND, SQRT)
#define BENCH_ALL_UNITS(P) \
    BENCH_UNIT(MUL, FAST, P) BENCH_UNIT(ADD, FAST, P) BENCH_UNIT(MAX, FAST, P) BENCH_UNIT(DIV, SLOW, P)

#define BENCH_BESIDE_LOOP(A, ROUND, B) BENCH_LOOP(loop_##A##_##B, BENCH_ROUND_##ROUND, BENCH_STEP_##A, BENCH_STEP_##B)
BENCH_ALL_UNITS(BENCH_BESIDE_LOOP)
BENCH_LOOP(loop_MUL, BENCH_ROUND_FAST, BENCH_STEP_MUL, BENCH_NOTHING)
BENCH_LOOP(loop_ADD, BENCH_ROUND_FAST, BENCH_STEP_ADD, BENCH_NOTHING)
BENCH_LOOP(loop_MAX, BENCH_ROUND_FAST, BENCH_STEP_MAX, BENCH_NOTHING)
BENCH_LOOP(loop_CMP, BENCH_ROUND_FAST, BENCH_STEP_KEEP, BENCH_NOTHING)
BENCH_LOOP(loop_PICK, BENCH_ROUND_FAST, BENCH_STEP_PICK, BENCH_NOTHING)
BENCH_LOOP(loop_DIV, BENCH_ROUND_SLOW, BENCH_STEP_DIV, BENCH_NOTHING)
BENCH_LOOP(loop_SQRT, BENCH_ROUND_SLOW, BENCH_STEP_SQRT, BENCH_NOTHING)

static void KERNEL(store_loop)(float *inout, uint32_t count, uint32_t rounds)
{
    for (lane depth = lane_splat(1.0f); rounds != 0; --rounds) {
        for (uint32_t k = 0; k < count; k += LANES) {
            const lane old = lane_load(inout + k);
            lane_store(inout + k, lane_pick(lane_lt(old, depth), depth, old));
        }
        depth = lane_add(depth, lane_splat(1.0f));
    }
}

/* Each lane reads a separate path through the table, in steps of 37. */
static void KERNEL(read_loop)(float *out, const float *in, int32_t count, uint32_t rounds)
{
    int32_t first[LANES];
    lane four[4], sum = lane_splat(0.0f);
    for (int k = 0; k < LANES; ++k) {
        first[k] = 11 * k;
    }
    for (lanei at = lanei_load(first); rounds != 0; --rounds) {
        lane_gather_rgba_f32(four, in, at);
        sum = lane_add(sum, lane_add(lane_add(four[0], four[1]), lane_add(four[2], four[3])));
        at = lanei_and(lanei_add(at, lanei_splat(37)), lanei_splat(count / 4 - 1));
    }
    lane_store(out, sum);
}

#define BENCH_ENTRY(A, ROUND, B) [BENCH_##A][BENCH_##B] = KERNEL(loop_##A##_##B),
const bench_backend KERNEL(bench_backend) = {
    BACKEND, LANES, 2 * CHAINS,
    {[BENCH_MUL] = KERNEL(loop_MUL), [BENCH_ADD] = KERNEL(loop_ADD), [BENCH_MAX] = KERNEL(loop_MAX),
     [BENCH_DIV] = KERNEL(loop_DIV), [BENCH_CMP] = KERNEL(loop_CMP), [BENCH_PICK] = KERNEL(loop_PICK),
     [BENCH_SQRT] = KERNEL(loop_SQRT)},
    {BENCH_ALL_UNITS(BENCH_ENTRY)},
    KERNEL(store_loop),
    KERNEL(read_loop),
};
