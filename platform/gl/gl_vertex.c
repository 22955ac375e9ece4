/* gl_vertex.c: vertices from glBegin to draw.h: they are batched, transformed, lit and assembled into primitives.
 *
 * A batch may hold independent primitives of several glBegin, until a state changes. */
#include "gl_context.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

#define OP(name) void gl_op_##name(gl_context *c, const gl_word *w)

/* --- attributes --------------------------------------------------------------------------------------------------- */

/* Sets values of the current vertex; the next one begins a look. */
static void vertex_set(gl_context *c, float *to, const gl_word *w, int n)
{
    memcpy(to, w, (size_t)n * sizeof *w);
    c->open = 0;
}

OP(colour) { vertex_set(c, c->s.current.v.colour, w, 4); }
OP(normal) { vertex_set(c, c->s.current.v.normal, w, 3); }
OP(second) { vertex_set(c, c->s.current.v.second, w, 3); }
OP(fog_coord) { vertex_set(c, &c->s.current.v.fog, w, 1); }
OP(edge) { vertex_set(c, &c->s.current.v.edge, w, 1); }
OP(tex_coord)
{
    const uint32_t unit = w[0].u - GL_TEXTURE0;
    if (unit < GL_UNITS) {
        vertex_set(c, c->s.current.v.tex[unit], w + 1, 4);
    } else if (unit >= 32) {
        gl_error(c, GL_INVALID_ENUM);
    }
}
/* s and t of the first unit. */
OP(tex_coord_2)
{
    const gl_word all[4] = {w[0], w[1], {.f = 0.0f}, {.f = 1.0f}};
    vertex_set(c, c->s.current.v.tex[0], all, 4);
}
OP(vertex)
{
    const float at[4] = {w[0].f, w[1].f, w[2].f, w[3].f};
    gl_vertex_at(c, at);
}
OP(vertex_3)
{
    const float at[4] = {w[0].f, w[1].f, w[2].f, 1.0f};
    gl_vertex_at(c, at);
}

/* --- batching ----------------------------------------------------------------------------------------------------- */

static int vertex_is_apart(GLenum p) { return p == GL_POINTS || p == GL_LINES || p == GL_TRIANGLES || p == GL_QUADS; }

static int vertex_each(GLenum p) { return p == GL_POINTS ? 1 : p == GL_LINES ? 2 : p == GL_TRIANGLES ? 3 : 4; }

OP(begin)
{
    if (c->is_inside) { /* arrays drawn between glBegin and glEnd draw nothing */
        gl_error(c, GL_INVALID_OPERATION);
        c->skips = w[1].u != 0;
        c->open = 0;
        return;
    }
    GL_FAIL(w[0].u > GL_POLYGON, GL_INVALID_ENUM, )
    const int is_static = gl_is_on(c, CAP_BOUNCED) && (c->list_depth > 0 || c->reads_static);
    const int waits = vertex_is_apart(c->primitive) ? c->orders == 0 : c->orders > 0;
    if (c->count > 0 &&
        (c->primitive != w[0].u || !waits || is_static != c->is_static || c->count == GL_BATCH)) { /* full of indices */
        gl_flush_vertices(c);
    }
    c->is_static = is_static;
    if (!gl_surface_ready(c, c->framebuffer)) {
        return;
    }
    c->is_inside = 1;
    c->primitive = w[0].u;
    c->is_continued = 0;
    c->stipple_at = 0;
    c->begin_at = c->count;
}

int gl_order_begin(gl_context *c, GLenum p)
{
    const GLenum kind = p == GL_QUADS || p == GL_QUAD_STRIP ? GL_QUADS : GL_TRIANGLES;
    if (c->count > 0 && (c->orders == 0 || c->ordered != kind || c->primitive != p || c->is_static)) {
        gl_flush_vertices(c);
    }
    c->is_static = 0;
    if (!gl_surface_ready(c, c->framebuffer)) {
        return 0;
    }
    c->primitive = p;
    c->ordered = kind;
    c->is_continued = 0;
    c->stipple_at = 0;
    c->begin_at = c->count;
    c->open = 0;
    return 1;
}

/* Puts a vertex with attributes of its own at the end of the batch. */
static void vertex_append(gl_context *c, const float at[4], const gl_vertex *look)
{
    if (c->count == 0) {
        c->looks = 0;
    }
    c->look[c->looks] = *look;
    c->look_from[c->looks++] = c->count;
    memcpy(c->at_of[c->count++], at, 4 * sizeof *at);
}

/* The look of vertex i, found from the end. */
static int32_t vertex_look(const gl_context *c, int32_t i)
{
    int32_t k = c->looks - 1;
    while (k > 0 && c->look_from[k] > i) {
        --k;
    }
    return k;
}

static gl_vertex vertex_copy(const gl_context *c, int32_t i)
{
    gl_vertex v = c->look[vertex_look(c, i)];
    memcpy(v.at, c->at_of[i], sizeof v.at);
    return v;
}

static int vertex_has_units(const gl_context *c)
{
    return gl_is_on(c, CAP_OFFSET_FILL) && c->s.polygon.units != 0.0f;
}

/* The looks of the batch's vertices from `from` on need no shader for their texture coordinates. */
static int vertex_looks_are_plain(const gl_context *c, int32_t from)
{
    const gl_matrices *s = &c->texture[0];
    const int textured = c->s.texture.unit[0].on != 0;
    if (textured && c->s.texture.unit[0].gen != 0) {
        return 0;
    }
    for (int32_t k = c->looks - 1; k >= 0 && textured; --k) {
        float t[4];
        gl_matrix_point(t, s->m[s->top], c->look[k].tex[0]);
        if (t[3] != 1.0f) {
            return 0;
        }
        if (c->look_from[k] <= from) {
            return 1;
        }
    }
    return 1;
}

static int vertex_fills(const gl_context *c)
{
    return c->s.polygon.front == GL_FILL && c->s.polygon.back == GL_FILL && c->render_mode == GL_RENDER;
}

int gl_can_order(const gl_context *c, GLenum p)
{
    return vertex_fills(c) && c->query == NULL && !vertex_has_units(c) && /* the batch decides how these are drawn */
           !gl_is_on(c, CAP_BOUNCED) && p >= GL_TRIANGLES && p <= GL_QUAD_STRIP &&
           (p != GL_QUAD_STRIP || c->s.lighting.shade != GL_FLAT); /* another vertex has a quad's flat colour */
}

/* Puts the strip, fan or quad strip of vertices `from` .. count - 1 into order_of. Returns 0 if it lacks room. */
static int vertex_order(gl_context *c, int32_t from)
{
    const GLenum mode = c->primitive;
    const uint32_t each = gl_order_each(mode), past = gl_order_past(mode, (uint32_t)(c->count - from));
    uint32_t *to = &c->order_of[c->orders];
    if ((uint32_t)c->orders + each * past > GL_ORDERS) {
        return 0;
    }
    c->ordered = each == 4 ? GL_QUADS : GL_TRIANGLES;
    for (uint32_t n = 0; n < past; ++n, to += each) {
        uint32_t place[4];
        gl_order_places(place, mode, n);
        for (uint32_t k = 0; k < each; ++k) {
            to[k] = (uint32_t)from + place[k];
        }
    }
    c->orders = (int32_t)(to - c->order_of);
    return 1;
}

