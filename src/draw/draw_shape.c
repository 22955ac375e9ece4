/* draw_shape.c: sets up triangles, lines and points, and finds the pixels that they cover. Layer 4.
 *
 * Corners snap to 24.8 from the viewport's centre as in src/raster, and setup.c there makes the edges. So a triangle
 * covers the same pixels, with the same depth, as in lmb_draw. */
#include "draw_part.h"

#include "../raster/setup.h"

#if LMB_DRAW
/* Snaps the corner to the picture. Returns 1 / w. */
static float shape_snap(lmb_screen_vertex *out, const lmb_draw_corner *c, const lmb_draw_pass *pass)
{
    const float *range = pass->state->depth_range, inverse = 1.0f / c->v[CORNER_W];
    const float d = minf(maxf(c->v[CORNER_Z] * inverse, 0.0f), 1.0f);
    out->x_24_8 = draw_to_24_8(c->v[CORNER_X] * inverse * pass->snap_x + 0.5f);
    out->y_24_8 = draw_to_24_8(0.5f - c->v[CORNER_Y] * inverse * pass->snap_y);
    out->d = range[0] == 0.0f && range[1] == 1.0f ? d : range[0] + (range[1] - range[0]) * d;
    return inverse;
}

static lmb_draw_plane shape_plane(double origin, double x, double y)
{
    lmb_draw_plane p;
    p.origin = origin;
    p.x = x;
    p.y = y;
    return p;
}

static lmb_draw_plane shape_scaled(const lmb_draw_plane *p, double by)
{
    return shape_plane(p->origin * by, p->x * by, p->y * by);
}

/* Sets n1, n2 and q. On entry n1 and n2 are the corners' shares in the picture. inverse: 1 / w of the corners. */
static void shape_set_shares(lmb_draw_shape *s, const float inverse[3])
{
    const double more1 = (double)inverse[1] - (double)inverse[0], more2 = (double)inverse[2] - (double)inverse[0];
    s->is_even = inverse[0] == inverse[1] && inverse[0] == inverse[2];
    if (s->is_even) {
        return;
    }
    s->q.origin = (double)inverse[0] + (s->n1.origin * more1 + s->n2.origin * more2);
    s->q.x = s->n1.x * more1 + s->n2.x * more2;
    s->q.y = s->n1.y * more1 + s->n2.y * more2;
    s->n1 = shape_scaled(&s->n1, (double)inverse[1]);
    s->n2 = shape_scaled(&s->n2, (double)inverse[2]);
}

/* The value of edge i, over twice the area: 0 on the edge from vertex `from`, 1 at the opposite corner. */
static lmb_draw_plane shape_edge(const lmb_setup *e, int i, const lmb_screen_vertex *from, double by_area)
{
    const double ex = e->ex[i], ey = e->ey[i];
    const int64_t origin = -(int64_t)e->ex[i] * from->x_24_8 - (int64_t)e->ey[i] * from->y_24_8;
    return shape_plane((double)origin * by_area, ex * 256.0 * by_area, ey * 256.0 * by_area);
}

/* The smallest step between depths near d. */
static float shape_depth_step(const lmb_draw_pass *pass, float d)
{
    float step = 1.1920929e-7f; /* of 1 .. 2 */
    if (pass->target->depth.format == LMB_DEPTH16) {
        return pass->depth_scale > 0.0f ? 1.0f / pass->depth_scale : 0.0f;
    }
    for (float size = 1.0f; d < size && step > 1e-30f; size *= 0.5f) {
        step *= 0.5f;
    }
    return step;
}

static float shape_offset(const lmb_draw_pass *pass, const lmb_setup *e)
{
    const lmb_draw_state *s = pass->state;
    if (!DRAW_FULL || (s->offset_slope == 0.0f && s->offset_units == 0.0f)) {
        return 0.0f;
    }
    const float slope = maxf(absf((float)e->d_x), absf((float)e->d_y));
    return slope * s->offset_slope + s->offset_units * shape_depth_step(pass, e->d_max);
}

