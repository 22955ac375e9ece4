/* relight_draw.h: draws objects in a world's light: one picture, or one for each place of a path. */
#ifndef RELIGHT_DRAW_H
#define RELIGHT_DRAW_H

#include "relight_light.h"

/* relight_draw: draws all pictures that `o` requests. *middle: the middle of the first object's box, at which it was
 * lit. Returns 1, or 0 with `r` set. */
int relight_draw(lmb_vec3 *middle, relight_light *w, relight_options *o, report *r);

#endif
