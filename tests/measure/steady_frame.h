/* steady_frame.h: a frame's light, the best light of the same frame, and the surface point of each pixel. */
#ifndef STEADY_FRAME_H
#define STEADY_FRAME_H

#include "../../tools/play/play_check.h"
#include "../../tools/play/play_motion.h"

/* Two jobs that draw the frames: one with the measured settings, one with the best. */
typedef struct steady_stage {
    play_options o;
    render_job job;
    play_motion motion;
    play_check check;
} steady_stage;

/* Pixels row by row. `light`, `best`: three a pixel, W/m2. */
typedef struct steady_frame {
    int32_t width, height;
    float *light, *best; /* best NULL: not needed */
    lmb_vec3 *place;
    uint32_t *id; /* 0: nothing */
    lmb_view view;
} steady_frame;

int steady_frame_make(steady_frame *out, int32_t width, int32_t height, int with_best);
void steady_frame_free(steady_frame *f);

/* steady_draw: draws the frame with the job's current scene and middle view. Returns 1, or 0 with `r` set. */
int steady_draw(steady_frame *out, steady_stage *s, report *r);

/* steady_look: grey light and best light of frame `f` at the surface point of pixel `i` of frame `of`, interpolated
 * between four pixels. Returns 0 if `f` does not show that point's triangle at all four, or `of` shows nothing at i. */
int steady_look(float *light, float *best, const steady_frame *f, const steady_frame *of, int32_t i);

#endif
