/* main_plan.c: the plan's model, fitted to some scenes and held against others.
 *
 *   figures-plan measure FILE [SCENE ...]   draw scenes by many settings: a file of rows (appended)
 *   figures-plan look FILE                  looks at the rows' scenes again
 *   figures-plan model FILE                 the model of the rows' fitting scenes, as src/plan/plan_model.inc
 *   figures-plan report FILE                predicted against measured
 *   figures-plan choose FILE [SCENE ...]    chosen settings, drawn, against the sweep's best */
#include <stdlib.h>
#include <string.h>

#include "../../tools/scene_look.h"
#include "../test.h"
#include "plan_rows.h"

int test_passed, test_failed, test_skipped;

#define NONE 1e30

static plan_scene scenes[PLAN_SCENES];

/* Structs of plain numbers of this very program and machine. */
static int read_rows(const char *path)
{
    FILE *f = fopen(path, "rb");
    int count = 0;
    while (f != NULL && count < PLAN_SCENES && fread(&scenes[count], sizeof *scenes, 1, f) == 1) {
        ++count;
    }
    if (f != NULL) {
        fclose(f);
    }
    return count;
}

/* What a look finds, after a change of looks; what was drawn stands. */
static void look_again(const char *path, int count)
{
    static render_job j;
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < plan_place_count; ++k) {
            report r = {""};
            if (strcmp(plan_places[k].name, scenes[i].name) == 0 && plan_open(&j, &plan_places[k])) {
                CHECK_MSG(scene_look(&scenes[i].facts, &j, &r), "%s", r.text);
                render_job_free(&j);
            }
        }
    }
    FILE *f = fopen(path, "wb");
    CHECK(f != NULL && fwrite(scenes, sizeof *scenes, (size_t)count, f) == (size_t)count);
    if (f != NULL) {
        fclose(f);
    }
}

static int is_wanted(const char *name, int argc, char **argv)
{
    int wanted = argc <= 3;
    for (int i = 3; i < argc; ++i) {
        wanted |= strcmp(argv[i], name) == 0;
    }
    return wanted;
}

static void measure(const char *path, int argc, char **argv)
{
    for (int i = 0; i < plan_place_count; ++i) {
        if (!is_wanted(plan_places[i].name, argc, argv)) {
            continue;
        }
        if (!plan_measure(&scenes[0], &plan_places[i])) {
            SKIP("%s: not here", plan_places[i].name);
            continue;
        }
        FILE *f = fopen(path, "ab");
        CHECK(f != NULL && fwrite(&scenes[0], sizeof *scenes, 1, f) == 1);
        if (f != NULL) {
            fclose(f);
        }
        printf("%-16s %d settings\n", scenes[0].name, scenes[0].runs);
        fflush(stdout);
    }
}

/* The least of the sweep's settings whose error is at most this: units of work, or seconds. */
static double best_of(const plan_scene *s, double error, double (*cost)(const plan_scene *, const plan_run *))
{
    double best = NONE;
    for (int i = 0; i < s->runs; ++i) {
        const double c = cost(s, &s->run[i]);
        best = s->run[i].error <= error && c < best ? c : best;
    }
    return best;
}

static double seconds_of(const plan_scene *s, const plan_run *r)
{
    (void)s;
    return plan_seconds(r);
}

static double least_error(const plan_scene *s)
{
    double least = 1e30;
    for (int i = 0; i < s->runs; ++i) {
        least = s->run[i].error < least ? s->run[i].error : least;
    }
    return least;
}

/* Three errors that the sweep reaches, chosen for and drawn. */
static void choose(const plan_scene *s, const plan_place *at)
{
    static render_job j;
    static const double over[3] = {1.3, 2.0, 4.0};
    if (!plan_open(&j, at)) {
        SKIP("%s: not here", at->name);
        return;
    }
    float *reference = plan_reference(&j), *light = malloc((size_t)PLAN_WIDTH * PLAN_HEIGHT * 3 * sizeof *light);
    for (int i = 0; i < 3 && reference != NULL && light != NULL; ++i) {
        lmb_budget b = {0.0, (float)(least_error(s) * over[i]), 0};
        lmb_choice c;
        plan_run run;
        CHECK(lmb_plan_choose(&c, &s->facts, &b, 0, 512) == LMB_OK);
        run.s = c.settings;
        run.s.light_map = run.s.tree; /* as the sweep's */
        CHECK(plan_draw(&run, light, &j));
        run.error = plan_error(light, reference, (size_t)PLAN_WIDTH * PLAN_HEIGHT);
        const double best = best_of(s, run.error, plan_work), ratio = plan_work(s, &run) / best;
        printf("%-15s%s wanted %.4f: tree %3d error %.3f step %d %s: error %.4f (predicted %.2f of it), pairs %.2f, "
               "segments %.2f; ",
               s->name, s->fits ? "*" : " ", (double)b.error, (int)c.settings.tree, (double)c.settings.error,
               (int)c.settings.gather_step, c.settings.occlusion == LMB_OCCLUSION_NONE ? "open" : "exact", run.error,
               (double)c.error / run.error, c.op[LMB_OP_PAIRS] / run.pairs,
               run.segments > 0.0 ? c.op[LMB_OP_SEGMENTS] / run.segments : 1.0);
        if (best < NONE) {
            printf("of the best at that error: work %.2f, seconds %.2f\n", ratio,
                   plan_seconds(&run) / best_of(s, run.error, seconds_of));
        } else {
            printf("none of the sweep has that error\n");
        }
        fflush(stdout);
        test_skipped += best >= NONE; /* better than all of the sweep */
        test_passed += best < NONE && ratio <= 1.3;
        test_failed += best < NONE && ratio > 1.3;
    }
    free(reference);
    free(light);
    render_job_free(&j);
}

int main(int argc, char **argv)
{
    if (argc < 3) {
        fprintf(stderr, "figures-plan measure|look|model|report|choose FILE [SCENE ...]\n");
        return 2;
    }
    if (strcmp(argv[1], "measure") == 0) {
        measure(argv[2], argc, argv);
    } else {
        const int count = read_rows(argv[2]);
        if (strcmp(argv[1], "model") == 0) {
            plan_fit(scenes, count, stdout);
            return count == 0;
        }
        if (strcmp(argv[1], "look") == 0) {
            look_again(argv[2], count);
        }
        test_failed += strcmp(argv[1], "report") == 0 ? plan_report(scenes, count) : 0;
        for (int i = 0; i < count && strcmp(argv[1], "choose") == 0; ++i) {
            for (int k = 0; k < plan_place_count; ++k) {
                if (strcmp(plan_places[k].name, scenes[i].name) == 0 && is_wanted(scenes[i].name, argc, argv)) {
                    choose(&scenes[i], &plan_places[k]);
                }
            }
        }
    }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
