/* draw_tile.c: the pixels of a shape in a tile: tests, colours, blending. Layer 4.
 *
 * Linear values are computed in binary64 at the tile's first pixel and continue in binary32 from there, so results do
 * not depend on windows or the order of tiles. The stages are loops over the pixels of a mask. */
#include "draw_part.h"

#include "../base/poly.h"
#include "../lane/kernels.h"

#if LMB_DRAW
#define TILE_LOG2_E 1.44269504f

static tile_slope tile_set(const lmb_draw_plane *p, double x, double y)
{
    tile_slope t;
    t.at = (float)(p->origin + p->x * x + p->y * y);
    t.x = (float)p->x;
    t.y = (float)p->y;
    return t;
}

/* --- tests -------------------------------------------------------------------------------------------------------- */

static uint8_t *tile_depth_place(const tile_job *j, int k)
{
    const lmb_surface *s = &j->pass->target->depth;
    const int32_t x = j->x - j->pass->target->x0 + (k & 7), y = j->y - j->pass->target->y0 + (k >> 3);
    const int32_t bytes = s->format == LMB_DEPTH16 ? 2 : 4;
    if (s->layout == LMB_TILED) {
        return (uint8_t *)s->data + (ptrdiff_t)(y >> 3) * s->stride_bytes +
               (ptrdiff_t)((x >> 3) * LMB_TILE_PIXELS + k) * bytes;
    }
    return (uint8_t *)s->data + (ptrdiff_t)y * s->stride_bytes + (ptrdiff_t)x * bytes;
}

static uint8_t *tile_stencil_place(const tile_job *j, int k)
{
    const lmb_draw_target *t = j->pass->target;
    return t->stencil + (ptrdiff_t)(j->y - t->y0 + (k >> 3)) * t->stencil_stride + (j->x - t->x0 + (k & 7));
}

static float tile_depth(const tile_job *j, int k)
{
    const lmb_draw_shape *s = j->shape;
    const float d = minf(maxf(tile_at(&j->d, k), s->d_min), s->d_max);
    return s->d_add == 0.0f ? d : minf(maxf(d + s->d_add, 0.0f), 1.0f);
}

/* Returns 1 if pixel k passes, and stores its depth. */
static int tile_depth_test(const tile_job *j, int k)
{
    const lmb_draw_state *s = j->pass->state;
    const int writes = (s->flags & LMB_DRAW_DEPTH_WRITE) != 0;
    const float d = tile_depth(j, k);
    if (j->pass->target->depth.format == LMB_DEPTH16) {
        uint16_t *was = (uint16_t *)(void *)tile_depth_place(j, k);
        const int32_t code = (int32_t)maxf(minf(65535.0f, d * j->pass->depth_scale + j->pass->depth_bias), 0.0f);
        const int passes = draw_passes(s->depth_func, code, *was);
        *was = passes && writes ? (uint16_t)code : *was;
        return passes;
    }
    float *was = (float *)(void *)tile_depth_place(j, k);
    const int passes = (s->depth_func & (d < *was    ? LMB_DRAW_LESS
                                         : d == *was ? LMB_DRAW_EQUAL
                                                     : LMB_DRAW_GREATER)) != 0;
    if (passes && writes) {
        *was = d;
    }
    return passes;
}

static void tile_stencil_change(const lmb_draw_state *s, uint8_t *at, int op)
{
    uint32_t v = *at;
    switch (op) {
    case LMB_DRAW_CLEAR:
        v = 0;
        break;
    case LMB_DRAW_PUT:
        v = s->stencil_value;
        break;
    case LMB_DRAW_INCREASE:
        v = v < 255 ? v + 1 : v;
        break;
    case LMB_DRAW_DECREASE:
        v = v > 0 ? v - 1 : v;
        break;
    case LMB_DRAW_INVERT:
        v = ~v;
        break;
    case LMB_DRAW_INCREASE_WRAP:
        v = v + 1;
        break;
    case LMB_DRAW_DECREASE_WRAP:
        v = v - 1;
        break;
    default:
        return;
    }
    *at = (uint8_t)((*at & ~(uint32_t)s->stencil_write) | (v & s->stencil_write));
}

