/* gl_wide.inl: gl_wide.h by one back end's verbs. The including file defines WIDE_NAME. */
#include "../../src/lane/lane.h"

/* --- numbers ------------------------------------------------------------------------------------------------------ */

/* gl_unit_range */
LANE_INLINE lane wide_range(lane v) { return lane_hold(v, lane_splat(0.0f), lane_splat(1.0f)); }

LANE_INLINE lane wide_mix(const gl_wide_value *v, lane share1, lane share2)
{
    const lane more = lane_add(lane_mul(share1, lane_splat(v->more1)), lane_mul(share2, lane_splat(v->more2)));
    return lane_add(lane_splat(v->at), more);
}

/* --- texels ------------------------------------------------------------------------------------------------------- */

/* fragment_place */
LANE_INLINE lane wide_place(lane s, int32_t size, GLenum wrap)
{
    const lane n = lane_splat((float)size), half = lane_splat(0.5f), limit = lane_splat(1e9f);
    s = lane_keep(mask_and(lane_lt(lane_splat(-1e9f), s), lane_lt(s, limit)), s);
    switch (wrap) {
    case GL_CLAMP: return lane_mul(wide_range(s), n);
    case GL_CLAMP_TO_EDGE: return lane_hold(lane_mul(s, n), half, lane_sub(n, half));
    case GL_CLAMP_TO_BORDER: return lane_hold(lane_mul(s, n), lane_splat(-0.5f), lane_add(n, half));
    case GL_MIRRORED_REPEAT: {
        const lane h = lane_mul(s, half), f = lane_mul(lane_splat(2.0f), lane_sub(h, lane_floor(h)));
        const lane folded = lane_pick(lane_lt(lane_splat(1.0f), f), lane_sub(lane_splat(2.0f), f), f);
        return lane_hold(lane_mul(folded, n), half, lane_sub(n, half));
    }
    default: return lane_mul(lane_sub(s, lane_floor(s)), n);
    }
}

/* The texels along one side: the first one, the second one, and the second one's share. Both lie inside the texture;
 * out: those that lie outside before they are moved. */
typedef struct wide_side {
    lanei first, second;
    lane share;
    lane_mask first_out, second_out;
} wide_side;

LANE_INLINE int wide_has_border(GLenum wrap) { return wrap == GL_CLAMP || wrap == GL_CLAMP_TO_BORDER; }

LANE_INLINE lane_mask wide_is_out(lanei i, int32_t size)
{
    return mask_or(lanei_lt(i, lanei_splat(0)), lanei_lt(lanei_splat(size - 1), i));
}

LANE_INLINE lanei wide_inside(lanei i, int32_t size)
{
    return lanei_min(lanei_max(i, lanei_splat(0)), lanei_splat(size - 1));
}

LANE_INLINE wide_side wide_linear_side(lane s, int32_t size, GLenum wrap)
{
    const lane x = lane_sub(wide_place(s, size, wrap), lane_splat(0.5f)), low = lane_floor(x);
    const lanei n = lanei_splat(size);
    wide_side r;
    r.first = lane_to_int(low);
    r.second = lanei_add(r.first, lanei_splat(1));
    r.share = lane_sub(x, low);
    if (wide_has_border(wrap)) {
        r.first_out = wide_is_out(r.first, size);
        r.second_out = wide_is_out(r.second, size);
    } else {
        r.first_out = r.second_out = mask_of_bits(0);
    }
    if (wrap == GL_REPEAT && (size & (size - 1)) == 0) {
        r.first = lanei_and(r.first, lanei_splat(size - 1));
        r.second = lanei_and(r.second, lanei_splat(size - 1));
    } else if (wrap == GL_REPEAT) {
        r.first = lanei_pick(lanei_lt(r.first, lanei_splat(0)), lanei_add(r.first, n), r.first);
        r.second = lanei_pick(lanei_lt(r.second, n), r.second, lanei_sub(r.second, n));
    } else {
        r.first = wide_inside(r.first, size);
        r.second = wide_inside(r.second, size); /* a share of 0 may belong to a texel past the end */
    }
    return r;
}

