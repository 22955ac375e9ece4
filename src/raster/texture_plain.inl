/* texture_plain.inl: the same in plain C of four lanes: loops over pixels that compilers turn into vectors. Layer 3. */

enum { PLAIN_RUN = LMB_TILE_PIXELS / 2 };

/* Along one axis, for a run of pixels: the first texel, the next one, and the position between them. */
typedef struct plain_axis {
    int32_t first[PLAIN_RUN], next[PLAIN_RUN];
    float between[PLAIN_RUN];
} plain_axis;

LANE_INLINE float plain_sane(float u, float none) { return ((u > -1048576.0f) & (u < 1048576.0f)) ? u : none; }

/* As texel_floor, without a branch. */
LANE_INLINE float plain_whole(float v)
{
    const int32_t whole = (int32_t)v;
    return (float)(whole - (v < (float)whole));
}

/* As texel_reduce. Limits that are constants would become branches. */
LANE_INLINE float plain_reduce(float u, int wrap, float zero, float one)
{
    if (wrap == LMB_WRAP_CLAMP) {
        return minf(maxf(u, zero), one);
    }
    return wrap == LMB_WRAP_MIRROR ? u - 2.0f * plain_whole(u * 0.5f) : u - plain_whole(u);
}

/* As texel_wrap, without branches where textures repeat. */
LANE_INLINE int32_t plain_wrap(int32_t i, int32_t size, int wrap)
{
    if (wrap == LMB_WRAP_REPEAT) {
        i += size & -(int32_t)(i < 0);
        return i - (size & -(int32_t)(i >= size));
    }
    return texel_wrap(i, size, wrap);
}

/* Texels of a run along an axis with `size` texels. */
LANE_INLINE void plain_find(plain_axis *PLAIN_ALONE out, const float *PLAIN_ALONE u, int32_t size, int wrap,
                            int nearest, float zero, float one)
{
    float sane[PLAIN_RUN]; /* in an array: a conversion after a choice would become a branch */
    for (int k = 0; k < PLAIN_RUN; ++k) {
        sane[k] = plain_sane(u[k], zero);
    }
    for (int k = 0; k < PLAIN_RUN; ++k) {
        const float x = plain_reduce(sane[k], wrap, zero, one) * (float)size;
        if (nearest) {
            out->first[k] = plain_wrap((int32_t)x, size, wrap);
        } else {
            const float low = x - 0.5f, whole = plain_whole(low);
            out->between[k] = low - whole;
            out->first[k] = plain_wrap((int32_t)whole, size, wrap);
            out->next[k] = plain_wrap((int32_t)whole + 1, size, wrap);
        }
    }
}

NOINLINE void plain_find_axis(plain_axis *out, const float *u, int32_t size, int wrap, int nearest,
                              const float limit[2])
{
    if (wrap == LMB_WRAP_REPEAT && nearest) {
        plain_find(out, u, size, LMB_WRAP_REPEAT, 1, limit[0], limit[1]);
    } else if (wrap == LMB_WRAP_REPEAT) {
        plain_find(out, u, size, LMB_WRAP_REPEAT, 0, limit[0], limit[1]);
    } else if (wrap == LMB_WRAP_CLAMP) {
        plain_find(out, u, size, LMB_WRAP_CLAMP, nearest, limit[0], limit[1]);
    } else {
        plain_find(out, u, size, LMB_WRAP_MIRROR, nearest, limit[0], limit[1]);
    }
}

LANE_INLINE float plain_mixed(const uint8_t *const texel[4], const float share[4], int c)
{
    return share[0] * lmb_srgb_linear[texel[0][c]] + share[1] * lmb_srgb_linear[texel[1][c]] +
           share[2] * lmb_srgb_linear[texel[2][c]] + share[3] * lmb_srgb_linear[texel[3][c]];
}

/* Pixels from `first` on. */
NOINLINE void plain_texture_run(lmb_tile *inout, const lmb_resolve_batch *batch, const lmb_texture *t, int first)
{
    float limit[2];
    const int nearest = t->filter == LMB_NEAREST;
    const int32_t *slot = batch->slot + first;
    float *red = inout->albedo[0] + first, *green = inout->albedo[1] + first, *blue = inout->albedo[2] + first;
    plain_axis x, y;
    limit[0] = 0.0f, limit[1] = 1.0f;
    plain_find_axis(&x, inout->uv[0] + first, t->width, t->wrap_s, nearest, limit);
    plain_find_axis(&y, inout->uv[1] + first, t->height, t->wrap_t, nearest, limit);
    for (int k = 0; k < PLAIN_RUN; ++k) {
        if (slot[k] < 0) {
            continue;
        }
        const uint8_t *upper = t->texels + 4 * (size_t)y.first[k] * (size_t)t->width,
                      *at = upper + 4 * (size_t)x.first[k];
        if (nearest) {
            red[k] *= lmb_srgb_linear[at[0]];
            green[k] *= lmb_srgb_linear[at[1]];
            blue[k] *= lmb_srgb_linear[at[2]];
        } else {
            const uint8_t *lower = t->texels + 4 * (size_t)y.next[k] * (size_t)t->width;
            const uint8_t *texel[4] = {at, upper + 4 * (size_t)x.next[k], lower + 4 * (size_t)x.first[k],
                                       lower + 4 * (size_t)x.next[k]};
            const float fx = x.between[k], fy = y.between[k], gx = 1.0f - fx, gy = 1.0f - fy;
            const float share[4] = {gx * gy, fx * gy, gx * fy, fx * fy};
            red[k] *= plain_mixed(texel, share, 0);
            green[k] *= plain_mixed(texel, share, 1);
            blue[k] *= plain_mixed(texel, share, 2);
        }
    }
}

static void KERNEL(texture)(lmb_tile *inout, const lmb_resolve_batch *batch, const lmb_texture *t)
{
    for (int first = 0; first < LMB_TILE_PIXELS; first += PLAIN_RUN) {
        plain_texture_run(inout, batch, t, first);
    }
}
