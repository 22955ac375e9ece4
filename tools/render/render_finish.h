/* render_finish.h: from light to an image file: exposure, background, format. */
#ifndef RENDER_FINISH_H
#define RENDER_FINISH_H

#include "render_exposure.h"

/* The processing of an image, and the facts about the view that it needs. */
typedef struct render_finish {
    int32_t format; /* PICTURE_ */
    render_background background;
    int32_t tone, exposure_auto;
    float exposure_ev;
    exposure_view view; /* has `cover` also if the background is not the world */
} render_finish;

/* finish_begin: prepares the picture of light that was drawn. finish_begin_at: the same with known stops. finish_free
 * releases it. finish_encode: encodes the bytes of the file from `linear`, which it may change. finish_write: writes
 * the file. Return 1, or 0 with `r` set. Finding the background behind surfaces overwrites the view of the frame. */
int finish_begin(render_finish *out, const render_job *j, report *r);
int finish_begin_at(render_finish *out, const render_job *j, float exposure_ev, report *r);
void finish_free(render_finish *f);
int finish_encode(file_bytes *out, const render_finish *f, image *linear, int is_quiet, report *r);
int finish_write(const render_finish *f, const char *path, image *linear, int is_quiet, report *r);

/* render_tell_coarse: prints a note about tiles whose visibility is coarser, if there are any. */
void render_tell_coarse(int is_quiet, const lmb_stats *stats);

/* render_tell_dropped: prints a note about triangles that cannot be drawn, if there were any. Each triangle of the
 * scene counts once. In stats a triangle counts each time that it is drawn, for each view and each face of a shadow
 * map. */
void render_tell_dropped(int is_quiet, const lmb_scene *scene, const lmb_stats *stats);

#endif
