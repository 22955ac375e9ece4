/* culled.inl: the fill kernels for windows with a bound of the farthest depth in each tile. Layer 3.
 *
 * Triangles behind a whole tile are skipped. The bound is at most every depth of the tile. It is compared with the
 * nearest depth of the triangle's plane over the covered part of the tile, at one corner, by the same operations as for
 * each pixel. These round monotonically, so no pixel is nearer, and the comparison needs no margin. Equal depths are
 * skipped, too, because the earlier draw stays. All other pixels are those of fill_small.inl and fill_large.inl, value
 * by value. */

/* The farthest depth of a tile. */
LANE_INLINE float culled_look(const lmb_fill_tile *tile)
{
    lane lowest = lane_splat(3e38f);
    for (int32_t y = 0; y < LMB_TILE; y += FILL_ROWS) {
        for (int32_t i = 0; i < FILL_ACROSS; ++i) {
            const int32_t at = y * tile->depth_step + i * LANES;
            lowest = lane_min(lowest, tile->depth_format == LMB_DEPTH32F
                                        ? lane_load_rows((const float *)tile->depth + at, tile->depth_step)
                                        : lane_load_u16((const uint16_t *)tile->depth + at, tile->depth_step));
        }
    }
    return lane_lowest(lowest);
}

static int KERNEL(culled_box)(const lmb_fill_window *w, const lmb_tile_box *box, float nearest)
{
    lmb_fill_tile tile = w->first;
    for (int32_t y = box->y0; y <= box->y1; ++y) {
        float *bound = w->farthest + (ptrdiff_t)y * w->tiles_x;
        for (int32_t x = box->x0; x <= box->x1; ++x) {
            if (bound[x] >= nearest) {
                continue;
            }
            tile.depth = (uint8_t *)w->first.depth + (ptrdiff_t)y * w->depth_row + (ptrdiff_t)x * w->depth_tile;
            bound[x] = culled_look(&tile);
            if (!(bound[x] >= nearest)) {
                return 0;
            }
        }
    }
    return 1;
}

#if LANES >= LMB_TILE
LANE_INLINE void culled_set_tile(lmb_fill_tile *tile, const lmb_fill_window *w, ptrdiff_t across, ptrdiff_t down)
{
    tile->depth = (uint8_t *)w->first.depth + down * w->depth_row + across * w->depth_tile;
    if (tile->id_format != LMB_FORMAT_NONE) {
        tile->id = (uint8_t *)w->first.id + down * w->id_row + across * w->id_tile;
    }
}

LANE_INLINE float *culled_bound(const lmb_fill_window *w, ptrdiff_t across, ptrdiff_t down)
{
    return w->farthest + down * w->tiles_x + across;
}

/* e: the edges at the tile's pixel (0, box->first_row), or for tiled kinds, which draw the whole tile, at (0, 0). */
LANE_INLINE void culled_cross(const lmb_fill_tile *tile, const lmb_fill_job *job, const fill_triangle *t,
                              const int32_t e[3], const fill_box *box, float *bound, int kind)
{
    if (kind == FILL_PLAIN || kind == FILL_ID32) {
        fill_rows r;
        large_rows(&r, tile, t, e);
        rows_draw(&r, job->d, t->per_row, ROWS_ALL, kind);
        rows_raise(bound, r.lowest);
        return;
    }
    small_tile(tile, job, t, e[0], e[1], e[2], box);
    *bound = culled_look(tile);
}

/* --- rows of tiles ------------------------------------------------------------------------------------------------ */

/* A plane over tiles. In each tile it is nearest at (near_x, near_y) and farthest at (far_x, far_y). */
typedef struct culled_plane {
    double d_origin, d_x;
    float dx, dy, d_min, d_max, near_x, near_y, far_x, far_y;
} culled_plane;

/* Depths in the target's format. */
LANE_INLINE lane culled_codes(lane d, const lmb_fill_tile *tile, const lmb_fill_job *job)
{
    return tile->depth_format == LMB_DEPTH32F ? d : fill_depth_16(d, job);
}

/* The depth at (x, y) of tiles with the depths `first` at their first pixels, before clamping to the triangle's
 * range. */
LANE_INLINE lane culled_at(lane first, const culled_plane *plane, float x, float y)
{
    return lane_add(lane_add(first, lane_splat(plane->dy * y)), lane_splat(plane->dx * x));
}

/* A plane over LANES adjacent tiles. */
typedef struct culled_tiles {
    lane first, far; /* depths: at first pixels; the farthest, as for pixels */
    uint32_t seen;   /* tiles it may show in */
    uint32_t leaves; /* tiles in which it may leave the triangle's range */
} culled_tiles;

