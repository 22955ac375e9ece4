/* fill_parts.inl: a batch's small triangles into tiled tiles, for backends of a row's lanes or more. Layer 3.
 *
 * Most triangles touch at most two or three tiles in each direction. The tiles in which they have pixels, and the edges
 * and depth at the first pixel of a tile, are computed for LANES triangles at a time. The rest is a loop that draws
 * these tiles. A loop over the tiles of each triangle would be mispredicted once per triangle, which costs about as
 * much as a tile.
 *
 * If tiles have bounds of their farthest depth (culled.inl), tiles that hide their part of a triangle are skipped. */

/* Tile p of a triangle lies p % PARTS_SIDE to the right of the first one, and p / PARTS_SIDE below. */
enum { PARTS_SIDE = 3, PARTS_TILES = PARTS_SIDE * PARTS_SIDE };

/* For ids, order matters: with at least PARTS_MORE triangles of three tiles in a direction, nine tiles are tested
 * instead of four; with fewer than PARTS_LESS of two, triangles go one by one. */
enum { PARTS_MORE = 3, PARTS_LESS = 3 };

typedef struct fill_slopes {
    float dx[LMB_BATCH], dy[LMB_BATCH];
    int32_t edge[3][LMB_BATCH]; /* rows_slope of the edges */
} fill_slopes;

/* The nearest depth of planes in a tile with the nearest point (x, y), px, computed as for pixels. If the plane has no
 * value there, pixels may get any. */
LANE_INLINE lane parts_nearest(lane d, lane dx, lane dy, lane x, lane y, lane d_min, lane d_max)
{
    const lane at = lane_add(lane_add(d, lane_mul(dy, y)), lane_mul(dx, x));
    return lane_pick(lane_lt(at, d_max), lane_max(at, d_min), d_max);
}

/* (x, y): px of the frame, first pixels of the tiles. */
LANE_INLINE lane parts_depth(const lmb_fill_window *w, const lmb_batch *b, int k, lanei x, lanei y)
{
    const lanei to_24_8 = lanei_splat(256);
    const laned to_px = laned_splat(1.0 / 256.0);
    const laned right = laned_from_int(lanei_add(lanei_mul(x, to_24_8), lanei_splat(w->origin_x))),
                down = laned_from_int(lanei_add(lanei_mul(y, to_24_8), lanei_splat(w->origin_y)));
    const laned d = laned_add(laned_load(b->d + k), laned_mul(laned_load(b->dx + k), laned_mul(right, to_px)));
    return lane_from_double(laned_add(d, laned_mul(laned_load(b->dy + k), laned_mul(down, to_px))));
}

/* Tile (px, py) of triangles k .. k + LANES - 1: returns the triangles with pixels that may show in it, and sets the
 * halves they are in. Sets the depth at the first pixel. */
