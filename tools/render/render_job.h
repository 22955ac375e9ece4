/* render_job.h: one run of a renderer, from the options to the picture. */
#ifndef RENDER_JOB_H
#define RENDER_JOB_H

#include <lambent/lambent.h>

#include "../common/workers.h"
#include "../common/io_file.h"
#include "../model/model.h"
#include "../picture/image.h"
#include "light_stream.h"
#include "render_world.h"
#include "render_options.h"

/* One run, from the options to the picture. Everything here is freed by render_job_free. */
typedef struct render_job {
    render_options o;
    file_bytes transfer_file;
    lmb_transfer transfer; /* in it */
    model loaded;
    model_notes notes;
    lmb_scene scene; /* the loaded or built-in one, with the lights of this run */
    world around; /* a sky, or none */
    int32_t gathers_sky; /* many_lights are the sky's alone */
    lmb_light sun, *with_sun; /* of a scene without light; the scene's lights and the sky's sun */
    lmb_light *wide;          /* --light, those with a size as many */
    lmb_view middle; /* between the eyes */
    int32_t eyes;    /* 1, or 2: side by side in the picture */
    light_stream many_lights;
    lmb_frame frame; /* its view and out: those of the eye at hand */
    lmb_render *render;
    int lit; /* the light stages of `render` are done */
    workers workers;
    lmb_stats stats;
    image linear;
    void *block, *owner_memory; /* the frame's; who holds each texel's light, where that is shown */
    size_t block_bytes, bytes;  /* bytes: of all memory but the scene's and many's */
    double load_s, write_s, total_s;
    double indirect_share;
} render_job;

/* Of a job that is zero but for its options, in this order. Each 1, or 0 with `r` set.
 *
 * render_job_load  the scene
 * render_job_set   its lights, the view and all memory: ready to draw */
int render_job_load(render_job *j, report *r);
int render_job_set(render_job *j, report *r);
void render_job_free(render_job *j);

/* render_job_take: the picture, the frame and its block, of a job whose scene, view, eyes and threads are set: part of
 * render_job_set, for jobs that are no run of their own. 1, or 0 with `r` set. */
int render_job_take(render_job *j, report *r);

/* render_job_refit: the frame and its block, again, as the options now are. 1, or 0 with `r` set. */
int render_job_refit(render_job *j, report *r);

/* render_job_picture: memory for a picture of all eyes, black. render_job_eye: which of them `f` draws, and where. */
int render_job_picture(render_job *j, image *out, report *r);
void render_job_eye(const render_job *j, lmb_frame *f, const image *whole, int32_t eye);

/* render_job_apply: chosen settings into a job's options. */
void render_job_apply(render_job *j, const lmb_settings *s);

#endif
