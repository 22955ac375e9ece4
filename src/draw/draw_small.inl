/* draw_small.inl: many triangles of at most 8 x 8 pixels: set up LANES at a time, then drawn one by one. Layer 4.
 *
 * Values equal those of draw_quick.c, draw_late.c and draw_tile.c. A linear value starts at the first pixel of the tile
 * that a pixel lies in. A box of 8 x 8 pixels touches four tiles at most, so it has four starts. Sixteen
 * lanes use the kernel of eight. */

#include "../base/vertex.h"

#if !defined(LANE_PLAIN) && LANES <= LMB_TILE /* sixteen lanes take 5 KiB of stack, and are no faster */
enum { SMALL_24_8 = 16 * 256 /* largest side of a triangle's box, so that its edges fit 32 bits */ };
#define SMALL_LEAST_W 2e-12f /* twice the least w of draw_quick.c */
#define SMALL_MOST_W  1e20f
#define SMALL_PLACE   1048576.0f /* as is_place */

/* Corners of the triangles. */
typedef struct small_corner {
    lanei x, y; /* 24.8 from the viewport's centre */
    lane d, inverse;
    lane_mask in; /* draw_quick.c would not clip it */
} small_corner;

/* A linear value of each triangle: at the first pixels of the tile of pixel (x, y), of the tiles to the right, below,
 * and right below, and per px. */
typedef struct small_plane {
    float at[4][LANES], x[LANES], y[LANES];
} small_plane;

/* Triangles to be drawn. Edges are at pixel (x, y) of the box. box: bytes of the first and last column, and of the last
 * row, from there. */
typedef struct small_setup {
    int32_t e[3][LANES], ex[3][LANES], ey[3][LANES];
    int32_t x[LANES], y[LANES], box[LANES];
    float low[LANES], high[LANES];
    small_plane d, n1, n2, q;
    uint32_t back;   /* corners 1 and 2 are not swapped */
    uint32_t varies; /* the corners have different colours: n1, n2 and q are set */
    int is_even;     /* q is 1 for all */
    uint32_t codes[LANES]; /* colour of the last corner */
    uint32_t first;        /* triangle of the batch in lane 0 */
} small_setup;

LANE_INLINE lane small_row(const float *m, const lane p[4])
{
    const lane xy = lane_add(lane_mul(lane_splat(m[0]), p[0]), lane_mul(lane_splat(m[4]), p[1]));
    return lane_add(lane_add(xy, lane_mul(lane_splat(m[8]), p[2])), lane_mul(lane_splat(m[12]), p[3]));
}

LANE_INLINE lanei small_to_24_8(lane v)
{
    const lanei whole = lane_to_int(v);
    return lanei_add(whole, lanei_pick(lane_lt(v, lane_from_int(whole)), lanei_splat(-1), lanei_splat(0)));
}

LANE_PART void small_place(small_corner *out, const lmb_draw_small *b, uint32_t first, int k)
{
    const float *m = b->state->to_clip.m, *range = b->state->depth_range;
    const lanei at = lanei_load(b->at[k] + first);
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), half = lane_splat(0.5f);
    lane p[4];
    lane_mask in;
    if (b->floats == 4) {
        lane_gather_rgba_f32(p, b->positions, at);
        in = mask_of_bits(~0u);
    } else {
        const lanei from = lanei_mul(at, lanei_splat(3));
        const lane limit = lane_splat(SMALL_PLACE);
        for (int i = 0; i < 3; ++i) {
            p[i] = lane_gather_f32(b->positions + i, from);
        }
        p[3] = one;
        in = mask_and(mask_and(lane_lt(lane_abs(p[0]), limit), lane_lt(lane_abs(p[1]), limit)),
                      lane_lt(lane_abs(p[2]), limit));
    }
    const lane x = small_row(m, p), y = small_row(m + 1, p), z = small_row(m + 2, p), w = small_row(m + 3, p);
    in = mask_and(in, mask_and(lane_le(lane_splat(SMALL_LEAST_W), w), lane_lt(w, lane_splat(SMALL_MOST_W))));
    in = mask_and(in, mask_and(lane_le(z, w), lane_le(zero, z)));
    in = mask_and(in, mask_and(lane_le(lane_abs(x), lane_mul(lane_splat(b->guard_x), w)),
                               lane_le(lane_abs(y), lane_mul(lane_splat(b->guard_y), w))));
    out->in = in;
    out->inverse = lane_div(one, w);
    const lane d = lane_hold(lane_mul(z, out->inverse), zero, one);
    const int is_usual = range[0] == 0.0f && range[1] == 1.0f;
    out->d = is_usual ? d : lane_add(lane_splat(range[0]), lane_mul(lane_splat(range[1] - range[0]), d));
    out->x = small_to_24_8(lane_add(lane_mul(lane_mul(x, out->inverse), lane_splat(b->snap_x)), half));
    out->y = small_to_24_8(lane_sub(half, lane_mul(lane_mul(y, out->inverse), lane_splat(b->snap_y))));
}

