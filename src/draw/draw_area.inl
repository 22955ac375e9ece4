/* draw_area.inl: all tiles of a triangle in one call, LANES pixels at a time. Layer 4.
 *
 * Values equal those of draw_shape.c and draw_tile.c. Values of all tiles are set up once for the triangle. With a
 * texture or fog, colours take a call per tile, so that they do not share their stack with the edges. */

#if !defined(LANE_PLAIN)
#if LANES > LMB_TILE
/* Draws pixels of one colour whose depths are less than the stored ones. No branch for empty rows, because
 * processors mispredict how many rows of a tile have pixels. */
LANE_INLINE void area_tile_usual(const lmb_draw_patch *p, uint64_t mask, lanei same)
{
    const lane low = lane_splat(p->d_min), high = lane_splat(p->d_max);
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        float *at = p->depth + (ptrdiff_t)(k >> 3) * p->depth_step;
        const lane d = lane_hold(draw_slope_at(&p->d, k), low, high);
        const lane_mask less = lane_lt(d, lane_load_rows(at, p->depth_step));
        const lane_mask passes = mask_and(mask_of_bits(draw_bits(mask, k)), less);
        lane_store_rows_some(at, p->depth_step, passes, d);
        lanei_store_rows_some(p->colour + (ptrdiff_t)(k >> 3) * p->colour_stride, p->colour_stride, passes, same);
    }
}
#endif

/* Draws the pixels of the mask. usual: 1: depths that are less pass, and are stored as they are. */
LANE_INLINE void area_tile(const lmb_draw_patch *p, uint64_t mask, lanei same, int meets, int tests, int varies,
                           int usual)
{
    const int writes = usual || (p->state->flags & LMB_DRAW_DEPTH_WRITE) != 0,
              func = usual ? LMB_DRAW_LESS : p->state->depth_func;
    const lane low = lane_splat(p->d_min), high = lane_splat(p->d_max);
    while (mask != 0) { /* processors mispredict a test of each vector */
        const int k = lowest_bit_64(mask) & ~(LANES - 1);
        uint32_t bits = draw_bits(mask, k);
        uint8_t *to = p->colour + (ptrdiff_t)(k >> 3) * p->colour_stride + 4 * (k & 7);
        mask &= ~((uint64_t)ALL_LANES << k);
        if (tests) {
            float *at = p->depth + (ptrdiff_t)(k >> 3) * p->depth_step + (k & 7);
            const lane was = lane_load_rows(at, p->depth_step);
            lane d = lane_hold(draw_slope_at(&p->d, k), low, high);
            if (!usual && p->d_add != 0.0f) {
                d = lane_hold(lane_add(d, lane_splat(p->d_add)), lane_splat(0.0f), lane_splat(1.0f));
            }
            const lane_mask passes = mask_and(mask_of_bits(bits), draw_passing(func, d, was));
            bits &= mask_bits(passes);
            if (varies && bits == 0) {
                continue;
            }
            if (writes) {
                lane_store_rows(at, p->depth_step, lane_pick(passes, d, was));
            }
        }
        lanei made = same;
        if (varies) {
            const draw_share share = draw_share_at(p, k);
            draw_codes v;
            for (int i = 0; i < 4; ++i) {
                v.c[i] = draw_code(draw_value_at(p, i, &share));
            }
            made = draw_join(&v);
            made = p->swaps ? draw_swap(made) : made;
        }
        const lanei was = draw_load(to, p->colour_stride);
        made = meets == DRAW_MEET_OVER ? codes_over(made, was) : meets == DRAW_MEET_ADD ? codes_plus(made, was) : made;
        draw_save(to, p->colour_stride, lanei_pick(mask_of_bits(bits), made, was));
    }
}

/* Vectors of a row of a tile; 1: a vector is a row, or two. */
enum { AREA_PARTS = LANES < LMB_TILE ? LMB_TILE / LANES : 1, AREA_FAR = 1 << 30 };

/* What the tiles share. */
typedef struct area_walk {
    lanei same;
    lanei first[3], across[3], down[3]; /* of the edges: pixels of a tile's first vector, less the first pixel; changes
                                           to the next vector of a row, and from a row's last to the next row */
    int64_t low[3], high[3]; /* changes of the edges from a tile's first pixel to their least and greatest */
    int meets;
} area_walk;