/* Stencil, then depth. */
static int tile_test(const tile_job *j, int k)
{
    const lmb_draw_state *s = j->pass->state;
    const int depth = (s->flags & LMB_DRAW_DEPTH_TEST) != 0;
    if (!DRAW_FULL || (s->flags & LMB_DRAW_STENCIL) == 0) {
        return !depth || tile_depth_test(j, k);
    }
    uint8_t *at = tile_stencil_place(j, k);
    if (!draw_passes(s->stencil_func, s->stencil_value & s->stencil_mask, *at & s->stencil_mask)) {
        tile_stencil_change(s, at, s->stencil_op[0]);
        return 0;
    }
    const int passes = !depth || tile_depth_test(j, k);
    tile_stencil_change(s, at, s->stencil_op[passes ? 2 : 1]);
    return passes;
}

static uint64_t tile_tests(const tile_job *j, uint64_t mask)
{
    uint64_t out = mask;
    for (uint64_t bits = j->pass->tests ? mask : 0; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        if (!tile_test(j, k)) {
            out &= ~((uint64_t)1 << k);
        }
    }
    return out;
}

/* --- colours ------------------------------------------------------------------------------------------------------ */

/* A pixel's shares of corners 1 and 2, and 1 / q. */
typedef struct tile_share {
    float b1, b2, inverse;
} tile_share;

static tile_share tile_find_share(const tile_job *j, int k)
{
    tile_share s = {0.0f, 0.0f, 1.0f};
    if (j->shape->corners == 1) {
        return s;
    }
    s.b1 = tile_at(&j->n1, k);
    s.b2 = tile_at(&j->n2, k);
    if (!j->shape->is_even) {
        const float q = tile_at(&j->q, k);
        s.inverse = q > 1e-30f ? 1.0f / q : 0.0f;
        s.b1 *= s.inverse;
        s.b2 *= s.inverse;
    }
    s.b1 = minf(maxf(s.b1, 0.0f), 1.0f);
    s.b2 = minf(maxf(s.b2, 0.0f), 1.0f);
    return s;
}

/* Code of a value 0 .. 255. */
static uint8_t tile_code(float v) { return (uint8_t)(minf(maxf(v, 0.0f), 255.0f) + 0.5f); }

/* The squared change of texel coordinates if the shares change by d1 and d2. */
static float tile_texels(const tile_job *j, const lmb_texture *t, int uv, float d1, float d2)
{
    const lmb_draw_corner *const *c = j->shape->corner;
    const float u = d1 * (c[1]->v[uv] - c[0]->v[uv]) + d2 * (c[2]->v[uv] - c[0]->v[uv]);
    const float v = d1 * (c[1]->v[uv + 1] - c[0]->v[uv + 1]) + d2 * (c[2]->v[uv + 1] - c[0]->v[uv + 1]);
    const float x = u * (float)t->width, y = v * (float)t->height;
    return x * x + y * y;
}

/* Level of a trilinear sample, in 1/256 levels: log2 of the larger change of texel coordinates per px. */
static int32_t tile_level(const tile_job *j, const lmb_draw_stage *stage, int uv, const tile_share *s)
{
    const lmb_texture *t = stage->texture;
    float x1 = j->n1.x, x2 = j->n2.x, y1 = j->n1.y, y2 = j->n2.y;
    if (t->filter != LMB_TRILINEAR || t->levels < 2) {
        return 0;
    }
    if (!j->shape->is_even) {
        x1 = (x1 - s->b1 * j->q.x) * s->inverse;
        x2 = (x2 - s->b2 * j->q.x) * s->inverse;
        y1 = (y1 - s->b1 * j->q.y) * s->inverse;
        y2 = (y2 - s->b2 * j->q.y) * s->inverse;
    }
    const float square = maxf(tile_texels(j, t, uv, x1, x2), tile_texels(j, t, uv, y1, y2));
    const float level = 0.5f * lmb_log2(square) + stage->level_bias;
    return (int32_t)(minf(maxf(level, 0.0f), (float)(t->levels - 1)) * 256.0f);
}

