/* composite.c: direct + indirect light of a tile -> radiance towards the viewer. Floor 7.             [V28 V29 V30] */
#include <lambent/compose.h>

#include "../base/vec.h"
#include "../lane/kernels.h"
#include "../light/gloss.h"
#include "../raster/triangle.h"

lmb_status lmb_compose_tile(lmb_radiance *out, const lmb_kernels *kernels, const lmb_tile *tile,
                            const lmb_irradiance *direct, const lmb_irradiance *indirect)
{
    if (out == NULL || kernels == NULL || tile == NULL) {
        return LMB_ERR_ARG;
    }
    kernels->blend(out, tile, direct, indirect);
    return LMB_OK;
}

lmb_status lmb_compose_shine(lmb_radiance *inout, const lmb_scene *scene, const lmb_tile *tile)
{
    uint32_t id = 0;
    const float *emission = NULL;
    if (inout == NULL || scene == NULL || tile == NULL) {
        return LMB_ERR_ARG;
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0 && tile->id[k] != id) {
            id = tile->id[k];
            emission = scene->materials[lmb_instance_of(scene, id)->material].emission;
        }
        for (int c = 0; c < 3 && tile->id[k] != 0; ++c) {
            inout->rgb[c][k] += emission[c];
        }
    }
    return LMB_OK;
}

#if LMB_LOBES

lmb_status lmb_compose_gloss(lmb_radiance *inout, const lmb_gloss *gloss)
{
    if (inout == NULL || gloss == NULL) {
        return LMB_ERR_ARG;
    }
    for (uint64_t bits = gloss->pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] = inout->rgb[c][k] * (1.0f - gloss_share(gloss, c, k)) + gloss->rgb[c][k];
        }
    }
    return LMB_OK;
}

#endif
