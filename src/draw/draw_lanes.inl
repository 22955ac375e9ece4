/* draw_lanes.inl: coverage, depth and colours of draws, LANES pixels of a tile at a time. Layer 4.
 *
 * Values equal those of draw_tile.c and draw_texel.c. Unused parts of a state cost a branch per tile, or per vector. */
#include <string.h>

#define DRAW_LOG2_E 1.44269504f

/* Pixels inside all three edges. */
static uint64_t KERNEL(draw_cover)(const int32_t e[3], const int32_t ex[3], const int32_t ey[3])
{
    uint64_t mask = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lanei a = lanei_affine(e[0], ex[0], ey[0], k), b = lanei_affine(e[1], ex[1], ey[1], k),
                    c = lanei_affine(e[2], ex[2], ey[2], k);
        mask |= (uint64_t)mask_bits(lanei_not_negative(lanei_or(lanei_or(a, b), c))) << k;
    }
    return mask;
}

LANE_INLINE lane draw_slope_at(const lmb_draw_slope *s, int k)
{
    const lane row = lane_add(lane_splat(s->at), lane_mul(lane_splat(s->y), lane_row(k)));
    return lane_add(row, lane_mul(lane_splat(s->x), lane_column(k)));
}

LANE_INLINE uint32_t draw_bits(uint64_t mask, int k) { return (uint32_t)(mask >> k) & ((1u << LANES) - 1u); }

/* --- depth -------------------------------------------------------------------------------------------------------- */

LANE_INLINE lane_mask draw_passing(int func, lane d, lane was)
{
    const lane_mask less = lane_lt(d, was), at_most = lane_le(d, was), other = mask_not(at_most);
    const lane_mask equal = mask_and(at_most, mask_not(less));
    switch (func) {
    case LMB_DRAW_NEVER: return mask_of_bits(0);
    case LMB_DRAW_LESS: return less;
    case LMB_DRAW_EQUAL: return equal;
    case LMB_DRAW_LEQUAL: return at_most;
    case LMB_DRAW_GREATER: return other;
    case LMB_DRAW_NOTEQUAL: return mask_not(equal);
    case LMB_DRAW_GEQUAL: return mask_not(less);
    default: return mask_of_bits(~0u);
    }
}

static uint64_t KERNEL(draw_test)(const lmb_draw_patch *p, uint64_t mask)
{
    const lane low = lane_splat(p->d_min), high = lane_splat(p->d_max);
    const int writes = (p->state->flags & LMB_DRAW_DEPTH_WRITE) != 0;
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t bits = draw_bits(mask, k);
        if (bits == 0) {
            continue;
        }
        float *at = p->depth + (ptrdiff_t)(k >> 3) * p->depth_step + (k & 7);
        const lane was = lane_load_rows(at, p->depth_step);
        lane d = lane_hold(draw_slope_at(&p->d, k), low, high);
        if (p->d_add != 0.0f) {
            d = lane_hold(lane_add(d, lane_splat(p->d_add)), lane_splat(0.0f), lane_splat(1.0f));
        }
        const lane_mask passes = mask_and(mask_of_bits(bits), draw_passing(p->state->depth_func, d, was));
        if (writes) {
            lane_store_rows(at, p->depth_step, lane_pick(passes, d, was));
        }
        out |= (uint64_t)(mask_bits(passes) & bits) << k;
    }
    return out;
}

/* --- colours ------------------------------------------------------------------------------------------------------ */

/* Codes R G B A, 0 .. 255. */
typedef struct draw_codes {
    lanei c[4];
} draw_codes;

LANE_INLINE lanei draw_code(lane v)
{
    return lane_to_int(lane_add(lane_hold(v, lane_splat(0.0f), lane_splat(255.0f)), lane_splat(0.5f)));
}

/* v / 255, to nearest, for 0 .. 255 x 255. */
LANE_INLINE lanei draw_255th(lanei v)
{
    v = lanei_add(v, lanei_splat(128));
    return lanei_shift(lanei_add(v, lanei_shift(v, 8)), 8);
}

LANE_INLINE lanei draw_lane_times(lanei a, lanei b) { return draw_255th(lanei_mul(a, b)); }

/* a if share is 255, b if it is 0. */
LANE_INLINE lanei draw_lane_between(lanei a, lanei b, lanei share)
{
    return draw_255th(lanei_add(lanei_mul(a, share), lanei_mul(b, lanei_sub(lanei_splat(255), share))));
}

LANE_INLINE draw_codes draw_split(lanei bits)
{
    const lanei byte = lanei_splat(255);
    draw_codes r;
    r.c[0] = lanei_and(bits, byte);
    r.c[1] = lanei_and(lanei_shift(bits, 8), byte);
    r.c[2] = lanei_and(lanei_shift(bits, 16), byte);
    r.c[3] = lanei_and(lanei_shift(bits, 24), byte);
    return r;
}

LANE_INLINE lanei draw_join(const draw_codes *v)
{
    const lanei even = lanei_or(v->c[0], lanei_mul(v->c[2], lanei_splat(1 << 16)));
    const lanei odd = lanei_or(v->c[1], lanei_mul(v->c[3], lanei_splat(1 << 16)));
    return lanei_or(even, lanei_mul(odd, lanei_splat(1 << 8)));
}

/* Swaps R and B. */
LANE_INLINE lanei draw_swap(lanei bits)
{
    const lanei byte = lanei_splat(255), first = lanei_and(bits, byte), third = lanei_and(lanei_shift(bits, 16), byte);
    const lanei others = lanei_and(bits, lanei_splat((int32_t)0xff00ff00u));
    return lanei_or(lanei_or(others, third), lanei_mul(first, lanei_splat(1 << 16)));
}

/* Weights of corners 1 and 2. */
typedef struct draw_share {
    lane b1, b2;
} draw_share;

LANE_INLINE lane draw_inverse(lane q)
{
    return lane_keep(lane_lt(lane_splat(1e-30f), q), lane_div(lane_splat(1.0f), q));
}

/* Divides by q. */
LANE_INLINE void draw_even_out(draw_share *s, lane q)
{
    const lane inverse = draw_inverse(q);
    s->b1 = lane_mul(s->b1, inverse);
    s->b2 = lane_mul(s->b2, inverse);
}

