/* fixed.c: a frame by integers: vertices to the screen, visible triangles, and bands. Layer 8.
 *
 * Coordinates have 14 bits, the camera's 16, and axes 15, so that a rotated vertex fits 31 bits. It is stored in 1/16
 * unit, 21 bits, below 2^31 / 2048. On the screen a guard band of 12 times the sides, in 1/16 px, keeps differences
 * below 2^14 and areas below 2^29. */
#include <lambent/fixed.h>

#include <string.h>

#include "fixed_part.h"
#include "number.h"

enum { GUARD_WIDTHS = 12, MIN_FOCAL = 16, MAX_FOCAL = 16383, MIN_NEAR = 16, MAX_NEAR = 4095 };

/* A vertex in camera space: right, up, ahead; 1/16 unit. */
typedef struct fixed_seen_from {
    int32_t v[3], colour[3];
} fixed_seen_from;

/* Shared by all vertices of a view: the guard band in 1/16 px, and the limits of x / z and y / z in 2^-16. */
typedef struct looking {
    const lmb_fixed_view *view;
    int32_t guard_x, guard_y, most_x, most_y;
} looking;

static looking look_through(const lmb_fixed_view *view)
{
    const int32_t free = zeros_above((uint32_t)view->focal);
    const uint32_t per = reciprocal((uint32_t)view->focal << free);
    looking l = {view, GUARD_WIDTHS * view->width, GUARD_WIDTHS * view->height, 0, 0};
    l.most_x = (int32_t)(high_of((uint32_t)l.guard_x << 16, per) >> (30 - free));
    l.most_y = (int32_t)(high_of((uint32_t)l.guard_y << 16, per) >> (30 - free));
    return l;
}

static void turn_to_view(int32_t v[3], const lmb_fixed_view *view, const int32_t at[3])
{
    const int32_t x = at[0] - view->eye[0], y = at[1] - view->eye[1], z = at[2] - view->eye[2];
    const int32_t *right = view->axis[0], *up = view->axis[1], *back = view->axis[2];
    v[0] = (right[0] * x + right[1] * y + right[2] * z) >> 10;
    v[1] = (up[0] * x + up[1] * y + up[2] * z) >> 10;
    v[2] = -((back[0] * x + back[1] * y + back[2] * z) >> 10);
}

/* Distance inside of a plane, in 31 bits: near, left, right, below, above. */
static int32_t distance_inside(const int32_t v[3], const lmb_fixed_view *view, int plane)
{
    const int64_t to = plane < 3 ? (int64_t)GUARD_WIDTHS * view->width * v[2]
                                 : (int64_t)GUARD_WIDTHS * view->height * v[2],
                  own = (int64_t)view->focal * v[plane < 3 ? 0 : 1];
    return plane == 0 ? v[2] - 16 * view->near_units : (int32_t)((plane & 1 ? to + own : to - own) >> 5);
}

/* Projects to the screen. Returns 0 if the guard band clamps the point. */
static int project(int32_t out[3], const int32_t v[3], const looking *l)
{
    const lmb_fixed_view *view = l->view;
    const int32_t free = zeros_above((uint32_t)v[2]);
    const uint32_t per = reciprocal((uint32_t)v[2] << free);
    /* v / z in 2^-(41 - free), and then in 2^-16 */
    const int32_t x = signed_high_of(v[0] * 2048, (int32_t)per) >> (25 - free),
                  y = signed_high_of(v[1] * 2048, (int32_t)per) >> (25 - free);
    const int32_t near_x = within(x, -l->most_x, l->most_x), near_y = within(y, -l->most_y, l->most_y);
    const uint32_t depth = high_of((uint32_t)view->near_units * (16u * 65535u), per) >> (30 - free);
    out[0] = 8 * view->width + ((near_x * view->focal + 32768) >> 16);
    out[1] = 8 * view->height - ((near_y * view->focal + 32768) >> 16);
    out[2] = within((int32_t)depth, FIXED_LEAST_DEPTH, FIXED_MOST_DEPTH);
    return x == near_x && y == near_y;
}