static void KERNEL(area_set)(area_walk *w, const lmb_draw_area *a)
{
    const lmb_draw_patch *p = &a->pixels;
    draw_codes v;
    w->meets = draw_meets(p->state);
    for (int i = 0; i < 4; ++i) {
        v.c[i] = draw_code(lane_splat(p->at[i]));
    }
    w->same = draw_join(&v);
    w->same = p->swaps ? draw_swap(w->same) : w->same;
    for (int i = 0; i < 3; ++i) {
        const int32_t ex = a->edge_x[i], ey = a->edge_y[i];
        w->first[i] = lanei_affine(0, ex, ey, 0);
        w->across[i] = lanei_splat(LANES * ex);
        w->down[i] = lanei_splat(LANES > LMB_TILE ? LANES / LMB_TILE * ey : ey - (AREA_PARTS - 1) * LANES * ex);
        w->low[i] = 7 * ((ex < 0 ? ex : 0) + (ey < 0 ? ey : 0));
        w->high[i] = 7 * ((ex > 0 ? ex : 0) + (ey > 0 ? ey : 0));
    }
}

/* The pixels of a tile that are inside all edges, which are e at the first pixel. Values over
 * AREA_FAR are limited to it: such a tile is inside the edge at all pixels, and sums then fit 32 bits. */
LANE_INLINE uint64_t area_covered(const area_walk *w, int64_t e0, int64_t e1, int64_t e2)
{
    uint64_t mask = 0;
    if (((e0 + w->low[0]) | (e1 + w->low[1]) | (e2 + w->low[2])) >= 0) {
        return ~(uint64_t)0;
    }
    lanei a = lanei_add(w->first[0], lanei_splat((int32_t)(e0 < AREA_FAR ? e0 : AREA_FAR)));
    lanei b = lanei_add(w->first[1], lanei_splat((int32_t)(e1 < AREA_FAR ? e1 : AREA_FAR)));
    lanei c = lanei_add(w->first[2], lanei_splat((int32_t)(e2 < AREA_FAR ? e2 : AREA_FAR)));
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lanei *by = k / LANES % AREA_PARTS == AREA_PARTS - 1 ? w->down : w->across;
        mask |= (uint64_t)mask_bits(lanei_not_negative(lanei_or(lanei_or(a, b), c))) << k;
        a = lanei_add(a, by[0]);
        b = lanei_add(b, by[1]);
        c = lanei_add(c, by[2]);
    }
    return mask;
}

/* The pixels of the tile at (x, y) that are in the box. */
LANE_INLINE uint64_t area_box(const lmb_draw_area *a, int32_t x, int32_t y)
{
    uint64_t rows = ~(uint64_t)0;
    uint32_t columns = 0xffu;
    rows = y < a->y0 ? rows << LMB_TILE * (a->y0 - y) : rows;
    rows = y + 7 > a->y1 ? rows & ~(uint64_t)0 >> LMB_TILE * (y + 7 - a->y1) : rows;
    columns = x < a->x0 ? columns << (a->x0 - x) : columns;
    columns = x + 7 > a->x1 ? columns & 0xffu >> (x + 7 - a->x1) : columns;
    return rows & (columns & 0xffu) * UINT64_C(0x0101010101010101);
}

LANE_INLINE void area_slope(lmb_draw_slope *out, const lmb_draw_plane *p, double x, double y)
{
    out->at = (float)(p->origin + p->x * x + p->y * y);
}

LANE_NOINLINE void KERNEL(area_plain)(const lmb_draw_patch *p, const area_walk *w, uint64_t mask, int tests)
{
    const int varies = p->varies;
    if (w->meets == DRAW_MEET_OVER) {
        if (tests) {
            area_tile(p, mask, w->same, DRAW_MEET_OVER, 1, varies, 0);
        } else {
            area_tile(p, mask, w->same, DRAW_MEET_OVER, 0, varies, 0);
        }
    } else if (w->meets == DRAW_MEET_ADD) {
        area_tile(p, mask, w->same, DRAW_MEET_ADD, tests, varies, 0);
    } else if (tests && varies) {
        area_tile(p, mask, w->same, DRAW_MEET_NOT, 1, 1, 0);
    } else if (tests) {
        area_tile(p, mask, w->same, DRAW_MEET_NOT, 1, 0, 0);
    } else {
        area_tile(p, mask, w->same, DRAW_MEET_NOT, 0, varies, 0);
    }
}