/* --- triangles ---------------------------------------------------------------------------------------------------- */

typedef struct shape_edges {
    int32_t e[3], ex[3], ey[3];
} shape_edges;

/* Changes of the edges from a tile's first pixel to the pixel where each is least and greatest. */
typedef struct shape_reach {
    int64_t low[3], high[3];
} shape_reach;

static void shape_set_reach(shape_reach *out, const lmb_setup *s)
{
    const int64_t reach = LMB_TILE - 1;
    for (int i = 0; i < 3; ++i) {
        const int32_t ex = s->ex[i], ey = s->ey[i];
        out->low[i] = reach * ((int64_t)(ex < 0 ? ex : 0) + (ey < 0 ? ey : 0));
        out->high[i] = reach * ((int64_t)(ex > 0 ? ex : 0) + (ey > 0 ? ey : 0));
    }
}

/* Returns 1 and the edges at the tile's first pixel, where they are e, or 0 if the tile lies outside one. If the whole
 * tile lies inside an edge, the edge is set to 0: sums fit 32 bits. */
static int shape_enter(shape_edges *out, const lmb_setup *s, const shape_reach *r, const int64_t e[3])
{
    if (e[0] + r->high[0] < 0 || e[1] + r->high[1] < 0 || e[2] + r->high[2] < 0) {
        return 0;
    }
    for (int i = 0; i < 3; ++i) {
        const int32_t ex = s->ex[i], ey = s->ey[i];
        const int64_t low = e[i] + r->low[i];
        out->e[i] = low >= 0 ? 0 : (int32_t)e[i];
        out->ex[i] = low >= 0 ? 0 : ex;
        out->ey[i] = low >= 0 ? 0 : ey;
    }
    return 1;
}

/* The pixels of the tile that are inside, one bit each, in columns x0 .. x1 and rows y0 .. y1. */
static uint64_t shape_covered(const lmb_draw_pass *pass, const shape_edges *s, int32_t x0, int32_t x1, int32_t y0,
                              int32_t y1)
{
    uint64_t mask = 0;
    if ((s->ex[0] | s->ey[0] | s->ex[1] | s->ey[1] | s->ex[2] | s->ey[2]) == 0) {
        return ~(uint64_t)0;
    }
#if LMB_DRAW_LANES
    if (pass->state->kernels !=
        NULL) { /* outside the box, no pixel is inside all edges, or lmb_draw_tile drops it */
        return pass->state->kernels->draw_cover(s->e, s->ex, s->ey);
    }
#endif
    (void)pass;
    for (int32_t y = y0; y <= y1; ++y) {
        int32_t a = s->e[0] + s->ey[0] * y + s->ex[0] * x0, b = s->e[1] + s->ey[1] * y + s->ex[1] * x0,
                c = s->e[2] + s->ey[2] * y + s->ex[2] * x0;
        for (int32_t x = x0; x <= x1; ++x, a += s->ex[0], b += s->ex[1], c += s->ex[2]) {
            mask |= (uint64_t)((a | b | c) >= 0) << (y * LMB_TILE + x);
        }
    }
    return mask;
}

