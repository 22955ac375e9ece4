/* relight_filters.c: irradiance at five places of truth/env_relight by every filter: errors, times and instructions.
 *
 * `alone` filters the true surroundings of a place, six faces of 64 x 64, through the same map; `remap` computes the
 * surroundings from the world's centre and the ground's picture. Errors are those of 6 x 8 x 8 normals. */
#include <string.h>

#include "../truth_scene.h"
#include "relight_stage.h"

/* Over the places. */
typedef struct summary {
    double sum, worst, largest;
    int places;
} summary;

static void add_place(summary *s, const relight_stage *stage, int place, int side)
{
    char file[40];
    image truth = {0};
    snprintf(file, sizeof file, "pos%d_irradiance%d.pfm", place + 1, side);
    if (truth_picture(&truth, "env_relight", file)) {
        const relight_error e = relight_compare(stage->cube, truth.pixels, 6 * side * side);
        s->sum += e.rmse;
        s->worst = e.rmse > s->worst ? e.rmse : s->worst;
        s->largest = e.largest > s->largest ? e.largest : s->largest;
        ++s->places;
    }
    image_free(&truth);
}

/* [FILTERS]: cosines of 32 x 32 faces. */
typedef struct errors {
    summary alone[FILTERS + 1], remap[FILTERS + 1];
} errors;

static void filter_all(summary out[FILTERS + 1], relight_stage *s, int place, lmb_vec3 at)
{
    for (int f = 0; f <= FILTERS; ++f) {
        const int side = f == FILTERS ? MAX_SIDE : SIDE;
        relight_update(s, f == FILTERS ? COSINE : f, at, side);
        add_place(&out[f], s, place, side);
    }
}

static void measure(errors *e, relight_stage *s)
{
    const lmb_vec3 origin = {0, 0, 0};
    for (int i = 0; i < PLACES; ++i) {
        if (relight_take_place(s, i)) {
            filter_all(e->alone, s, i, origin);
        }
    }
    if (relight_take_centre(s)) {
        for (int i = 0; i < PLACES; ++i) {
            filter_all(e->remap, s, i, relight_places[i]);
        }
    }
}

/* --- times -------------------------------------------------------------------------------------------------------- */

enum { REMAP, REDUCE, COSINES, HARMONICS, FROM_9, FROM_25, HALVE, BLUR_SOURCE, BLUR_FIT_1, BLUR_FIT_2, MAP_CUBE,
       STAGES };
static const char *const stage_names[STAGES] = {
    "remap to 128 x 64",     "reduce to 6 x 8 x 8 lights", "cosine",
    "harmonics of the map",  "cube from 9 harmonics",      "cube from 25 harmonics",
    "halve twice",           "blur of 32 x 16",            "blur1 of 32 x 16",
    "blur2 of 32 x 16",      "cube from the map"};

typedef struct job {
    relight_stage *s;
    int filter, stage;
} job;

static void update(void *context)
{
    const job *j = context;
    relight_update(j->s, j->filter, relight_places[0], SIDE);
}

static void step(void *context)
{
    const job *j = context;
    relight_stage *s = j->s;
    const float (*h)[LMB_SH_25] = (const float (*)[LMB_SH_25])s->harmonics;
    switch (j->stage) {
    case REMAP: lmb_probe_remap(s->map, s->kernels, &s->world, &s->table[0], relight_places[0], 0); break;
    case REDUCE: lmb_probe_reduce(&s->lights, s->kernels, s->map, &s->table[0]); break;
    case COSINES: lmb_probe_cosine(s->cube, SIDE, s->kernels, &s->lights, &s->table[0]); break;
    case HARMONICS: lmb_probe_sh(s->harmonics, s->map, &s->table[0]); break;
    case FROM_9: lmb_probe_sh_cube(s->cube, SIDE, h, LMB_SH_9); break;
    case FROM_25: lmb_probe_sh_cube(s->cube, SIDE, h, LMB_SH_25); break;
    case HALVE:
        lmb_probe_halve(s->half, s->map, &s->table[0]);
        lmb_probe_halve(s->half, s->half, &s->table[1]);
        break;
    case MAP_CUBE: lmb_probe_map_cube(s->cube, SIDE, s->blurred, &s->table[2]); break;
    default:
        lmb_probe_blur_map(s->blurred, s->kernels, s->line, s->half, &s->blur[j->stage - BLUR_SOURCE]);
        break;
    }
}

