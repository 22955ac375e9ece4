/* draw_quick.c: triangles that are neither clipped nor large: corners are cached, edges fit 32 bits. Layer 4.
 *
 * Most triangles of a mesh cover a few pixels or none, so corners dominate the cost. A repeated corner is not
 * transformed again, and colours and shares are not read before a pixel passes the tests. The arithmetic is that of
 * draw_list.c, draw_shape.c and setup.c, value by value. */
#include "draw_part.h"

#include <string.h>

#include "../base/vertex.h"
#include "../raster/setup.h"

#if LMB_DRAW
enum { QUICK_24_8 = 16 * 256 /* largest side of the box of small triangles */ };
enum { QUICK_AHEAD = 24 /* indices */, QUICK_KNOWN = 16 /* more take too much stack beside a kernel's vectors */,
       QUICK_QUEUE = 6 /* triangles */, QUICK_REST = 8, /* triangles after one that no batch can draw; */
       QUICK_MOST_REST = 128 /* at most, as the rest doubles each time that fewer were drawn before */ };
#define QUICK_ABSURD  1e30f
#define QUICK_LEAST_W 1e-12f /* as in draw_cut.c */

void lmb_draw_find_fog(lmb_draw_pass *pass)
{
    const float *axis = pass->state->fog_axis, *m = pass->state->to_clip.m;
    const int has_axis = axis[0] != 0.0f || axis[1] != 0.0f || axis[2] != 0.0f || axis[3] != 0.0f;
    pass->fog_is_w = !has_axis || (axis[0] == m[3] && axis[1] == m[7] && axis[2] == m[11] && axis[3] == m[15]);
}

void lmb_draw_quick_begin(lmb_draw_pass *pass, draw_vertex few[DRAW_FEW])
{
    const lmb_draw_state *s = pass->state;
    const lmb_draw_vertices *v = pass->vertices;
    if ((v->position_format != LMB_DRAW_F32 && v->position_format != LMB_DRAW_F32X4) || v->uv_format != LMB_DRAW_F32 ||
        s->planes != 0 || s->offset_slope != 0.0f || s->offset_units != 0.0f || s->polygon_mode[0] != LMB_DRAW_FILL ||
        s->polygon_mode[1] != LMB_DRAW_FILL || v->fogs != NULL || v->seconds != NULL || v->back_colours != NULL ||
        v->back_seconds != NULL || s->shader != NULL || s->passed != NULL) {
        return;
    }
    lmb_draw_find_fog(pass);
    for (int i = 0; i < DRAW_FEW; ++i) {
        few[i].name = 0;
    }
    pass->few = few;
    pass->draws &= pass->fog_is_w ? DRAW_AREAS | DRAW_SMALLS : DRAW_AREAS;
}

/* --- corners ------------------------------------------------------------------------------------------------------ */

/* Limits of draw_list.c: with LMB_DRAW_F32X4 only clip space has one. */
static int quick_is_place(const lmb_draw_pass *pass, const float p[4])
{
    return pass->vertices->position_format == LMB_DRAW_F32X4 || is_place(vec3(p[0], p[1], p[2]));
}

static int quick_is_absurd(float v) { return !(v > -QUICK_ABSURD && v < QUICK_ABSURD); }

/* Bits of the planes that a corner is outside of; DRAW_DROPPED if it is not finite. */
static uint32_t quick_out(const lmb_draw_pass *pass, const float p[4], const float clip[4])
{
    const float x = clip[0], y = clip[1], z = clip[2], w = clip[3];
    const float side = pass->guard_x * w, top = pass->guard_y * w;
    if (quick_is_absurd(x) || quick_is_absurd(y) || quick_is_absurd(z) || quick_is_absurd(w) ||
        quick_is_absurd(quick_fog(pass, p, w)) || !quick_is_place(pass, p)) {
        return DRAW_DROPPED;
    }
    return (uint32_t)(w - QUICK_LEAST_W < 0.0f) << DRAW_CUT_W | (uint32_t)(w - z < 0.0f) << DRAW_CUT_NEAR |
           (uint32_t)(z < 0.0f) << DRAW_CUT_FAR | (uint32_t)(side + x < 0.0f) << DRAW_CUT_LEFT |
           (uint32_t)(side - x < 0.0f) << DRAW_CUT_RIGHT | (uint32_t)(top - y < 0.0f) << DRAW_CUT_TOP |
           (uint32_t)(top + y < 0.0f) << DRAW_CUT_BOTTOM;
}

/* 1 if quick_out would return 0: enough for the usual corner. */
static int quick_is_in(const lmb_draw_pass *pass, const float p[4], const float clip[4])
{
    const float w = clip[3];
    return pass->fog_is_w && w >= 2.0f * QUICK_LEAST_W && w < 1e20f && w >= clip[2] && clip[2] >= 0.0f &&
           absf(clip[0]) <= pass->guard_x * w && absf(clip[1]) <= pass->guard_y * w && quick_is_place(pass, p);
}

