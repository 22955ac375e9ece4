/* mix_next.h: one frame of a sequence: prepared while the previous one is drawn, then drawn. */
#ifndef MIX_NEXT_H
#define MIX_NEXT_H

#include "mix_frames.h"

/* A frame that was read. */
typedef struct mix_ready {
    mix_job *job;    /* NULL: it cannot be used */
    mix_depth depth; /* valid if has_depth: the known depth merged with this frame's; `job` has a copy */
    int has_depth;
} mix_ready;

/* mix_make_ready: computes the depth that `k` will have after the current frame and this one and, if much of it is new,
 * the planes. It reads only k->frames, k->depth and the frame, so you may call it while a picture is drawn. */
void mix_make_ready(mix_ready *n, const mix_kept *k);

/* mix_draw_next: draws the frame into k->last and keeps the state for later frames; n then holds memory that is no
 * longer needed. On failure returns 0 with `r` set: the sequence goes on as if the frame were not listed, so frames
 * prepared meanwhile are invalid. */
int mix_draw_next(mix_ready *n, mix_kept *k, report *r);
void mix_ready_free(mix_ready *n);

#endif
