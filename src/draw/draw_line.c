/* draw_line.c: lines of one pixel that need no cutting, in common states, coloured by lanes. Layer 4.
 *
 * Corners, pixels and values are those of draw_quick.c, draw_shape.c and draw_tile.c. The pixels of a line are found
 * first, then tested, coloured and stored; no pixel occurs twice. */
#include "draw_part.h"

#include <string.h>

#if LMB_DRAW && LMB_DRAW_LANES
void lmb_draw_lines_begin(lmb_draw_pass *pass)
{
    const lmb_draw_state *s = pass->state;
    const lmb_draw_vertices *v = pass->vertices;
    const int tested = !pass->tests || (pass->tests_rows && pass->target->depth.layout == LMB_LINEAR);
    if (pass->paints_lanes && pass->paints_rows && s->kernels->draw_dots != NULL && tested &&
        s->stage[0].texture == NULL && s->line_px == 1 && s->line_pattern == 0xffff && s->planes == 0 &&
        (v->position_format == LMB_DRAW_F32 || v->position_format == LMB_DRAW_F32X4) && v->fogs == NULL) {
        pass->draws |= DRAW_LINES;
    }
    lmb_draw_find_fog(pass);
}

/* A line along its longer axis; 24.8 of the frame. As shape_way and shape_slope of draw_shape.c. */
typedef struct line_way {
    int32_t from_along, from_across, to_along, to_across;
    int is_steep;
    int64_t length, rise;
} line_way;

/* The parts of a line that all of its pixels use. */
typedef struct line_job {
    const lmb_draw_pass *pass;
    lmb_draw_plane n1, q, d;
    float d_min, d_max;
    lmb_draw_patch pixels; /* slopes without values at pixel 0 */
    lmb_draw_dots dots;
    uint8_t *pixel[LMB_DRAW_DOTS];
    int32_t count, blends;
    int32_t tile_x, tile_y; /* of the values below */
    float n1_at, q_at, d_at;
} line_job;

static line_way line_way_of(const lmb_draw_pass *pass, const draw_vertex *a, const draw_vertex *b)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y, ax = a->x + pass->middle_x, ay = a->y + pass->middle_y;
    line_way w = {ax, ay, ax + dx, ay + dy, 0, 0, 0};
    if ((dy < 0 ? -dy : dy) > (dx < 0 ? -dx : dx)) {
        const line_way steep = {ay, ax, ay + dy, ax + dx, 1, 0, 0};
        w = steep;
    }
    const int forth = w.to_along > w.from_along;
    w.length = forth ? (int64_t)w.to_along - w.from_along : (int64_t)w.from_along - w.to_along;
    w.rise = forth ? (int64_t)w.to_across - w.from_across : (int64_t)w.from_across - w.to_across;
    return w;
}

/* As shape_in_diamond. */
static int line_in_diamond(const line_way *w, int32_t along, int32_t across, int32_t pixel_along, int32_t pixel_across)
{
    const int32_t a = along - (pixel_along * 256 + 128), b = across - (pixel_across * 256 + 128);
    const int32_t sum = (a < 0 ? -a : a) + (b < 0 ? -b : b);
    return sum < 128 || (sum == 128 && (w->is_steep ? b : a) > 0);
}

/* As shape_leaves. */
static int line_leaves(const line_way *w, int32_t pixel_along, int32_t pixel_across)
{
    const int32_t middle = pixel_along * 256 + 128;
    if (line_in_diamond(w, w->to_along, w->to_across, pixel_along, pixel_across)) {
        return 0;
    }
    if (line_in_diamond(w, w->from_along, w->from_across, pixel_along, pixel_across)) {
        return 1;
    }
    return w->to_along > w->from_along ? middle >= w->from_along && middle < w->to_along
                                       : middle < w->from_along && middle >= w->to_along;
}

static float line_start(const lmb_draw_plane *p, double x, double y)
{
    return (float)(p->origin + p->x * x + p->y * y);
}