/* Triangles with texture coordinates that draw_quick.c takes. */
LANE_PART lane_mask small_sane(const lmb_draw_small *b, uint32_t first)
{
    const lane limit = lane_splat(SMALL_PLACE);
    lane_mask sane = mask_of_bits(~0u);
    for (int k = 0; k < 3; ++k) {
        const lanei from = lanei_mul(lanei_load(b->at[k] + first), lanei_splat(2));
        sane = mask_and(sane, mask_and(lane_lt(lane_abs(lane_gather_f32(b->uvs, from)), limit),
                                       lane_lt(lane_abs(lane_gather_f32(b->uvs + 1, from)), limit)));
    }
    return sane;
}

LANE_INLINE laned small_difference(lanei a, lanei b) { return laned_sub(laned_from_int(a), laned_from_int(b)); }

/* --- setup -------------------------------------------------------------------------------------------------------- */

typedef struct small_linear {
    laned origin, x, y;
} small_linear;

/* Starts as in draw_tile.c. */
LANE_PART void small_set_plane(small_plane *out, const small_setup *s, const lmb_draw_small *b, const small_linear *p)
{
    const laned px = laned_splat(1.0 / 256.0), tile = laned_splat((double)LMB_TILE);
    const lanei first = lanei_splat(~7), by = lanei_splat(256);
    const lanei left = lanei_mul(lanei_and(lanei_load(s->x), first), by),
                top = lanei_mul(lanei_and(lanei_load(s->y), first), by);
    laned x = laned_mul(laned_from_int(lanei_add(left, lanei_splat(128 - b->middle_x))), px);
    const laned y = laned_mul(laned_from_int(lanei_add(top, lanei_splat(128 - b->middle_y))), px),
                above = laned_mul(p->y, y), below = laned_mul(p->y, laned_add(y, tile));
    for (int i = 0; i < 2; ++i, x = laned_add(x, tile)) {
        const laned at = laned_add(p->origin, laned_mul(p->x, x));
        lane_store(out->at[i], lane_from_double(laned_add(at, above)));
        lane_store(out->at[2 + i], lane_from_double(laned_add(at, below)));
    }
    lane_store(out->x, lane_from_double(p->x));
    lane_store(out->y, lane_from_double(p->y));
}

/* As quick_set_depth. */
LANE_PART void small_set_depth(small_setup *s, const lmb_draw_small *b, const small_corner c[3], laned by_area)
{
    const laned bx = small_difference(c[1].x, c[0].x), by = small_difference(c[1].y, c[0].y),
                cx = small_difference(c[2].x, c[0].x), cy = small_difference(c[2].y, c[0].y);
    const laned d0 = laned_from(c[0].d), bd = laned_sub(laned_from(c[1].d), d0), cd = laned_sub(laned_from(c[2].d), d0);
    const laned per_px = laned_mul(laned_splat(256.0), by_area), px = laned_splat(1.0 / 256.0);
    small_linear p;
    p.x = laned_mul(laned_sub(laned_mul(bd, cy), laned_mul(cd, by)), per_px);
    p.y = laned_mul(laned_sub(laned_mul(cd, bx), laned_mul(bd, cx)), per_px);
    p.origin = laned_sub(laned_sub(d0, laned_mul(p.x, laned_mul(laned_from_int(c[0].x), px))),
                         laned_mul(p.y, laned_mul(laned_from_int(c[0].y), px)));
    small_set_plane(&s->d, s, b, &p);
    lane_store(s->low, lane_min(c[0].d, lane_min(c[1].d, c[2].d)));
    lane_store(s->high, lane_max(c[0].d, lane_max(c[1].d, c[2].d)));
}

