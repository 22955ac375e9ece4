/* relight_figures.h: an object's copies at their places, as a scene; who of them shares light. */
#ifndef RELIGHT_FIGURES_H
#define RELIGHT_FIGURES_H

#include "../model/model.h"
#include "relight_options.h"

enum { RELIGHT_GLOSSY_CUBES = 16 }; /* kinds of roughness that are told apart: more take the nearest's */

/* Figure f's part i, as the file numbers its instances, is instance f * parts + i. Owners of light are figures, or, by
 * --per-part, those instances. */
typedef struct figures {
    model loaded;
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
