/* mix_near.h: indirect light on the object. */
#ifndef MIX_NEAR_H
#define MIX_NEAR_H

#include "mix_cones.h"

/* The samples of a tile's pixels traced so far. */
typedef struct mix_near {
    lmb_tile tile;  /* position, normal; id 0: nothing yet */
    lmb_tile asked; /* scratch */
    lmb_irradiance light;
} mix_near;

/* mix_cones_near: like mix_cones_tile, but a sample near another sample of the same pixel takes its light, and a place
 * that the previous frame shows takes the light found there. This light does not depend on the view. */
void mix_cones_near(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile, mix_near *near);

#endif
