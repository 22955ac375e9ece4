/* relight_shade.h: the ground in a picture: darker where objects take its light, and where they block given lights. */
#ifndef RELIGHT_SHADE_H
#define RELIGHT_SHADE_H

#include <lambent/relight.h>

#include "relight_ground.h"
#include "relight_light.h"

struct contact;

/* What the world's light comes to on the ground by each figure. Zeroed: none; ground_lights_free releases it. */
typedef struct ground_lights {
    lmb_vec3 *foot;
    float (*rgb)[3]; /* W/m2 */
    uint32_t figures;
    float ground_y;
} ground_lights;

/* figure_light: the world's light where a figure is. 1, or 0. */
int figure_light(far_lights *out, const figures *f, uint32_t figure, relight_light *w, const relight_options *o);

/* ground_lights_take: where the figures are now; nothing if there are no given lights or no ground. 1, or 0 with `r` set. */
int ground_lights_take(ground_lights *inout, const figures *f, relight_light *w, const relight_options *o, report *r);

/* ground_band: the ground's pixels of a band are multiplied by what is left of their light. The pictures show the ground
 * in all of its light, that of the scene's lights too: these take from it where an object blocks them.
 *
 *   g  figures 0: no given lights
 *   c  NULL: objects take nothing of the world's light
 * `out` is the whole frame. */
lmb_status ground_band(const ground_lights *g, const struct contact *c, const lmb_relight *r, lmb_relight_scratch *scratch,
                       const lmb_surface *out, int32_t band);

void ground_lights_free(ground_lights *g);

#endif
