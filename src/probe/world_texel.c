/* world_texel.c: one texel of a world, coded and back. Layer 5.                                             [S4] */
#include "../base/poly.h"
#include "world.h"

/* e = (log10(c + LOG_SHIFT) + 1) / 3; LOG_MAX has code 1. */
#define LOG_SHIFT 0.101f
#define LOG_MAX 99.899f

float lmb_world_encode(float c)
{
    c = c > 0.0f ? minf(c, LOG_MAX) : 0.0f;
    return clampf((lmb_log2(c + LOG_SHIFT) * (1.0f / LMB_WORLD_LOG2_10) + 1.0f) * (1.0f / 3.0f), 0.0f, 1.0f);
}

float lmb_world_decode(float e)
{
    e = e > 0.0f ? minf(e, 1.0f) : 0.0f;
    return maxf(lmb_exp2((3.0f * e - 1.0f) * LMB_WORLD_LOG2_10) - LOG_SHIFT, 0.0f);
}

static int32_t code_of_exponent(float e, float steps) { return (int32_t)(e * steps + 0.5f); }

void lmb_world_put(const lmb_world *w, size_t at, const float rgba[4])
{
    for (int c = 0; c < 4; ++c) {
        const float v = c < 3 && w->format != LMB_WORLD_F32 ? lmb_world_encode(rgba[c]) : rgba[c];
        switch (w->format) {
        case LMB_WORLD_LOG8:
            ((uint8_t *)w->texels)[4 * at + (size_t)c] = (uint8_t)code_of_exponent(v, 255.0f);
            break;
        case LMB_WORLD_LOG16:
            ((uint16_t *)w->texels)[4 * at + (size_t)c] = (uint16_t)code_of_exponent(v, 65535.0f);
            break;
        default: ((float *)w->texels)[4 * at + (size_t)c] = v; break;
        }
    }
}

void lmb_world_texel(float out[4], const lmb_world *w, size_t at)
{
    for (int c = 0; c < 4; ++c) {
        const size_t i = 4 * at + (size_t)c;
        if (w->format == LMB_WORLD_F32) {
            out[c] = ((const float *)w->texels)[i];
        } else if (w->format == LMB_WORLD_LOG8) {
            const uint8_t code = ((const uint8_t *)w->texels)[i];
            out[c] = c < 3 ? w->log8[code] : (float)code * (1.0f / 255.0f);
        } else {
            const uint16_t code = ((const uint16_t *)w->texels)[i];
            out[c] = c < 3 ? maxf(w->log16[0][code >> 8] * w->log16[1][code & 255] - LOG_SHIFT, 0.0f)
                           : (float)code * (1.0f / 65535.0f);
        }
    }
}

size_t lmb_world_face_texel(const lmb_world_level *l, int32_t face, int32_t x, int32_t y)
{
    const size_t side = (size_t)l->width + 2;
    return l->at + ((size_t)face * side + (size_t)(y + 1)) * side + (size_t)(x + 1);
}
