/* fill_small.inl: a batch's small triangles into the tiles of a window, all in the backend's own code. Layer 3.
 *
 * Same sums as fill.inl, value by value. Visits only the rows of a triangle's box, and only tiles that are not outside
 * an edge. For a float target without ids, such as a shadow map, each row is one load and one store without a
 * branch. */

/* The part of the box inside a tile that starts at (x, y), rounded to begin at a multiple of `rows`. */
LANE_INLINE fill_box small_cut(const lmb_batch *b, int k, int32_t x, int32_t y, int32_t rows)
{
    fill_box box;
    box.first_row = (b->y0[k] > y ? b->y0[k] - y : 0) & ~(rows - 1);
    box.last_row = b->y1[k] < y + LMB_TILE ? b->y1[k] - y : LMB_TILE - 1;
    box.first = FILL_ACROSS > 1 && b->x0[k] > x ? (b->x0[k] - x) / LANES : 0;
    box.last = FILL_ACROSS > 1 && b->x1[k] < x + LMB_TILE ? (b->x1[k] - x) / LANES : FILL_ACROSS - 1;
    return box;
}

/* The largest gain of an edge within a tile. If even that leaves the edge negative, the tile is outside. */
LANE_INLINE int32_t small_reach(int32_t ex, int32_t ey)
{
    return (LMB_TILE - 1) * ((ex > 0 ? ex : 0) + (ey > 0 ? ey : 0));
}

/* e0 .. e2: the edges at the tile's first pixel. */
LANE_INLINE void small_tile(const lmb_fill_tile *tile, const lmb_fill_job *job, const fill_triangle *t, int32_t e0,
                            int32_t e1, int32_t e2, const fill_box *box)
{
    const int32_t e[3] = {e0 + t->ey[0] * box->first_row, e1 + t->ey[1] * box->first_row,
                          e2 + t->ey[2] * box->first_row};
#if LANES > 1
    if (t->codes) {
        fill_codes_rows((uint16_t *)tile->depth, job, t, e, job->d, box->first_row, box->last_row);
        return;
    }
#endif
    for (int32_t i = box->first; i <= box->last; ++i) {
        fill_column(tile, job, t, e, job->d, box, i);
    }
}

/* A triangle with a box in one tile, the most common case. */
LANE_INLINE void small_one(const lmb_fill_window *w, lmb_fill_job *job, const lmb_batch *b, int k,
                           const fill_triangle *t, int kind)
{
    const int32_t x = b->x0[k] & ~(LMB_TILE - 1), y = b->y0[k] & ~(LMB_TILE - 1);
    const ptrdiff_t down = (y - w->y0) / LMB_TILE, across = (x - w->x0) / LMB_TILE;
    const double d_row = b->dy[k] * ((y * 256 + w->origin_y) * (1.0 / 256.0));
    const fill_box box = small_cut(b, k, x, y, t->codes ? (int)FILL_PAIR : (int)FILL_ROWS);
    lmb_fill_tile tile = fill_first(w, kind);
    tile.depth = (uint8_t *)w->first.depth + down * w->depth_row + across * w->depth_tile;
    if (tile.id_format != LMB_FORMAT_NONE) {
        tile.id = (uint8_t *)w->first.id + down * w->id_row + across * w->id_tile;
    }
    job->d = (float)(b->d[k] + b->dx[k] * ((x * 256 + w->origin_x) * (1.0 / 256.0)) + d_row);
    small_tile(&tile, job, t, b->e[0][k], b->e[1][k], b->e[2][k], &box);
}

/* The three edges are unrolled: gcc -O2 keeps a loop of three, and arrays in memory. */
LANE_INLINE void small_fill(const lmb_fill_window *w, lmb_fill_job *job, const lmb_batch *b, int k,
                            const fill_triangle *t, int kind)
{
    if (LANES > 1 && ((b->x0[k] ^ b->x1[k]) | (b->y0[k] ^ b->y1[k])) < LMB_TILE) {
        small_one(w, job, b, k, t, kind);
        return;
    }
    const double d_origin = b->d[k], dx = b->dx[k], dy = b->dy[k];
    const int32_t left = b->x0[k] & ~(LMB_TILE - 1), top = b->y0[k] & ~(LMB_TILE - 1), right = b->x1[k],
                  bottom = b->y1[k];
    const int32_t reach0 = small_reach(t->ex[0], t->ey[0]), reach1 = small_reach(t->ex[1], t->ey[1]),
                  reach2 = small_reach(t->ex[2], t->ey[2]);
    const int32_t down = (top - w->y0) / LMB_TILE, across = (left - w->x0) / LMB_TILE;
    int32_t row0 = b->e[0][k], row1 = b->e[1][k], row2 = b->e[2][k];
    uint8_t *depth_row = (uint8_t *)w->first.depth + (ptrdiff_t)down * w->depth_row + (ptrdiff_t)across * w->depth_tile;
    lmb_fill_tile tile = fill_first(w, kind);
    const int ids = tile.id_format != LMB_FORMAT_NONE;
    uint8_t *id_row =
        ids ? (uint8_t *)w->first.id + (ptrdiff_t)down * w->id_row + (ptrdiff_t)across * w->id_tile : NULL;
    for (int32_t y = top; y <= bottom; y += LMB_TILE) {
        const double d_row = dy * ((y * 256 + w->origin_y) * (1.0 / 256.0));
        int32_t e0 = row0, e1 = row1, e2 = row2;
        tile.depth = depth_row;
        tile.id = id_row;
        for (int32_t x = left; x <= right; x += LMB_TILE) {
            if (((e0 + reach0) | (e1 + reach1) | (e2 + reach2)) >= 0) {
                const fill_box box = small_cut(b, k, x, y, t->codes ? (int)FILL_PAIR : (int)FILL_ROWS);
                job->d = (float)(d_origin + dx * ((x * 256 + w->origin_x) * (1.0 / 256.0)) + d_row);
                small_tile(&tile, job, t, e0, e1, e2, &box);
            }
            tile.depth = (uint8_t *)tile.depth + w->depth_tile;
            tile.id = ids ? (uint8_t *)tile.id + w->id_tile : NULL;
            e0 += t->ex[0] * LMB_TILE;
            e1 += t->ex[1] * LMB_TILE;
            e2 += t->ex[2] * LMB_TILE;
        }
        depth_row += w->depth_row;
        id_row = ids ? id_row + w->id_row : NULL;
        row0 += t->ey[0] * LMB_TILE;
        row1 += t->ey[1] * LMB_TILE;
        row2 += t->ey[2] * LMB_TILE;
    }
}