/* Draws the runs before the current one, which moves to the start of the batch. */
static void vertex_move_down(gl_context *c)
{
    const int32_t from = c->begin_at, n = c->count - from, k = vertex_look(c, from), looks = c->looks - k,
                  made = maxi(c->made_count - from, 0);
    c->count = from;
    c->made_count = mini(c->made_count, from);
    c->looks = k;
    gl_flush_vertices(c);
    memmove(c->at_of, c->at_of + from, (size_t)n * sizeof c->at_of[0]);
    memmove(c->look, c->look + k, (size_t)looks * sizeof c->look[0]);
    memmove(c->made, c->made + from, (size_t)made * sizeof c->made[0]);
    for (int32_t i = 0; i < looks; ++i) {
        c->look_from[i] = maxi(c->look_from[k + i] - from, 0);
    }
    c->count = n;
    c->looks = looks;
    c->made_count = made;
    c->begin_at = 0;
}

/* Draws the full batch, and keeps the vertices that later primitives share. Those are only made if they were before, as
 * the material may have changed since. */
static void vertex_turn_over(gl_context *c)
{
    const GLenum p = c->primitive;
    if (c->begin_at > 0) {
        vertex_move_down(c);
        return;
    }
    if (vertex_is_apart(p)) {
        gl_flush_vertices(c);
        c->is_continued = 1;
        return;
    }
    const int n = c->count, first = p == GL_TRIANGLE_FAN || p == GL_POLYGON ? 0 : n - 2;
    const gl_vertex keep[2] = {first == 0 ? c->look[0] : vertex_copy(c, first), vertex_copy(c, n - 1)};
    const float from[4] = {c->at_of[first][0], c->at_of[first][1], c->at_of[first][2], c->at_of[first][3]};
    const int is_made = c->made_count > 0 || !gl_can_order(c, p);
    if (is_made) {
        gl_make_vertices(c);
    }
    const gl_made made[2] = {c->made[first], c->made[n - 1]};
    if (p == GL_LINE_LOOP && !c->is_continued) {
        c->loop_first = c->look[0];
        memcpy(c->loop_first.at, c->at_of[0], sizeof c->loop_first.at);
    }
    gl_flush_vertices(c);
    c->is_continued = 1;
    c->begin_at = 0;
    if (p != GL_LINE_STRIP && p != GL_LINE_LOOP) {
        c->made[0] = made[0];
        vertex_append(c, from, &keep[0]);
    }
    c->made[c->count] = made[1];
    vertex_append(c, keep[1].at, &keep[1]);
    c->made_count = is_made ? c->count : 0;
}

void gl_vertex_at(gl_context *c, const float at[4])
{
    if (!c->is_inside || c->skips) {
        return;
    }
    if (c->open == 0) {
        vertex_append(c, at, &c->s.current.v);
        c->open = c->list_mode == 0 ? GL_BATCH - 1 : 0;
    } else {
        memcpy(c->at_of[c->count++], at, 4 * sizeof *at);
    }
    if (c->count == GL_BATCH) {
        vertex_turn_over(c);
    }
}

void gl_vertex_of(gl_context *c, const float at[4], const gl_vertex *look)
{
    if (!c->is_inside || c->skips) {
        return;
    }
    vertex_append(c, at, look);
    if (c->count == GL_BATCH) {
        vertex_turn_over(c);
    }
}

/* Puts vertices into the batch, which has room for them. */
static void vertex_copies(float (*to)[4], const gl_word *w, int32_t count, int32_t words)
{
    if (words == 4) {
        memcpy(to, w, (size_t)count * sizeof *to);
        return;
    }
    for (int32_t i = 0; i + 1 < count; ++i, w += 3) { /* with the first word of the next one */
        memcpy(to[i], w, sizeof to[i]);
        to[i][3] = 1.0f;
    }
    memcpy(to[count - 1], w, 3 * sizeof *w);
    to[count - 1][3] = 1.0f;
}

void gl_vertices_at(gl_context *c, const gl_word *w, int32_t count, int32_t words)
{
    while (count > 0) {
        const int32_t n = c->count < c->open ? mini(count, c->open - c->count) : 1;
        if (c->count < c->open) {
            vertex_copies(&c->at_of[c->count], w, n, words);
            c->count += n;
        } else {
            const float at[4] = {w[0].f, w[1].f, w[2].f, words == 4 ? w[3].f : 1.0f};
            gl_vertex_at(c, at);
        }
        w += words * n;
        count -= n;
    }
}

/* A strip, a fan or a quad strip waits for others. Returns 0 if it cannot. */
static int vertex_end_run(gl_context *c)
{
    const int plain = vertex_looks_are_plain(c, c->begin_at);
    if (plain && vertex_order(c, c->begin_at)) {
        return 1;
    }
    if (c->begin_at > 0) {
        vertex_move_down(c);
    }
    return plain && vertex_order(c, 0);
}

/* 1: the texture coordinates of this run need a shader. Generated ones are made now, as they are needed anyway. */
static int vertex_run_is_odd(gl_context *c)
{
    int odd = 0;
    if (c->s.texture.unit[0].on == 0 || c->s.texture.unit[0].gen == 0) {
        return !vertex_looks_are_plain(c, c->begin_at);
    }
    gl_make_vertices(c);
    for (int32_t i = c->begin_at; i < c->count; ++i) {
        odd |= c->made[i].tex[0][3] != 1.0f;
    }
    return odd;
}

/* All primitives of a batch take a shader if one does: those before this run are drawn if only one of both needs it. */
static void vertex_keep_apart(gl_context *c)
{
    if (c->count == c->begin_at) {
        return;
    }
    const int odd = vertex_run_is_odd(c);
    if (c->begin_at > 0 && odd != c->is_odd) {
        vertex_move_down(c);
    }
    c->is_odd = odd;
}

OP(end)
{
    if (w != NULL && w[0].u != 0 && c->skips) {
        c->skips = 0;
        return;
    }
    GL_FAIL(!c->is_inside, GL_INVALID_OPERATION, )
    c->is_inside = 0;
    c->open = 0;
    if (vertex_is_apart(c->primitive)) {
        c->count -= (c->count - c->begin_at) % vertex_each(c->primitive);
        c->made_count = mini(c->made_count, c->count);
        while (c->looks > 0 && c->look_from[c->looks - 1] >= c->count) {
            --c->looks;
        }
        vertex_keep_apart(c);
        if (c->render_mode == GL_RENDER && c->query == NULL) {
            return;
        }
    } else if (c->primitive == GL_LINE_LOOP && c->is_continued) {
        vertex_append(c, c->loop_first.at, &c->loop_first);
        c->primitive = GL_LINE_STRIP;
    } else if (gl_can_order(c, c->primitive) && vertex_end_run(c)) {
        return;
    }
    gl_flush_vertices(c);
}

