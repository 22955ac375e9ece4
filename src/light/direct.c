/* direct.c: direct light on a tile: the kernel's irradiance where the shadow map says lit. Layer 5. */
#include <lambent/light.h>

#include "../base/vec.h"
#include "../lane/kernels.h"
#include "shadow.h"

static lmb_direct_job make_job(const lmb_light *light)
{
    lmb_direct_job job;
    float width = light->cos_inner - light->cos_outer;
    job.position = light->position;
    job.direction = light->direction;
    job.cos_outer = light->cos_outer;
    job.cone_scale = 1.0f / maxf(width, 1e-6f); /* a hard edge: a step over a millionth */
    job.kind = light->kind;
    for (int c = 0; c < 3; ++c) {
        /* Under 2^-80 it is nothing, as in the maps: a kernel meets no denormal. */
        job.intensity[c] = light->intensity[c] < 8.2718061e-25f ? 0.0f : light->intensity[c];
    }
    return job;
}

static int pixel_is_lit(const lmb_tile *tile, int k, const lmb_view *view, const lmb_scene *scene,
                        const lmb_light *light, const lmb_shadow_map *map)
{
    lmb_receiver r;
    r.position = vec3(tile->position[0][k], tile->position[1][k], tile->position[2][k]);
    r.face = vec3(tile->face[0][k], tile->face[1][k], tile->face[2][k]);
    r.id = tile->id[k];
    /* 2^-15 of the pixel's distance: of its place in its triangle's plane, whose edges are snapped to parts of a pixel;
     * 2^-22 of its coordinates: a few roundings of the resolve. */
    r.noise = 3.0517578e-5f * length3(sub3(r.position, view->eye)) + 2.3841858e-7f * length3(r.position);
    return lmb_is_lit(map, light, scene, &r);
}

lmb_status lmb_direct_tile(lmb_irradiance *inout, const lmb_kernels *kernels, const lmb_tile *tile,
                           const lmb_view *view, const lmb_scene *scene, const lmb_light *light,
                           const lmb_shadow_map *map)
{
    lmb_irradiance one;
    if (inout == NULL || kernels == NULL || tile == NULL || view == NULL || scene == NULL || light == NULL) {
        return LMB_ERR_ARG;
    }
    lmb_direct_job job = make_job(light);
    kernels->direct(&one, tile, &job);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        int dark = tile->id[k] == 0 || (one.rgb[0][k] == 0.0f && one.rgb[1][k] == 0.0f && one.rgb[2][k] == 0.0f);
        if (!dark && (map == NULL || pixel_is_lit(tile, k, view, scene, light, map))) {
            for (int c = 0; c < 3; ++c) {
                inout->rgb[c][k] += one.rgb[c][k];
            }
        }
    }
    return LMB_OK;
}
