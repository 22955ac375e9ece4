/* relight_way.h: light that follows an object along its way: each computed cube is blended in over the next metres. */
#ifndef RELIGHT_WAY_H
#define RELIGHT_WAY_H

#include "relight_figures.h"

/* One cube as it is shown. */
typedef struct way_cube {
    float *from, *shown; /* planes: when the blend began, and now */
    void *texels;
    int32_t side;
} way_cube;

/* Of one owner of light. Zeroed: it has not been anywhere; way_free releases it. */
typedef struct way {
    way_cube irradiance, glossy[RELIGHT_GLOSSY_CUBES];
    lmb_vec3 at, ahead; /* where it was last; its unit direction, or 0 */
    int32_t slot;       /* whose light it blends in */
    float gone, share;  /* m since that was computed; how much of it shows */
    int has_begun, is_new;
} way;

/* way_move: the owner is `at` now. Returns its unit direction, 0 if it has just begun, rests or jumped over more than
 * `radius`. way_turn: from here on the light of a slot counts, computed now or not. */
lmb_vec3 way_move(way *inout, lmb_vec3 at, float radius);
void way_turn(way *inout, int32_t slot, int is_computed, float radius);

/* way_show: planes of n x n x 6 texels as far as they are blended in, as a cube. *step: by how much its light changed
 * at least, relative RMSE, if that is more. 1, or 0 with `r` set. */
int way_show(lmb_probe_cube *out, float *step, way_cube *inout, const way *w, const float *planes, int32_t n, report *r);

void way_free(way *w);

#endif
