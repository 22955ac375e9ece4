/* relight_figures.h: copies of an object at several places, as a scene, and the owners of light. */
#ifndef RELIGHT_FIGURES_H
#define RELIGHT_FIGURES_H

#include "../model/model.h"
#include "relight_options.h"

enum { RELIGHT_GLOSSY_CUBES = 16 }; /* number of roughness values with a cube; others use the nearest */

/* Figure f's part i, in the file's order of instances, is instance f * parts + i. An owner of light is a figure, or
 * with --per-part an instance. */
typedef struct figures {
    model loaded; /* of several objects: one scene of all, each in place, with arrays in `joined` */
    model object[RELIGHT_OBJECTS];
    uint32_t object_first[RELIGHT_OBJECTS + 1]; /* by object: the first instance */
    struct {
        lmb_mesh *meshes;
        lmb_material *materials;
        lmb_texture *textures;
        lmb_instance *instances;
        uint8_t *has_lobe; /* by material */
    } joined;
    int is_many;
    lmb_scene scene;
    lmb_instance *instances;
    lmb_material *materials;
    lmb_vec3 low, high;      /* the object's box as loaded */
    float scale;
    uint32_t count, parts, owners;
    float roughness[RELIGHT_GLOSSY_CUBES];
    int32_t glossy_cubes;
    uint16_t *glossy_of;      /* by instance of the file */
} figures;

/* figures_load: loads the object, `count` times. Returns 1, or 0 with `r` set. */
int figures_load(figures *out, const relight_options *o, uint32_t count, report *r);

/* figures_load_model: loads one file, or `demo`. figures_load_many: loads all objects into `loaded`, each at one --at.
 * They return 1, or 0 with `r` set. figures_place: the transform that scales an object with this box about the middle
 * of the box's bottom and moves that point to `at`. */
int figures_load_model(model *out, const char *name, const relight_options *o, report *r);
int figures_load_many(figures *inout, const relight_options *o, report *r);
void figures_place(lmb_mat4 *out, const lmb_mat4 *from, lmb_vec3 low, lmb_vec3 high, float scale, lmb_vec3 at);

/* figures_foot: the middle of the bottom of `loaded`'s box. */
lmb_vec3 figures_foot(const figures *f);

/* figures_stand: places a figure with the middle of the box's bottom `at`. */
void figures_stand(figures *f, uint32_t figure, lmb_vec3 at);

/* figures_bounds: sets the scene's bounds to those of all figures. */
void figures_bounds(figures *f);

/* The owner of an instance's light, and the position of that light. */
uint32_t figures_owner(const figures *f, uint32_t instance);
lmb_vec3 figures_middle(const figures *f, uint32_t owner);
/* The number of owners per figure; the position of the light of the i-th if you placed the figure `at`. */
uint32_t figures_owners_each(const figures *f);
lmb_vec3 figures_middle_at(figures *f, uint32_t i, lmb_vec3 at);

void figures_free(figures *f);

#endif
