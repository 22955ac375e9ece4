/* fill_large.inl: a triangle of any size into a window: tiles are outside, crossed by edges or wholly inside. Layer 3.
 *
 * Edges are 64-bit sums from tile to tile. Over a tile that edges cross they fit 32 bits. An edge far from the tile is
 * clamped to FAR_INSIDE, which no step within a tile (under 2^27) can turn negative. */

enum { FAR_INSIDE = 1 << 29 };

/* Tiles of a row: the first step of the search for the end of a run. With one lane, code size matters, so tiles go one
 * by one. */
enum { LARGE_LEAP = LANES > 1 ? 64 : 0 };

/* One value per edge. Not a loop: gcc -O2 keeps a loop of three, and arrays in memory. */
typedef struct large3 {
    int64_t a, b, c;
} large3;

LANE_INLINE large3 large_make(int64_t a, int64_t b, int64_t c)
{
    large3 r;
    r.a = a;
    r.b = b;
    r.c = c;
    return r;
}

LANE_INLINE large3 large_add(large3 p, large3 q) { return large_make(p.a + q.a, p.b + q.b, p.c + q.c); }

LANE_INLINE int large_negative(large3 p) { return (p.a | p.b | p.c) < 0; }

typedef struct large_edges {
    large3 at, step_x, step_y; /* at a tile's first pixel; per tile */
    large3 low, high;          /* least and greatest change within a tile */
} large_edges;

LANE_INLINE int64_t large_start(const lmb_setup *s, int i, int32_t x_24_8, int32_t y_24_8)
{
    return (s->e_origin[i] + (int64_t)s->ex[i] * x_24_8 + (int64_t)s->ey[i] * y_24_8) >> 8;
}

LANE_INLINE int64_t large_low(const lmb_setup *s, int i)
{
    return (LMB_TILE - 1) * ((int64_t)(s->ex[i] < 0 ? s->ex[i] : 0) + (s->ey[i] < 0 ? s->ey[i] : 0));
}

LANE_INLINE int64_t large_high(const lmb_setup *s, int i)
{
    return (LMB_TILE - 1) * ((int64_t)(s->ex[i] > 0 ? s->ex[i] : 0) + (s->ey[i] > 0 ? s->ey[i] : 0));
}

LANE_INLINE void large_set(large_edges *edges, const lmb_setup *s, int32_t x_24_8, int32_t y_24_8)
{
    const int64_t tile = LMB_TILE;
    edges->at = large_make(large_start(s, 0, x_24_8, y_24_8), large_start(s, 1, x_24_8, y_24_8),
                           large_start(s, 2, x_24_8, y_24_8));
    edges->step_x = large_make(tile * s->ex[0], tile * s->ex[1], tile * s->ex[2]);
    edges->step_y = large_make(tile * s->ey[0], tile * s->ey[1], tile * s->ey[2]);
    edges->low = large_make(large_low(s, 0), large_low(s, 1), large_low(s, 2));
    edges->high = large_make(large_high(s, 0), large_high(s, 1), large_high(s, 2));
}

LANE_INLINE int32_t large_near(int64_t e) { return e < FAR_INSIDE ? (int32_t)e : FAR_INSIDE; }

#if LANES >= LMB_TILE
/* e: the edges at the tile's first pixel. */
LANE_INLINE void large_rows(fill_rows *r, const lmb_fill_tile *tile, const fill_triangle *t, const int32_t e[3])
{
    r->e0 = lanei_add(lanei_splat(e[0]), t->step[0][0]);
    r->e1 = lanei_add(lanei_splat(e[1]), t->step[1][0]);
    r->e2 = lanei_add(lanei_splat(e[2]), t->step[2][0]);
    r->down0 = lanei_splat(t->ey[0] * FILL_ROWS);
    r->down1 = lanei_splat(t->ey[1] * FILL_ROWS);
    r->down2 = lanei_splat(t->ey[2] * FILL_ROWS);
    r->step_d = t->step_d[0];
    r->d_min = t->d_min;
    r->d_max = t->d_max;
    r->depth = (float *)tile->depth;
    r->ids = (uint32_t *)tile->id;
    r->id = t->id;
}
#endif