/* --- transforming ------------------------------------------------------------------------------------------------- */

static float vertex_point_size(const gl_context *c, const float eye[4])
{
    const float *a = c->s.point.attenuation;
    float size = c->s.point.size;
    if (a[0] != 1.0f || a[1] != 0.0f || a[2] != 0.0f) {
        const float d = lmb_sqrt(eye[0] * eye[0] + eye[1] * eye[1] + eye[2] * eye[2]);
        const float by = a[0] + d * (a[1] + d * a[2]);
        size = by > 0.0f ? size / lmb_sqrt(by) : c->s.point.max;
    }
    size = maxf(minf(size, c->s.point.max), c->s.point.min);
    return clampf(size, 1.0f, 255.0f);
}

static void vertex_make(gl_context *c, const float at[4], const gl_vertex *v, gl_made *m)
{
    gl_matrix_point(m->eye, c->modelview.m[c->modelview.top], at);
    gl_matrix_point(m->clip, c->projection.m[c->projection.top], m->eye);
    if (gl_is_on(c, CAP_LIGHTING)) {
        gl_light_vertex(c, v, m);
    } else {
        for (int i = 0; i < 4; ++i) {
            m->colour[0][i] = gl_unit_range(v->colour[i]);
        }
        for (int i = 0; i < 3; ++i) {
            m->second[0][i] = gl_is_on(c, CAP_COLOR_SUM) ? gl_unit_range(v->second[i]) : 0.0f;
        }
    }
    m->fog = c->s.fog.source == GL_FOG_COORD ? v->fog : absf(m->eye[2]);
    m->size = c->primitive == GL_POINTS || c->s.polygon.front == GL_POINT || c->s.polygon.back == GL_POINT
                  ? vertex_point_size(c, m->eye) : 1.0f;
    m->edge = v->edge;
    gl_gen_vertex(c, at, v, m);
}

void gl_make_vertices(gl_context *c)
{
    gl_update_matrices(c);
    int32_t k = c->made_count < c->count ? vertex_look(c, c->made_count) : 0;
    for (int i = c->made_count; i < c->count; ++i) {
        k += k + 1 < c->looks && c->look_from[k + 1] <= i;
        vertex_make(c, c->at_of[i], &c->look[k], &c->made[i]);
    }
    c->made_count = c->count;
}

/* --- primitives --------------------------------------------------------------------------------------------------- */

/* Draws vertices i ..: their order, and whether each edge is an edge of the polygon. */
typedef void (*vertex_sink)(gl_context *c, const uint32_t *at, int n, const int *edges);

/* index NULL: all vertices in order. */
static void vertex_draw_list(gl_context *c, const uint32_t *index, uint32_t count, int primitive)
{
    const lmb_draw_indices indices = {index, count, LMB_INDEX_U32};
    lmb_draw_vertices v;
    memset(&v, 0, sizeof v);
    v.positions = c->eye_of;
    v.position_format = LMB_DRAW_F32X4;
    v.count = (uint32_t)c->count;
    if (!c->shades) {
        v.colours = c->colour_of[0];
        v.uvs[0] = c->draw.stage[0].texture != NULL ? c->uv_of : NULL;
    }
    if (c->window.is_complete && c->drawn.is_complete && c->draws) {
        (void)lmb_draw_list(&c->target, &c->draw, &v, primitive, index != NULL ? &indices : NULL, NULL);
    }
}

static uint8_t vertex_line_px(const gl_context *c)
{
    return (uint8_t)clampf(floorf(c->s.line.width + 0.5f), 1.0f, 255.0f);
}

/* Draws a line; if it continues the line before, so does the stipple. */
static void vertex_line(gl_context *c, uint32_t a, uint32_t b)
{
    const uint32_t at[2] = {a, b};
    if (c->render_mode != GL_RENDER) {
        gl_select_primitive(c, at, 2, c->stipple_at == 0);
        c->stipple_at = 1;
        return;
    }
    c->draw.line_px = vertex_line_px(c);
    if (gl_is_on(c, CAP_LINE_STIPPLE)) {
        float from[3], to[3];
        gl_window_place(c, c->made[a].clip, from);
        gl_window_place(c, c->made[b].clip, to);
        for (int i = 0; i < 2; ++i) { /* as draw.h snaps */
            c->line_from[i] = floorf(from[i] * 256.0f + 0.5f) * (1.0f / 256.0f);
        }
        c->line_steep = absf(to[1] - from[1]) > absf(to[0] - from[0]);
        vertex_draw_list(c, at, 2, LMB_DRAW_LINES);
        const float length = maxf(absf(to[0] - from[0]), absf(to[1] - from[1]));
        c->stipple_at += length < 1e6f ? (int32_t)(length + 0.5f) : 0;
        return;
    }
    vertex_draw_list(c, at, 2, LMB_DRAW_LINES);
}

static void vertex_point(gl_context *c, uint32_t at)
{
    if (c->render_mode != GL_RENDER) {
        gl_select_primitive(c, &at, 1, 0);
        return;
    }
    c->draw.point_px = (uint8_t)(c->made[at].size + 0.5f);
    vertex_draw_list(c, &at, 1, LMB_DRAW_POINTS);
}

/* Twice the area of a polygon in the window, in homogeneous coordinates: the sign is right
 * even if some w are negative. */
static double vertex_area(const gl_context *c, const uint32_t *at, int n)
{
    double area = 0.0;
    for (int i = 2; i < n; ++i) {
        const float *p = c->made[at[0]].clip, *q = c->made[at[i - 1]].clip, *r = c->made[at[i]].clip;
        area += (double)p[0] * ((double)q[1] * (double)r[3] - (double)q[3] * (double)r[1]) -
                (double)p[1] * ((double)q[0] * (double)r[3] - (double)q[3] * (double)r[0]) +
                (double)p[3] * ((double)q[0] * (double)r[1] - (double)q[1] * (double)r[0]);
    }
    return area;
}

/* --- polygon offset ----------------------------------------------------------------------------------------------- */

/* A unit is 2^-23 of the depth range. draw.h's unit is the least step of depths as large as a triangle's. */

#define VERTEX_OFFSET_UNIT (1.0f / 8388608.0f)

/* draw.h's step of depths as large as vertex `at`. */
static float vertex_depth_step(const gl_context *c, uint32_t at)
{
    const float *clip = c->made[at].clip;
    const float z = clip[3] > 0.0f ? 0.5f * clip[2] / clip[3] + 0.5f : 0.0f;
    const float near = (float)c->s.viewport.range[0], far = (float)c->s.viewport.range[1];
    const float d = near + (far - near) * gl_unit_range(z);
    float step = 1.1920929e-7f;
    for (float size = 1.0f; d < size && step > 1e-30f; size *= 0.5f) {
        step *= 0.5f;
    }
    return step;
}

