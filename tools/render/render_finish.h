/* render_finish.h: from a picture's light to its file: exposure, what lies behind, format. */
#ifndef RENDER_FINISH_H
#define RENDER_FINISH_H

#include "render_exposure.h"

/* What is to be done to the light, and what the view says for it. */
typedef struct render_finish {
    int32_t format; /* PICTURE_ */
    render_background background;
    int32_t tone, exposure_auto;
    float exposure_ev;
    exposure_view view; /* its cover also where the background is none of the world's */
} render_finish;

/* finish_begin: of the picture of light that was drawn. finish_free releases it. finish_write: the file, of this light,
 * which it may change. 1, or 0 with `r` set. */
int finish_begin(render_finish *out, const render_job *j, report *r);
void finish_free(render_finish *f);
int finish_write(const render_finish *f, const char *path, image *linear, int is_quiet, report *r);

#endif
