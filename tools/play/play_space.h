/* play_space.h: free space in a scene: distance to surfaces, and free paths. */
#ifndef PLAY_SPACE_H
#define PLAY_SPACE_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* Zeroed: empty. Release it with play_space_free. */
typedef struct play_space {
    lmb_bvh bvh;
    lmb_tile *tile;
    void *memory;
    const lmb_kernels *kernels;
    lmb_traversal traversal;
} play_space;

/* play_space_make: prepares a checked scene. Returns 1, or 0 with `r` set: out of memory. All calls together may use
 * the visibility tests of one tile (LMB_TRAVERSAL_FIRST). Beyond that, results are coarse, and traversal.coarse counts
 * them. */
int play_space_make(play_space *out, const lmb_scene *scene, const lmb_kernels *kernels, report *r);
void play_space_free(play_space *space);

/* play_space_sees: are all of `count` places, 1 .. 64, visible from one? */
int play_space_sees(play_space *space, lmb_vec3 from, const lmb_vec3 *place, int count);

/* play_space_reach: distance to the surface that `from` sees along a unit vector, m, to a thousandth; at most
 * `far_m`. */
float play_space_reach(play_space *space, lmb_vec3 from, lmb_vec3 along, float far_m);

#endif