LANE_INLINE draw_share draw_hold_share(draw_share s)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    s.b1 = lane_hold(s.b1, zero, one);
    s.b2 = lane_hold(s.b2, zero, one);
    return s;
}

LANE_INLINE draw_share draw_share_at(const lmb_draw_patch *p, int k)
{
    draw_share s;
    s.b1 = draw_slope_at(&p->n1, k);
    s.b2 = draw_slope_at(&p->n2, k);
    if (!p->is_even) {
        draw_even_out(&s, draw_slope_at(&p->q, k));
    }
    return draw_hold_share(s);
}

LANE_INLINE lane draw_value_at(const lmb_draw_patch *p, int i, const draw_share *s)
{
    const lane more = lane_add(lane_mul(s->b1, lane_splat(p->more1[i])), lane_mul(s->b2, lane_splat(p->more2[i])));
    return lane_add(lane_splat(p->at[i]), more);
}

/* texture_wrap; sides that are powers of two repeat by a mask. */
LANE_INLINE lanei draw_wrap(lanei i, int32_t size, int wrap)
{
    if (wrap == LMB_WRAP_REPEAT && (size & (size - 1)) == 0) {
        return lanei_and(i, lanei_splat(size - 1));
    }
    return texture_wrap(i, lanei_splat(size), wrap);
}

LANE_INLINE lanei draw_texel_row(const lmb_texture *t, lanei y)
{
    return lanei_mul(draw_wrap(y, t->height, t->wrap_t), lanei_splat(t->width));
}

LANE_INLINE lanei draw_texel_at(const lmb_texture *t, lanei x, lanei y)
{
    const lanei row = lanei_mul(texture_wrap(y, lanei_splat(t->height), t->wrap_t), lanei_splat(t->width));
    return lanei_gather_rgba(t->texels, lanei_add(row, texture_wrap(x, lanei_splat(t->width), t->wrap_s)));
}

/* The four texels around x, y in 1/256 texels. */
LANE_INLINE void draw_find_corners(lanei out[4], const lmb_texture *t, lanei x, lanei y)
{
    const lanei one = lanei_splat(1), x0 = lanei_shift(x, 8), y0 = lanei_shift(y, 8);
    const lanei left = draw_wrap(x0, t->width, t->wrap_s), right = draw_wrap(lanei_add(x0, one), t->width, t->wrap_s);
    const lanei upper = draw_texel_row(t, y0), lower = draw_texel_row(t, lanei_add(y0, one));
    out[0] = lanei_gather_rgba(t->texels, lanei_add(upper, left));
    out[1] = lanei_gather_rgba(t->texels, lanei_add(upper, right));
    out[2] = lanei_gather_rgba(t->texels, lanei_add(lower, left));
    out[3] = lanei_gather_rgba(t->texels, lanei_add(lower, right));
}

/* Between the texels of pixels `bits`, at least one; of others, any. */
LANE_PART lanei draw_between_texels(const lmb_texture *t, lanei x, lanei y, uint32_t bits)
{
    lanei corner[4];
#ifdef LANE_GATHERS_PAIRS
    const lanei x0 = lanei_shift(x, 8), y0 = lanei_shift(y, 8);
    const lane_mask inside = mask_and(lanei_within(x0, t->width - 1), lanei_within(y0, t->height - 1));
    lanei pair[4];
    if ((mask_bits(inside) & bits) == bits) { /* no side of the texture lies between the texels */
        const lanei at = lanei_add(lanei_mul(y0, lanei_splat(t->width)), x0);
        lanei_gather_pairs(pair, t->texels, 4 * (ptrdiff_t)t->width, lanei_pick(inside, at, lanei_splat(0)));
    } else {
        draw_find_corners(corner, t, x, y);
        lanei_pair_corners(pair, corner);
    }
    return codes_between_pairs(pair, x, y);
#else
    (void)bits;
    draw_find_corners(corner, t, x, y);
    return codes_between(corner, x, y);
#endif
}

LANE_INLINE draw_codes draw_bilinear(const lmb_texture *t, lane u, lane v)
{
    const lanei half = lanei_splat(128);
    const lanei x = lanei_sub(lane_to_int(lane_mul(u, lane_splat((float)(t->width * 256)))), half);
    const lanei y = lanei_sub(lane_to_int(lane_mul(v, lane_splat((float)(t->height * 256)))), half);
    return draw_split(draw_between_texels(t, x, y, ALL_LANES));
}

LANE_PART draw_codes draw_sample(const lmb_texture *t, lane u, lane v)
{
    u = texture_reduce(u, t->wrap_s);
    v = texture_reduce(v, t->wrap_t);
    if (t->filter != LMB_NEAREST) {
        return draw_bilinear(t, u, v);
    }
    return draw_split(draw_texel_at(t, lane_to_int(lane_mul(u, lane_splat((float)t->width))),
                                    lane_to_int(lane_mul(v, lane_splat((float)t->height)))));
}

/* Applies a stage's texture to the colour. */
LANE_PART draw_codes draw_stage_lanes(draw_codes v, const lmb_draw_patch *p, int n, const draw_share *s, int is_white)
{
    const lmb_draw_stage *stage = &p->state->stage[n];
    const draw_codes t = draw_sample(stage->texture, draw_value_at(p, 4 + 2 * n, s), draw_value_at(p, 5 + 2 * n, s));
    if (stage->mode == LMB_DRAW_REPLACE || (stage->mode == LMB_DRAW_MODULATE && is_white)) {
        return t;
    }
    for (int i = 0; i < 3; ++i) {
        switch (stage->mode) {
        case LMB_DRAW_DECAL: v.c[i] = draw_lane_between(t.c[i], v.c[i], t.c[3]); break;
        case LMB_DRAW_MIX: v.c[i] = draw_lane_between(lanei_splat(stage->colour[i]), v.c[i], t.c[i]); break;
        case LMB_DRAW_PLUS: v.c[i] = lanei_min(lanei_add(v.c[i], t.c[i]), lanei_splat(255)); break;
        default: v.c[i] = draw_lane_times(v.c[i], t.c[i]); break;
        }
    }
    v.c[3] = stage->mode == LMB_DRAW_DECAL ? v.c[3] : draw_lane_times(v.c[3], t.c[3]);
    return v;
}

