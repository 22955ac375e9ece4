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

/* The least time of the sweep's settings whose error is at most this. */
static double best_seconds(const plan_scene *s, double error)
{
    double best = 1e30;
    for (int i = 0; i < s->runs; ++i) {
        const double t = plan_seconds(&s->run[i]);
        best = s->run[i].error <= error && t < best ? t : best;
    }
    return best;
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
    float *reference = plan_reference(&j), *light = malloc((size_t)320 * 240 * 3 * sizeof *light);
    for (int i = 0; i < 3 && reference != NULL && light != NULL; ++i) {
        lmb_budget b = {0.0, (float)(least_error(s) * over[i]), 0};
        lmb_choice c;
        plan_run run;
        CHECK(lmb_plan_choose(&c, &s->facts, &b, 0, 512) == LMB_OK);
        run.s = c.settings;
        run.s.light_map = run.s.tree; /* as the sweep's */
        CHECK(plan_draw(&run, light, &j));
        run.error = plan_error(light, reference, (size_t)320 * 240);
        const double best = best_seconds(s, run.error), ratio = plan_seconds(&run) / best;
        printf("%-16s wanted %.4f: tree %4d error %.3f step %d %s: predicted %.4f, measured %.4f (%.2f), %.3f s, the "
               "sweep's best at that error %.3f s: %s%.2f\n",
               s->name, (double)b.error, (int)c.settings.tree, (double)c.settings.error, (int)c.settings.gather_step,
               c.settings.occlusion == LMB_OCCLUSION_NONE ? "open" : "exact", (double)c.error, run.error,
               (double)c.error / run.error, plan_seconds(&run), best < 1e29 ? best : 0.0, best < 1e29 ? "" : "none ",
               best < 1e29 ? ratio : 0.0);
        fflush(stdout);
        test_skipped += best >= 1e29; /* better than all of the sweep */
        test_passed += best < 1e29 && ratio <= 1.3;
        test_failed += best < 1e29 && ratio > 1.3;
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