/* draw_to_24_8 for values in the guard band. */
static int32_t quick_to_24_8(float v)
{
    const int32_t whole = (int32_t)v;
    return whole - ((float)whole > v);
}

static void quick_place(draw_vertex *out, const lmb_draw_pass *pass, uint32_t i)
{
    const float *m = pass->state->to_clip.m, *range = pass->state->depth_range;
    float p[4];
    quick_fetch(p, pass->vertices, i);
    const float clip[4] = {quick_row(m, p), quick_row(m + 1, p), quick_row(m + 2, p), quick_row(m + 3, p)};
    out->name = i + 1;
    out->out = quick_is_in(pass, p, clip) ? 0 : quick_out(pass, p, clip);
    if (out->out != 0) {
        return;
    }
    const float inverse = 1.0f / clip[3], d = minf(maxf(clip[2] * inverse, 0.0f), 1.0f);
    out->x = quick_to_24_8(clip[0] * inverse * pass->snap_x + 0.5f);
    out->y = quick_to_24_8(0.5f - clip[1] * inverse * pass->snap_y);
    out->d = range[0] == 0.0f && range[1] == 1.0f ? d : range[0] + (range[1] - range[0]) * d;
    out->inverse = inverse;
}

NOINLINE void quick_renew(draw_vertex *at, const lmb_draw_pass *pass, uint32_t i)
{
    quick_place(at, pass, i);
    for (int k = 0; k < LMB_DRAW_STAGES; ++k) {
        if (pass->vertices->uvs[k] != NULL && pass->state->stage[k].texture != NULL) {
            const float *uv = (const float *)pass->vertices->uvs[k] + 2 * (size_t)i;
            at->out |= is_sane(uv[0]) && is_sane(uv[1]) ? 0 : DRAW_DROPPED;
        }
    }
}

void lmb_draw_place(draw_vertex *out, const lmb_draw_pass *pass, uint32_t i) { quick_renew(out, pass, i); }

/* Vertex i, from the cache if possible. Texture coordinates must be valid too. */
static inline draw_vertex quick_corner(draw_vertex *known, uint32_t count, const lmb_draw_pass *pass, uint32_t i)
{
    draw_vertex *at = &known[i & (count - 1)];
    if (at->name != i + 1) {
        quick_renew(at, pass, i);
    }
    return *at;
}

/* --- triangles ---------------------------------------------------------------------------------------------------- */

/* Edges at pixel (x0, y0) of the box, and per px, in 32 bits. */
typedef struct quick_edges {
    int32_t e[3], ex[3], ey[3];
    int32_t x0, y0, x1, y1;
} quick_edges;

static inline void quick_set_edge(quick_edges *out, int i, const lmb_screen_vertex *a, const lmb_screen_vertex *b,
                                  int32_t x, int32_t y)
{
    const int32_t ex = a->y_24_8 - b->y_24_8, ey = b->x_24_8 - a->x_24_8;
    const int32_t rule = ex > 0 || (ex == 0 && ey > 0) ? 0 : 1;
    out->e[i] = (ex * (x - a->x_24_8) + ey * (y - a->y_24_8) - rule) >> 8;
    out->ex[i] = ex;
    out->ey[i] = ey;
}

static inline void quick_set_edges(quick_edges *out, const lmb_draw_pass *pass, const lmb_screen_vertex at[3])
{
    const int32_t x = out->x0 * 256 + 128 - pass->middle_x, y = out->y0 * 256 + 128 - pass->middle_y;
    quick_set_edge(out, 0, &at[0], &at[1], x, y);
    quick_set_edge(out, 1, &at[1], &at[2], x, y);
    quick_set_edge(out, 2, &at[2], &at[0], x, y);
}

/* The pixels of the box in the tile at (x, y) that are inside all edges. */
static uint64_t quick_covered(const quick_edges *s, int32_t x, int32_t y)
{
    const int32_t x0 = maxi(s->x0, x), x1 = mini(s->x1, x + LMB_TILE - 1);
    const int32_t y0 = maxi(s->y0, y), y1 = mini(s->y1, y + LMB_TILE - 1);
    const int32_t right = x0 - s->x0, down = y0 - s->y0;
    int32_t a = s->e[0] + s->ex[0] * right + s->ey[0] * down, b = s->e[1] + s->ex[1] * right + s->ey[1] * down,
            c = s->e[2] + s->ex[2] * right + s->ey[2] * down;
    uint64_t mask = 0;
    for (int32_t j = y0; j <= y1; ++j, a += s->ey[0], b += s->ey[1], c += s->ey[2]) {
        int32_t p = a, q = b, r = c;
        uint32_t row = 0;
        for (int32_t i = x0; i <= x1; ++i, p += s->ex[0], q += s->ex[1], r += s->ex[2]) {
            row |= (uint32_t)((p | q | r) >= 0) << (i & 7);
        }
        mask |= (uint64_t)row << ((j & 7) * LMB_TILE);
    }
    return mask;
}

