/* texture.inl: a tile's albedo times the base colour's finest level, nearest or bilinear. Layer 3.
 *
 * Same values as texture.c. */
#include "../base/codec.h"
#include "texels.h"
#include "texture.h"

LANE_INLINE lane texture_floor(lane v)
{
    const lane whole = lane_trunc(v);
    return lane_pick(lane_lt(v, whole), lane_sub(whole, lane_splat(1.0f)), whole);
}

/* Reduces to one period: [0, 1], or [0, 2] if mirrored. */
LANE_INLINE lane texture_reduce(lane u, int32_t wrap)
{
    const lane zero = lane_splat(0.0f), limit = lane_splat(1048576.0f);
    u = lane_keep(mask_and(lane_lt(lane_splat(-1048576.0f), u), lane_lt(u, limit)), u);
    switch (wrap) {
    case LMB_WRAP_CLAMP: return lane_min(lane_max(u, zero), lane_splat(1.0f));
    case LMB_WRAP_MIRROR:
        return lane_sub(u, lane_mul(lane_splat(2.0f), texture_floor(lane_mul(u, lane_splat(0.5f)))));
    default: return lane_sub(u, texture_floor(u));
    }
}

LANE_INLINE lanei texture_wrap(lanei i, lanei size, int32_t wrap)
{
    const lanei zero = lanei_splat(0), one = lanei_splat(1), last = lanei_sub(size, one);
    const lane_mask before = lanei_lt(i, zero), past = lanei_lt(last, i);
    if (wrap == LMB_WRAP_CLAMP) {
        return lanei_min(lanei_max(i, zero), last);
    }
    if (wrap == LMB_WRAP_MIRROR) {
        const lanei twice = lanei_add(size, size);
        i = lanei_pick(before, lanei_sub(lanei_splat(-1), i), i);
        i = lanei_pick(lanei_lt(i, twice), i, lanei_sub(i, twice));
        return lanei_pick(lanei_lt(last, i), lanei_sub(lanei_sub(twice, one), i), i);
    }
    return lanei_pick(before, lanei_add(i, size), lanei_pick(past, lanei_sub(i, size), i));
}

#if defined(LANE_PLAIN) && LANES > 1
#include "texture_plain.inl"
#elif defined(LANE_PLAIN)
/* Without vectors, uses the sampler for single pixels, which exists for holes anyway. Four unrolled lanes are a tenth
 * faster, but take 4.8 KB of stack on a Cortex-M4F. */
static void KERNEL(texture)(lmb_tile *inout, const lmb_resolve_batch *batch, const lmb_texture *t)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        float texel[4];
        if (batch->slot[k] >= 0) {
            lmb_texture_sample(texel, t, inout->uv[0][k], inout->uv[1][k], 0.0f);
            inout->albedo[0][k] *= texel[0];
            inout->albedo[1][k] *= texel[1];
            inout->albedo[2][k] *= texel[2];
        }
    }
}
#else

/* A level and how it wraps. */
typedef struct texture_level {
    const uint8_t *texels;
    lanei width, height;
    int32_t wrap_s, wrap_t;
} texture_level;

enum { TEXTURE_RUN = LMB_TILE_PIXELS / 2 };

/* The texels of a run of pixels, and each pixel's position between them. */
typedef struct texture_found {
    int32_t texel[4][TEXTURE_RUN]; /* upper left, upper right, lower left, lower right; nearest: the first */
    float fx[TEXTURE_RUN], fy[TEXTURE_RUN];
} texture_found;

LANE_INLINE lanei texture_texel(const texture_level *l, lanei x, lanei y)
{
    const lanei row = lanei_mul(texture_wrap(y, l->height, l->wrap_t), l->width);
    return lanei_gather_rgba(l->texels, lanei_add(row, texture_wrap(x, l->width, l->wrap_s)));
}

/* Finds the texels at texel coordinates x, y, for pixels k .. k + LANES - 1. */
LANE_INLINE void texture_find(texture_found *out, int k, const texture_level *l, lane x, lane y)
{
    const lane half = lane_splat(0.5f);
    x = lane_sub(x, half);
    y = lane_sub(y, half);
    const lane x0 = texture_floor(x), y0 = texture_floor(y);
    const lanei one = lanei_splat(1), ix = lane_to_int(x0), iy = lane_to_int(y0), jx = lanei_add(ix, one),
                jy = lanei_add(iy, one);
    lane_store(out->fx + k, lane_sub(x, x0));
    lane_store(out->fy + k, lane_sub(y, y0));
    lanei_store(out->texel[0] + k, texture_texel(l, ix, iy));
    lanei_store(out->texel[1] + k, texture_texel(l, jx, iy));
    lanei_store(out->texel[2] + k, texture_texel(l, ix, jy));
    lanei_store(out->texel[3] + k, texture_texel(l, jx, jy));
}

