/* relight_draw.h: objects drawn in a world's light: one picture, or one a place of a path. */
#ifndef RELIGHT_DRAW_H
#define RELIGHT_DRAW_H

#include "relight_light.h"

/* relight_draw: all pictures that `o` asks for. *middle: of the first object's box, where it was lit. 1, or 0 with `r`
 * set. */
int relight_draw(lmb_vec3 *middle, relight_light *w, relight_options *o, report *r);

#endif