/* Channel n of texels, 0 .. 1. */
LANE_INLINE lane wide_channel(lanei code, int n)
{
    const lanei byte = lanei_and(n == 0 ? code : lanei_shift(code, 8 * n), lanei_splat(255));
    return lane_mul(lane_from_int(byte), lane_splat(1.0f / 255.0f));
}

LANE_INLINE lane wide_sum(const lane weight[4], const lanei code[4], int n)
{
    lane sum = lane_mul(weight[0], wide_channel(code[0], n));
    for (int k = 1; k < 4; ++k) {
        sum = lane_add(sum, lane_mul(weight[k], wide_channel(code[k], n)));
    }
    return sum;
}

/* The border's colour, as a base format keeps it. */
static float wide_border(const gl_texture *t, GLenum base, int n)
{
    const int is_grey = base == GL_LUMINANCE || base == GL_LUMINANCE_ALPHA || base == GL_INTENSITY;
    if (n < 3) {
        return t->border[is_grey ? 0 : n];
    }
    return base == GL_INTENSITY ? t->border[0] : base == GL_LUMINANCE || base == GL_RGB ? 1.0f : t->border[3];
}

/* fragment_level. channels: 3 or 4, those that count. */
LANE_NOINLINE void wide_level(lane out[4], const gl_texture *t, const gl_image *m, lane s, lane r, int linear,
                                    int channels)
{
    const int32_t w = m->width, h = m->height;
    const lanei wide = lanei_splat(w);
    const GLenum wrap_s = t->wrap[0], wrap_t = t->wrap[1];
    if (!linear) {
        lanei x = lane_to_int(lane_floor(wide_place(s, w, wrap_s))),
              y = lane_to_int(lane_floor(wide_place(r, h, wrap_t)));
        const lane_mask outside = mask_or(wrap_s == GL_CLAMP_TO_BORDER ? wide_is_out(x, w) : mask_of_bits(0),
                                          wrap_t == GL_CLAMP_TO_BORDER ? wide_is_out(y, h) : mask_of_bits(0));
        x = wide_inside(x, w);
        y = wide_inside(y, h);
        const lanei code = lanei_gather_rgba(m->texels, lanei_add(lanei_mul(y, wide), x));
        for (int n = 0; n < 4; ++n) {
            out[n] = wide_channel(code, n);
        }
        if ((mask_bits(outside) & ALL_LANES) != 0) {
            for (int n = 0; n < 4; ++n) {
                out[n] = lane_pick(outside, lane_splat(wide_border(t, m->base, n)), out[n]);
            }
        }
        return;
    }
    const wide_side x = wide_linear_side(s, w, wrap_s), y = wide_linear_side(r, h, wrap_t);
    const lanei upper = lanei_mul(y.first, wide), lower = lanei_mul(y.second, wide);
    const lanei code[4] = {lanei_gather_rgba(m->texels, lanei_add(upper, x.first)),
                           lanei_gather_rgba(m->texels, lanei_add(upper, x.second)),
                           lanei_gather_rgba(m->texels, lanei_add(lower, x.first)),
                           lanei_gather_rgba(m->texels, lanei_add(lower, x.second))};
    const lane one = lane_splat(1.0f), left = lane_sub(one, x.share), above = lane_sub(one, y.share);
    const lane weight[4] = {lane_mul(left, above), lane_mul(x.share, above), lane_mul(left, y.share),
                            lane_mul(x.share, y.share)};
    if (!wide_has_border(wrap_s) && !wide_has_border(wrap_t)) {
        out[0] = wide_sum(weight, code, 0);
        out[1] = wide_sum(weight, code, 1);
        out[2] = wide_sum(weight, code, 2);
        out[3] = channels > 3 ? wide_sum(weight, code, 3) : lane_splat(1.0f);
        return;
    }
    const lane_mask outside[4] = {
        mask_or(x.first_out, y.first_out), mask_or(x.second_out, y.first_out), mask_or(x.first_out, y.second_out),
        mask_or(x.second_out, y.second_out)};
    for (int n = 0; n < 4; ++n) {
        const lane border = lane_splat(wide_border(t, m->base, n));
        out[n] = lane_splat(0.0f);
        for (int k = 0; k < 4; ++k) {
            const lane v = lane_pick(outside[k], border, wide_channel(code[k], n));
            out[n] = lane_add(out[n], lane_mul(weight[k], v));
        }
    }
}

