/* gl_eval.c: evaluators: points of Bezier curves and surfaces, by de Casteljau's method. */
#include "gl_context.h"

#define OP(name) void gl_op_##name(gl_context *c, const gl_word *w)
enum { EVAL_COLOUR, EVAL_INDEX, EVAL_NORMAL, EVAL_TEX1, EVAL_TEX4 = EVAL_TEX1 + 3, EVAL_VERTEX3, EVAL_VERTEX4 };
static const int eval_values[9] = {4, 1, 3, 1, 2, 3, 4, 3, 4};

/* w: target, u1, u2, order, v1, v2, order, values, points */
OP(map)
{
    const int two = w[0].u >= GL_MAP2_COLOR_4;
    const GLenum k = w[0].u - (two ? GL_MAP2_COLOR_4 : GL_MAP1_COLOR_4);
    gl_map *m = k < 9 ? (two ? &c->map2[k] : &c->map1[k]) : NULL;
    GL_FAIL(m == NULL, GL_INVALID_ENUM, )
    GL_FAIL(c->s.texture.active != 0, GL_INVALID_OPERATION, )
    const size_t bytes = (size_t)(w[3].i * w[6].i * w[7].i) * sizeof(float);
    float *points = gl_alloc(c, bytes);
    if (points == NULL) {
        return;
    }
    memcpy(points, gl_data_of(w + 8), bytes);
    gl_free(c, m->points);
    m->points = points;
    m->order[0] = w[3].i;
    m->order[1] = w[6].i;
    m->range[0] = w[1].f;
    m->range[1] = w[2].f;
    m->range[2] = w[4].f;
    m->range[3] = w[5].f;
}

OP(map_grid)
{
    GL_FAIL(w[1].i < 1 || w[4].i < 1, GL_INVALID_VALUE, )
    if (w[0].i == 1) {
        c->s.eval.n1 = w[1].i;
        c->s.eval.grid1[0] = w[2].f;
        c->s.eval.grid1[1] = w[3].f;
        return;
    }
    c->s.eval.n2[0] = w[1].i;
    c->s.eval.n2[1] = w[4].i;
    for (int i = 0; i < 2; ++i) {
        c->s.eval.grid2[i] = w[2 + i].f;
        c->s.eval.grid2[2 + i] = w[5 + i].f;
    }
}

/* The point at t of a curve of n points, `stride` floats apart; also the derivative if `by` is not NULL. */
static void eval_curve(float *out, float *by, const float *p, int n, int stride, int values, float t)
{
    float q[GL_MAP_ORDER][4];
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < values; ++k) {
            q[i][k] = p[i * stride + k];
        }
    }
    for (int m = n - 1; m > 0; --m) {
        for (int k = 0; k < values && m == 1 && by != NULL; ++k) {
            by[k] = (float)(n - 1) * (q[1][k] - q[0][k]);
        }
        for (int i = 0; i < m; ++i) {
            for (int k = 0; k < values; ++k) {
                q[i][k] += (q[i + 1][k] - q[i][k]) * t;
            }
        }
    }
    for (int k = 0; k < values; ++k) {
        out[k] = q[0][k];
        if (n == 1 && by != NULL) {
            by[k] = 0.0f;
        }
    }
}

static void eval_surface(float *out, float *by_u, float *by_v, const gl_map *m, int values, float u, float v)
{
    float row[GL_MAP_ORDER * 4], column[GL_MAP_ORDER * 4];
    for (int i = 0; i < m->order[0]; ++i) {
        eval_curve(&row[4 * i], NULL, m->points + i * m->order[1] * values, m->order[1], values, values, v);
    }
    eval_curve(out, by_u, row, m->order[0], 4, values, u);
    if (by_v != NULL) {
        for (int j = 0; j < m->order[1]; ++j) {
            eval_curve(&column[4 * j], NULL, m->points + j * values, m->order[0], m->order[1] * values, values, u);
        }
        eval_curve(out, by_v, column, m->order[1], 4, values, v);
    }
}

static int eval_has(const gl_context *c, int dims, int k)
{
    const gl_map *m = dims == 1 ? &c->map1[k] : &c->map2[k];
    return gl_is_on(c, (dims == 1 ? CAP_MAP1 : CAP_MAP2) + k) && m->points != NULL;
}

/* 1 and the values of a map, if it is on. */
static int eval_map(const gl_context *c, int dims, int k, float u, float v, float *out, float *by_u, float *by_v)
{
    const gl_map *m = dims == 1 ? &c->map1[k] : &c->map2[k];
    if (!eval_has(c, dims, k)) {
        return 0;
    }
    const float s = (u - m->range[0]) / (m->range[1] - m->range[0]);
    if (dims == 1) {
        eval_curve(out, NULL, m->points, m->order[0], eval_values[k], eval_values[k], s);
    } else {
        eval_surface(out, by_u, by_v, m, eval_values[k], s, (v - m->range[2]) / (m->range[3] - m->range[2]));
    }
    return 1;
}

