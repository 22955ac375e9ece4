/* direct.c: direct light on a tile: the kernel's irradiance for pixels that pass the shadow test. Layer 4. */
#include <lambent/light.h>

#include "../base/light_kind.h"
#include "../base/vec.h"
#include "../base/whole.h"
#include "../lane/kernels.h"
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

#if !LMB_SHADOW_LANES
/* doubtful: NULL, or gets bit k if the answer is LMB_LIT_IN_DOUBT. */
ALWAYS_INLINE int pixel_is_lit(lmb_shadow_query *query, uint64_t *doubtful, const lmb_tile *tile, int k)
{
    lmb_receiver r;
    r.position = vec3(tile->position[0][k], tile->position[1][k], tile->position[2][k]);
    r.face = vec3(tile->face[0][k], tile->face[1][k], tile->face[2][k]);
    r.id = tile->id[k];
    const int lit = lmb_is_lit(query, &r);
    if (doubtful != NULL && lit == LMB_LIT_IN_DOUBT) {
        *doubtful |= (uint64_t)1 << k;
    }
    return lit;
}
#endif

/* doubtful: NULL, or gets the lit pixels whose answer is LMB_LIT_IN_DOUBT. */
ALWAYS_INLINE lmb_status add_direct(lmb_irradiance *inout, uint64_t *doubtful, const lmb_kernels *kernels,
                                    const lmb_tile *tile, const lmb_view *view, const lmb_scene *scene,
                                    const lmb_light *light, const lmb_shadow_map *map)
{
    lmb_shadow_query query;
    lmb_irradiance one;
    if (inout == NULL || kernels == NULL || tile == NULL || view == NULL || scene == NULL || light == NULL) {
        return LMB_ERR_ARG;
    }
    lmb_direct_job job = make_job(light);
    lmb_shadow_ask(&query, map, light, scene, view);
    kernels->direct(&one, tile, &job);
#if LMB_SHADOW_LANES
    const uint64_t shown = kernels->direct_shown(&one, tile);
    uint64_t unused, lit = shown;
    if (map != NULL) {
        lit = lmb_shadow_lit(doubtful != NULL ? doubtful : &unused, &query, kernels, tile, shown);
    }
    kernels->direct_add(inout, &one, lit);
#else
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        int dark = tile->id[k] == 0 || (one.rgb[0][k] == 0.0f && one.rgb[1][k] == 0.0f && one.rgb[2][k] == 0.0f);
        if (!dark && (map == NULL || pixel_is_lit(&query, doubtful, tile, k))) {
            for (int c = 0; c < 3; ++c) {
                inout->rgb[c][k] += one.rgb[c][k];
            }
        }
    }
#endif
    return LMB_OK;
}

lmb_status lmb_direct_tile(lmb_irradiance *inout, const lmb_kernels *kernels, const lmb_tile *tile,
                           const lmb_view *view, const lmb_scene *scene, const lmb_light *light,
                           const lmb_shadow_map *map)
{
    return add_direct(inout, NULL, kernels, tile, view, scene, light, map);
}

#if LMB_FACETS

lmb_status lmb_direct_doubtful(lmb_irradiance *inout, uint64_t *doubtful, const light_tile *to, const lmb_light *light,
                               const lmb_shadow_map *map)
{
    *doubtful = 0;
    return add_direct(inout, doubtful, to->kernels, to->tile, to->view, to->scene, light, map);
}

#endif
