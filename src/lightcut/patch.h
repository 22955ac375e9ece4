/* patch.h: the pixels of one surface in a tile, which take a cut of the light's tree together. Floor 7. */
#ifndef LMB_LIGHTCUT_PATCH_H
#define LMB_LIGHTCUT_PATCH_H

#include "../lane/kernels.h"

void lmb_patch_of(lmb_patch *out, const lmb_tile *tile, uint64_t pixels);

/* How far the patch's box reaches along a direction from its centre, m. */
float lmb_patch_reach(const lmb_patch *p, lmb_vec3 along);

/* Squared distance of a point from the patch's box, m2. */
float lmb_patch_apart2(const lmb_patch *p, lmb_vec3 at);

#endif
