/* relight_way.h: light that follows a moving object: each computed cube is blended in over the next metres. */
#ifndef RELIGHT_WAY_H
#define RELIGHT_WAY_H

#include "relight_figures.h"

/* One cube as displayed. */
typedef struct way_cube {
    float *from, *shown; /* planes: when the blend began, and now */
    void *texels;
    int32_t side;
} way_cube;

/* State of one owner of light. Zeroed: it has not been anywhere. Release it with way_free. */
typedef struct way {
    way_cube irradiance, glossy[RELIGHT_GLOSSY_CUBES];
    lmb_vec3 at, ahead; /* last position; unit direction, or 0 */
    int32_t slot;       /* the slot that it blends in */
    float gone, share;  /* m since that was computed; weight of it */
    int has_begun, is_new;
} way;

/* way_move: moves the owner to `at`. Returns the unit direction, or 0 if the owner has just begun, rests or jumped over
 * more than `radius`. way_turn: blends to a slot's light from here on, whether computed now or before. */
lmb_vec3 way_move(way *inout, lmb_vec3 at, float radius);
void way_turn(way *inout, int32_t slot, int is_computed, float radius);

/* way_show: blends planes of n x n x 6 texels, as a cube. *step: raised to the relative RMSE of the change if that is
 * larger. Returns 1, or 0 with `r` set. */
int way_show(lmb_probe_cube *out, float *step, way_cube *inout, const way *w, const float *planes, int32_t n,
             report *r);

void way_free(way *w);

#endif