static void quick_set_depth(lmb_draw_shape *s, const lmb_screen_vertex at[3], double by_area)
{
    const lmb_screen_vertex *a = &at[0], *b = &at[1], *c = &at[2];
    const double bx = b->x_24_8 - a->x_24_8, by = b->y_24_8 - a->y_24_8, cx = c->x_24_8 - a->x_24_8,
                 cy = c->y_24_8 - a->y_24_8;
    const double bd = (double)b->d - (double)a->d, cd = (double)c->d - (double)a->d;
    const double per_px = 256.0 * by_area; /* exactly 256 / area, rounded */
    s->d.x = (bd * cy - cd * by) * per_px;
    s->d.y = (cd * bx - bd * cx) * per_px;
    s->d.origin = (double)a->d - s->d.x * (a->x_24_8 * (1.0 / 256.0)) - s->d.y * (a->y_24_8 * (1.0 / 256.0));
    s->d_min = minf(a->d, minf(b->d, c->d));
    s->d_max = maxf(a->d, maxf(b->d, c->d));
    s->d_add = 0.0f;
}

static void quick_begin_shape(lmb_draw_shape *out, lmb_draw_late *late, int64_t area)
{
    late->by_area = 1.0 / (double)area;
    out->late = late;
    out->corners = 3;
    out->is_cut = 0;
    for (int i = 0; i < 3; ++i) {
        out->corner[i] = &late->corner[i];
    }
    quick_set_depth(out, late->at, late->by_area);
}

/* Bit i of a row: 1 if pixel i is inside. */
#define QUICK_BIT(i) ((~(uint32_t)((a + ex0 * (i)) | (b + ex1 * (i)) | (c + ex2 * (i))) >> 31) << (i))

/* The pixels of a box of at most 8 x 8, with bit 0 as the first one. Four at a time, because processors mispredict the
 * end of a loop over the width of the box. */
static inline uint64_t quick_covered_box(const quick_edges *s)
{
    const int32_t wide = s->x1 - s->x0, ex0 = s->ex[0], ex1 = s->ex[1], ex2 = s->ex[2];
    int32_t a = s->e[0], b = s->e[1], c = s->e[2];
    uint64_t mask = 0;
    for (int32_t j = 0; j <= s->y1 - s->y0; ++j) {
        uint32_t row = QUICK_BIT(0) | QUICK_BIT(1) | QUICK_BIT(2) | QUICK_BIT(3);
        if (wide > 3) {
            row |= QUICK_BIT(4) | QUICK_BIT(5) | QUICK_BIT(6) | QUICK_BIT(7);
        }
        mask |= (uint64_t)row << (LMB_TILE * j);
        a += s->ey[0], b += s->ey[1], c += s->ey[2];
    }
    return mask & (uint64_t)(0xffu >> (7 - wide)) * UINT64_C(0x0101010101010101);
}

/* Fills a box of at most 8 x 8 pixels, in one to four tiles. */
static void quick_fill_box(const lmb_draw_pass *pass, lmb_draw_late *late, int64_t area, const quick_edges *edges)
{
    const uint64_t mask = quick_covered_box(edges);
    const int32_t x = edges->x0 & ~7, y = edges->y0 & ~7, right = edges->x0 & 7, down = LMB_TILE * (edges->y0 & 7);
    const uint64_t near_columns = (uint64_t)(0xffu >> right) * UINT64_C(0x0101010101010101);
    const uint64_t left = (mask & near_columns) << right,
                   other = right != 0 ? (mask & ~near_columns) >> (8 - right) : 0;
    lmb_draw_shape shape;
    if (mask == 0) {
        return;
    }
    quick_begin_shape(&shape, late, area);
    if (left << down != 0) {
        lmb_draw_tile(pass, &shape, x, y, left << down);
    }
    if (other << down != 0) {
        lmb_draw_tile(pass, &shape, x + LMB_TILE, y, other << down);
    }
    if (down == 0) {
        return;
    }
    if (left >> (64 - down) != 0) {
        lmb_draw_tile(pass, &shape, x, y + LMB_TILE, left >> (64 - down));
    }
    if (other >> (64 - down) != 0) {
        lmb_draw_tile(pass, &shape, x + LMB_TILE, y + LMB_TILE, other >> (64 - down));
    }
}

#if LMB_DRAW_LANES
/* Draws the triangle by one kernel, if possible. */
NOINLINE int quick_area(const lmb_draw_pass *pass, lmb_draw_shape *shape, const quick_edges *edges)
{
    const int32_t box[4] = {edges->x0, edges->y0, edges->x1, edges->y1};
    draw_edge edge[3];
    for (int i = 0; i < 3; ++i) {
        edge[i].at = edges->e[i] - edges->ex[i] * (edges->x0 & 7) - edges->ey[i] * (edges->y0 & 7);
        edge[i].x = edges->ex[i];
        edge[i].y = edges->ey[i];
    }
    return lmb_draw_rows_area(pass, shape, edge, box);
}
#endif