/* The share that fog leaves, as a code. */
LANE_INLINE lanei draw_fog_code(const lmb_draw_patch *p, const draw_share *s)
{
    const lmb_draw_state *state = p->state;
    const lane c = draw_value_at(p, LMB_DRAW_VALUES - 1, s);
    lane left;
    if (state->fog == LMB_DRAW_FOG_LINEAR) {
        left = lane_div(lane_sub(lane_splat(state->fog_end), c), lane_splat(state->fog_end - state->fog_start));
    } else {
        const lane thick = lane_mul(lane_splat(state->fog_density), c);
        const lane by = state->fog == LMB_DRAW_FOG_EXP ? thick : lane_mul(thick, thick);
        left = lane_exp2(lane_mul(by, lane_splat(-DRAW_LOG2_E)));
    }
    return draw_code(lane_mul(left, lane_splat(255.0f)));
}

LANE_INLINE draw_codes draw_fogged(draw_codes v, const lmb_draw_patch *p, const draw_share *s)
{
    const lanei code = draw_fog_code(p, s);
    for (int i = 0; i < 3; ++i) {
        v.c[i] = draw_lane_between(v.c[i], lanei_splat(p->state->fog_colour[i]), code);
    }
    return v;
}

/* --- blending ----------------------------------------------------------------------------------------------------- */

/* The factor of channel i. */
LANE_PART lanei draw_factor(const lmb_draw_state *s, int factor, const draw_codes *source, const draw_codes *target,
                            int i)
{
    const lanei all = lanei_splat(255);
    switch (factor) {
    case LMB_DRAW_ZERO: return lanei_splat(0);
    case LMB_DRAW_ONE: return all;
    case LMB_DRAW_SOURCE_COLOUR: return source->c[i];
    case LMB_DRAW_INVERSE_SOURCE_COLOUR: return lanei_sub(all, source->c[i]);
    case LMB_DRAW_SOURCE_ALPHA: return source->c[3];
    case LMB_DRAW_INVERSE_SOURCE_ALPHA: return lanei_sub(all, source->c[3]);
    case LMB_DRAW_TARGET_ALPHA: return target->c[3];
    case LMB_DRAW_INVERSE_TARGET_ALPHA: return lanei_sub(all, target->c[3]);
    case LMB_DRAW_TARGET_COLOUR: return target->c[i];
    case LMB_DRAW_INVERSE_TARGET_COLOUR: return lanei_sub(all, target->c[i]);
    case LMB_DRAW_SATURATE: return i == 3 ? all : lanei_min(source->c[3], lanei_sub(all, target->c[3]));
    case LMB_DRAW_CONSTANT_COLOUR: return lanei_splat(s->blend_colour[i]);
    case LMB_DRAW_INVERSE_CONSTANT_COLOUR: return lanei_splat(255 - s->blend_colour[i]);
    case LMB_DRAW_CONSTANT_ALPHA: return lanei_splat(s->blend_colour[3]);
    default: return lanei_splat(255 - s->blend_colour[3]);
    }
}

LANE_PART lanei draw_blend_channel(const lmb_draw_state *s, const draw_codes *source, const draw_codes *target, int i)
{
    const int alpha = i == 3, equation = s->blend_equation[alpha];
    if (equation == LMB_DRAW_MIN) {
        return lanei_min(source->c[i], target->c[i]);
    }
    if (equation == LMB_DRAW_MAX) {
        return lanei_max(source->c[i], target->c[i]);
    }
    const lanei a = lanei_mul(source->c[i], draw_factor(s, s->blend_source[alpha], source, target, i));
    const lanei b = lanei_mul(target->c[i], draw_factor(s, s->blend_target[alpha], source, target, i));
    const lanei sum = equation == LMB_DRAW_ADD        ? lanei_add(a, b)
                      : equation == LMB_DRAW_SUBTRACT ? lanei_sub(a, b)
                                                      : lanei_sub(b, a);
    return draw_255th(lanei_min(lanei_max(sum, lanei_splat(0)), lanei_splat(255 * 255)));
}

LANE_PART lanei draw_blend_all(const lmb_draw_state *s, const draw_codes *source, lanei was)
{
    const draw_codes target = draw_split(was);
    draw_codes made;
    for (int i = 0; i < 4; ++i) {
        made.c[i] = draw_blend_channel(s, source, &target, i);
    }
    return draw_join(&made);
}

LANE_PART lanei draw_logic_lanes(uint32_t op, lanei source, lanei was)
{
    const lanei ones = lanei_splat(-1), zero = lanei_splat(0);
    const lanei other_source = lanei_sub(ones, source), other_was = lanei_sub(ones, was);
    const lanei a = (op & 1u) != 0 ? lanei_and(source, was) : zero;
    const lanei b = (op & 2u) != 0 ? lanei_and(source, other_was) : zero;
    const lanei c = (op & 4u) != 0 ? lanei_and(other_source, was) : zero;
    const lanei d = (op & 8u) != 0 ? lanei_and(other_source, other_was) : zero;
    return lanei_or(lanei_or(a, b), lanei_or(c, d));
}

/* How a state combines colours with the target. */
enum { DRAW_MEET_NOT = 0, DRAW_MEET_OVER = 1, DRAW_MEET_ADD = 2, DRAW_MEET_BLEND = 3, DRAW_MEET_LOGIC = 4 };

static int draw_meets(const lmb_draw_state *s)
{
    const int source = s->blend_source[0], target = s->blend_target[0];
    if ((s->flags & LMB_DRAW_LOGIC) != 0) {
        return DRAW_MEET_LOGIC;
    }
    if ((s->flags & LMB_DRAW_BLEND) == 0) {
        return DRAW_MEET_NOT;
    }
    if (s->blend_equation[0] != LMB_DRAW_ADD || s->blend_equation[1] != LMB_DRAW_ADD || source != s->blend_source[1] ||
        target != s->blend_target[1] || source != LMB_DRAW_SOURCE_ALPHA) {
        return DRAW_MEET_BLEND;
    }
    return target == LMB_DRAW_INVERSE_SOURCE_ALPHA ? DRAW_MEET_OVER
           : target == LMB_DRAW_ONE                ? DRAW_MEET_ADD
                                                   : DRAW_MEET_BLEND;
}