static void tile_combine(uint8_t c[4], const lmb_draw_stage *stage, const uint8_t t[4])
{
    for (int i = 0; i < 3; ++i) {
        switch (stage->mode) {
        case LMB_DRAW_REPLACE:
            c[i] = t[i];
            break;
        case LMB_DRAW_DECAL:
            c[i] = (uint8_t)draw_between(t[i], c[i], t[3]);
            break;
        case LMB_DRAW_MIX:
            c[i] = (uint8_t)draw_between(stage->colour[i], c[i], t[i]);
            break;
        case LMB_DRAW_PLUS:
            c[i] = (uint8_t)mini(c[i] + t[i], 255);
            break;
        default:
            c[i] = (uint8_t)draw_times(c[i], t[i]);
            break;
        }
    }
    if (stage->mode == LMB_DRAW_REPLACE) {
        c[3] = t[3];
    } else if (stage->mode != LMB_DRAW_DECAL) {
        c[3] = (uint8_t)draw_times(c[3], t[3]);
    }
}

/* Share of the colour that fog leaves, 0 .. 255. */
static uint8_t tile_fog(const lmb_draw_state *s, float c)
{
    const float thick = s->fog_density * c;
    switch (s->fog) {
    case LMB_DRAW_FOG_LINEAR:
        return tile_code((s->fog_end - c) / (s->fog_end - s->fog_start) * 255.0f);
    case LMB_DRAW_FOG_EXP:
        return tile_code(lmb_exp2(-thick * TILE_LOG2_E) * 255.0f);
    default:
        return tile_code(lmb_exp2(-(thick * thick) * TILE_LOG2_E) * 255.0f);
    }
}

/* Applies all stages to a colour. */
static void tile_stages(uint8_t inout[4], const tile_job *j, const tile_share *share)
{
    const lmb_draw_stage *stage = j->pass->state->stage;
    uint8_t texel[LMB_DRAW_STAGES][4];
    const uint8_t first[4] = {inout[0], inout[1], inout[2], inout[3]};
    for (int i = 0; i < LMB_DRAW_STAGES; ++i) {
        const int uv = CORNER_UV + 2 * i;
        if (stage[i].texture != NULL) {
            lmb_draw_texel(texel[i], stage[i].texture, draw_value(j->shape, uv, share->b1, share->b2),
                           draw_value(j->shape, uv + 1, share->b1, share->b2), tile_level(j, &stage[i], uv, share));
        } else {
            texel[i][0] = texel[i][1] = texel[i][2] = texel[i][3] = 255;
        }
    }
    for (int i = 0; i < LMB_DRAW_STAGES; ++i) {
        if (DRAW_FULL && stage[i].texture != NULL && stage[i].mode == LMB_DRAW_COMBINE) {
            lmb_draw_combine_codes(inout, j->pass->state, i, first, (const uint8_t(*)[4])texel);
        } else if (stage[i].texture != NULL) {
            tile_combine(inout, &stage[i], texel[i]);
        }
    }
}

static void tile_colour(uint8_t out[4], const tile_job *j, int k)
{
    const lmb_draw_state *s = j->pass->state;
    const tile_share share = tile_find_share(j, k);
    const int adds = j->pass->vertices->seconds != NULL || j->pass->vertices->back_seconds != NULL;
    for (int i = 0; i < 4; ++i) {
        out[i] = tile_code(draw_value(j->shape, CORNER_RED + i, share.b1, share.b2));
    }
    tile_stages(out, j, &share);
    for (int i = 0; DRAW_FULL && i < 3 && adds; ++i) {
        const uint8_t second = tile_code(draw_value(j->shape, CORNER_SECOND + i, share.b1, share.b2));
        out[i] = (uint8_t)mini(out[i] + second, 255);
    }
    if (DRAW_FULL && s->fog != LMB_DRAW_FOG_NONE) {
        const uint8_t left = tile_fog(s, draw_value(j->shape, CORNER_FOG, share.b1, share.b2));
        for (int i = 0; i < 3; ++i) {
            out[i] = (uint8_t)draw_between(out[i], s->fog_colour[i], left);
        }
    }
}