/* Fills tiles in rows, as the general path does. */
static void quick_fill(const lmb_draw_pass *pass, lmb_draw_late *late, int64_t area, const quick_edges *edges)
{
    lmb_draw_shape shape;
    quick_begin_shape(&shape, late, area);
#if LMB_DRAW_LANES
    if ((pass->draws & DRAW_AREAS) != 0 && quick_area(pass, &shape, edges)) {
        return;
    }
#endif
    for (int32_t y = edges->y0 & ~7; y <= edges->y1; y += LMB_TILE) {
        for (int32_t x = edges->x0 & ~7; x <= edges->x1; x += LMB_TILE) {
            const uint64_t mask = quick_covered(edges, x, y);
            if (mask != 0) {
                lmb_draw_tile(pass, &shape, x, y, mask);
            }
        }
    }
}

static void quick_set_corner(lmb_draw_late *late, int i, const draw_vertex *c)
{
    late->at[i].x_24_8 = c->x;
    late->at[i].y_24_8 = c->y;
    late->at[i].d = c->d;
    late->inverse[i] = c->inverse;
    late->vertex[i] = c->name - 1;
}

/* Prefetches the depths of a tile. */
MESH_HINT void quick_ask_depth(const lmb_draw_pass *pass, int32_t x, int32_t y)
{
    const lmb_surface *s = &pass->target->depth;
    if (pass->tests_rows && s->layout == LMB_TILED) {
        const int32_t column = (x - pass->target->x0) >> 3, row = (y - pass->target->y0) >> 3;
        MESH_SOON((const uint8_t *)s->data + (ptrdiff_t)row * s->stride_bytes +
                  (ptrdiff_t)column * LMB_TILE_PIXELS * 4 + (y & 7) * LMB_TILE * 4);
    }
}

/* Returns 1 if something may show, 0 if not, and -1 if it needs the general path. */
static int quick_draw(const lmb_draw_pass *pass, const draw_vertex *a, const draw_vertex *b, const draw_vertex *c,
                      uint32_t flat)
{
    const lmb_draw_state *s = pass->state;
    const int32_t x_min = mini(a->x, mini(b->x, c->x)), x_max = maxi(a->x, maxi(b->x, c->x));
    const int32_t y_min = mini(a->y, mini(b->y, c->y)), y_max = maxi(a->y, maxi(b->y, c->y));
    const int32_t x = 128 - pass->middle_x, y = 128 - pass->middle_y;
    quick_edges edges;
    lmb_draw_late late;
    const int64_t area = (int64_t)(b->x - a->x) * (c->y - a->y) - (int64_t)(c->x - a->x) * (b->y - a->y);
    const int back = area > 0, front = (s->flags & LMB_DRAW_CLOCKWISE) != 0 ? back : !back;
    edges.x0 = maxi((x_min - x + 255) >> 8, pass->x0);
    edges.x1 = mini((x_max - x) >> 8, pass->x1);
    edges.y0 = maxi((y_min - y + 255) >> 8, pass->y0);
    edges.y1 = mini((y_max - y) >> 8, pass->y1);
    if (edges.x0 > edges.x1 || edges.y0 > edges.y1 || area == 0 ||
        (s->flags & (front ? LMB_DRAW_CULL_FRONT : LMB_DRAW_CULL_BACK)) != 0) {
        return 0;
    }
    if (x_max - x_min >= QUICK_24_8 || y_max - y_min >= QUICK_24_8) {
        return -1;
    }
    quick_ask_depth(pass, edges.x0, edges.y0);
    quick_set_corner(&late, 0, a);
    quick_set_corner(&late, back ? 1 : 2, b);
    quick_set_corner(&late, back ? 2 : 1, c);
    late.flat = flat;
    quick_set_edges(&edges, pass, late.at);
    if (edges.x1 - edges.x0 < LMB_TILE && edges.y1 - edges.y0 < LMB_TILE) {
        quick_fill_box(pass, &late, back ? area : -area, &edges);
    } else {
        quick_fill(pass, &late, back ? area : -area, &edges);
    }
    return 1;
}

