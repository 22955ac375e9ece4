/* mix_near.h: light from around on the object. */
#ifndef MIX_NEAR_H
#define MIX_NEAR_H

#include "mix_cones.h"

/* What samples of a tile's pixels have found so far. */
typedef struct mix_near {
    lmb_tile tile;  /* position, normal; id 0: nothing yet */
    lmb_tile asked; /* scratch */
    lmb_irradiance light;
} mix_near;

/* mix_cones_near: as mix_cones_tile, but what lies beside what another sample of its pixel has found takes that, and what the
 * frame before saw takes what it found there: it is no matter of where it is seen from. */
void mix_cones_near(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile, mix_near *near);

#endif