static uint8_t outside(const int32_t v[3], const lmb_fixed_view *view)
{
    uint32_t flags = 0;
    for (int plane = 0; plane < 5; ++plane) {
        flags |= (uint32_t)(distance_inside(v, view, plane) < 0) << plane;
    }
    return (uint8_t)flags;
}

static void place_vertex(lmb_fixed_vertex *out, const looking *l, const uint32_t *word)
{
    int32_t at[3], v[3], p[3];
    fixed_place_of(at, word);
    turn_to_view(v, l->view, at);
    out->flags = 0;
    if (v[2] < 16 * l->view->near_units) {
        out->flags = outside(v, l->view);
        return;
    }
    if (!project(p, v, l)) {
        out->flags = outside(v, l->view);
    }
    out->x = (int16_t)p[0];
    out->y = (int16_t)p[1];
    out->depth = (uint16_t)p[2];
}

/* --- clipping ----------------------------------------------------------------------------------------------------- */

/* Cuts from a, inside, to b, outside. */
static void cut_edge_units(fixed_seen_from *out, const fixed_seen_from *a, const fixed_seen_from *b, int32_t in,
                           int32_t beyond)
{
    const uint32_t whole = (uint32_t)in + (uint32_t)-beyond;
    const int32_t free = zeros_above(whole);
    const uint32_t share = high_of((uint32_t)in << free, reciprocal(whole << free)); /* 2^-30 */
    for (int i = 0; i < 3; ++i) {
        out->v[i] = a->v[i] + (int32_t)(((int64_t)(b->v[i] - a->v[i]) * share) >> 30);
        out->colour[i] = a->colour[i] + (int32_t)(((int64_t)(b->colour[i] - a->colour[i]) * share) >> 30);
    }
}

/* Always cuts from the inside to the outside, so that neighbours cut a shared edge at one place. Rounding may leave a
 * shape that is not quite convex: excess corners are dropped. */
static int cut_by_view_plane(fixed_seen_from *out, const fixed_seen_from *p, int count, const lmb_fixed_view *view,
                             int plane)
{
    int n = 0;
    for (int i = 0; i < count && n + 2 <= FIXED_CORNERS; ++i) {
        const fixed_seen_from *a = &p[i], *b = &p[i + 1 < count ? i + 1 : 0];
        const int32_t at = distance_inside(a->v, view, plane), bt = distance_inside(b->v, view, plane);
        if (at >= 0) {
            out[n++] = *a;
        }
        if (at >= 0 && bt < 0) {
            cut_edge_units(&out[n++], a, b, at, bt);
        } else if (at < 0 && bt >= 0) {
            cut_edge_units(&out[n++], b, a, bt, at);
        }
    }
    return n;
}

/* 1 if a corner is outside the plane; usually all are inside. */
static int is_cut(const fixed_seen_from *p, int count, const lmb_fixed_view *view, int plane)
{
    int32_t any = 0;
    for (int i = 0; i < count; ++i) {
        any |= distance_inside(p[i].v, view, plane);
    }
    return any < 0;
}

static void fixed_triangle(uint32_t out[3], const lmb_fixed *s, uint32_t triangle)
{
    const uint32_t *t = s->triangle + 2 * triangle;
    out[0] = t[0] & 0xffffu, out[1] = t[0] >> 16, out[2] = t[1];
}