/* As quick_edge of draw_late.c. */
LANE_PART void small_edge_plane(small_linear *out, const small_corner *from, const small_corner *to, laned by_area)
{
    const laned ex = small_difference(from->y, to->y), ey = small_difference(to->x, from->x), px = laned_splat(256.0);
    const laned at = laned_add(laned_mul(ex, laned_from_int(from->x)), laned_mul(ey, laned_from_int(from->y)));
    out->origin = laned_mul(laned_sub(laned_splat(0.0), at), by_area);
    out->x = laned_mul(laned_mul(ex, px), by_area);
    out->y = laned_mul(laned_mul(ey, px), by_area);
}

LANE_INLINE laned small_mixed(laned n1, laned n2, laned more1, laned more2)
{
    return laned_add(laned_mul(n1, more1), laned_mul(n2, more2));
}

/* by: 1 for triangles without perspective, so that these keep the plane. */
LANE_INLINE void small_scale(small_linear *p, lane by)
{
    const laned wide = laned_from(by);
    p->origin = laned_mul(p->origin, wide);
    p->x = laned_mul(p->x, wide);
    p->y = laned_mul(p->y, wide);
}

/* As lmb_draw_finish. Triangles without perspective have q = 1, which changes no share. */
LANE_PART void small_set_shares(small_setup *s, const lmb_draw_small *b, const small_corner c[3], laned by_area)
{
    const lane one = lane_splat(1.0f), zero = lane_splat(0.0f), i0 = c[0].inverse, i1 = c[1].inverse, i2 = c[2].inverse;
    const lane_mask uneven =
        mask_or(mask_or(lane_lt(i0, i1), lane_lt(i1, i0)), mask_or(lane_lt(i0, i2), lane_lt(i2, i0)));
    small_linear n1, n2, q;
    small_edge_plane(&n1, &c[2], &c[0], by_area);
    small_edge_plane(&n2, &c[0], &c[1], by_area);
    s->is_even = mask_bits(uneven) == 0;
    if (!s->is_even) {
        const laned all = laned_from(lane_pick(uneven, i0, one)), more1 = laned_sub(laned_from(i1), laned_from(i0)),
                    more2 = laned_sub(laned_from(i2), laned_from(i0));
        const laned held1 = laned_mul(more1, laned_from(lane_pick(uneven, one, zero))),
                    held2 = laned_mul(more2, laned_from(lane_pick(uneven, one, zero)));
        q.origin = laned_add(all, small_mixed(n1.origin, n2.origin, held1, held2));
        q.x = small_mixed(n1.x, n2.x, held1, held2);
        q.y = small_mixed(n1.y, n2.y, held1, held2);
        small_set_plane(&s->q, s, b, &q);
        small_scale(&n1, lane_pick(uneven, i1, one));
        small_scale(&n2, lane_pick(uneven, i2, one));
    }
    small_set_plane(&s->n1, s, b, &n1);
    small_set_plane(&s->n2, s, b, &n2);
}

