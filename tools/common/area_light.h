/* area_light.h: a light with a size as many lights without one, so that its shadows are soft. */
#ifndef AREA_LIGHT_H
#define AREA_LIGHT_H

#include <lambent/scene.h>

/* area_light: `count` lights of equal strength that stand for one of `size`: m across, of a sun degrees across, over 0.
 *
 * A point light becomes a ball that shows a disc of even brightness to every side, a spot a disc across its axis, a sun
 * a disc in the sky. Places come in a fixed order, without random numbers: the same bytes everywhere. Hard shadows
 * whose edges are 1 / count apart make one soft shadow. */
void area_light(lmb_light *out, int32_t count, const lmb_light *from, float size);

#endif