LANE_INLINE lanei draw_met(const lmb_draw_state *s, const draw_codes *v, lanei was, int meets)
{
    switch (meets) {
    case DRAW_MEET_OVER:
        return codes_over(draw_join(v), was);
    case DRAW_MEET_ADD:
        return codes_plus(draw_join(v), was);
    case DRAW_MEET_BLEND: return draw_blend_all(s, v, was);
    case DRAW_MEET_LOGIC: return draw_logic_lanes(s->logic_op, draw_join(v), was);
    default: return draw_join(v);
    }
}

/* --- the target --------------------------------------------------------------------------------------------------- */

/* Pixels in a row. A copy of 32 bytes in two parts would stall the load of all of them. */
LANE_INLINE lanei draw_load_row(const uint8_t *p)
{
#if LANES == LMB_TILE
    return lanei_load((const int32_t *)(const void *)p);
#else
    int32_t v[LANES];
    memcpy(v, p, sizeof v);
    return lanei_load(v);
#endif
}

LANE_INLINE void draw_save_row(uint8_t *p, lanei bits)
{
#if LANES == LMB_TILE
    lanei_store((int32_t *)(void *)p, bits);
#else
    int32_t v[LANES];
    lanei_store(v, bits);
    memcpy(p, v, sizeof v);
#endif
}

/* Rows are `stride` bytes apart; sixteen lanes are two rows. */
LANE_INLINE lanei draw_load(const uint8_t *p, int32_t stride)
{
    (void)stride;
#if LANES > LMB_TILE
    return lanei_load_rows(p, stride);
#else
    return draw_load_row(p);
#endif
}

LANE_INLINE void draw_save(uint8_t *p, int32_t stride, lanei bits)
{
    (void)stride;
#if LANES > LMB_TILE
    lanei_store_rows(p, stride, bits);
#else
    draw_save_row(p, bits);
#endif
}

LANE_INLINE draw_codes draw_colour_of(const lmb_draw_patch *p, const draw_share *s, const draw_codes *same,
                                      int is_white)
{
    const lmb_draw_state *state = p->state;
    draw_codes v = *same;
    if (p->varies) {
        for (int i = 0; i < 4; ++i) {
            v.c[i] = draw_code(draw_value_at(p, i, s));
        }
    }
    for (int n = 0; n < LMB_DRAW_STAGES; ++n) {
        if (state->stage[n].texture != NULL) {
            v = draw_stage_lanes(v, p, n, s, is_white && n == 0);
        }
    }
    return state->fog != LMB_DRAW_FOG_NONE ? draw_fogged(v, p, s) : v;
}

/* --- one texture, blended by alpha -------------------------------------------------------------------------------- */

#if !defined(LANE_PLAIN) /* in plain C the general kernel is faster */
/* 1: the usual states: at most one texture, all channels, opaque or blended by alpha. */
static int draw_is_usual(const lmb_draw_state *s, int meets)
{
    const lmb_draw_stage *stage = &s->stage[0];
    return meets <= DRAW_MEET_ADD && s->colour_mask == 15 && s->stage[1].texture == NULL &&
           (stage->texture == NULL || stage->mode == LMB_DRAW_MODULATE || stage->mode == LMB_DRAW_REPLACE);
}

/* Texture coordinate i over a patch. Copies of the patch's values, because stores of vectors may alias it. */
typedef struct draw_axis {
    float at, more1, more2, size;
    int32_t texels, wrap;
    int up; /* 1: never negative, and far from the limits */
} draw_axis;

LANE_INLINE draw_axis draw_axis_of(const lmb_draw_patch *p, int i, int32_t texels, int32_t wrap, int32_t steps)
{
    draw_axis a;
    a.at = p->at[i];
    a.more1 = p->more1[i];
    a.more2 = p->more2[i];
    a.size = (float)(texels * steps);
    a.texels = texels;
    a.wrap = wrap;
    a.up = wrap == LMB_WRAP_REPEAT && a.at >= 0.0f && a.more1 >= 0.0f && a.more2 >= 0.0f &&
           a.at + a.more1 + a.more2 < 1e6f;
    return a;
}

/* The coordinate within a period, in steps of a texel. A coordinate that is not negative needs no floor. */
LANE_INLINE lanei draw_place(const draw_axis *a, const draw_share *s)
{
    const lane more = lane_add(lane_mul(s->b1, lane_splat(a->more1)), lane_mul(s->b2, lane_splat(a->more2))),
               u = lane_add(lane_splat(a->at), more);
    const lane part = a->up ? lane_part(u) : texture_reduce(u, a->wrap);
    return lane_to_int(lane_mul(part, lane_splat(a->size)));
}

/* The same as the index of a texel. The rest of `up` coordinates is below 1. */
LANE_INLINE lanei draw_nearest(const draw_axis *a, const draw_share *s)
{
    const lanei i = draw_place(a, s);
    return a->up ? i : draw_wrap(i, a->texels, a->wrap);
}

/* Values that the pixels of a shape share. */
typedef struct draw_brush {
    const lmb_texture *texture;
    lanei same; /* the colour, if it does not vary */
    int32_t meets, varies, is_smooth, is_white;
} draw_brush;

LANE_INLINE draw_brush draw_brush_of(const lmb_draw_patch *p, int meets)
{
    const lmb_draw_stage *stage = &p->state->stage[0];
    const int replaces = stage->texture != NULL && stage->mode == LMB_DRAW_REPLACE;
    draw_brush b;
    uint32_t codes = 0; /* of corner 0; vectors of each channel would take a quarter of the stack */
    b.texture = stage->texture;
    b.meets = meets;
    b.varies = p->varies && !replaces;
    b.is_smooth = b.texture != NULL && b.texture->filter != LMB_NEAREST;
    b.is_white = replaces || !p->varies;
    for (int i = 0; i < 4; ++i) {
        const float code = p->at[i] > 0.0f ? p->at[i] : 0.0f;
        codes |= (uint32_t)(int32_t)((code < 255.0f ? code : 255.0f) + 0.5f) << 8 * i;
        b.is_white &= replaces || p->at[i] == 255.0f;
    }
    b.same = lanei_splat((int32_t)codes);
    return b;
}

