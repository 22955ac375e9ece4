/* bench_rates.c: times the backends' loops, and computes a lower bound for a mix of operations. */
#include "bench_rates.h"

#include <stddef.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../src/lane/backends.h"

const char *const bench_op_names[BENCH_OPS] = {"mul", "add", "max", "div", "cmp", "pick", "sqrt"};

#define DECLARE(upper, lower) extern const bench_backend bench_backend_##lower;
LMB_BACKENDS(DECLARE)

static const bench_backend *const backends[] = {
#define BACKEND_OF(upper, lower) LMB_IF(LMB_HAVE_##upper, &bench_backend_##lower, )
    LMB_BACKENDS(BACKEND_OF)};

enum { ROUNDS = 1024, CHAIN = 16, IN_CACHE = 4096 /* floats */ };
static const double never = 1e30;

static void keep_min(double *inout, double v) { *inout = v < *inout ? v : *inout; }

/* Dependent operations of one cycle. They are of two kinds, because a compiler would replace a chain of equal additions
 * by a multiplication. */
static double cycle_seconds(void)
{
    static volatile uint32_t seed = 12345;
    const uint32_t a = seed, b = a ^ seed << 7;
    const double start = host_seconds();
    uint32_t x = b;
    for (int i = 0; i < 2 * ROUNDS; ++i) {
        x += a, x ^= b, x += a, x ^= b, x += a, x ^= b, x += a, x ^= b;
        x += a, x ^= b, x += a, x ^= b, x += a, x ^= b, x += a, x ^= b;
    }
    const double seconds = host_seconds() - start;
    seed = x | 1;
    return seconds / (2.0 * ROUNDS * CHAIN);
}

static void time_loop(double *min, bench_loop *loop)
{
    float in[BENCH_ROWS][16], out[16];
    for (int i = 0; i < BENCH_ROWS; ++i) {
        for (int k = 0; k < 16; ++k) {
            in[i][k] = i == 0 ? 1.0f : i == 1 ? 1e-12f : 1.0f + (float)((5 * i + 3 * k) % 16) / 16.0f;
        }
    }
    const double start = host_seconds();
    loop(out, ROUNDS, in[0]);
    keep_min(min, (host_seconds() - start) / ROUNDS);
}

double bench_rates_store(bench_rates *r)
{
    static float depth[IN_CACHE];
    memset(depth, 0, sizeof depth);
    const double start = host_seconds();
    r->backend->store(depth, IN_CACHE, 8);
    keep_min(&r->store, (host_seconds() - start) / (8.0 * IN_CACHE));
    return 1.0 / r->store;
}

double bench_rates_read(bench_rates *r)
{
    static float in[IN_CACHE];
    float out[16];
    const double start = host_seconds();
    r->backend->read(out, in, IN_CACHE, ROUNDS);
    keep_min(&r->read, (host_seconds() - start) / ((double)ROUNDS * r->backend->lanes));
    return 1.0 / r->read;
}

int bench_rates_begin(bench_rates *out, const char *name)
{
    out->backend = NULL;
    for (size_t i = 0; i < sizeof backends / sizeof *backends; ++i) {
        if (strcmp(backends[i]->name, name) == 0) {
            out->backend = backends[i];
        }
    }
    out->cycle = out->store = out->read = never;
    for (int a = 0; a < BENCH_OPS; ++a) {
        out->alone[a] = never;
        for (int unit = 0; unit < BENCH_UNITS; ++unit) {
            out->beside[unit][a] = never;
        }
    }
    return out->backend != NULL;
}

void bench_rates_step(bench_rates *r)
{
    for (int a = 0; a < BENCH_OPS; ++a) {
        keep_min(&r->cycle, cycle_seconds());
        time_loop(&r->alone[a], r->backend->alone[a]);
        for (int unit = 0; unit < BENCH_UNITS; ++unit) {
            time_loop(&r->beside[unit][a], r->backend->beside[unit][a]);
        }
    }
}

double bench_rates_op(const bench_rates *r, int op)
{
    return r->alone[op] / (BENCH_BUSY(op) * r->backend->chains) / r->cycle;
}

double bench_rates_load(const bench_rates *r, int unit, int op)
{
    const double more = (r->beside[unit][op] - r->alone[unit]) / BENCH_BESIDE(unit) / r->cycle;
    const double max = bench_rates_op(r, op);
    return unit == op || more > max ? max : more > 0.0 ? more : 0.0;
}

double bench_rates_bound(int *unit, const bench_rates *r, const double counts[BENCH_OPS])
{
    double max = 0.0;
    for (int u = 0; u < BENCH_UNITS; ++u) {
        double sum = 0.0;
        for (int op = 0; op < BENCH_OPS; ++op) {
            sum += counts[op] * bench_rates_load(r, u, op);
        }
        if (sum > max) {
            max = sum;
            *unit = u;
        }
    }
    return max;
}
