/* texture.c: samples an image at a point: nearest, bilinear, trilinear; repeat, clamp, mirror. Layer 3.
 *
 * Colours are decoded to linear light before they are mixed. glTF: (0, 0) is the first texel's corner. */
#include "texture.h"

#include "../base/codec.h"
#include "../base/vec.h"
#include "texels.h"

/* Meaning of the codes of R G B. Alpha is linear. */
enum { AS_COLOUR, AS_VECTOR };

static float decode(int32_t codes, uint8_t code)
{
    return codes == AS_COLOUR ? lmb_srgb_decode(code) : (float)code * (2.0f / 255.0f) - 1.0f;
}

/* Up to four texels of a level, and their weights. */
typedef struct texel_footprint {
    texel_level from;
    int32_t x, y, count;
    float share[4]; /* upper left, upper right, lower left, lower right; nearest: the first */
} texel_footprint;

static texel_footprint find_texels(const lmb_texture *t, int32_t n, float u, float v, float weight)
{
    texel_footprint f;
    f.from = texel_find_level(t, n);
    const float x = texel_reduce(u, t->wrap_s) * (float)f.from.width,
                y = texel_reduce(v, t->wrap_t) * (float)f.from.height;
    if (t->filter == LMB_NEAREST) {
        f.count = 1;
        f.x = (int32_t)x;
        f.y = (int32_t)y;
        f.share[0] = weight;
        return f;
    }
    const float x0 = texel_floor(x - 0.5f), y0 = texel_floor(y - 0.5f);
    const float fx = (x - 0.5f) - x0, fy = (y - 0.5f) - y0;
    f.count = 4;
    f.x = (int32_t)x0;
    f.y = (int32_t)y0;
    f.share[0] = weight * ((1.0f - fx) * (1.0f - fy));
    f.share[1] = weight * (fx * (1.0f - fy));
    f.share[2] = weight * ((1.0f - fx) * fy);
    f.share[3] = weight * (fx * fy);
    return f;
}

#if LMB_TEXTURE_FORMATS
/* R G B A of a texel in another format. */
static const uint8_t *find_codes(uint8_t out[4], const lmb_texture *t, const uint8_t *texels, size_t at)
{
    if (t->format == LMB_TEXELS_PALETTE4) {
        return t->texels + 4 * (size_t)(texels[at / 2] >> 4 * (at & 1u) & 15u);
    }
    const uint32_t v = ((const uint16_t *)(const void *)texels)[at];
    const uint32_t r = v >> 11, g = v >> 5 & 63u, b = v & 31u;
    out[0] = (uint8_t)(r << 3 | r >> 2);
    out[1] = (uint8_t)(g << 2 | g >> 4);
    out[2] = (uint8_t)(b << 3 | b >> 2);
    out[3] = 255;
    return out;
}
#endif

static void add_texels(float out[4], const lmb_texture *t, const texel_footprint *f, int32_t codes)
{
    for (int k = 0; k < f->count; ++k) {
        const int32_t x = texel_wrap(f->x + (k & 1), f->from.width, t->wrap_s),
                      y = texel_wrap(f->y + (k >> 1), f->from.height, t->wrap_t);
        const size_t at = (size_t)y * (size_t)f->from.width + (size_t)x;
#if LMB_TEXTURE_FORMATS
        uint8_t codes_of[4];
        const uint8_t *p = texels_are_rgba8(t) ? f->from.texels + 4 * at : find_codes(codes_of, t, f->from.texels, at);
#else
        const uint8_t *p = f->from.texels + 4 * at;
#endif
        for (int c = 0; c < 3; ++c) {
            out[c] += f->share[k] * decode(codes, p[c]);
        }
        out[3] += f->share[k] * ((float)p[3] * (1.0f / 255.0f));
    }
}

/* One loop for both levels of a trilinear sample, with all calls inlined: in small builds masked triangles call it at a
 * deep level of the stack. */
static void sample(float out[4], const lmb_texture *t, int32_t codes, float u, float v, float lod)
{
    int32_t n = 0;
    float part = 0.0f;
    if (out == NULL) {
        return;
    }
    out[0] = out[1] = out[2] = out[3] = 0.0f;
    if (t == NULL || t->texels == NULL) {
        return;
    }
    if (t->filter == LMB_TRILINEAR && t->levels > 1 && lod > 0.0f) {
        lod = minf(lod, (float)(t->levels - 1));
        n = (int32_t)lod;
        part = lod - (float)n;
    }
    for (float weight = 1.0f - part;; weight = part, part = 0.0f, ++n) {
        const texel_footprint f = find_texels(t, n, u, v, weight);
        add_texels(out, t, &f, codes);
        if (!(part > 0.0f)) {
            return;
        }
    }
}