/* Prefetches the depths and colours around a corner, in linear targets. */
MESH_HINT void quick_ask_pixels(const lmb_draw_pass *pass, const draw_vertex *at)
{
    const lmb_draw_target *t = pass->target;
    if (at->out != 0) { /* a corner outside the guard band has no place */
        return;
    }
    const int32_t x = (at->x + pass->middle_x) >> 8, y = (at->y + pass->middle_y) >> 8;
    if (x < pass->x0 || x > pass->x1 || y <= pass->y0 || y > pass->y1) {
        return;
    }
    if (pass->tests_rows && t->depth.layout == LMB_LINEAR) {
        const uint8_t *row = (const uint8_t *)t->depth.data + (ptrdiff_t)(y - t->y0) * t->depth.stride_bytes;
        MESH_SOON(row + (ptrdiff_t)(x - t->x0) * 4);
        MESH_SOON(row + (ptrdiff_t)(x - t->x0) * 4 - t->depth.stride_bytes);
    }
    if (pass->paints_rows) { /* four bytes a pixel */
        const uint8_t *row = (const uint8_t *)t->colour.data + (ptrdiff_t)(y - t->y0) * t->colour.stride_bytes;
        MESH_SOON(row + (ptrdiff_t)(x - t->x0) * 4);
        MESH_SOON(row + (ptrdiff_t)(x - t->x0) * 4 - t->colour.stride_bytes);
    }
}

/* Prefetches the positions of corners of a later triangle. */
MESH_HINT void quick_ask(const lmb_draw_pass *pass, uint32_t n)
{
    const lmb_draw_indices *x = pass->indices;
    if (x != NULL && x->format == LMB_INDEX_U32 && n < x->count) {
        const uint32_t i = ((const uint32_t *)x->data)[n];
        const size_t bytes = pass->vertices->position_format == LMB_DRAW_F32X4 ? 16 : 12;
        MESH_SOON((const void *)((uintptr_t)pass->vertices->positions + (size_t)i * bytes)); /* not checked yet */
    }
}

/* Draws a triangle of placed corners; 0 if it needs the general path. */
static inline int quick_placed(const lmb_draw_pass *pass, const draw_vertex *p, const draw_vertex *q,
                               const draw_vertex *r, uint32_t flat)
{
    int drawn = 0;
    if (((p->out | q->out | r->out) & DRAW_DROPPED) != 0) {
        return 0;
    }
    if ((p->out & q->out & r->out) == 0) {
        drawn = (p->out | q->out | r->out) == 0 ? quick_draw(pass, p, q, r, flat) : -1;
    }
    if (drawn < 0) {
        return 0;
    }
    if (pass->stats != NULL) {
        ++pass->stats->triangles;
        pass->stats->triangles_drawn += (uint32_t)drawn;
    }
    return 1;
}

/* known: a cache of `size` corners, a power of two. */
static inline int quick_triangle(const lmb_draw_pass *pass, draw_vertex *known, uint32_t size, const uint32_t order[3],
                                 uint32_t flat)
{
    const uint32_t count = pass->vertices->count;
    const uint32_t i = draw_index(pass, order[0]), j = draw_index(pass, order[1]), k = draw_index(pass, order[2]),
                   last = flat == order[2] ? k : draw_index(pass, flat);
    if (i >= count || j >= count || k >= count || last >= count) {
        return 0;
    }
    const draw_vertex p = quick_corner(known, size, pass, i), q = quick_corner(known, size, pass, j),
                      r = quick_corner(known, size, pass, k);
    return quick_placed(pass, &p, &q, &r, last);
}

int lmb_draw_quick(const lmb_draw_pass *pass, uint32_t a, uint32_t b, uint32_t c, uint32_t flat)
{
    const uint32_t order[3] = {a, b, c};
    return quick_triangle(pass, pass->few, DRAW_FEW, order, flat);
}

/* Triangles without indices share no corners. Several are placed first: their pixels arrive in the cache meanwhile. */
NOINLINE uint32_t quick_stream(const lmb_draw_pass *pass, uint32_t i, uint32_t count)
{
    draw_vertex corner[3 * QUICK_QUEUE];
    while (i < count) {
        const uint32_t left = (count - i + 2) / 3, n = left < QUICK_QUEUE ? left : QUICK_QUEUE;
        for (uint32_t k = 0; k < 3 * n; ++k) {
            quick_renew(&corner[k], pass, i - 2 + k);
            if (k % 3 == 0) {
                quick_ask_pixels(pass, &corner[k]);
            }
        }
        for (uint32_t k = 0; k < n; ++k, i += 3) {
            if (!quick_placed(pass, &corner[3 * k], &corner[3 * k + 1], &corner[3 * k + 2], i)) {
                return i;
            }
        }
    }
    return i;
}

