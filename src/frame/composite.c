/* composite.c: direct + indirect light of a tile -> radiance towards the viewer. Layer 8.             [V28 V29 V30] */
#include <lambent/compose.h>

#include "../base/vec.h"
#include "../lane/kernels.h"
#include "../direct/glossy.h"
#include "../raster/paint.h"

lmb_status lmb_compose_tile(lmb_radiance *out, const lmb_kernels *kernels, const lmb_tile *tile,
                            const lmb_irradiance *direct, const lmb_irradiance *indirect)
{
    if (out == NULL || kernels == NULL || tile == NULL) {
        return LMB_ERR_ARG;
    }
    kernels->blend(out, tile, direct, indirect);
    return LMB_OK;
}

lmb_status lmb_compose_emission(lmb_radiance *inout, const lmb_scene *scene, const lmb_view *view, const lmb_tile *tile)
{
    const lmb_material *m = NULL;
    uint32_t id = 0;
    if (inout == NULL || scene == NULL || view == NULL || tile == NULL) {
        return LMB_ERR_ARG;
    }
#if LMB_LOBES
    lmb_painter painter;
    lmb_painter_begin(&painter, scene, view, tile);
#endif
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        float texel[4] = {1.0f, 1.0f, 1.0f, 1.0f};
        if (tile->id[k] != id) {
            id = tile->id[k];
            m = lmb_material_of(scene, id);
        }
        if (m == NULL) {
            continue;
        }
#if LMB_LOBES
        if (m->emission_map > 0) {
            lmb_painter_colour(texel, &painter, m->emission_map - 1, k);
        }
#endif
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] += m->emission[c] * texel[c];
        }
    }
    return LMB_OK;
}

#if LMB_LOBES

lmb_status lmb_compose_glossy(lmb_radiance *inout, const lmb_glossy *glossy)
{
    if (inout == NULL || glossy == NULL) {
        return LMB_ERR_ARG;
    }
    for (uint64_t bits = glossy->pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] = inout->rgb[c][k] * (1.0f - glossy_share(glossy, c, k)) + glossy->rgb[c][k];
        }
    }
    return LMB_OK;
}

#endif