/* Texture coordinates u and v of the first stage over a patch; unused without a texture. */
typedef struct draw_axes {
    draw_axis u, v;
} draw_axes;

LANE_INLINE draw_axes draw_axes_of(const draw_brush *b, const lmb_draw_patch *p)
{
    const lmb_texture *t = b->texture;
    const int32_t steps = b->is_smooth ? 256 : 1, first = t != NULL ? 4 : 0; /* the patch has no others then */
    draw_axes a;
    a.u = draw_axis_of(p, first, t != NULL ? t->width : 1, t != NULL ? t->wrap_s : LMB_WRAP_REPEAT, steps);
    a.v = draw_axis_of(p, first + 1, t != NULL ? t->height : 1, t != NULL ? t->wrap_t : LMB_WRAP_REPEAT, steps);
    return a;
}

/* Values of pixels before they are blended. Bilinear: x and y in 1/256 texels; nearest: x is the texel's index. */
typedef struct draw_found {
    lanei x, y, colour; /* unused ones hold the shape's colour */
} draw_found;

LANE_INLINE draw_found draw_find(const draw_brush *b, const draw_axes *a, const lmb_draw_patch *p, const draw_share *s)
{
    draw_found f;
    f.colour = f.x = f.y = b->same;
    if (b->varies) {
        draw_codes v;
        for (int i = 0; i < 4; ++i) {
            v.c[i] = draw_code(draw_value_at(p, i, s));
        }
        f.colour = draw_join(&v);
    }
    if (b->is_smooth) {
        f.x = lanei_sub(draw_place(&a->u, s), lanei_splat(128));
        f.y = lanei_sub(draw_place(&a->v, s), lanei_splat(128));
    } else if (b->texture != NULL) {
        f.x = lanei_add(lanei_mul(draw_nearest(&a->v, s), lanei_splat(b->texture->width)), draw_nearest(&a->u, s));
    }
    return f;
}

/* The colours of the pixels. */
LANE_INLINE lanei draw_painted(const draw_brush *b, const draw_found *f, uint32_t bits)
{
    lanei v = f->colour;
    if (b->texture != NULL) {
        const lanei c = b->is_smooth ? draw_between_texels(b->texture, f->x, f->y, bits)
                                     : lanei_gather_rgba(b->texture->texels, f->x);
        v = b->is_white ? c : codes_times(c, v);
    }
    return v;
}

/* Blends colours onto `was`. */
LANE_INLINE lanei draw_mixed(const draw_brush *b, lanei v, int swaps, lanei was)
{
    v = swaps ? draw_swap(v) : v;
    return b->meets == DRAW_MEET_OVER ? codes_over(v, was) : b->meets == DRAW_MEET_ADD ? codes_plus(v, was) : v;
}

/* Mixes colours with the fog's R G B; alpha stays. code: the share of the colours. */
LANE_INLINE lanei draw_into_fog(lanei v, lanei code, uint32_t fog)
{
    const lanei low = lanei_splat(0xffffff), alpha = lanei_mul(code, lanei_splat(1 << 24));
    const lanei over = codes_over(lanei_or(lanei_and(v, low), alpha), lanei_splat((int32_t)fog));
    return lanei_or(lanei_and(over, low), lanei_and(v, lanei_splat(~0xffffff)));
}

/* Values that all tiles of a shape share. */
typedef struct draw_look {
    draw_brush brush;
    draw_axes axes;
    uint32_t fog; /* R G B */
    int fogs;
} draw_look;

LANE_INLINE draw_look draw_look_of(const lmb_draw_patch *p, int meets)
{
    draw_look l;
    l.brush = draw_brush_of(p, meets);
    l.axes = draw_axes_of(&l.brush, p);
    l.fogs = p->state->fog != LMB_DRAW_FOG_NONE;
    l.fog = 0;
    for (int i = 0; i < 3; ++i) {
        l.fog |= (uint32_t)p->state->fog_colour[i] << 8 * i;
    }
    return l;
}

LANE_INLINE void draw_usual_pixels(const lmb_draw_patch *p, uint64_t mask, const draw_look *l, int fogs)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t bits = draw_bits(mask, k);
        uint8_t *at = p->colour + (ptrdiff_t)(k >> 3) * p->colour_stride + 4 * (k & 7);
        if (bits != 0) {
            const draw_share share = draw_share_at(p, k);
            const draw_found f = draw_find(&l->brush, &l->axes, p, &share);
            const lanei was = draw_load(at, p->colour_stride);
            lanei v = draw_painted(&l->brush, &f, bits);
            if (fogs) {
                v = draw_into_fog(v, draw_fog_code(p, &share), l->fog);
            }
            const lanei made = draw_mixed(&l->brush, v, p->swaps, was);
            draw_save(at, p->colour_stride, lanei_pick(mask_of_bits(bits), made, was));
        }
    }
}

/* Colours pixels of a tile in the usual states. */
LANE_NOINLINE void KERNEL(draw_usual)(const lmb_draw_patch *p, uint64_t mask, const draw_look *l)
{
    draw_usual_pixels(p, mask, l, 0);
}

LANE_NOINLINE void KERNEL(draw_usual_fogged)(const lmb_draw_patch *p, uint64_t mask, const draw_look *l)
{
    draw_usual_pixels(p, mask, l, 1);
}

LANE_INLINE void draw_usual_tile(const lmb_draw_patch *p, uint64_t mask, const draw_look *l)
{
    if (l->fogs) {
        KERNEL(draw_usual_fogged)(p, mask, l);
    } else {
        KERNEL(draw_usual)(p, mask, l);
    }
}

#endif

/* How a state writes colours. */
typedef struct draw_writer {
    lanei written; /* bits of the channels that are written */
    int meets, keeps;
} draw_writer;

