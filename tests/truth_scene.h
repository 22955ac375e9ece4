/* truth_scene.h: the truth's scenes for tests: their pictures, and their cameras as views. */
#ifndef TRUTH_SCENE_H
#define TRUTH_SCENE_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../tools/model/model.h"
#include "../tools/picture/image.h"
#include "pfm_file.h"
#include "shared_file.h"

static inline int truth_is_there(const char *scene)
{
    char path[SHARED_PATH], name[128];
    snprintf(name, sizeof name, "truth/%.60s/scene.gltf", scene);
    return shared_file(path, name);
}

static inline void truth_path(char path[SHARED_PATH], const char *scene, const char *file)
{
    const char *shared = getenv("LMB_SHARED");
    snprintf(path, SHARED_PATH, "%.300s/truth/%.60s/%.60s", shared != NULL && *shared != '\0' ? shared : "../shared",
             scene, file);
}

/* A picture of a scene that is there: one that cannot be read has failed. */
static inline int truth_picture(image *out, const char *scene, const char *file)
{
    char path[SHARED_PATH];
    truth_path(path, scene, file);
    return pfm_file(out, path);
}

/* A scene with a camera, its one bounce and its depth; 0 where they are not there. truth_scene_free releases them. */
static inline int truth_scene(model *loaded, image *bounce, image *depth, const char *scene)
{
    char path[SHARED_PATH];
    model_notes notes;
    report r = {""};
    memset(&notes, 0, sizeof notes);
    truth_path(path, scene, "scene.gltf");
    if (!truth_is_there(scene) || !truth_picture(bounce, scene, "pt_indirect1.pfm") ||
        !truth_picture(depth, scene, "gbuffer_depth.pfm")) {
        return 0;
    }
    const int ok = model_load(loaded, path, NULL, &notes, &r) && loaded->camera_count > 0;
    CHECK_MSG(ok, "%s: %s", scene, r.text);
    return ok;
}

static inline void truth_scene_free(model *loaded, image *bounce, image *depth)
{
    image_free(bounce);
    image_free(depth);
    model_free(loaded);
}

/* As large as the picture it is held against. */
static inline void truth_view(lmb_view *v, const model_camera *c, const image *like)
{
    memset(v, 0, sizeof *v);
    v->eye = c->eye;
    v->right = c->right;
    v->up = c->up;
    v->back = c->back;
    v->kind = LMB_PERSPECTIVE;
    v->half_height = tanf(0.5f * c->yfov_rad);
    v->half_width = v->half_height * (float)like->width / (float)like->height;
    v->near_m = c->near_m > 0.0f ? c->near_m : 1e-3f;
    v->far_m = 1000.0f;
    v->frame_width = like->width;
    v->frame_height = like->height;
}

#endif