#if !LMB_DRAW_SMALL
/* Converts shares of the shape's corners to shares of the primitive's vertices. */
static void tile_find_shares(float out[2], const lmb_draw_shape *s, float b1, float b2)
{
    const lmb_draw_corner *const *c = s->corner;
    for (int i = 0; i < 2; ++i) {
        const int v = CORNER_SHARE + i;
        out[i] = b1 * (c[1]->v[v] - c[0]->v[v]) + b2 * (c[2]->v[v] - c[0]->v[v]);
    }
}

static void tile_no_fragment(lmb_draw_fragment_at *out)
{
    if (out != NULL) {
        memset(out, 0, sizeof *out);
    }
}

void lmb_draw_fragment(lmb_draw_fragment_at *out, const lmb_draw_pixels_of *pixels, int32_t k)
{
    const tile_job *j = pixels != NULL && k >= 0 && k < LMB_TILE_PIXELS ? (const tile_job *)pixels->job : NULL;
    if (j == NULL || out == NULL) {
        tile_no_fragment(out);
        return;
    }
    const tile_share s = tile_find_share(j, k);
    float x1 = j->n1.x, x2 = j->n2.x, y1 = j->n1.y, y2 = j->n2.y;
    if (!j->shape->is_even) {
        x1 = (x1 - s.b1 * j->q.x) * s.inverse;
        x2 = (x2 - s.b2 * j->q.x) * s.inverse;
        y1 = (y1 - s.b1 * j->q.y) * s.inverse;
        y2 = (y2 - s.b2 * j->q.y) * s.inverse;
    }
    tile_find_shares(out->share, j->shape, s.b1, s.b2);
    out->share[0] += j->shape->corner[0]->v[CORNER_SHARE];
    out->share[1] += j->shape->corner[0]->v[CORNER_SHARE + 1];
    tile_find_shares(out->by_x, j->shape, x1, x2);
    tile_find_shares(out->by_y, j->shape, y1, y2);
}

void lmb_draw_shares(float out[2][LMB_TILE_PIXELS], const lmb_draw_pixels_of *pixels)
{
    const tile_job *j = pixels != NULL ? (const tile_job *)pixels->job : NULL;
    if (j == NULL || out == NULL) {
        return;
    }
#if LMB_DRAW_LANES
    if (lmb_draw_lanes_shares(out, j, pixels->mask)) {
        return;
    }
#endif
    for (uint64_t bits = pixels->mask; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const tile_share s = tile_find_share(j, k);
        float share[2];
        tile_find_shares(share, j->shape, s.b1, s.b2);
        out[0][k] = share[0] + j->shape->corner[0]->v[CORNER_SHARE];
        out[1][k] = share[1] + j->shape->corner[0]->v[CORNER_SHARE + 1];
    }
}

void lmb_draw_steps(float by_x[2][LMB_TILE_PIXELS], float by_y[2][LMB_TILE_PIXELS], const lmb_draw_pixels_of *pixels)
{
    const tile_job *j = pixels != NULL ? (const tile_job *)pixels->job : NULL;
    if (j == NULL || by_x == NULL || by_y == NULL) {
        return;
    }
#if LMB_DRAW_LANES
    if (lmb_draw_lanes_steps(by_x, by_y, j, pixels->mask)) {
        return;
    }
#endif
    for (uint64_t bits = pixels->mask; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        lmb_draw_fragment_at at;
        lmb_draw_fragment(&at, pixels, k);
        for (int i = 0; i < 2; ++i) {
            by_x[i][k] = at.by_x[i];
            by_y[i][k] = at.by_y[i];
        }
    }
}