/* Compares with the bounds from `bound` on. */
LANE_INLINE void culled_ask(culled_tiles *out, lane first, const culled_plane *plane, const lmb_fill_tile *tile,
                            const lmb_fill_job *job, const float *bound)
{
    const lane low = lane_splat(plane->d_min), high = lane_splat(plane->d_max);
    const lane near = culled_at(first, plane, plane->near_x, plane->near_y),
               far = culled_at(first, plane, plane->far_x, plane->far_y);
    const lane seen = lane_pick(lane_lt(near, high), lane_max(near, low), high);
    out->first = first;
    out->far = culled_codes(lane_pick(lane_lt(low, far), lane_min(far, high), low), tile, job);
    out->seen = mask_bits(lane_lt(lane_load(bound), culled_codes(seen, tile, job)));
    out->leaves = ~mask_bits(mask_and(lane_le(low, far), lane_le(near, high)));
}

/* --- small triangles ---------------------------------------------------------------------------------------------- */

NOINLINE void culled_small_plain(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits)
{
    parts_fill_plain(w, b, bits, FILL_PLAIN, 1);
}

NOINLINE void culled_small_id32(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits)
{
    parts_fill_id32(w, b, bits, 1);
}

static void KERNEL(culled_small)(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits)
{
    const int kind = small_kind(w);
    if (kind == FILL_PLAIN) {
        culled_small_plain(w, b, bits);
        return;
    }
    if (kind == FILL_ID32) {
        culled_small_id32(w, b, bits);
        return;
    }
    KERNEL(fill_small)(w, b, bits);
}

/* --- large triangles ---------------------------------------------------------------------------------------------- */

#define ALL_TILES ((1u << LANES) - 1)

/* State for drawing a row of tiles. */
typedef struct culled_row {
    const lmb_fill_window *w;
    const lmb_setup *s;
    const fill_triangle *t;
    const large_edges *edges;
    const large_plane *whole;
    lmb_fill_tile *tile;
    lmb_fill_job *job;
    double d_row;
    int32_t ty;
} culled_row;

LANE_INLINE void culled_large_crossed(const culled_row *r, large3 at, float *bound, int kind)
{
    static const fill_box all = {0, LMB_TILE - 1, 0, FILL_ACROSS - 1};
    const int32_t e[3] = {large_near(at.a), large_near(at.b), large_near(at.c)};
    culled_cross(r->tile, r->job, r->t, e, &all, bound, kind);
}

/* Prefetches the tile below, which is likely to be drawn soon and is far away in memory. It may not exist. */
LANE_INLINE void culled_soon(const culled_row *r)
{
    const uintptr_t below = (uintptr_t)r->tile->depth + (uintptr_t)(intptr_t)r->w->depth_row;
    MESH_SOON((const void *)below);
    MESH_SOON((const void *)(below + 64));
    MESH_SOON((const void *)(below + 128));
    MESH_SOON((const void *)(below + 192));
}

/* Tiles `some` of those from tx on, all inside all edges: no pixel stays farther than the plane's farthest depth. */
LANE_INLINE void culled_large_run(const culled_row *r, const culled_tiles *tiles, const float *d, int32_t tx,
                                  uint32_t some, int kind)
{
    float *bound = culled_bound(r->w, tx, r->ty);
    const lane old = lane_load(bound);
    lane_store(bound, lane_pick(mask_of_bits(some), lane_max(old, tiles->far), old));
    if (some == ALL_TILES && (tiles->leaves & ALL_TILES) == 0) { /* no address waits for a mask, so the
                                                                    processor runs farther ahead */
        culled_set_tile(r->tile, r->w, tx, r->ty);
        large_run(r->w, r->tile, r->job, r->t, r->whole, d, LANES, 0, kind);
        return;
    }
    for (; some != 0; some &= some - 1) {
        const int i = lowest_bit(some);
        culled_set_tile(r->tile, r->w, tx + i, r->ty);
        culled_soon(r);
        r->job->d = d[i];
        if (tiles->leaves >> i & 1u) {
            fill_inside(r->tile, r->job, r->t, 1);
        } else if (kind != FILL_PLAIN && kind != FILL_ID32) {
            fill_inside(r->tile, r->job, r->t, 0);
        } else {
            large_whole(r->tile, r->whole, d[i], kind);
        }
    }
}

/* 1 if LANES tiles lie inside all edges. */
LANE_INLINE int culled_all_inside(const large_edges *edges, large3 at)
{
    const large3 low = large_add(at, edges->low);
    return !large_negative(low) && !large_negative(large_add(low, large_times(edges->step_x, LANES - 1)));
}

/* The first `count` tiles, at most LANES, from tx on, with edges `at`. */
LANE_INLINE void culled_large_tiles(const culled_row *r, const culled_tiles *tiles, large3 at, int32_t tx,
                                    int32_t count, int kind)
{
    float d[LANES];
    lane_store(d, tiles->first);
    for (int32_t i = 0, n; i < count; i += n, at = large_add(at, large_times(r->edges->step_x, n))) {
        n = count == LANES && i == 0 && culled_all_inside(r->edges, at)
                ? LANES
                : large_inside(r->edges, at, count - i, LANES / 2);
        if (n > 0) {
            culled_large_run(r, tiles, d, tx, tiles->seen & ((1u << n) - 1) << i, kind);
            continue;
        }
        n = 1;
        if (tiles->seen >> i & 1u && !large_negative(large_add(at, r->edges->high))) {
            culled_set_tile(r->tile, r->w, tx + i, r->ty);
            culled_soon(r);
            r->job->d = d[i];
            culled_large_crossed(r, at, culled_bound(r->w, tx + i, r->ty), kind);
        }
    }
}

