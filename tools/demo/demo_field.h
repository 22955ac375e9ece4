/* demo_field.h: the built-in world: a playing field in a stadium at dusk, and a figure to put in it. */
#ifndef DEMO_FIELD_H
#define DEMO_FIELD_H

#include "../picture/world_read.h"

/* demo_field_place: sets everything except the images, and the size of the ground, m. */
void demo_field_place(lmb_world_pictures *out, float ground_size[2]);

/* demo_field_pictures: the cube map from the middle of the field, and the ground. Returns 1, or 0 with `r` set. */
int demo_field_pictures(lmb_world_pictures *out, world_pictures *own, report *r);

/* demo_field_figure: a head on a body, 1.8 m high, standing at the origin. Static storage. */
const lmb_scene *demo_field_figure(void);

#endif
