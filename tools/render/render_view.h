/* render_view.h: where a picture is taken from. */
#ifndef RENDER_VIEW_H
#define RENDER_VIEW_H

#include "../model/model.h"
#include "render_options.h"

/* render_view: the view the options ask for; sets o->width and height where they were left open. `scene` is what is
 * drawn, `loaded` what the file held. Says on stderr when it had to choose. near_m is 0 where the file gives none:
 * view_from goes on. 1, or 0 with `r` set. */
int render_view(lmb_view *out, render_options *o, const model *loaded, const lmb_scene *scene, report *r);

/* render_camera: that of the file's cameras which the options ask for, else its first. NULL: none; `r` is set where one
 * was asked for. */
const model_camera *render_camera(const render_options *o, const model *loaded, report *r);

#endif