#if LMB_DRAW_LANES
static void quick_set_small(lmb_draw_small *b, const lmb_draw_pass *pass)
{
    const lmb_draw_target *t = pass->target;
    b->state = pass->state;
    b->positions = (const float *)pass->vertices->positions;
    b->floats = pass->vertices->position_format == LMB_DRAW_F32X4 ? 4 : 3;
    b->colours = pass->vertices->colours;
    b->uvs = pass->state->stage[0].texture != NULL ? (const float *)pass->vertices->uvs[0] : NULL;
    b->middle_x = pass->middle_x;
    b->middle_y = pass->middle_y;
    b->snap_x = pass->snap_x;
    b->snap_y = pass->snap_y;
    b->guard_x = pass->guard_x;
    b->guard_y = pass->guard_y;
    b->x0 = pass->x0;
    b->y0 = pass->y0;
    b->x1 = pass->x1;
    b->y1 = pass->y1;
    b->right = mini(pass->x1 | 7, t->x0 + t->colour.width - 1);
    b->target_x = t->x0;
    b->target_y = t->y0;
    b->depth = pass->tests ? (float *)t->depth.data : NULL;
    b->colour = (uint8_t *)t->colour.data;
    b->depth_step = t->depth.stride_bytes / 4;
    b->colour_stride = t->colour.stride_bytes;
    b->swaps = t->colour.format == LMB_BGRA8;
    b->drawn = 0;
}

/* Draws the batch. Returns how many triangles come before the first that needs another path. */
static inline uint32_t quick_batch(const lmb_draw_pass *pass, lmb_draw_small *b)
{
    for (uint32_t k = b->count; k < LMB_DRAW_SMALLS; ++k) {
        for (int i = 0; i < 4; ++i) {
            b->at[i][k] = b->at[i][0];
        }
    }
    return pass->state->kernels->draw_small(b);
}

/* Counts triangles that a batch drew. */
static void quick_count_small(const lmb_draw_pass *pass, const lmb_draw_small *b, uint32_t triangles)
{
    if (pass->stats != NULL) {
        pass->stats->triangles += triangles;
        pass->stats->triangles_drawn += b->drawn;
    }
}

/* Triangle n needs another path; batches drew `drawn` before it. Sets the triangle from which a batch is tried. */
static void quick_set_rest(const lmb_draw_pass *pass, uint32_t n, uint32_t drawn)
{
    draw_primitive *now = pass->now;
    const int32_t rest = (int32_t)now->rest;
    now->rest = (uint32_t)(drawn >= now->rest ? QUICK_REST : mini(2 * rest, QUICK_MOST_REST));
    now->small_from = n + now->rest;
}

/* Draws small triangles by the state's kernels. Returns the first that needs another path. */
NOINLINE uint32_t quick_small(const lmb_draw_pass *pass, uint32_t i, uint32_t count)
{
    const uint32_t first = i;
    lmb_draw_small b;
    quick_set_small(&b, pass);
    while (i < count) {
        const uint32_t left = (count - i + 2) / 3;
        b.count = left < LMB_DRAW_SMALLS ? left : LMB_DRAW_SMALLS;
        for (uint32_t k = 0; k < b.count; ++k) {
            const int32_t at = (int32_t)(i - 2 + 3 * k);
            b.at[0][k] = at;
            b.at[1][k] = at + 1;
            b.at[2][k] = b.at[3][k] = at + 2;
        }
        const uint32_t done = quick_batch(pass, &b);
        i += 3 * done;
        if (done < b.count) {
            quick_set_rest(pass, (i - 2) / 3, (i - first) / 3);
            break;
        }
    }
    quick_count_small(pass, &b, ((i < count ? i : count) - first + 2) / 3);
    return i;
}

/* The places of triangle n in the list, and the place of its colour if it is flat. */
static inline void quick_places(uint32_t out[4], int32_t primitive, uint32_t n)
{
    const uint32_t quad = n >> 1, odd = n & 1u;
    switch (primitive) {
    case LMB_DRAW_TRIANGLES:
        out[0] = 3 * n, out[1] = 3 * n + 1, out[2] = out[3] = 3 * n + 2;
        break;
    case LMB_DRAW_TRIANGLE_STRIP:
        out[0] = n + odd, out[1] = n + 1 - odd, out[2] = out[3] = n + 2;
        break;
    case LMB_DRAW_QUADS:
        out[0] = 4 * quad, out[1] = 4 * quad + 1 + odd, out[2] = 4 * quad + 2 + odd, out[3] = 4 * quad + 3;
        break;
    case LMB_DRAW_QUAD_STRIP:
        out[0] = 2 * quad, out[1] = odd != 0 ? 2 * quad + 3 : 2 * quad + 1;
        out[2] = odd != 0 ? 2 * quad + 2 : 2 * quad + 3, out[3] = 2 * quad + 3;
        break;
    default:
        out[0] = 0, out[1] = n + 1, out[2] = n + 2, out[3] = primitive == LMB_DRAW_POLYGON ? 0 : n + 2;
        break;
    }
}