LANE_INLINE void area_draw(lmb_draw_area *a, const area_walk *w, uint64_t mask, int32_t x, int32_t y, int usual)
{
    lmb_draw_patch *p = &a->pixels;
    const double at_x = a->x + x, at_y = a->y + y;
    p->colour = a->colour + (ptrdiff_t)y * p->colour_stride + 4 * (ptrdiff_t)x;
    if (a->tests) {
        p->depth = a->depth + (ptrdiff_t)y * p->depth_step + x;
        area_slope(&p->d, a->plane[0], at_x, at_y);
    }
    if (p->varies) {
        area_slope(&p->n1, a->plane[1], at_x, at_y);
        area_slope(&p->n2, a->plane[2], at_x, at_y);
        if (!p->is_even) {
            area_slope(&p->q, a->plane[3], at_x, at_y);
        }
    }
    if (usual) {
#if LANES > LMB_TILE
        area_tile_usual(p, mask, w->same);
#else
        area_tile(p, mask, w->same, DRAW_MEET_NOT, 1, 0, 1);
#endif
    } else {
        KERNEL(area_plain)(p, w, mask, a->tests);
    }
}

/* The first column of tiles, from 0, that reaches inside the edges that grow along a row, which are e at the greatest
 * pixel of tile 0. */
static int32_t KERNEL(area_first)(const lmb_draw_area *a, const int64_t e[3])
{
    int64_t first = 0;
    for (int i = 0; i < 3; ++i) {
        if (e[i] < 0 && a->edge_x[i] > 0) {
            const int64_t by = (int64_t)a->edge_x[i] * LMB_TILE, tiles = (by - 1 - e[i]) / by;
            first = tiles > first ? tiles : first;
        }
    }
    return (int32_t)(first < LMB_MAX_FRAME ? first : LMB_MAX_FRAME) * LMB_TILE;
}

/* The tiles of a row that a triangle touches are next to each other. */
LANE_INLINE void area_draw_all(lmb_draw_area *a, const area_walk *w, int usual)
{
    const int64_t by0 = (int64_t)a->edge_x[0] * LMB_TILE, by1 = (int64_t)a->edge_x[1] * LMB_TILE,
                  by2 = (int64_t)a->edge_x[2] * LMB_TILE;
    const int64_t high0 = w->high[0], high1 = w->high[1], high2 = w->high[2];
    for (int32_t y = 0; y <= a->y1; y += LMB_TILE) {
        int64_t e[3];
        for (int i = 0; i < 3; ++i) {
            e[i] = a->edge[i] + (int64_t)a->edge_y[i] * y + w->high[i];
        }
        int32_t x = KERNEL(area_first)(a, e);
        int64_t e0 = e[0] - high0 + (int64_t)a->edge_x[0] * x, e1 = e[1] - high1 + (int64_t)a->edge_x[1] * x,
                e2 = e[2] - high2 + (int64_t)a->edge_x[2] * x;
        for (; x <= a->x1 && ((e0 + high0) | (e1 + high1) | (e2 + high2)) >= 0; x += LMB_TILE) {
            uint64_t mask = area_covered(w, e0, e1, e2);
            if (x < a->x0 || y < a->y0 || x + 7 > a->x1 || y + 7 > a->y1) {
                mask &= area_box(a, x, y);
            }
            if (mask != 0) {
                area_draw(a, w, mask, x, y, usual);
            }
            e0 += by0;
            e1 += by1;
            e2 += by2;
        }
    }
}

/* --- with a texture or fog ---------------------------------------------------------------------------------------- */