void lmb_texture_sample(float out[4], const lmb_texture *t, float u, float v, float lod)
{
    sample(out, t, AS_COLOUR, u, v, lod);
}

#if LMB_TREES
/* The range of texels that samples from low to high read along one axis, plus one on each side for rounding, as inputs
 * of texel_wrap. If the samples cover a whole period, these are all texels. */
static void texels_between(int32_t *first, int32_t *last, float low, float high, int32_t size, int wrap)
{
    const float period = wrap == LMB_WRAP_MIRROR ? 2.0f : 1.0f, at = texel_reduce(low, wrap), wide = high - low;
    const float largest = (float)size * maxf(absf(low), absf(high)); /* beyond 2^20 interpolation is off by texels */
    *first = 0;
    *last = size - 1;
    if (!is_sane(low) || !is_sane(high) || !is_sane(largest)) {
        return;
    }
    if (wrap == LMB_WRAP_CLAMP) {
        *first = (int32_t)(at * (float)size) - 2;
        *last = (int32_t)(texel_reduce(high, wrap) * (float)size) + 2;
    } else if (wide + 4.0f / (float)size < period && at + wide < period) {
        *first = maxi((int32_t)(at * (float)size) - 2, wrap == LMB_WRAP_MIRROR ? -1 : -size);
        *last = (int32_t)((at + wide) * (float)size) + 2;
    }
}

/* Alpha of a texel of level 0, 0 .. 255. */
static int32_t alpha_at(const lmb_texture *t, const texel_level *from, int32_t x, int32_t y)
{
    const size_t at = (size_t)texel_wrap(y, from->height, t->wrap_t) * (size_t)from->width +
                      (size_t)texel_wrap(x, from->width, t->wrap_s);
#if LMB_TEXTURE_FORMATS
    uint8_t codes_of[4];
    return texels_are_rgba8(t) ? from->texels[4 * at + 3] : find_codes(codes_of, t, from->texels, at)[3];
#else
    return from->texels[4 * at + 3];
#endif
}

float lmb_texture_alpha(const lmb_texture *t, float u, float v)
{
    if (texels_are_rgba8(t)) {
        return texels_alpha(t, u, v);
    }
    const texel_footprint f = find_texels(t, 0, u, v, 1.0f);
    float out = 0.0f;
    for (int k = 0; k < f.count; ++k) {
        out += f.share[k] * ((float)alpha_at(t, &f.from, f.x + (k & 1), f.y + (k >> 1)) * (1.0f / 255.0f));
    }
    return out;
}

/* Widens the range of codes of alpha by texels x0 .. x1 of a row. */
static void alphas_between(int32_t *low, int32_t *high, const lmb_texture *t, const texel_level *from, int32_t x0,
                           int32_t x1, int32_t y)
{
    int32_t min = *low, max = *high;
    if (texels_are_rgba8(t) && x0 >= 0 && x1 < from->width) {
        const int32_t row = texel_wrap(y, from->height, t->wrap_t);
        const uint8_t *alpha = from->texels + 4 * ((size_t)row * (size_t)from->width) + 3;
        for (int32_t x = x0; x <= x1; ++x) {
            const int32_t code = alpha[4 * (size_t)x];
            min = mini(min, code);
            max = maxi(max, code);
        }
    } else {
        for (int32_t x = x0; x <= x1; ++x) {
            const int32_t code = alpha_at(t, from, x, y);
            min = mini(min, code);
            max = maxi(max, code);
        }
    }
    *low = min;
    *high = max;
}

int lmb_texture_coverage(const lmb_texture *t, const float low[2], const float high[2], float hole, float solid,
                         uint32_t *texels)
{
    const texel_level from = texel_find_level(t, 0);
    int32_t x0, x1, y0, y1, min = 255, max = 0, all = 0;
    texels_between(&x0, &x1, low[0], high[0], from.width, t->wrap_s);
    texels_between(&y0, &y1, low[1], high[1], from.height, t->wrap_t);
    const uint64_t count = (uint64_t)(uint32_t)maxi(x1 - x0 + 1, 0) * (uint32_t)maxi(y1 - y0 + 1, 0);
    if (count == 0 || count > *texels) {
        return 0;
    }
    for (int32_t y = y0; y <= y1; ++y) {
        *texels -= (uint32_t)(x1 - x0 + 1);
        alphas_between(&min, &max, t, &from, x0, x1, y);
        all = ((float)max * (1.0f / 255.0f) < hole ? LMB_COVERS_NONE : 0) |
              ((float)min * (1.0f / 255.0f) > solid ? LMB_COVERS_ALL : 0);
        if (all == 0) {
            return 0;
        }
    }
    return all;
}
#endif

void lmb_normal_map_sample(float out[4], const lmb_texture *t, float u, float v, float lod)
{
    sample(out, t, AS_VECTOR, u, v, lod);
}
