/* draw_list.c: checks a list's vertices and primitives and draws them in order. Layer 4. */
#include "draw_part.h"

#include <string.h>

#include "../base/surface_check.h"

#if LMB_DRAW
#define LIST_GUARD_PX 16383.0f /* from the viewport's centre; one px of rounding below the limit of setup.c */
#define LIST_ABSURD   1e30f    /* in clip space */

/* --- vertices ----------------------------------------------------------------------------------------------------- */

static float list_row(const lmb_mat4 *m, int row, lmb_vec3 p, float w)
{
    return m->m[row] * p.x + m->m[4 + row] * p.y + m->m[8 + row] * p.z + m->m[12 + row] * w;
}

static float list_plane(const float plane[4], lmb_vec3 p, float w)
{
    return plane[0] * p.x + plane[1] * p.y + plane[2] * p.z + plane[3] * w;
}

/* Position of a vertex in clip space, and values that depend on it. Returns 0 if it is not finite or absurd. */
static int list_place(lmb_draw_corner *out, const lmb_draw_pass *pass, uint32_t i)
{
    const lmb_draw_vertices *v = pass->vertices;
    const lmb_draw_state *s = pass->state;
    float w;
    const lmb_vec3 p = lmb_draw_position_w(&w, v, i);
    int sane = 1;
    for (int row = 0; row < 4; ++row) {
        out->v[CORNER_X + row] = list_row(&s->to_clip, row, p, w);
        sane &= out->v[CORNER_X + row] > -LIST_ABSURD && out->v[CORNER_X + row] < LIST_ABSURD;
    }
    const float *axis = s->fog_axis;
    const int has_axis = axis[0] != 0.0f || axis[1] != 0.0f || axis[2] != 0.0f || axis[3] != 0.0f;
    out->v[CORNER_FOG] = v->fogs != NULL ? v->fogs[i] : has_axis ? list_plane(axis, p, w) : out->v[CORNER_W];
    sane &= out->v[CORNER_FOG] > -LIST_ABSURD && out->v[CORNER_FOG] < LIST_ABSURD;
    for (int k = 0; DRAW_FULL && k < LMB_DRAW_PLANES; ++k) {
        const int on = (s->planes >> k & 1u) != 0;
        out->v[CORNER_PLANES + k] = on ? list_plane(s->plane[k], p, w) : 0.0f;
        sane &= out->v[CORNER_PLANES + k] > -LIST_ABSURD && out->v[CORNER_PLANES + k] < LIST_ABSURD;
    }
    return sane && (v->position_format == LMB_DRAW_F32X4 || is_place(p));
}

/* The colours of vertex i; those of the back if there are such. */
static void list_paint(lmb_draw_corner *out, const lmb_draw_pass *pass, uint32_t i, int back)
{
    static const uint8_t none[4] = {0, 0, 0, 0};
    const lmb_draw_vertices *v = pass->vertices;
    const uint8_t *colours = back && v->back_colours != NULL ? v->back_colours : v->colours;
    const uint8_t *seconds = back && v->back_seconds != NULL ? v->back_seconds : v->seconds;
    const uint8_t *colour = colours != NULL ? colours + 4 * (size_t)i : pass->state->colour;
    const uint8_t *second = seconds != NULL ? seconds + 4 * (size_t)i : none;
    for (int k = 0; k < 4; ++k) {
        out->v[CORNER_RED + k] = (float)colour[k];
    }
    for (int k = 0; k < 3; ++k) {
        out->v[CORNER_SECOND + k] = (float)second[k];
    }
}

/* Vertex i without colours. Returns 0 if it is to be dropped. */
static int list_vertex(lmb_draw_corner *out, const lmb_draw_pass *pass, uint32_t i)
{
    const lmb_draw_vertices *v = pass->vertices;
    int sane = list_place(out, pass, i);
    for (int k = 0; k < LMB_DRAW_STAGES; ++k) {
        float *uv = &out->v[CORNER_UV + 2 * k];
        uv[0] = uv[1] = 0.0f;
        if (v->uvs[k] != NULL && pass->state->stage[k].texture != NULL) {
            const float scale = v->uv_format == LMB_DRAW_I16 ? v->uv_scale : 1.0f;
            lmb_draw_fetch(uv, v->uvs[k], i, 2, v->uv_format);
            uv[0] *= scale;
            uv[1] *= scale;
            sane &= is_sane(uv[0]) && is_sane(uv[1]);
        }
    }
    return sane;
}

