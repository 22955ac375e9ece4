/* delta.c: shadow maps without and with an object, and the photo changed by their difference. Layer 6. [M9 M23 M24] */
#include "../base/poly.h"
#include "../base/vec.h"
#include "../raster/tile.h"
#include <lambent/mixed.h>

#if LMB_MIXED

#define MAX_MIRRORED_SHARE 0.5f

lmb_status lmb_two_maps(lmb_shadow_map maps[2], const lmb_light *light, const lmb_scene *scene, int32_t size,
                        void *memory, size_t bytes)
{
    const size_t half = bytes / 8 * 4;
    if (maps == NULL || memory == NULL) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = lmb_shadow_map_init(&maps[0], light, scene, size, LMB_ID32, memory, half);
    return status != LMB_OK
               ? status
               : lmb_shadow_map_init(&maps[1], light, scene, size, LMB_ID32, (char *)memory + half, half);
}

float lmb_real_albedo(float radiance, float irradiance)
{
    if (!(irradiance > 1e-6f)) {
        return 0.5f;
    }
    const float albedo = LMB_PI * radiance / irradiance;
    /* inf / inf is NaN, and gives the minimum. */
    return albedo > LMB_ALBEDO_MIN ? minf(albedo, LMB_ALBEDO_MAX) : LMB_ALBEDO_MIN;
}

lmb_status lmb_delta_tile(lmb_radiance *inout, const lmb_tile *real, const lmb_irradiance *without,
                          const lmb_irradiance *with)
{
    if (inout == NULL || real == NULL || without == NULL || with == NULL) {
        return LMB_ERR_ARG;
    }
    for (int32_t c = 0; c < 3; ++c) {
        for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
            const float delta = with->rgb[c][k] - without->rgb[c][k], photo = inout->rgb[c][k];
            if (real->id[k] != 0 && delta < 0.0f) {
                /* Light that the object blocks scales the photo, so it needs no albedo. */
                inout->rgb[c][k] = photo * maxf(with->rgb[c][k] / without->rgb[c][k], 0.0f);
            } else if (real->id[k] != 0 && delta > 0.0f) {
                inout->rgb[c][k] = photo + lmb_real_albedo(photo, without->rgb[c][k]) * (1.0f / LMB_PI) * delta;
            }
        }
    }
    return LMB_OK;
}

/* --- mirror image ------------------------------------------------------------------------------------------------- */

static float schlick(const lmb_tile *real, int32_t k, float specular)
{
    const lmb_vec3 p = tile_vec(real->position, k), n = tile_vec(real->normal, k);
    const float m = 1.0f - clampf(-dot3(normalize3(p), n), 0.0f, 1.0f), m2 = m * m;
    return specular + (1.0f - specular) * (m2 * m2 * m);
}

/* A pixel of the photo shows mirrored light plus the colour of the surface, so at most MAX_MIRRORED_SHARE of it can be
 * removed. Without this limit dark or colourful floors turn black or garish if the object hides a bright wall. */
static float mirrored(float photo, float share, float delta)
{
    return photo + maxf(share * delta, -MAX_MIRRORED_SHARE * photo);
}

lmb_status lmb_mirror_tile(lmb_radiance *inout, const lmb_tile *real, const lmb_planes *planes,
                           const lmb_pinhole *camera, int32_t p, const lmb_cone_seen *without,
                           const lmb_cone_seen *with, float specular)
{
    if (inout == NULL || real == NULL || planes == NULL || planes->label == NULL || camera == NULL ||
        without == NULL || with == NULL) {
        return LMB_ERR_ARG;
    }
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t x = real->x + k % LMB_TILE, y = real->y + k / LMB_TILE;
        const int inside = x >= 0 && y >= 0 && x < camera->width && y < camera->height;
        const int32_t label = real->id[k] != 0 && inside ? planes->label[y * camera->width + x] : 0;
        if (label == 0 || (p >= 0 && label - 1 != p)) {
            continue;
        }
        const float share = schlick(real, k, specular);
        for (int32_t c = 0; c < 3; ++c) {
            const float delta = with->rgb[c][k] - without->rgb[c][k];
            inout->rgb[c][k] = delta != 0.0f ? mirrored(inout->rgb[c][k], share, delta) : inout->rgb[c][k];
        }
    }
    return LMB_OK;
}

#endif