static void vertex_set_units(gl_context *c, float step)
{
    c->draw.offset_units = c->s.polygon.units * (VERTEX_OFFSET_UNIT / step);
}

/* Set the units for all vertices that wait; 0: their steps differ. */
static int vertex_set_all_units(gl_context *c)
{
    const float step = vertex_depth_step(c, 0);
    for (int i = 1; i < c->count; ++i) {
        if (vertex_depth_step(c, (uint32_t)i) != step) {
            return 0;
        }
    }
    vertex_set_units(c, step);
    return 1;
}

/* 1: a shader takes the flat colour of one primitive a call. */
static int vertex_needs_flat(const gl_context *c) { return c->s.lighting.shade == GL_FLAT && c->shades; }

/* A polygon whose sides may be drawn as lines or points. */
static void vertex_polygon(gl_context *c, const uint32_t *at, int n, const int *edges)
{
    const double area = vertex_area(c, at, n);
    const int back = (area < 0.0) == (c->s.polygon.front_face == GL_CCW);
    const GLenum mode = back ? c->s.polygon.back : c->s.polygon.front;
    const int by_triangle = vertex_fills(c) && c->primitive != GL_POLYGON && !vertex_needs_flat(c); /* as together */
    if (gl_is_on(c, CAP_CULL) && (c->s.polygon.cull == GL_FRONT_AND_BACK ||
                                  (!by_triangle && (c->s.polygon.cull == GL_BACK) == back))) {
        return;
    }
    c->side = back;
    if (c->render_mode != GL_RENDER && (mode == GL_FILL || c->render_mode == GL_SELECT)) {
        gl_select_primitive(c, at, n, 0);
        return;
    }
    if (mode == GL_FILL) {
        for (int i = 2; i < n; ++i) {
            const uint32_t t[3] = {at[0], at[i - 1], at[i]};
            if (vertex_has_units(c)) {
                vertex_set_units(c, maxf(vertex_depth_step(c, t[0]),
                                         maxf(vertex_depth_step(c, t[1]), vertex_depth_step(c, t[2]))));
            }
            vertex_draw_list(c, t, 3, LMB_DRAW_TRIANGLES);
        }
        return;
    }
    const lmb_draw_state kept = c->draw;
    const int offset = gl_is_on(c, mode == GL_LINE ? CAP_OFFSET_LINE : CAP_OFFSET_POINT);
    if (offset) {
        float p[3][3];
        for (int i = 0; i < 3; ++i) {
            gl_window_place(c, c->made[at[i % n]].clip, p[i]);
        }
        const float ax = p[1][0] - p[0][0], ay = p[1][1] - p[0][1], az = p[1][2] - p[0][2], bx = p[2][0] - p[0][0],
                    by = p[2][1] - p[0][1], bz = p[2][2] - p[0][2], d = ax * by - ay * bx;
        const float slope = d != 0.0f ? maxf(absf((az * by - ay * bz) / d), absf((ax * bz - az * bx) / d)) : 0.0f;
        const float d_add = c->s.polygon.factor * slope + c->s.polygon.units * VERTEX_OFFSET_UNIT;
        const float range = (float)(c->s.viewport.range[1] - c->s.viewport.range[0]);
        for (int k = 0; k < 4 && range != 0.0f; ++k) {
            c->draw.to_clip.m[4 * k + 2] += d_add / range * c->draw.to_clip.m[4 * k + 3];
        }
    }
    c->is_side = 1;
    c->stipple_at = 0;
    for (int i = 0; i < n; ++i) {
        if (edges[i] && c->made[at[i]].edge != 0.0f) {
            if (mode == GL_LINE) {
                vertex_line(c, at[i], at[(i + 1) % n]);
            } else {
                vertex_point(c, at[i]);
            }
        }
    }
    c->is_side = 0;
    c->draw = kept;
}

/* With GL_FLAT all vertices get the colour of one: by copying, or as an index for the shader. */
static void vertex_set_flat(gl_context *c, uint32_t provoking) { c->flat = provoking; }

/* With GL_FLAT and bounced light: copies the normal and colours that a pixel is lit with. */
static void vertex_copy_look(gl_context *c, uint32_t to, uint32_t from)
{
    if (c->bounces && to != from) {
        memcpy(c->made[to].normal, c->made[from].normal, sizeof c->made[to].normal);
        memcpy(c->made[to].material, c->made[from].material, sizeof c->made[to].material);
    }
}

static void vertex_polygon_flat(gl_context *c, const uint32_t *at, int n, uint32_t flat)
{
    static const int all[4] = {1, 1, 1, 1};
    gl_made kept[4];
    vertex_set_flat(c, flat);
    const int flattens = c->s.lighting.shade == GL_FLAT;
    for (int i = 0; i < n && flattens; ++i) {
        kept[i] = c->made[at[i]];
    }
    const gl_made from = c->made[flat];
    for (int i = 0; i < n && flattens; ++i) {
        memcpy(c->made[at[i]].colour, from.colour, sizeof from.colour);
        memcpy(c->made[at[i]].second, from.second, sizeof from.second);
        vertex_copy_look(c, at[i], flat);
        for (int k = 0; k < 4; ++k) {
            c->colour_of[at[i]][k] = gl_code(from.colour[0][k]);
        }
    }
    vertex_polygon(c, at, n, all);
    for (int i = 0; i < n && flattens; ++i) {
        c->made[at[i]] = kept[i];
        for (int k = 0; k < 4; ++k) {
            c->colour_of[at[i]][k] = gl_code(kept[i].colour[0][k]);
        }
    }
}

static void vertex_line_flat(gl_context *c, uint32_t a, uint32_t b)
{
    const gl_made kept = c->made[a];
    if (c->s.lighting.shade == GL_FLAT) {
        memcpy(c->made[a].colour, c->made[b].colour, sizeof kept.colour);
        memcpy(c->made[a].second, c->made[b].second, sizeof kept.second);
        memcpy(c->colour_of[a], c->colour_of[b], 4);
    }
    vertex_line(c, a, b);
    c->made[a] = kept;
    for (int k = 0; k < 4; ++k) {
        c->colour_of[a][k] = gl_code(kept.colour[0][k]);
    }
}

static void vertex_whole_polygon(gl_context *c, uint32_t n)
{
    uint32_t *at = c->index_of;
    if (n < 3) {
        return;
    }
    for (uint32_t i = 0; i < n; ++i) {
        at[i] = i;
        c->edges[i] = !(c->is_continued && i == 0);
        if (c->s.lighting.shade == GL_FLAT && i > 0) {
            memcpy(c->made[i].colour, c->made[0].colour, sizeof c->made[0].colour);
            memcpy(c->made[i].second, c->made[0].second, sizeof c->made[0].second);
            vertex_copy_look(c, i, 0);
            memcpy(c->colour_of[i], c->colour_of[0], 4);
        }
    }
    vertex_polygon(c, at, (int)n, c->edges);
}