LANE_INLINE draw_writer draw_writer_of(const lmb_draw_state *s)
{
    uint32_t channels = 0;
    draw_writer w;
    for (int i = 0; i < 4; ++i) {
        channels |= (s->colour_mask >> i & 1u) != 0 ? 0xffu << 8 * i : 0;
    }
    w.written = lanei_splat((int32_t)channels);
    w.meets = draw_meets(s);
    w.keeps = s->colour_mask != 15;
    return w;
}

/* Writes the pixels `bits` of k, .... */
LANE_INLINE void draw_write(const draw_writer *w, const lmb_draw_patch *p, const draw_codes *v, int k, uint32_t bits)
{
    uint8_t *at = p->colour + (ptrdiff_t)(k >> 3) * p->colour_stride + 4 * (k & 7);
    lanei was = lanei_splat(0);
    if (w->meets != DRAW_MEET_NOT || w->keeps || bits != ALL_LANES) {
        was = draw_load(at, p->colour_stride);
        was = p->swaps ? draw_swap(was) : was;
    }
    lanei made = draw_met(p->state, v, was, w->meets);
    if (w->keeps) {
        made = lanei_or(lanei_and(made, w->written), lanei_and(was, lanei_sub(lanei_splat(-1), w->written)));
    }
    made = lanei_pick(mask_of_bits(bits), made, was);
    draw_save(at, p->colour_stride, p->swaps ? draw_swap(made) : made);
}

LANE_NOINLINE void KERNEL(draw_general)(const lmb_draw_patch *p, uint64_t mask)
{
    const lmb_draw_state *s = p->state;
    const draw_writer writer = draw_writer_of(s);
    const int textured = s->stage[0].texture != NULL || s->stage[1].texture != NULL;
    const int needs_share = p->varies || textured || s->fog != LMB_DRAW_FOG_NONE;
    int is_white = !p->varies;
    draw_codes same;
    draw_share share = {lane_splat(0.0f), lane_splat(0.0f)};
    for (int i = 0; i < 4; ++i) {
        same.c[i] = draw_code(lane_splat(p->at[i]));
        is_white &= p->at[i] == 255.0f;
    }
    draw_codes v = same;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t bits = draw_bits(mask, k);
        if (bits == 0) {
            continue;
        }
        if (needs_share) {
            share = draw_share_at(p, k);
            v = draw_colour_of(p, &share, &same, is_white);
        }
        draw_write(&writer, p, &v, k, bits);
    }
}

static void KERNEL(draw_paint)(const lmb_draw_patch *p, uint64_t mask)
{
#if !defined(LANE_PLAIN)
    const int meets = draw_meets(p->state);
    const int is_plain = p->state->stage[0].texture == NULL && p->state->fog == LMB_DRAW_FOG_NONE &&
                         meets == DRAW_MEET_NOT; /* one pass is faster */
    if (!is_plain && draw_is_usual(p->state, meets)) {
        const draw_look look = draw_look_of(p, meets);
        draw_usual_tile(p, mask, &look);
        return;
    }
#endif
    KERNEL(draw_general)(p, mask);
}

#if !defined(LANE_PLAIN)

static void KERNEL(draw_shares)(float out[2][LMB_TILE_PIXELS], const lmb_draw_patch *p, uint64_t mask)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        if (draw_bits(mask, k) != 0) {
            const draw_share share = draw_share_at(p, k);
            lane_store(&out[0][k], draw_value_at(p, 0, &share));
            lane_store(&out[1][k], draw_value_at(p, 1, &share));
        }
    }
}

static void KERNEL(draw_steps)(float by_x[2][LMB_TILE_PIXELS], float by_y[2][LMB_TILE_PIXELS], const lmb_draw_patch *p,
                               uint64_t mask)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        lane x1 = lane_splat(p->n1.x), x2 = lane_splat(p->n2.x), y1 = lane_splat(p->n1.y), y2 = lane_splat(p->n2.y);
        if (draw_bits(mask, k) == 0) {
            continue;
        }
        if (!p->is_even) {
            const lane q = draw_slope_at(&p->q, k), q_x = lane_splat(p->q.x), q_y = lane_splat(p->q.y),
                       inverse = draw_inverse(q);
            const draw_share s = draw_share_at(p, k);
            x1 = lane_mul(lane_sub(x1, lane_mul(s.b1, q_x)), inverse);
            x2 = lane_mul(lane_sub(x2, lane_mul(s.b2, q_x)), inverse);
            y1 = lane_mul(lane_sub(y1, lane_mul(s.b1, q_y)), inverse);
            y2 = lane_mul(lane_sub(y2, lane_mul(s.b2, q_y)), inverse);
        }
        for (int i = 0; i < 2; ++i) {
            const lane more1 = lane_splat(p->more1[i]), more2 = lane_splat(p->more2[i]);
            lane_store(&by_x[i][k], lane_add(lane_mul(x1, more1), lane_mul(x2, more2)));
            lane_store(&by_y[i][k], lane_add(lane_mul(y1, more1), lane_mul(y2, more2)));
        }
    }
}

static void KERNEL(draw_dots)(lmb_draw_dots *d, const lmb_draw_patch *p, int32_t count)
{
    const int meets = draw_meets(p->state);
    draw_codes v;
    for (int i = 0; i < 4; ++i) {
        v.c[i] = lanei_splat((int32_t)p->at[i]);
    }
    for (int32_t k = 0; k < count; k += LANES) {
        const lane x = lane_from_int(lanei_load(&d->column[k])), y = lane_from_int(lanei_load(&d->row[k]));
        if (p->varies) {
            draw_share s = {lane_add(lane_load(&d->n1[k]), lane_mul(lane_splat(p->n1.y), y)), lane_splat(0.0f)};
            s.b1 = lane_add(s.b1, lane_mul(lane_splat(p->n1.x), x));
            if (!p->is_even) {
                const lane q = lane_add(lane_load(&d->q[k]), lane_mul(lane_splat(p->q.y), y));
                draw_even_out(&s, lane_add(q, lane_mul(lane_splat(p->q.x), x)));
            }
            s = draw_hold_share(s);
            for (int i = 0; i < 4; ++i) {
                v.c[i] = draw_code(draw_value_at(p, i, &s));
            }
        }
        const lanei made = draw_join(&v), code = p->swaps ? draw_swap(made) : made, was = lanei_load(&d->codes[k]);
        lanei_store(&d->codes[k], meets == DRAW_MEET_OVER  ? codes_over(code, was)
                                  : meets == DRAW_MEET_ADD ? codes_plus(code, was)
                                                           : code);
    }
}

