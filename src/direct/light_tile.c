/* light_tile.c: adds one of the scene's lights to a tile. Layer 4. */
#include "light_tile.h"

#include <string.h>

lmb_status lmb_light_tile_add(lmb_irradiance *sum, lmb_glossy *glossy, lmb_irradiance *one, const light_tile *to,
                              uint32_t i, const lmb_shadow_map *map)
{
    const lmb_light *light = &to->scene->lights[i];
    if (glossy == NULL) {
        return lmb_direct_tile(sum, to->kernels, to->tile, to->view, to->scene, light, map);
    }
#if LMB_LOBES
    memset(one, 0, sizeof *one);
    const lmb_status status = lmb_direct_tile(one, to->kernels, to->tile, to->view, to->scene, light, map);
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        sum->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] += one->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
    }
    return status == LMB_OK ? lmb_glossy_direct(glossy, to->kernels, to->tile, one, light) : status;
#else
    (void)one;
    return LMB_ERR_ARG;
#endif
}
