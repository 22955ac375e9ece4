/* draw_lanes.inl: coverage, depth and colours of draws, LANES pixels of a tile at a time. Layer 4.
 *
 * Values equal those of draw_tile.c and draw_texel.c. Unused parts of a state cost a branch per tile, or per vector. */
#include <string.h>

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

LANE_INLINE draw_share draw_share_at(const lmb_draw_patch *p, int k)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    draw_share s;
    s.b1 = draw_slope_at(&p->n1, k);
    s.b2 = draw_slope_at(&p->n2, k);
    if (!p->is_even) {
        const lane q = draw_slope_at(&p->q, k);
        const lane inverse = lane_keep(lane_lt(lane_splat(1e-30f), q), lane_div(one, q));
        s.b1 = lane_mul(s.b1, inverse);
        s.b2 = lane_mul(s.b2, inverse);
    }
    s.b1 = lane_hold(s.b1, zero, one);
    s.b2 = lane_hold(s.b2, zero, one);
    return s;
}

LANE_INLINE lane draw_value_at(const lmb_draw_patch *p, int i, const draw_share *s)
{
    const lane more = lane_add(lane_mul(s->b1, lane_splat(p->more1[i])), lane_mul(s->b2, lane_splat(p->more2[i])));
    return lane_add(lane_splat(p->at[i]), more);
}

LANE_INLINE lanei draw_texel_at(const lmb_texture *t, lanei x, lanei y)
{
    const lanei row = lanei_mul(texture_wrap(y, lanei_splat(t->height), t->wrap_t), lanei_splat(t->width));
    return lanei_gather_rgba(t->texels, lanei_add(row, texture_wrap(x, lanei_splat(t->width), t->wrap_s)));
}

LANE_INLINE void draw_add_texel(draw_codes *sum, lanei texel, lanei weight)
{
    const draw_codes t = draw_split(texel);
    for (int i = 0; i < 4; ++i) {
        sum->c[i] = lanei_add(sum->c[i], lanei_mul(t.c[i], weight));
    }
}

/* The four weights sum to 2^16. */
LANE_PART draw_codes draw_bilinear(const lmb_texture *t, lane u, lane v)
{
    const lanei half = lanei_splat(128), byte = lanei_splat(255), all = lanei_splat(256), one = lanei_splat(1);
    const lanei x = lanei_sub(lane_to_int(lane_mul(u, lane_splat((float)(t->width * 256)))), half);
    const lanei y = lanei_sub(lane_to_int(lane_mul(v, lane_splat((float)(t->height * 256)))), half);
    const lanei fx = lanei_and(x, byte), fy = lanei_and(y, byte), gx = lanei_sub(all, fx), gy = lanei_sub(all, fy);
    const lanei x0 = lanei_shift(x, 8), y0 = lanei_shift(y, 8), x1 = lanei_add(x0, one), y1 = lanei_add(y0, one);
    draw_codes sum;
    for (int i = 0; i < 4; ++i) {
        sum.c[i] = lanei_splat(1 << 15);
    }
    draw_add_texel(&sum, draw_texel_at(t, x0, y0), lanei_mul(gx, gy));
    draw_add_texel(&sum, draw_texel_at(t, x1, y0), lanei_mul(fx, gy));
    draw_add_texel(&sum, draw_texel_at(t, x0, y1), lanei_mul(gx, fy));
    draw_add_texel(&sum, draw_texel_at(t, x1, y1), lanei_mul(fx, fy));
    for (int i = 0; i < 4; ++i) {
        sum.c[i] = lanei_shift(sum.c[i], 16);
    }
    return sum;
}

LANE_INLINE draw_codes draw_sample(const lmb_texture *t, lane u, lane v)
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