LANE_INLINE lane_mask parts_set(float *depth, lane_mask halves[2], const fill_slopes *slopes, const lmb_fill_window *w,
                                const lmb_batch *b, int k, lanei px, lanei py, int bounded)
{
    const lanei zero = lanei_splat(0), last = lanei_splat(LMB_TILE - 1);
    const lanei x0 = lanei_load(b->x0 + k), y0 = lanei_load(b->y0 + k);
    const lanei across = lanei_add(lanei_shift(x0, 3), px), down = lanei_add(lanei_shift(y0, 3), py);
    const lanei side = lanei_splat(LMB_TILE), x = lanei_mul(across, side), y = lanei_mul(down, side);
    const lanei to_x = lanei_mul(px, side), to_y = lanei_mul(py, side);
    const lanei left = lanei_max(lanei_sub(x0, x), zero), top = lanei_max(lanei_sub(y0, y), zero);
    const lanei right = lanei_min(lanei_sub(lanei_load(b->x1 + k), x), last),
                bottom = lanei_min(lanei_sub(lanei_load(b->y1 + k), y), last);
    const lanei width = lanei_sub(right, left), height = lanei_sub(bottom, top);
    lanei inside = lanei_or(width, height);
    halves[0] = lanei_lt(bottom, lanei_splat(LMB_TILE / 2));
    halves[1] = lanei_lt(lanei_splat(LMB_TILE / 2 - 1), top);
    /* The part of the box in the tile. From the first pixel of this part, an edge gains at most its positive steps. */
    const lanei corner = rows_way(lanei_add(to_x, left), lanei_add(to_y, top)), box = rows_way(width, height);
    for (int i = 0; i < 3; ++i) {
        const lanei first = rows_gain(lanei_load(slopes->edge[i] + k), corner);
        const lanei rise =
            rows_slope(lanei_max(lanei_load(b->ex[i] + k), zero), lanei_max(lanei_load(b->ey[i] + k), zero));
        const lanei gain = rows_gain(rise, box);
        inside = lanei_or(inside, lanei_add(lanei_add(lanei_load(b->e[i] + k), first), gain));
    }
    const lane d = parts_depth(w, b, k, x, y);
    lane_store(depth + k, d);
    lane_mask seen = lanei_not_negative(inside);
#if LMB_CULLING
    if (bounded && mask_bits(seen) != 0) {
        const lane dx = lane_load(slopes->dx + k), dy = lane_load(slopes->dy + k), zerof = lane_splat(0.0f);
        const lane near = parts_nearest(d, dx, dy, lane_from_int(lanei_pick(lane_lt(zerof, dx), right, left)),
                                        lane_from_int(lanei_pick(lane_lt(zerof, dy), bottom, top)),
                                        lane_load(b->d_min + k), lane_load(b->d_max + k));
        const lanei at = lanei_add(lanei_mul(lanei_sub(down, lanei_splat(w->y0 / LMB_TILE)), lanei_splat(w->tiles_x)),
                                   lanei_sub(across, lanei_splat(w->x0 / LMB_TILE)));
        seen = mask_and(seen, lane_lt(lane_gather_f32(w->farthest, lanei_pick(seen, at, zero)), near));
    }
#else
    (void)slopes, (void)bounded;
#endif
    return seen;
}

/* Draws triangle k in its tile (px, py). e0 .. e2, d: edges and depth at the tile's first pixel. */
LANE_INLINE void parts_draw(const lmb_fill_window *w, const lmb_batch *b, int k, int32_t px, int32_t py, int32_t e0,
                            int32_t e1, int32_t e2, float d, float dx, float dy, uint32_t id, int kind, int bounded)
{
    const ptrdiff_t across = ((b->x0[k] - w->x0) >> 3) + px, down = ((b->y0[k] - w->y0) >> 3) + py;
    const int32_t ex[3] = {b->ex[0][k], b->ex[1][k], b->ex[2][k]}, ey[3] = {b->ey[0][k], b->ey[1][k], b->ey[2][k]};
    fill_rows r;
    r.e0 = lanei_affine(e0, ex[0], ey[0], 0);
    r.e1 = lanei_affine(e1, ex[1], ey[1], 0);
    r.e2 = lanei_affine(e2, ex[2], ey[2], 0);
    r.down0 = lanei_splat(ey[0] * FILL_ROWS);
    r.down1 = lanei_splat(ey[1] * FILL_ROWS);
    r.down2 = lanei_splat(ey[2] * FILL_ROWS);
    r.step_d = lane_mul(lane_splat(dx), lane_column(0));
    r.d_min = lane_splat(b->d_min[k]);
    r.d_max = lane_splat(b->d_max[k]);
    r.depth = (float *)(void *)((uint8_t *)w->first.depth + down * w->depth_row + across * w->depth_tile);
    r.codes = (uint16_t *)(void *)r.depth;
    r.scale = lane_splat(w->d_scale);
    r.bias = lane_splat(w->d_bias);
    r.ids = kind == FILL_ID32 ? (uint32_t *)(void *)((uint8_t *)w->first.id + down * w->id_row + across * w->id_tile)
                              : NULL;
    r.id = id;
    rows_draw(&r, d, dy, ROWS_ALL, kind);
#if LMB_CULLING
    if (bounded && w->bounds == LMB_BOUNDS_RAISED) {
        rows_raise(w->farthest + down * w->tiles_x + across, r.lowest);
    }
#else
    (void)bounded;
#endif
}

