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
#include "blended.h"
#include "render_options.h"

enum { RENDER_SUNS = 2 }; /* the most suns of a world */

/* One run, from the options to the picture. render_job_free frees everything in it. */
typedef struct render_job {
    render_options o;
    file_bytes transfer_file;
    lmb_transfer transfer; /* points into transfer_file */
    model loaded;
    model_notes notes;
    int hides; /* kinds of notes that do not apply, a sum of MODEL_NOTE_ */
    lmb_scene scene; /* loaded or built-in, with the lights of this run */
    world around; /* a sky, or none */
    int32_t gathers_sky; /* many_lights contains only lights of the sky */
    lmb_light sun, *with_sun; /* for a scene without light; the lights of the scene and the sun of the sky */
    lmb_light *wide;          /* --light, with those that have a size split into many */
    lmb_view middle; /* between the eyes */
    int32_t eyes;    /* 1, or 2: side by side in the picture */
    light_stream many_lights;
    uint32_t own_lights; /* of scene.lights; suns of the world, at most RENDER_SUNS, follow them */
    int too_many;     /* for maps: all lights go into the tree */
    uint32_t in_tree; /* lights of the scene that are only in the tree: scene.light_count is 0, scene.lights has them */
    lmb_frame frame; /* view and out belong to the current eye */
    lmb_render *render;
    int lit; /* the light stages of `render` are done */
    workers workers;
    blended blended; /* with --blend sorted; else zeros */
    lmb_stats stats;
    image linear;
    void *block, *owner_memory; /* of the frame; owners of the texels' light, if these are shown */
    size_t block_bytes, bytes;  /* bytes: all memory except scene and many_lights */
    double load_s, write_s, total_s;
    double indirect_share;
} render_job;

/* Call these in order, on a job that is zero except for the options. Each returns 1, or 0 with `r` set.
 *
 *   render_job_load loads the scene
 *   render_job_set  sets lights and view, and allocates all memory: ready to draw */
int render_job_load(render_job *j, report *r);
int render_job_set(render_job *j, report *r);
void render_job_free(render_job *j);

/* render_job_take: allocates the picture, the frame and the frame's block for a job that has scene, view, eyes and
 * threads. Part of render_job_set; you only call it for jobs that are not a run. Returns 1, or 0 with `r` set. */
int render_job_take(render_job *j, report *r);

/* render_job_refit: sets up the frame and the block again after the options changed. Returns 1, or 0 with `r` set. */
int render_job_refit(render_job *j, report *r);

/* render_job_change_world: after `around` has changed, puts the world's suns behind the own lights in `lights`, which
 * has room for RENDER_SUNS, and sets up tree, frame and block again. The next frame reuses nothing. `lights` is
 * scene.lights, or stays unused if all lights are in a tree. Returns 1, or 0 with `r` set. [S20 S28] */
int render_job_change_world(render_job *j, lmb_light *lights, report *r);

/* render_job_picture: allocates a black picture for all eyes. render_job_eye: sets the view of `f` to an eye, and
 * the output to the eye's part of the picture. */
int render_job_picture(render_job *j, image *out, report *r);
void render_job_eye(const render_job *j, lmb_frame *f, const image *whole, int32_t eye);

/* render_job_apply: copies chosen settings into the options of a job. */
void render_job_apply(render_job *j, const ladder_settings *s);

#endif
