/* draw_texel.c: a texture's codes at a point, filtered in integers. Layer 4. */
#include "draw_part.h"

#include "../raster/texels.h"

#if LMB_DRAW
/* Adds weight x the codes of texel (x, y). */
static void texel_add(uint32_t sum[4], const lmb_texture *t, const texel_level *l, int32_t x, int32_t y,
                      uint32_t weight)
{
    uint8_t made[4];
    const uint8_t *p = made;
    const size_t at =
        (size_t)texel_wrap(y, l->height, t->wrap_t) * (size_t)l->width + (size_t)texel_wrap(x, l->width, t->wrap_s);
    if (t->format == LMB_TEXELS_PALETTE4) {
        p = t->texels + 4 * (size_t)(l->texels[at / 2] >> 4 * (at & 1u) & 15u);
    } else if (t->format == LMB_TEXELS_RGB565) {
        lmb_draw_read_pixel(made, LMB_RGB565, l->texels + 2 * at);
    } else {
        p = l->texels + 4 * at;
    }
    for (int c = 0; c < 4; ++c) {
        sum[c] += weight * p[c];
    }
}

/* Adds share x the level's bilinear sample; the four weights sum to 2^16. */
static void texel_add_level(uint32_t sum[4], const lmb_texture *t, int32_t n, float u, float v, uint32_t share)
{
    const texel_level l = texel_find_level(t, n);
    const int32_t x = (int32_t)(texel_reduce(u, t->wrap_s) * (float)(l.width * 256)) - 128,
                  y = (int32_t)(texel_reduce(v, t->wrap_t) * (float)(l.height * 256)) - 128;
    const uint32_t fx = (uint32_t)x & 255u, fy = (uint32_t)y & 255u;
    texel_add(sum, t, &l, x >> 8, y >> 8, share * (256u - fx) * (256u - fy));
    texel_add(sum, t, &l, (x >> 8) + 1, y >> 8, share * fx * (256u - fy));
    texel_add(sum, t, &l, x >> 8, (y >> 8) + 1, share * (256u - fx) * fy);
    texel_add(sum, t, &l, (x >> 8) + 1, (y >> 8) + 1, share * fx * fy);
}

void lmb_draw_texel(uint8_t out[4], const lmb_texture *t, float u, float v, int32_t level)
{
    uint32_t sum[4] = {0, 0, 0, 0};
    if (t->filter == LMB_NEAREST) {
        const texel_level l = texel_find_level(t, 0);
        texel_add(sum, t, &l, (int32_t)(texel_reduce(u, t->wrap_s) * (float)l.width),
                  (int32_t)(texel_reduce(v, t->wrap_t) * (float)l.height), 1u << 24);
    } else {
        const uint32_t part = (uint32_t)level & 255u; /* 255 x 2^24 and the rounding fit 32 bits */
        texel_add_level(sum, t, level >> 8, u, v, 256u - part);
        if (part != 0) {
            texel_add_level(sum, t, (level >> 8) + 1, u, v, part);
        }
    }
    for (int c = 0; c < 4; ++c) {
        out[c] = (uint8_t)((sum[c] + (1u << 23)) >> 24);
    }
}
#endif