/* Triangles among `bits` of at most `tiles` tiles in each direction. */
LANE_INLINE uint32_t parts_narrow(const lmb_batch *b, uint32_t bits, int32_t tiles)
{
    uint32_t narrow = 0;
    for (int k = 0; k < LMB_BATCH && bits >> k != 0; k += LANES) {
        const lanei x = lanei_sub(lanei_shift(lanei_load(b->x1 + k), 3), lanei_shift(lanei_load(b->x0 + k), 3)),
                    y = lanei_sub(lanei_shift(lanei_load(b->y1 + k), 3), lanei_shift(lanei_load(b->y0 + k), 3));
        narrow |= mask_bits(lanei_lt(lanei_max(x, y), lanei_splat(tiles))) << k;
    }
    return narrow & bits;
}

LANE_INLINE void parts_slopes(fill_slopes *out, const lmb_batch *b, uint32_t bits)
{
    for (int k = 0; k < LMB_BATCH && bits >> k != 0; k += LANES) {
        lane_store(out->dx + k, lane_from_double(laned_load(b->dx + k)));
        lane_store(out->dy + k, lane_from_double(laned_load(b->dy + k)));
        for (int i = 0; i < 3; ++i) {
            lanei_store(out->edge[i] + k, rows_slope(lanei_load(b->ex[i] + k), lanei_load(b->ey[i] + k)));
        }
    }
}

/* PARTS_TOGETHER tiles of each triangle are found before any is drawn. Drawing is then one long loop, with one
 * misprediction at the end. In surfaces over PARTS_CACHED bytes, tiles are prefetched PARTS_AHEAD tiles before they are
 * drawn. */
enum { PARTS_TOGETHER = 4, PARTS_AHEAD = 6, PARTS_CACHED = 6 << 20 };

/* Four tiles of each triangle: the depth at the first pixels, and byte offsets in the depth surface. Bit i LMB_BATCH +
 * k of rows is set if triangle k has pixels that may show in its tile i: in all rows, the upper half, the lower
 * half. */
typedef struct fill_places {
    float d[PARTS_TOGETHER][LMB_BATCH];
    int32_t at[PARTS_TOGETHER][LMB_BATCH];
    uint64_t rows[3];
} fill_places;

/* Order of tiles: the first four go together, because most triangles have no others; then the tiles beside these. */
static const uint8_t parts_order[PARTS_TILES] = {0, 1, 3, 4, 2, 5, 6, 7, 8};

/* Ways from a triangle's first tile to the pixels of a vector: the first rows of these tiles, and of their lower
 * halves. */
#define PARTS_ROW(x, y) (x) + ((y) << 16), (x) + 1 + ((y) << 16), (x) + 2 + ((y) << 16), (x) + 3 + ((y) << 16), \
                        (x) + 4 + ((y) << 16), (x) + 5 + ((y) << 16), (x) + 6 + ((y) << 16), (x) + 7 + ((y) << 16)
#define PARTS_ROWS(x, y) {{PARTS_ROW(x, y), PARTS_ROW(x, (y) + 1)}, {PARTS_ROW(x, (y) + 4), PARTS_ROW(x, (y) + 5)}}
static const int32_t parts_at[PARTS_TILES][2][16] = {
    PARTS_ROWS(0, 0), PARTS_ROWS(8, 0), PARTS_ROWS(0, 8), PARTS_ROWS(8, 8), PARTS_ROWS(16, 0),
    PARTS_ROWS(16, 8), PARTS_ROWS(0, 16), PARTS_ROWS(8, 16), PARTS_ROWS(16, 16)};
#undef PARTS_ROW
#undef PARTS_ROWS

LANE_INLINE lanei parts_address(const lmb_fill_window *w, const lmb_batch *b, int k, int p)
{
    const int32_t px = p % PARTS_SIDE - w->x0 / LMB_TILE, py = p / PARTS_SIDE - w->y0 / LMB_TILE;
    const lanei across = lanei_add(lanei_shift(lanei_load(b->x0 + k), 3), lanei_splat(px)),
                down = lanei_add(lanei_shift(lanei_load(b->y0 + k), 3), lanei_splat(py));
    return lanei_add(lanei_mul(across, lanei_splat(w->depth_tile)), lanei_mul(down, lanei_splat(w->depth_row)));
}

/* 1 if one of the vector of triangles from k on is to be drawn. Otherwise set-up stored nothing for them, and old
 * values may address tiles anywhere. */