LANE_INLINE void large_crossed(const lmb_fill_tile *tile, const lmb_fill_job *job, const fill_triangle *t, large3 at,
                               int kind)
{
    static const fill_box whole = {0, LMB_TILE - 1, 0, FILL_ACROSS - 1};
    const int32_t e[3] = {large_near(at.a), large_near(at.b), large_near(at.c)};
#if LANES > 1
    if (t->codes) {
        fill_codes_rows((uint16_t *)tile->depth, job, t, e, job->d, 0, LMB_TILE - 1);
        return;
    }
#endif
#if LANES >= LMB_TILE
    if (kind == FILL_PLAIN || kind == FILL_ID32) {
        fill_rows r;
        large_rows(&r, tile, t, e);
        rows_draw(&r, job->d, t->per_row, ROWS_ALL, kind);
        return;
    }
#endif
    (void)kind;
    for (int i = 0; i < FILL_ACROSS; ++i) {
        fill_column(tile, job, t, e, job->d, &whole, i);
    }
}

LANE_INLINE large3 large_times(large3 p, int64_t n) { return large_make(p.a * n, p.b * n, p.c * n); }

/* Number of the `count` tiles from `at` on that lie inside all edges: less than twice `leap`, a power of two. Edges are
 * linear, so all tiles between two inside ones are inside. Halves the step, without a branch, because the number is as
 * good as random. */
LANE_INLINE int32_t large_inside(const large_edges *edges, large3 at, int32_t count, int32_t leap)
{
    large3 low = large_add(at, edges->low);
    int32_t n = 0;
    if (large_negative(low)) {
        return 0;
    }
    for (; leap > 0; leap >>= 1) {
        const large3 next = large_add(low, large_times(edges->step_x, leap));
        const int too_far = large_negative(next) | (n + leap >= count);
        low = too_far ? low : next;
        n += too_far ? 0 : leap;
    }
    return n + 1;
}

/* Number of tiles, less than twice LARGE_LEAP, outside an edge that the first one is outside of; 0 if it is outside
 * none. */
LANE_INLINE int32_t large_outside(const large_edges *edges, large3 at, int32_t count)
{
    const large3 first = large_add(at, edges->high);
    large3 high = first;
    int32_t n = 0;
    if (!large_negative(first)) {
        return 0;
    }
    for (int32_t leap = LARGE_LEAP; leap > 0; leap >>= 1) {
        const large3 next = large_add(high, large_times(edges->step_x, leap));
        const int too_far =
            (((next.a & first.a) | (next.b & first.b) | (next.c & first.c)) >= 0) | (n + leap >= count);
        high = too_far ? high : next;
        n += too_far ? 0 : leap;
    }
    return n + 1;
}

/* The depth of a plane at the first pixel of a tile. */
LANE_INLINE float large_depth(const lmb_setup *s, int32_t x_24_8, double d_row)
{
    return (float)(s->d_origin + s->d_x * (x_24_8 * (1.0 / 256.0)) + d_row);
}