/* sum + weight * texel. */
LANE_INLINE lane3 texture_add(lane3 sum, const int32_t *code, lane weight)
{
    const lanei texel = lanei_load(code), byte = lanei_splat(255);
    lane3 colour;
    colour.x = lane_gather_f32(lmb_srgb_linear, lanei_and(texel, byte));
    colour.y = lane_gather_f32(lmb_srgb_linear, lanei_and(lanei_shift(texel, 8), byte));
    colour.z = lane_gather_f32(lmb_srgb_linear, lanei_and(lanei_shift(texel, 16), byte));
    return lane3_add(sum, lane3_scale(colour, weight));
}

LANE_INLINE lane3 texture_bilinear(const texture_found *f, int k)
{
    const lane one = lane_splat(1.0f), fx = lane_load(f->fx + k), fy = lane_load(f->fy + k);
    const lane gx = lane_sub(one, fx), gy = lane_sub(one, fy);
    lane3 sum = lane3_splat(0.0f, 0.0f, 0.0f);
    sum = texture_add(sum, f->texel[0] + k, lane_mul(gx, gy));
    sum = texture_add(sum, f->texel[1] + k, lane_mul(fx, gy));
    sum = texture_add(sum, f->texel[2] + k, lane_mul(gx, fy));
    return texture_add(sum, f->texel[3] + k, lane_mul(fx, fy));
}

LANE_INLINE void texture_multiply(float (*albedo)[LMB_TILE_PIXELS], int k, lane_mask mine, lane3 texel)
{
    const lane x = lane_load(albedo[0] + k), y = lane_load(albedo[1] + k), z = lane_load(albedo[2] + k);
    lane_store(albedo[0] + k, lane_pick(mine, lane_mul(x, texel.x), x));
    lane_store(albedo[1] + k, lane_pick(mine, lane_mul(y, texel.y), y));
    lane_store(albedo[2] + k, lane_pick(mine, lane_mul(z, texel.z), z));
}

/* Pixels first .. first + TEXTURE_RUN - 1. All texels are loaded before any is decoded: one wait for cache misses
 * instead of one per vector. */
NOINLINE void texture_run(lmb_tile *inout, const lmb_resolve_batch *batch, const lmb_texture *t, int first)
{
    const lane width = lane_splat((float)t->width), height = lane_splat((float)t->height), one = lane_splat(1.0f);
    const lane3 none = lane3_splat(0.0f, 0.0f, 0.0f);
    const texture_level l = {t->texels, lanei_splat(t->width), lanei_splat(t->height), t->wrap_s, t->wrap_t};
    const int nearest = t->filter == LMB_NEAREST;
    texture_found found;
    for (int i = 0; i < TEXTURE_RUN; i += LANES) {
        const int k = first + i;
        const lane_mask mine = lanei_not_negative(lanei_load(batch->slot + k));
        if (mask_bits(mine) != 0) {
            const lane x = lane_mul(texture_reduce(lane_load(inout->uv[0] + k), l.wrap_s), width);
            const lane y = lane_mul(texture_reduce(lane_load(inout->uv[1] + k), l.wrap_t), height);
            if (nearest) {
                lanei_store(found.texel[0] + i, texture_texel(&l, lane_to_int(x), lane_to_int(y)));
            } else {
                texture_find(&found, i, &l, x, y);
            }
        }
    }
    for (int i = 0; i < TEXTURE_RUN; i += LANES) {
        const int k = first + i;
        const lane_mask mine = lanei_not_negative(lanei_load(batch->slot + k));
        if (mask_bits(mine) != 0) {
            const lane3 texel = nearest ? texture_add(none, found.texel[0] + i, one) : texture_bilinear(&found, i);
            texture_multiply(inout->albedo, k, mine, texel);
        }
    }
}

static void KERNEL(texture)(lmb_tile *inout, const lmb_resolve_batch *batch, const lmb_texture *t)
{
    for (int first = 0; first < LMB_TILE_PIXELS; first += TEXTURE_RUN) {
        texture_run(inout, batch, t, first);
    }
}
#endif
