/* direct.c: direct light on a tile: the kernel's irradiance for pixels that pass the shadow test. Layer 4. */
#include <lambent/light.h>

#include "../base/light_kind.h"
#include "../base/vec.h"
#include "../base/whole.h"
#include "../lane/kernels.h"
#include "../raster/tile.h"
#include "light_tile.h"
#include "shadow.h"

static lmb_direct_job make_job(const lmb_light *light)
{
    lmb_direct_job job;
    float width = light->cos_inner - light->cos_outer;
    job.position = light->position;
    job.direction = light->direction;
    job.cos_outer = light->cos_outer;
    job.cone_scale = 1.0f / maxf(width, 1e-6f); /* a hard edge: a step over a millionth */
    job.range2 = light_range2(light);
    job.kind = light->kind;
    for (int c = 0; c < 3; ++c) {
        /* Below 2^-80 it counts as 0, as in the maps, so that kernels meet no denormals. */
        job.intensity[c] = light->intensity[c] < 8.2718061e-25f ? 0.0f : light->intensity[c];
    }
    return job;
}

/* The irradiance of all pixels without shadows. Returns the pixels that the light reaches; without a map, all. */
ALWAYS_INLINE lmb_lit_pixels find_direct(lmb_irradiance *one, lmb_shadow_query *query, const lmb_kernels *kernels,
                                         const lmb_tile *tile)
{
    lmb_lit_pixels out = {0, 0, 0};
    const lmb_direct_job job = make_job(query->light);
    kernels->direct(one, tile, &job);
#if LMB_SHADOW_LANES
    out.lit = kernels->direct_shown(one, tile);
    if (query->map != NULL) {
        lmb_shadow_lit(&out, query, kernels, tile, out.lit);
    }
#else
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int dark =
            tile->id[k] == 0 || (one->rgb[0][k] == 0.0f && one->rgb[1][k] == 0.0f && one->rgb[2][k] == 0.0f);
        const lmb_receiver r = {tile_vec(tile->position, k), tile_vec(tile->face, k), tile->id[k]};
        const int lit = dark ? 0 : query->map == NULL ? 1 : lmb_is_lit(query, &r);
        out.lit |= (uint64_t)(lit != 0) << k;
        out.doubtful |= (uint64_t)(lit == LMB_LIT_IN_DOUBT) << k;
        out.beside |= (uint64_t)(lit == LMB_LIT_BESIDE) << k;
    }
#endif
    return out;
}

static void add_lit(lmb_irradiance *inout, const lmb_kernels *kernels, const lmb_irradiance *one, uint64_t lit)
{
#if LMB_SHADOW_LANES
    kernels->direct_add(inout, one, lit);
#else
    (void)kernels;
    for (uint64_t bits = lit; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] += one->rgb[c][k];
        }
    }
#endif
}

lmb_status lmb_direct_tile(lmb_irradiance *inout, const lmb_kernels *kernels, const lmb_tile *tile,
                           const lmb_view *view, const lmb_scene *scene, const lmb_light *light,
                           const lmb_shadow_map *map)
{
    lmb_shadow_query query;
    lmb_irradiance one;
    if (inout == NULL || kernels == NULL || tile == NULL || view == NULL || scene == NULL || light == NULL) {
        return LMB_ERR_ARG;
    }
    lmb_shadow_ask(&query, map, light, scene, view);
    const lmb_lit_pixels found = find_direct(&one, &query, kernels, tile);
    add_lit(inout, kernels, &one, found.lit);
    return LMB_OK;
}

#if LMB_FACETS

uint64_t lmb_direct_find(lmb_irradiance *one, uint64_t *lit, const light_tile *to, const lmb_light *light,
                         const lmb_shadow_map *map, int is_brief)
{
    lmb_shadow_query query;
    lmb_shadow_ask(&query, map, light, to->scene, to->view);
    const lmb_lit_pixels found = find_direct(one, &query, to->kernels, to->tile);
    *lit = found.lit;
    return lmb_shadow_unsure(&query, to->tile, &found, is_brief);
}

void lmb_direct_add(lmb_irradiance *inout, const lmb_kernels *kernels, const lmb_irradiance *one, uint64_t lit)
{
    add_lit(inout, kernels, one, lit);
}

#endif
