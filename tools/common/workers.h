/* workers.h: a frame's stages shared out among threads: maps and view by rows, pictures by bands. */
#ifndef WORKERS_H
#define WORKERS_H

#include <lambent/lambent.h>

#include "../../platform/host/pool.h"
#include "slice_items.h"

/* Who draws, and who is told how far it is. */
typedef struct workers {
    int threads;                  /* 1 .. POOL_MAX */
    lmb_band_scratch *scratches;  /* one a thread */
    void (*tell)(void *user, const lmb_render *r); /* from the calling thread, now and then; or NULL */
    void *user;
    double (*clock)(void);          /* s; NULL: the time that passes */
    int32_t every;                  /* one band in so many is drawn; 0, 1: all */
    slice slice;                    /* likewise: those of a slice */
    double stage_s[LMB_STAGE_DONE]; /* of the last frame and its further views, s */
    double stage_cpu_s[LMB_STAGE_DONE]; /* the same of the processor, all threads together */
} workers;

/* workers_render: lmb_render_frame on all threads: the same bytes and, in frame->stats, the same counts. The frame's
 * callback is not called. *stage is the last one begun. Returns what lmb_render_begin, _step and _band do. */
lmb_status workers_render(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame);

/* workers_reuse: the same by lmb_render_reuse: what did not change since r's last frame is kept. */
lmb_status workers_reuse(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame);

/* workers_light: the stages before `past` alone, of a frame that begins: its light's shadow maps, points, groups.
 * workers_again: lmb_render_again and the stages that follow; seconds add up to those before. */
lmb_status workers_light(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame, int32_t past);
lmb_status workers_again(workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame);

#endif
