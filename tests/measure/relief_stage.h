/* relief_stage.h: shared parts of the relief figures: models and their reliefs, bars, pictures. */
#ifndef RELIEF_STAGE_H
#define RELIEF_STAGE_H

#include <lambent/lambent.h>

#include "../../tools/model/model.h"
#include "../../tools/picture/image.h"
#include "../../tools/relief/relief_bake.h"
#include "../../tools/relief/relief_model.h"

enum { RELIEF_VIEWS = 26, RELIEF_TEXELS = 256, CAMERAS = 24 };

/* A complex model and a relief of it. */
typedef struct subject {
    model loaded;
    triangle_mesh mesh, simple;
    relief_scene complex;
    relief_bake bake;
    lmb_relief relief;
    file_bytes file;
    relief_coverage coverage;
    double bake_s;
    lmb_vec3 middle;
    float diagonal;
} subject;

/* The statues used for the figures. */
typedef struct statue {
    const char *name, *file;
    uint32_t triangles; /* of the simple model */
} statue;
enum { STATUES = 3 };
extern const statue statues[STATUES];

void give_up(const report *r);

/* Reports a failure if the bar is missed. */
void bar(const char *name, const char *what, int holds);

/* Writes a picture to the folder LMB_PICTURES, if it is set. */
void relief_show(const char *name, float *rgb, int32_t width, int32_t height, report *r);

/* subject_make: a statue and a relief of it with RELIEF_VIEWS views; NULL if the file is missing. */
subject *subject_make(const statue *of, report *r);
void subject_free(subject *s);

/* subject_of: the same from a mesh's positions and indices, with smooth normals and a simple model of `triangles`. */
subject *subject_of(const triangle_mesh *mesh, uint32_t triangles, report *r);

/* subject_camera: camera i of CAMERAS around a statue, and a sun behind and above the camera. */
lmb_view subject_camera(const subject *s, int i, int32_t side, lmb_light *sun);

/* The parts of the program. */
void relief_quality(report *r);
void relief_speed(report *r);
void relief_own_views(report *r); /* relief_own.c */
void relief_rooms(report *r);     /* relief_rooms.c */
void relief_causes(report *r);    /* relief_causes.c */
void relief_baroque(report *r);   /* relief_baroque.c */
void relief_crowds(report *r);    /* relief_crowds.c */

#endif
