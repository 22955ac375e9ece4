/* culled_parts.inl: a batch's small triangles where tiles have bounds, for backends of a row's lanes or more. Layer 3.
 *
 * Most triangles touch at most two tiles each way. In which tiles
 * they have pixels that may show, and the depth at each tile's first pixel, are found for LANES triangles at a time; then
 * each triangle is drawn, tile by tile, from one set of steps. */

/* Tile p of a triangle lies p % PARTS_SIDE to the right of its first one, and p / PARTS_SIDE below. */
enum { PARTS_SIDE = 3 };

/* So many triangles of three tiles each way are worth looking at nine instead of four; fewer of two go one by one. */
enum { PARTS_MORE = 6, PARTS_LESS = 3 };

typedef struct culled_parts {
    float d[PARTS_SIDE * PARTS_SIDE][LMB_BATCH]; /* at the tile's first pixel */
    float dx[LMB_BATCH], dy[LMB_BATCH];
    int32_t tiles[LMB_BATCH]; /* of each triangle, those with pixels that may show: bit p */
} culled_parts;

/* Tile p of triangles k .. k + LANES - 1: bit p where it has pixels that may show. */
LANE_INLINE lanei culled_parts_set(culled_parts *out, const lmb_fill_window *w, const lmb_batch *b, int k, int p)
{
    const lanei zero = lanei_splat(0), last = lanei_splat(LMB_TILE - 1);
    const lanei x0 = lanei_load(b->x0 + k), y0 = lanei_load(b->y0 + k);
    const lanei tile_x = lanei_shift(x0, 3), tile_y = lanei_shift(y0, 3);
    const lanei across = lanei_add(tile_x, lanei_splat(p % PARTS_SIDE)),
                down = lanei_add(tile_y, lanei_splat(p / PARTS_SIDE));
    const lanei x = lanei_mul(across, lanei_splat(LMB_TILE)), y = lanei_mul(down, lanei_splat(LMB_TILE));
    const lanei left = lanei_max(lanei_sub(x0, x), zero), top = lanei_max(lanei_sub(y0, y), zero);
    const lanei right = lanei_min(lanei_sub(lanei_load(b->x1 + k), x), last),
                bottom = lanei_min(lanei_sub(lanei_load(b->y1 + k), y), last);
    const lanei width = lanei_sub(right, left), height = lanei_sub(bottom, top);
    const lanei from_x = lanei_add(left, lanei_splat(p % PARTS_SIDE * LMB_TILE)),
                from_y = lanei_add(top, lanei_splat(p / PARTS_SIDE * LMB_TILE));
    lanei inside = lanei_or(width, height);
    for (int i = 0; i < 3; ++i) {
        const lanei ex = lanei_load(b->ex[i] + k), ey = lanei_load(b->ey[i] + k);
        const lanei corner =
            lanei_add(lanei_load(b->e[i] + k), lanei_add(lanei_mul(ex, from_x), lanei_mul(ey, from_y)));
        inside = lanei_or(inside, lanei_add(corner, parts_gain(ex, ey, width, height)));
    }
    const lanei to_24_8 = lanei_splat(256);
    const laned to_px = laned_splat(1.0 / 256.0);
    const laned to_x = laned_from_int(lanei_add(lanei_mul(x, to_24_8), lanei_splat(w->origin_x))),
                to_y = laned_from_int(lanei_add(lanei_mul(y, to_24_8), lanei_splat(w->origin_y)));
    const laned d_row = laned_add(laned_load(b->d + k), laned_mul(laned_load(b->dx + k), laned_mul(to_x, to_px)));
    const lane d = lane_from_double(laned_add(d_row, laned_mul(laned_load(b->dy + k), laned_mul(to_y, to_px))));
    lane_store(out->d[p] + k, d);
    lane_mask seen = lanei_not_negative(inside);
    const lane dx = lane_load(out->dx + k), dy = lane_load(out->dy + k), zerof = lane_splat(0.0f);
    const lane near = culled_nearest(d, dx, dy, lane_from_int(lanei_pick(lane_lt(zerof, dx), right, left)),
                                     lane_from_int(lanei_pick(lane_lt(zerof, dy), bottom, top)),
                                     lane_load(b->d_min + k), lane_load(b->d_max + k));
    const lanei at = lanei_add(lanei_mul(lanei_sub(down, lanei_splat(w->y0 / LMB_TILE)), lanei_splat(w->tiles_x)),
                               lanei_sub(across, lanei_splat(w->x0 / LMB_TILE)));
    if (mask_bits(seen) != 0) {
        seen = mask_and(seen, lane_lt(lane_gather_f32(w->farthest, lanei_pick(seen, at, zero)), near));
    }
    return lanei_pick(seen, lanei_splat(1 << p), zero);
}

