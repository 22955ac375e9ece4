/* relight_shade.h: the ground in a picture: darker where objects block the world's light or given lights. */
#ifndef RELIGHT_SHADE_H
#define RELIGHT_SHADE_H

#include <lambent/relight.h>

#include "relight_ground.h"
#include "relight_light.h"

struct contact;

/* The world's light on the ground at each figure. Zeroed: empty. Release it with ground_lights_free. */
typedef struct ground_lights {
    lmb_vec3 *foot;
    float (*rgb)[3]; /* W/m2 */
    uint32_t figures;
    float ground_y;
} ground_lights;

/* figure_light: the world's light at a figure. Returns 1, or 0 on failure. */
int figure_light(far_lights *out, const figures *f, uint32_t figure, relight_light *w, const relight_options *o);

/* ground_lights_take: computes it at the figures' present places; does nothing without given lights or ground. Returns
 * 1, or 0 with `r` set. */
int ground_lights_take(ground_lights *inout, const figures *f, relight_light *w, const relight_options *o, report *r);

/* ground_band: multiplies the ground's pixels of a band by the share of light left. The world's pictures show the
 * ground fully lit, also by the scene's lights; this removes the blocked light.
 *
 *   g  figures 0: no given lights
 *   c  NULL: objects do not block the world's light
 * `out` is the whole frame. */
lmb_status ground_band(const ground_lights *g, const struct contact *c, const lmb_relight *r,
                       lmb_relight_scratch *scratch, const lmb_surface *out, int32_t band);

void ground_lights_free(ground_lights *g);

#endif
