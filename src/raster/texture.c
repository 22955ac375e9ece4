/* texture.c: an image at a point: nearest, bilinear, trilinear; repeat, clamp, mirror. Floor 3.
 *
 * Colours are decoded to linear light before they are mixed. glTF: (0, 0) is the first texel's corner. */
#include "texture.h"

#include "../base/codec.h"
#include "../base/vec.h"

typedef struct level {
    const uint8_t *texels;
    int32_t width, height;
} level;

static level find_level(const lmb_texture *t, int32_t n)
{
    level l;
    l.texels = t->texels;
    l.width = t->width;
    l.height = t->height;
    for (int32_t i = 0; i < n; ++i) {
        l.texels += (size_t)l.width * (size_t)l.height * 4;
        l.width = maxi(l.width / 2, 1);
        l.height = maxi(l.height / 2, 1);
    }
    return l;
}

/* Into one period, so that texel numbers stay small: [0, 1), or [0, 2) for mirrored ones. */
static float reduce(float u, int wrap)
{
    if (!is_sane(u)) {
        return 0.0f;
    }
    switch (wrap) {
    case LMB_WRAP_CLAMP: return clampf(u, 0.0f, 1.0f);
    case LMB_WRAP_MIRROR: return u - 2.0f * floorf(u * 0.5f);
    default: return u - floorf(u);
    }
}

static int32_t wrap_texel(int32_t i, int32_t size, int wrap)
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

/* What the codes of R G B stand for. Alpha is linear. */
enum { AS_COLOUR, AS_VECTOR };

/* Where on a level, and what for. */
typedef struct lookup {
    const lmb_texture *texture;
    float u, v;
    int32_t codes;
} lookup;

static float decode(int32_t codes, uint8_t code)
{
    return codes == AS_COLOUR ? lmb_srgb_decode(code) : (float)code * (2.0f / 255.0f) - 1.0f;
}

static void add_texel(float out[4], const lookup *at, const level *l, int32_t x, int32_t y, float weight)
{
    const lmb_texture *t = at->texture;
    const uint8_t *p = l->texels + 4 * ((size_t)wrap_texel(y, l->height, t->wrap_t) * (size_t)l->width +
                                        (size_t)wrap_texel(x, l->width, t->wrap_s));
    for (int c = 0; c < 3; ++c) {
        out[c] += weight * decode(at->codes, p[c]);
    }
    out[3] += weight * ((float)p[3] * (1.0f / 255.0f));
}

static void sample_level(float out[4], const lookup *at, int32_t n, float weight)
{
    const lmb_texture *t = at->texture;
    level l = find_level(t, n);
    float x = reduce(at->u, t->wrap_s) * (float)l.width, y = reduce(at->v, t->wrap_t) * (float)l.height;
    if (t->filter == LMB_NEAREST) {
        add_texel(out, at, &l, (int32_t)x, (int32_t)y, weight);
        return;
    }
    float x0 = floorf(x - 0.5f), y0 = floorf(y - 0.5f);
    float fx = (x - 0.5f) - x0, fy = (y - 0.5f) - y0;
    int32_t ix = (int32_t)x0, iy = (int32_t)y0;
    add_texel(out, at, &l, ix, iy, weight * ((1.0f - fx) * (1.0f - fy)));
    add_texel(out, at, &l, ix + 1, iy, weight * (fx * (1.0f - fy)));
    add_texel(out, at, &l, ix, iy + 1, weight * ((1.0f - fx) * fy));
    add_texel(out, at, &l, ix + 1, iy + 1, weight * (fx * fy));
}

static void sample(float out[4], const lookup *at, float lod)
{
    const lmb_texture *t = at->texture;
    out[0] = out[1] = out[2] = out[3] = 0.0f;
    if (t->filter != LMB_TRILINEAR || t->levels < 2 || !(lod > 0.0f)) {
        sample_level(out, at, 0, 1.0f);
        return;
    }
    lod = minf(lod, (float)(t->levels - 1));
    int32_t n = (int32_t)lod;
    float part = lod - (float)n;
    sample_level(out, at, n, 1.0f - part);
    if (part > 0.0f) {
        sample_level(out, at, n + 1, part);
    }
}

void lmb_texture_sample(float out[4], const lmb_texture *t, float u, float v, float lod)
{
    const lookup at = {t, u, v, AS_COLOUR};
    sample(out, &at, lod);
}

void lmb_normal_map_sample(float out[4], const lmb_texture *t, float u, float v, float lod)
{
    const lookup at = {t, u, v, AS_VECTOR};
    sample(out, &at, lod);
}