static void KERNEL(draw_put)(const lmb_draw_put *to, const uint8_t (*codes)[4], uint64_t mask)
{
    const int meets = draw_meets(to->state);
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t bits = draw_bits(mask, k);
        uint8_t *at = to->colour + (ptrdiff_t)(k >> 3) * to->stride + 4 * (k & 7);
        if (bits == 0) {
            continue;
        }
        int32_t of[LANES];
        memcpy(of, codes + k, sizeof of);
        const lanei was = draw_load(at, to->stride), code = lanei_load(of), v = to->swaps ? draw_swap(code) : code;
        const lanei made = meets == DRAW_MEET_OVER  ? codes_over(v, was)
                           : meets == DRAW_MEET_ADD ? codes_plus(v, was)
                                                    : v;
        draw_save(at, to->stride, lanei_pick(mask_of_bits(bits), made, was));
    }
}

/* Loads and stores the pixels `bits`, of which the others of a row follow. */
LANE_INLINE lanei sheet_load(const uint8_t *p, int32_t stride, uint32_t bits)
{
#if LANES > LMB_TILE
    return lanei_load_rows_some(p, stride, mask_of_bits(bits));
#else
    (void)stride;
    return bits == ALL_LANES ? draw_load_row(p) : lanei_load_some(p, highest_bit(bits) + 1);
#endif
}

LANE_INLINE void sheet_save(uint8_t *p, int32_t stride, uint32_t bits, lanei v)
{
#if LANES > LMB_TILE
    lanei_store_rows_some(p, stride, mask_of_bits(bits), v);
#else
    (void)stride;
    if (bits == ALL_LANES) {
        draw_save_row(p, v);
    } else {
        lanei_store_some(p, highest_bit(bits) + 1, v);
    }
#endif
}

/* Vectors of a sheet are parts of rows from the sheet's left side on, of one row or of two rows of a tile. */
enum {
    SHEET_WIDE = LANES < LMB_TILE ? LANES : LMB_TILE,
    SHEET_HIGH = LANES / SHEET_WIDE,
    SHEET_PARTS = LMB_TILE / SHEET_HIGH /* in the height of a tile */
};

/* The shares over a column of parts: in the first row of the tiles, and their changes across. */
typedef struct sheet_shares {
    lane at1, at2, at_q, x1, x2, x_q;
} sheet_shares;

/* The bits of a row of a part in each of the part's rows. Rows are eight pixels apart, as SHEET_WIDE is 8 if a part has
 * two rows. */
LANE_INLINE uint32_t sheet_all_rows(uint32_t row) { return SHEET_HIGH > 1 ? row * 0x101u : row; }

/* The values of a plane at the first pixels of the tiles that pixels x, ... of the row y of tiles lie in. */
LANE_INLINE lane sheet_slope(const lmb_draw_sheet *s, const lmb_draw_plane *p, int32_t x, int32_t y)
{
    const int32_t from = x & ~7, next = from + LMB_TILE;
    const lane v = lane_splat((float)(p->origin + p->x * (s->x + from) + p->y * (s->y + y)));
    if (x + SHEET_WIDE <= next) {
        return v;
    }
    const uint32_t row = (1u << (next - x)) - 1u;
    return lane_pick(mask_of_bits(sheet_all_rows(row)), v,
                     lane_splat((float)(p->origin + p->x * (s->x + next) + p->y * (s->y + y))));
}

LANE_INLINE void sheet_set_shares(sheet_shares *out, const lmb_draw_sheet *s, int i, int32_t x, int32_t y)
{
    static const float columns[24] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
    const lmb_draw_patch *p = &s->half[i];
    const lane column = lane_load(columns + (x & 7));
    out->at1 = sheet_slope(s, s->plane[i][0], x, y);
    out->at2 = sheet_slope(s, s->plane[i][1], x, y);
    out->x1 = lane_mul(lane_splat(p->n1.x), column);
    out->x2 = lane_mul(lane_splat(p->n2.x), column);
    if (!p->is_even) {
        out->at_q = sheet_slope(s, s->plane[i][2], x, y);
        out->x_q = lane_mul(lane_splat(p->q.x), column);
    }
}

/* draw_share_at for a row of the tile. */
LANE_INLINE draw_share sheet_share(const sheet_shares *t, const lmb_draw_patch *p, int32_t row)
{
    const lane down = lane_row(LMB_TILE * row);
    draw_share s;
    s.b1 = lane_add(lane_add(t->at1, lane_mul(lane_splat(p->n1.y), down)), t->x1);
    s.b2 = lane_add(lane_add(t->at2, lane_mul(lane_splat(p->n2.y), down)), t->x2);
    if (!p->is_even) {
        draw_even_out(&s, lane_add(lane_add(t->at_q, lane_mul(lane_splat(p->q.y), down)), t->x_q));
    }
    return draw_hold_share(s);
}

/* Values of the parts of a column. Processors overlap more of two loops of short steps than of one of long steps. */
typedef struct sheet_parts {
    int32_t x[SHEET_PARTS][LANES], y[SHEET_PARTS][LANES], colour[SHEET_PARTS][LANES];
    uint32_t drawn[SHEET_PARTS], first[SHEET_PARTS]; /* bits of pixels inside the sheet, and of those of half 0 */
    int from, past;                                  /* the parts that have pixels inside */
} sheet_parts;

