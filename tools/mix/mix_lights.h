/* mix_lights.h: lights' light on real surfaces, without and with the object. */
#ifndef MIX_LIGHTS_H
#define MIX_LIGHTS_H

#include "mix_job.h"

/* mix_lights_begin: the ball about the object, before any tile is asked. */
void mix_lights_begin(mix_job *j);

/* mix_lights_tile: add them to the light from around. Only lights whose shadow of the object can fall on the tile are asked
 * twice; where none is such, a few of those that are one stand for it, and where the light from around is the same in
 * both none is asked: the tile stays the photo's. */
void mix_lights_tile(lmb_irradiance *without, lmb_irradiance *with, const mix_job *j, const lmb_view *view,
                     const lmb_tile *real);

#endif
