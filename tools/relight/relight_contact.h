/* relight_contact.h: the world's light that objects block from the ground, from each other and from their lobes. */
#ifndef RELIGHT_CONTACT_H
#define RELIGHT_CONTACT_H

#include <lambent/relight.h>

#include "relight_ground.h"
#include "relight_light.h"
#include "relight_shade.h"

/* Zeroed: empty. Release it with contact_free. */
typedef struct contact {
    hidden hidden;
    regions regions;
    float reflected[REGIONS][3]; /* by region of one figure: radiance */
    far_lights *lights;      /* by figure */
    lmb_vec3 *foot;          /* by figure: the middle of the box's bottom */
    contact_ground *grounds; /* by figure; NULL: the world has no ground */
    lmb_mesh *meshes;        /* by instance: with the share of light left as vertex colours */
    uint8_t **colours;       /* of the meshes */
    peak_runs peaks[HIDDEN_MAPS]; /* of one figure */
    const uint16_t *fold;    /* of the light's table */
    uint32_t figures, instances;
    int has_told; /* the note about coarser visibility was printed */
    float ground_y; /* m */
} contact;

/* contact_make: computes contact for all figures under the light at their places. The figures' scene then uses meshes
 * with vertex colours. Call it again after you move figures; self-occlusion is kept from the first call. Returns 1, or
 * 0 with `r` set. */
int contact_make(contact *inout, figures *f, relight_light *w, const relight_options *o, report *r);

/* contact_ground_left: the share of the ground's light that all figures leave at a place: bilinear, 1 outside the
 * maps. */
void contact_ground_left(float out[3], const contact *c, float x, float z);

/* contact_band: like lmb_relight_band, with the ground darkened outside objects. Lobes reflect the darkened ground, and
 * the object in directions that it blocks. `out` is the whole frame; `rows` is scratch for eight rows of it, RGB. */
lmb_status contact_band(const contact *c, const figures *f, const ground_lights *g, const lmb_relight *r,
                        lmb_relight_scratch *scratch, float *rows, const lmb_surface *out, int32_t band);

void contact_free(contact *c);

#endif