/* --- levels ------------------------------------------------------------------------------------------------------- */

/* Coordinates of a unit at the pixels, or one pixel further. */
typedef struct wide_coords {
    lane s, t;
} wide_coords;

LANE_INLINE wide_coords wide_project(lane s, lane t, lane q, int divides)
{
    wide_coords r = {s, t};
    if (divides) {
        const lane zero = lane_splat(0.0f);
        const lane_mask is_zero = mask_and(lane_le(q, zero), lane_le(zero, q));
        const lane by = lane_pick(is_zero, zero, lane_div(lane_splat(1.0f), q));
        r.s = lane_mul(s, by);
        r.t = lane_mul(t, by);
    }
    return r;
}

LANE_INLINE lane wide_further(lane at, const gl_wide_value *v, lane by1, lane by2)
{
    return lane_add(at, lane_add(lane_mul(by1, lane_splat(v->more1)), lane_mul(by2, lane_splat(v->more2))));
}

/* fragment_texels */
LANE_INLINE lane wide_texels(const gl_image *m, const wide_coords *a, const wide_coords *b)
{
    const lane x = lane_mul(lane_sub(b->s, a->s), lane_splat((float)m->width)),
               y = lane_mul(lane_sub(b->t, a->t), lane_splat((float)m->height));
    return m->height > 1 ? lane_add(lane_mul(x, x), lane_mul(y, y)) : lane_mul(x, x);
}

/* The last level that completeness requires. */
static int32_t wide_last(const gl_texture *t)
{
    const gl_image *base = &t->image[0][t->base_level];
    int32_t last = t->base_level;
    for (int32_t n = maxi(base->width, base->height); n > 1; n /= 2) {
        ++last;
    }
    return mini(mini(last, t->max_level), GL_LEVELS - 1);
}

/* Samples minified pixels `bits` between two levels, or in the nearest one. */
LANE_NOINLINE void wide_minified(lane out[4], const gl_texture *t, const wide_coords *at, lane lambda,
                                       uint32_t bits, int channels)
{
    const GLenum f = t->min_filter;
    const int linear = f == GL_LINEAR_MIPMAP_NEAREST || f == GL_LINEAR_MIPMAP_LINEAR;
    const int is_nearest = f == GL_NEAREST_MIPMAP_NEAREST || f == GL_LINEAR_MIPMAP_NEAREST;
    const int32_t last = wide_last(t), deepest = last - t->base_level;
    const gl_image *image = &t->image[0][t->base_level];
    int32_t level[LANES];
    lambda = lane_hold(lambda, lane_splat(0.0f), lane_splat((float)deepest));
    lanei n = lane_to_int(lambda);
    const lane share = lane_sub(lambda, lane_from_int(n));
    if (is_nearest) {
        const lanei rounded = lanei_min(lane_to_int(lane_add(lambda, lane_splat(0.49999997f))), lanei_splat(deepest));
        n = lanei_pick(lane_le(lambda, lane_splat(0.5f)), lanei_splat(0), rounded);
    }
    lanei_store(level, n);
    while (bits != 0) {
        const int32_t of = level[lowest_bit(bits)];
        const lane_mask mine = lanei_equal(n, lanei_splat(of));
        lane v[4];
        bits &= ~mask_bits(mine);
        wide_level(v, t, &image[of], at->s, at->t, linear, channels);
        if (!is_nearest && of < deepest) {
            lane more[4];
            wide_level(more, t, &image[of + 1], at->s, at->t, linear, channels);
            for (int i = 0; i < 4; ++i) {
                v[i] = lane_add(v[i], lane_mul(share, lane_sub(more[i], v[i])));
            }
        }
        for (int i = 0; i < 4; ++i) {
            out[i] = lane_pick(mine, v[i], out[i]);
        }
    }
}