/* --- primitives --------------------------------------------------------------------------------------------------- */

/* A primitive: `n` vertices; the vertex for a flat colour; bits 0 .. 2 of the sides of a triangle that are sides of the
 * polygon, from each corner to the next one; bit SIDES_CHOSEN if the vertices' edge flags count. */
enum { SIDES_ALL = 7, SIDES_CHOSEN = 8 };
typedef struct list_primitive {
    uint32_t at[3], flat;
    int n, sides;
} list_primitive;

/* 1 if it faces away, by the corners before they snap. */
static int list_is_back(const lmb_draw_pass *pass, const lmb_draw_corner c[3])
{
    const float *p = c[0].v, *q = c[1].v, *r = c[2].v;
    const double x = (double)q[CORNER_Y] * (double)r[CORNER_W] - (double)q[CORNER_W] * (double)r[CORNER_Y];
    const double y = (double)q[CORNER_W] * (double)r[CORNER_X] - (double)q[CORNER_X] * (double)r[CORNER_W];
    const double w = (double)q[CORNER_X] * (double)r[CORNER_Y] - (double)q[CORNER_Y] * (double)r[CORNER_X];
    const double area = (double)p[CORNER_X] * x + (double)p[CORNER_Y] * y + (double)p[CORNER_W] * w;
    return ((pass->state->flags & LMB_DRAW_CLOCKWISE) != 0) == (area > 0.0);
}

/* For a shader: puts the shares of the primitive's vertices in place of colours. */
static void list_share(lmb_draw_corner corner[3], const lmb_draw_pass *pass, const list_primitive *p)
{
    for (int i = 0; i < 3; ++i) {
        pass->now->vertex[i] = p->at[i < p->n ? i : 0];
    }
    for (int i = 0; i < p->n; ++i) {
        for (int k = CORNER_RED; k < CORNER_UV; ++k) {
            corner[i].v[k] = 0.0f;
        }
        for (int k = 0; k < 3; ++k) {
            corner[i].v[CORNER_SECOND + k] = 0.0f;
        }
        if (i > 0) {
            corner[i].v[CORNER_SHARE + i - 1] = 1.0f;
        }
    }
}

/* Draws the sides of a triangle, or the corners at their start: bits 0 .. 2 of `sides`, from each corner to the next
 * one. */
NOINLINE int list_outline(const lmb_draw_pass *pass, const lmb_draw_corner corner[3], int sides, int mode)
{
    int drawn = 0;
    for (int i = 0; i < 3; ++i) {
        lmb_draw_corner line[2] = {corner[i], corner[(i + 1) % 3]};
        if ((sides >> i & 1) != 0) {
            drawn |= mode == LMB_DRAW_EDGES ? lmb_draw_line(pass, line) : lmb_draw_point(pass, line);
        }
    }
    return drawn;
}

static int list_draw_corners(const lmb_draw_pass *pass, const list_primitive *p, lmb_draw_corner corner[3])
{
    const lmb_draw_state *s = pass->state;
    const int has_back = DRAW_FULL && (pass->vertices->back_colours != NULL || pass->vertices->back_seconds != NULL);
    const int is_plain = !DRAW_FULL || (s->polygon_mode[0] == LMB_DRAW_FILL && s->polygon_mode[1] == LMB_DRAW_FILL);
    const int back = p->n == 3 && (has_back || !is_plain) && list_is_back(pass, corner);
    if (DRAW_FULL && s->shader != NULL) {
        list_share(corner, pass, p);
    }
    for (int i = 0; i < p->n && (!DRAW_FULL || s->shader == NULL); ++i) {
        list_paint(&corner[i], pass, (s->flags & LMB_DRAW_FLAT) != 0 ? p->flat : p->at[i], back);
    }
    if (DRAW_FULL && p->n == 3 && s->polygon_mode[back] != LMB_DRAW_FILL) {
        const int culled = (s->flags & (back ? LMB_DRAW_CULL_BACK : LMB_DRAW_CULL_FRONT)) != 0;
        pass->now->is_back = back;
        return culled ? 0 : list_outline(pass, corner, p->sides, s->polygon_mode[back]);
    }
    return !DRAW_FULL || p->n == 3 ? lmb_draw_triangle(pass, corner)
           : p->n == 2 ? lmb_draw_line(pass, corner)
                       : lmb_draw_point(pass, corner);
}

/* Draws a primitive of n corners from indices into the list. The arguments are apart, because callers that keep a
 * list_primitive take more stack. */