/* Sets codes and varies. */
LANE_PART void small_set_colours(small_setup *s, const lmb_draw_small *b, uint32_t first)
{
    const int is_flat = (b->state->flags & LMB_DRAW_FLAT) != 0;
    s->varies = 0;
    if (b->colours == NULL) {
        uint32_t codes;
        memcpy(&codes, b->state->colour, sizeof codes);
        lanei_store((int32_t *)s->codes, lanei_splat((int32_t)codes));
        return;
    }
    const lanei last = lanei_gather_rgba(b->colours, lanei_load(b->at[is_flat ? 3 : 2] + first));
    lanei_store((int32_t *)s->codes, last);
    for (int k = 0; k < 2 && !is_flat; ++k) {
        const lanei other = lanei_gather_rgba(b->colours, lanei_load(b->at[k] + first));
        s->varies |= mask_bits(mask_not(lanei_equal(other, last)));
    }
    s->varies &= ALL_LANES;
}

/* The edge from a to b. */
LANE_PART void small_set_edge(small_setup *s, const lmb_draw_small *b, int i, const small_corner *from,
                              const small_corner *to)
{
    const lanei zero = lanei_splat(0), one = lanei_splat(1);
    const lanei ex = lanei_sub(from->y, to->y), ey = lanei_sub(to->x, from->x);
    const lane_mask owns = mask_or(lanei_lt(zero, ex), mask_and(lanei_equal(ex, zero), lanei_lt(zero, ey)));
    const lanei x = lanei_add(lanei_mul(lanei_load(s->x), lanei_splat(256)), lanei_splat(128 - b->middle_x)),
                y = lanei_add(lanei_mul(lanei_load(s->y), lanei_splat(256)), lanei_splat(128 - b->middle_y));
    const lanei e = lanei_add(lanei_mul(ex, lanei_sub(x, from->x)), lanei_mul(ey, lanei_sub(y, from->y)));
    lanei_store(s->e[i], lanei_shift(lanei_sub(e, lanei_pick(owns, zero, one)), 8));
    lanei_store(s->ex[i], ex);
    lanei_store(s->ey[i], ey);
}

LANE_INLINE void small_pick(small_corner *out, lane_mask m, const small_corner *a, const small_corner *b)
{
    out->x = lanei_pick(m, a->x, b->x);
    out->y = lanei_pick(m, a->y, b->y);
    out->d = lane_pick(m, a->d, b->d);
    out->inverse = lane_pick(m, a->inverse, b->inverse);
}

LANE_INLINE lanei small_least(lanei a, lanei b, lanei c) { return lanei_min(a, lanei_min(b, c)); }
LANE_INLINE lanei small_most(lanei a, lanei b, lanei c) { return lanei_max(a, lanei_max(b, c)); }

