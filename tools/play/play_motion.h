/* play_motion.h: moves lights, camera and objects in a frame. */
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
    int moves;      /* KEY_*: of those that can */
    int is_animated;
    model_camera *camera; /* posed by the animations: all of the file's */
    int32_t camera_used;  /* of them; -1: none, or a static one */
    lmb_light *light, *light_at_rest, *light_posed;
    float *radius;  /* by light */
    lmb_instance *instance, *instance_at_rest, *instance_posed;
    double shaped_s; /* time of the current mesh shapes; -1: none yet */
    lmb_view view_at_rest;
    lmb_vec3 middle; /* centre of the camera's swing, by at most `swing` rad; 0: none */
    float swing;
} play_motion;

/* Call these in order. play_motion_read: reads the path. play_motion_find: finds out, for a loaded job, whether the
 * file's animations move anything that may move. play_motion_make: call it once you have set the job; from then on the
 * motion owns the scene's lights and objects. play_motion_set: sets the job's scene and view to frame k; you may draw
 * frames in any order. They return 1, or 0 with `r` set. Release it with play_motion_free; zeroed: empty. */
int play_motion_read(play_motion *out, const play_options *o, report *r);
int play_motion_find(play_motion *inout, render_job *j, report *r);
int play_motion_make(play_motion *inout, report *r);
int play_motion_set(play_motion *m, int32_t k, report *r);

/* play_motion_suns: call it after the suns of the world in `light` have changed. */
void play_motion_suns(play_motion *m);
void play_motion_free(play_motion *m);

/* Time of the last key of the path or the animations, s; 0: neither moves anything. */
double play_motion_end(const play_motion *m);

/* Whether a path or animations moved something, and nothing moves at this time and later. */
int play_motion_is_over(const play_motion *m, double time_s);

#endif
