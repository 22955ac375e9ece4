/* mix_lights.h: direct light on real surfaces, without and with the object. */
#ifndef MIX_LIGHTS_H
#define MIX_LIGHTS_H

#include "mix_cones.h"

/* mix_lights_step: the step between evaluated lights. If `few` samples can represent a guessed sun, the others are
 * skipped. Given lights are never skipped: each has another place and colour. */
static inline int32_t mix_lights_step(const mix_job *j, int32_t few)
{
    return j->o.light_count == 0 && j->light_count - j->lamp_count == MIX_SUN_SAMPLES ? MIX_SUN_SAMPLES / few : 1;
}

/* mix_lights_begin: computes the object's box; call it before you light the first tile. */
void mix_lights_begin(mix_job *j);

/* mix_lights_tile: adds direct light to the light from the cones. Only lights that the object can shadow on this tile
 * are evaluated twice. If there are none, `direct` is evaluated only for unknown pixels, with a few samples of a
 * guessed sun. If the cones' light is also equal without and with the object, no light is evaluated and the tile stays
 * as in the photo. `direct` receives the evaluated light. */
void mix_lights_tile(lmb_irradiance *without, lmb_irradiance *with, mix_direct *direct, const mix_job *j,
                     const lmb_view *view, const lmb_tile *real);

#endif