static void list_draw(const lmb_draw_pass *pass, uint32_t a, uint32_t b, uint32_t c, uint32_t flat, int n, int sides)
{
    const lmb_draw_vertices *v = pass->vertices;
    lmb_draw_corner corner[3];
    list_primitive p = {{a, b, c}, draw_index(pass, flat), n, sides};
    int sane = p.flat < v->count;
    for (int i = 0; i < n && sane; ++i) {
        p.at[i] = draw_index(pass, p.at[i]);
        sane = p.at[i] < v->count && list_vertex(&corner[i], pass, p.at[i]);
        if (sane && (p.sides & SIDES_CHOSEN) != 0 && v->edges != NULL && v->edges[p.at[i]] == 0) {
            p.sides &= ~(1 << i);
        }
    }
    if (pass->stats != NULL) {
        ++pass->stats->triangles;
        pass->stats->triangles_dropped += !sane;
    }
    if (!sane) {
        return;
    }
    const int drawn = list_draw_corners(pass, &p, corner);
    if (pass->stats != NULL) {
        pass->stats->triangles_drawn += (uint32_t)drawn;
    }
}

static void list_triangle(const lmb_draw_pass *pass, uint32_t a, uint32_t b, uint32_t c, uint32_t flat, int sides)
{
    if (!DRAW_FULL || pass->few == NULL || !lmb_draw_quick(pass, a, b, c, flat)) {
        list_draw(pass, a, b, c, flat, 3, sides);
    }
}

static void list_line(const lmb_draw_pass *pass, uint32_t a, uint32_t b)
{
#if LMB_DRAW_LANES
    if ((pass->draws & DRAW_LINES) != 0 && lmb_draw_quick_line(pass, a, b)) {
        return;
    }
#endif
    list_draw(pass, a, b, b, b, 2, 0);
}

static void list_quad(const lmb_draw_pass *pass, uint32_t a, uint32_t b, uint32_t c, uint32_t d, uint32_t flat,
                      int chosen)
{
    const uint32_t at[4] = {a, b, c, d};
    *pass->dashed = 0;
    if (DRAW_FULL && pass->fills && pass->few != NULL && lmb_draw_quick_rectangle(pass, at, flat)) {
        return;
    }
    list_triangle(pass, a, b, c, flat, 3 | chosen);
    list_triangle(pass, a, c, d, flat, 6 | chosen);
}

#if LMB_DRAW_LANES
/* Draws quad n / 2 if it is an upright rectangle that pass->fills names. */
static int list_rectangle(const lmb_draw_pass *pass, int32_t primitive, uint32_t n)
{
    const uint32_t i = primitive == LMB_DRAW_QUADS ? 2 * n : n,
                   at[4] = {i, i + 1, primitive == LMB_DRAW_QUADS ? i + 2 : i + 3,
                            primitive == LMB_DRAW_QUADS ? i + 3 : i + 2};
    return pass->fills != 0 && (n & 1u) == 0 && lmb_draw_quick_rectangle(pass, at, i + 3);
}
#endif

static void list_fan_triangle(const lmb_draw_pass *pass, int is_polygon, uint32_t i, uint32_t count)
{
    const int sides = 2 | (i == 2) | (i + 1 == count) << 2 | SIDES_CHOSEN;
    if (!is_polygon) {
        *pass->dashed = 0;
    }
    list_triangle(pass, 0, i - 1, i, is_polygon ? 0 : i, is_polygon ? sides : SIDES_ALL);
}

static void list_triangles(const lmb_draw_pass *pass, uint32_t count)
{
    for (uint32_t i = 2; i < count; i += 3) {
        i = DRAW_FULL && pass->few != NULL ? lmb_draw_quick_run(pass, i, count) : i;
        if (i < count) {
            *pass->dashed = 0;
            list_draw(pass, i - 2, i - 1, i, i, 3, SIDES_ALL | SIDES_CHOSEN);
        }
    }
}

