/* plan_run.c: scenes drawn by many settings, by one thread: time of each stage, counts, error. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../../tools/budget.h"
#include "../../tools/scene_look.h"
#include "../shared_file.h"
#include "plan_rows.h"

#define WINDOW  "--light sun:0,0,0:0.25,-0.7,-1:6,6,6 --eye -3.4,2.9,-1.6 --target 1,1.2,1.5 --fov 70"
#define CEILING "--light spot:0,1.55,0:0,-1,0:3,3,3:30,49 --eye 0,0.8,3.2 --target 0,0.8,0 --fov 38"
#define OUTSIDE "--light sun:0,0,0:0.4,-1,-0.3:5,5,5"

const plan_place plan_places[] = {
    {"demo", NULL, "", 1, 0},
    {"cornell", "truth/cornell/scene.gltf", "", 1, 0},
    {"corridor", "truth/corridor/scene.gltf", "", 1, 0},
    {"point_room", "truth/point_room/scene.gltf", "", 1, 0},
    {"Duck", "data/gltf/Duck.glb", "", 1, 0},
    {"bunny_room", "truth/bunny_room/scene.gltf", "", 0, 0},
    {"corner_contact", "truth/corner_contact/scene.gltf", "", 0, 0},
    {"two_lights", "truth/two_lights/scene.gltf", "", 0, 0},
    {"grazing_sun", "truth/grazing_sun/scene.gltf", "", 0, 0},
    {"living_room", "data/scenes/living_room.glb", WINDOW, 0, 0},
    {"sphere_box", "data/scenes/CornellBox-Sphere.obj", CEILING, 0, 0},
    {"level", "data/scenes/zdm2.obj", OUTSIDE, 0, 0},
    {"sponza", "truth/sponza/scene.gltf", "", 0, 1},
};
const int plan_place_count = sizeof plan_places / sizeof *plan_places;

enum { WIDTH = PLAN_WIDTH, HEIGHT = PLAN_HEIGHT, REFERENCE_TREE = 1024, WORDS = 24 };

/* The words of `text`, which is cut up, after those that are there. */
static int add_words(char **argv, int count, char *text)
{
    for (char *word = strtok(text, " "); word != NULL && count < WORDS; word = strtok(NULL, " ")) {
        argv[count++] = word;
    }
    return count;
}

int plan_open(render_job *j, const plan_place *at)
{
    char path[SHARED_PATH] = "demo", verb[] = "plan", options[200], own[256];
    char *argv[WORDS] = {verb, path};
    report r = {""};
    memset(j, 0, sizeof *j);
    if (at->path != NULL && !shared_file(path, at->path)) {
        return 0;
    }
    snprintf(options, sizeof options, "--size %dx%d --show irradiance --threads 1", WIDTH, HEIGHT);
    snprintf(own, sizeof own, "%s", at->options);
    if (!render_options_parse(&j->o, add_words(argv, add_words(argv, 2, options), own), argv, &r)) {
        printf("FAIL %s: %s\n", at->name, r.text);
        return 0;
    }
    j->o.view.is_quiet = 1;
    j->o.budget.error = 1.0f; /* so that a look is at all settings */
    if (!render_job_load(j, &r) || !render_job_set(j, &r)) {
        printf("FAIL %s: %s\n", at->name, r.text);
        return 0;
    }
    return 1;
}

static void keep_light(float *light, const render_job *j)
{
    const lmb_frame *f = &j->render->frame;
    const uint32_t *id = (const uint32_t *)f->eye.id.data;
    for (int32_t y = 0; y < f->view.frame_height; ++y) {
        for (int32_t x = 0; x < f->view.frame_width; ++x) {
            float *p = light + 3 * ((size_t)y * (size_t)f->view.frame_width + (size_t)x);
            const uint32_t here = id[(size_t)(y / 8) * (size_t)f->eye.id.stride_bytes / sizeof *id +
                                     (size_t)(x / 8 * 64 + y % 8 * 8 + x % 8)]; /* in tiles */
            memcpy(p, (const float *)f->out.data + 3 * ((size_t)y * (size_t)f->view.frame_width + (size_t)x),
                   3 * sizeof *p);
            p[0] = here != 0 ? p[0] : -1.0f;
        }
    }
}