static void eval_at(gl_context *c, int dims, float u, float v)
{
    const gl_vertex kept = c->s.current.v;
    float at[4] = {0.0f, 0.0f, 0.0f, 1.0f}, by_u[4] = {0.0f}, by_v[4] = {0.0f};
    const int wide = eval_has(c, dims, EVAL_VERTEX4);
    if (!wide && !eval_has(c, dims, EVAL_VERTEX3)) {
        return;
    }
    c->open = 0;
    (void)eval_map(c, dims, EVAL_COLOUR, u, v, c->s.current.v.colour, NULL, NULL);
    (void)eval_map(c, dims, EVAL_NORMAL, u, v, c->s.current.v.normal, NULL, NULL);
    for (int k = EVAL_TEX4; k >= EVAL_TEX1; --k) {
        float t[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        if (eval_map(c, dims, k, u, v, t, NULL, NULL)) {
            memcpy(c->s.current.v.tex[0], t, sizeof t);
            break;
        }
    }
    const int normals = dims == 2 && gl_is_on(c, CAP_AUTO_NORMAL);
    (void)eval_map(c, dims, wide ? EVAL_VERTEX4 : EVAL_VERTEX3, u, v, at, normals ? by_u : NULL, normals ? by_v : NULL);
    if (normals) {
        for (int i = 0; i < 3 && wide; ++i) {
            by_u[i] = by_u[i] * at[3] - by_u[3] * at[i];
            by_v[i] = by_v[i] * at[3] - by_v[3] * at[i];
        }
        const gl_map *m = &c->map2[wide ? EVAL_VERTEX4 : EVAL_VERTEX3];
        const float turn = (m->range[1] < m->range[0]) != (m->range[3] < m->range[2]) ? -1.0f : 1.0f;
        float n[3] = {by_u[1] * by_v[2] - by_u[2] * by_v[1], by_u[2] * by_v[0] - by_u[0] * by_v[2],
                      by_u[0] * by_v[1] - by_u[1] * by_v[0]};
        const float square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2],
                    by = square > 0.0f ? turn / lmb_sqrt(square) : 0.0f;
        for (int i = 0; i < 3; ++i) {
            c->s.current.v.normal[i] = n[i] * by;
        }
    }
    gl_vertex_at(c, at);
    c->s.current.v = kept;
    c->open = 0;
}

OP(eval_coord) { eval_at(c, w[0].i, w[1].f, w[2].f); }

static float eval_grid(const float grid[2], int n, int i)
{
    return i == n ? grid[1] : grid[0] + (float)i * ((grid[1] - grid[0]) / (float)n);
}

static void eval_point(gl_context *c, int dims, int i, int j)
{
    if (dims == 1) {
        eval_at(c, 1, eval_grid(c->s.eval.grid1, c->s.eval.n1, i), 0.0f);
    } else {
        eval_at(c, 2, eval_grid(c->s.eval.grid2, c->s.eval.n2[0], i),
                eval_grid(c->s.eval.grid2 + 2, c->s.eval.n2[1], j));
    }
}

OP(eval_point) { eval_point(c, w[0].i, w[1].i, w[2].i); }

static int eval_begin(gl_context *c, GLenum mode)
{
    const gl_word begin[2] = {{.u = mode}, {.u = 0}};
    gl_op_begin(c, begin);
    return c->is_inside;
}

/* w: dims, mode, i1, i2, j1, j2 */
OP(eval_mesh)
{
    const GLenum mode = w[1].u;
    GL_FAIL(mode != GL_POINT && mode != GL_LINE && (mode != GL_FILL || w[0].i == 1), GL_INVALID_ENUM, )
    if (w[0].i == 1 || mode == GL_POINT) {
        if (!eval_begin(c, mode == GL_POINT ? GL_POINTS : GL_LINE_STRIP)) {
            return;
        }
        for (int j = w[4].i; j <= w[5].i; ++j) {
            for (int i = w[2].i; i <= w[3].i; ++i) {
                eval_point(c, w[0].i, i, j);
            }
        }
        gl_op_end(c, NULL);
        return;
    }
    for (int j = w[4].i; j <= w[5].i - (mode == GL_FILL); ++j) {
        if (!eval_begin(c, mode == GL_FILL ? GL_QUAD_STRIP : GL_LINE_STRIP)) {
            return;
        }
        for (int i = w[2].i; i <= w[3].i; ++i) {
            if (mode == GL_FILL) {
                eval_point(c, 2, i, j + 1);
            }
            eval_point(c, 2, i, j);
        }
        gl_op_end(c, NULL);
    }
    for (int i = w[2].i; i <= w[3].i && mode == GL_LINE && eval_begin(c, GL_LINE_STRIP); ++i) {
        for (int j = w[4].i; j <= w[5].i; ++j) {
            eval_point(c, 2, i, j);
        }
        gl_op_end(c, NULL);
    }
}

#define GET_MAP(t, T, ROUND) \
    void glGetMap##t##v(GLenum target, GLenum query, T *out) \
    { \
        GL_ENTER() \
        const int two = target >= GL_MAP2_COLOR_4; \
        const GLenum k = target - (two ? GL_MAP2_COLOR_4 : GL_MAP1_COLOR_4); \
        GL_FAIL(k >= 9, GL_INVALID_ENUM, ) \
        const gl_map *m = two ? &c->map2[k] : &c->map1[k]; \
        if (query == GL_ORDER) { \
            for (int i = 0; i < 1 + two; ++i) out[i] = (T)(m->points != NULL ? m->order[i] : 1); \
        } else if (query == GL_DOMAIN) { \
            for (int i = 0; i < 2 + 2 * two; ++i) out[i] = (T)ROUND(m->points != NULL ? m->range[i] : (float)(i & 1)); \
        } else if (query == GL_COEFF) { \
            const int n = m->points != NULL ? m->order[0] * (two ? m->order[1] : 1) * eval_values[k] : 0; \
            for (int i = 0; i < n; ++i) out[i] = (T)ROUND(m->points[i]); \
        } else { \
            gl_error(c, GL_INVALID_ENUM); \
        } \
    }
#define PLAIN(v) (v)
#define NEAREST(v) gl_int(floorf((v) + 0.5f))
GET_MAP(f, GLfloat, PLAIN) GET_MAP(d, GLdouble, PLAIN) GET_MAP(i, GLint, NEAREST)