/* fragment_sample. k: the first of the pixels; bits: those that count. */
LANE_NOINLINE void wide_sample(lane out[4], const gl_wide_job *j, const gl_wide_unit *u, int k, uint32_t bits,
                                     int channels)
{
    const gl_texture *t = u->texture;
    const gl_image *base = &t->image[0][t->base_level];
    const lane share1 = lane_load(&j->share[0][k]), share2 = lane_load(&j->share[1][k]);
    const lane s = wide_mix(&u->s, share1, share2), r = wide_mix(&u->t, share1, share2),
               q = wide_mix(&u->q, share1, share2);
    const wide_coords at = wide_project(s, r, q, u->divides);
    if (!u->has_levels) {
        wide_level(out, t, base, at.s, at.t, t->min_filter == GL_LINEAR, channels);
        return;
    }
    lane square[2];
    for (int i = 0; i < 2; ++i) {
        const lane by1 = lane_load(i == 0 ? &j->by_x[0][k] : &j->by_y[0][k]),
                   by2 = lane_load(i == 0 ? &j->by_x[1][k] : &j->by_y[1][k]);
        const wide_coords next = wide_project(wide_further(s, &u->s, by1, by2), wide_further(r, &u->t, by1, by2),
                                              wide_further(q, &u->q, by1, by2), u->divides);
        square[i] = wide_texels(base, &at, &next);
    }
    const GLenum f = t->min_filter;
    const int mips = f != GL_NEAREST && f != GL_LINEAR;
    const int is_late = t->mag_filter == GL_LINEAR && (f == GL_NEAREST_MIPMAP_NEAREST || f == GL_NEAREST_MIPMAP_LINEAR);
    lane lambda = lane_mul(lane_splat(0.5f), lane_log2(lane_max(square[0], square[1])));
    lambda = lane_add(lambda, lane_splat(u->bias));
    lambda = lane_min(lane_max(lambda, lane_splat(t->min_lod)), lane_splat(t->max_lod));
    const lane_mask magnified = lane_le(lambda, lane_splat(is_late ? 0.5f : 0.0f));
    const uint32_t few = mask_bits(magnified) & bits;
    if (few != bits) {
        for (int i = 0; i < 4; ++i) {
            out[i] = lane_splat(0.0f);
        }
        if (mips) {
            wide_minified(out, t, &at, lambda, bits & ~few, channels);
        } else {
            wide_level(out, t, base, at.s, at.t, f == GL_LINEAR, channels);
        }
    }
    if (few != 0) {
        lane v[4];
        wide_level(v, t, base, at.s, at.t, t->mag_filter == GL_LINEAR, channels);
        for (int i = 0; i < 4; ++i) {
            out[i] = few == bits ? v[i] : lane_pick(magnified, v[i], out[i]);
        }
    }
}

/* --- colours ------------------------------------------------------------------------------------------------------ */

LANE_INLINE int wide_has_alpha(GLenum base)
{
    return base == GL_ALPHA || base == GL_LUMINANCE_ALPHA || base == GL_RGBA || base == GL_INTENSITY;
}

/* Applies a unit with texels t: fragment_classic. */
LANE_INLINE void wide_apply(lane c[4], const gl_wide_unit *u, const lane t[4])
{
    const GLenum base = u->base, mode = u->unit->mode;
    const int colours = base != GL_ALPHA, alphas = wide_has_alpha(base);
    const lane one = lane_splat(1.0f);
    for (int i = 0; i < 3 && colours; ++i) {
        switch (mode) {
        case GL_REPLACE: c[i] = t[i]; break;
        case GL_DECAL:
            if (base == GL_RGBA) {
                c[i] = lane_add(lane_mul(c[i], lane_sub(one, t[3])), lane_mul(t[i], t[3]));
            } else if (base == GL_RGB) {
                c[i] = t[i];
            }
            break;
        case GL_BLEND:
            c[i] = lane_add(lane_mul(c[i], lane_sub(one, t[i])), lane_mul(lane_splat(u->unit->colour[i]), t[i]));
            break;
        case GL_ADD: c[i] = lane_min(lane_add(c[i], t[i]), one); break;
        default: c[i] = lane_mul(c[i], t[i]); break;
        }
    }
    if (!alphas || mode == GL_DECAL) {
        return;
    }
    if (mode == GL_REPLACE) {
        c[3] = t[3];
    } else if (base == GL_INTENSITY && mode == GL_BLEND) {
        c[3] = lane_add(lane_mul(c[3], lane_sub(one, t[3])), lane_mul(lane_splat(u->unit->colour[3]), t[3]));
    } else if (base == GL_INTENSITY && mode == GL_ADD) {
        c[3] = lane_min(lane_add(c[3], t[3]), one);
    } else {
        c[3] = lane_mul(c[3], t[3]);
    }
}

