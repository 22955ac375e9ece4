/* own_light.h: decides whether emissive surfaces light the scene or only glow. */
#ifndef OWN_LIGHT_H
#define OWN_LIGHT_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* own_light: returns the irradiance of surfaces from emissive ones, without bounces: mean over area (both sides if
 * both are drawn) and channels, each clamped to 0.05; W/m2. Returns -1 with `r` set if memory is short. */
float own_light(const lmb_scene *scene, report *r);

/* From this mean irradiance on, W/m2, emissive surfaces light the scene. A ceiling light gives 0.015 (Cornell box,
 * 17, 12, 4 W/(sr m2)) to 0.009 (with 1, 1, 1), a street light on 40 x 40 m 0.004. The eyes of a robot give 0.0003,
 * BoomBox's lights 0.00008, because most of that light leaves the scene. */
#define OWN_LIGHT 0.003f

#endif
