/* culled_tile.inl: one triangle into one tiled tile that has a bound, for backends of a row's lanes or more. Layer 3.
 *
 * All rows are written, without a branch: which of them a triangle meets is as good as random. The steps are fill.inl's
 * value by value; written out, as compilers keep a loop. */

typedef struct culled_rows {
    lanei e0, e1, e2; /* edges at the next rows */
    lanei down0, down1, down2;
    lane step_d, d_min, d_max;
    lane lowest; /* of the depths so far */
    float *depth;
    uint32_t *ids, id;
} culled_rows;

LANE_INLINE void culled_put_rows(culled_rows *r, lane depth, lane_mask in, int y, int kind)
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

/* FILL_ROWS rows from row y on. */
LANE_INLINE void culled_cross_rows(culled_rows *r, lane at, int y, int kind)
{
    const lane_mask in = lanei_not_negative(lanei_or(lanei_or(r->e0, r->e1), r->e2));
    culled_put_rows(r, lane_min(lane_max(lane_add(at, r->step_d), r->d_min), r->d_max), in, y, kind);
    r->e0 = lanei_add(r->e0, r->down0);
    r->e1 = lanei_add(r->e1, r->down1);
    r->e2 = lanei_add(r->e2, r->down2);
}

/* d + dy y of each row, or of two, in all lanes of out. */
LANE_INLINE void culled_at_rows(lane *out, float d, float dy)
{
#if LANES > LMB_TILE
    out[0] = lane_add(lane_splat(d), lane_mul(lane_splat(dy), lane_row(0 * LMB_TILE)));
    out[1] = lane_add(lane_splat(d), lane_mul(lane_splat(dy), lane_row(2 * LMB_TILE)));
    out[2] = lane_add(lane_splat(d), lane_mul(lane_splat(dy), lane_row(4 * LMB_TILE)));
    out[3] = lane_add(lane_splat(d), lane_mul(lane_splat(dy), lane_row(6 * LMB_TILE)));
#else
    float at[LMB_TILE];
    lane_store(at, lane_add(lane_splat(d), lane_mul(lane_splat(dy), lane_column(0)))); /* rows side by side */
    out[0] = lane_splat(at[0]), out[1] = lane_splat(at[1]), out[2] = lane_splat(at[2]), out[3] = lane_splat(at[3]);
    out[4] = lane_splat(at[4]), out[5] = lane_splat(at[5]), out[6] = lane_splat(at[6]), out[7] = lane_splat(at[7]);
#endif
}

LANE_INLINE void culled_start(culled_rows *r, const lmb_fill_tile *tile, const fill_triangle *t)
{
    r->step_d = t->step_d[0];
    r->d_min = t->d_min;
    r->d_max = t->d_max;
    r->lowest = lane_splat(3e38f);
    r->depth = (float *)tile->depth;
    r->ids = (uint32_t *)tile->id;
    r->id = t->id;
}

/* Most triangles leave a pixel that is as far as any was. */
LANE_INLINE void culled_raise(float *bound, lane lowest)
{
    if (mask_bits(lane_le(lowest, lane_splat(*bound))) == 0) {
        *bound = lane_lowest(lowest);
    }
}

/* e0 .. e2: the edges at the tile's first pixels; d: the depth at the first one. */
LANE_INLINE void culled_cross_tiled(const lmb_fill_tile *tile, const fill_triangle *t, lanei e0, lanei e1, lanei e2,
                                    float d, float *bound, int kind)
{
    lane at[LMB_TILE / FILL_ROWS];
    culled_rows r;
    culled_start(&r, tile, t);
    r.e0 = e0, r.e1 = e1, r.e2 = e2;
    r.down0 = lanei_splat(t->ey[0] * FILL_ROWS);
    r.down1 = lanei_splat(t->ey[1] * FILL_ROWS);
    r.down2 = lanei_splat(t->ey[2] * FILL_ROWS);
    culled_at_rows(at, d, t->per_row);
#if LANES > LMB_TILE
    culled_cross_rows(&r, at[0], 0, kind);
    culled_cross_rows(&r, at[1], 2, kind);
    culled_cross_rows(&r, at[2], 4, kind);
    culled_cross_rows(&r, at[3], 6, kind);
#else
    culled_cross_rows(&r, at[0], 0, kind);
    culled_cross_rows(&r, at[1], 1, kind);
    culled_cross_rows(&r, at[2], 2, kind);
    culled_cross_rows(&r, at[3], 3, kind);
    culled_cross_rows(&r, at[4], 4, kind);
    culled_cross_rows(&r, at[5], 5, kind);
    culled_cross_rows(&r, at[6], 6, kind);
    culled_cross_rows(&r, at[7], 7, kind);
#endif
    culled_raise(bound, r.lowest);
}
