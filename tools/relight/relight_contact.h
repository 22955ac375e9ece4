/* relight_contact.h: what objects take of the world's light from the ground and from each other. */
#ifndef RELIGHT_CONTACT_H
#define RELIGHT_CONTACT_H

#include "../picture/image.h"
#include "relight_figures.h"
#include "relight_light.h"

enum { CONTACT_SIDE = 128 };

/* What is left of the ground's light around one figure. */
typedef struct contact_ground {
    float x, z, per_x, per_z; /* its corner, m, and texels a metre */
    float left[CONTACT_SIDE * CONTACT_SIDE][3];
} contact_ground;

/* Zeroed: none. contact_free releases it. */
typedef struct contact {
    contact_ground *grounds; /* by figure; NULL: the world has no ground */
    lmb_mesh *meshes;        /* by instance: with what is left of its light as vertex colours */
    void **memory;           /* theirs */
    uint32_t figures, instances;
    float ground_y;
} contact;

/* contact_make: of all figures where they stand, by the light there; the figures' scene then has the meshes with their
 * colours. Again after they moved. 1, or 0 with `r` set. */
int contact_make(contact *inout, figures *f, relight_light *w, const relight_options *o, report *r);

/* contact_darken: the ground where a picture shows it: pixels without an object. */
void contact_darken(image *inout, const contact *c, const lmb_view *view, const lmb_surface *id);

void contact_free(contact *c);

#endif