/* Sets up the triangles. Returns those to be drawn; others: those that need another path. */
LANE_NOINLINE uint32_t KERNEL(small_set)(small_setup *s, const lmb_draw_small *b, uint32_t first, uint32_t *others)
{
    const lmb_draw_state *state = b->state;
    const lanei seven = lanei_splat(7), zero = lanei_splat(0);
    small_corner c[3];
    for (int k = 0; k < 3; ++k) {
        small_place(&c[k], b, first, k);
    }
    const lanei x_min = small_least(c[0].x, c[1].x, c[2].x), x_max = small_most(c[0].x, c[1].x, c[2].x),
                y_min = small_least(c[0].y, c[1].y, c[2].y), y_max = small_most(c[0].y, c[1].y, c[2].y);
    const lanei to_x = lanei_splat(b->middle_x - 128), to_y = lanei_splat(b->middle_y - 128), up = lanei_splat(255);
    const lanei x0 = lanei_max(lanei_shift(lanei_add(lanei_add(x_min, to_x), up), 8), lanei_splat(b->x0)),
                x1 = lanei_min(lanei_shift(lanei_add(x_max, to_x), 8), lanei_splat(b->x1)),
                y0 = lanei_max(lanei_shift(lanei_add(lanei_add(y_min, to_y), up), 8), lanei_splat(b->y0)),
                y1 = lanei_min(lanei_shift(lanei_add(y_max, to_y), 8), lanei_splat(b->y1));
    lane_mask in = mask_and(c[0].in, mask_and(c[1].in, c[2].in));
    if (b->uvs != NULL) {
        in = mask_and(in, small_sane(b, first));
    }
    const lane_mask empty = mask_or(lanei_lt(x1, x0), lanei_lt(y1, y0));
    const lanei side = lanei_splat(SMALL_24_8);
    const lane_mask fits = mask_and(lanei_lt(lanei_sub(x_max, x_min), side), lanei_lt(lanei_sub(y_max, y_min), side));
    const lanei area = lanei_sub(lanei_mul(lanei_sub(c[1].x, c[0].x), lanei_sub(c[2].y, c[0].y)),
                                 lanei_mul(lanei_sub(c[2].x, c[0].x), lanei_sub(c[1].y, c[0].y)));
    const lane_mask back = lanei_lt(zero, area), front = lanei_lt(area, zero);
    const int is_clockwise = (state->flags & LMB_DRAW_CLOCKWISE) != 0;
    lane_mask shows = mask_of_bits(0);
    if ((state->flags & (is_clockwise ? LMB_DRAW_CULL_FRONT : LMB_DRAW_CULL_BACK)) == 0) {
        shows = mask_or(shows, back);
    }
    if ((state->flags & (is_clockwise ? LMB_DRAW_CULL_BACK : LMB_DRAW_CULL_FRONT)) == 0) {
        shows = mask_or(shows, front);
    }
    const lane_mask has_box = mask_and(in, mask_not(empty)), asked = mask_and(has_box, mask_and(fits, shows));
    const lane_mask is_small =
        mask_and(lanei_lt(lanei_sub(x1, x0), lanei_splat(8)), lanei_lt(lanei_sub(y1, y0), lanei_splat(8)));
    const uint32_t small = mask_bits(mask_and(asked, is_small));
    *others = mask_bits(mask_or(mask_not(in), mask_or(mask_and(has_box, mask_not(fits)),
                                                      mask_and(asked, mask_not(is_small)))));
    if (small == 0) {
        return 0;
    }
    const lanei x = lanei_min(x0, lanei_sub(lanei_splat(b->right), seven));
    lanei_store(s->x, x);
    lanei_store(s->y, y0);
    lanei_store(s->box, lanei_or(lanei_or(lanei_sub(x0, x), lanei_mul(lanei_sub(x1, x), lanei_splat(1 << 8))),
                                 lanei_mul(lanei_sub(y1, y0), lanei_splat(1 << 16))));
    s->back = mask_bits(back);
    s->first = first;
    const small_corner second = c[1];
    small_pick(&c[1], back, &second, &c[2]);
    small_pick(&c[2], back, &c[2], &second);
    for (int i = 0; i < 3; ++i) {
        small_set_edge(s, b, i, &c[i], &c[(i + 1) % 3]);
    }
    small_set_colours(s, b, first);
    const laned by_area = laned_div(laned_splat(1.0), laned_from_int(lanei_max(area, lanei_sub(zero, area))));
    if (b->depth != NULL) {
        small_set_depth(s, b, c, by_area);
    }
    if ((s->varies & small) != 0 || b->uvs != NULL) {
        small_set_shares(s, b, c, by_area);
    }
    return small;
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* The tiles that the pixels of a vector lie in. */
typedef struct small_where {
    lane_mask is_right;
    int is_below;
    lane column, row; /* in the tile */
} small_where;

/* Starts and steps of a value for the columns of a vector: above and below the border of two tiles. */
typedef struct small_run {
    lane above, below, along, per_y;
} small_run;

LANE_INLINE small_run small_run_of(const small_plane *p, int t, const small_where *w)
{
    small_run r;
    r.above = lane_pick(w->is_right, lane_splat(p->at[1][t]), lane_splat(p->at[0][t]));
    r.below = lane_pick(w->is_right, lane_splat(p->at[3][t]), lane_splat(p->at[2][t]));
    r.along = lane_mul(lane_splat(p->x[t]), w->column);
    r.per_y = lane_splat(p->y[t]);
    return r;
}

LANE_INLINE lane small_value(const small_run *r, const small_where *w)
{
    return lane_add(lane_add(w->is_below ? r->below : r->above, lane_mul(r->per_y, w->row)), r->along);
}

LANE_INLINE lanei small_columns(void)
{
    static const int32_t column[16] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
    return lanei_load(column);
}

/* Colours of the corners, R G B A of corner 0 and the others' differences from it. */
typedef struct small_colours {
    float at[4], more1[4], more2[4];
} small_colours;

/* The same and texture coordinates of triangle t. */
LANE_INLINE void small_set_painted(lmb_draw_patch *out, const lmb_draw_small *b, const small_setup *s, int t)
{
    const int back = (int)(s->back >> t & 1u);
    const uint32_t n = s->first + (uint32_t)t;
    const ptrdiff_t v0 = b->at[0][n], v1 = b->at[2 - back][n], v2 = b->at[1 + back][n];
    out->state = b->state;
    out->varies = (int)(s->varies >> t & 1u);
    for (int i = 0; i < 4; ++i) {
        out->at[i] = (float)(out->varies ? b->colours[4 * v0 + i] : s->codes[t] >> 8 * i & 0xffu);
        out->more1[i] = out->varies ? (float)b->colours[4 * v1 + i] - out->at[i] : 0.0f;
        out->more2[i] = out->varies ? (float)b->colours[4 * v2 + i] - out->at[i] : 0.0f;
    }
    for (int i = 0; i < 2; ++i) {
        out->at[4 + i] = b->uvs[2 * v0 + i];
        out->more1[4 + i] = b->uvs[2 * v1 + i] - out->at[4 + i];
        out->more2[4 + i] = b->uvs[2 * v2 + i] - out->at[4 + i];
    }
}

LANE_INLINE draw_share small_share(const small_run n[3], const small_where *w, int is_even)
{
    draw_share share = {small_value(&n[0], w), small_value(&n[1], w)};
    if (!is_even) {
        draw_even_out(&share, small_value(&n[2], w));
    }
    return draw_hold_share(share);
}

LANE_INLINE void small_set_smooth(small_colours *out, const lmb_draw_small *b, const small_setup *s, int t)
{
    const int back = (int)(s->back >> t & 1u);
    const uint32_t n = s->first + (uint32_t)t;
    const uint8_t *c0 = b->colours + 4 * (ptrdiff_t)b->at[0][n], *c1 = b->colours + 4 * (ptrdiff_t)b->at[2 - back][n],
                  *c2 = b->colours + 4 * (ptrdiff_t)b->at[1 + back][n];
    for (int i = 0; i < 4; ++i) {
        out->at[i] = (float)c0[i];
        out->more1[i] = (float)c1[i] - out->at[i];
        out->more2[i] = (float)c2[i] - out->at[i];
    }
}

LANE_INLINE lanei small_smooth_codes(const small_colours *v, const small_run n[3], const small_where *w, int is_even)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    lane b1 = small_value(&n[0], w), b2 = small_value(&n[1], w);
    draw_codes made;
    if (!is_even) {
        const lane q = small_value(&n[2], w), inverse = lane_keep(lane_lt(lane_splat(1e-30f), q), lane_div(one, q));
        b1 = lane_mul(b1, inverse);
        b2 = lane_mul(b2, inverse);
    }
    b1 = lane_hold(b1, zero, one);
    b2 = lane_hold(b2, zero, one);
    for (int i = 0; i < 4; ++i) {
        const lane more = lane_add(lane_mul(b1, lane_splat(v->more1[i])), lane_mul(b2, lane_splat(v->more2[i])));
        made.c[i] = draw_code(lane_add(lane_splat(v->at[i]), more));
    }
    return draw_join(&made);
}

