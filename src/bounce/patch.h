/* patch.h: the pixels of one surface in a tile, which take a cut of the light's tree together. Floor 6. */
#ifndef LMB_BOUNCE_PATCH_H
#define LMB_BOUNCE_PATCH_H

#include "../base/vec.h"
#include "../lane/kernels.h"

void lmb_patch_of(lmb_patch *out, const lmb_tile *tile, uint64_t pixels);

static inline float gap(float centre, float halves) { return maxf(absf(centre) - halves, 0.0f); }

/* Between two boxes: `to`: from one's centre to the other's. */
static inline lmb_vec3 boxes_apart(lmb_vec3 to, lmb_vec3 a, lmb_vec3 b)
{
    return vec3(gap(to.x, a.x + b.x), gap(to.y, a.y + b.y), gap(to.z, a.z + b.z));
}

#endif
