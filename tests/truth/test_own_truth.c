/* test_own_truth.c: compares pictures of tests/scenes with path-traced ones in tests/truth/small. [V25]
 *
 * Pictures of 32 x 32 pixels, one bounce, 2 x 160^2 samples a pixel, of scenes that no constant was fitted to. They
 * guard the presets' accuracy, upright and turned, if the shared folder of larger truth is missing. */
#include "../own_scene.h"
#include <math.h>

void test_own_truth(void);

/* Bars that a row does not meet yet: those figures are only printed. All other bars apply. */
enum { OPEN_DEFAULT = 1, OPEN_BEST = 2, OPEN_HALF = 4, OPEN_TURNED = 8 };

typedef struct own_row {
    const char *name, *file;
    double worst[2]; /* measured metrics_worst with default and best quality; the limit is 1.3 times that */
    double rmse[2];  /* likewise */
    double mean;     /* maximum distance from 1 */
    int open;
} own_row;

/* Bars of the presets for any scene, in trim. */
static const double best_bar = 0.03, default_bar = 0.06;

/* A finer preset never increases the error by more than a tenth, and must at least halve it. make check-all draws every
 * third scene by `best`, and make nightly all. */
static void check_errors(const own_row *row, int number, const image *truth, own_drawn *by_default)
{
    static const struct preset {
        const char *name;
        const double *bar;
        int open;
    } presets[] = {{"default", &default_bar, OPEN_DEFAULT}, {"best", &best_bar, OPEN_BEST}};
    const scene_place place = scene_as_it_is();
    const int count = test_length() < 2 && number % 3 != 0 ? 1 : COUNT_OF(presets);
    double trim[COUNT_OF(presets)];
    for (int i = 0; i < count; ++i) {
        own_drawn d;
        own_draw(&d, row->name, &place, presets[i].name, truth);
        trim[i] = d.error.trim;
        if (i == 0) {
            *by_default = d;
        }
        const int open = row->open & presets[i].open;
        printf("  %-12s %-8s trim %.4f, rmse %.4f, worst %.4f, mean %.4f, %.2f M pairs, %.2f M segments%s\n",
               row->name, presets[i].name, d.error.trim, d.error.rmse, d.worst, d.error.mean, d.pairs * 1e-6, d.segments * 1e-6,
               open ? " (open)" : "");
        CHECK_MSG(d.worst <= 1.3 * row->worst[i], "%s, %s: worst %g", row->name, presets[i].name, d.worst);
        CHECK_MSG(d.error.rmse <= 1.3 * row->rmse[i], "%s, %s: rmse %g", row->name, presets[i].name, d.error.rmse);
        CHECK_MSG(fabs(d.error.mean - 1.0) <= row->mean, "%s, %s: mean %g", row->name, presets[i].name, d.error.mean);
        CHECK_MSG(open || trim[i] <= *presets[i].bar, "%s, %s: trim %g", row->name, presets[i].name, trim[i]);
    }
    if (count == 1) {
        return;
    }
    CHECK_MSG(trim[1] <= 1.1 * trim[0], "%s: trim %g at best, %g by default", row->name, trim[1], trim[0]);
    CHECK_MSG((row->open & OPEN_HALF) || trim[1] <= 0.5 * trim[0], "%s: trim %g at best, %g by default", row->name,
              trim[1], trim[0]);
}

/* Turning the world changes neither the picture nor the work. make check-all turns every second scene once, and
 * make nightly turns all scenes twice. */
static void check_turns(const own_row *row, int number, const image *truth, const own_drawn *upright)
{
    enum { TURNS = 2 };
    for (int seed = 1; seed <= TURNS; ++seed) {
        if (test_length() < 2 && (number % 2 != 0 || seed - 1 != number / 2 % TURNS)) {
            continue;
        }
        own_drawn d;
        scene_place place = scene_as_it_is();
        scene_turn_any(&place, (uint64_t)seed);
        own_draw(&d, row->name, &place, "default", truth);
        const double pairs = d.pairs / upright->pairs, segments = d.segments / upright->segments,
                     trim = d.error.trim / upright->error.trim;
        printf("  %-12s turned %d: %.2f x the pairs, %.2f x the segments, %.2f x the trim%s\n", row->name, seed, pairs,
               segments, trim, row->open & OPEN_TURNED ? " (open)" : "");
        CHECK_MSG(pairs <= 1.3 && segments <= 1.3,
                  "%s turned %d: %g x the pairs, %g x the segments", row->name, seed, pairs, segments);
        CHECK_MSG((row->open & OPEN_TURNED) || trim <= 1.1, "%s turned %d: %g x the trim", row->name, seed, trim);
    }
}

void test_own_truth(void)
{
    static const own_row rows[] = {
        {"kitchen:2", "kitchen_2.pfm", {5.162, 5.181}, {0.117, 0.114}, 0.015, OPEN_HALF | OPEN_TURNED},
        {"grille:2", "grille_2.pfm", {1.258, 1.257}, {0.095, 0.091}, 0.015, OPEN_BEST | OPEN_HALF},
        {"blinds:2", "blinds_2.pfm", {0.590, 0.570}, {0.210, 0.208}, 0.08,
         OPEN_DEFAULT | OPEN_BEST | OPEN_HALF | OPEN_TURNED},
        {"railing:2", "railing_2.pfm", {0.205, 0.120}, {0.043, 0.028}, 0.01, OPEN_HALF},
        {"furnished:2", "furnished_2.pfm", {0.091, 0.075}, {0.017, 0.010}, 0.01, 0},
        {"louvres:2", "louvres_2.pfm", {0.369, 0.096}, {0.053, 0.044}, 0.02, OPEN_BEST | OPEN_HALF},
    };
    for (int i = 0; i < COUNT_OF(rows); ++i) {
        image truth;
        own_drawn upright = {0};
        if (own_truth(&truth, rows[i].file)) {
            check_errors(&rows[i], i, &truth, &upright);
            check_turns(&rows[i], i, &truth, &upright);
            image_free(&truth);
        }
    }
}
