/* view_frame.h: a default view that frames a scene without a camera. */
#ifndef VIEW_FRAME_H
#define VIEW_FRAME_H

#include "view_options.h"

/* view_frame: frames the whole scene from slightly above and to the side, and prints a note on stderr with `name`,
 * the scene's name. Long scenes are seen from the side, flat ones from higher up, a room with one open wall through
 * that wall. If you leave the size open, it becomes 480 rows in the aspect ratio that the scene fills best: 1:3,
 * 1:2, 3:4, 4:3, 2:1 or 3:1. near_m is not set. Triangles with a corner that is not finite or beyond 2^20 m are not
 * drawn, so they do not count. Returns 1, or 0 with `r` set. Cost: two passes over the triangles. */
int view_frame(lmb_view *out, view_options *o, const lmb_scene *scene, const char *name, report *r);

/* view_any: returns 1 if the scene has triangles that are drawn and are not all in one point, or 0 with `r` set. */
int view_any(const lmb_scene *scene, const char *name, report *r);

#endif
