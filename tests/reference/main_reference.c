/* main_reference.c: compares the library's rasterizer with the slow ones: `reference` runs all, `reference hard` skips
 * the workloads. Ends with `N passed, N failed, N skipped`; exit status 1 if one failed. */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/bench/bench_scene.h"
#include "../shared_file.h"
#include "../test.h"
#include "accuracy.h"
#include "hard_sets.h"
#include "ref_draw.h"

int test_passed, test_failed, test_skipped;

static double percent(uint64_t part, uint64_t of) { return of > 0 ? 100.0 * (double)part / (double)of : 100.0; }

static void print_head(void)
{
    printf("Depth's error in ulps, by pixels: `alone` each triangle drawn by itself, `frame` all of them.\n"
           "%-22s %-6s %9s %8s %8s %8s %8s %8s %8s\n", "case", "", "pixels", "one only", "0, %", "<= 1, %", "<= 2, %",
           "<= 4, %", "worst");
}

static void print_errors(const char *name, const char *what, const error_count *n)
{
    printf("%-22s %-6s %9" PRIu64 " %8" PRIu64 " %8.4f %8.4f %8.4f %8.4f %8.2f\n", name, what, n->pixels, n->only_one,
           percent(n->none, n->pixels), percent(n->one, n->pixels), percent(n->two, n->pixels),
           percent(n->four, n->pixels), n->worst);
}

static void print_case(const char *name, const accuracy *a)
{
    print_errors(name, "alone", &a->alone);
    print_errors("", "frame", &a->frame);
    printf("%-22s outside its range %" PRIu64 ", past the bound %" PRIu64 ", unlike by %d backends %" PRIu64, "",
           a->outside, a->past_bound, a->backends, a->unlike);
    printf("; z-fights %" PRIu64 ", %.2f ulps\n", a->fights, a->fight_gap);
    printf("%-22s unsnapped: one only %" PRIu64 ", another triangle %" PRIu64 ", depth off by %.1e, at most %.1e\n", "",
           a->exact_only_one, a->exact_other, a->exact_mean, a->exact_max);
}

static void check_errors(const char *name, const error_count *n, int steep)
{
    CHECK_MSG(n->only_one == 0, "%s: %" PRIu64 " pixels", name, n->only_one);
    CHECK_MSG(steep || 1000 * n->four >= 999 * n->pixels, "%s: %.4f %% within 4 ulps", name,
              percent(n->four, n->pixels));
}

/* A plane with a large change of depth within a px exceeds 4 ulps; the rounding bound holds for all. */
static void run_case(const char *name, const lmb_view *view, const lmb_scene *scene, int cull, int steep)
{
    accuracy a;
    if (!accuracy_measure(&a, view, scene, cull)) {
        CHECK_MSG(0, "%s: out of memory", name);
        return;
    }
    print_case(name, &a);
    CHECK_MSG(a.alone.pixels > 0, "%s: nothing drawn", name);
    check_errors(name, &a.alone, steep);
    check_errors(name, &a.frame, steep);
    CHECK_MSG(a.past_bound == 0, "%s: %" PRIu64 " pixels", name, a.past_bound);
    CHECK_MSG(a.outside == 0, "%s: %" PRIu64 " pixels", name, a.outside);
    CHECK_MSG(a.unlike == 0, "%s: %" PRIu64 " pixels", name, a.unlike);
}

static void run_hard_sets(void)
{
    static hard_set set;
    for (int i = 0; i < HARD_SETS; ++i) {
        char name[64];
        hard_set_make(&set, i);
        snprintf(name, sizeof name, "%s%s", set.name, i & 1 ? "-ortho" : "");
        run_case(name, &set.view, &set.scene, set.cull, set.steep);
    }
}

/* The same eye and axes, without perspective: objects at 60 % of the far plane's distance keep their size. */
static void see_orthographic(lmb_view *v)
{
    v->kind = LMB_ORTHOGRAPHIC;
    v->half_width *= 0.5f * v->far_m;
    v->half_height *= 0.5f * v->far_m;
}

static void run_bench_case(const bench_case *k, const char *folder, int orthographic)
{
    bench_scene s;
    report r = {""};
    char name[64];
    snprintf(name, sizeof name, "%s%s", k->name, orthographic ? "-ortho" : "");
    if (!bench_scene_load(&s, k, folder, &r)) {
        CHECK_MSG(0, "%s", r.text);
        return;
    }
    if (orthographic) {
        see_orthographic(&s.view);
    }
    run_case(name, &s.view, &s.scene, k->cull, 0);
    bench_scene_free(&s);
}

static void run_workload(void)
{
    char path[SHARED_PATH];
    for (int i = 0; i < bench_case_count; ++i) {
        const bench_case *k = &bench_cases[i];
        const int made = k->scene >= BENCH_FILL_PASS;
        if (k->look != BENCH_DEPTH) {
            continue;
        }
        if (made || shared_file(path, k->scene == BENCH_BUNNY ? "bench/bunny.mesh" : "bench/sponza.mesh")) {
            *(made ? path : strrchr(path, '/')) = 0;
            run_bench_case(k, path, 0);
            if (!made && k->width == 1024 && !k->cull && k->scene != BENCH_SPONZA_INSIDE) {
                run_bench_case(k, path, 1);
            }
        }
    }
}

int main(int argc, char **argv)
{
    if (argc > 2 || (argc == 2 && strcmp(argv[1], "hard") != 0)) {
        printf("FAIL reference takes `hard` or nothing, not `%s`\n", argv[argc - 1]);
        return 2;
    }
    print_head();
    run_hard_sets();
    ref_draw_lines();
    ref_draw_blends();
    ref_draw_fogs();
    if (argc < 2) {
        run_workload();
    }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