/* Draws one by one: modes other than fill, lines, points, selection, feedback. */
static void vertex_each_primitive(gl_context *c)
{
    const uint32_t n = (uint32_t)c->count, *o = c->order_of;
    if (c->orders > 0) {
        const uint32_t each = c->ordered == GL_QUADS ? 4 : 3;
        for (uint32_t i = 0; i + each <= (uint32_t)c->orders; i += each, o += each) {
            vertex_polygon_flat(c, o, (int)each, o[each - 1]);
        }
        return;
    }
    switch (c->primitive) {
    case GL_POINTS:
        for (uint32_t i = 0; i < n; ++i) {
            vertex_point(c, i);
        }
        break;
    case GL_LINES:
        for (uint32_t i = 0; i + 1 < n; i += 2) {
            c->stipple_at = 0;
            vertex_line_flat(c, i, i + 1);
        }
        break;
    case GL_LINE_STRIP: case GL_LINE_LOOP:
        for (uint32_t i = 1; i < n; ++i) {
            vertex_line_flat(c, i - 1, i);
        }
        if (c->primitive == GL_LINE_LOOP && n >= 2 && !c->is_continued && !c->is_inside) {
            vertex_line_flat(c, n - 1, 0);
        }
        break;
    case GL_TRIANGLES:
        for (uint32_t i = 0; i + 2 < n; i += 3) {
            const uint32_t at[3] = {i, i + 1, i + 2};
            vertex_polygon_flat(c, at, 3, i + 2);
        }
        break;
    case GL_TRIANGLE_STRIP:
        for (uint32_t i = 2; i < n; ++i) {
            const uint32_t at[3] = {i - 2 + (i & 1u), i - 1 - (i & 1u), i};
            vertex_polygon_flat(c, at, 3, i);
        }
        break;
    case GL_TRIANGLE_FAN:
        for (uint32_t i = 2; i < n; ++i) {
            const uint32_t at[3] = {0, i - 1, i};
            vertex_polygon_flat(c, at, 3, i);
        }
        break;
    case GL_QUADS:
        for (uint32_t i = 0; i + 3 < n; i += 4) {
            const uint32_t at[4] = {i, i + 1, i + 2, i + 3};
            vertex_polygon_flat(c, at, 4, i + 3);
        }
        break;
    case GL_QUAD_STRIP:
        for (uint32_t i = 0; i + 3 < n; i += 2) {
            const uint32_t at[4] = {i, i + 1, i + 3, i + 2};
            vertex_polygon_flat(c, at, 4, i + 3);
        }
        break;
    default: vertex_whole_polygon(c, n); break;
    }
}

/* draw.h's primitive if the batch is filled triangles or quads for the picture; -1: not. */
static int vertex_area_mode(const gl_context *c)
{
    static const int modes[10] = {-1, -1, -1, -1, LMB_DRAW_TRIANGLES, LMB_DRAW_TRIANGLE_STRIP, LMB_DRAW_TRIANGLE_FAN,
                                  LMB_DRAW_QUADS, LMB_DRAW_QUAD_STRIP, -1};
    return vertex_fills(c) ? modes[c->orders > 0 ? c->ordered : c->primitive] : -1;
}

/* draw.h's primitive if the batch is lines or points that need no values of their own for each; -1: not. */
static int vertex_line_mode(const gl_context *c)
{
    const float *a = c->s.point.attenuation;
    const int closes = !c->is_continued && !c->is_inside, fades = a[0] != 1.0f || a[1] != 0.0f || a[2] != 0.0f;
    if (c->render_mode != GL_RENDER || gl_is_on(c, CAP_LINE_STIPPLE)) {
        return -1;
    }
    switch (c->primitive) {
    case GL_POINTS: return fades ? -1 : LMB_DRAW_POINTS;
    case GL_LINES: return LMB_DRAW_LINES;
    case GL_LINE_STRIP: return LMB_DRAW_LINE_STRIP;
    case GL_LINE_LOOP: return closes ? LMB_DRAW_LINE_LOOP : LMB_DRAW_LINE_STRIP;
    default: return -1;
    }
}

/* --- batches outside the picture ---------------------------------------------------------------------------------- */

/* Above the rounding errors of the transformation and of draw.h's clipping, per sum of absolute products. */
#define VERTEX_OUT_MARGIN 1e-3f

/* The smallest and the largest of each coordinate. NaN is ignored, but not in the first vertex: draw.h drops its
 * primitives. */
static void vertex_box(const gl_context *c, float low[4], float high[4])
{
#ifdef __SSE__
    /* Two at a time, because each minimum waits for the one before it. */
    __m128 l = _mm_loadu_ps(c->at_of[0]), h = l, l_odd = l, h_odd = l;
    for (int i = 1; i < c->count; i += 2) {
        const __m128 v = _mm_loadu_ps(c->at_of[i]), odd = _mm_loadu_ps(c->at_of[i + 1 < c->count ? i + 1 : i]);
        l = _mm_min_ps(v, l);
        h = _mm_max_ps(v, h);
        l_odd = _mm_min_ps(odd, l_odd);
        h_odd = _mm_max_ps(odd, h_odd);
    }
    _mm_storeu_ps(low, _mm_min_ps(l, l_odd));
    _mm_storeu_ps(high, _mm_max_ps(h, h_odd));
#else
    memcpy(low, c->at_of[0], 4 * sizeof *low);
    memcpy(high, c->at_of[0], 4 * sizeof *high);
    for (int i = 1; i < c->count; ++i) {
        for (int k = 0; k < 4; ++k) {
            const float v = c->at_of[i][k];
            low[k] = v < low[k] ? v : low[k];
            high[k] = v > high[k] ? v : high[k];
        }
    }
#endif
}

