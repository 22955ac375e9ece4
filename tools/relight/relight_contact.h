/* relight_contact.h: what objects take of the world's light from the ground, from each other and from their lobes. */
#ifndef RELIGHT_CONTACT_H
#define RELIGHT_CONTACT_H

#include <lambent/relight.h>

#include "relight_ground.h"
#include "relight_light.h"
#include "relight_shade.h"

/* Zeroed: none. contact_free releases it. */
typedef struct contact {
    hidden hidden;
    regions regions;
    float reflected[REGIONS][3]; /* by region of one figure: radiance */
    far_lights *lights;      /* by figure */
    lmb_vec3 *foot;          /* by figure: where it stands */
    contact_ground *grounds; /* by figure; NULL: the world has no ground */
    lmb_mesh *meshes;        /* by instance: with what is left of its light as vertex colours */
    uint8_t **colours;       /* theirs */
    peak_runs peaks[HIDDEN_MAPS]; /* of one figure */
    const uint16_t *fold;    /* of the light's table */
    uint32_t figures, instances;
    int has_told; /* that sights are coarser */
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
lmb_status contact_band(const contact *c, const figures *f, const ground_lights *g, const lmb_relight *r,
                        lmb_relight_scratch *scratch, float *rows, const lmb_surface *out, int32_t band);

void contact_free(contact *c);

#endif
