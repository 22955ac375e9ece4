/* render_exposure.h: automatic exposure of an image. */
#ifndef RENDER_EXPOSURE_H
#define RENDER_EXPOSURE_H

#include "render_job.h"

/* Facts about the pixels of an image that do not depend on the light. */
typedef struct exposure_view {
    int32_t width, height, eye_width; /* of all eyes; of one */
    int32_t samples, tone;
    float *emitted; /* 3 per pixel of the last eye: light emitted by surfaces; NULL: none */
    float *unlit;   /* 3 per pixel: unlit_colours, independent of light and exposure; NULL: none */
    float *cover;   /* per pixel: share covered by surfaces; NULL: the background is black */
    uint8_t *own;   /* per pixel of the last eye: 0 if no surface or the added ground; NULL: no ground was added */
} exposure_view;

/* exposure_look: collects the facts of the image that was drawn; release them with exposure_view_free. exposure_of:
 * returns the exposure in stops: picture_auto_exposure of the light that surfaces reflect (of two eyes the right
 * one's), so that a glow does not darken the surroundings. If nothing is reflected, it uses all light. Unlit colours
 * are ignored. render_exposure: both, for j->linear. Return 1, or 0 with `r` set: out of memory. */
int exposure_look(exposure_view *out, const render_job *j, report *r);
void exposure_view_free(exposure_view *v);
int exposure_of(float *ev, const exposure_view *v, const image *linear, report *r);
int render_exposure(float *ev, const render_job *j, report *r);

#endif
