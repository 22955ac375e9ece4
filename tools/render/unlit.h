/* unlit.h: colours that are shown as they are, whatever light there is and however the picture is exposed. */
#ifndef UNLIT_H
#define UNLIT_H

#include "render_job.h"

/* unlit_colours: of the picture that was drawn, what LMB_UNLIT materials have in each pixel, 3 a pixel: *out is the
 * caller's to free, and NULL where no material is one or the picture does not show light. 1, or 0 with `r` set. */
int unlit_colours(float **out, const render_job *j, report *r);

/* unlit_rest: a channel's light without those colours. */
float unlit_rest(float light, float unlit);

/* unlit_expose: expose all but them. */
void unlit_expose(image *inout, const float *unlit, float exposure_ev, int tone);

#endif
