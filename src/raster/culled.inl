/* culled.inl: the fill kernels where each tile of a window has a bound of its farthest depth. Layer 3.
 *
 * What a triangle hides behind a whole tile is left out. The bound is at most every depth of the tile; against it
 * stands the nearest depth that the triangle's plane takes over its part of the tile: at one corner, by the operations
 * that each pixel goes through. These round monotonically, so no pixel lies nearer, and the comparison needs no margin.
 * Equal depths are left out, too, as the earlier draw stays. Else pixels are fill_small.inl's and fill_large.inl's,
 * value by value. */

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
/* A depth as the target holds it. */
LANE_INLINE float culled_code(float d, const lmb_fill_tile *tile, const lmb_fill_job *job)
{
    if (tile->depth_format == LMB_DEPTH32F) {
        return d;
    }
    return (float)(int32_t)maxf(minf(d * job->d_scale + job->d_bias, 65535.0f), 0.0f);
}

/* The nearest depth of a plane whose nearest place in a tile is (x, y), px, as parts_nearest. */
LANE_INLINE float culled_near(const lmb_fill_tile *tile, const lmb_fill_job *job, float x, float y)
{
    const float d = (job->d + job->dy * y) + job->dx * x;
    return culled_code(d < job->d_max ? maxf(d, job->d_min) : job->d_max, tile, job);
}

LANE_INLINE float culled_far(const lmb_fill_tile *tile, const lmb_fill_job *job)
{
    const float x = job->dx > 0.0f ? 0.0f : (float)(LMB_TILE - 1), y = job->dy > 0.0f ? 0.0f : (float)(LMB_TILE - 1);
    const float d = (job->d + job->dy * y) + job->dx * x;
    return culled_code(d > job->d_min ? minf(d, job->d_max) : job->d_min, tile, job);
}

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

/* e: the edges at the tile's pixel (0, box->first_row) - but for tiled ones, which all is drawn of, (0, 0). */
LANE_INLINE void culled_cross(const lmb_fill_tile *tile, const lmb_fill_job *job, const fill_triangle *t,
                              const int32_t e[3], const fill_box *box, float *bound, int kind)
{
    if (kind == FILL_PLAIN || kind == FILL_ID32) {
        fill_rows r;
        r.e0 = lanei_add(lanei_splat(e[0]), t->step[0][0]);
        r.e1 = lanei_add(lanei_splat(e[1]), t->step[1][0]);
        r.e2 = lanei_add(lanei_splat(e[2]), t->step[2][0]);
        r.down0 = lanei_splat(t->ey[0] * FILL_ROWS);
        r.down1 = lanei_splat(t->ey[1] * FILL_ROWS);
        r.down2 = lanei_splat(t->ey[2] * FILL_ROWS);
        r.step_d = t->step_d[0];
        r.d_min = t->d_min;
        r.d_max = t->d_max;
        r.depth = (float *)tile->depth;
        r.ids = (uint32_t *)tile->id;
        r.id = t->id;
        rows_draw(&r, job->d, t->per_row, ROWS_ALL, kind);
        rows_raise(bound, r.lowest);
        return;
    }
    small_tile(tile, job, t, e[0], e[1], e[2], box);
    *bound = culled_look(tile);
}

LANE_INLINE void culled_inside(const lmb_fill_tile *tile, const lmb_fill_job *job, const fill_triangle *t, float *bound,
                               int clamped)
{
    fill_inside(tile, job, t, clamped);
    *bound = maxf(*bound, culled_far(tile, job));
}

/* --- rows of tiles ------------------------------------------------------------------------------------------------ */

/* A plane over tiles beside each other. */
typedef struct culled_plane {
    double d_origin, d_x;
    float dx, dy, d_min, d_max;
} culled_plane;

/* LANES tiles from `bound` on, whose first pixels lie at x_24_8, and 8 px on each: which may the plane show in? A bit
 * each; d: the depth at their first pixels. (near_x, near_y): where it is nearest in a tile. */
