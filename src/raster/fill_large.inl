/* fill_large.inl: a triangle of any size into a window: tiles are outside, crossed by edges or wholly inside. Layer 3.
 *
 * Edges are 64-bit sums from tile to tile. Over a tile that edges cross they fit 32 bits, and one that is far from the
 * tile is held at FAR_INSIDE, which no step within a tile (under 2^27) can turn negative. */

enum { FAR_INSIDE = 1 << 29 };

/* One value an edge. Written out: gcc -O2 keeps a loop of three, and arrays in memory. */
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
    large3 at, step_x, step_y; /* at a tile's first pixel; a tile on */
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

LANE_INLINE void large_crossed(const lmb_fill_tile *tile, const lmb_fill_job *job, const fill_triangle *t, large3 at)
{
    static const fill_box whole = {0, LMB_TILE - 1, 0, FILL_ACROSS - 1};
    const int32_t e[3] = {large_near(at.a), large_near(at.b), large_near(at.c)};
#if LANES > 1
    if (t->codes) {
        fill_codes_rows((uint16_t *)tile->depth, job, t, e, job->d, 0, LMB_TILE - 1);
        return;
    }
#endif
    for (int i = 0; i < FILL_ACROSS; ++i) {
        fill_column(tile, job, t, e, job->d, &whole, i);
    }
}

/* `count` tiles of a row; edges->at is at the first. */
LANE_INLINE void large_row(const lmb_fill_window *w, const lmb_setup *s, const fill_triangle *t,
                           const large_edges *edges, lmb_fill_tile *tile, lmb_fill_job *job, int32_t x_24_8,
                           int32_t count, double d_row)
{
    large3 at = edges->at;
    int entered = 0;
    for (; count > 0; --count, x_24_8 += LMB_TILE * 256) {
        const int outside = large_negative(large_add(at, edges->high));
        if (outside && entered) {
            return; /* a triangle's part of a row has no gap */
        }
        if (!outside) {
            entered = 1;
            job->d = (float)(s->d_origin + s->d_x * (x_24_8 * (1.0 / 256.0)) + d_row);
            if (large_negative(large_add(at, edges->low))) {
                large_crossed(tile, job, t, at);
            } else if (fill_in_range(job)) {
                fill_inside(tile, job, t, 0);
            } else {
                fill_inside(tile, job, t, 1);
            }
        }
        tile->depth = (uint8_t *)tile->depth + w->depth_tile;
        tile->id = tile->id_format != LMB_FORMAT_NONE ? (uint8_t *)tile->id + w->id_tile : NULL;
        at = large_add(at, edges->step_x);
    }
}

/* First tile and count, inside the window, of a box's side in 24.8 from the frame's middle. */
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
    job.dx = (float)s->d_x;
    job.dy = (float)s->d_y;
    job.d_min = s->d_min;
    job.d_max = s->d_max;
    job.d_scale = w->d_scale;
    job.d_bias = w->d_bias;
    job.id = id;
    fill_set(&t, s->ex, s->ey, &job);
    t.codes = kind == FILL_CODES;
    large_set(&edges, s, x_24_8, y_24_8);
    for (; across > 0 && down > 0; --down, ++ty, y_24_8 += LMB_TILE * 256) {
        lmb_fill_tile tile = fill_first(w, kind);
        tile.depth = (uint8_t *)w->first.depth + (ptrdiff_t)ty * w->depth_row + (ptrdiff_t)tx * w->depth_tile;
        if (tile.id_format != LMB_FORMAT_NONE) {
            tile.id = (uint8_t *)w->first.id + (ptrdiff_t)ty * w->id_row + (ptrdiff_t)tx * w->id_tile;
        }
        large_row(w, s, &t, &edges, &tile, &job, x_24_8, across, s->d_y * (y_24_8 * (1.0 / 256.0)));
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
