/* model.h: a scene read from a file, as the library wants it, with the cameras and names the library has no use for. */
#ifndef MODEL_H
#define MODEL_H

#include <lambent/lambent.h>

#include "report.h"

typedef struct model_camera {
    char name[64];
    lmb_vec3 eye, right, up, back; /* world, orthonormal */
    int orthographic;
    float yfov_rad;                /* perspective */
    float half_width, half_height; /* orthographic, metres */
    float aspect;                  /* width / height; 0: not given */
    float near_m, far_m;           /* far_m 0: not given */
} model_camera;

/* Owns everything `scene` points to. model_free releases it; a zeroed model is empty. */
typedef struct model {
    lmb_scene scene; /* checked: lmb_scene_check(&scene) == LMB_OK */
    model_camera *cameras;
    uint32_t camera_count;
    void **blocks; /* every allocation, for model_free */
    uint32_t block_count, block_cap;
} model;

/* A line for the user that is not an error ("3 lines and points skipped"), printed by the caller after loading. */
typedef struct model_notes {
    char line[16][200];
    uint32_t count;
} model_notes;

/* model_load: .gltf, .glb or .obj by content and extension. Returns 1, or 0 with `r` set and *out empty. */
int model_load(model *out, const char *path, model_notes *notes, report *r);
void model_free(model *m);

#endif