LANE_INLINE uint32_t culled_row_seen(float *d, const culled_plane *plane, const lmb_fill_tile *tile,
                                     const lmb_fill_job *job, double d_row, int32_t x_24_8, float near_x,
                                     float near_y, const float *bound)
{
    static const int32_t steps[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const lanei x = lanei_add(lanei_splat(x_24_8), lanei_mul(lanei_load(steps), lanei_splat(LMB_TILE * 256)));
    const laned at = laned_mul(laned_splat(plane->d_x), laned_mul(laned_from_int(x), laned_splat(1.0 / 256.0)));
    const lane first = lane_from_double(laned_add(laned_add(laned_splat(plane->d_origin), at), laned_splat(d_row)));
    lane near = parts_nearest(first, lane_splat(plane->dx), lane_splat(plane->dy),
                               lane_splat(near_x), lane_splat(near_y),
                               lane_splat(plane->d_min), lane_splat(plane->d_max));
    if (tile->depth_format != LMB_DEPTH32F) {
        near = fill_depth_16(near, job);
    }
    lane_store(d, first);
    return mask_bits(lane_lt(lane_load(bound), near));
}

/* --- small triangles ---------------------------------------------------------------------------------------------- */

NOINLINE void culled_small_plain(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits)
{
    parts_fill_plain(w, b, bits, FILL_PLAIN, 1);
}

NOINLINE void culled_small_id32(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits, uint32_t first_id)
{
    parts_fill_id32(w, b, bits, first_id, 1);
}

static void KERNEL(culled_small)(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits, uint32_t first_id)
{
    const int kind = small_kind(w);
    if (kind == FILL_PLAIN) {
        culled_small_plain(w, b, bits);
        return;
    }
    if (kind == FILL_ID32) {
        culled_small_id32(w, b, bits, first_id);
        return;
    }
    KERNEL(fill_small)(w, b, bits, first_id);
}

/* --- large triangles ---------------------------------------------------------------------------------------------- */

/* One tile that the triangle may show in. */
LANE_INLINE void culled_large_tile(const lmb_fill_tile *tile, const lmb_fill_job *job, const fill_triangle *t,
                                  const large_edges *edges, large3 at, float *bound, int kind)
{
    static const fill_box whole = {0, LMB_TILE - 1, 0, FILL_ACROSS - 1};
    if (large_negative(large_add(at, edges->low))) {
        const int32_t e[3] = {large_near(at.a), large_near(at.b), large_near(at.c)};
        culled_cross(tile, job, t, e, &whole, bound, kind);
    } else if (fill_in_range(job)) {
        culled_inside(tile, job, t, bound, 0);
    } else {
        culled_inside(tile, job, t, bound, 1);
    }
}

LANE_INLINE large3 large_times(large3 p, int64_t n) { return large_make(p.a * n, p.b * n, p.c * n); }

enum { CULLED_ROW = 8 }; /* the depths of a row of more tiles than this are asked for side by side */

/* LANES tiles of a row, or `count`, from tile (tx, ty) of the window on, and `at` on to the tile after them; 0 where the
 * triangle's part of the row ended. */
LANE_INLINE int culled_large_tiles(const lmb_fill_window *w, const culled_plane *plane, const fill_triangle *t,
                                   const large_edges *edges, large3 *at, lmb_fill_tile *tile, lmb_fill_job *job,
                                   int32_t tx, int32_t ty, int32_t count, double d_row, int *entered, int kind)
{
    const int32_t x_24_8 = (w->x0 + tx * LMB_TILE) * 256 + w->origin_x;
    const float near_x = job->dx > 0.0f ? (float)(LMB_TILE - 1) : 0.0f,
                near_y = job->dy > 0.0f ? (float)(LMB_TILE - 1) : 0.0f;
    float d[LANES];
    uint32_t seen = 0xffffu;
    const int in_row = count > CULLED_ROW;
    if (in_row) {
        seen = culled_row_seen(d, plane, tile, job, d_row, x_24_8, near_x, near_y, culled_bound(w, tx, ty));
        if (seen == 0) {
            *at = large_add(*at, large_times(edges->step_x, LANES));
            return 1;
        }
    }
    count = count < LANES ? count : LANES;
    for (int32_t i = 0; i < count; ++i, *at = large_add(*at, edges->step_x)) {
        float *bound = culled_bound(w, tx + i, ty);
        if (large_negative(large_add(*at, edges->high))) {
            if (*entered) {
                return 0;
            }
            continue;
        }
        *entered = 1;
        if (!(seen >> i & 1u)) {
            continue;
        }
        job->d = in_row ? d[i]
                        : (float)(plane->d_origin + plane->d_x * ((x_24_8 + i * (LMB_TILE * 256)) * (1.0 / 256.0)) +
                                  d_row);
        if (in_row || *bound < culled_near(tile, job, near_x, near_y)) {
            culled_set_tile(tile, w, tx + i, ty);
            culled_large_tile(tile, job, t, edges, *at, bound, kind);
        }
    }
    return 1;
}

/* `count` tiles of a row from tile (tx, ty) of the window on; edges->at is at the first. */
LANE_INLINE void culled_large_row(const lmb_fill_window *w, const lmb_setup *s, const fill_triangle *t,
                                  const large_edges *edges, lmb_fill_tile *tile, lmb_fill_job *job, int32_t tx,
                                  int32_t ty, int32_t count, int kind)
{
    const double d_row = s->d_y * (((w->y0 + ty * LMB_TILE) * 256 + w->origin_y) * (1.0 / 256.0));
    const culled_plane plane = {s->d_origin, s->d_x, job->dx, job->dy, job->d_min, job->d_max};
    large3 at = edges->at;
    int entered = 0;
    for (; count > 0; count -= LANES, tx += LANES) {
        if (!culled_large_tiles(w, &plane, t, edges, &at, tile, job, tx, ty, count, d_row, &entered, kind)) {
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
    lmb_fill_tile tile = fill_first(w, kind);
    job.dx = (float)s->d_x;
    job.dy = (float)s->d_y;
    job.d_min = s->d_min;
    job.d_max = s->d_max;
    job.d_scale = w->d_scale;
    job.d_bias = w->d_bias;
    job.id = id;
    fill_set(&t, s->ex, s->ey, &job);
    t.codes = kind == FILL_CODES;
    large_set(&edges, s, (w->x0 + tx * LMB_TILE) * 256 + w->origin_x, (w->y0 + ty * LMB_TILE) * 256 + w->origin_y);
    for (; across > 0 && down > 0; --down, ++ty) {
        culled_large_row(w, s, &t, &edges, &tile, &job, tx, ty, across, kind);
        edges.at = large_add(edges.at, edges.step_y);
    }
}

static void KERNEL(culled_large)(const lmb_fill_window *w, const lmb_setup *s, uint32_t id)
{
    switch (fill_kind(w)) {
    case FILL_CODES: culled_large_fill(w, s, id, FILL_CODES); break;
    case FILL_PLAIN: culled_large_fill(w, s, id, FILL_PLAIN); break;
    case FILL_ID32: culled_large_fill(w, s, id, FILL_ID32); break;
    default: culled_large_fill(w, s, id, FILL_ANY); break;
    }
}
#else
/* Where lanes are fewer, asking costs as much as it saves, and bounds stay as they are. */
static void KERNEL(culled_small)(const lmb_fill_window *w, const lmb_batch *b, uint32_t bits, uint32_t first_id)
{
    KERNEL(fill_small)(w, b, bits, first_id);
}

static void KERNEL(culled_large)(const lmb_fill_window *w, const lmb_setup *s, uint32_t id)
{
    KERNEL(fill_large)(w, s, id);
}
#endif
