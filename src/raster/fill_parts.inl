/* fill_parts.inl: a batch's triangles that touch at most two tiles each way, tile by tile. Layer 3.
 *
 * Of such a triangle at most one tile has a given parity of column and row. So what a tile needs (edges, depth, rows)
 * is made for LANES triangles at a time, once a parity, and what remains is one loop over rows. Tiles of two parities
 * are never the same one, and within a parity triangles keep their order: pixels are fill_small.inl's, value by value.
 * For backends of a row's lanes or more: narrower ones spend more on four parities than they save. */

/* Of each triangle of a batch the part in a tile of one parity. */
typedef struct fill_parts {
    int32_t e[3][LMB_BATCH];                              /* at the first pixel of first_row */
    int32_t first_row[LMB_BATCH], last_row[LMB_BATCH];    /* in the tile */
    int32_t across[LMB_BATCH], down[LMB_BATCH];           /* of the tile in the window, tiles */
    float d[LMB_BATCH];                                   /* at the tile's first pixel */
    float dx[LMB_BATCH], dy[LMB_BATCH];                   /* of every tile */
} fill_parts;

/* Triangles whose box touches more than two tiles in a row, a bit each. */
LANE_INLINE uint32_t parts_wide(const lmb_batch *b, uint32_t bits)
{
    const lanei two = lanei_splat(2);
    uint32_t wide = 0;
    for (int k = 0; k < LMB_BATCH && bits >> k != 0; k += LANES) {
        const lanei x = lanei_sub(lanei_shift(lanei_load(b->x1 + k), 3), lanei_shift(lanei_load(b->x0 + k), 3)),
                    y = lanei_sub(lanei_shift(lanei_load(b->y1 + k), 3), lanei_shift(lanei_load(b->y0 + k), 3));
        wide |= mask_bits(mask_not(mask_and(lanei_lt(x, two), lanei_lt(y, two)))) << k;
    }
    return wide & bits;
}

LANE_INLINE void parts_slopes(fill_parts *out, const lmb_batch *b, uint32_t bits)
{
    for (int k = 0; k < LMB_BATCH && bits >> k != 0; k += LANES) {
        lane_store(out->dx + k, lane_from_double(laned_load(b->dx + k)));
        lane_store(out->dy + k, lane_from_double(laned_load(b->dy + k)));
    }
}

/* (x, y): px of the frame, of the tiles' first pixels. */
LANE_INLINE void parts_depth(fill_parts *out, const lmb_fill_window *w, const lmb_batch *b, int k, lanei x, lanei y)
{
    const lanei to_24_8 = lanei_splat(256);
    const laned to_px = laned_splat(1.0 / 256.0);
    const laned right = laned_from_int(lanei_add(lanei_mul(x, to_24_8), lanei_splat(w->origin_x))),
                down = laned_from_int(lanei_add(lanei_mul(y, to_24_8), lanei_splat(w->origin_y)));
    const laned d = laned_add(laned_load(b->d + k), laned_mul(laned_load(b->dx + k), laned_mul(right, to_px)));
    lane_store(out->d + k,
               lane_from_double(laned_add(d, laned_mul(laned_load(b->dy + k), laned_mul(down, to_px)))));
}

/* What an edge gains at most from a box's first pixel to another. */
LANE_INLINE lanei parts_gain(lanei ex, lanei ey, lanei width, lanei height)
{
    const lanei zero = lanei_splat(0);
    return lanei_add(lanei_max(lanei_mul(ex, width), zero), lanei_max(lanei_mul(ey, height), zero));
}

