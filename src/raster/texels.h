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

#endif