/* Values at the first pixel of the tile of pixel (x, y). */
static void line_enter(line_job *j, int32_t x, int32_t y)
{
    const lmb_draw_pass *pass = j->pass;
    j->tile_x = x & ~7;
    j->tile_y = y & ~7;
    const double at_x = (j->tile_x * 256 + 128 - pass->middle_x) * (1.0 / 256.0),
                 at_y = (j->tile_y * 256 + 128 - pass->middle_y) * (1.0 / 256.0);
    j->n1_at = line_start(&j->n1, at_x, at_y);
    j->q_at = j->pixels.is_even ? 1.0f : line_start(&j->q, at_x, at_y);
    if (pass->tests) {
        j->d_at = line_start(&j->d, at_x, at_y);
    }
}

/* Colours and stores the pixels that wait. */
static void line_flush(line_job *j)
{
    lmb_draw_dots *d = &j->dots;
    if (j->count == 0) {
        return;
    }
    if (j->blends) {
        for (int32_t i = 0; i < j->count; ++i) {
            memcpy(&d->codes[i], j->pixel[i], 4);
        }
    }
    j->pass->state->kernels->draw_dots(d, &j->pixels, j->count);
    for (int32_t i = 0; i < j->count; ++i) {
        memcpy(j->pixel[i], &d->codes[i], 4);
    }
    j->count = 0;
}

/* Returns 1 if the depth passes, and stores it. */
static int line_passes(const line_job *j, int32_t x, int32_t y)
{
    const lmb_draw_state *s = j->pass->state;
    const lmb_draw_target *t = j->pass->target;
    const lmb_draw_slope *slope = &j->pixels.d;
    uint8_t *row = (uint8_t *)t->depth.data + (ptrdiff_t)(y - t->y0) * t->depth.stride_bytes;
    float *was = (float *)(void *)row + (x - t->x0);
    const float d = minf(maxf((j->d_at + slope->y * (float)(y & 7)) + slope->x * (float)(x & 7), j->d_min), j->d_max);
    const int passes = (s->depth_func & (d < *was    ? LMB_DRAW_LESS
                                         : d == *was ? LMB_DRAW_EQUAL
                                                     : LMB_DRAW_GREATER)) != 0;
    if (passes && (s->flags & LMB_DRAW_DEPTH_WRITE) != 0) {
        *was = d;
    }
    return passes;
}

static inline void line_put(line_job *j, int32_t x, int32_t y)
{
    const lmb_draw_pass *pass = j->pass;
    const lmb_draw_target *t = pass->target;
    if (x < pass->x0 || x > pass->x1 || y < pass->y0 || y > pass->y1) {
        return;
    }
    if ((x & ~7) != j->tile_x || (y & ~7) != j->tile_y) {
        line_enter(j, x, y);
    }
    if (pass->tests && !line_passes(j, x, y)) {
        return;
    }
    const int32_t i = j->count++;
    j->dots.n1[i] = j->n1_at;
    j->dots.q[i] = j->q_at;
    j->dots.column[i] = x & 7;
    j->dots.row[i] = y & 7;
    j->pixel[i] = (uint8_t *)t->colour.data + (ptrdiff_t)(y - t->y0) * t->colour.stride_bytes +
                  4 * (ptrdiff_t)(x - t->x0);
    if (j->count == LMB_DRAW_DOTS) {
        line_flush(j);
    }
}

/* As shape_walk. Only pixels near the ends may stay in their diamonds. */
static void line_walk(line_job *j, const line_way *w)
{
    const lmb_draw_pass *pass = j->pass;
    const int32_t low = mini(w->from_along, w->to_along), high = maxi(w->from_along, w->to_along);
    const int32_t first = maxi((low - 1) >> 8, w->is_steep ? pass->y0 : pass->x0),
                  last = mini(high >> 8, w->is_steep ? pass->y1 : pass->x1);
    const int64_t whole = 256 * w->length, step = 256 * w->rise;
    const int64_t at = w->from_across * w->length + ((int64_t)first * 256 + 128 - w->from_along) * w->rise;
    int64_t across = at / whole, rest = at % whole;
    if (rest < 0) {
        rest += whole;
        --across;
    }
    const int back = w->is_steep || w->rise <= 0;
    for (int32_t along = first; along <= last; ++along) {
        const int32_t on = (int32_t)across - (rest == 0 && back), middle = along * 256 + 128;
        if ((middle - low > 128 && high - middle > 128) || line_leaves(w, along, on)) {
            line_put(j, w->is_steep ? on : along, w->is_steep ? along : on);
        }
        rest += step; /* without branches, which processors mispredict here */
        const int64_t over = -(int64_t)(rest >= whole), under = -(int64_t)(rest < 0);
        rest += (under & whole) - (over & whole);
        across += under - over;
    }
    line_flush(j);
}

