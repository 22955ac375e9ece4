/* composite.c: direct + indirect light of a tile -> radiance towards the viewer. Floor 7.             [V28 V29 V30] */
#include <lambent/compose.h>

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