/* Channel i of argument n of a unit with GL_COMBINE, for colours or for alpha. */
LANE_INLINE lane wide_argument(const lane c[4], const gl_wide_unit *u, const lane primary[4],
                               const lane texels[GL_UNITS][4], int half, int n, int i)
{
    const GLenum from = u->unit->source[half][n], how = u->unit->operand[half][n];
    const int at = how == GL_SRC_ALPHA || how == GL_ONE_MINUS_SRC_ALPHA ? 3 : i;
    const lane v = from == GL_TEXTURE                                            ? texels[u->number][at]
                   : from >= GL_TEXTURE0 && from < GL_TEXTURE0 + GL_UNITS ? texels[from - GL_TEXTURE0][at]
                   : from == GL_CONSTANT                                       ? lane_splat(u->unit->colour[at])
                   : from == GL_PRIMARY_COLOR                                  ? primary[at]
                                                                               : c[at];
    return how == GL_ONE_MINUS_SRC_COLOR || how == GL_ONE_MINUS_SRC_ALPHA ? lane_sub(lane_splat(1.0f), v) : v;
}

/* fragment_combine */
LANE_NOINLINE void wide_combine(lane c[4], const gl_wide_unit *u, const lane primary[4],
                                const lane texels[GL_UNITS][4])
{
    const gl_unit *unit = u->unit;
    const lane one = lane_splat(1.0f), half_one = lane_splat(0.5f);
    lane out[4], dot = lane_splat(0.0f);
    for (int i = 0; i < 3 && (unit->combine[0] == GL_DOT3_RGB || unit->combine[0] == GL_DOT3_RGBA); ++i) {
        const lane a = wide_argument(c, u, primary, texels, 0, 0, i), b = wide_argument(c, u, primary, texels, 0, 1, i);
        const lane product = lane_mul(lane_sub(a, half_one), lane_sub(b, half_one));
        dot = i == 0 ? product : lane_add(dot, product);
    }
    dot = lane_mul(lane_splat(4.0f), dot);
    for (int i = 0; i < 4; ++i) {
        const int half = i == 3;
        const lane a = wide_argument(c, u, primary, texels, half, 0, i);
        lane v = a, b = a;
        if (unit->combine[half] != GL_REPLACE) {
            b = wide_argument(c, u, primary, texels, half, 1, i);
        }
        switch (unit->combine[half]) {
        case GL_REPLACE: break;
        case GL_ADD: v = lane_add(a, b); break;
        case GL_ADD_SIGNED: v = lane_sub(lane_add(a, b), half_one); break;
        case GL_INTERPOLATE: {
            const lane d = wide_argument(c, u, primary, texels, half, 2, i);
            v = lane_add(lane_mul(a, d), lane_mul(b, lane_sub(one, d)));
            break;
        }
        case GL_SUBTRACT: v = lane_sub(a, b); break;
        case GL_DOT3_RGB: case GL_DOT3_RGBA: v = dot; break;
        default: v = lane_mul(a, b); break;
        }
        out[i] = unit->combine[0] == GL_DOT3_RGBA && half ? wide_range(lane_mul(dot, lane_splat(unit->scale[0])))
                                                           : wide_range(lane_mul(v, lane_splat(unit->scale[half])));
    }
    for (int i = 0; i < 4; ++i) {
        c[i] = out[i];
    }
}