/* Draws triangle n of a strip, a fan or a polygon, or a quad from triangle n on. Returns the number of the next one. */
static uint32_t list_other(const lmb_draw_pass *pass, int32_t primitive, uint32_t n, uint32_t count)
{
    const uint32_t i = primitive == LMB_DRAW_QUADS ? 4 * (n >> 1) + 3 : 2 * (n >> 1) + 3, odd = n & 1u;
    const uint32_t c = primitive == LMB_DRAW_QUADS ? i - 1 : i, d = primitive == LMB_DRAW_QUADS ? i : i - 1;
    switch (primitive) {
    case LMB_DRAW_TRIANGLE_STRIP:
        *pass->dashed = 0;
        list_triangle(pass, n + odd, n + 1 - odd, n + 2, n + 2, SIDES_ALL);
        return n + 1;
    case LMB_DRAW_QUADS: case LMB_DRAW_QUAD_STRIP:
        if (odd != 0) { /* a batch drew the first half */
            list_triangle(pass, i - 3, c, d, i, 6);
            return n + 1;
        }
        list_quad(pass, i - 3, i - 2, c, d, i, primitive == LMB_DRAW_QUADS ? SIDES_CHOSEN : 0);
        return n + 2;
    default:
        list_fan_triangle(pass, primitive == LMB_DRAW_POLYGON, n + 2, count);
        return n + 1;
    }
}

#if LMB_DRAW_LANES
/* Draws small triangles in batches from triangle n on. Returns the first that needs another path, or `past`. */
static uint32_t list_small(const lmb_draw_pass *pass, int32_t primitive, uint32_t n, uint32_t past)
{
    const int quads = primitive == LMB_DRAW_QUADS || primitive == LMB_DRAW_QUAD_STRIP;
    while (n < past && pass->few != NULL && (pass->draws & DRAW_SMALLS) != 0 && n >= pass->now->small_from) {
        if (!quads || !list_rectangle(pass, primitive, n)) {
            return lmb_draw_quick_others(pass, primitive, n, past);
        }
        n += 2;
    }
    return n;
}
#else
static uint32_t list_small(const lmb_draw_pass *pass, int32_t primitive, uint32_t n, uint32_t past)
{
    (void)pass;
    (void)primitive;
    (void)past;
    return n;
}
#endif

/* Strips, fans, polygons and quads of `count` places in the list: small triangles in batches; others, and some after
 * each of them, one by one. */
static void list_others(const lmb_draw_pass *pass, int32_t primitive, uint32_t count)
{
    const uint32_t sides = count < 2 ? 0 : count - 2,
                   past = primitive == LMB_DRAW_QUADS        ? count / 4 * 2
                          : primitive == LMB_DRAW_QUAD_STRIP ? sides / 2 * 2
                                                             : sides;
    uint32_t n = 0;
    while ((n = list_small(pass, primitive, n, past)) < past) {
        n = list_other(pass, primitive, n, count);
    }
}

static void list_lines(const lmb_draw_pass *pass, int32_t primitive, uint32_t count)
{
    for (uint32_t i = 1; i < count; i += primitive == LMB_DRAW_LINES ? 2 : 1) {
        if (primitive == LMB_DRAW_LINES) {
            *pass->dashed = 0;
        }
        list_line(pass, i - 1, i);
    }
    if (primitive == LMB_DRAW_LINE_LOOP && count >= 2) {
        list_line(pass, count - 1, 0);
    }
}

static void list_points(const lmb_draw_pass *pass, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i) {
        list_draw(pass, i, i, i, i, 1, 0);
    }
}

/* --- the call ----------------------------------------------------------------------------------------------------- */

static lmb_status list_check_indices(const lmb_draw_indices *x)
{
    if (x == NULL) {
        return LMB_OK;
    }
    if (x->format > LMB_DRAW_INDEX_U8) {
        return LMB_ERR_FORMAT;
    }
    if ((x->format != LMB_INDEX_NONE && x->data == NULL && x->count > 0) || x->count > UINT32_MAX - 4) {
        return LMB_ERR_ARG;
    }
    const size_t bytes = x->format == LMB_INDEX_U32 ? 4 : x->format == LMB_INDEX_U16 ? 2 : 1;
    return (uintptr_t)x->data % bytes == 0 ? LMB_OK : LMB_ERR_ALIGN;
}

static void list_keep(lmb_draw_pass *pass, int32_t x, int32_t y, int32_t width, int32_t height)
{
    pass->x0 = maxi(pass->x0, x);
    pass->y0 = maxi(pass->y0, y);
    pass->x1 = mini(pass->x1, x + width - 1);
    pass->y1 = mini(pass->y1, y + height - 1);
}

static void list_set_window(lmb_draw_pass *pass)
{
    const lmb_draw_target *t = pass->target;
    const lmb_draw_state *s = pass->state;
    const lmb_surface *any = t->colour.data != NULL ? &t->colour : &t->depth;
    pass->x0 = t->x0;
    pass->y0 = t->y0;
    pass->x1 = t->x0 + any->width - 1;
    pass->y1 = t->y0 + any->height - 1;
    list_keep(pass, s->viewport[0], s->viewport[1], s->viewport[2], s->viewport[3]);
    if ((s->flags & LMB_DRAW_SCISSOR) != 0) {
        list_keep(pass, s->scissor[0], s->scissor[1], s->scissor[2], s->scissor[3]);
    }
}