static inline int parts_any(uint32_t bits, int k) { return (bits >> k & ((1u << LANES) - 1u)) != 0; }

/* Finds tile i of a group, which is tile p of the triangles. */
LANE_INLINE void parts_place(fill_places *out, const fill_slopes *slopes, const lmb_fill_window *w, const lmb_batch *b,
                             uint32_t bits, int i, int p, int bounded)
{
    const lanei px = lanei_splat(p % PARTS_SIDE), py = lanei_splat(p / PARTS_SIDE);
    uint32_t seen = 0, upper = 0, lower = 0;
    for (int k = 0; k < LMB_BATCH && bits >> k != 0; k += LANES) {
        if (!parts_any(bits, k)) {
            continue;
        }
        lane_mask halves[2];
        seen |= mask_bits(parts_set(out->d[i], halves, slopes, w, b, k, px, py, bounded)) << k;
        upper |= mask_bits(halves[0]) << k;
        lower |= mask_bits(halves[1]) << k;
        lanei_store(out->at[i] + k, parts_address(w, b, k, p));
    }
    seen &= bits;
    out->rows[ROWS_ALL] |= (uint64_t)(seen & ~(upper | lower)) << (i * LMB_BATCH);
    out->rows[ROWS_UPPER] |= (uint64_t)(seen & upper) << (i * LMB_BATCH);
    out->rows[ROWS_LOWER] |= (uint64_t)(seen & lower) << (i * LMB_BATCH);
}

/* An edge at the pixels of a vector, from a triangle's first tile. */
LANE_INLINE lanei parts_edge(const fill_slopes *slopes, const lmb_batch *b, int i, int k, const int32_t *at)
{
    return lanei_add(lanei_splat(b->e[i][k]), rows_gain(lanei_splat(slopes->edge[i][k]), lanei_load(at)));
}

LANE_INLINE void parts_edges(fill_rows *r, const fill_slopes *slopes, const lmb_batch *b, int k, int i, int rows)
{
    const int32_t *at = parts_at[i][rows == ROWS_LOWER];
    r->e0 = parts_edge(slopes, b, 0, k, at);
    r->e1 = parts_edge(slopes, b, 1, k, at);
    r->e2 = parts_edge(slopes, b, 2, k, at);
    r->down0 = lanei_splat(b->ey[0][k] * FILL_ROWS);
    r->down1 = lanei_splat(b->ey[1][k] * FILL_ROWS);
    r->down2 = lanei_splat(b->ey[2][k] * FILL_ROWS);
}

/* Draws tile i of a group that starts at tile `first` of parts_order. */
LANE_INLINE void parts_put(const fill_places *places, const fill_slopes *slopes, const lmb_fill_window *w,
                           const lmb_batch *b, int k, int i, int first, int rows, int kind, int bounded)
{
    fill_rows r;
    parts_edges(&r, slopes, b, k, first + i, rows);
    r.step_d = lane_mul(lane_splat(slopes->dx[k]), lane_column(0));
    r.d_min = lane_splat(b->d_min[k]);
    r.d_max = lane_splat(b->d_max[k]);
    r.depth = (float *)(void *)((uint8_t *)w->first.depth + places->at[i][k]);
    r.codes = (uint16_t *)(void *)r.depth;
    r.scale = lane_splat(w->d_scale);
    r.bias = lane_splat(w->d_bias);
    r.ids = NULL;
    r.id = 0;
    rows_draw(&r, places->d[i][k], slopes->dy[k], rows, kind);
#if LMB_CULLING
    if (bounded && w->bounds == LMB_BOUNDS_RAISED) {
        const int p = parts_order[first + i];
        const ptrdiff_t across = ((b->x0[k] - w->x0) >> 3) + p % PARTS_SIDE,
                        down = ((b->y0[k] - w->y0) >> 3) + p / PARTS_SIDE;
        rows_raise(w->farthest + down * w->tiles_x + across, r.lowest);
    }
#else
    (void)bounded;
#endif
}

/* As lowest_bit_64, in one instruction if there is one. */
LANE_INLINE int parts_lowest(uint64_t bits)
{
#if defined(__GNUC__)
    return __builtin_ctzll(bits);
#else
    return lowest_bit_64(bits);
#endif
}

