/* composite.c: direct + indirect light of a tile -> radiance towards the viewer. Floor 7.             [V28 V29 V30] */
#include <lambent/compose.h>

#include "../base/vec.h"
#include "../lane/kernels.h"

lmb_status lmb_compose_tile(lmb_radiance *out, const lmb_kernels *kernels, const lmb_tile *tile,
                            const lmb_irradiance *direct, const lmb_irradiance *indirect)
{
    if (out == NULL || kernels == NULL || tile == NULL) {
        return LMB_ERR_ARG;
    }
    kernels->blend(out, tile, direct, indirect);
    return LMB_OK;
}

#if LMB_TREES

/* What the lobe takes is no longer there for the diffuse light below it: Schlick's F at the angle of view stands for it. */
lmb_status lmb_compose_gloss(lmb_radiance *inout, const lmb_gloss *gloss)
{
    if (inout == NULL || gloss == NULL) {
        return LMB_ERR_ARG;
    }
    for (uint64_t bits = gloss->pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const float low = maxf(1.0f - gloss->facing[k], 0.0f), low2 = low * low, rise = low2 * low2 * low;
        for (int c = 0; c < 3; ++c) {
            const float f0 = gloss->specular[c][k], f = f0 + (1.0f - f0) * rise;
            inout->rgb[c][k] = inout->rgb[c][k] * (1.0f - minf(f, 1.0f)) + gloss->rgb[c][k];
        }
    }
    return LMB_OK;
}

#endif
