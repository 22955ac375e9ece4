/* background.h: what a picture shows where no surface is: a colour, or nothing. */
#ifndef BACKGROUND_H
#define BACKGROUND_H

#include "render_job.h"

/* background_cover: the share of each pixel that surfaces cover, 0 .. 1, of the picture that was drawn: the caller's to
 * free. NULL with `r` set. */
float *background_cover(const render_job *j, report *r);

/* background_colour: put a display's codes behind a picture that is exposed. */
void background_colour(image *inout, const uint8_t rgb[3], const float *cover);

#endif