/* Draws triangle t. varies: the colours do, or there is a texture. */
LANE_INLINE void small_draw(const lmb_draw_small *b, const small_setup *s, int t, int meets, int tests, int varies,
                            int textured)
{
    const lmb_draw_state *state = b->state;
    const int writes = (state->flags & LMB_DRAW_DEPTH_WRITE) != 0;
    const uint32_t box = (uint32_t)s->box[t];
    const int32_t x = s->x[t], y = s->y[t], rows = (int32_t)(box >> 16);
    const uint32_t columns = (0xffu >> (7u - (box >> 8 & 0xffu))) & (0xffu << (box & 0xffu)) & 0xffu;
    const uint32_t packed = s->codes[t];
    const lanei seven = lanei_splat(7);
    lanei colour = lanei_splat((int32_t)packed);
    small_colours smooth;
    colour = b->swaps ? draw_swap(colour) : colour;
    lmb_draw_patch painted;
    draw_brush brush;
    draw_axes axes;
    if (textured) {
        small_set_painted(&painted, b, s, t);
        brush = draw_brush_of(&painted, meets);
        axes = draw_axes_of(&brush, &painted);
    } else if (varies) {
        small_set_smooth(&smooth, b, s, t);
    }
    for (int k = 0; k < LMB_TILE; k += LANES) {
        const lanei across = lanei_add(small_columns(), lanei_splat(k)), column = lanei_add(across, lanei_splat(x & 7));
        const uint32_t chosen = columns >> k & ((1u << LANES) - 1u);
        const ptrdiff_t right = x + k - b->target_x;
        small_where w;
        small_run d, n[3];
        lanei e[3];
        if (chosen == 0) {
            continue;
        }
        for (int i = 0; i < 3; ++i) {
            e[i] = lanei_add(lanei_splat(s->e[i][t]), lanei_mul(lanei_splat(s->ex[i][t]), across));
        }
        w.is_right = lanei_lt(seven, column);
        w.column = lane_from_int(lanei_and(column, seven));
        if (tests) {
            d = small_run_of(&s->d, t, &w);
        }
        if (varies) {
            n[0] = small_run_of(&s->n1, t, &w);
            n[1] = small_run_of(&s->n2, t, &w);
            n[2] = s->is_even ? n[0] : small_run_of(&s->q, t, &w);
        }
        for (int32_t j = 0; j <= rows; ++j) {
            uint32_t bits = mask_bits(lanei_not_negative(lanei_or(lanei_or(e[0], e[1]), e[2]))) & chosen;
            for (int i = 0; i < 3; ++i) {
                e[i] = lanei_add(e[i], lanei_splat(s->ey[i][t]));
            }
            if (bits == 0) {
                continue;
            }
            const ptrdiff_t down = y + j - b->target_y;
            w.is_below = (y & 7) + j > 7;
            w.row = lane_splat((float)((y + j) & 7));
            if (tests) {
                const lane at = lane_hold(small_value(&d, &w), lane_splat(s->low[t]), lane_splat(s->high[t]));
                float *depth = b->depth + down * b->depth_step + right;
                const lane was = lane_load_rows(depth, b->depth_step);
                const lane_mask passes = mask_and(mask_of_bits(bits), draw_passing(state->depth_func, at, was));
                bits &= mask_bits(passes);
                if (bits == 0) {
                    continue;
                }
                if (writes) {
                    lane_store_rows(depth, b->depth_step, lane_pick(passes, at, was));
                }
            }
            uint8_t *to = b->colour + down * b->colour_stride + 4 * right;
            const lanei was = draw_load(to, b->colour_stride);
            if (textured) {
                const draw_share share = small_share(n, &w, s->is_even);
                const draw_found found = draw_find(&brush, &axes, &painted, &share);
                const lanei texel = draw_painted(&brush, &found, bits);
                draw_save(to, b->colour_stride,
                          lanei_pick(mask_of_bits(bits), draw_mixed(&brush, texel, b->swaps, was), was));
                continue;
            }
            if (varies) {
                colour = small_smooth_codes(&smooth, n, &w, s->is_even);
                colour = b->swaps ? draw_swap(colour) : colour;
            }
            const lanei made = meets == DRAW_MEET_OVER  ? codes_over(colour, was)
                               : meets == DRAW_MEET_ADD ? codes_plus(colour, was)
                                                        : colour;
            draw_save(to, b->colour_stride, lanei_pick(mask_of_bits(bits), made, was));
        }
    }
}

