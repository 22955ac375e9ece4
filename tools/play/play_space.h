/* play_space.h: where there is room in a scene: how far one sees, and whether a way is free. */
#ifndef PLAY_SPACE_H
#define PLAY_SPACE_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* Zeroed: none. play_space_free releases it. */
typedef struct play_space {
    lmb_bvh bvh;
    lmb_tile *tile;
    void *memory;
    const lmb_kernels *kernels;
    lmb_traversal traversal;
} play_space;

/* play_space_make: of a checked scene as it stands. 1, or 0 with `r` set: out of memory. All calls together spend a
 * tile's tests of visibility (LMB_TRAVERSAL_FIRST). Beyond these, calls are answered coarsely, and traversal.coarse
 * counts them. */
int play_space_make(play_space *out, const lmb_scene *scene, const lmb_kernels *kernels, report *r);
void play_space_free(play_space *space);

/* play_space_sees: are all of `count` places, 1 .. 64, seen from one? */
int play_space_sees(play_space *space, lmb_vec3 from, const lmb_vec3 *place, int count);

/* play_space_reach: how far it is to what `from` sees along a unit vector, m, to a thousandth; at most `far_m`. */
float play_space_reach(play_space *space, lmb_vec3 from, lmb_vec3 along, float far_m);

#endif