static void shape_fill(const lmb_draw_pass *pass, lmb_draw_shape *shape, const lmb_setup *s)
{
    const int32_t origin_x = 128 - pass->middle_x, origin_y = 128 - pass->middle_y;
    const int32_t x0 = maxi((s->x_min - origin_x + 255) >> 8, pass->x0),
                  x1 = mini((s->x_max - origin_x) >> 8, pass->x1);
    const int32_t y0 = maxi((s->y_min - origin_y + 255) >> 8, pass->y0),
                  y1 = mini((s->y_max - origin_y) >> 8, pass->y1);
    shape_reach reach;
    shape_set_reach(&reach, s);
    for (int32_t y = y0 & ~7; y <= y1; y += LMB_TILE) {
        int entered = 0;
        int64_t e[3];
        for (int i = 0; i < 3; ++i) {
            e[i] = setup_edge(s, i, (x0 & ~7) * 256 + origin_x, y * 256 + origin_y);
        }
        /* The tiles of a row that a triangle touches are next to each other. A step of 8 px is a whole number. */
        for (int32_t x = x0 & ~7; x <= x1; x += LMB_TILE) {
            shape_edges edges;
            const int enters = shape_enter(&edges, s, &reach, e);
            if (entered && !enters) {
                break;
            }
            entered = enters;
            for (int i = 0; i < 3; ++i) {
                e[i] += (int64_t)s->ex[i] * LMB_TILE;
            }
            if (enters) {
                lmb_draw_tile(pass, shape, x, y,
                              shape_covered(pass, &edges, maxi(x0 - x, 0), mini(x1 - x, LMB_TILE - 1), maxi(y0 - y, 0),
                                            mini(y1 - y, LMB_TILE - 1)));
            }
        }
    }
}

static int shape_is_back(const lmb_draw_state *s, int clockwise)
{
    return clockwise != ((s->flags & LMB_DRAW_CLOCKWISE) != 0);
}

/* 1 if the state culls this facing. */
static int shape_is_culled(const lmb_draw_state *s, int clockwise)
{
    return (s->flags & (shape_is_back(s, clockwise) ? LMB_DRAW_CULL_BACK : LMB_DRAW_CULL_FRONT)) != 0;
}

/* 1 if the box of the corners holds the centre of a pixel to be drawn. Most small triangles' boxes hold none. */
static int shape_holds_pixel(const lmb_draw_pass *pass, const lmb_screen_vertex at[3])
{
    const int32_t x = 128 - pass->middle_x, y = 128 - pass->middle_y;
    const int32_t x0 = (mini(at[0].x_24_8, mini(at[1].x_24_8, at[2].x_24_8)) - x + 255) >> 8;
    const int32_t x1 = (maxi(at[0].x_24_8, maxi(at[1].x_24_8, at[2].x_24_8)) - x) >> 8;
    const int32_t y0 = (mini(at[0].y_24_8, mini(at[1].y_24_8, at[2].y_24_8)) - y + 255) >> 8;
    const int32_t y1 = (maxi(at[0].y_24_8, maxi(at[1].y_24_8, at[2].y_24_8)) - y) >> 8;
    return maxi(x0, pass->x0) <= mini(x1, pass->x1) && maxi(y0, pass->y0) <= mini(y1, pass->y1);
}

/* Returns 0 if no pixel can be drawn. */
static int shape_set_triangle(lmb_draw_shape *out, lmb_setup *s, const lmb_draw_pass *pass, const lmb_draw_corner *a,
                              const lmb_draw_corner *b, const lmb_draw_corner *c)
{
    lmb_screen_vertex at[3];
    float inverse[3] = {shape_snap(&at[0], a, pass), shape_snap(&at[1], b, pass), shape_snap(&at[2], c, pass)};
    const int64_t area = setup_area(&at[0], &at[1], &at[2]);
    if (area == 0 || shape_is_culled(pass->state, area > 0) || !shape_holds_pixel(pass, at)) {
        return 0;
    }
    if (area < 0) { /* the winding is always the same */
        const lmb_screen_vertex vertex = at[1];
        const lmb_draw_corner *corner = b;
        const float w = inverse[1];
        at[1] = at[2];
        at[2] = vertex;
        b = c;
        c = corner;
        inverse[1] = inverse[2];
        inverse[2] = w;
    }
    lmb_setup_triangle(s, &at[0], &at[1], &at[2]);
    out->corner[0] = a;
    out->corner[1] = b;
    out->corner[2] = c;
    out->corners = 3;
    out->late = NULL;
    if (DRAW_FULL) {
        pass->now->is_back = shape_is_back(pass->state, area > 0);
    }
    out->d = shape_plane(s->d_origin, s->d_x, s->d_y);
    out->d_min = s->d_min;
    out->d_max = s->d_max;
    out->d_add = shape_offset(pass, s);
    const double by_area = 1.0 / (double)(area < 0 ? -area : area);
    out->n1 = shape_edge(s, 2, &at[2], by_area);
    out->n2 = shape_edge(s, 0, &at[0], by_area);
    shape_set_shares(out, inverse);
    return 1;
}

