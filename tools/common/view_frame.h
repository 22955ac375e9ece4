/* view_frame.h: a view of all of a scene that has no camera. */
#ifndef VIEW_FRAME_H
#define VIEW_FRAME_H

#include "view_options.h"

/* view_frame: all of the scene, from a little above and to the side; says so on stderr, where `name` is the scene's. What
 * is longer than wide is seen from its side, what is flat from higher up, a room with one open wall through that. A size
 * that was left open becomes 480 rows in the shape that the scene fills best: 1:3, 1:2, 3:4, 4:3, 2:1 or 3:1. near_m is
 * left. A triangle with a corner that is not finite or 2^20 m away is not drawn, and so is not framed. 1, or 0 with `r`
 * set. Cost: two passes over the triangles. */
int view_frame(lmb_view *out, view_options *o, const lmb_scene *scene, const char *name, report *r);

#endif
