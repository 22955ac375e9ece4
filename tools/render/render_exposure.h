/* render_exposure.h: how bright a picture is shown where nobody says. */
#ifndef RENDER_EXPOSURE_H
#define RENDER_EXPOSURE_H

#include "render_job.h"

/* Stops for the picture that was drawn into j->linear: picture_auto_exposure of the light that surfaces reflect (of two
 * eyes the right one's), so that a glow does not darken what is beside it; of all light where they reflect none.
 * 1, or 0 with `r` set: out of memory. */
int render_exposure(float *ev, const render_job *j, report *r);

#endif