#if LMB_DRAW_LANES
/* Draws the triangle by one kernel, if possible. */
static int shape_area(const lmb_draw_pass *pass, lmb_draw_shape *shape, const lmb_setup *s)
{
    const int32_t x = 128 - pass->middle_x, y = 128 - pass->middle_y;
    const int32_t box[4] = {maxi((s->x_min - x + 255) >> 8, pass->x0), maxi((s->y_min - y + 255) >> 8, pass->y0),
                            mini((s->x_max - x) >> 8, pass->x1), mini((s->y_max - y) >> 8, pass->y1)};
    draw_edge edge[3];
    for (int i = 0; i < 3; ++i) {
        edge[i].at = setup_edge(s, i, (box[0] & ~7) * 256 + x, (box[1] & ~7) * 256 + y);
        edge[i].x = s->ex[i];
        edge[i].y = s->ey[i];
    }
    return lmb_draw_rows_area(pass, shape, edge, box);
}
#endif

NOINLINE int shape_cut_part(const lmb_draw_pass *pass, const lmb_draw_corner *a, const lmb_draw_corner *b,
                            const lmb_draw_corner *c)
{
    lmb_draw_shape shape;
    lmb_setup s;
    const int shows = shape_set_triangle(&shape, &s, pass, a, b, c);
    shape.is_cut = 1;
    if (shows) {
        shape_fill(pass, &shape, &s);
    }
    return shows;
}

/* A triangle that needs cutting. All corners and a kernel's vectors take too much stack together, so it is coloured in
 * plain C. */
NOINLINE int shape_cut_triangle(const lmb_draw_pass *pass, const lmb_draw_corner corner[3])
{
    lmb_draw_corner all[DRAW_CORNERS];
    int drawn = 0;
    for (int i = 0; i < 3; ++i) {
        all[i] = corner[i];
    }
    const int n = lmb_draw_cut_polygon(all, pass);
    for (int i = 2; i < n; ++i) {
        drawn |= shape_cut_part(pass, &all[0], &all[i - 1], &all[i]);
    }
    return drawn;
}

/* A triangle that needs no cutting. */
NOINLINE int shape_whole_triangle(const lmb_draw_pass *pass, const lmb_draw_corner corner[3])
{
    lmb_draw_shape shape;
    lmb_setup s;
    if (!shape_set_triangle(&shape, &s, pass, &corner[0], &corner[1], &corner[2])) {
        return 0;
    }
    shape.is_cut = 0;
#if LMB_DRAW_LANES
    if ((pass->draws & DRAW_AREAS) != 0 && shape_area(pass, &shape, &s)) {
        return 1;
    }
#endif
    shape_fill(pass, &shape, &s);
    return 1;
}

int lmb_draw_triangle(const lmb_draw_pass *pass, const lmb_draw_corner corner[3])
{
    for (int i = 0; i < 3; ++i) {
        if (lmb_draw_is_out(&corner[i], pass)) {
            return shape_cut_triangle(pass, corner);
        }
    }
    return shape_whole_triangle(pass, corner);
}

/* --- lines -------------------------------------------------------------------------------------------------------- */

/* Pixels of a shape in one tile, not drawn yet. */
typedef struct shape_run {
    const lmb_draw_pass *pass;
    lmb_draw_shape *shape;
    int32_t x, y;
    uint64_t mask;
} shape_run;

