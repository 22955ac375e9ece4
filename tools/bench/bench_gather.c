/* bench_gather.c: times the far gather on a tile that every group lights, against the processor's bound. */
#include "bench_gather.h"

#include <stdio.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "bench_operations.h"
#include "bench_rates.h"

enum { GROUPS = 256, CALLS = 16, ROW = 16 };

typedef struct workload {
    lmb_tile tile;
    lmb_groups groups;
    lmb_irradiance sums;
    lmb_gather_scratch scratch;
} workload;

/* A floor of 8 x 8 pixels 5 cm apart under a ceiling of 16 x 16 discs: all face each other at a distance. */
static void workload_make(workload *w)
{
    memset(w, 0, sizeof *w);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        w->tile.position[0][k] = 0.05f * (float)(k % LMB_TILE);
        w->tile.position[2][k] = 0.05f * (float)(k / LMB_TILE);
        w->tile.face[1][k] = 1.0f;
        w->tile.normal[0][k] = 0.6f * (float)(k % 3 - 1) * 0.1f;
        w->tile.normal[1][k] = 1.0f;
        w->tile.id[k] = 1;
    }
    w->tile.hits = LMB_TILE_PIXELS;
    w->groups.count = GROUPS < LMB_MAX_GROUPS ? GROUPS : LMB_MAX_GROUPS;
    for (int32_t j = 0; j < w->groups.count; ++j) {
        w->groups.position[0][j] = 0.2f * (float)(j % ROW - ROW / 2);
        w->groups.position[1][j] = 2.0f;
        w->groups.position[2][j] = 0.2f * (float)(j / ROW - ROW / 2);
        w->groups.normal[1][j] = -1.0f;
        w->groups.area[j] = 0.04f;
        w->groups.radius[j] = 0.14f;
        w->groups.flux[0][j] = w->groups.flux[1][j] = w->groups.flux[2][j] = 0.01f;
    }
}

/* Shortest time of one call, s. */
static void time_gather(double *min, workload *w, const lmb_kernels *kernels)
{
    for (int i = 0; i < CALLS; ++i) {
        const double start = host_seconds();
        lmb_gather_tile(&w->sums, kernels, &w->scratch, &w->tile, &w->groups, NULL, NULL);
        const double seconds = host_seconds() - start;
        *min = seconds < *min ? seconds : *min;
    }
}

static void print_ops(const char *name, const double value[BENCH_OPS], int json)
{
    printf(json ? ",\"%s\":{" : ",%s=", name);
    for (int op = 0; op < BENCH_OPS; ++op) {
        printf(json ? "%s\"%s\":%.3f" : "%s%s:%.3g", op > 0 ? json ? "," : "/" : "", bench_op_names[op], value[op]);
    }
    fputs(json ? "}" : "", stdout);
}

static void print_line(const lmb_kernels *kernels, double min, const bench_rates *r, const double counts[BENCH_OPS],
                       double pairs, int json)
{
    int unit = 0;
    const double cycles = min / pairs / r->cycle, bound = bench_rates_bound(&unit, r, counts) / r->backend->lanes;
    double alone[BENCH_OPS], load[BENCH_OPS];
    printf(
        json ? "{\"case\":\"gather\",\"backend\":\"%s\",\"pairs_per_s\":%.4g,\"cycles_per_pair\":%.3f,"
               "\"bound_cycles\":%.3f,\"share\":%.4f,\"unit\":\"%s\",\"ghz\":%.3f"
             : "lambent,gather,backend=%s,pairs_per_s=%.4g,cycles_per_pair=%.3f,bound_cycles=%.3f,share=%.4f,unit=%s,"
               "ghz=%.3f",
        lmb_kernels_name(kernels), pairs / min, cycles, bound, bound / cycles, bench_op_names[unit], 1e-9 / r->cycle);
    for (int op = 0; op < BENCH_OPS; ++op) {
        alone[op] = bench_rates_op(r, op);
        load[op] = bench_rates_load(r, unit, op);
    }
    print_ops("ops_per_vector", counts, json);
    print_ops("cycles_per_op", alone, json);
    print_ops("load_per_op", load, json);
    puts(json ? "}" : "");
    fflush(stdout);
}

/* Alternates the gather with the processor's loops, so that both see the same clock rate and load. */
static int bench_backend_gather(const lmb_kernels *kernels, const gather_options *o, report *r)
{
    static workload w;
    bench_rates rates;
    double counts[BENCH_OPS], min = 1e30;
    if (!bench_rates_begin(&rates, lmb_kernels_name(kernels))) {
        return report_fail(r, "%s: its rates are not known", lmb_kernels_name(kernels));
    }
    workload_make(&w);
    bench_operations_gather(counts, &w.tile, &w.groups);
    const double end = host_seconds() + o->seconds;
    do {
        time_gather(&min, &w, kernels);
        bench_rates_step(&rates);
    } while (host_seconds() < end);
    if (!o->is_quiet) {
        print_line(kernels, min, &rates, counts, (double)LMB_TILE_PIXELS * w.groups.count, o->json);
    }
    return 1;
}

int bench_gather(const gather_options *o, report *r)
{
    const lmb_kernels *kernels;
    if (o->kernels != NULL) {
        return bench_backend_gather(o->kernels, o, r);
    }
    for (int32_t i = 0; (kernels = lmb_kernels_at(i)) != NULL; ++i) {
        if (!bench_backend_gather(kernels, o, r)) {
            return 0;
        }
    }
    return 1;
}