/* Draw a triangle: with a depth test or without, of one colour or smooth. They are functions of their own, because the
 * compiler gives inlined copies separate places on the stack. */
LANE_NOINLINE void KERNEL(small_tested)(const lmb_draw_small *b, const small_setup *s, int t, int meets)
{
    small_draw(b, s, t, meets, 1, 0, 0);
}

LANE_NOINLINE void KERNEL(small_tested_smooth)(const lmb_draw_small *b, const small_setup *s, int t, int meets)
{
    small_draw(b, s, t, meets, 1, 1, 0);
}

LANE_NOINLINE void KERNEL(small_untested)(const lmb_draw_small *b, const small_setup *s, int t, int meets)
{
    small_draw(b, s, t, meets, 0, 0, 0);
}

LANE_NOINLINE void KERNEL(small_untested_smooth)(const lmb_draw_small *b, const small_setup *s, int t, int meets)
{
    small_draw(b, s, t, meets, 0, 1, 0);
}

LANE_NOINLINE void KERNEL(small_textured)(const lmb_draw_small *b, const small_setup *s, int t, int meets)
{
    if (b->depth != NULL) {
        small_draw(b, s, t, meets, 1, 1, 1);
    } else {
        small_draw(b, s, t, meets, 0, 1, 1);
    }
}