/* Prefetches a tile, or half of one, that will be drawn to soon. */
LANE_INLINE void parts_soon(const fill_places *places, const lmb_fill_window *w, int bit, int rows, int kind)
{
    const uint8_t *depth = (const uint8_t *)w->first.depth + places->at[bit / LMB_BATCH][bit % LMB_BATCH];
    if (kind == FILL_CODES) {
        MESH_SOON(depth), MESH_SOON(depth + 64);
        return;
    }
    if (rows != ROWS_LOWER) {
        MESH_SOON(depth), MESH_SOON(depth + 64);
    }
    if (rows != ROWS_UPPER) {
        MESH_SOON(depth + 128), MESH_SOON(depth + 192);
    }
}

/* Prefetches the first PARTS_AHEAD of the tiles `rows`. Returns the others, or none if the surface fits the cache. */
LANE_INLINE uint64_t parts_begin(const fill_places *places, const lmb_fill_window *w, int rows, int kind)
{
    uint64_t left = (int64_t)w->depth_row * w->tiles_y > PARTS_CACHED ? places->rows[rows] : 0;
    for (int n = 0; n < PARTS_AHEAD && left != 0; ++n, left &= left - 1) {
        parts_soon(places, w, parts_lowest(left), rows, kind);
    }
    return left;
}

/* ahead: the result of parts_begin. */
LANE_INLINE void parts_put_all(const fill_places *places, const fill_slopes *slopes, const lmb_fill_window *w,
                               const lmb_batch *b, uint64_t ahead, int first, int rows, int kind, int bounded)
{
    for (uint64_t left = places->rows[rows]; left != 0; left &= left - 1) {
        const int bit = parts_lowest(left), k = bit % LMB_BATCH, i = bit / LMB_BATCH;
        if (ahead != 0) {
            parts_soon(places, w, parts_lowest(ahead), rows, kind);
            ahead &= ahead - 1;
        }
        parts_put(places, slopes, w, b, k, i, first, rows, kind, bounded);
    }
}

/* Draws tiles `first` and on, in parts_order, of triangles `bits`. */
LANE_INLINE void parts_together(const fill_slopes *slopes, const lmb_fill_window *w, const lmb_batch *b, uint32_t bits,
                                int first, int kind, int bounded)
{
    fill_places places;
    places.rows[0] = places.rows[1] = places.rows[2] = 0;
    for (int i = 0; i < PARTS_TOGETHER && first + i < PARTS_TILES; ++i) {
        parts_place(&places, slopes, w, b, bits, i, parts_order[first + i], bounded);
    }
#if LMB_CULLING
    if (bounded && w->bounds == LMB_BOUNDS_RAISED) {
        places.rows[ROWS_ALL] |= places.rows[ROWS_UPPER] | places.rows[ROWS_LOWER];
        places.rows[ROWS_UPPER] = places.rows[ROWS_LOWER] = 0;
    }
#endif
    const uint64_t ahead = parts_begin(&places, w, ROWS_ALL, kind),
                   ahead_upper = parts_begin(&places, w, ROWS_UPPER, kind),
                   ahead_lower = parts_begin(&places, w, ROWS_LOWER, kind);
    parts_put_all(&places, slopes, w, b, ahead, first, ROWS_ALL, kind, bounded);
    parts_put_all(&places, slopes, w, b, ahead_upper, first, ROWS_UPPER, kind, 0);
    parts_put_all(&places, slopes, w, b, ahead_lower, first, ROWS_LOWER, kind, 0);
}

/* Tiles of triangles with ids, in triangle order, because ids depend on the order. If no triangle has more than four
 * tiles, tile i of parts_order of triangle k is bit 4 k + i: in left[0] if it has pixels that may show in the upper
 * half, in left[1] for the lower. Halves are independent, so each is one loop. With more tiles it is bit 16 (k % 4) + i
 * of left[k / 4]. */
typedef struct fill_found {
    fill_slopes slopes;
    float d[PARTS_TILES][LMB_BATCH];
    int32_t at[LMB_BATCH];     /* byte offset of a triangle's first tile */
    int32_t step[PARTS_TILES]; /* from there to tile i */
    uint64_t left[4];
} fill_found;