/* The pixels of the tile at (x, y) that are in the box and inside all edges, which are e at the first pixel. */
LANE_NOINLINE uint64_t KERNEL(area_mask)(const lmb_draw_area *a, const int64_t e[3], int32_t x, int32_t y)
{
    int32_t held[3];
    int64_t inside = 0; /* negative: some pixel is outside an edge */
    for (int i = 0; i < 3; ++i) {
        const int32_t ex = a->edge_x[i], ey = a->edge_y[i];
        inside |= e[i] + 7 * ((int64_t)(ex < 0 ? ex : 0) + (ey < 0 ? ey : 0));
        held[i] = (int32_t)(e[i] < AREA_FAR ? e[i] : AREA_FAR);
    }
    return area_box(a, x, y) & (inside >= 0 ? ~(uint64_t)0 : KERNEL(draw_cover)(held, a->edge_x, a->edge_y));
}

LANE_NOINLINE void KERNEL(area_painted_tile)(lmb_draw_area *a, const draw_look *look, uint64_t mask, int32_t x,
                                             int32_t y)
{
    lmb_draw_patch *p = &a->pixels;
    const double at_x = a->x + x, at_y = a->y + y;
    if (a->tests) {
        p->depth = a->depth + (ptrdiff_t)y * p->depth_step + x;
        area_slope(&p->d, a->plane[0], at_x, at_y);
        mask = KERNEL(draw_test)(p, mask);
        if (mask == 0) {
            return;
        }
    }
    p->colour = a->colour + (ptrdiff_t)y * p->colour_stride + 4 * (ptrdiff_t)x;
    area_slope(&p->n1, a->plane[1], at_x, at_y);
    area_slope(&p->n2, a->plane[2], at_x, at_y);
    if (!p->is_even) {
        area_slope(&p->q, a->plane[3], at_x, at_y);
    }
    draw_usual_tile(p, mask, look);
}

LANE_NOINLINE void KERNEL(area_painted)(lmb_draw_area *a)
{
    const draw_look look = draw_look_of(&a->pixels, draw_meets(a->pixels.state));
    int64_t high[3];
    for (int i = 0; i < 3; ++i) {
        const int32_t ex = a->edge_x[i], ey = a->edge_y[i];
        high[i] = 7 * ((int64_t)(ex > 0 ? ex : 0) + (ey > 0 ? ey : 0));
    }
    for (int32_t y = 0; y <= a->y1; y += LMB_TILE) {
        int64_t e[3];
        for (int i = 0; i < 3; ++i) {
            e[i] = a->edge[i] + (int64_t)a->edge_y[i] * y + high[i];
        }
        int32_t x = KERNEL(area_first)(a, e);
        for (int i = 0; i < 3; ++i) {
            e[i] += (int64_t)a->edge_x[i] * x - high[i];
        }
        for (; x <= a->x1 && ((e[0] + high[0]) | (e[1] + high[1]) | (e[2] + high[2])) >= 0; x += LMB_TILE) {
            const uint64_t mask = KERNEL(area_mask)(a, e, x, y);
            if (mask != 0) {
                KERNEL(area_painted_tile)(a, &look, mask, x, y);
            }
            for (int i = 0; i < 3; ++i) {
                e[i] += (int64_t)a->edge_x[i] * LMB_TILE;
            }
        }
    }
}

LANE_NOINLINE void KERNEL(area_bare)(lmb_draw_area *a)
{
    const lmb_draw_state *s = a->pixels.state;
    area_walk w;
    KERNEL(area_set)(&w, a);
    if (!a->pixels.varies && a->tests && w.meets == DRAW_MEET_NOT && a->pixels.d_add == 0.0f &&
        s->depth_func == LMB_DRAW_LESS && (s->flags & LMB_DRAW_DEPTH_WRITE) != 0) {
        area_draw_all(a, &w, 1);
    } else {
        area_draw_all(a, &w, 0);
    }
}

static void KERNEL(draw_area)(lmb_draw_area *a)
{
    const lmb_draw_state *s = a->pixels.state;
    if (s->stage[0].texture != NULL || s->fog != LMB_DRAW_FOG_NONE) {
        KERNEL(area_painted)(a);
    } else {
        KERNEL(area_bare)(a);
    }
}
#endif
