/* map_picture.h: the contents of the shadow maps as images: one row of faces per light, in map resolution. [V15 V33] */
#ifndef MAP_PICTURE_H
#define MAP_PICTURE_H

#include <lambent/lambent.h>

#include "../picture/image.h"

/* The frame must have run the light stages that each call needs. They allocate `out` and return 1, or 0 with `r` set.
 *
 *   map_distances distance from the light to the first surface in each texel of the light's cone, metres, one channel;
 *                 0 if there is none. For a directional light the distance is measured from the plane of the map.
 *   map_points    after LMB_STAGE_POINTS, with owners: each lit texel has the exitance of the first point or disc that
 *                 owns it, W/m2. `display`: mapped to 0 .. 1, with disc outlines and a dot at each point
 *   map_groups    after LMB_STAGE_GROUPS, with owners: the number of the group that owns the texel, from 1; 0 if dark,
 *                 -1 if the disc was dropped. One channel. `display`: one colour per group, grey for dropped */
int map_distances(image *out, const lmb_render *render, report *r);
int map_points(image *out, const lmb_render *render, int display, report *r);
int map_groups(image *out, const lmb_render *render, int display, report *r);

/* distance_of_depth: converts `width` x `height` depths along the view axis, in rows `step` floats apart, to
 * distances from the eye. In an orthographic view both are equal. */
void distance_of_depth(float *pixels, int32_t width, int32_t height, size_t step, const lmb_view *view);

#endif