/* Bit k becomes bit 4 k. */
LANE_INLINE uint64_t parts_by_four(uint32_t bits)
{
    uint64_t v = bits;
    v = (v | v << 24) & 0x000000ff000000ffu;
    v = (v | v << 12) & 0x000f000f000f000fu;
    v = (v | v << 6) & 0x0303030303030303u;
    return (v | v << 3) & 0x1111111111111111u;
}

/* Bit k of four becomes bit 16 k. */
LANE_INLINE uint64_t parts_by_sixteen(uint32_t bits)
{
    return (bits & 15u) * (uint64_t)0x0000200040008001u & 0x0001000100010001u;
}

LANE_INLINE void parts_find(fill_found *out, const lmb_fill_window *w, const lmb_batch *b, uint32_t bits, int more,
                            int bounded)
{
    out->left[0] = out->left[1] = out->left[2] = out->left[3] = 0;
    for (int k = 0; k < LMB_BATCH && bits >> k != 0; k += LANES) {
        lanei_store(out->at + k, parts_address(w, b, k, 0));
    }
    for (int i = 0; i < (more ? (int)PARTS_TILES : (int)PARTS_TOGETHER); ++i) {
        const int p = parts_order[i];
        uint32_t seen = 0, upper = 0, lower = 0;
        out->step[i] = p % PARTS_SIDE * w->depth_tile + p / PARTS_SIDE * w->depth_row;
        for (int k = 0; k < LMB_BATCH && bits >> k != 0; k += LANES) {
            if (parts_any(bits, k)) {
                lane_mask halves[2];
                seen |= mask_bits(parts_set(out->d[i], halves, &out->slopes, w, b, k, lanei_splat(p % PARTS_SIDE),
                                            lanei_splat(p / PARTS_SIDE), bounded))
                        << k;
                upper |= mask_bits(halves[0]) << k;
                lower |= mask_bits(halves[1]) << k;
            }
        }
        seen &= bits;
        if (!more) {
            out->left[0] |= parts_by_four(seen & ~lower) << i;
            out->left[1] |= parts_by_four(seen & ~upper) << i;
        }
        for (int c = 0; more && c < LMB_BATCH / 4; ++c) {
            out->left[c] |= parts_by_sixteen(seen >> 4 * c) << i;
        }
    }
}

/* The same, if the edges are not computed yet. */
LANE_INLINE void parts_draw_from(const lmb_fill_window *w, const lmb_batch *b, int k, int32_t px, int32_t py, float d,
                                 float dx, float dy, uint32_t id, int kind, int bounded)
{
    const int32_t x = px * LMB_TILE, y = py * LMB_TILE;
    parts_draw(w, b, k, px, py, b->e[0][k] + b->ex[0][k] * x + b->ey[0][k] * y,
               b->e[1][k] + b->ex[1][k] * x + b->ey[1][k] * y, b->e[2][k] + b->ex[2][k] * x + b->ey[2][k] * y, d, dx,
               dy, id, kind, bounded);
}

/* Draws tile i of triangle k. */
LANE_INLINE void parts_put_id(const fill_found *f, const lmb_fill_window *w, const lmb_batch *b, int k, int i, int rows,
                              int bounded)
{
    const ptrdiff_t at = (ptrdiff_t)f->at[k] + f->step[i];
    fill_rows r;
    parts_edges(&r, &f->slopes, b, k, i, rows);
    r.step_d = lane_mul(lane_splat(f->slopes.dx[k]), lane_column(0));
    r.d_min = lane_splat(b->d_min[k]);
    r.d_max = lane_splat(b->d_max[k]);
    r.depth = (float *)(void *)((uint8_t *)w->first.depth + at);
    r.ids = (uint32_t *)(void *)((uint8_t *)w->first.id + at);
    r.id = b->id[k];
    rows_draw(&r, f->d[i][k], f->slopes.dy[k], rows, FILL_ID32);
#if LMB_CULLING
    if (bounded && w->bounds == LMB_BOUNDS_RAISED) {
        const int p = parts_order[i];
        const ptrdiff_t across = ((b->x0[k] - w->x0) >> 3) + p % PARTS_SIDE,
                        down = ((b->y0[k] - w->y0) >> 3) + p / PARTS_SIDE;
        rows_raise(w->farthest + down * w->tiles_x + across, r.lowest);
    }
#else
    (void)bounded;
#endif
}

