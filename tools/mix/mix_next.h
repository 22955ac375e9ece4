/* mix_next.h: one frame of a sequence: made ready while the one before it is drawn, then drawn. */
#ifndef MIX_NEXT_H
#define MIX_NEXT_H

#include "mix_frames.h"

/* A frame that was read. */
typedef struct mix_ready {
    mix_job *job;    /* NULL: it cannot be used */
    mix_depth depth; /* what is known with it, and `job` has its part of that, */
    int has_depth;   /* where this is 1 */
} mix_ready;

/* mix_make_ready: what `k` will know when the frame that is drawn now was kept, and with this one; and where that is much,
 * its planes. What k->frames, k->depth and the frame itself say is read alone: pictures may be drawn meanwhile. */
void mix_make_ready(mix_ready *n, const mix_kept *k);

/* mix_draw_next: its picture is k->last's, and what later frames need is kept; n has what nobody needs. 0, with `r` set:
 * the next frames are those of a list without it, and what was made ready meanwhile is not. */
int mix_draw_next(mix_ready *n, mix_kept *k, report *r);
void mix_ready_free(mix_ready *n);

#endif
