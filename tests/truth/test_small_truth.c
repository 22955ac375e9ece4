/* test_small_truth.c: compares six small scenes with our own path tracer, which shares no code with src/. [V25]
 *
 * Bounced light is in tests/truth/small, 64 x 64 pixels each; `make small-truth` recomputes it. Direct light is exact
 * and traced here. The test needs nothing outside the repository. make check-all also draws quick scenes by
 * `best`, and make nightly all scenes. */
#include "../own_scene.h"
#include <math.h>

#include "path.h"

void test_small_truth(void);

enum { SIDE = OWN_LARGEST, BLOCK = 8, PRESETS = 3, FEW = 4 };

/* Maximum growth of a figure. Compilers and processors give the same pictures, so only a change
 * of code can cause growth. */
static const double slack = 1.3;

/* Maximum distance of the mean from the truth's. */
static const double mean_bar = 0.01;

typedef struct small_row {
    const char *name;
    int bounces, best_is_slow;
    double error[PRESETS][3]; /* trim, rmse, worst */
} small_row;

static const char *const presets[PRESETS] = {"draft", "default", "best"};

/* Results of the path tracer in this run. */
static float surface[SIDE * SIDE * 3], direct[SIDE * SIDE * 3], bounced[SIDE * SIDE * 3];

static void put(float *to, const double rgb[3])
{
    for (int c = 0; c < 3; ++c) {
        to[c] = (float)rgb[c];
    }
}

/* Traces surfaces, direct light and rough bounced light; returns 1 if the scene has lights other than emitters. */
static int trace(const small_row *row)
{
    made_scene s;
    path_tracer p;
    test_rng random = {1};
    const int ok = scene_make(&s, row->name) && path_open(&p, &s);
    CHECK_MSG(ok, "%s: no scene, or no memory", row->name);
    if (!ok) {
        return 0;
    }
    for (int i = 0; i < SIDE * SIDE; ++i) {
        path_point seen;
        double straight[3] = {0, 0, 0}, reflected[3] = {0, 0, 0};
        const int is_surface = path_eye(&p, &seen, i % SIDE, i / SIDE, SIDE);
        if (is_surface) {
            path_direct(&p, &seen, straight);
            path_bounced(&p, &seen, row->bounces, FEW, &random, reflected);
        }
        surface[3 * i + 2] = (float)is_surface;
        put(direct + 3 * i, straight);
        put(bounced + 3 * i, reflected);
    }
    const int has_lights = s.light_count > 0;
    path_close(&p);
    scene_drop(&s);
    return has_lights;
}

static double block_sum(const float *pixels, int block, int c)
{
    const int across = SIDE / BLOCK, x0 = block % across * BLOCK, y0 = block / across * BLOCK;
    double sum = 0.0;
    for (int i = 0; i < BLOCK * BLOCK; ++i) {
        sum += (double)pixels[3 * ((y0 + i / BLOCK) * SIDE + x0 + i % BLOCK) + c];
    }
    return sum;
}

/* Checks that the scene did not change after its truth was made, by comparing blocks of pixels. */
static void check_truth_is_of_scene(const small_row *row, const image *truth)
{
    const int blocks = SIDE / BLOCK * (SIDE / BLOCK);
    double off = 0.0, mean = 0.0;
    for (int i = 0; i < 3 * blocks; ++i) {
        const double want = block_sum(truth->pixels, i / 3, i % 3), d = block_sum(bounced, i / 3, i % 3) - want;
        off += d * d / (3 * blocks);
        mean += want / (3 * blocks);
    }
    printf("  %-13s %d paths a pixel are %.4f off the truth that is kept\n", row->name, FEW * FEW, sqrt(off) / mean);
    CHECK_MSG(sqrt(off) <= 0.1 * mean, "%s: the truth is of another scene (make small-truth): %g", row->name,
              sqrt(off) / mean);
}

/* Exact up to rounding, except for pixels at the edges of shadows. */
static void check_direct_light(const small_row *row)
{
    image truth = {SIDE, SIDE, 3, direct};
    const own_how how = {"default", "direct", SIDE, 1, &truth, surface};
    const scene_place place = scene_as_it_is();
    own_drawn d;
    own_draw_as(&d, row->name, &place, &how);
    printf("  %-13s direct   trim %.6f, rmse %.4f, mean %.4f\n", row->name, d.error.trim, d.error.rmse, d.error.mean);
    CHECK_MSG(d.error.trim <= 3e-6, "%s, direct light: trim %g", row->name, d.error.trim);
    CHECK_MSG(d.error.rmse <= 0.02, "%s, direct light: rmse %g", row->name, d.error.rmse);
}

static void check_bounced_light(const small_row *row, const image *truth)
{
    const scene_place place = scene_as_it_is();
    const int count = test_length() > row->best_is_slow ? PRESETS : PRESETS - 1;
    for (int q = 0; q < count; ++q) {
        const own_how how = {presets[q], "indirect", SIDE, row->bounces, truth, surface};
        own_drawn d;
        own_draw_as(&d, row->name, &place, &how);
        printf("  %-13s %-8s trim %.4f, rmse %.4f, worst %.4f, mean %.4f, %.2f M pairs, %.2f M segments\n", row->name,
               presets[q], d.error.trim, d.error.rmse, d.worst, d.error.mean, d.pairs * 1e-6, d.segments * 1e-6);
        CHECK_MSG(d.error.trim <= slack * row->error[q][0], "%s, %s: trim %g", row->name, presets[q], d.error.trim);
        CHECK_MSG(d.error.rmse <= slack * row->error[q][1], "%s, %s: rmse %g", row->name, presets[q], d.error.rmse);
        CHECK_MSG(d.worst <= slack * row->error[q][2], "%s, %s: worst %g", row->name, presets[q], d.worst);
        CHECK_MSG(fabs(d.error.mean - 1.0) <= mean_bar, "%s, %s: mean %g", row->name, presets[q], d.error.mean);
    }
}

static void check_small(const small_row *row)
{
    image truth;
    char path[256];
    snprintf(path, sizeof path, "tests/truth/small/%s.hdr", row->name);
    const int has_lights = trace(row);
    if (picture_file(&truth, path, hdr_decode)) {
        check_truth_is_of_scene(row, &truth);
        if (has_lights) {
            check_direct_light(row);
        }
        check_bounced_light(row, &truth);
        image_free(&truth);
    }
}

void test_small_truth(void)
{
    static const small_row rows[] = {
#define SMALL_TRUTH(kind, bounces, strata, slow, t0, r0, w0, t1, r1, w1, t2, r2, w2) \
    {#kind, bounces, slow, {{t0, r0, w0}, {t1, r1, w1}, {t2, r2, w2}}},
#include "small_truths.inc"
#undef SMALL_TRUTH
    };
    for (int i = 0; i < COUNT_OF(rows); ++i) {
        check_small(&rows[i]);
    }
}