/* The same for pixels that the caller's shader colours. */
static uint64_t tile_shade(uint8_t colour[LMB_TILE_PIXELS][4], const tile_job *j, uint64_t mask)
{
    const lmb_draw_state *s = j->pass->state;
    lmb_draw_pixels_of p;
    p.job = j;
    for (int i = 0; i < 3; ++i) {
        p.vertex[i] = j->pass->now->vertex[i];
    }
    p.x = j->x;
    p.y = j->y;
    p.is_back = j->pass->now->is_back;
    p.mask = mask;
    return s->shader(s->shader_user, &p, colour) & mask;
}
#endif

/* Colours the mask's pixels. Returns those that pass the alpha test. */
static uint64_t tile_colours(uint8_t colour[LMB_TILE_PIXELS][4], const tile_job *j, uint64_t mask)
{
    const lmb_draw_state *s = j->pass->state;
    const int tests = (s->flags & LMB_DRAW_ALPHA_TEST) != 0;
#if !LMB_DRAW_SMALL
    mask = s->shader != NULL && mask != 0 ? tile_shade(colour, j, mask) : mask;
#endif
    for (uint64_t bits = DRAW_FULL && s->shader != NULL && !tests ? 0 : mask; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        if (!DRAW_FULL || s->shader == NULL) {
            tile_colour(colour[k], j, k);
        }
        if (tests && !draw_passes(s->alpha_func, colour[k][3], s->alpha_value)) {
            mask &= ~((uint64_t)1 << k);
        }
    }
    return mask;
}

/* --- blending ----------------------------------------------------------------------------------------------------- */

/* The factor of channel i, 0 .. 255. */
static uint32_t tile_factor(const lmb_draw_state *s, int factor, const uint8_t source[4], const uint8_t target[4],
                            int i)
{
    switch (factor) {
    case LMB_DRAW_ZERO:
        return 0;
    case LMB_DRAW_ONE:
        return 255;
    case LMB_DRAW_SOURCE_COLOUR:
        return source[i];
    case LMB_DRAW_INVERSE_SOURCE_COLOUR:
        return 255u - source[i];
    case LMB_DRAW_SOURCE_ALPHA:
        return source[3];
    case LMB_DRAW_INVERSE_SOURCE_ALPHA:
        return 255u - source[3];
    case LMB_DRAW_TARGET_ALPHA:
        return target[3];
    case LMB_DRAW_INVERSE_TARGET_ALPHA:
        return 255u - target[3];
    case LMB_DRAW_TARGET_COLOUR:
        return target[i];
    case LMB_DRAW_INVERSE_TARGET_COLOUR:
        return 255u - target[i];
    case LMB_DRAW_SATURATE:
        return i == 3 ? 255u : (uint32_t)mini(source[3], 255 - target[3]);
    case LMB_DRAW_CONSTANT_COLOUR:
        return s->blend_colour[i];
    case LMB_DRAW_INVERSE_CONSTANT_COLOUR:
        return 255u - s->blend_colour[i];
    case LMB_DRAW_CONSTANT_ALPHA:
        return s->blend_colour[3];
    default:
        return 255u - s->blend_colour[3];
    }
}

static uint8_t tile_blend(const lmb_draw_state *s, const uint8_t source[4], const uint8_t target[4], int i)
{
    const int alpha = i == 3, equation = s->blend_equation[alpha];
    if (equation == LMB_DRAW_MIN || equation == LMB_DRAW_MAX) {
        return (source[i] < target[i]) == (equation == LMB_DRAW_MIN) ? source[i] : target[i];
    }
    const int32_t a = (int32_t)(source[i] * tile_factor(s, s->blend_source[alpha], source, target, i));
    const int32_t b = (int32_t)(target[i] * tile_factor(s, s->blend_target[alpha], source, target, i));
    const int32_t sum = equation == LMB_DRAW_ADD ? a + b : equation == LMB_DRAW_SUBTRACT ? a - b : b - a;
    return (uint8_t)((clampi(sum, 0, 255 * 255) + 127) / 255);
}

/* Combines the source's and the target's bits. */
static uint32_t tile_logic(uint32_t op, uint32_t source, uint32_t target)
{
    return ((op & 1u) != 0 ? source & target : 0) | ((op & 2u) != 0 ? source & ~target : 0) |
           ((op & 4u) != 0 ? ~source & target : 0) | ((op & 8u) != 0 ? ~source & ~target : 0);
}