uint32_t lmb_draw_quick_others(const lmb_draw_pass *pass, int32_t primitive, uint32_t n, uint32_t count)
{
    const uint32_t first = n, vertices = pass->vertices->count;
    lmb_draw_small b;
    quick_set_small(&b, pass);
    for (int is_good = 1; is_good && n < count;) {
        for (b.count = 0; b.count < LMB_DRAW_SMALLS && n + b.count < count && is_good; b.count += (uint32_t)is_good) {
            uint32_t place[4];
            quick_places(place, primitive, n + b.count);
            for (int i = 0; i < 4; ++i) {
                const uint32_t at = draw_index(pass, place[i]);
                is_good &= at < vertices;
                b.at[i][b.count] = (int32_t)at;
            }
        }
        const uint32_t done = b.count != 0 ? quick_batch(pass, &b) : 0;
        is_good &= done == b.count;
        n += done;
    }
    quick_count_small(pass, &b, n - first);
    quick_set_rest(pass, n, n - first);
    return n;
}
#endif

NOINLINE uint32_t quick_indexed(const lmb_draw_pass *pass, uint32_t i, uint32_t count)
{
    draw_vertex known[QUICK_KNOWN];
    for (int k = 0; k < QUICK_KNOWN; ++k) {
        known[k].name = 0;
    }
    for (; i < count; i += 3) {
        const uint32_t order[3] = {i - 2, i - 1, i};
        quick_ask(pass, i - 2 + QUICK_AHEAD);
        quick_ask(pass, i - 1 + QUICK_AHEAD);
        quick_ask(pass, i + QUICK_AHEAD);
        if (!quick_triangle(pass, known, QUICK_KNOWN, order, i)) {
            break;
        }
    }
    return i;
}

/* The list's end, or the triangle from which a batch is tried. */
static inline uint32_t quick_end(const lmb_draw_pass *pass, uint32_t count)
{
    return pass->now->small_from < count / 3 ? 3 * pass->now->small_from + 2 : count;
}

/* Small triangles in batches; others, and some after each of them, one by one. */
uint32_t lmb_draw_quick_run(const lmb_draw_pass *pass, uint32_t i, uint32_t count)
{
    const int is_indexed = pass->indices != NULL;
#if LMB_DRAW_LANES
    while ((pass->draws & DRAW_SMALLS) != 0 && i < count) {
        if (i >= quick_end(pass, count)) {
            i = is_indexed ? 3 * lmb_draw_quick_others(pass, LMB_DRAW_TRIANGLES, (i - 2) / 3, count / 3) + 2
                           : quick_small(pass, i, count);
        }
        if (i < count) {
            const uint32_t end = quick_end(pass, count);
            i = is_indexed ? quick_indexed(pass, i, end) : quick_stream(pass, i, end);
            if (i < end) {
                return i;
            }
        }
    }
#endif
    return is_indexed ? quick_indexed(pass, i, count) : quick_stream(pass, i, count);
}

/* --- rectangles --------------------------------------------------------------------------------------------------- */

/* 1 if four corners in order are an upright rectangle. */
static int quick_is_upright(const draw_vertex v[4])
{
    const int is_down = v[0].x == v[1].x; /* the first side is a column */
    const draw_vertex *down = is_down ? &v[1] : &v[3], *across = is_down ? &v[3] : &v[1];
    return v[0].x == down->x && v[2].x == across->x && v[0].y == across->y && v[2].y == down->y;
}

/* The colour of all corners, or NULL if they differ. */
static const uint8_t *quick_colour(const lmb_draw_pass *pass, const draw_vertex v[4], uint32_t last)
{
    const uint8_t *all = pass->vertices->colours;
    const int is_flat = (pass->state->flags & LMB_DRAW_FLAT) != 0;
    if (all == NULL) {
        return pass->state->colour;
    }
    const uint8_t *first = all + 4 * (size_t)(is_flat ? last : v[0].name - 1);
    for (int k = 1; k < 4 && !is_flat; ++k) {
        if (memcmp(all + 4 * (size_t)(v[k].name - 1), first, 4) != 0) {
            return NULL;
        }
    }
    return first;
}

#if LMB_DRAW_LANES
/* Sets a half of the rectangle: corners 0, i and i + 1. */
static void quick_set_half(lmb_draw_shape *shape, lmb_draw_late *late, const lmb_draw_pass *pass,
                           const draw_vertex v[4], int i, uint32_t flat)
{
    const int64_t area =
        (int64_t)(v[i].x - v[0].x) * (v[i + 1].y - v[0].y) - (int64_t)(v[i + 1].x - v[0].x) * (v[i].y - v[0].y);
    quick_set_corner(late, 0, &v[0]);
    quick_set_corner(late, area > 0 ? 1 : 2, &v[i]);
    quick_set_corner(late, area > 0 ? 2 : 1, &v[i + 1]);
    late->flat = flat;
    quick_begin_shape(shape, late, area > 0 ? area : -area);
    lmb_draw_finish(pass, shape);
}

