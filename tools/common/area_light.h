/* area_light.h: replaces a light that has a size by many lights without one, for soft shadows. */
#ifndef AREA_LIGHT_H
#define AREA_LIGHT_H

#include <lambent/scene.h>

/* area_light: makes `count` lights of equal strength that replace one of `size`, which is over 0: metres across, for
 * a sun degrees. A point light becomes a ball that looks like a disc of even brightness from every side, a spot a
 * disc across the axis, a sun a disc in the sky. Positions have a fixed order without random numbers, so the bytes
 * are the same everywhere. `count` hard shadows with slightly different edges add up to a soft one. */
void area_light(lmb_light *out, int32_t count, const lmb_light *from, float size);

#endif