static void shape_flush(shape_run *r)
{
    if (r->mask != 0) {
        lmb_draw_tile(r->pass, r->shape, r->x, r->y, r->mask);
    }
    r->mask = 0;
}

static void shape_put(shape_run *r, int32_t x, int32_t y)
{
    const lmb_draw_pass *p = r->pass;
    if (x < p->x0 || x > p->x1 || y < p->y0 || y > p->y1) {
        return;
    }
    if ((x & ~7) != r->x || (y & ~7) != r->y) {
        shape_flush(r);
        r->x = x & ~7;
        r->y = y & ~7;
    }
    r->mask |= (uint64_t)1 << ((y & 7) * LMB_TILE + (x & 7));
}

/* A line along its longer axis, `along`; `across` is the other axis. 24.8 of the frame; pixel indices use the same
 * axes. */
typedef struct shape_way {
    int32_t from_along, from_across, to_along, to_across;
    int is_steep; /* along is y */
} shape_way;

/* 1 if the point, shifted a little to the left and less upwards, is in the open diamond of the pixel. */
static int shape_in_diamond(const shape_way *w, int32_t along, int32_t across, int32_t pixel_along,
                            int32_t pixel_across)
{
    const int32_t a = along - (pixel_along * 256 + 128), b = across - (pixel_across * 256 + 128);
    const int32_t sum = (a < 0 ? -a : a) + (b < 0 ? -b : b);
    return sum < 128 || (sum == 128 && (w->is_steep ? b : a) > 0);
}

/* 1 if the line leaves the diamond of the pixel in which it crosses this column or row. */
static int shape_leaves(const shape_way *w, int32_t pixel_along, int32_t pixel_across)
{
    const int32_t middle = pixel_along * 256 + 128;
    const int forth = w->to_along > w->from_along;
    if (shape_in_diamond(w, w->to_along, w->to_across, pixel_along, pixel_across)) {
        return 0;
    }
    if (shape_in_diamond(w, w->from_along, w->from_across, pixel_along, pixel_across)) {
        return 1;
    }
    return forth ? middle >= w->from_along && middle < w->to_along : middle < w->from_along && middle >= w->to_along;
}

/* Length of a line along its axis, and rise across it in the same direction. */
typedef struct shape_slope {
    int64_t length, rise;
} shape_slope;

static shape_slope shape_slope_of(const shape_way *w)
{
    const int forth = w->to_along > w->from_along;
    shape_slope s;
    s.length = forth ? (int64_t)w->to_along - w->from_along : (int64_t)w->from_along - w->to_along;
    s.rise = forth ? (int64_t)w->to_across - w->from_across : (int64_t)w->from_across - w->to_across;
    return s;
}

/* Intersection of the line with the centre line of a pixel: whole pixels across, and the rest in 1 / (256 length) of
 * one. */
typedef struct shape_cross {
    int64_t across, rest;
} shape_cross;

static shape_cross shape_cross_at(const shape_way *w, const shape_slope *s, int32_t along)
{
    const int64_t whole = 256 * s->length;
    const int64_t at = w->from_across * s->length + ((int64_t)along * 256 + 128 - w->from_along) * s->rise;
    shape_cross c;
    c.across = at / whole;
    c.rest = at % whole;
    if (c.rest < 0) {
        c.rest += whole;
        --c.across;
    }
    return c;
}

/* On the border of two pixels: the left one, or the upper one unless the line falls to the right. */
static int32_t shape_crossed(const shape_way *w, const shape_slope *s, const shape_cross *c)
{
    return (int32_t)c->across - (c->rest == 0 && (w->is_steep || s->rise <= 0));
}

/* The pixels that line_pattern draws. */
typedef struct shape_dash {
    int32_t from, forth; /* first pixel along the line, and the direction */
    uint32_t before, repeat, pattern;
} shape_dash;