/* The same for LANES adjacent tiles, the first at x_24_8. */
LANE_INLINE lane large_depths(double d_origin, double d_x, int32_t x_24_8, double d_row)
{
    static const int32_t steps[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const lanei x = lanei_add(lanei_splat(x_24_8), lanei_mul(lanei_load(steps), lanei_splat(LMB_TILE * 256)));
    const laned at = laned_mul(laned_splat(d_x), laned_mul(laned_from_int(x), laned_splat(1.0 / 256.0)));
    return lane_from_double(laned_add(laned_add(laned_splat(d_origin), at), laned_splat(d_row)));
}

/* 1 if the plane is within the range in all of `count` tiles of a row from x_24_8 on. Depths are monotone from tile to
 * tile, so this tests only the first and the last. */
LANE_INLINE int large_in_range(const lmb_setup *s, lmb_fill_job *job, int32_t x_24_8, int32_t count, double d_row)
{
    job->d = large_depth(s, x_24_8, d_row);
    if (!fill_in_range(job)) {
        return 0;
    }
    job->d = large_depth(s, x_24_8 + (count - 1) * (LMB_TILE * 256), d_row);
    return fill_in_range(job);
}

LANE_INLINE void large_next(const lmb_fill_window *w, lmb_fill_tile *tile, int32_t n)
{
    tile->depth = (uint8_t *)tile->depth + (ptrdiff_t)n * w->depth_tile;
    tile->id = tile->id_format != LMB_FORMAT_NONE ? (uint8_t *)tile->id + (ptrdiff_t)n * w->id_tile : NULL;
}

/* Change of a plane from a tile's first pixel to each vector of the tile: dy y of the vector's rows, and dx x. Not
 * arrays: gcc -O2 keeps a loop over them, and arrays in memory. */
typedef struct large_plane {
    uint32_t id;
#if LANES >= LMB_TILE
    lane y0, y1, y2, y3, x;
#endif
#if LANES == LMB_TILE
    lane y4, y5, y6, y7;
#endif
} large_plane;

/* All lanes of a row are equal. If gcc saw that, it would add d to one and broadcast each sum, eight times a tile. */
#if LANES == LMB_TILE && defined(__GNUC__)
#define LARGE_VECTOR(v) __asm__("" : "+x"(v))
#else
#define LARGE_VECTOR(v) ((void)0)
#endif

#if LANES >= LMB_TILE
LANE_INLINE void large_plane_set(large_plane *p, const fill_triangle *t)
{
    const lane dy = lane_splat(t->per_row);
    p->x = t->step_d[0];
    p->id = t->id;
    p->y0 = lane_mul(dy, lane_row(0)), p->y1 = lane_mul(dy, lane_row(LANES));
    p->y2 = lane_mul(dy, lane_row(2 * LANES)), p->y3 = lane_mul(dy, lane_row(3 * LANES));
#if LANES == LMB_TILE
    p->y4 = lane_mul(dy, lane_row(4 * LANES)), p->y5 = lane_mul(dy, lane_row(5 * LANES));
    p->y6 = lane_mul(dy, lane_row(6 * LANES)), p->y7 = lane_mul(dy, lane_row(7 * LANES));
    LARGE_VECTOR(p->y0);
    LARGE_VECTOR(p->y1);
    LARGE_VECTOR(p->y2);
    LARGE_VECTOR(p->y3);
    LARGE_VECTOR(p->y4);
    LARGE_VECTOR(p->y5);
    LARGE_VECTOR(p->y6);
    LARGE_VECTOR(p->y7);
#endif
}

/* A vector of pixels inside all edges, from pixel `at` of a tile on. */
LANE_INLINE void large_put(const lmb_fill_tile *tile, const large_plane *p, int at, lane row, int kind)
{
    float *was = (float *)tile->depth + at;
    const lane depth = lane_add(row, p->x), old = lane_load(was);
    if (kind == FILL_PLAIN) {
        lane_store(was, lane_max(depth, old));
        return;
    }
    const lane_mask pass = lane_lt(old, depth);
    lane_store(was, lane_pick(pass, depth, old));
    lane_put_u32((uint32_t *)tile->id + at, LMB_TILE, p->id, pass);
}

/* A tile inside all edges, with all depths in the triangle's range. Same sums as fill_inside. */
LANE_INLINE void large_whole(const lmb_fill_tile *tile, const large_plane *p, float first, int kind)
{
    const lane d = lane_splat(first);
    large_put(tile, p, 0, lane_add(d, p->y0), kind);
    large_put(tile, p, LANES, lane_add(d, p->y1), kind);
    large_put(tile, p, 2 * LANES, lane_add(d, p->y2), kind);
    large_put(tile, p, 3 * LANES, lane_add(d, p->y3), kind);
#if LANES == LMB_TILE
    large_put(tile, p, 4 * LANES, lane_add(d, p->y4), kind);
    large_put(tile, p, 5 * LANES, lane_add(d, p->y5), kind);
    large_put(tile, p, 6 * LANES, lane_add(d, p->y6), kind);
    large_put(tile, p, 7 * LANES, lane_add(d, p->y7), kind);
#endif
}

/* LANES / 4 rows of codes, from pixel `at` of a tile on. Left and right halves of rows, because narrowing then leaves
 * them in order. row: d + dy y. */
LANE_INLINE void large_put_codes(const lmb_fill_tile *tile, const lmb_fill_job *job, int at, lane row, lane left,
                                 lane right)
{
    const lane scale = lane_splat(job->d_scale), bias = lane_splat(job->d_bias);
    lane_raise_u16_halves((uint16_t *)tile->depth + at, lane_add(lane_mul(lane_add(row, left), scale), bias),
                          lane_add(lane_mul(lane_add(row, right), scale), bias));
}

/* `count` tiles of codes inside all edges, with all depths in the triangle's range. */
LANE_INLINE void large_codes(const lmb_fill_window *w, lmb_fill_tile *tile, const lmb_fill_job *job, const float *d,
                             int32_t count)
{
    static const float column[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3},
                       row[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    const lane dx = lane_splat(job->dx), dy = lane_splat(job->dy), x = lane_load(column), y = lane_load(row);
    const lane left = lane_mul(dx, x), right = lane_mul(dx, lane_add(x, lane_splat(4.0f)));
    const lane y0 = lane_mul(dy, y), y1 = lane_mul(dy, lane_add(y, lane_splat((float)(LANES / 4))));
#if LANES == LMB_TILE
    const lane y2 = lane_mul(dy, lane_add(y, lane_splat(4.0f))), y3 = lane_mul(dy, lane_add(y, lane_splat(6.0f)));
#endif
    for (int32_t i = 0; i < count; ++i) {
        const lane first = lane_splat(d[i]);
        large_put_codes(tile, job, 0, lane_add(first, y0), left, right);
        large_put_codes(tile, job, 2 * LANES, lane_add(first, y1), left, right);
#if LANES == LMB_TILE
        large_put_codes(tile, job, 4 * LANES, lane_add(first, y2), left, right);
        large_put_codes(tile, job, 6 * LANES, lane_add(first, y3), left, right);
#endif
        large_next(w, tile, 1);
    }
}
#endif

/* `count` tiles inside all edges; advances `tile`. d: the depths at their first pixels. */
LANE_INLINE void large_run(const lmb_fill_window *w, lmb_fill_tile *tile, lmb_fill_job *job, const fill_triangle *t,
                           const large_plane *plane, const float *d, int32_t count, int clamped, int kind)
{
#if LANES >= LMB_TILE
    if ((kind == FILL_PLAIN || kind == FILL_ID32) && !clamped) {
        for (int32_t i = 0; i < count; ++i) {
            large_whole(tile, plane, d[i], kind);
            large_next(w, tile, 1);
        }
        return;
    }
    if (kind == FILL_CODES && !clamped) {
        large_codes(w, tile, job, d, count);
        return;
    }
#endif
    (void)plane, (void)kind;
    for (int32_t i = 0; i < count; ++i) {
        job->d = d[i];
        if (LANES == 1 || clamped) { /* the same bytes if depths are in range anyway */
            fill_inside(tile, job, t, 1);
        } else {
            fill_inside(tile, job, t, 0);
        }
        large_next(w, tile, 1);
    }
}

#if LANES > 1
/* The code of a depth, clamped to the triangle's range. */
LANE_INLINE int32_t large_code(const lmb_fill_job *job, float d)
{
    d = minf(maxf(d, job->d_min), job->d_max);
    return (int32_t)maxf(d * job->d_scale + job->d_bias, 0.0f);
}

/* The code at all corners of a tile, and so (all is monotone) at all pixels; -1 if they differ. */
LANE_INLINE int32_t large_tile_code(const lmb_fill_job *job, float d)
{
    const float right = job->dx * (float)(LMB_TILE - 1), below = d + job->dy * (float)(LMB_TILE - 1);
    const int32_t code = large_code(job, d);
    return code == large_code(job, d + right) && code == large_code(job, below) &&
                   code == large_code(job, below + right)
               ? code
               : -1;
}

/* `count` tiles inside all edges, from x_24_8 on, if the first and last, and so all, have one code, as on surfaces that
 * face the viewer. Otherwise draws nothing and returns 0. */
LANE_INLINE int large_run_code(const lmb_fill_window *w, const lmb_setup *s, lmb_fill_tile *tile,
                               const lmb_fill_job *job, int32_t x_24_8, int32_t count, double d_row)
{
    const int32_t code = large_tile_code(job, large_depth(s, x_24_8, d_row));
    const lane all = lane_splat((float)code);
    if (code < 0 || code != large_tile_code(job, large_depth(s, x_24_8 + (count - 1) * (LMB_TILE * 256), d_row))) {
        return 0;
    }
    for (int32_t i = 0; i < count; ++i) {
        for (int k = 0; k < LMB_TILE_PIXELS; k += 2 * LANES) {
            lane_raise_u16((uint16_t *)tile->depth + k, all, all);
        }
        large_next(w, tile, 1);
    }
    return 1;
}
#endif

/* `count` tiles inside all edges, from x_24_8 on; advances `tile`. */
LANE_INLINE void large_inside_tiles(const lmb_fill_window *w, const lmb_setup *s, const fill_triangle *t,
                                    const large_plane *plane, lmb_fill_tile *tile, lmb_fill_job *job, int32_t x_24_8,
                                    int32_t count, double d_row, int kind)
{
#if LANES > 1
    if (kind == FILL_CODES && large_run_code(w, s, tile, job, x_24_8, count, d_row)) {
        return;
    }
#endif
    const int clamped = LANES == 1 || !large_in_range(s, job, x_24_8, count, d_row);
    for (int32_t i = 0; i < count; i += LANES) {
        float d[LANES];
        lane_store(d, large_depths(s->d_origin, s->d_x, x_24_8 + i * (LMB_TILE * 256), d_row));
        large_run(w, tile, job, t, plane, d, count - i < LANES ? count - i : LANES, clamped, kind);
    }
}

/* `count` tiles of a row; edges->at is at the first. */
LANE_INLINE void large_row(const lmb_fill_window *w, const lmb_setup *s, const fill_triangle *t,
                           const large_plane *plane, const large_edges *edges, lmb_fill_tile *tile,
                           lmb_fill_job *job, int32_t x_24_8, int32_t count, double d_row, int kind)
{
    large3 at = edges->at;
    for (int entered = 0; count > 0;) {
        int32_t n = entered ? 0 : large_outside(edges, at, count);
        if (n == 0) {
            if (entered && large_negative(large_add(at, edges->high))) {
                return; /* a triangle's part of a row has no gap */
            }
            entered = 1;
            n = large_inside(edges, at, count, LARGE_LEAP);
            if (n > 0) {
                large_inside_tiles(w, s, t, plane, tile, job, x_24_8, n, d_row, kind);
            } else {
                n = 1;
                job->d = large_depth(s, x_24_8, d_row);
                large_crossed(tile, job, t, at, kind);
                large_next(w, tile, 1);
            }
        } else {
            large_next(w, tile, n);
        }
        count -= n;
        x_24_8 += n * (LMB_TILE * 256);
        at = large_add(at, large_times(edges->step_x, n));
    }
}

/* First tile and count, inside the window, of one side of a box in 24.8 from the frame's centre. */
LANE_INLINE int32_t large_span(int32_t *first, int32_t low, int32_t high, int32_t origin, int32_t window, int32_t tiles)
{
    const int32_t low_px = ((low - origin + 255) >> 8) - window, high_px = ((high - origin) >> 8) - window;
    int32_t last = high_px >> 3;
    *first = low_px < 0 ? 0 : low_px >> 3;
    last = last < tiles ? last : tiles - 1;
    return high_px < low_px ? 0 : last - *first + 1;
}

LANE_INLINE void large_fill(const lmb_fill_window *w, const lmb_setup *s, uint32_t id, int kind)
{
    int32_t tx, ty, across = large_span(&tx, s->x_min, s->x_max, w->origin_x, w->x0, w->tiles_x),
                    down = large_span(&ty, s->y_min, s->y_max, w->origin_y, w->y0, w->tiles_y);
    const int32_t x_24_8 = (w->x0 + tx * LMB_TILE) * 256 + w->origin_x;
    int32_t y_24_8 = (w->y0 + ty * LMB_TILE) * 256 + w->origin_y;
    fill_triangle t;
    lmb_fill_job job;
    large_edges edges;
    large_plane plane;
    job.dx = (float)s->d_x;
    job.dy = (float)s->d_y;
    job.d_min = s->d_min;
    job.d_max = s->d_max;
    job.d_scale = w->d_scale;
    job.d_bias = w->d_bias;
    job.id = id;
    fill_set(&t, s->ex, s->ey, &job, kind);
#if LANES >= LMB_TILE
    large_plane_set(&plane, &t);
#endif
    large_set(&edges, s, x_24_8, y_24_8);
    for (; across > 0 && down > 0; --down, ++ty, y_24_8 += LMB_TILE * 256) {
        lmb_fill_tile tile = fill_first(w, kind);
        tile.depth = (uint8_t *)w->first.depth + (ptrdiff_t)ty * w->depth_row + (ptrdiff_t)tx * w->depth_tile;
        if (tile.id_format != LMB_FORMAT_NONE) {
            tile.id = (uint8_t *)w->first.id + (ptrdiff_t)ty * w->id_row + (ptrdiff_t)tx * w->id_tile;
        }
        large_row(w, s, &t, &plane, &edges, &tile, &job, x_24_8, across, s->d_y * (y_24_8 * (1.0 / 256.0)),
                  kind);
        edges.at = large_add(edges.at, edges.step_y);
    }
}

static void KERNEL(fill_large)(const lmb_fill_window *w, const lmb_setup *s, uint32_t id)
{
    switch (fill_kind(w)) {
    case FILL_CODES: large_fill(w, s, id, FILL_CODES); break;
    case FILL_PLAIN: large_fill(w, s, id, FILL_PLAIN); break;
    case FILL_ID32: large_fill(w, s, id, FILL_ID32); break;
    default: large_fill(w, s, id, FILL_ANY); break;
    }
}
