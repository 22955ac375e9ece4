/* relight_contact.h: what objects take of the world's light from the ground, from each other and from their lobes. */
#ifndef RELIGHT_CONTACT_H
#define RELIGHT_CONTACT_H

#include <lambent/relight.h>

#include "relight_hidden.h"
#include "relight_light.h"

/* The world's light at a place from one direction: W/m2 across it; and the radiance of a white surface that faces it
 * there: what blocks the light shows that, times its albedo. */
typedef struct far_light {
    lmb_vec3 to;
    float rgb[3], back[3];
} far_light;

/* The reduced cube's, then its peaks. */
typedef struct far_lights {
    far_light light[LMB_PROBE_TEXELS + LMB_PROBE_PEAKS];
    float angle[LMB_PROBE_TEXELS]; /* sr */
    int32_t count;
} far_lights;

/* What is left of the ground's light around one figure. */
typedef struct contact_ground {
    float x, z, per_x, per_z; /* its corner, m, and texels a metre */
    float left[HIDDEN_SIDE * HIDDEN_SIDE][3];
} contact_ground;

/* Zeroed: none. contact_free releases it. */
typedef struct contact {
    hidden hidden;
    far_lights *lights;      /* by figure */
    lmb_vec3 *foot;          /* by figure: where it stands */
    contact_ground *grounds; /* by figure; NULL: the world has no ground */
    lmb_mesh *meshes;        /* by instance: with what is left of its light as vertex colours */
    uint8_t **colours;       /* theirs */
    float (*albedo)[3];      /* by part */
    hidden_runs runs;        /* of one of the peaks */
    const uint16_t *fold;    /* of the light's table */
    uint32_t figures, instances;
    float ground_y; /* m */
} contact;

/* contact_make: of all figures where they stand, by the light there; the figures' scene then has the meshes with their
 * colours. Again after they moved: what they hide from themselves was found at the first time. 1, or 0 with `r` set. */
int contact_make(contact *inout, figures *f, relight_light *w, const relight_options *o, report *r);

/* contact_ground_left: what is left of the ground's light at a place, by all figures: bilinear, 1 beside the maps. */
void contact_ground_left(float out[3], const contact *c, float x, float z);

/* contact_band: lmb_relight_band with the ground darkened, where no object is, and so what lobes mirror: from the ground,
 * as dark as it is; from where the object hides the world, the object instead. `out` is the whole frame; `rows` scratch:
 * eight of its rows, RGB. */
lmb_status contact_band(const contact *c, const figures *f, const lmb_relight *r, lmb_relight_scratch *scratch,
                        float *rows, const lmb_surface *out, int32_t band);

void contact_free(contact *c);

#endif
