/* play_motion.h: where lights, camera and objects are at a frame. */
#ifndef PLAY_MOTION_H
#define PLAY_MOTION_H

#include "../model/model_motion.h"
#include "../render/render_job.h"
#include "play_options.h"
#include "../common/key_path.h"

/* Motion by a path, else by the animations of the file, else a default motion around the rest position. `radius` is the
 * distance of a light in metres, or for a sun the tangent of the angle; 0: it does not move. */
typedef struct play_motion {
    render_job *job;
    const play_options *options;
    key_path path; /* no keys: none */
    int moves;      /* PLAY_*: of those that can */
    int is_animated;
    model_camera *camera; /* the animations': all of the file's */
    int32_t camera_used;  /* of them; -1: none, or one that stands still */
    lmb_light *light, *light_at_rest, *light_posed;
    float *radius;  /* by light */
    lmb_instance *instance, *instance_at_rest, *instance_posed;
    double shaped_s; /* time of the current mesh shapes; -1: none yet */
    lmb_view view_at_rest;
    lmb_vec3 middle; /* that the camera swings around, by at most `swing` rad; 0: it stands still */
    float swing;
} play_motion;

/* play_motion_read: the path, before anything else is done. play_motion_find: of a job that is loaded: do its file's
 * animations move anything that may? play_motion_make: once it is set: from now on its scene's lights and objects are
 * the motion's own. play_motion_set: the job's scene and view as they are at frame k, however they were before. Each 1,
 * or 0 with `r` set. play_motion_free releases it; zeroed it is empty. */
int play_motion_read(play_motion *out, const play_options *o, report *r);
int play_motion_find(play_motion *inout, render_job *j, report *r);
int play_motion_make(play_motion *inout, report *r);
int play_motion_set(play_motion *m, int32_t k, report *r);
void play_motion_free(play_motion *m);

/* When the path's or animations' last key is, s; 0: neither moves anything. */
double play_motion_end(const play_motion *m);

#endif
