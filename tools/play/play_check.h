/* play_check.h: a frame's error against the best settings. */
#ifndef PLAY_CHECK_H
#define PLAY_CHECK_H

#include "../picture/metrics.h"
#include "../render/render_job.h"

/* Zeroed: empty. Release it with play_check_free. */
typedef struct play_check {
    render_job best;
    int is_made;
    uint32_t worlds; /* of the last frame */
} play_check;

/* play_check_frame: the errors of j->linear, for the job's present scene and view. Draw the frame before you call it.
 * The first call, and one after another world, allocate memory. `worlds` counts the job's changes of the world. Returns
 * 1, or 0 with `r` set. */
int play_check_frame(metrics *out, play_check *c, const render_job *j, uint32_t worlds, report *r);
void play_check_free(play_check *c);

#endif
