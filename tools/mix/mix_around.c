/* mix_around.c: the environment if the lights are given: folded from a photo without the lamps and their light. */
#include "mix_around.h"

#include <stddef.h>
#include <string.h>

typedef struct around {
    mix_job *j;
    lmb_view view;
    lmb_tile tile;
    lmb_irradiance lamps;
    image unlit;
} around;

/* Power of the lamps towards directions that the photo does not show, divided by the power towards those it shows; at
 * most 1. Reads one texel per tile of the shadow maps. */
static float elsewhere(const mix_job *j)
{
    double sent[2] = {0.0, 0.0};
    for (int32_t i = 0; i < j->light_count - j->lamp_count; ++i) {
        const lmb_shadow_map *map = &j->maps[i][0];
        lmb_shadow_map coarse = *map;
        coarse.size = map->size / LMB_TILE;
        const int32_t n = coarse.size;
        for (int32_t k = 0; k < map->faces * n * n; ++k) {
            const lmb_surface *id = &map->face[k / (n * n)].id;
            const char *row = (const char *)id->data + (ptrdiff_t)(k / n % n) * id->stride_bytes; /* of tiles */
            float power[3] = {0, 0, 0};
            if ((map->drawn >> k / (n * n) & 1u) != 0) {
                lmb_light_texel_power(power, &j->lights[i], &coarse, k / (n * n), k % n, k / n % n);
                sent[((const uint32_t *)(const void *)row)[LMB_TILE_PIXELS * (k % n)] != 0] +=
                    (double)(power[0] + power[1] + power[2]);
            }
        }
    }
    return sent[0] < sent[1] ? (float)(sent[0] / sent[1]) : 1.0f;
}

/* Sets pixels to the radiance of their surface under the environment and `share` of the lamps' light. A pixel brighter
 * than any surface under this light is itself a source. */
static void unlight_tile(around *a, int32_t x, int32_t y, float share)
{
    mix_job *j = a->j;
    lmb_real_tile(&a->tile, &j->cloud, &j->planes, &j->real, &j->axes, x, y);
    memset(&a->lamps, 0, sizeof a->lamps);
    for (int32_t i = 0; i < j->light_count - j->lamp_count; ++i) {
        lmb_direct_tile(&a->lamps, j->o.kernels, &a->tile, &a->view, &j->scene, &j->lights[i], &j->maps[i][0]);
    }
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        const lmb_vec3 n = {a->tile.normal[0][k], a->tile.normal[1][k], a->tile.normal[2][k]};
        float rgb[3];
        lmb_env_irradiance(rgb, &j->env[0], n);
        for (int c = 0; c < 3 && a->tile.id[k] != 0 && px < a->unlit.width && py < a->unlit.height; ++c) {
            const float lamps = a->lamps.rgb[c][k];
            const size_t at = 3 * ((size_t)py * (size_t)a->unlit.width + (size_t)px) + (size_t)c;
            a->unlit.pixels[at] = lmb_real_albedo(j->frame.light.pixels[at], rgb[c] + lamps) *
                                  (1.0f / 3.14159265f) * (rgb[c] + share * lamps);
        }
    }
}

int mix_around(mix_job *j, report *r)
{
    around *a = mix_take(j, sizeof *a, r);
    const size_t bytes = 3 * (size_t)j->frame.light.width * (size_t)j->frame.light.height * sizeof(float);
    float *pixels = mix_take(j, bytes, r);
    const float share = elsewhere(j);
    int32_t x0, y0;
    if (a == NULL || pixels == NULL || lmb_photo_view(&a->view, &x0, &y0, &j->frame.camera, &j->axes) != LMB_OK) {
        return 0;
    }
    a->j = j;
    a->unlit = j->frame.light;
    a->unlit.pixels = pixels;
    memcpy(pixels, j->frame.light.pixels, bytes); /* pixels without a surface */
    for (int32_t y = 0; y < a->unlit.height; y += LMB_TILE) {
        for (int32_t x = 0; x < a->unlit.width; x += LMB_TILE) {
            unlight_tile(a, x, y, share);
        }
    }
    lmb_env_fold(&j->env[0], pixels, a->unlit.width, a->unlit.height, &j->axes);
    return 1;
}