int lmb_fixed_clip(lmb_fixed_vertex out[FIXED_CORNERS], const lmb_fixed_frame *f, uint32_t triangle)
{
    fixed_seen_from one[FIXED_CORNERS], other[FIXED_CORNERS], *a = one, *b = other, *swap;
    uint32_t vertex[3];
    int count = 3;
    const looking l = look_through(&f->view);
    fixed_triangle(vertex, f->scene, triangle);
    for (int i = 0; i < 3; ++i) {
        int32_t at[3];
        fixed_place_of(at, f->scene->receiver + LMB_FIXED_RECEIVER_WORDS * vertex[i]);
        turn_to_view(a[i].v, &f->view, at);
        for (int c = 0; c < 3; ++c) {
            a[i].colour[c] = f->vertex[vertex[i]].colour[c];
        }
    }
    for (int plane = 0; plane < 5 && count >= 3; ++plane) {
        if (is_cut(a, count, &f->view, plane)) {
            count = cut_by_view_plane(b, a, count, &f->view, plane);
            swap = a, a = b, b = swap;
        }
    }
    for (int i = 0; i < count; ++i) {
        int32_t p[3];
        a[i].v[2] = maxi(a[i].v[2], 16 * f->view.near_units);
        project(p, a[i].v, &l);
        out[i].x = (int16_t)p[0], out[i].y = (int16_t)p[1], out[i].depth = (uint16_t)p[2];
        for (int c = 0; c < 3; ++c) {
            out[i].colour[c] = (uint8_t)a[i].colour[c];
        }
    }
    return count;
}

/* --- visible triangles -------------------------------------------------------------------------------------------- */

