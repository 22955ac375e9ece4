/* workers.h: runs the stages of a frame on several threads: maps and view by rows, pictures by bands. */
#ifndef WORKERS_H
#define WORKERS_H

#include <lambent/lambent.h>

#include "../../platform/host/pool.h"
#include "slice_items.h"

/* The threads, and a progress callback. */
typedef struct workers {
    int threads;                  /* 1 .. POOL_MAX */
    lmb_band_scratch *scratches;  /* one per thread */
    void (*tell)(void *user, const lmb_render *r); /* called now and then from the calling thread; or NULL */
    void *user;
    double (*clock)(void);          /* s; NULL: wall clock */
    int32_t every;                  /* draws one of `every` bands; 0, 1: all */
    slice slice;                    /* draws only the bands of a slice */
    double stage_s[LMB_STAGE_DONE]; /* of the last frame and further views of it, s */
    double stage_cpu_s[LMB_STAGE_DONE]; /* the same in processor time, summed over threads */
} workers;

/* workers_render: lmb_render_frame on all threads, with the same bytes and, in frame->stats, the same counts. The
 * frame's callback is not called. *stage is the last stage that began. Returns the status of lmb_render_begin, _step
 * and _band. */
lmb_status workers_render(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame);

/* workers_reuse: like workers_render, with lmb_render_reuse: keeps results that did not change since r's last frame. */
lmb_status workers_reuse(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame);

/* workers_light: begins a frame and runs only the stages before `past`: shadow maps, points, groups. workers_again:
 * runs lmb_render_again and the stages that follow; adds to the seconds. workers_again_drawn: the same for ids that you
 * have put into frame->eye, which holds the whole frame. The scene has at least one triangle. */
lmb_status workers_light(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame, int32_t past);
lmb_status workers_again(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame);
lmb_status workers_again_drawn(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame);

#endif