LANE_INLINE void culled_prefetch(const lmb_fill_window *w, const lmb_batch *b, const culled_parts *parts, int k)
{
#if defined(__GNUC__)
    const ptrdiff_t down = (b->y0[k] - w->y0) / LMB_TILE, across = (b->x0[k] - w->x0) / LMB_TILE;
    const uint8_t *first = (const uint8_t *)w->first.depth + down * w->depth_row + across * w->depth_tile;
    for (uint32_t tiles = (uint32_t)parts->tiles[k]; tiles != 0; tiles &= tiles - 1) {
        const int p = lowest_bit(tiles);
        const uint8_t *at = first + p / PARTS_SIDE * w->depth_row + p % PARTS_SIDE * w->depth_tile;
        __builtin_prefetch(at, 1, 3);
        __builtin_prefetch(at + 64, 1, 3);
        __builtin_prefetch(at + 128, 1, 3);
        __builtin_prefetch(at + 192, 1, 3);
    }
#else
    (void)w, (void)b, (void)parts, (void)k;
#endif
}

/* Triangle k in those of its tiles whose bits are set. */
LANE_INLINE void culled_draw_parts(const lmb_fill_window *w, const lmb_batch *b, const culled_parts *parts, int k,
                                   uint32_t id, int kind)
{
    const int32_t down = (b->y0[k] - w->y0) / LMB_TILE, across = (b->x0[k] - w->x0) / LMB_TILE;
    const int32_t ex[3] = {b->ex[0][k], b->ex[1][k], b->ex[2][k]}, ey[3] = {b->ey[0][k], b->ey[1][k], b->ey[2][k]};
    lmb_fill_tile tile = fill_first(w, kind);
    lmb_fill_job job;
    fill_triangle t;
    job.dx = parts->dx[k];
    job.dy = parts->dy[k];
    job.d_min = b->d_min[k];
    job.d_max = b->d_max[k];
    job.id = id;
    fill_set(&t, ex, ey, &job);
    const lanei e0 = lanei_add(lanei_splat(b->e[0][k]), t.step[0][0]),
                e1 = lanei_add(lanei_splat(b->e[1][k]), t.step[1][0]),
                e2 = lanei_add(lanei_splat(b->e[2][k]), t.step[2][0]);
    for (uint32_t tiles = (uint32_t)parts->tiles[k]; tiles != 0; tiles &= tiles - 1) {
        const int p = lowest_bit(tiles), py = p / PARTS_SIDE, px = p % PARTS_SIDE;
        const int32_t right = px * LMB_TILE, below = py * LMB_TILE;
        culled_set_tile(&tile, w, across + px, down + py);
        culled_cross_tiled(&tile, &t, lanei_add(e0, lanei_splat(ex[0] * right + ey[0] * below)),
                           lanei_add(e1, lanei_splat(ex[1] * right + ey[1] * below)),
                           lanei_add(e2, lanei_splat(ex[2] * right + ey[2] * below)), parts->d[p][k],
                           culled_bound(w, across + px, down + py), kind);
    }
}

/* Of `bits`, triangles of at most so many tiles each way. */
LANE_INLINE uint32_t culled_narrow(const lmb_batch *b, uint32_t bits, int32_t tiles)
{
    uint32_t narrow = 0;
    for (int k = 0; k < LMB_BATCH && bits >> k != 0; k += LANES) {
        const lanei x = lanei_sub(lanei_shift(lanei_load(b->x1 + k), 3), lanei_shift(lanei_load(b->x0 + k), 3)),
                    y = lanei_sub(lanei_shift(lanei_load(b->y1 + k), 3), lanei_shift(lanei_load(b->y0 + k), 3));
        narrow |= mask_bits(lanei_lt(lanei_max(x, y), lanei_splat(tiles))) << k;
    }
    return narrow & bits;
}

LANE_INLINE void culled_parts_find(culled_parts *out, const lmb_fill_window *w, const lmb_batch *b, uint32_t bits,
                                   int side)
{
    for (int k = 0; k < LMB_BATCH && bits >> k != 0; k += LANES) {
        lanei tiles = lanei_splat(0);
        lane_store(out->dx + k, lane_from_double(laned_load(b->dx + k)));
        lane_store(out->dy + k, lane_from_double(laned_load(b->dy + k)));
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                tiles = lanei_or(tiles, culled_parts_set(out, w, b, k, y * PARTS_SIDE + x));
            }
        }
        lanei_store(out->tiles + k, tiles);
    }
}

/* `kind` is a tiled one. */
LANE_INLINE void culled_small_parts(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits, uint32_t first_id,
                                    int kind)
{
    uint32_t narrow = culled_narrow(b, bits, 2);
    const uint32_t wider = culled_narrow(b, bits, 3);
    int side = 2;
    culled_parts parts;
    if (count_bits_16(wider & ~narrow) >= PARTS_MORE) {
        narrow = wider;
        side = 3;
    } else if (count_bits_16(narrow) < PARTS_LESS) {
        narrow = 0;
    }
    culled_parts_find(&parts, w, b, narrow, side);
    for (uint32_t left = narrow; left != 0; left &= left - 1) {
        culled_prefetch(w, b, &parts, lowest_bit(left));
    }
    for (; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        if (!(narrow >> k & 1u)) {
            culled_small_one(w, b, k, first_id + (uint32_t)k, kind);
        } else if (parts.tiles[k] != 0) {
            culled_draw_parts(w, b, &parts, k, first_id + (uint32_t)k, kind);
        }
    }
}
