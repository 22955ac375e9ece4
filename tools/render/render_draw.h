/* render_draw.h: a picture drawn, as it is shown. */
#ifndef RENDER_DRAW_H
#define RENDER_DRAW_H

#include "render_job.h"

/* render_draw: what the options show, into j->linear; again and again where that is light. 1, or 0 with `r` set. */
int render_draw(render_job *j, report *r);

/* render_draw_once_more: the same frame shown otherwise, by the same light, into `out`; image_free releases it. But
 * elements that send their light do it by one occlusion. Neither told nor timed. */
int render_draw_once_more(render_job *j, image *out, lmb_frame how, report *r);

#endif