static void tile_store(const tile_job *j, int k, const uint8_t colour[4])
{
    const lmb_draw_state *s = j->pass->state;
    const lmb_draw_target *t = j->pass->target;
    const int32_t x = j->x + (k & 7), y = j->y + (k >> 3), format = t->colour.format;
    uint8_t *at = (uint8_t *)t->colour.data + (ptrdiff_t)(y - t->y0) * t->colour.stride_bytes +
                  (ptrdiff_t)(x - t->x0) * lmb_pixel_bytes(format);
    const int dithers = (s->flags & LMB_DRAW_DITHER) != 0, logic = DRAW_FULL && (s->flags & LMB_DRAW_LOGIC) != 0;
    uint32_t channels = s->colour_mask, bits;
    const uint32_t was = lmb_draw_pixel_bits(format, at);
    if ((s->flags & LMB_DRAW_BLEND) != 0 && !logic) {
        uint8_t target[4], made[4];
        lmb_draw_read_pixel(target, format, at);
        for (int i = 0; i < 4; ++i) {
            made[i] = tile_blend(s, colour, target, i);
            channels &= ~((uint32_t)(made[i] == target[i]) << i);
        }
        bits = lmb_draw_pixel_of(format, made, dithers, x, y);
    } else {
        bits = lmb_draw_pixel_of(format, colour, dithers, x, y);
        bits = logic ? tile_logic(s->logic_op, bits, was) : bits;
    }
    const uint32_t mask = lmb_draw_pixel_mask(format, channels);
    lmb_draw_put_bits(format, at, (was & ~mask) | (bits & mask));
}

/* 1: colours replace pixels of four bytes. */
static int tile_is_copied(const lmb_draw_pass *pass)
{
    const lmb_draw_state *s = pass->state;
    const int32_t format = pass->target->colour.format;
    return (s->flags & (LMB_DRAW_BLEND | LMB_DRAW_LOGIC)) == 0 && s->colour_mask == 15 &&
           (format == LMB_RGBA8 || format == LMB_BGRA8);
}

/* Stores colours if tile_is_copied. */
static void tile_store_all(const tile_job *j, uint64_t mask, uint8_t colour[LMB_TILE_PIXELS][4])
{
    const lmb_surface *to = &j->pass->target->colour;
    uint8_t *row = (uint8_t *)to->data + (ptrdiff_t)(j->y - j->pass->target->y0) * to->stride_bytes +
                   (ptrdiff_t)(j->x - j->pass->target->x0) * 4;
    const int swaps = to->format == LMB_BGRA8 ? 2 : 0;
    for (int i = 0; i < LMB_TILE && !swaps; ++i) {
        const uint64_t bits = (uint64_t)0xffu << LMB_TILE * i;
        if ((mask & bits) == bits) {
            memcpy(row + (ptrdiff_t)i * to->stride_bytes, colour[LMB_TILE * i], 4 * LMB_TILE);
            mask &= ~bits;
        }
    }
    for (; mask != 0; mask &= mask - 1) {
        const int k = lowest_bit_64(mask);
        const uint8_t *c = colour[k], code[4] = {c[swaps], c[1], c[2 - swaps], c[3]};
        memcpy(row + (ptrdiff_t)(k >> 3) * to->stride_bytes + 4 * (k & 7), code, 4);
    }
}

/* --- a tile ------------------------------------------------------------------------------------------------------- */

/* The pixels of a tile that may be drawn. */
static uint64_t tile_inside(const lmb_draw_pass *p, int32_t x, int32_t y)
{
    const int32_t x0 = maxi(p->x0 - x, 0), x1 = mini(p->x1 - x, LMB_TILE - 1);
    const int32_t y0 = maxi(p->y0 - y, 0), y1 = mini(p->y1 - y, LMB_TILE - 1);
    uint64_t mask = 0;
    if (x0 > x1 || y0 > y1) {
        return 0;
    }
    const uint64_t row = (uint64_t)((0xffu >> (7 - x1)) & (0xffu << x0) & 0xffu);
    for (int32_t i = y0; i <= y1; ++i) {
        mask |= row << (i * LMB_TILE);
    }
    return mask;
}

