/* own_light.h: is what emits light a scene's light, or does it only glow? */
#ifndef OWN_LIGHT_H
#define OWN_LIGHT_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* What all surfaces receive straight from those that emit light, in the mean over their area (of both sides, where both
 * are drawn) and the channels, none counting for more than 0.05; W/m2; -1 with `r` set where memory is short. */
float own_light(const lmb_scene *scene, report *r);

/* From so much on it is the scene's light, W/m2. A light at a ceiling brings 0.015 (Cornell's box, 17, 12, 4 W/(sr m2))
 * to 0.009 (the same with 1, 1, 1), a street's light 0.004 to 40 x 40 m; a robot's eyes 0.0003,
 * BoomBox's lights 0.00008: most of what they send leaves the scene. */
#define OWN_LIGHT 0.003f

#endif