/* The edge from a to b. */
static void quick_set_diagonal(draw_edge *out, const lmb_draw_pass *pass, const draw_vertex *a, const draw_vertex *b)
{
    const int64_t ex = a->y - b->y, ey = b->x - a->x, rule = ex > 0 || (ex == 0 && ey > 0) ? 0 : 1;
    out->at = (ex * (128 - pass->middle_x - a->x) + ey * (128 - pass->middle_y - a->y) - rule) >> 8;
    out->x = (int32_t)ex;
    out->y = (int32_t)ey;
}

/* The pixels of a tile. */
static void quick_sheet_tile(const lmb_draw_pass *pass, lmb_draw_shape half[2], const draw_edge *edge,
                            const int32_t box[4], int32_t x, int32_t y)
{
    uint64_t mask[2] = {0, 0};
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + (k & 7), py = y + (k >> 3);
        if (px >= box[0] && py >= box[1] && px <= box[2] && py <= box[3]) {
            mask[edge->at + (int64_t)edge->x * px + (int64_t)edge->y * py < 0] |= (uint64_t)1 << k;
        }
    }
    for (int i = 0; i < 2; ++i) {
        if (mask[i] != 0) {
            lmb_draw_tile(pass, &half[i], x, y, mask[i]);
        }
    }
}

/* The pixels of the box: the first half inside the edge that both share, the second outside. */
static void quick_sheet(const lmb_draw_pass *pass, lmb_draw_shape half[2], const draw_edge *edge, const int32_t box[4])
{
    const lmb_draw_target *t = pass->target;
    const int32_t past_x = t->x0 + (t->colour.width & ~7), past_y = t->y0 + (t->colour.height & ~7);
    const int32_t whole[4] = {box[0], box[1], mini(box[2], past_x - 1), mini(box[3], past_y - 1)};
    if (whole[0] <= whole[2] && whole[1] <= whole[3]) {
        lmb_draw_rows_sheet(pass, half, edge, whole);
    }
    for (int32_t y = box[1] & ~7; y <= box[3]; y += LMB_TILE) { /* tiles that the target cuts off */
        for (int32_t x = y < past_y ? maxi(box[0] & ~7, past_x) : box[0] & ~7; x <= box[2]; x += LMB_TILE) {
            quick_sheet_tile(pass, half, edge, box, x, y);
        }
    }
}

/* The two triangles of a rectangle by the state's kernels. */
NOINLINE void quick_fill_halves(const lmb_draw_pass *pass, const draw_vertex v[4], uint32_t flat, const int32_t box[4])
{
    lmb_draw_late late[2];
    lmb_draw_shape half[2];
    draw_edge edge;
    quick_set_half(&half[0], &late[0], pass, v, 1, flat);
    quick_set_half(&half[1], &late[1], pass, v, 2, flat);
    quick_set_diagonal(&edge, pass, late[0].vertex[1] == v[1].name - 1 ? &v[2] : &v[0],
                       late[0].vertex[1] == v[1].name - 1 ? &v[0] : &v[2]);
    quick_sheet(pass, half, &edge, box);
}
#endif

/* The two triangles of a rectangle share all pixels of its box out among them, by the top-left rule. */
int lmb_draw_quick_rectangle(const lmb_draw_pass *pass, const uint32_t at[4], uint32_t flat)
{
    const uint32_t count = pass->vertices->count, last = draw_index(pass, flat);
    draw_vertex v[4];
    for (int k = 0; k < 4; ++k) {
        const uint32_t i = draw_index(pass, at[k]);
        if (i >= count || last >= count) {
            return 0;
        }
        v[k] = quick_corner(pass->few, DRAW_FEW, pass, i);
        if (v[k].out != 0) {
            return 0;
        }
    }
    const int32_t x = 128 - pass->middle_x, y = 128 - pass->middle_y;
    const int32_t x0 = maxi((mini(v[0].x, v[2].x) - x + 255) >> 8, pass->x0),
                  x1 = mini(((maxi(v[0].x, v[2].x) - x + 255) >> 8) - 1, pass->x1),
                  y0 = maxi((mini(v[0].y, v[2].y) - y + 255) >> 8, pass->y0),
                  y1 = mini(((maxi(v[0].y, v[2].y) - y + 255) >> 8) - 1, pass->y1);
    if (!quick_is_upright(v) || x0 > x1 || y0 > y1) {
        return 0;
    }
    const uint8_t *codes = (pass->fills & DRAW_FILLS_COLOUR) != 0 ? quick_colour(pass, v, last) : NULL;
    if (codes == NULL && (pass->fills & DRAW_FILLS_SHEET) == 0) {
        return 0;
    }
    if (codes != NULL) {
        lmb_draw_rows_fill(pass, codes, x0, x1, y0, y1);
    }
#if LMB_DRAW_LANES
    if (codes == NULL) {
        const int32_t box[4] = {x0, y0, x1, y1};
        quick_fill_halves(pass, v, last, box);
    }
#endif
    if (pass->stats != NULL) {
        pass->stats->triangles += 2;
        pass->stats->triangles_drawn += 2;
    }
    return 1;
}
#endif