/* Triangles k .. k + LANES - 1 in tiles of this parity; returns those that may have pixels there, a bit each. */
LANE_INLINE uint32_t parts_set(fill_parts *out, const lmb_fill_window *w, const lmb_batch *b, int k, int parity)
{
    const lanei zero = lanei_splat(0), one = lanei_splat(1), side = lanei_splat(LMB_TILE),
                last = lanei_splat(LMB_TILE - 1);
    const lanei x0 = lanei_load(b->x0 + k), y0 = lanei_load(b->y0 + k);
    const lanei tile_x = lanei_shift(x0, 3), tile_y = lanei_shift(y0, 3);
    const lanei next_x = lanei_and(lanei_add(tile_x, lanei_splat(parity & 1)), one),
                next_y = lanei_and(lanei_add(tile_y, lanei_splat(parity >> 1)), one);
    const lanei across = lanei_add(tile_x, next_x), down = lanei_add(tile_y, next_y);
    const lanei x = lanei_mul(across, side), y = lanei_mul(down, side);
    /* The box in the tile; its sides are negative where it is not there. */
    const lanei left = lanei_max(lanei_sub(x0, x), zero), top = lanei_max(lanei_sub(y0, y), zero);
    const lanei bottom = lanei_min(lanei_sub(lanei_load(b->y1 + k), y), last);
    const lanei width = lanei_sub(lanei_min(lanei_sub(lanei_load(b->x1 + k), x), last), left),
                height = lanei_sub(bottom, top);
    const lanei row = lanei_and(top, lanei_splat(~(FILL_ROWS - 1)));
    const lanei right = lanei_mul(next_x, side), below = lanei_add(lanei_mul(next_y, side), row),
                within = lanei_sub(top, row);
    lanei inside = lanei_or(width, height);
    for (int i = 0; i < 3; ++i) {
        const lanei ex = lanei_load(b->ex[i] + k), ey = lanei_load(b->ey[i] + k);
        const lanei e =
            lanei_add(lanei_load(b->e[i] + k), lanei_add(lanei_mul(ex, right), lanei_mul(ey, below)));
        const lanei corner = lanei_add(e, lanei_add(lanei_mul(ex, left), lanei_mul(ey, within)));
        lanei_store(out->e[i] + k, e);
        inside = lanei_or(inside, lanei_add(corner, parts_gain(ex, ey, width, height)));
    }
    lanei_store(out->first_row + k, row);
    lanei_store(out->last_row + k, bottom);
    lanei_store(out->across + k, lanei_sub(across, lanei_splat(w->x0 / LMB_TILE)));
    lanei_store(out->down + k, lanei_sub(down, lanei_splat(w->y0 / LMB_TILE)));
    parts_depth(out, w, b, k, x, y);
    return mask_bits(lanei_not_negative(inside));
}

/* Triangle k in its tile. */
LANE_INLINE void parts_draw(const lmb_fill_window *w, const lmb_batch *b, const fill_parts *p, int k, uint32_t id,
                            int kind)
{
    const ptrdiff_t down = p->down[k], across = p->across[k];
    const int32_t e[3] = {p->e[0][k], p->e[1][k], p->e[2][k]};
    const int32_t ex[3] = {b->ex[0][k], b->ex[1][k], b->ex[2][k]}, ey[3] = {b->ey[0][k], b->ey[1][k], b->ey[2][k]};
    const fill_box box = {p->first_row[k], p->last_row[k], 0, 0};
    lmb_fill_tile tile = fill_first(w, kind);
    lmb_fill_job job;
    fill_triangle t;
    job.dx = p->dx[k];
    job.dy = p->dy[k];
    job.d_min = b->d_min[k];
    job.d_max = b->d_max[k];
    job.id = id;
    fill_set(&t, ex, ey, &job);
    tile.depth = (uint8_t *)w->first.depth + down * w->depth_row + across * w->depth_tile;
    if (tile.id_format != LMB_FORMAT_NONE) {
        tile.id = (uint8_t *)w->first.id + down * w->id_row + across * w->id_tile;
    }
    fill_column(&tile, &job, &t, e, p->d[k], &box, 0);
}

/* `kind` is a tiled one. */
LANE_INLINE void parts_fill(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits, uint32_t first_id, int kind)
{
    fill_parts parts;
    parts_slopes(&parts, b, bits);
    for (int parity = 0; parity < 4; ++parity) {
        uint32_t some = 0;
        for (int k = 0; k < LMB_BATCH && bits >> k != 0; k += LANES) {
            some |= parts_set(&parts, w, b, k, parity) << k;
        }
        for (some &= bits; some != 0; some &= some - 1) {
            const int k = lowest_bit(some);
            parts_draw(w, b, &parts, k, first_id + (uint32_t)k, kind);
        }
    }
}
