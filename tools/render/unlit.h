/* unlit.h: colours that are shown unchanged, independent of light and exposure. */
#ifndef UNLIT_H
#define UNLIT_H

#include "render_job.h"

/* unlit_colours: computes the colours of LMB_UNLIT materials in the picture that was drawn, 3 per pixel. You free
 * *out. It is NULL if there is no such material or if the picture does not show light. Returns 1, or 0 with `r` set. */
int unlit_colours(float **out, const render_job *j, report *r);

/* unlit_rest: returns the light of a channel without those colours. */
float unlit_rest(float light, float unlit);

/* unlit_expose: exposes everything except those colours. */
void unlit_expose(image *inout, const float *unlit, float exposure_ev, int tone);

#endif