/* Prefetches half of a tile that will be drawn to soon. */
LANE_INLINE void parts_soon_id(const fill_found *f, const lmb_fill_window *w, int bit, int rows)
{
    const ptrdiff_t at = (ptrdiff_t)f->at[bit >> 2] + f->step[bit & 3] + (rows == ROWS_LOWER ? 128 : 0);
    const uint8_t *depth = (const uint8_t *)w->first.depth + at, *id = (const uint8_t *)w->first.id + at;
    MESH_SOON(depth), MESH_SOON(depth + 64), MESH_SOON(id), MESH_SOON(id + 64);
}

/* Draws `rows` of tiles `left`, four a triangle. Depth and ids are twice the bytes of depth. */
LANE_INLINE void parts_put_fours(const fill_found *f, const lmb_fill_window *w, const lmb_batch *b, uint64_t left,
                                 int rows, int bounded)
{
    uint64_t ahead = 2 * (int64_t)w->depth_row * w->tiles_y > PARTS_CACHED ? left : 0;
    for (int n = 0; n < PARTS_AHEAD && ahead != 0; ++n, ahead &= ahead - 1) {
        parts_soon_id(f, w, parts_lowest(ahead), rows);
    }
    for (; left != 0; left &= left - 1) {
        const int bit = parts_lowest(left), k = bit >> 2;
        if (ahead != 0) {
            parts_soon_id(f, w, parts_lowest(ahead), rows);
            ahead &= ahead - 1;
        }
        parts_put_id(f, w, b, k, bit & 3, rows, bounded);
    }
}

/* Draws all tiles of triangles `bits`. A tile's bound is raised with all rows. */
LANE_INLINE void parts_run(const fill_found *f, const lmb_fill_window *w, const lmb_batch *b, uint32_t bits, int more,
                           int bounded)
{
    const uint64_t own = parts_by_four(bits) * 15u;
    for (int c = 0; more && c < LMB_BATCH / 4; ++c) {
        for (uint64_t left = f->left[c] & parts_by_sixteen(bits >> 4 * c) * 0xffffu; left != 0; left &= left - 1) {
            const int bit = parts_lowest(left), k = 4 * c + (bit >> 4);
            parts_put_id(f, w, b, k, bit & 15, ROWS_ALL, bounded);
        }
    }
    if (more) {
        return;
    }
#if LMB_CULLING
    if (bounded && w->bounds == LMB_BOUNDS_RAISED) {
        parts_put_fours(f, w, b, (f->left[0] | f->left[1]) & own, ROWS_ALL, 1);
        return;
    }
#endif
    parts_put_fours(f, w, b, f->left[0] & own, ROWS_UPPER, 0);
    parts_put_fours(f, w, b, f->left[1] & own, ROWS_LOWER, 0);
}

/* --- more tiles --------------------------------------------------------------------------------------------------- */

/* Tests LANES tiles of triangle k from its tile (px, py) on. Returns those with pixels that may show, one bit each. d:
 * the depth at the first pixels. */
