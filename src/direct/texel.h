/* texel.h: a row of a shadow map's texels, for src/direct/texel.inl. Layer 4. */
#ifndef LMB_DIRECT_TEXEL_H
#define LMB_DIRECT_TEXEL_H

#include "../base/light_kind.h"
#include "../lane/kernels.h"

#define FLUX_FLOOR 8.2718061e-25f /* 2^-80 W: less counts as 0, so that kernels meet no denormals */

/* Row y of a face, with the light's cone. */
void lmb_texel_row_of(lmb_texel_row *out, const lmb_light *light, const lmb_shadow_map *map, int32_t face, int32_t y);

/* Centre of texel x of `size` in the view's plane at distance 1 (m for suns). */
static inline float texel_sx(const lmb_view *v, int32_t size, int32_t x)
{
    return ((float)(2 * x + 1 - size) * 0.5f) * (2.0f * v->half_width / (float)size);
}

static inline float texel_sy(const lmb_view *v, int32_t size, int32_t y)
{
    return ((float)(size - 2 * y - 1) * 0.5f) * (2.0f * v->half_height / (float)size);
}

/* Flux of one channel of the light through a texel of this power, W. */
static inline float texel_flux(float intensity, float power)
{
    const float w = intensity * power;
    return w < FLUX_FLOOR ? 0.0f : w;
}

/* Reduces a texel's power by the light's range, at the position of a surface. */
static inline void light_end_power(float power[3], const lmb_light *light, lmb_vec3 at)
{
    const float left = light_within_at(light, at);
    for (int c = 0; c < 3 && left < 1.0f; ++c) {
        power[c] = texel_flux(power[c], left);
    }
}

#endif
