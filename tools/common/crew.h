/* crew.h: a frame's stages shared out among threads: maps and view by rows, pictures by bands. */
#ifndef CREW_H
#define CREW_H

#include <lambent/lambent.h>

#include "../../platform/host/pool.h"

/* Who draws, and who is told how far it is. */
typedef struct crew {
    int threads;                  /* 1 .. POOL_MAX */
    lmb_band_scratch *scratches;  /* one a thread */
    void (*tell)(void *user, const lmb_render *r); /* from the calling thread, now and then; or NULL */
    void *user;
    double (*clock)(void);          /* s; NULL: the time that passes */
    int32_t every;                  /* one band in so many is drawn; 0, 1: all */
    double stage_s[LMB_STAGE_DONE]; /* of the last frame and its further views, s */
} crew;

/* crew_render: lmb_render_frame on all threads: the same bytes and, in frame->stats, the same counts. The frame's
 * callback is not called. *stage is the last one begun. Returns what lmb_render_begin, _step and _band do. */
lmb_status crew_render(crew *c, int32_t *stage, lmb_render *r, const lmb_frame *frame);

/* crew_light: the stages before `past` alone, of a frame that begins: its light's maps, points, groups.
 * crew_again: lmb_render_again and the stages that follow; seconds add up to those before. */
lmb_status crew_light(crew *c, int32_t *stage, lmb_render *r, const lmb_frame *frame, int32_t past);
lmb_status crew_again(crew *c, int32_t *stage, lmb_render *r, const lmb_frame *frame);

#endif