/* 1 if all vertices lie outside one plane of the view volume, so that nothing shows. */
static int vertex_all_out(const gl_context *c)
{
    const float *m = c->modelview.m[c->modelview.top], *p = c->projection.m[c->projection.top];
    float row[4][4], size[4][4], low[4], high[4];
    int outside = 0;
    for (int i = 0; i < 16; ++i) { /* rows of projection x model-view, and of their absolute values */
        const int r = i >> 2, k = 4 * (i & 3);
        row[r][i & 3] = p[r] * m[k] + p[4 + r] * m[k + 1] + p[8 + r] * m[k + 2] + p[12 + r] * m[k + 3];
        size[r][i & 3] = absf(p[r] * m[k]) + absf(p[4 + r] * m[k + 1]) + absf(p[8 + r] * m[k + 2]) +
                         absf(p[12 + r] * m[k + 3]);
    }
    for (int plane = 0; plane < 6; ++plane) { /* first vertex 0 */
        const float *a = row[plane >> 1], sign = (plane & 1) != 0 ? -1.0f : 1.0f, *v = c->at_of[0];
        float d = 0.0f;
        for (int k = 0; k < 4; ++k) {
            d += (sign * a[k] - row[3][k]) * v[k];
        }
        outside |= (d > 0.0f) << plane;
    }
    if (outside == 0) {
        return 0;
    }
    vertex_box(c, low, high);
    for (int plane = 0; plane < 6; ++plane) {
        const float *a = row[plane >> 1], *s = size[plane >> 1], sign = (plane & 1) != 0 ? -1.0f : 1.0f;
        float inmost = 0.0f, margin = 0.0f;
        for (int k = 0; k < 4; ++k) {
            const float by = sign * a[k] - row[3][k];
            inmost += by * (by > 0.0f ? low[k] : high[k]);
            margin += (s[k] + size[3][k]) * maxf(absf(low[k]), absf(high[k]));
        }
        if ((outside >> plane & 1) != 0 && inmost > VERTEX_OUT_MARGIN * margin) {
            return 1;
        }
    }
    return 0;
}

/* --- a batch ------------------------------------------------------------------------------------------------------ */