/* Sets the bits of parts at x, ..., of which n pixels are in the sheet. Returns bits of the halves that have some. */
LANE_INLINE int sheet_set_parts(sheet_parts *out, const lmb_draw_sheet *s, int32_t x, int32_t n, int32_t y)
{
    const int32_t ex = s->edge_x, ey = s->edge_y;
    const int64_t low = (SHEET_WIDE - 1) * (int64_t)(ex < 0 ? ex : 0) + (SHEET_HIGH - 1) * (int64_t)(ey < 0 ? ey : 0),
                  high = (SHEET_WIDE - 1) * (int64_t)(ex > 0 ? ex : 0) + (SHEET_HIGH - 1) * (int64_t)(ey > 0 ? ey : 0);
    const uint32_t row = (1u << n) - 1u, all = sheet_all_rows(row);
    const int32_t y0 = s->y0 - y, y1 = s->y1 - y; /* rows */
    uint32_t firsts = 0, others = 0;
    out->from = y0 > 0 ? y0 / SHEET_HIGH : 0;
    out->past = y1 < LMB_TILE ? y1 / SHEET_HIGH + 1 : SHEET_PARTS;
    for (int k = out->from; k < out->past; ++k) {
        const int64_t e = s->edge + (int64_t)ex * x + (int64_t)ey * (y + SHEET_HIGH * k);
        uint32_t first = e + low >= 0 ? all : 0;
        if (e + low < 0 && e + high >= 0) { /* near 0 */
            first = all & mask_bits(lanei_not_negative(lanei_affine((int32_t)e, ex, ey, 0)));
        }
        out->drawn[k] = all;
        out->first[k] = first;
        firsts |= first;
        others |= all & ~first;
    }
    if (SHEET_HIGH > 1 && (y0 & 1) != 0 && y0 > 0) {
        out->drawn[out->from] = row << SHEET_WIDE % 32;
    }
    if (SHEET_HIGH > 1 && (y1 & 1) == 0 && y1 < LMB_TILE) {
        out->drawn[out->past - 1] &= row;
    }
    return (firsts != 0) | (others != 0) << 1;
}

/* Stores v, except where `kept` has earlier values. */
LANE_INLINE void sheet_keep(int32_t *at, lanei v, int mixed, uint32_t kept)
{
    lanei_store(at, mixed ? lanei_pick(mask_of_bits(kept), lanei_load(at), v) : v);
}

/* Finds what the pixels of half i need. mixed: 1: keeps what half 0 found. All parts are found, because processors
 * mispredict which ones have pixels of the half. */
LANE_INLINE void sheet_find(sheet_parts *out, const lmb_draw_sheet *s, const draw_brush *b, const draw_axes *axes,
                            int i, int mixed, int32_t x, int32_t y)
{
    sheet_shares shares;
    sheet_set_shares(&shares, s, i, x, y);
    for (int k = out->from; k < out->past; ++k) {
        const draw_share share = sheet_share(&shares, &s->half[i], SHEET_HIGH * k);
        const draw_found f = draw_find(b, axes, &s->half[i], &share);
        sheet_keep(out->x[k], f.x, mixed, out->first[k]);
        if (b->is_smooth) {
            sheet_keep(out->y[k], f.y, mixed, out->first[k]);
        }
        if (b->varies) {
            sheet_keep(out->colour[k], f.colour, mixed, out->first[k]);
        }
    }
}

/* Draws the column of parts at x, ... in the row y of tiles. */
LANE_NOINLINE void KERNEL(sheet_draw)(const lmb_draw_sheet *s, const draw_brush *b, const draw_axes axes[2], int32_t x,
                                      int32_t n, int32_t y)
{
    const int32_t stride = s->half[0].colour_stride, swaps = s->half[0].swaps;
    sheet_parts parts;
    const int has = sheet_set_parts(&parts, s, x, n, y);
    if ((has & 1) != 0) {
        sheet_find(&parts, s, b, &axes[0], 0, 0, x, y);
    }
    if ((has & 2) != 0) {
        sheet_find(&parts, s, b, &axes[1], 1, has == 3, x, y);
    }
    uint8_t *at = s->colour + (ptrdiff_t)(y + SHEET_HIGH * parts.from) * stride + 4 * (ptrdiff_t)x;
    for (int k = parts.from; k < parts.past; ++k, at += SHEET_HIGH * (ptrdiff_t)stride) {
        const uint32_t drawn = parts.drawn[k];
        const draw_found f = {lanei_load(parts.x[k]), b->is_smooth ? lanei_load(parts.y[k]) : b->same,
                              b->varies ? lanei_load(parts.colour[k]) : b->same};
        const lanei was = sheet_load(at, stride, drawn); /* before the texels, which take longer */
        sheet_save(at, stride, drawn, draw_mixed(b, draw_painted(b, &f, drawn), swaps, was));
    }
}

static void KERNEL(draw_sheet)(lmb_draw_sheet *s)
{
    s->half[0].varies |= s->half[1].varies;
    const draw_brush b = draw_brush_of(&s->half[0], draw_meets(s->half[0].state));
    const draw_axes axes[2] = {draw_axes_of(&b, &s->half[0]), draw_axes_of(&b, &s->half[1])};
    for (int32_t y = 0; y <= s->y1; y += LMB_TILE) {
        for (int32_t x = s->x0; x <= s->x1; x += SHEET_WIDE) {
            const int32_t n = s->x1 - x + 1;
            KERNEL(sheet_draw)(s, &b, axes, x, n < SHEET_WIDE ? n : SHEET_WIDE, y);
        }
    }
}

#endif

LANE_INLINE lanei draw_fill_one(lanei bits, lanei was, int adds)
{
    return adds ? codes_plus(bits, was) : codes_same(bits, was);
}

LANE_INLINE void draw_fill_rows(uint8_t *row, int32_t stride, int32_t width, int32_t height, lanei bits, int adds)
{
    const int32_t rest = width % LANES;
    for (int32_t y = 0; y < height; ++y, row += stride) {
        uint8_t *at = row;
        for (int32_t k = LANES; k <= width; k += LANES, at += 4 * LANES) {
            draw_save_row(at, draw_fill_one(bits, draw_load_row(at), adds));
        }
        if (rest != 0) {
            lanei_store_some(at, rest, draw_fill_one(bits, lanei_load_some(at, rest), adds));
        }
    }
}

static void KERNEL(draw_fill)(uint8_t *row, int32_t stride, int32_t width, int32_t height, uint32_t codes, int adds)
{
    const lanei bits = lanei_splat((int32_t)codes);
    if (adds) {
        draw_fill_rows(row, stride, width, height, bits, 1);
    } else {
        draw_fill_rows(row, stride, width, height, bits, 0);
    }
}