static double time_of(relight_stage *s, const lmb_kernels *kernels, int filter, int stage)
{
    job j = {s, filter, stage};
    const lmb_kernels *own = s->kernels;
    if (kernels == NULL) {
        return 0.0;
    }
    s->kernels = kernels;
    const double seconds = relight_seconds(stage < 0 ? update : step, &j);
    s->kernels = own;
    return seconds;
}

/* Instructions of one update, as counted by the script; "-" without counts. */
static const char *count_of(char out[32], const char *counts, int filter)
{
    char line[80], name[32], number[32];
    FILE *f = counts != NULL ? fopen(counts, "r") : NULL;
    strcpy(out, "-");
    while (f != NULL && fgets(line, sizeof line, f) != NULL) {
        if (sscanf(line, "%31s %31s", name, number) == 2 && strcmp(name, filter_names[filter]) == 0) {
            memcpy(out, number, sizeof number);
        }
    }
    if (f != NULL) {
        fclose(f);
    }
    return out;
}

/* --- tables ------------------------------------------------------------------------------------------------------- */

enum { OBJECTS = 200 }; /* in a frame, by the fastest filter */
static const double frame_s = 1.0 / 60.0;

static void print_errors(const char *name, const summary *alone, const summary *remap)
{
    printf("| %s | %.2f | %.2f | %.1f | %.2f | %.2f | %.1f |", name, 100.0 * alone->sum / alone->places,
           100.0 * alone->worst, 100.0 * alone->largest, 100.0 * remap->sum / remap->places, 100.0 * remap->worst,
           100.0 * remap->largest);
}

/* bar: limit of the worst place in percent; 0: no bar. */
static void check(const char *name, const summary *alone, const summary *remap, const double bar[2])
{
    CHECK_MSG(bar[0] <= 0.0 || 100.0 * alone->worst <= bar[0], "%s alone: %.3f %%", name, 100.0 * alone->worst);
    CHECK_MSG(bar[1] <= 0.0 || 100.0 * remap->worst <= bar[1], "%s: %.3f %%", name, 100.0 * remap->worst);
}

static void table_of_filters(relight_stage *s, const errors *e, const char *counts)
{
    static const double bar[FILTERS + 1][2] = {{0.5, 0.6}, {0, 1.5}, {0, 0}, {0.8, 0.8}, {0, 0}, {0, 5.0}, {0, 2.0},
                                               {0.5, 0.6}};
    const lmb_kernels *avx2 = lmb_kernels_named("avx2");
    printf("Errors in percent: rmse of the mean (mean and worst of five places), largest error of the largest.\n"
           "Times of one update in us, remap and filter and cube; objects: as many in 1/60 s of one core.\n\n"
           "| filter | alone: mean | worst | largest | remap: mean | worst | largest | us, %s | objects | us, avx2 | "
           "objects | instructions, avx2 |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
           lmb_kernels_name(s->kernels));
    double quickest = 1.0;
    for (int f = 0; f < FILTERS; ++f) {
        char count[32];
        const double best = time_of(s, s->kernels, f, -1), second = time_of(s, avx2, f, -1);
        print_errors(filter_names[f], &e->alone[f], &e->remap[f]);
        printf(" %.1f | %.0f | %.1f | %.0f | %s |\n", 1e6 * best, frame_s / best, 1e6 * second,
               avx2 != NULL ? frame_s / second : 0.0, count_of(count, counts, f));
        check(filter_names[f], &e->alone[f], &e->remap[f], bar[f]);
        quickest = best < quickest ? best : quickest;
    }
    print_errors("cosine, 32 x 32", &e->alone[FILTERS], &e->remap[FILTERS]);
    printf(" | | | | |\n\n");
    CHECK_MSG(frame_s / quickest >= OBJECTS, "%.0f objects", frame_s / quickest);
    check("cosine, 32 x 32", &e->alone[FILTERS], &e->remap[FILTERS], bar[FILTERS]);
}

static void table_of_stages(relight_stage *s)
{
    const lmb_kernels *avx2 = lmb_kernels_named("avx2");
    printf("| stage | us, %s | us, avx2 |\n|---|---|---|\n", lmb_kernels_name(s->kernels));
    for (int i = 0; i < STAGES; ++i) {
        printf("| %s | %.1f | %.1f |\n", stage_names[i], 1e6 * time_of(s, s->kernels, 0, i),
               1e6 * time_of(s, avx2, 0, i));
    }
    printf("\n");
}

void relight_tell_filters(relight_stage *s, const char *counts)
{
    static errors e;
    memset(&e, 0, sizeof e);
    measure(&e, s);
    if (e.remap[0].places == PLACES && e.alone[0].places == PLACES) {
        table_of_filters(s, &e, counts);
        table_of_stages(s);
    }
}