/* fragment_texture if a unit combines: it may read the texels of any. */
LANE_NOINLINE void wide_combine_all(lane c[4], const gl_wide_job *j, int k, uint32_t bits)
{
    lane texels[GL_UNITS][4], primary[4];
    for (int n = 0; n < 4; ++n) {
        primary[n] = c[n];
        for (int i = 0; i < GL_UNITS; ++i) {
            texels[i][n] = lane_splat(n == 3 ? 1.0f : 0.0f);
        }
    }
    for (int i = 0; i < j->units; ++i) {
        lane *t = texels[j->unit[i].number];
        wide_sample(t, j, &j->unit[i], k, bits, 4);
        for (int n = 0; n < 3 && j->unit[i].base == GL_ALPHA; ++n) {
            t[n] = lane_splat(0.0f);
        }
    }
    for (int i = 0; i < j->units; ++i) {
        if (j->unit[i].unit->mode == GL_COMBINE) {
            wide_combine(c, &j->unit[i], primary, (const lane(*)[4])texels);
        } else {
            wide_apply(c, &j->unit[i], texels[j->unit[i].number]);
        }
    }
}

/* The share that fog leaves: fragment_fog. */
LANE_INLINE lane wide_fog(lane z, const gl_context *c)
{
    const float start = c->s.fog.start, end = c->s.fog.end;
    const lane thick = lane_mul(lane_splat(c->s.fog.density), z), back = lane_mul(lane_splat(-c->s.fog.density), z),
               log2_e = lane_splat(1.44269504f);
    lane v;
    if (c->s.fog.mode == GL_LINEAR && end == start) {
        v = lane_pick(lane_lt(z, lane_splat(end)), lane_splat(1.0f), lane_splat(0.0f));
    } else if (c->s.fog.mode == GL_LINEAR) {
        v = lane_div(lane_sub(lane_splat(end), z), lane_splat(end - start));
    } else if (c->s.fog.mode == GL_EXP) {
        v = lane_exp2(lane_mul(back, log2_e));
    } else {
        v = lane_exp2(lane_mul(lane_mul(back, thick), log2_e));
    }
    return wide_range(v);
}

LANE_INLINE void wide_store(uint8_t (*out)[4], lanei codes)
{
    int32_t code[LANES];
    lanei_store(code, codes);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    memcpy(out, code, sizeof code);
#else
    for (int i = 0; i < LANES; ++i) {
        for (int n = 0; n < 4; ++n) {
            out[i][n] = (uint8_t)((uint32_t)code[i] >> 8 * n);
        }
    }
#endif
}

LANE_INLINE lanei wide_pixels(const gl_wide_job *j, int k, uint32_t bits)
{
    const gl_context *context = j->context;
    const lane share1 = lane_load(&j->share[0][k]), share2 = lane_load(&j->share[1][k]);
    lane c[4];
    for (int n = 0; n < 4; ++n) {
        c[n] = wide_mix(&j->colour[n], share1, share2);
    }
    if (j->combines) {
        wide_combine_all(c, j, k, bits);
    }
    for (int i = 0; i < j->units && !j->combines; ++i) {
        lane t[4];
        wide_sample(t, j, &j->unit[i], k, bits, wide_has_alpha(j->unit[i].base) ? 4 : 3);
        wide_apply(c, &j->unit[i], t);
    }
    for (int n = 0; n < 3; ++n) {
        if (j->adds) {
            c[n] = lane_add(c[n], wide_mix(&j->second[n], share1, share2));
        }
        c[n] = wide_range(c[n]);
    }
    if (j->fogs) {
        const lane left = wide_fog(wide_mix(&j->fog, share1, share2), context),
                   rest = lane_sub(lane_splat(1.0f), left);
        for (int n = 0; n < 3; ++n) {
            c[n] = lane_add(lane_mul(left, c[n]), lane_mul(rest, lane_splat(context->s.fog.colour[n])));
        }
    }
    lanei codes = lanei_splat(0);
    for (int n = 0; n < 4; ++n) {
        const lane code = lane_add(lane_mul(wide_range(c[n]), lane_splat(255.0f)), lane_splat(0.5f));
        const lanei byte = lane_to_int(code);
        codes = n == 0 ? byte : lanei_or(codes, lanei_mul(byte, lanei_splat((int32_t)(1u << 8 * n))));
    }
    return codes;
}

void WIDE_NAME(uint8_t out[64][4], const gl_wide_job *job, uint64_t mask)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t bits = (uint32_t)(mask >> k) & ALL_LANES;
        if (bits != 0) {
            wide_store(out + k, wide_pixels(job, k, bits));
        }
    }
}