LANE_INLINE void small_draw_all(const lmb_draw_small *b, const small_setup *s, uint32_t asked, int meets)
{
    for (; asked != 0; asked &= asked - 1) {
        const int t = lowest_bit(asked), varies = (s->varies >> t & 1u) != 0;
        if (b->uvs != NULL) {
            KERNEL(small_textured)(b, s, t, meets);
        } else if (b->depth != NULL && varies) {
            KERNEL(small_tested_smooth)(b, s, t, meets);
        } else if (b->depth != NULL) {
            KERNEL(small_tested)(b, s, t, meets);
        } else if (varies) {
            KERNEL(small_untested_smooth)(b, s, t, meets);
        } else {
            KERNEL(small_untested)(b, s, t, meets);
        }
    }
}

/* Prefetches the rows of triangles. */
LANE_INLINE void small_ask(const lmb_draw_small *b, const small_setup *s, uint32_t asked)
{
    for (; asked != 0; asked &= asked - 1) {
        const int t = lowest_bit(asked);
        const ptrdiff_t rows = s->box[t] >> 16, right = s->x[t] - b->target_x, down = s->y[t] - b->target_y;
        for (ptrdiff_t j = 0; j <= rows; ++j) {
            if (b->depth != NULL) {
                MESH_SOON(b->depth + (down + j) * b->depth_step + right);
            }
            MESH_SOON(b->colour + (down + j) * b->colour_stride + 4 * right);
        }
    }
}

/* Draws triangles from `first` on, at most LANES. Returns how many come before the first that needs another path. */
LANE_INLINE uint32_t small_few(lmb_draw_small *b, uint32_t first, uint32_t count)
{
    small_setup s;
    uint32_t others, small = KERNEL(small_set)(&s, b, first, &others);
    others = (others & ALL_LANES) | (uint32_t)1 << count;
    const uint32_t past = (uint32_t)lowest_bit(others);
    small &= ((uint32_t)1 << past) - 1;
    b->drawn += (uint32_t)count_bits_64(small);
    small_ask(b, &s, small);
    small_draw_all(b, &s, small, draw_meets(b->state));
    return past;
}

static uint32_t KERNEL(draw_small)(lmb_draw_small *b)
{
    for (uint32_t first = 0; first < b->count; first += LANES) {
        const uint32_t left = b->count - first, count = left < LANES ? left : LANES;
        const uint32_t past = small_few(b, first, count);
        if (past < count) {
            return first + past;
        }
    }
    return b->count;
}
#endif
