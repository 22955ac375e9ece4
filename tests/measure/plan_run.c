/* plan_run.c: draws scenes by many settings on one thread: time of each stage, counts. */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../../tools/render/budget.h"
#include "../../tools/render/scene_sample.h"
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

enum { WIDTH = PLAN_WIDTH, HEIGHT = PLAN_HEIGHT, WORDS = 24 };

/* Appends the words of `text`, which the call cuts up, to argv. */
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
    j->o.budget.error = 1.0f; /* any budget makes the job sample the scene */
    if (!render_job_load(j, &r) || !render_job_set(j, &r)) {
        printf("FAIL %s: %s\n", at->name, r.text);
        return 0;
    }
    return 1;
}

int plan_draw(plan_run *out, render_job *j)
{
    report r = {""};
    lmb_render *d = j->render;
    render_job_apply(j, &out->s);
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

/* Setting i of the combinations of tree size and error. Returns 0 past the last, and for settings
 * that a heavy scene skips. */
static int setting(ladder_settings *s, int i, int heavy)
{
    static const int32_t trees[] = {64, 128, 256, 512};
    static const float errors[] = {0.01f, 0.03f, 0.1f};
    s->tree = s->shadow_map = trees[i % 4];
    s->error = errors[i / 4 % 3];
    s->visibility = 0.75f * s->error;
    s->occlusion = LMB_OCCLUSION_EXACT;
    return i < 12 && (!heavy || s->error >= 0.1f);
}

int plan_measure(plan_scene *out, const plan_place *at)
{
    static render_job j;
    report r = {""};
    look_cost cost;
    memset(out, 0, sizeof *out);
    if (!plan_open(&j, at)) {
        return 0;
    }
    snprintf(out->name, sizeof out->name, "%s", at->name);
    out->fits = at->fits;
    int ok = scene_sample(&out->facts, &cost, &j, &j.o.budget, 0, &r);
    for (int i = 0; i < 12 && ok; ++i) {
        plan_run *run = &out->run[out->runs];
        if (setting(&run->s, i, at->heavy)) {
            ok = plan_draw(run, &j);
            ++out->runs;
        }
    }
    render_job_free(&j);
    return ok;
}
