/* render_view.h: the view of a picture. */
#ifndef RENDER_VIEW_H
#define RENDER_VIEW_H

#include "../model/model.h"
#include "render_options.h"

/* render_view: returns the view from the options, and sets o->width and height if they are open. `scene` is drawn,
 * `loaded` is the file. Prints a note on stderr if it had to choose. near_m is 0 if the file has none; complete it
 * with view_from. Returns 1, or 0 with `r` set. */
int render_view(lmb_view *out, render_options *o, const model *loaded, const lmb_scene *scene, report *r);

/* render_camera: returns the camera of the file that the options name, by default the first. NULL: none, with `r`
 * set if the options name one. */
const model_camera *render_camera(const render_options *o, const model *loaded, report *r);

#endif