static int shape_is_dashed(const shape_dash *d, int32_t along)
{
    const uint32_t n = d->before + (uint32_t)(d->forth ? along - d->from : d->from - along);
    return (d->pattern >> (n / d->repeat & 15u) & 1u) != 0;
}

/* The first pixel of the line from `at` on, within three. */
static int32_t shape_end(const shape_way *w, const shape_slope *s, int32_t at, int32_t step)
{
    for (int i = 0; i < 3; ++i, at += step) {
        const shape_cross c = shape_cross_at(w, s, at);
        if (shape_leaves(w, at, shape_crossed(w, s, &c))) {
            break;
        }
    }
    return at;
}

/* A line's dashes, from the end pixels first .. last. Updates the count for the next line. */
static shape_dash shape_dash_of(const lmb_draw_pass *pass, const shape_way *w, int32_t first, int32_t last)
{
    const shape_slope s = shape_slope_of(w);
    shape_dash d = {0, 1, *pass->dashed, pass->state->line_repeat, pass->state->line_pattern};
    if (d.pattern == 0xffff) {
        return d;
    }
    const int32_t low = shape_end(w, &s, first, 1), high = shape_end(w, &s, last, -1);
    d.forth = w->to_along > w->from_along;
    d.from = d.forth ? low : high;
    *pass->dashed += (uint32_t)maxi(high - low + 1, 0);
    return d;
}

/* Draws the pixels first .. last along the line, line_px wide. */
static void shape_walk(shape_run *run, const shape_way *w, int32_t first, int32_t last, const shape_dash *dash)
{
    const shape_slope s = shape_slope_of(w);
    const int64_t whole = 256 * s.length, step = 256 * s.rise;
    const int32_t px = run->pass->state->line_px;
    shape_cross c = shape_cross_at(w, &s, first);
    for (int32_t along = first; along <= last; ++along) {
        const int32_t at = shape_crossed(w, &s, &c);
        if (shape_leaves(w, along, at) && (dash->pattern == 0xffff || shape_is_dashed(dash, along))) {
            for (int32_t k = 0; k < px; ++k) {
                shape_put(run, w->is_steep ? at + k : along, w->is_steep ? along : at + k);
            }
        }
        c.rest += step;
        if (c.rest >= whole) {
            c.rest -= whole;
            ++c.across;
        } else if (c.rest < 0) {
            c.rest += whole;
            --c.across;
        }
    }
}

/* a and b: 24.8 from the viewport's centre; two places. */
static void shape_trace(const lmb_draw_pass *pass, lmb_draw_shape *shape, const lmb_screen_vertex *a,
                        const lmb_screen_vertex *b)
{
    const int32_t px = pass->state->line_px, shift = (px - 1) * 128;
    const int32_t dx = b->x_24_8 - a->x_24_8, dy = b->y_24_8 - a->y_24_8;
    const int32_t ax = a->x_24_8 + pass->middle_x, ay = a->y_24_8 + pass->middle_y;
    shape_run run = {pass, shape, 0, 0, 0};
    shape_way w = {ax, ay - shift, ax + dx, ay + dy - shift, 0};
    if ((dy < 0 ? -dy : dy) > (dx < 0 ? -dx : dx)) {
        const shape_way steep = {ay, ax - shift, ay + dy, ax + dx - shift, 1};
        w = steep;
    }
    const int32_t first = (mini(w.from_along, w.to_along) - 1) >> 8, last = maxi(w.from_along, w.to_along) >> 8;
    const shape_dash dash = shape_dash_of(pass, &w, first, last);
    shape_walk(&run, &w, maxi(first, w.is_steep ? pass->y0 : pass->x0), mini(last, w.is_steep ? pass->y1 : pass->x1),
               &dash);
    shape_flush(&run);
}

