/* mix_lights.h: lights' light on real surfaces, without and with the object. */
#ifndef MIX_LIGHTS_H
#define MIX_LIGHTS_H

#include "mix_cones.h"

/* mix_lights_step: where `few` places of a guessed sun stand for all of it, each so manieth light is asked. Of told lights
 * each counts: another one is elsewhere and has another colour. */
static inline int32_t mix_lights_step(const mix_job *j, int32_t few)
{
    return j->o.light_count == 0 && j->light_count - j->lamp_count == MIX_SUN_SAMPLES ? MIX_SUN_SAMPLES / few : 1;
}

/* mix_lights_begin: the object's box, before any tile is asked. */
void mix_lights_begin(mix_job *j);

/* mix_lights_tile: add them to the light from around. Only lights whose shadow of the object can fall on the tile are asked
 * twice; where none is such, `direct` is asked only where it is not known, a few places of a guessed sun stand for it, and
 * where the light from around is the same in both none is asked: the tile stays the photo's. `direct` becomes what was
 * asked. */
void mix_lights_tile(lmb_irradiance *without, lmb_irradiance *with, mix_direct *direct, const mix_job *j,
                     const lmb_view *view, const lmb_tile *real);

#endif