static const uint8_t *line_colour(const lmb_draw_pass *pass, uint32_t i)
{
    return pass->vertices->colours != NULL ? pass->vertices->colours + 4 * (size_t)i : pass->state->colour;
}

static void line_set_plane(lmb_draw_slope *slope, const lmb_draw_plane *p)
{
    slope->x = (float)p->x;
    slope->y = (float)p->y;
}

static void line_scale(lmb_draw_plane *p, double by)
{
    p->origin *= by;
    p->x *= by;
    p->y *= by;
}

/* As lmb_draw_line. flat: the vertex of a flat colour. */
static void line_set(line_job *j, const lmb_draw_pass *pass, const draw_vertex *a, const draw_vertex *b, uint32_t flat,
                     double square, double dx, double dy)
{
    const double ax = a->x * (1.0 / 256.0), ay = a->y * (1.0 / 256.0);
    const int is_flat = (pass->state->flags & LMB_DRAW_FLAT) != 0;
    const uint8_t *from = line_colour(pass, is_flat ? flat : a->name - 1),
                  *to = line_colour(pass, is_flat ? flat : b->name - 1);
    lmb_draw_patch *p = &j->pixels;
    j->pass = pass;
    j->count = 0;
    j->blends = (pass->state->flags & LMB_DRAW_BLEND) != 0;
    j->tile_x = j->tile_y = -1; /* none */
    j->n1.origin = -(ax * dx + ay * dy) / square;
    j->n1.x = dx / square;
    j->n1.y = dy / square;
    if (pass->tests) {
        j->d = j->n1;
        line_scale(&j->d, (double)b->d - (double)a->d);
        j->d.origin += (double)a->d;
        j->d_min = minf(a->d, b->d);
        j->d_max = maxf(a->d, b->d);
        line_set_plane(&p->d, &j->d);
    }
    p->is_even = a->inverse == b->inverse;
    if (!p->is_even) {
        const double more = (double)b->inverse - (double)a->inverse;
        j->q.origin = (double)a->inverse + (j->n1.origin * more + 0.0);
        j->q.x = j->n1.x * more + 0.0;
        j->q.y = j->n1.y * more + 0.0;
        line_scale(&j->n1, (double)b->inverse);
        line_set_plane(&p->q, &j->q);
    }
    line_set_plane(&p->n1, &j->n1);
    p->state = pass->state;
    p->swaps = pass->target->colour.format == LMB_BGRA8;
    p->varies = 0;
    for (int i = 0; i < 4; ++i) {
        p->at[i] = from[i];
        p->more1[i] = (float)to[i] - (float)from[i];
        p->more2[i] = 0.0f;
        p->varies |= from[i] != to[i];
    }
}

int lmb_draw_quick_line(const lmb_draw_pass *pass, uint32_t a, uint32_t b)
{
    const uint32_t count = pass->vertices->count, i = draw_index(pass, a), k = draw_index(pass, b);
    draw_vertex from, to;
    line_job j;
    if (i >= count || k >= count) {
        return 0;
    }
    lmb_draw_place(&from, pass, i);
    lmb_draw_place(&to, pass, k);
    if ((from.out | to.out) != 0) {
        return 0;
    }
    const double dx = to.x * (1.0 / 256.0) - from.x * (1.0 / 256.0), dy = to.y * (1.0 / 256.0) - from.y * (1.0 / 256.0),
                 square = dx * dx + dy * dy;
    if (square > 0.0) {
        const line_way w = line_way_of(pass, &from, &to);
        line_set(&j, pass, &from, &to, k, square, dx, dy);
        line_walk(&j, &w);
    }
    if (pass->stats != NULL) {
        ++pass->stats->triangles;
        pass->stats->triangles_drawn += square > 0.0;
    }
    return 1;
}
#endif