/* The pixels that a pattern of 32 x 32 px keeps. */
static uint64_t tile_pattern(const uint8_t *pattern, int32_t x, int32_t y)
{
    const uint8_t *at = pattern + 4 * (y & 31) + (x >> 3 & 3);
    uint64_t mask = 0;
    for (int i = 0; i < LMB_TILE; ++i) {
        mask |= (uint64_t)at[4 * i] << (LMB_TILE * i);
    }
    return mask;
}

static void tile_count(const lmb_draw_pass *pass, uint64_t mask)
{
    for (uint64_t bits = DRAW_FULL && pass->state->passed != NULL ? mask : 0; bits != 0; bits &= bits - 1) {
        ++*pass->state->passed;
    }
}

/* Tests first, unless the tests need colours. */
NOINLINE void tile_draw_tested(const tile_job *j, uint64_t mask)
{
    uint8_t colour[LMB_TILE_PIXELS][4];
    mask = tile_colours(colour, j, mask);
    if (j->pass->paints_first) {
        mask = tile_tests(j, mask);
    }
    tile_count(j->pass, mask);
#if LMB_DRAW_LANES
    if (j->pass->shows && lmb_draw_lanes_put(j, (const uint8_t(*)[4])colour, mask)) {
        return;
    }
#endif
    if (DRAW_FULL && j->pass->shows && tile_is_copied(j->pass)) {
        tile_store_all(j, mask, colour);
        return;
    }
    for (uint64_t bits = j->pass->shows ? mask : 0; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        tile_store(j, k, colour[k]);
    }
}

/* Tests before colours. Tests after colours take too much stack with lmb_draw_stencil. */
static inline uint64_t tile_test_all(const tile_job *j, uint64_t mask)
{
#if LMB_DRAW_LANES
    if (lmb_draw_rows_stencils(j)) {
        return lmb_draw_stencil(j, mask);
    }
#endif
    return DRAW_FULL && j->pass->tests_rows ? lmb_draw_rows_test(j, mask) : tile_tests(j, mask);
}

void lmb_draw_tile(const lmb_draw_pass *pass, lmb_draw_shape *shape, int32_t x, int32_t y, uint64_t mask)
{
    const double at_x = (x * 256 + 128 - pass->middle_x) * (1.0 / 256.0),
                 at_y = (y * 256 + 128 - pass->middle_y) * (1.0 / 256.0);
    tile_job j;
    if (x < pass->x0 || y < pass->y0 || x + LMB_TILE - 1 > pass->x1 || y + LMB_TILE - 1 > pass->y1) {
        mask &= tile_inside(pass, x, y);
    }
    if (DRAW_FULL && shape->corners == 3 && pass->state->area_pattern != NULL) {
        mask &= tile_pattern(pass->state->area_pattern, x, y);
    }
    if (mask == 0) {
        return;
    }
    j.pass = pass;
    j.shape = shape;
    j.x = x;
    j.y = y;
    if (pass->tests) {
        j.d = tile_set(&shape->d, at_x, at_y);
    }
    if (!pass->paints_first) {
        mask = tile_test_all(&j, mask);
    }
    if (mask == 0 || (!pass->shows && !pass->paints_first)) {
        tile_count(pass, mask);
        return;
    }
    if (DRAW_FULL && shape->late != NULL) {
        lmb_draw_finish(pass, shape);
    }
    j.n1 = tile_set(&shape->n1, at_x, at_y);
    j.n2 = tile_set(&shape->n2, at_x, at_y);
    if (!shape->is_even) {
        j.q = tile_set(&shape->q, at_x, at_y);
    }
#if LMB_DRAW_LANES
    if (lmb_draw_lanes_paint(&j, mask)) {
        return;
    }
#endif
    if (DRAW_FULL && pass->paints_rows) {
        lmb_draw_rows_paint(&j, mask);
    } else {
        tile_draw_tested(&j, mask);
    }
}
#endif