int plan_draw(plan_run *out, float *light, render_job *j)
{
    report r = {""};
    lmb_render *d = j->render;
    budget_apply(j, &out->s);
    memset(&j->stats, 0, sizeof j->stats);
    memset(out->seconds, 0, sizeof out->seconds);
    if (!render_job_refit(j, &r) || lmb_render_begin(d, &j->frame) != LMB_OK) {
        return 0;
    }
    while (d->stage < LMB_STAGE_DONE && d->failed == LMB_OK) {
        const int32_t stage = d->stage;
        const clock_t start = clock();
        lmb_render_step(d, 64);
        out->seconds[stage] += (double)(clock() - start) / (double)CLOCKS_PER_SEC;
    }
    out->pairs = (double)j->stats.pairs;
    out->segments = (double)j->stats.segments;
    keep_light(light, j);
    return d->failed == LMB_OK;
}

double plan_seconds(const plan_run *r)
{
    double sum = 0.0;
    for (int i = 0; i < PLAN_TIMES; ++i) {
        sum += r->seconds[i];
    }
    return sum;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double plan_error(const float *a, const float *b, size_t pixels)
{
    double *e = malloc(pixels * sizeof *e), mean = 0.0, sum = 0.0;
    size_t n = 0;
    for (size_t i = 0; i < pixels && e != NULL; ++i) {
        const float *p = a + 3 * i, *q = b + 3 * i;
        if (p[0] >= 0.0f && q[0] >= 0.0f) {
            double square = 0.0;
            for (int c = 0; c < 3; ++c) {
                square += ((double)p[c] - (double)q[c]) * ((double)p[c] - (double)q[c]);
                mean += (double)q[c];
            }
            e[n++] = square;
        }
    }
    if (n == 0 || mean <= 0.0) {
        free(e);
        return 0.0;
    }
    qsort(e, n, sizeof *e, by_size);
    const size_t kept = n - n / 100;
    for (size_t i = 0; i < kept; ++i) {
        sum += e[i];
    }
    free(e);
    return sqrt(sum / (3.0 * (double)kept)) / (mean / (3.0 * (double)n));
}

float *plan_reference(render_job *j)
{
    plan_run r = {{REFERENCE_TREE, REFERENCE_TREE, 0.025f, 0.0075f, 1, LMB_OCCLUSION_EXACT}, {0}, 0, 0, 0};
    float *light = malloc((size_t)WIDTH * HEIGHT * 3 * sizeof *light);
    if (light != NULL && !plan_draw(&r, light, j)) {
        free(light);
        return NULL;
    }
    return light;
}

/* Trees, rungs of error and steps, one after another; heavy scenes: every other. */
static int setting(lmb_settings *s, int i, int heavy)
{
    static const int32_t trees[] = {64, 128, 256, 512}, steps[] = {1, 2, 4};
    static const float errors[] = {0.01f, 0.028284271f, 0.11313708f}; /* the first is the look's own */
    s->tree = s->light_map = trees[i % 4];
    s->error = errors[i / 4 % 3];
    s->visible = LMB_FACT_VISIBLE * s->error;
    s->gather_step = steps[i / 12 % 3];
    s->occlusion = LMB_OCCLUSION_EXACT;
    return i < 36 && (!heavy || s->error > 0.1f);
}

int plan_measure(plan_scene *out, const plan_place *at)
{
    static render_job j;
    report r = {""};
    const size_t pixels = (size_t)WIDTH * HEIGHT;
    memset(out, 0, sizeof *out);
    if (!plan_open(&j, at)) {
        return 0;
    }
    snprintf(out->name, sizeof out->name, "%s", at->name);
    out->fits = at->fits;
    float *reference = NULL, *light = malloc(pixels * 3 * sizeof *light);
    int ok = light != NULL && scene_look(&out->facts, &j, &r) && (reference = plan_reference(&j)) != NULL;
    for (int i = 0; i < 36 && ok; ++i) {
        plan_run *run = &out->run[out->runs];
        if (setting(&run->s, i, at->heavy)) {
            ok = plan_draw(run, light, &j);
            run->error = plan_error(light, reference, pixels);
            ++out->runs;
        }
    }
    free(light);
    free(reference);
    render_job_free(&j);
    return ok;
}
