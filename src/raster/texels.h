/* texels.h: addresses of texels: levels, formats, coordinates that repeat or are mirrored. Layer 3. */
#ifndef LMB_RASTER_TEXELS_H
#define LMB_RASTER_TEXELS_H

#include <lambent/scene.h>

#include "../base/vec.h"

typedef struct texel_level {
    const uint8_t *texels;
    int32_t width, height;
} texel_level;

enum { PALETTE_BYTES = 64 };

static inline int texels_are_rgba8(const lmb_texture *t)
{
    return !LMB_TEXTURE_FORMATS || t->format == LMB_TEXELS_RGBA8;
}

static inline size_t texels_bytes(const lmb_texture *t, size_t texels)
{
    return texels_are_rgba8(t) ? 4 * texels : t->format == LMB_TEXELS_RGB565 ? 2 * texels : (texels + 1) / 2;
}

static inline texel_level texel_find_level(const lmb_texture *t, int32_t n)
{
    texel_level l;
    l.texels = t->texels + (!texels_are_rgba8(t) && t->format == LMB_TEXELS_PALETTE4 ? PALETTE_BYTES : 0);
    l.width = t->width;
    l.height = t->height;
    for (int32_t i = 0; i < n; ++i) {
        l.texels += texels_bytes(t, (size_t)l.width * (size_t)l.height);
        l.width = maxi(l.width / 2, 1);
        l.height = maxi(l.height / 2, 1);
    }
    return l;
}

/* floorf for sane values: without a call, so callers save fewer registers. */
static inline float texel_floor(float v)
{
    const float whole = (float)(int32_t)v;
    return whole > v ? whole - 1.0f : whole;
}

/* Reduces to one period, so that texel indices stay small: 0 .. 1, or 0 .. 2 if mirrored. Absurd values become 0. */
static inline float texel_reduce(float u, int wrap)
{
    if (!is_sane(u)) {
        return 0.0f;
    }
    switch (wrap) {
    case LMB_WRAP_CLAMP: return clampf(u, 0.0f, 1.0f);
    case LMB_WRAP_MIRROR: return u - 2.0f * texel_floor(u * 0.5f);
    default: return u - texel_floor(u);
    }
}

/* Index of texel i of a side, for -1 .. twice the size. */
static inline int32_t texel_wrap(int32_t i, int32_t size, int wrap)
{
    switch (wrap) {
    case LMB_WRAP_CLAMP: return mini(maxi(i, 0), size - 1);
    case LMB_WRAP_MIRROR:
        i = i < 0 ? -1 - i : i;
        i = i >= 2 * size ? i - 2 * size : i;
        return i >= size ? 2 * size - 1 - i : i;
    default: return i < 0 ? i + size : i >= size ? i - size : i;
    }
}

/* Alpha of level 0 of an RGBA8 texture: the bits of lmb_texture_sample. Many samples of a mask lie between four texels
 * without coverage, and need no weights. */
static inline float texels_alpha(const lmb_texture *t, float u, float v)
{
    const uint8_t *alpha = t->texels + 3;
    const int32_t width = t->width, height = t->height;
    float x = texel_reduce(u, t->wrap_s) * (float)width, y = texel_reduce(v, t->wrap_t) * (float)height;
    if (t->filter == LMB_NEAREST) {
        const size_t row = (size_t)texel_wrap((int32_t)y, height, t->wrap_t) * (size_t)width;
        return (float)alpha[4 * (row + (size_t)texel_wrap((int32_t)x, width, t->wrap_s))] * (1.0f / 255.0f);
    }
    x -= 0.5f;
    y -= 0.5f;
    const float x0 = texel_floor(x), y0 = texel_floor(y);
    const size_t left = (size_t)texel_wrap((int32_t)x0, width, t->wrap_s),
                 right = (size_t)texel_wrap((int32_t)x0 + 1, width, t->wrap_s),
                 upper = (size_t)texel_wrap((int32_t)y0, height, t->wrap_t) * (size_t)width,
                 lower = (size_t)texel_wrap((int32_t)y0 + 1, height, t->wrap_t) * (size_t)width;
    const int32_t a = alpha[4 * (upper + left)], b = alpha[4 * (upper + right)], c = alpha[4 * (lower + left)],
                  d = alpha[4 * (lower + right)];
    if ((a | b | c | d) == 0) {
        return 0.0f;
    }
    const float fx = x - x0, fy = y - y0;
    float out = ((1.0f - fx) * (1.0f - fy)) * ((float)a * (1.0f / 255.0f));
    out += (fx * (1.0f - fy)) * ((float)b * (1.0f / 255.0f));
    out += ((1.0f - fx) * fy) * ((float)c * (1.0f / 255.0f));
    return out + (fx * fy) * ((float)d * (1.0f / 255.0f));
}

#endif
