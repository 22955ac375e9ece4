/* relight_figures.h: an object's copies at their places, as a scene; who of them shares light. */
#ifndef RELIGHT_FIGURES_H
#define RELIGHT_FIGURES_H

#include "../model/model.h"
#include "relight_options.h"

enum { RELIGHT_GLOSSY_CUBES = 16 }; /* kinds of roughness that are told apart: more take the nearest's */

/* Figure f's part i, as the file numbers its instances, is instance f * parts + i. Owners of light are figures, or, by
 * --per-part, those instances. */
typedef struct figures {
    model loaded; /* of several objects: one scene of all of them, where they stand, its arrays in `joined` */
    model object[RELIGHT_OBJECTS];
    uint32_t object_first[RELIGHT_OBJECTS + 1]; /* by object: its first instance */
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
    lmb_vec3 low, high;      /* the object's box as its file has it */
    float scale;
    uint32_t count, parts, owners;
    float roughness[RELIGHT_GLOSSY_CUBES];
    int32_t glossy_cubes;
    uint16_t *glossy_of;      /* by instance of the file */
} figures;

/* figures_load: the object, `count` times. 1, or 0 with `r` set. */
int figures_load(figures *out, const relight_options *o, uint32_t count, report *r);

/* figures_load_model: one file, or `demo`. figures_load_many: all objects into `loaded`, each at its --at. 1, or 0 with
 * `r` set. figures_place: a transform of an object with this box, scaled about the middle of the box's bottom, which
 * goes to `at`. */
int figures_load_model(model *out, const char *name, const relight_options *o, report *r);
int figures_load_many(figures *inout, const relight_options *o, report *r);
void figures_place(lmb_mat4 *out, const lmb_mat4 *from, lmb_vec3 low, lmb_vec3 high, float scale, lmb_vec3 at);

/* figures_foot: where `loaded` stands by itself: the middle of its box's bottom. */
lmb_vec3 figures_foot(const figures *f);

/* figures_stand: one of them, with the middle of its box's bottom `at`. */
void figures_stand(figures *f, uint32_t figure, lmb_vec3 at);

/* figures_bounds: of all that stand, into the scene. */
void figures_bounds(figures *f);

/* Whose light an instance takes, and where that is. */
uint32_t figures_owner(const figures *f, uint32_t instance);
lmb_vec3 figures_middle(const figures *f, uint32_t owner);
/* How many owners a figure has; where the light of its i-th would be if it stood `at`. */
uint32_t figures_owners_each(const figures *f);
lmb_vec3 figures_middle_at(figures *f, uint32_t i, lmb_vec3 at);

void figures_free(figures *f);

#endif
