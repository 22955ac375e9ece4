/* lit.c: one of the scene's lights on a tile. Floor 5. */
#include "lit.h"

#include <string.h>

lmb_status lmb_lit_add(lmb_irradiance *sum, lmb_gloss *gloss, lmb_irradiance *one, const lit_tile *to, uint32_t i,
                       const lmb_light_map *map)
{
    const lmb_light *light = &to->scene->lights[i];
    if (gloss == NULL) {
        return lmb_direct_tile(sum, to->kernels, to->tile, to->view, to->scene, light, map);
    }
#if LMB_LOBES
    memset(one, 0, sizeof *one);
    const lmb_status status = lmb_direct_tile(one, to->kernels, to->tile, to->view, to->scene, light, map);
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        sum->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] += one->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
    }
    return status == LMB_OK ? lmb_gloss_direct(gloss, to->kernels, to->tile, one, light) : status;
#else
    (void)one;
    return LMB_ERR_ARG;
#endif
}