static int32_t screen_area(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t x2, int32_t y2)
{
    return (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
}

/* Sets the rows with centres in between. Returns 1 if there are any, and pixels across. */
static int set_seen_rows(lmb_fixed_seen *out, const lmb_fixed_view *view, int32_t x0, int32_t x1, int32_t y0,
                         int32_t y1)
{
    const int32_t first = maxi((y0 + 7) >> 4, 0), past = mini((y1 + 7) >> 4, view->height);
    out->first = (int16_t)first;
    out->past = (int16_t)past;
    return first < past && x1 > 0 && x0 < 16 * view->width && (x0 + 7) >> 4 < (x1 + 8) >> 4;
}

/* Number of triangles left of a cut one. */
static uint32_t see_cut(lmb_fixed_seen *out, const lmb_fixed_frame *f, uint32_t triangle)
{
    lmb_fixed_vertex c[FIXED_CORNERS];
    const int count = lmb_fixed_clip(c, f, triangle);
    int32_t x0, x1, y0, y1, area = 0;
    if (count < 3) {
        return 0;
    }
    x0 = x1 = c[0].x, y0 = y1 = c[0].y;
    for (int i = 1; i < count; ++i) {
        x0 = mini(x0, c[i].x), x1 = maxi(x1, c[i].x), y0 = mini(y0, c[i].y), y1 = maxi(y1, c[i].y);
    }
    for (int i = 2; i < count; ++i) {
        area += screen_area(c[0].x, c[0].y, c[i - 1].x, c[i - 1].y, c[i].x, c[i].y);
    }
    return area < 0 && set_seen_rows(out, &f->view, x0, x1, y0, y1) ? (uint32_t)(count - 2) : 0;
}

static uint32_t see(lmb_fixed_seen *out, const lmb_fixed_frame *f, uint32_t triangle)
{
    uint32_t vertex[3];
    fixed_triangle(vertex, f->scene, triangle);
    const lmb_fixed_vertex *a = &f->vertex[vertex[0]], *b = &f->vertex[vertex[1]], *c = &f->vertex[vertex[2]];
    out->triangle = (uint16_t)triangle;
    if (((a->flags | b->flags | c->flags) & FIXED_OUTSIDE) != 0) {
        out->triangle |= FIXED_CUT;
        return (a->flags & b->flags & c->flags & FIXED_OUTSIDE) == 0 ? see_cut(out, f, triangle) : 0;
    }
    if (screen_area(a->x, a->y, b->x, b->y, c->x, c->y) >= 0) {
        return 0;
    }
    return (uint32_t)set_seen_rows(out, &f->view, mini(a->x, mini(b->x, c->x)), maxi(a->x, maxi(b->x, c->x)),
                                   mini(a->y, mini(b->y, c->y)), maxi(a->y, maxi(b->y, c->y)));
}

static int is_between(int32_t v, int32_t low, int32_t high) { return v >= low && v <= high; }

static int has_memory(const lmb_fixed_frame *f)
{
    return f != NULL && f->scene != NULL && f->scene->receiver != NULL && f->vertex != NULL && f->seen != NULL &&
           f->group != NULL;
}

static int is_fixed_view(const lmb_fixed_view *v)
{
    for (int i = 0; i < 3; ++i) {
        int64_t length = 0;
        for (int c = 0; c < 3; ++c) {
            length += (int64_t)v->axis[i][c] * v->axis[i][c];
        }
        if (!is_between(v->eye[i], -LMB_FIXED_EYE, LMB_FIXED_EYE) || length > 16400 * 16400) {
            return 0;
        }
    }
    return is_between(v->width, 1, LMB_FIXED_MAX_SIDE) && is_between(v->height, 1, LMB_FIXED_MAX_SIDE) &&
           is_between(v->focal, MIN_FOCAL, MAX_FOCAL) && is_between(v->near_units, MIN_NEAR, MAX_NEAR);
}

static void set_groups(const lmb_fixed_frame *f)
{
    for (uint32_t i = 0; i < f->seen_count; i += LMB_FIXED_GROUP) {
        const uint32_t past = f->seen_count - i < LMB_FIXED_GROUP ? f->seen_count : i + LMB_FIXED_GROUP;
        int32_t first_row = f->seen[i].first, past_row = f->seen[i].past;
        for (uint32_t k = i + 1; k < past; ++k) {
            first_row = mini(first_row, f->seen[k].first), past_row = maxi(past_row, f->seen[k].past);
        }
        f->group[i / LMB_FIXED_GROUP].first = (int16_t)first_row;
        f->group[i / LMB_FIXED_GROUP].past = (int16_t)past_row;
    }
}

lmb_status lmb_fixed_transform(lmb_fixed_frame *f)
{
    if (!has_memory(f) || !is_fixed_view(&f->view)) {
        return LMB_ERR_ARG;
    }
    const lmb_fixed *s = f->scene;
    const looking l = look_through(&f->view);
    for (uint32_t i = 0; i < s->vertices; ++i) {
        place_vertex(&f->vertex[i], &l, s->receiver + LMB_FIXED_RECEIVER_WORDS * i);
    }
    f->seen_count = f->ready_count = 0;
    for (uint32_t t = 0; t < s->triangles && f->seen_count < f->seen_cap; ++t) {
        lmb_fixed_seen *first = &f->seen[f->seen_count];
        const uint32_t count = see(first, f, t);
        if (count > 0 && count <= f->seen_cap - f->seen_count) {
            uint32_t vertex[3];
            fixed_triangle(vertex, s, t);
            for (int i = 0; i < 3; ++i) {
                f->vertex[vertex[i]].flags |= FIXED_USED;
            }
            for (uint32_t i = 1; i < count; ++i) {
                first[i] = *first;
            }
            f->seen_count += count;
        }
    }
    set_groups(f);
    return LMB_OK;
}

/* --- bands -------------------------------------------------------------------------------------------------------- */

static int is_hull(const lmb_fixed_frame *f, uint32_t triangle)
{
    return (triangle & ~(uint32_t)FIXED_CUT) < f->scene->hull;
}

static int set_up(lmb_fixed_ready *out, const lmb_fixed_frame *f, uint32_t triangle, int32_t first, int32_t past)
{
    const uint32_t *t = f->scene->triangle + 2 * triangle;
    return lmb_fixed_set_up(out, &f->vertex[t[0] & 0xffffu], &f->vertex[t[0] >> 16], &f->vertex[t[1]], f->view.width,
                            first, past, !is_hull(f, triangle));
}

static void prepare_cut(lmb_fixed_ready *out, int places, const lmb_fixed_frame *f, uint32_t triangle)
{
    lmb_fixed_vertex c[FIXED_CORNERS];
    const int count = lmb_fixed_clip(c, f, triangle & ~(uint32_t)FIXED_CUT);
    for (int k = 0; k < places; ++k) {
        out[k].first = out[k].past = 0;
        if (k + 2 < count) {
            lmb_fixed_set_up(&out[k], &c[0], &c[k + 1], &c[k + 2], f->view.width, 0, f->view.height,
                             !is_hull(f, triangle));
        }
    }
}

lmb_status lmb_fixed_prepare(lmb_fixed_frame *f)
{
    if (!has_memory(f) || !is_fixed_view(&f->view)) {
        return LMB_ERR_ARG;
    }
    f->ready_count = 0;
    const uint32_t cap = f->ready == NULL ? 0 : f->ready_cap < f->seen_count ? f->ready_cap : f->seen_count;
    for (uint32_t i = 0, next; i < cap; i = next) {
        const uint32_t triangle = f->seen[i].triangle;
        next = i + 1;
        if ((triangle & FIXED_CUT) == 0) {
            set_up(&f->ready[i], f, triangle, 0, f->view.height);
        } else {
            while (next < f->seen_count && f->seen[next].triangle == triangle) {
                ++next;
            }
            if (next > cap) {
                break;
            }
            prepare_cut(&f->ready[i], (int)(next - i), f, triangle);
        }
        f->ready_count = next;
    }
    return LMB_OK;
}

/* Draws an entry that is not in `ready`. A cut triangle has several entries; the first one draws all parts. */
static void draw(const fixed_band *b, const lmb_fixed_frame *f, uint32_t i)
{
    const uint32_t triangle = f->seen[i].triangle;
    lmb_fixed_ready r;
    if ((triangle & FIXED_CUT) == 0) {
        if (set_up(&r, f, triangle, b->first, b->past)) {
            lmb_fixed_fill(b, &r);
        }
        return;
    }
    if (i > 0 && f->seen[i - 1].triangle == triangle) {
        return;
    }
    lmb_fixed_vertex c[FIXED_CORNERS];
    const int count = lmb_fixed_clip(c, f, triangle & ~(uint32_t)FIXED_CUT);
    for (int k = 2; k < count; ++k) {
        if (lmb_fixed_set_up(&r, &c[0], &c[k - 1], &c[k], b->width, b->first, b->past, b->depth != NULL)) {
            lmb_fixed_fill(b, &r);
        }
    }
}

lmb_status lmb_fixed_band(const lmb_fixed_frame *f, int32_t first, int32_t past)
{
    void *pixel = f != NULL && f->format != LMB_FIXED_RGB888 ? (void *)f->pixel_16
                  : f != NULL                                ? (void *)f->pixel
                                                             : NULL;
    if (!has_memory(f) || !is_fixed_view(&f->view) || pixel == NULL || f->depth == NULL || first < 0 || past <= first ||
        past > f->view.height || f->format < 0 || f->format > LMB_FIXED_RGBA5551) {
        return LMB_ERR_ARG;
    }
    fixed_band b = {pixel, NULL, f->view.width, first, past, f->format};
    if (f->background != LMB_FIXED_COVERED) {
        lmb_fixed_clear(&b, f->background);
    }
    for (uint32_t i = 0; i < f->seen_count; ++i) {
        const lmb_fixed_seen *s = &f->seen[i];
        const lmb_fixed_rows *g = &f->group[i / LMB_FIXED_GROUP];
        if (i % LMB_FIXED_GROUP == 0 && (g->first >= past || g->past <= first)) {
            i += LMB_FIXED_GROUP - 1;
            continue;
        }
        if (s->first >= past || s->past <= first) {
            continue;
        }
        if (b.depth == NULL && !is_hull(f, s->triangle)) { /* the hull's triangles come first */
            b.depth = f->depth;
            memset(b.depth, 0, (size_t)b.width * (size_t)(past - first) * sizeof *b.depth);
        }
        if (i < f->ready_count) {
            lmb_fixed_fill(&b, &f->ready[i]);
        } else {
            draw(&b, f, i);
        }
    }
    return LMB_OK;
}
