/* render_exposure.h: how bright a picture is shown where nobody says. */
#ifndef RENDER_EXPOSURE_H
#define RENDER_EXPOSURE_H

#include "render_job.h"

/* What the view says about a picture's pixels, whatever light comes to them. */
typedef struct exposure_view {
    int32_t width, height, eye_width; /* of all eyes; of one */
    int32_t samples, tone;
    float *emitted; /* 3 a pixel of the last eye: what its surfaces emit; NULL: none does */
    float *unlit;   /* 3 per pixel: unlit_colours, independent of light and exposure; NULL: none */
    float *cover;   /* a pixel: the share that surfaces cover; NULL: what lies behind them is black */
    uint8_t *own;   /* a pixel of the last eye: 0 where it shows no surface, or a ground put below; NULL: none was */
} exposure_view;

/* exposure_look: of the picture that was drawn. exposure_view_free releases it. exposure_of: stops for its light:
 * picture_auto_exposure of the light that surfaces reflect (of two eyes the right one's), so that a glow does not darken
 * its surroundings; of all light if they reflect none. Unlit colours are ignored. render_exposure: both, for j->linear.
 * Return 1, or 0 with `r` set: out of memory. */
int exposure_look(exposure_view *out, const render_job *j, report *r);
void exposure_view_free(exposure_view *v);
int exposure_of(float *ev, const exposure_view *v, const image *linear, report *r);
int render_exposure(float *ev, const render_job *j, report *r);

#endif
