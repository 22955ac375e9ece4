/* render_draw.h: draws the image that the options show. */
#ifndef RENDER_DRAW_H
#define RENDER_DRAW_H

#include "render_job.h"

/* render_draw: draws into j->linear; repeatedly if it shows light. Returns 1, or 0 with `r` set. */
int render_draw(render_job *j, report *r);

/* render_draw_once_more: draws the same frame as `how` shows it, with the same light, into `out`; free it with
 * image_free. Elements that send light use one occlusion test. Not reported, not timed. */
int render_draw_once_more(render_job *j, image *out, lmb_frame how, report *r);

#endif
