/* texture.inl: a base colour's finest level times the albedo of a tile's pixels, nearest or bilinear: as texture.c, value
 * by value. */
#include "../base/codec.h"
#include "texture.h"

#if defined(LANE_PLAIN)
/* Without vectors, the sampler that takes one pixel at a time: it is there anyway, for holes. Four lanes written out are
 * a tenth faster, and 4.8 KB of stack on a Cortex-M4F. */
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

/* A level and how its edges go on. */
typedef struct texture_level {
    const uint8_t *texels;
    lanei width, height;
    int32_t wrap_s, wrap_t;
} texture_level;

LANE_INLINE lane texture_floor(lane v)
{
    const lane whole = lane_trunc(v);
    return lane_pick(lane_lt(v, whole), lane_sub(whole, lane_splat(1.0f)), whole);
}

/* Into one period: [0, 1], or [0, 2] for mirrored ones. */
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

/* sum + weight * texel. */
LANE_INLINE lane3 texture_add(lane3 sum, const texture_level *l, lanei x, lanei y, lane weight)
{
    const lanei byte = lanei_splat(255);
    const lanei at =
        lanei_add(lanei_mul(texture_wrap(y, l->height, l->wrap_t), l->width), texture_wrap(x, l->width, l->wrap_s));
    const lanei texel = lanei_gather_rgba(l->texels, at);
    lane3 colour;
    colour.x = lane_gather_f32(lmb_srgb_linear, lanei_and(texel, byte));
    colour.y = lane_gather_f32(lmb_srgb_linear, lanei_and(lanei_shift(texel, 8), byte));
    colour.z = lane_gather_f32(lmb_srgb_linear, lanei_and(lanei_shift(texel, 16), byte));
    return lane3_add(sum, lane3_scale(colour, weight));
}

LANE_INLINE lane3 texture_bilinear(const texture_level *l, lane x, lane y)
{
    const lane half = lane_splat(0.5f), one = lane_splat(1.0f);
    x = lane_sub(x, half);
    y = lane_sub(y, half);
    const lane x0 = texture_floor(x), y0 = texture_floor(y), fx = lane_sub(x, x0), fy = lane_sub(y, y0);
    const lane gx = lane_sub(one, fx), gy = lane_sub(one, fy);
    const lanei ix = lane_to_int(x0), iy = lane_to_int(y0), jx = lanei_add(ix, lanei_splat(1)),
                jy = lanei_add(iy, lanei_splat(1));
    lane3 sum = lane3_splat(0.0f, 0.0f, 0.0f);
    sum = texture_add(sum, l, ix, iy, lane_mul(gx, gy));
    sum = texture_add(sum, l, jx, iy, lane_mul(fx, gy));
    sum = texture_add(sum, l, ix, jy, lane_mul(gx, fy));
    return texture_add(sum, l, jx, jy, lane_mul(fx, fy));
}

static void KERNEL(texture)(lmb_tile *inout, const lmb_resolve_batch *batch, const lmb_texture *t)
{
    const lane width = lane_splat((float)t->width), height = lane_splat((float)t->height);
    texture_level l;
    l.texels = t->texels;
    l.width = lanei_splat(t->width);
    l.height = lanei_splat(t->height);
    l.wrap_s = t->wrap_s;
    l.wrap_t = t->wrap_t;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lane_mask mine = lanei_not_negative(lanei_load(batch->slot + k));
        if (mask_bits(mine) == 0) {
            continue;
        }
        const lane x = lane_mul(texture_reduce(lane_load(inout->uv[0] + k), l.wrap_s), width);
        const lane y = lane_mul(texture_reduce(lane_load(inout->uv[1] + k), l.wrap_t), height);
        const lane3 none = lane3_splat(0.0f, 0.0f, 0.0f);
        const lane3 texel = t->filter == LMB_NEAREST
                                ? texture_add(none, &l, lane_to_int(x), lane_to_int(y), lane_splat(1.0f))
                                : texture_bilinear(&l, x, y);
        resolve_put(inout->albedo[0] + k, mine, lane_mul(lane_load(inout->albedo[0] + k), texel.x));
        resolve_put(inout->albedo[1] + k, mine, lane_mul(lane_load(inout->albedo[1] + k), texel.y));
        resolve_put(inout->albedo[2] + k, mine, lane_mul(lane_load(inout->albedo[2] + k), texel.z));
    }
}
#endif