/* Texture coordinates, and colours of unlit vertices, a look at a time. Returns 0 if the general path is needed. */
static int vertex_set_looks(gl_context *c, lmb_draw_vertices *v)
{
    const int textured = c->draw.stage[0].texture != NULL, lit = gl_is_on(c, CAP_LIGHTING);
    const gl_matrices *s = &c->texture[0];
    for (int32_t k = 0; k < c->looks && (textured || !lit); ++k) {
        const int32_t from = c->look_from[k], to = k + 1 < c->looks ? c->look_from[k + 1] : c->count;
        uint8_t code[4];
        float t[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        for (int i = 0; i < 4; ++i) {
            code[i] = gl_code(c->look[k].colour[i]);
        }
        if (textured) {
            gl_matrix_point(t, s->m[s->top], c->look[k].tex[0]);
        }
        if (t[3] != 1.0f) {
            return 0;
        }
        for (int32_t i = from; i < to; ++i) {
            memcpy(c->colour_of[i], code, sizeof code); /* replaced if lit */
            c->uv_of[i][0] = t[0];
            c->uv_of[i][1] = t[1];
        }
    }
    v->colours = c->colour_of[0];
    v->uvs[0] = textured ? c->uv_of : NULL;
    return 1;
}

/* Colours of lit vertices; earlier ones may have been lit before the material changed. */
static void vertex_set_lit(gl_context *c)
{
    for (int i = 0; i < c->made_count; ++i) {
        for (int k = 0; k < 4; ++k) {
            c->colour_of[i][k] = gl_code(c->made[i].colour[0][k]);
        }
    }
    gl_light_codes(c, c->made_count);
}

/* Sets the sizes of a mode of vertex_line_mode. */
static void vertex_set_sizes(gl_context *c)
{
    static const float none[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    c->draw.line_px = vertex_line_px(c);
    c->draw.point_px = (uint8_t)(vertex_point_size(c, none) + 0.5f);
}

/* Draws primitives in a state that needs no values but those of draw.h. Returns 0 if it cannot. */
static int vertex_plain(gl_context *c, int mode)
{
    static const float one[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const float *m = c->modelview.m[c->modelview.top];
    lmb_draw_vertices v;
    memset(&v, 0, sizeof v);
    if (c->shades || vertex_has_units(c) ||
        (c->draw.stage[0].texture != NULL && c->s.texture.unit[0].gen != 0) || !vertex_set_looks(c, &v)) {
        return 0;
    }
    v.positions = c->at_of;
    v.position_format = LMB_DRAW_F32X4;
    v.count = (uint32_t)c->count;
    if (gl_is_on(c, CAP_LIGHTING) || memcmp(m, one, sizeof one) != 0) {
        gl_matrix_points(c->eye_of, m, (const float(*)[4])c->at_of, c->count);
        v.positions = c->eye_of;
    }
    if (gl_is_on(c, CAP_LIGHTING)) {
        vertex_set_lit(c);
    }
    const lmb_draw_indices order = {c->order_of, (uint32_t)c->orders, LMB_INDEX_U32};
    (void)lmb_draw_list(&c->target, &c->draw, &v, mode, c->orders > 0 ? &order : NULL, NULL);
    return 1;
}

/* The same for lines and points without light: vertices of other primitives than areas are lit one by one. */
static int vertex_plain_lines(gl_context *c, int shows)
{
    const int mode = vertex_line_mode(c);
    if (mode < 0 || !shows || gl_is_on(c, CAP_LIGHTING)) {
        return 0;
    }
    vertex_set_sizes(c);
    return vertex_plain(c, mode);
}

/* Draws filled primitives in one call. */
static int vertex_areas(gl_context *c)
{
    const int mode = vertex_area_mode(c);
    if (mode < 0 || vertex_needs_flat(c) ||
        (gl_is_on(c, CAP_CULL) && c->s.polygon.cull == GL_FRONT_AND_BACK) ||
        (vertex_has_units(c) && !vertex_set_all_units(c))) {
        return 0;
    }
    vertex_draw_list(c, c->orders > 0 ? c->order_of : NULL, (uint32_t)c->orders, mode);
    return 1;
}

/* Draws lines or points in one call. */
static int vertex_lines(gl_context *c)
{
    const int mode = vertex_line_mode(c);
    if (mode < 0 || vertex_needs_flat(c)) {
        return 0;
    }
    vertex_set_sizes(c);
    vertex_draw_list(c, NULL, 0, mode);
    return 1;
}

/* Draws the batch with values of every vertex. */
static void vertex_general(gl_context *c)
{
    gl_make_vertices(c);
    for (int i = 0; i < c->count; ++i) {
        const gl_made *m = &c->made[i];
        memcpy(c->eye_of[i], m->eye, sizeof m->eye);
        for (int k = 0; k < 4 && !c->shades; ++k) {
            c->colour_of[i][k] = gl_code(m->colour[0][k]);
        }
        c->uv_of[i][0] = m->tex[0][0];
        c->uv_of[i][1] = m->tex[0][1];
        if (m->tex[0][3] != 1.0f && c->draw.stage[0].texture != NULL && !c->shades) {
            c->draw.shader = gl_shade_pixels;
            c->shades = 1;
            c->dirty = 1;
        }
    }
    if (!vertex_areas(c) && !vertex_lines(c)) {
        vertex_each_primitive(c);
    }
}

void gl_flush_vertices(gl_context *c)
{
    if (c->count == 0) {
        return;
    }
    if (gl_is_on(c, CAP_BOUNCED)) {
        gl_bounce_batch(c);
    }
    gl_set_draw(c);
    const int mode = vertex_area_mode(c), shows = c->window.is_complete && c->drawn.is_complete && c->draws;
    if (mode < 0 ? !vertex_plain_lines(c, shows) : shows && !vertex_all_out(c) && !vertex_plain(c, mode)) {
        vertex_general(c);
    }
    c->count = c->made_count = c->looks = c->open = c->orders = 0;
}

OP(rect)
{
    static const uint8_t corner[4][2] = {{0, 1}, {2, 1}, {2, 3}, {0, 3}};
    const gl_word mode[2] = {{.u = GL_POLYGON}, {.u = 0}};
    gl_op_begin(c, mode);
    for (int i = 0; i < 4 && c->is_inside; ++i) {
        const float at[4] = {w[corner[i][0]].f, w[corner[i][1]].f, 0.0f, 1.0f};
        gl_vertex_at(c, at);
    }
    if (c->is_inside) {
        gl_op_end(c, NULL);
    }
}

/* --- draw.h's state ----------------------------------------------------------------------------------------------- */

void gl_window_place(const gl_context *c, const float clip[4], float out[3])
{
    const int32_t *b = c->s.viewport.box;
    const float by = clip[3] != 0.0f ? 1.0f / clip[3] : 0.0f;
    const float near = (float)c->s.viewport.range[0], far = (float)c->s.viewport.range[1];
    out[0] = (float)b[0] + ((clip[0] * by) * 0.5f + 0.5f) * (float)b[2];
    out[1] = (float)b[1] + ((clip[1] * by) * 0.5f + 0.5f) * (float)b[3];
    out[2] = near + (far - near) * ((clip[2] * by) * 0.5f + 0.5f);
}

static uint8_t vertex_factor(GLenum f)
{
    return (uint8_t)(f == GL_ZERO   ? LMB_DRAW_ZERO
                     : f == GL_ONE  ? LMB_DRAW_ONE
                     : f >= GL_CONSTANT_COLOR ? (GLenum)LMB_DRAW_CONSTANT_COLOUR + f - GL_CONSTANT_COLOR
                     : f == GL_SRC_ALPHA_SATURATE ? (GLenum)LMB_DRAW_SATURATE
                     : f <= GL_ONE_MINUS_DST_ALPHA ? (GLenum)LMB_DRAW_SOURCE_COLOUR + f - GL_SRC_COLOR
                                              : (GLenum)LMB_DRAW_TARGET_COLOUR + f - GL_DST_COLOR);
}

static uint8_t vertex_stencil_op(GLenum o)
{
    return (uint8_t)(o == GL_ZERO        ? LMB_DRAW_CLEAR
                     : o == GL_REPLACE   ? LMB_DRAW_PUT
                     : o == GL_INCR      ? LMB_DRAW_INCREASE
                     : o == GL_DECR      ? LMB_DRAW_DECREASE
                     : o == GL_INVERT    ? LMB_DRAW_INVERT
                     : o == GL_INCR_WRAP ? LMB_DRAW_INCREASE_WRAP
                     : o == GL_DECR_WRAP ? LMB_DRAW_DECREASE_WRAP
                                         : LMB_DRAW_KEEP);
}

static uint8_t vertex_equation(GLenum e)
{
    return (uint8_t)(e == GL_MIN ? LMB_DRAW_MIN : e == GL_MAX ? LMB_DRAW_MAX : e == GL_FUNC_SUBTRACT ? LMB_DRAW_SUBTRACT
                     : e == GL_FUNC_REVERSE_SUBTRACT ? LMB_DRAW_REVERSE_SUBTRACT : LMB_DRAW_ADD);
}

/* A truth table: bit 0 for source and target 1, bit 1 for source 1 only, bit 2 for target 1 only, bit 3 for none. */
static uint8_t vertex_logic(GLenum op)
{
    static const uint8_t table[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return table[op - GL_CLEAR];
}

static void vertex_set_target(gl_context *c)
{
    lmb_draw_target *t = &c->target;
    const gl_surface *s = &c->drawn;
    memset(t, 0, sizeof *t);
    if (s->colour != NULL) {
        t->colour.data = s->colour;
        t->colour.width = s->width;
        t->colour.height = s->height;
        t->colour.stride_bytes = s->stride * 4;
        t->colour.format = s->swaps ? LMB_BGRA8 : LMB_RGBA8;
        t->colour.layout = LMB_LINEAR;
    }
    if (s->depth != NULL) {
        t->depth.data = s->depth;
        t->depth.width = s->width;
        t->depth.height = s->height;
        t->depth.stride_bytes = s->depth_stride * 4;
        t->depth.format = LMB_DEPTH32F;
        t->depth.layout = LMB_LINEAR;
    }
    t->stencil = s->stencil;
    t->stencil_stride = s->stencil_stride;
}

static void vertex_set_to_clip(gl_context *c)
{
    const float *p = c->projection.m[c->projection.top];
    for (int k = 0; k < 4; ++k) { /* memory rows go up; z from -w .. w to 0 .. w */
        c->draw.to_clip.m[4 * k] = p[4 * k];
        c->draw.to_clip.m[4 * k + 1] = -p[4 * k + 1];
        c->draw.to_clip.m[4 * k + 2] = 0.5f * (p[4 * k + 2] + p[4 * k + 3]);
        c->draw.to_clip.m[4 * k + 3] = p[4 * k + 3];
    }
}

static void vertex_set_tests(gl_context *c, lmb_draw_state *d)
{
    const gl_state *s = &c->s;
    d->flags = s->polygon.front_face == GL_CCW ? LMB_DRAW_CLOCKWISE : 0;
    if (gl_is_on(c, CAP_DEPTH) && c->drawn.depth != NULL) {
        d->flags |= LMB_DRAW_DEPTH_TEST | (s->depth.mask ? (uint32_t)LMB_DRAW_DEPTH_WRITE : 0);
    }
    if (gl_is_on(c, CAP_STENCIL) && c->drawn.stencil != NULL) {
        d->flags |= LMB_DRAW_STENCIL;
    }
    d->flags |= s->lighting.shade == GL_FLAT ? LMB_DRAW_FLAT : 0;
    d->flags |= gl_is_on(c, CAP_SCISSOR) ? LMB_DRAW_SCISSOR : 0;
    d->flags |= gl_is_on(c, CAP_ALPHA_TEST) ? LMB_DRAW_ALPHA_TEST : 0;
    d->flags |= gl_is_on(c, CAP_BLEND) ? LMB_DRAW_BLEND : 0;
    d->flags |= gl_is_on(c, CAP_LOGIC) ? LMB_DRAW_LOGIC : 0;
    if (gl_is_on(c, CAP_CULL)) {
        d->flags |= s->polygon.cull != GL_BACK ? LMB_DRAW_CULL_FRONT : 0;
        d->flags |= s->polygon.cull != GL_FRONT ? LMB_DRAW_CULL_BACK : 0;
    }
    d->depth_func = (uint8_t)gl_draw_func(s->depth.func);
    d->alpha_func = (uint8_t)gl_draw_func(s->colour.alpha_func);
    d->alpha_value = gl_code(s->colour.alpha_ref);
    d->stencil_func = (uint8_t)gl_draw_func(s->stencil.func);
    d->stencil_value = (uint8_t)s->stencil.ref;
    d->stencil_mask = (uint8_t)s->stencil.mask;
    d->stencil_write = (uint8_t)s->stencil.write;
    d->stencil_op[0] = vertex_stencil_op(s->stencil.fail);
    d->stencil_op[1] = vertex_stencil_op(s->stencil.zfail);
    d->stencil_op[2] = vertex_stencil_op(s->stencil.zpass);
    for (int i = 0; i < 2; ++i) {
        d->blend_source[i] = vertex_factor(s->colour.blend[2 * i]);
        d->blend_target[i] = vertex_factor(s->colour.blend[2 * i + 1]);
        d->blend_equation[i] = vertex_equation(s->colour.equation[i]);
    }
    for (int i = 0; i < 4; ++i) {
        d->blend_colour[i] = gl_code(s->colour.blend_colour[i]);
        d->scissor[i] = clampi(s->scissor.box[i], i < 2 ? -2 * LMB_MAX_FRAME : 0, 2 * LMB_MAX_FRAME);
    }
    d->logic_op = vertex_logic(s->colour.logic);
    d->colour_mask = (uint8_t)(s->colour.draw == GL_NONE ? 0 : s->colour.mask & (c->drawn.has_alpha ? 15u : 7u));
}

int gl_draw_func(GLenum f) { return (int)(f - GL_NEVER); }

/* Returns whether draw.h's own stage is enough, without a shader. */
static int vertex_is_plain(gl_context *c)
{
    const gl_state *s = &c->s;
    const gl_unit *u = &s->texture.unit[0];
    if (s->lighting.two || gl_is_on(c, CAP_POLYGON_STIPPLE) || gl_is_on(c, CAP_LINE_STIPPLE) ||
        gl_is_on(c, CAP_COLOR_SUM) || (gl_is_on(c, CAP_LIGHTING) && s->lighting.separate) ||
        (gl_is_on(c, CAP_FOG)) || gl_is_on(c, CAP_POINT_SPRITE)) {
        return 0;
    }
    for (int i = 1; i < GL_UNITS; ++i) {
        if (gl_unit_is_on(c, i)) {
            return 0;
        }
    }
    memset(&c->draw.stage[0], 0, sizeof c->draw.stage[0]);
    if (!gl_unit_is_on(c, 0)) {
        return 1;
    }
    const gl_texture *t = gl_unit_texture(c, 0);
    const gl_image *image = t->target == TARGET_2D ? &t->image[0][t->base_level] : NULL;
    if (image == NULL || image->border != 0 || image->width > LMB_MAX_SIDE || image->height > LMB_MAX_SIDE ||
        (t->min_filter != GL_NEAREST && t->min_filter != GL_LINEAR) ||
        t->min_filter != t->mag_filter || u->mode != GL_MODULATE || image->base == GL_DEPTH_COMPONENT) {
        return 0;
    }
    for (int i = 0; i < 4; ++i) {
        if (t->swizzle[i] != GL_RED + (GLenum)i) {
            return 0;
        }
    }
    for (int i = 0; i < 2; ++i) {
        if (t->wrap[i] != GL_REPEAT && t->wrap[i] != GL_CLAMP_TO_EDGE && t->wrap[i] != GL_MIRRORED_REPEAT) {
            return 0;
        }
    }
    lmb_texture *d = &c->draw_texture;
    memset(d, 0, sizeof *d);
    d->texels = image->texels;
    d->width = (uint16_t)image->width;
    d->height = (uint16_t)image->height;
    d->levels = 1;
    d->filter = (uint8_t)(t->mag_filter == GL_NEAREST ? LMB_NEAREST : LMB_BILINEAR);
    d->wrap_s = (uint8_t)(t->wrap[0] == GL_REPEAT          ? LMB_WRAP_REPEAT
                          : t->wrap[0] == GL_CLAMP_TO_EDGE ? LMB_WRAP_CLAMP
                                                           : LMB_WRAP_MIRROR);
    d->wrap_t = (uint8_t)(t->wrap[1] == GL_REPEAT          ? LMB_WRAP_REPEAT
                          : t->wrap[1] == GL_CLAMP_TO_EDGE ? LMB_WRAP_CLAMP
                                                           : LMB_WRAP_MIRROR);
    c->draw.stage[0].texture = d;
    c->draw.stage[0].mode = LMB_DRAW_MODULATE;
    return 1;
}

void gl_set_draw(gl_context *c)
{
    lmb_draw_state *d = &c->draw;
    if (!c->dirty) {
        return;
    }
    c->dirty = 0;
    gl_find_surface(c, &c->drawn, c->framebuffer);
    gl_find_textures(c);
    vertex_set_target(c);
    c->draws = c->s.viewport.box[2] > 0 && c->s.viewport.box[3] > 0 &&
               (c->target.colour.data != NULL || c->target.depth.data != NULL);
    if (!c->draws) {
        return;
    }
    (void)lmb_draw_state_init(d, 1, 1);
    d->kernels = c->kernels;
    vertex_set_to_clip(c);
    for (int i = 0; i < 4; ++i) {
        d->viewport[i] =
            i < 2 ? clampi(c->s.viewport.box[i], -2 * LMB_MAX_FRAME, 2 * LMB_MAX_FRAME) : c->s.viewport.box[i];
    }
    d->depth_range[0] = (float)c->s.viewport.range[0];
    d->depth_range[1] = (float)c->s.viewport.range[1];
    for (int i = 0; i < GL_CLIP_PLANES; ++i) {
        if (gl_is_on(c, CAP_CLIP + i)) {
            d->planes |= (uint8_t)(1u << i);
            for (int k = 0; k < 4; ++k) {
                d->plane[i][k] = c->s.transform.plane[i][k];
            }
        }
    }
    vertex_set_tests(c, d);
    if (gl_is_on(c, CAP_OFFSET_FILL)) {
        d->offset_slope = c->s.polygon.factor;
        d->offset_units = c->s.polygon.units;
    }
    c->bounces = gl_bounce_shows(c);
    c->shades = !vertex_is_plain(c) || c->bounces;
    if (c->shades) {
        memset(&d->stage[0], 0, sizeof d->stage[0]);
        d->shader = gl_shade_pixels;
        d->flags |= gl_is_on(c, CAP_POLYGON_STIPPLE) || gl_is_on(c, CAP_LINE_STIPPLE) ? LMB_DRAW_DISCARDS : 0;
    }
    d->shader_user = c;
    d->passed = c->query != NULL ? &c->query->passed : NULL;
}