static void list_set_pass(lmb_draw_pass *pass)
{
    const lmb_draw_target *t = pass->target;
    const lmb_draw_state *s = pass->state;
    list_set_window(pass);
    pass->middle_x = s->viewport[0] * 256 + s->viewport[2] * 128;
    pass->middle_y = s->viewport[1] * 256 + s->viewport[3] * 128;
    pass->snap_x = (float)(s->viewport[2] * 128);
    pass->snap_y = (float)(s->viewport[3] * 128);
    pass->guard_x = LIST_GUARD_PX * 2.0f / (float)s->viewport[2];
    pass->guard_y = LIST_GUARD_PX * 2.0f / (float)s->viewport[3];
    pass->depth_scale = pass->depth_bias = 0.0f;
    if (t->depth.data != NULL && t->depth.format == LMB_DEPTH16) {
        pass->depth_scale = 65534.0f / (1.0f - t->depth_far);
        pass->depth_bias = 1.0f - t->depth_far * pass->depth_scale;
    }
    pass->paints_first = (s->flags & LMB_DRAW_ALPHA_TEST) != 0 ||
                         (DRAW_FULL && s->shader != NULL && (s->flags & LMB_DRAW_DISCARDS) != 0);
    pass->tests = (s->flags & (LMB_DRAW_DEPTH_TEST | LMB_DRAW_STENCIL)) != 0;
    pass->shows = t->colour.data != NULL && s->colour_mask != 0;
}

static lmb_status list_check(const lmb_draw_target *target, const lmb_draw_state *state,
                             const lmb_draw_vertices *vertices, int32_t primitive, const lmb_draw_indices *indices)
{
    if (target == NULL || state == NULL || vertices == NULL || primitive < LMB_DRAW_TRIANGLES ||
        primitive > LMB_DRAW_POLYGON || (!DRAW_FULL && primitive >= LMB_DRAW_LINES && primitive <= LMB_DRAW_POINTS)) {
        return LMB_ERR_ARG;
    }
    lmb_status status = lmb_draw_check_target(target);
    status = status != LMB_OK ? status : lmb_draw_check_state(state, target);
    status = status != LMB_OK ? status : lmb_draw_check_vertices(vertices);
    return status != LMB_OK ? status : list_check_indices(indices);
}

lmb_status lmb_draw_list(const lmb_draw_target *target, const lmb_draw_state *state, const lmb_draw_vertices *vertices,
                         int32_t primitive, const lmb_draw_indices *indices, lmb_stats *stats)
{
    const lmb_status status = list_check(target, state, vertices, primitive, indices);
    uint32_t dashed = 0;
    draw_primitive now = {{0, 0, 0}, 0, 0, 0};
    lmb_draw_pass pass;
    draw_vertex few[DRAW_FEW];
    if (status != LMB_OK) {
        return status;
    }
    memset(&pass, 0, sizeof pass);
    pass.target = target;
    pass.state = state;
    pass.vertices = vertices;
    pass.indices = indices;
    pass.stats = stats;
    pass.dashed = &dashed;
    pass.now = &now;
    list_set_pass(&pass);
    if (DRAW_FULL) {
        lmb_draw_rows_begin(&pass);
    }
    if (DRAW_FULL && primitive < LMB_DRAW_LINES) {
        lmb_draw_quick_begin(&pass, few);
    }
#if LMB_DRAW_LANES
    if (primitive >= LMB_DRAW_LINES && primitive <= LMB_DRAW_LINE_LOOP) {
        lmb_draw_lines_begin(&pass);
    }
#endif
    const uint32_t count = indices != NULL ? indices->count : vertices->count;
    if (DRAW_FULL && primitive == LMB_DRAW_POINTS) {
        list_points(&pass, count);
    } else if (DRAW_FULL && primitive >= LMB_DRAW_LINES && primitive <= LMB_DRAW_LINE_LOOP) {
        list_lines(&pass, primitive, count);
    } else if (primitive == LMB_DRAW_TRIANGLES) {
        list_triangles(&pass, count);
    } else {
        list_others(&pass, primitive, count);
    }
    return LMB_OK;
}
#endif
