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

/* What the lobe takes is no longer there for the diffuse light below it. It takes about what it would reflect of
 * light from everywhere: F0 + (1 - F0) (1 - alpha)^3 (1 - n.v)^5, Schlick's F flattened by roughness, fitted to the
 * lobe of F0 = 0.04: that is 0.01 too little at most, between smooth and rough, and 0.13 too much, where it grazes. */
lmb_status lmb_compose_gloss(lmb_radiance *inout, const lmb_gloss *gloss)
{
    if (inout == NULL || gloss == NULL) {
        return LMB_ERR_ARG;
    }
    for (uint64_t bits = gloss->pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const float low = maxf(1.0f - gloss->facing[k], 0.0f), low2 = low * low;
        const float smooth = maxf(1.0f - sqrtf(gloss->alpha2[k]), 0.0f);
        const float rise = low2 * low2 * low * (smooth * smooth * smooth);
        for (int c = 0; c < 3; ++c) {
            const float f0 = gloss->specular[c][k], taken = minf(f0 + (1.0f - f0) * rise, 1.0f);
            inout->rgb[c][k] = inout->rgb[c][k] * (1.0f - taken) + gloss->rgb[c][k];
        }
    }
    return LMB_OK;
}

#endif