int lmb_draw_line(const lmb_draw_pass *pass, lmb_draw_corner corner[2])
{
    lmb_draw_shape shape;
    lmb_screen_vertex at[2];
    if (!lmb_draw_cut_line(corner, pass)) {
        return 0;
    }
    const float inverse0 = shape_snap(&at[0], &corner[0], pass), inverse1 = shape_snap(&at[1], &corner[1], pass);
    const float inverse[3] = {inverse0, inverse1, inverse0};
    const double ax = at[0].x_24_8 * (1.0 / 256.0), ay = at[0].y_24_8 * (1.0 / 256.0),
                 dx = at[1].x_24_8 * (1.0 / 256.0) - ax, dy = at[1].y_24_8 * (1.0 / 256.0) - ay,
                 square = dx * dx + dy * dy, more = (double)at[1].d - (double)at[0].d;
    if (!(square > 0.0)) {
        return 0;
    }
    shape.corner[0] = shape.corner[2] = &corner[0];
    shape.corner[1] = &corner[1];
    shape.corners = 2;
    shape.late = NULL;
    shape.is_cut = 0;
    shape.n1 = shape_plane(-(ax * dx + ay * dy) / square, dx / square, dy / square);
    shape.n2 = shape_plane(0.0, 0.0, 0.0);
    shape.d = shape_scaled(&shape.n1, more);
    shape.d.origin += (double)at[0].d;
    shape.d_min = minf(at[0].d, at[1].d);
    shape.d_max = maxf(at[0].d, at[1].d);
    shape.d_add = 0.0f;
    shape_set_shares(&shape, inverse);
    shape_trace(pass, &shape, &at[0], &at[1]);
    return 1;
}

/* --- points ------------------------------------------------------------------------------------------------------- */

/* The pixels in columns x0 .. x1 and rows y0 .. y1 of a tile. */
static uint64_t shape_rectangle(int32_t x0, int32_t x1, int32_t y0, int32_t y1)
{
    const uint64_t row = (0xffu >> (7 - x1)) & (0xffu << x0);
    uint64_t mask = 0;
    for (int32_t y = y0; y <= y1 && x0 <= x1; ++y) {
        mask |= row << (y * LMB_TILE);
    }
    return mask;
}

int lmb_draw_point(const lmb_draw_pass *pass, const lmb_draw_corner *corner)
{
    const lmb_draw_plane none = {0.0, 0.0, 0.0};
    const int32_t px = pass->state->point_px, half = (px & 1) != 0 ? 0 : 128;
    lmb_draw_shape shape;
    lmb_screen_vertex at;
    if (lmb_draw_is_out(corner, pass)) {
        return 0;
    }
    (void)shape_snap(&at, corner, pass);
    shape.corner[0] = shape.corner[1] = shape.corner[2] = corner;
    shape.corners = 1;
    shape.late = NULL;
    shape.is_cut = 0;
    shape.d = shape.n1 = shape.n2 = shape.q = none;
    shape.d.origin = (double)at.d;
    shape.d_min = shape.d_max = at.d;
    shape.d_add = 0.0f;
    shape.is_even = 1;
    const int32_t left = ((at.x_24_8 + pass->middle_x + half) >> 8) - px / 2;
    const int32_t top = ((at.y_24_8 + pass->middle_y + half) >> 8) - px / 2;
    const int32_t x0 = maxi(left, pass->x0), x1 = mini(left + px - 1, pass->x1);
    const int32_t y0 = maxi(top, pass->y0), y1 = mini(top + px - 1, pass->y1);
    for (int32_t y = y0 & ~7; y <= y1; y += LMB_TILE) {
        for (int32_t x = x0 & ~7; x <= x1; x += LMB_TILE) {
            lmb_draw_tile(pass, &shape, x, y,
                          shape_rectangle(maxi(x0 - x, 0), mini(x1 - x, LMB_TILE - 1), maxi(y0 - y, 0),
                                          mini(y1 - y, LMB_TILE - 1)));
        }
    }
    return 1;
}
#endif
