/* map_picture.h: what lives in the shadow maps, as pictures: a row of faces a light, at the maps' size. [V15 V33] */
#ifndef MAP_PICTURE_H
#define MAP_PICTURE_H

#include <lambent/lambent.h>

#include "../picture/image.h"

/* Of a frame whose light stages are done as far as each needs. `out` is allocated; 1, or 0 with `r` set.
 *
 * map_distances  from the light to what each texel in its cone sees, metres, one channel; 0 where there is nothing. Of
 *                a directional light: from its map's plane.
 * map_points     after LMB_STAGE_POINTS, with owners: each lit texel has the exitance of its first point or disc, W/m2.
 *                `display`: brought into 0 .. 1, with the discs' outlines, and a dot where each stands.
 * map_groups     after LMB_STAGE_GROUPS, with owners: the number of the group that owns the texel, from 1; 0 where it
 *                is dark, -1 where its disc was dropped. One channel. `display`: a colour a group, grey for dropped. */
int map_distances(image *out, const lmb_render *render, report *r);
int map_points(image *out, const lmb_render *render, int display, report *r);
int map_groups(image *out, const lmb_render *render, int display, report *r);

/* distance_of_depth: `width` x `height` floats of depth along a view's axis, rows `step` floats apart, into distances
 * from its eye; the same thing in an orthographic view. */
void distance_of_depth(float *pixels, int32_t width, int32_t height, size_t step, const lmb_view *view);

#endif
