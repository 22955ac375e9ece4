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

enum { OWN_SIDE = 32 }; /* pixels of the truths that are kept here */

typedef struct own_drawn {
    int ok;
    double pairs, segments;
    metrics error; /* of one bounce; zeros without a truth */
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
static inline int own_measure(metrics *m, const image *drawn, const image *truth, report *r)
{
    static float surface[OWN_SIDE * OWN_SIDE * 3];
    metrics_input in;
    memset(&in, 0, sizeof in);
    if (truth->width != OWN_SIDE || truth->height != OWN_SIDE || truth->channels != 3) {
        return report_fail(r, "truth of another size");
    }
    for (int i = 0; i < OWN_SIDE * OWN_SIDE; ++i) {
        surface[3 * i + 2] = truth->pixels[3 * i + 1] > 0.0f ? 1.0f : 0.0f;
    }
    in.test = drawn->pixels;
    in.truth = truth->pixels;
    in.surface = surface;
    in.width = in.height = OWN_SIDE;
    in.channels = 3;
    return metrics_measure(m, &in, r);
}

/* Bounced light by a preset; `truth` may be NULL. */
static inline void own_draw(own_drawn *out, const char *name, const scene_place *place, const char *preset,
                            const image *truth)
{
    char verb[] = "render", path[FOLDER_PATH], quality[16];
    char *line[] = {verb,     path,       "-o",        "none.pfm", "--size",    "32x32",
                    "--show", "indirect", "--quality", quality,    "--threads", "1"};
    static render_job j;
    report r = {""};
    folder f;
    memset(out, 0, sizeof *out);
    memset(&j, 0, sizeof j);
    folder_open(&f);
    const char *model_path = own_write(&f, name, place);
    if (model_path != NULL) {
        snprintf(path, sizeof path, "%s", model_path);
        snprintf(quality, sizeof quality, "%s", preset);
        out->ok = render_options_parse(&j.o, COUNT_OF(line), line, &r) && render_job_load(&j, &r) &&
                  render_job_set(&j, &r) && render_draw(&j, &r) &&
                  (truth == NULL || own_measure(&out->error, &j.linear, truth, &r));
        out->pairs = (double)j.stats.pairs;
        out->segments = (double)j.stats.segments;
        CHECK_MSG(out->ok, "%s, %s: %s", name, preset, r.text);
        render_job_free(&j);
    }
    folder_close(&f);
}

#endif