/* Draws triangle k of a batch by itself. */
LANE_INLINE void small_alone(const lmb_fill_window *w, const lmb_batch *b, int k, uint32_t id, int kind)
{
    const int32_t ex[3] = {b->ex[0][k], b->ex[1][k], b->ex[2][k]}, ey[3] = {b->ey[0][k], b->ey[1][k], b->ey[2][k]};
    fill_triangle t;
    lmb_fill_job job;
    job.d_scale = w->d_scale;
    job.d_bias = w->d_bias;
    job.dx = (float)b->dx[k];
    job.dy = (float)b->dy[k];
    job.d_min = b->d_min[k];
    job.d_max = b->d_max[k];
    job.id = id;
    fill_set(&t, ex, ey, &job, kind);
    small_fill(w, &job, b, k, &t, kind);
}

#if LANES >= LMB_TILE
#include "fill_rows.inl"
#include "fill_parts.inl"

NOINLINE void small_plain(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits)
{
    parts_fill_plain(w, b, bits, FILL_PLAIN, 0);
}

NOINLINE void small_codes(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits)
{
    parts_fill_plain(w, b, bits, FILL_CODES, 0);
}

NOINLINE void small_id32(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits)
{
    parts_fill_id32(w, b, bits, 0);
}
#endif

#if defined(LANE_PLAIN) && LANES > 1
#include "fill_tiny.inl"
#endif

/* One by one. */
#if LANES >= LMB_TILE
NOINLINE
#else
LANE_INLINE
#endif
void small_each(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits, int kind)
{
    lmb_fill_job job;
    job.d_scale = w->d_scale;
    job.d_bias = w->d_bias;
    for (; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        const int32_t ex[3] = {b->ex[0][k], b->ex[1][k], b->ex[2][k]}, ey[3] = {b->ey[0][k], b->ey[1][k], b->ey[2][k]};
        fill_triangle t;
#if defined(LANE_PLAIN) && LANES > 1
        if (kind == FILL_ID32 && tiny_is(b, k)) {
            tiny_fill(w, b, k);
            continue;
        }
#endif
        job.dx = (float)b->dx[k];
        job.dy = (float)b->dy[k];
        job.d_min = b->d_min[k];
        job.d_max = b->d_max[k];
        job.id = b->id[k];
        fill_set(&t, ex, ey, &job, FILL_ANY);
        switch (kind) {
        case FILL_PLAIN: small_fill(w, &job, b, k, &t, FILL_PLAIN); break;
        case FILL_ID32: small_fill(w, &job, b, k, &t, FILL_ID32); break;
        default: small_fill(w, &job, b, k, &t, FILL_ANY); break;
        }
    }
}

/* Tiles are addressed by 32-bit byte offsets from the first one, with ids at the offsets of depths. Triangles go one by
 * one on other surfaces. */
LANE_INLINE int small_kind(const lmb_fill_window *w)
{
    const int kind = fill_kind(w);
    const int is_apart = kind == FILL_ID32 && w->id_row != w->depth_row;
    return is_apart || (int64_t)w->depth_row * w->tiles_y > INT32_MAX ? FILL_ANY : kind;
}

#if LANES > 1 && LANES < LMB_TILE
NOINLINE void small_codes(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits)
{
    for (; bits != 0; bits &= bits - 1) {
        small_alone(w, b, lowest_bit(bits), 0, FILL_CODES);
    }
}
#endif

static void KERNEL(fill_small)(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits)
{
    const int kind = small_kind(w);
#if LANES > 1
    if (kind == FILL_CODES) {
        small_codes(w, b, bits);
        return;
    }
#endif
#if LANES >= LMB_TILE
    if (kind == FILL_PLAIN) {
        small_plain(w, b, bits);
        return;
    }
    if (kind == FILL_ID32) {
        small_id32(w, b, bits);
        return;
    }
#endif
    small_each(w, b, bits, kind);
}
