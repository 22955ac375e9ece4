/* own_scene.h: a scene of tests/scenes for tests: made from its name, written as a model, drawn as `lambent render
 * --quality` draws it, against its truth. Include it before any system header. */
#ifndef OWN_SCENE_H
#define OWN_SCENE_H

#include "folder.h"
#include "pfm_file.h"

#include <lambent/lambent.h>

#include "../tools/picture/metrics.h"
#include "../tools/render/render_draw.h"
#include "scenes/scenes.h"

enum { OWN_SIDE = 32, OWN_LARGEST = 64 }; /* pixels of the truths that are kept here */

/* What is drawn of a scene. `surface`: as metrics_input has it, or NULL: where truth has green light. */
typedef struct own_how {
    const char *preset, *show;
    int side, bounces;
    const image *truth; /* NULL: nothing is measured */
    const float *surface;
} own_how;

typedef struct own_drawn {
    int ok;
    double pairs, segments;
    metrics error; /* of one bounce; zeros without a truth */
    double worst;  /* from metrics_worst */
} own_drawn;

/* tests/truth/small/FILE. */
static inline int own_truth(image *out, const char *file)
{
    char path[256];
    snprintf(path, sizeof path, "tests/truth/small/%s", file);
    return pfm_file(out, path);
}

/* The scene's files in the test's folder; the model's path, or NULL. */
static inline const char *own_write(folder *f, const char *name, const scene_place *place)
{
    static const char *const files[] = {"scene.bin", "scene.txt", "scene.box", "scene.gltf"};
    const char *path = NULL;
    made_scene s;
    for (int i = 0; i < COUNT_OF(files); ++i) {
        path = folder_put(f, files[i], "", 0); /* so that it goes with the folder */
    }
    int ok = scene_make(&s, name);
    if (ok) {
        scene_put(&s, place);
        ok = scene_write(&s, f->path, OWN_SIDE);
        scene_drop(&s);
    }
    CHECK_MSG(ok, "%s cannot be made", name);
    return ok ? path : NULL;
}

/* Where no light has bounced to there is no surface: the rooms have no such place. */
static inline int own_measure(own_drawn *out, const image *drawn, const own_how *how, report *r)
{
    static float surface[OWN_LARGEST * OWN_LARGEST * 3];
    const image *truth = how->truth;
    metrics_input in;
    memset(&in, 0, sizeof in);
    if (how->side > OWN_LARGEST || truth->width != how->side || truth->height != how->side || truth->channels != 3) {
        return report_fail(r, "truth of another size");
    }
    for (int i = 0; i < how->side * how->side; ++i) {
        surface[3 * i + 2] = truth->pixels[3 * i + 1] > 0.0f ? 1.0f : 0.0f;
    }
    in.test = drawn->pixels;
    in.truth = truth->pixels;
    in.surface = how->surface != NULL ? how->surface : surface;
    in.width = in.height = how->side;
    in.channels = 3;
    const int ok = metrics_measure(&out->error, &in, r);
    out->worst = ok ? metrics_worst(&out->error, &in) : 0.0;
    return ok;
}

/* The scene by a preset, on one thread, with light of its own alone and no more than `bounces` reflections. Elements are
 * those of one bounce, which take a fifth of a second at most. */
static inline void own_draw_as(own_drawn *out, const char *name, const scene_place *place, const own_how *how)
{
    char verb[] = "render", path[FOLDER_PATH], quality[16], show[16], size[32], bounces[16];
    char *line[] = {verb,      path,    "-o",     "none.pfm", "--size",  size,   "--show",     show,    "--quality", quality,
                    "--bounces", bounces, "--rest", "none",     "--world", "none", "--elements", "16384", "--threads", "1"};
    static render_job j;
    report r = {""};
    folder f;
    memset(out, 0, sizeof *out);
    memset(&j, 0, sizeof j);
    folder_open(&f);
    const char *model_path = own_write(&f, name, place);
    if (model_path != NULL) {
        snprintf(path, sizeof path, "%s", model_path);
        snprintf(quality, sizeof quality, "%s", how->preset);
        snprintf(show, sizeof show, "%s", how->show);
        snprintf(size, sizeof size, "%dx%d", how->side, how->side);
        snprintf(bounces, sizeof bounces, "%d", how->bounces);
        out->ok = render_options_parse(&j.o, COUNT_OF(line), line, &r) && render_job_load(&j, &r) &&
                  render_job_set(&j, &r) && render_draw(&j, &r) &&
                  (how->truth == NULL || own_measure(out, &j.linear, how, &r));
        out->pairs = (double)j.stats.pairs;
        out->segments = (double)j.stats.segments;
        CHECK_MSG(out->ok, "%s, %s: %s", name, how->preset, r.text);
        render_job_free(&j);
    }
    folder_close(&f);
}

/* One bounce by a preset; `truth` may be NULL. */
static inline void own_draw(own_drawn *out, const char *name, const scene_place *place, const char *preset,
                            const image *truth)
{
    const own_how how = {preset, "indirect", OWN_SIDE, 1, truth, NULL};
    own_draw_as(out, name, place, &how);
}

#endif