/* `count` tiles of a row from tile (tx, ty) of the window on; edges->at is at the first. */
LANE_INLINE void culled_large_row(const culled_row *r, const culled_plane *plane, int32_t tx, int32_t count, int kind)
{
    large3 at = r->edges->at;
    for (int32_t n = 1; count > 0 && n > 0; count -= n, tx += n) {
        n = large_outside(r->edges, at, count);
        at = large_add(at, large_times(r->edges->step_x, n));
    }
    for (; count > 0; count -= LANES, tx += LANES) {
        culled_tiles tiles;
        culled_ask(&tiles, large_depths(plane->d_origin, plane->d_x,
                                        (r->w->x0 + tx * LMB_TILE) * 256 + r->w->origin_x, r->d_row),
                   plane, r->tile, r->job, culled_bound(r->w, tx, r->ty));
        if (tiles.seen != 0) {
            culled_large_tiles(r, &tiles, at, tx, count < LANES ? count : LANES, kind);
        }
        at = large_add(at, large_times(r->edges->step_x, LANES));
        if (large_negative(large_add(at, r->edges->high))) {
            return; /* a triangle's part of a row has no gap */
        }
    }
}

LANE_INLINE void culled_large_fill(const lmb_fill_window *w, const lmb_setup *s, uint32_t id, int kind)
{
    int32_t tx, ty, across = large_span(&tx, s->x_min, s->x_max, w->origin_x, w->x0, w->tiles_x),
                    down = large_span(&ty, s->y_min, s->y_max, w->origin_y, w->y0, w->tiles_y);
    fill_triangle t;
    lmb_fill_job job;
    large_edges edges;
    large_plane whole;
    lmb_fill_tile tile = fill_first(w, kind);
    culled_plane plane;
    culled_row r = {w, s, &t, &edges, &whole, &tile, &job, 0.0, 0};
    job.dx = (float)s->d_x;
    job.dy = (float)s->d_y;
    job.d_min = s->d_min;
    job.d_max = s->d_max;
    job.d_scale = w->d_scale;
    job.d_bias = w->d_bias;
    job.id = id;
    fill_set(&t, s->ex, s->ey, &job, kind);
    large_set(&edges, s, (w->x0 + tx * LMB_TILE) * 256 + w->origin_x, (w->y0 + ty * LMB_TILE) * 256 + w->origin_y);
    large_plane_set(&whole, &t);
    plane.d_origin = s->d_origin;
    plane.d_x = s->d_x;
    plane.dx = job.dx;
    plane.dy = job.dy;
    plane.d_min = s->d_min;
    plane.d_max = s->d_max;
    plane.near_x = job.dx > 0.0f ? (float)(LMB_TILE - 1) : 0.0f;
    plane.near_y = job.dy > 0.0f ? (float)(LMB_TILE - 1) : 0.0f;
    plane.far_x = (float)(LMB_TILE - 1) - plane.near_x;
    plane.far_y = (float)(LMB_TILE - 1) - plane.near_y;
    for (r.ty = ty; across > 0 && down > 0; --down, ++r.ty) {
        r.d_row = s->d_y * (((w->y0 + r.ty * LMB_TILE) * 256 + w->origin_y) * (1.0 / 256.0));
        culled_large_row(&r, &plane, tx, across, kind);
        edges.at = large_add(edges.at, edges.step_y);
    }
}

/* Separate functions, each with a separate stack frame. */
NOINLINE void culled_large_plain(const lmb_fill_window *w, const lmb_setup *s)
{
    culled_large_fill(w, s, 0, FILL_PLAIN);
}

NOINLINE void culled_large_id32(const lmb_fill_window *w, const lmb_setup *s, uint32_t id)
{
    culled_large_fill(w, s, id, FILL_ID32);
}

NOINLINE void culled_large_codes(const lmb_fill_window *w, const lmb_setup *s)
{
    culled_large_fill(w, s, 0, FILL_CODES);
}

NOINLINE void culled_large_any(const lmb_fill_window *w, const lmb_setup *s, uint32_t id)
{
    culled_large_fill(w, s, id, FILL_ANY);
}

static void KERNEL(culled_large)(const lmb_fill_window *w, const lmb_setup *s, uint32_t id)
{
    switch (fill_kind(w)) {
    case FILL_CODES: culled_large_codes(w, s); break;
    case FILL_PLAIN: culled_large_plain(w, s); break;
    case FILL_ID32: culled_large_id32(w, s, id); break;
    default: culled_large_any(w, s, id); break;
    }
}
#else
/* With fewer lanes, the test costs as much as it saves, and bounds do not change. */
static void KERNEL(culled_small)(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits)
{
    KERNEL(fill_small)(w, b, bits);
}

static void KERNEL(culled_large)(const lmb_fill_window *w, const lmb_setup *s, uint32_t id)
{
    KERNEL(fill_large)(w, s, id);
}
#endif