LANE_INLINE uint32_t parts_row(float *d, const lmb_fill_window *w, const lmb_batch *b, int k, int32_t px, int32_t py,
                               int bounded)
{
    static const int32_t steps[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const int32_t y = (b->y0[k] & ~(LMB_TILE - 1)) + py * LMB_TILE;
    const lanei at = lanei_add(lanei_load(steps), lanei_splat(px));
    const lanei x = lanei_add(lanei_splat(b->x0[k] & ~(LMB_TILE - 1)), lanei_mul(at, lanei_splat(LMB_TILE)));
    const laned right = laned_mul(laned_from_int(lanei_add(lanei_mul(x, lanei_splat(256)), lanei_splat(w->origin_x))),
                                  laned_splat(1.0 / 256.0));
    const double down = b->dy[k] * ((y * 256 + w->origin_y) * (1.0 / 256.0));
    const lane first = lane_from_double(
        laned_add(laned_add(laned_splat(b->d[k]), laned_mul(laned_splat(b->dx[k]), right)), laned_splat(down)));
    lanei inside = lanei_sub(lanei_splat(b->x1[k]), x);
    for (int i = 0; i < 3; ++i) {
        const int32_t ex = b->ex[i][k], ey = b->ey[i][k];
        const int32_t e = b->e[i][k] + ey * py * LMB_TILE + small_reach(ex, ey);
        inside = lanei_or(inside, lanei_add(lanei_splat(e), lanei_mul(at, lanei_splat(ex * LMB_TILE))));
    }
    lane_store(d, first);
    uint32_t seen = mask_bits(lanei_not_negative(inside));
#if LMB_CULLING
    if (bounded && seen != 0) {
        const float dx = (float)b->dx[k], dy = (float)b->dy[k], end = (float)(LMB_TILE - 1);
        const lane near = parts_nearest(first, lane_splat(dx), lane_splat(dy), lane_splat(dx > 0.0f ? end : 0.0f),
                                        lane_splat(dy > 0.0f ? end : 0.0f), lane_splat(b->d_min[k]),
                                        lane_splat(b->d_max[k]));
        const ptrdiff_t across = ((b->x0[k] - w->x0) >> 3) + px, below = ((b->y0[k] - w->y0) >> 3) + py;
        seen &= mask_bits(lane_lt(lane_load(w->farthest + below * w->tiles_x + across), near));
    }
#else
    (void)bounded;
#endif
    return seen;
}

LANE_INLINE void parts_wide(const lmb_fill_window *w, const lmb_batch *b, int k, uint32_t id, int kind, int bounded)
{
    const int32_t across = (b->x1[k] >> 3) - (b->x0[k] >> 3), down = (b->y1[k] >> 3) - (b->y0[k] >> 3);
    const float dx = (float)b->dx[k], dy = (float)b->dy[k];
    for (int32_t py = 0; py <= down; ++py) {
        for (int32_t px = 0; px <= across; px += LANES) {
            float d[LANES];
            for (uint32_t seen = parts_row(d, w, b, k, px, py, bounded); seen != 0; seen &= seen - 1) {
                const int i = lowest_bit(seen);
                parts_draw_from(w, b, k, px + i, py, d[i], dx, dy, id, kind, bounded);
            }
        }
    }
}

/* Without ids, triangles and tiles may be drawn in any order, because each pixel keeps the nearest depth. */
LANE_INLINE void parts_fill_plain(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits, int kind, int bounded)
{
    const uint32_t wider = parts_narrow(b, bits, PARTS_SIDE), beside = wider & ~parts_narrow(b, bits, 2);
    if (wider != 0) {
        fill_slopes slopes;
        parts_slopes(&slopes, b, wider);
        parts_together(&slopes, w, b, wider, 0, kind, bounded);
        for (int first = PARTS_TOGETHER; first < PARTS_TILES && beside != 0; first += PARTS_TOGETHER) {
            parts_together(&slopes, w, b, beside, first, kind, bounded);
        }
    }
    for (bits &= ~wider; bits != 0; bits &= bits - 1) {
        /* Without bounds, sixteen lanes draw wider triangles one by one: most rows are skipped then. */
        if (LANES > LMB_TILE && !bounded) {
            small_alone(w, b, lowest_bit(bits), 0, kind);
        } else {
            parts_wide(w, b, lowest_bit(bits), 0, kind, bounded);
        }
    }
}

/* Draws in order, because ids depend on the order. */
LANE_INLINE void parts_fill_id32(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits, int bounded)
{
    uint32_t narrow = parts_narrow(b, bits, 2);
    const uint32_t wider = parts_narrow(b, bits, PARTS_SIDE);
    const int more = count_bits_16(wider & ~narrow) >= PARTS_MORE;
    fill_found found;
    narrow = more ? wider : count_bits_16(narrow) < PARTS_LESS ? 0 : narrow;
    parts_slopes(&found.slopes, b, narrow);
    parts_find(&found, w, b, narrow, more, bounded);
    while (bits != 0) { /* a run of narrow ones, then a wide one */
        const uint32_t wide = bits & ~narrow, run = wide != 0 ? bits & ((wide & (0u - wide)) - 1) : bits;
        parts_run(&found, w, b, run, more, bounded);
        bits &= ~run;
        if (wide != 0) {
            const int k = lowest_bit(wide);
            parts_wide(w, b, k, b->id[k], FILL_ID32, bounded);
            bits &= bits - 1;
        }
    }
}