LANE_INLINE draw_codes draw_fogged(draw_codes v, const lmb_draw_patch *p, const draw_share *s)
{
    const lmb_draw_state *state = p->state;
    const lane left = lane_sub(lane_splat(state->fog_end), draw_value_at(p, LMB_DRAW_VALUES - 1, s));
    const lane share = lane_div(left, lane_splat(state->fog_end - state->fog_start));
    const lanei code = draw_code(lane_mul(share, lane_splat(255.0f)));
    for (int i = 0; i < 3; ++i) {
        v.c[i] = draw_lane_between(v.c[i], lanei_splat(state->fog_colour[i]), code);
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

/* Two codes at once, in the low and the high half. */
LANE_INLINE lanei draw_pair_255th(lanei v)
{
    const lanei pair = lanei_splat(0x00ff00ff);
    v = lanei_add(v, lanei_splat(0x00800080));
    return lanei_and(lanei_shift(lanei_add(v, lanei_and(lanei_shift(v, 8), pair)), 8), pair);
}

/* Blends by the source's alpha: over the target, or added to it. */
LANE_INLINE lanei draw_pair_blend(lanei a, lanei b, lanei share, int adds)
{
    if (!adds) {
        return draw_pair_255th(lanei_add(lanei_mul(a, share), lanei_mul(b, lanei_sub(lanei_splat(255), share))));
    }
    const lanei sum = lanei_add(draw_pair_255th(lanei_mul(a, share)), b);
    const lanei over = lanei_and(sum, lanei_splat(0x01000100));
    return lanei_and(lanei_or(sum, lanei_sub(over, lanei_shift(over, 8))), lanei_splat(0x00ff00ff));
}

LANE_INLINE lanei draw_blend_usual(lanei bits, lanei share, lanei was, int adds)
{
    const lanei pair = lanei_splat(0x00ff00ff);
    const lanei even = draw_pair_blend(lanei_and(bits, pair), lanei_and(was, pair), share, adds);
    const lanei upper = lanei_and(lanei_shift(bits, 8), pair), upper_was = lanei_and(lanei_shift(was, 8), pair);
    const lanei odd = draw_pair_blend(upper, upper_was, share, adds);
    return lanei_or(even, lanei_mul(odd, lanei_splat(1 << 8)));
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
    case DRAW_MEET_ADD: return draw_blend_usual(draw_join(v), v->c[3], was, meets == DRAW_MEET_ADD);
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

static void KERNEL(draw_paint)(const lmb_draw_patch *p, uint64_t mask)
{
    const lmb_draw_state *s = p->state;
    const int meets = draw_meets(s), keeps = s->colour_mask != 15;
    const int textured = s->stage[0].texture != NULL || s->stage[1].texture != NULL;
    const int needs_share = p->varies || textured || s->fog != LMB_DRAW_FOG_NONE;
    int is_white = !p->varies;
    uint32_t channels = 0;
    draw_codes same;
    draw_share share = {lane_splat(0.0f), lane_splat(0.0f)};
    for (int i = 0; i < 4; ++i) {
        same.c[i] = draw_code(lane_splat(p->at[i]));
        is_white &= p->at[i] == 255.0f;
        channels |= (s->colour_mask >> i & 1u) != 0 ? 0xffu << 8 * i : 0;
    }
    draw_codes v = same;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t bits = draw_bits(mask, k);
        uint8_t *at = p->colour + (ptrdiff_t)(k >> 3) * p->colour_stride + 4 * (k & 7);
        lanei was = lanei_splat(0);
        if (bits == 0) {
            continue;
        }
        if (needs_share) {
            share = draw_share_at(p, k);
            v = draw_colour_of(p, &share, &same, is_white);
        }
        if (meets != DRAW_MEET_NOT || keeps || bits != (1u << LANES) - 1u) {
            was = draw_load(at, p->colour_stride);
            was = p->swaps ? draw_swap(was) : was;
        }
        lanei made = draw_met(s, &v, was, meets);
        if (keeps) {
            const lanei written = lanei_splat((int32_t)channels);
            made = lanei_or(lanei_and(made, written), lanei_and(was, lanei_sub(lanei_splat(-1), written)));
        }
        made = lanei_pick(mask_of_bits(bits), made, was);
        draw_save(at, p->colour_stride, p->swaps ? draw_swap(made) : made);
    }
}

static int32_t KERNEL(draw_row)(uint8_t *pixels, int32_t count, uint32_t codes, uint32_t share, int adds)
{
    const lanei bits = lanei_splat((int32_t)codes), shares = lanei_splat((int32_t)share);
    int32_t filled = 0;
    for (; filled + LANES <= count; filled += LANES) {
        uint8_t *at = pixels + 4 * filled;
        draw_save_row(at, draw_blend_usual(bits, shares, draw_load_row(at), adds));
    }
    return filled;
}
