/* background.h: the background of an image behind all surfaces: a colour, or transparent. */
#ifndef BACKGROUND_H
#define BACKGROUND_H

#include "render_job.h"

/* background_cover: returns the share of each pixel that surfaces cover, 0 .. 1, of the image drawn last. You free
 * it. NULL with `r` set. */
float *background_cover(const render_job *j, report *r);

/* background_colour: puts display codes behind an exposed image. */
void background_colour(image *inout, const uint8_t rgb[3], const float *cover);

#endif
