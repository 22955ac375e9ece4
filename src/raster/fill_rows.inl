/* fill_rows.inl: one triangle into one tiled tile, for backends of a row's lanes or more. Layer 3.
 *
 * All rows are written, without a branch: the rows that a triangle meets are as good as random, and a mispredicted
 * branch costs as much as the rows of a tile. The steps are those of fill.inl, value by value; unrolled, because
 * compilers keep a loop. */

/* An edge's gain per px, or a way in px: to the right in the low 16 bits, down in the high 16 bits. One instruction
 * multiplies both halves and adds the products. The edges of a small triangle gain under 2^14 per px. */
LANE_INLINE lanei rows_slope(lanei ex, lanei ey) { return lanei_halves(ex, ey); }
LANE_INLINE lanei rows_way(lanei x, lanei y) { return lanei_halves(x, y); }
LANE_INLINE lanei rows_gain(lanei slope, lanei way) { return lanei_add_halves(slope, way); }

typedef struct fill_rows {
    lanei e0, e1, e2; /* edges at the next rows */
    lanei down0, down1, down2;
    lane step_d, d_min, d_max;
    lane lowest; /* of the depths so far */
    float *depth;
    uint32_t *ids, id;
    uint16_t *codes; /* FILL_CODES: for depth */
    lane scale, bias;
} fill_rows;

LANE_INLINE void rows_put(fill_rows *r, lane depth, lane_mask in, int y, int kind)
{
    float *p = r->depth + y * LMB_TILE;
    const lane old = lane_load(p);
    if (kind == FILL_PLAIN) {
        depth = lane_pick(in, lane_max(depth, old), old);
    } else {
        const lane_mask pass = mask_and(in, lane_lt(old, depth));
        depth = lane_pick(pass, depth, old);
        lane_put_u32(r->ids + y * LMB_TILE, LMB_TILE, r->id, pass);
    }
    lane_store(p, depth);
    r->lowest = lane_min(r->lowest, depth);
}

/* Advances the edges to the next rows. Returns the pixels of the current rows that are inside. */
LANE_INLINE lane_mask rows_inside(fill_rows *r)
{
    const lane_mask in = lanei_not_negative(lanei_or(lanei_or(r->e0, r->e1), r->e2));
    r->e0 = lanei_add(r->e0, r->down0);
    r->e1 = lanei_add(r->e1, r->down1);
    r->e2 = lanei_add(r->e2, r->down2);
    return in;
}

/* FILL_ROWS rows from row y on. */
LANE_INLINE void rows_cross(fill_rows *r, lane at, int y, int kind)
{
    const lane_mask in = rows_inside(r);
    rows_put(r, lane_min(lane_max(lane_add(at, r->step_d), r->d_min), r->d_max), in, y, kind);
}

/* Codes of FILL_ROWS rows, before clamping to 16 bits; 0 outside. at: d + dy y of the first. */
LANE_INLINE lane rows_code(fill_rows *r, lane at)
{
    const lane_mask in = rows_inside(r);
    const lane d = lane_min(lane_max(lane_add(at, r->step_d), r->d_min), r->d_max);
    return lane_keep(in, lane_add(lane_mul(d, r->scale), r->bias));
}

/* Rows of a tile: all, the upper four, the lower four. */
enum { ROWS_ALL, ROWS_UPPER, ROWS_LOWER };

/* FILL_ROWS rows from row y on. at: d + dy y of eight rows, used if a vector is one row. */
LANE_INLINE void rows_at(fill_rows *r, float d, float dy, const float *at, int y, int kind)
{
#if LANES > LMB_TILE
    (void)at;
    rows_cross(r, lane_add(lane_splat(d), lane_mul(lane_splat(dy), lane_row(y * LMB_TILE))), y, kind);
#else
    (void)d, (void)dy;
    rows_cross(r, lane_splat(at[y]), y, kind);
#endif
}

/* FILL_PAIR rows of codes from row y on; as rows_at. */
LANE_INLINE void rows_codes_at(fill_rows *r, float d, float dy, const float *at, int y)
{
#if LANES > LMB_TILE
    (void)at;
    const lane first = rows_code(r, lane_add(lane_splat(d), lane_mul(lane_splat(dy), lane_row(y * LMB_TILE))));
    const lane next =
        rows_code(r, lane_add(lane_splat(d), lane_mul(lane_splat(dy), lane_row((y + FILL_ROWS) * LMB_TILE))));
#else
    (void)d, (void)dy;
    const lane first = rows_code(r, lane_splat(at[y]));
    const lane next = rows_code(r, lane_splat(at[y + 1]));
#endif
    lane_raise_u16(r->codes + y * LMB_TILE, first, next);
}

LANE_INLINE void rows_draw_codes(fill_rows *r, float d, float dy, const float *at, int rows)
{
    if (rows != ROWS_LOWER) {
        rows_codes_at(r, d, dy, at, 0);
        if (FILL_PAIR == 2) {
            rows_codes_at(r, d, dy, at, 2);
        }
    }
    if (rows != ROWS_UPPER) {
        rows_codes_at(r, d, dy, at, 4);
        if (FILL_PAIR == 2) {
            rows_codes_at(r, d, dy, at, 6);
        }
    }
}

/* On entry all but `lowest` is set, with the edges at the first of `rows`. d: the depth at the tile's first pixel. Sets
 * `lowest` to the farthest depth of these rows. */
LANE_INLINE void rows_draw(fill_rows *r, float d, float dy, int rows, int kind)
{
    float at[LMB_TILE];
#if LANES == LMB_TILE
    lane_store(at, lane_add(lane_splat(d), lane_mul(lane_splat(dy), lane_column(0)))); /* rows side by side */
#endif
    if (kind == FILL_CODES) {
        rows_draw_codes(r, d, dy, at, rows);
        return;
    }
    r->lowest = lane_splat(3e38f);
#if LANES > LMB_TILE
    if (rows != ROWS_LOWER) {
        rows_at(r, d, dy, at, 0, kind);
        rows_at(r, d, dy, at, 2, kind);
    }
    if (rows != ROWS_UPPER) {
        rows_at(r, d, dy, at, 4, kind);
        rows_at(r, d, dy, at, 6, kind);
    }
#else
    if (rows != ROWS_LOWER) {
        rows_at(r, d, dy, at, 0, kind);
        rows_at(r, d, dy, at, 1, kind);
        rows_at(r, d, dy, at, 2, kind);
        rows_at(r, d, dy, at, 3, kind);
    }
    if (rows != ROWS_UPPER) {
        rows_at(r, d, dy, at, 4, kind);
        rows_at(r, d, dy, at, 5, kind);
        rows_at(r, d, dy, at, 6, kind);
        rows_at(r, d, dy, at, 7, kind);
    }
#endif
}

#if LMB_CULLING
/* Raises a bound if all depths exceed it. Most triangles leave a pixel as far as before. */
LANE_INLINE void rows_raise(float *bound, lane lowest)
{
    if (mask_bits(lane_le(lowest, lane_splat(*bound))) == 0) {
        *bound = lane_lowest(lowest);
    }
}
#endif
