/* gl_select.c: selection and feedback: records of primitives instead of pixels. */
#include "gl_context.h"

#define OP(name) void gl_op_##name(gl_context *c, const gl_word *w)

static void select_put(gl_context *c, GLuint v)
{
    if (c->select_at < c->select_size) {
        c->select[c->select_at] = v;
    }
    ++c->select_at;
}

static GLuint select_depth(float z) { return (GLuint)((double)gl_unit_range(z) * 4294967295.0); }

/* Writes a record of the current names if there was a hit. */
static void select_record(gl_context *c)
{
    if (!c->hit) {
        return;
    }
    select_put(c, (GLuint)c->name_count);
    select_put(c, select_depth(c->hit_min));
    select_put(c, select_depth(c->hit_max));
    for (int i = 0; i < c->name_count; ++i) {
        select_put(c, c->name_stack[i]);
    }
    c->hits = c->select_at > c->select_size ? -1 : c->hits < 0 ? -1 : c->hits + 1;
    c->hit = 0;
    c->hit_min = 1.0f;
    c->hit_max = 0.0f;
}

OP(init_names)
{
    (void)w;
    if (c->render_mode == GL_SELECT) {
        select_record(c);
        c->name_count = 0;
    }
}
OP(load_name)
{
    if (c->render_mode != GL_SELECT) {
        return;
    }
    GL_FAIL(c->name_count == 0, GL_INVALID_OPERATION, )
    select_record(c);
    c->name_stack[c->name_count - 1] = w[0].u;
}
OP(push_name)
{
    if (c->render_mode != GL_SELECT) {
        return;
    }
    GL_FAIL(c->name_count >= GL_NAMES, GL_STACK_OVERFLOW, )
    select_record(c);
    c->name_stack[c->name_count++] = w[0].u;
}
OP(pop_name)
{
    (void)w;
    if (c->render_mode != GL_SELECT) {
        return;
    }
    GL_FAIL(c->name_count == 0, GL_STACK_UNDERFLOW, )
    select_record(c);
    --c->name_count;
}

/* --- clipped primitives ------------------------------------------------------------------------------------------- */

typedef struct select_vertex {
    float eye[4], clip[4], colour[4], tex[4];
} select_vertex;
enum { SELECT_CORNERS = 32 };

static float select_distance(const gl_context *c, const select_vertex *v, int plane)
{
    if (plane < 6) {
        return plane % 2 == 0 ? v->clip[3] + v->clip[plane / 2] : v->clip[3] - v->clip[plane / 2];
    }
    const float *p = c->s.transform.plane[plane - 6];
    return p[0] * v->eye[0] + p[1] * v->eye[1] + p[2] * v->eye[2] + p[3] * v->eye[3];
}

static int select_cut(const gl_context *c, select_vertex *v, int n, int closed)
{
    for (int plane = 0; plane < 6 + GL_CLIP_PLANES && n > 0; ++plane) {
        select_vertex out[SELECT_CORNERS];
        int m = 0;
        if (plane >= 6 && !gl_is_on(c, CAP_CLIP + plane - 6)) {
            continue;
        }
        for (int i = 0; i < n; ++i) {
            const select_vertex *a = &v[i], *b = &v[(i + 1) % n];
            const float da = select_distance(c, a, plane), db = select_distance(c, b, plane);
            if (da >= 0.0f && m < SELECT_CORNERS) {
                out[m++] = *a;
            }
            if ((da >= 0.0f) != (db >= 0.0f) && (closed || i + 1 < n) && m < SELECT_CORNERS) {
                const float t = da / (da - db), *pa = a->eye, *pb = b->eye;
                float *to = out[m++].eye;
                for (int k = 0; k < 16; ++k) {
                    to[k] = pa[k] + (pb[k] - pa[k]) * t;
                }
            }
        }
        memcpy(v, out, (size_t)m * sizeof *v);
        n = m;
    }
    return n;
}

static void select_feed(gl_context *c, float v)
{
    if (c->feedback_at < c->feedback_size) {
        c->feedback[c->feedback_at] = v;
    }
    ++c->feedback_at;
}

static void select_feed_vertex(gl_context *c, const select_vertex *v)
{
    float at[3];
    gl_window_place(c, v->clip, at);
    select_feed(c, at[0]);
    select_feed(c, at[1]);
    if (c->feedback_type != GL_2D) {
        select_feed(c, at[2]);
    }
    if (c->feedback_type == GL_4D_COLOR_TEXTURE) {
        select_feed(c, v->clip[3]);
    }
    for (int i = 0; i < 4 && c->feedback_type >= GL_3D_COLOR; ++i) {
        select_feed(c, v->colour[i]);
    }
    for (int i = 0; i < 4 && c->feedback_type >= GL_3D_COLOR_TEXTURE; ++i) {
        select_feed(c, v->tex[i]);
    }
}

/* index NULL: a token of a pixel rectangle, n, at the raster position. reset: a line begins its stipple. */
void gl_select_primitive(gl_context *c, const uint32_t *index, int n, int reset)
{
    select_vertex v[SELECT_CORNERS];
    if (index == NULL) {
        select_feed(c, (float)n);
        const float *r = c->s.current.raster;
        select_feed(c, r[0]);
        select_feed(c, r[1]);
        if (c->feedback_type != GL_2D) {
            select_feed(c, r[2]);
        }
        if (c->feedback_type == GL_4D_COLOR_TEXTURE) {
            select_feed(c, r[3]);
        }
        for (int i = 0; i < 4 && c->feedback_type >= GL_3D_COLOR; ++i) {
            select_feed(c, c->s.current.raster_colour[i]);
        }
        for (int i = 0; i < 4 && c->feedback_type >= GL_3D_COLOR_TEXTURE; ++i) {
            select_feed(c, c->s.current.raster_tex[0][i]);
        }
        return;
    }
    for (int first = 0; first == 0 || first + 2 < n; first += SELECT_CORNERS / 2 - 2) { /* large polygons in parts */
        int count = mini(n - (first == 0 ? 0 : first), SELECT_CORNERS / 2);
        for (int i = 0; i < count; ++i) {
            const gl_made *m = &c->made[index[first == 0 || i > 0 ? first + i : 0]];
            const int side = gl_is_on(c, CAP_LIGHTING) && c->s.lighting.two && n > 2 ? c->side : 0;
            memcpy(v[i].eye, m->eye, sizeof m->eye);
            memcpy(v[i].clip, m->clip, sizeof m->clip);
            memcpy(v[i].colour, m->colour[side], sizeof m->colour[side]);
            memcpy(v[i].tex, m->tex[0], sizeof m->tex[0]);
        }
        count = select_cut(c, v, count, n > 2);
        if (count == 0) {
            continue;
        }
        if (c->render_mode == GL_SELECT) {
            for (int i = 0; i < count; ++i) {
                float at[3];
                gl_window_place(c, v[i].clip, at);
                c->hit_min = c->hit ? minf(c->hit_min, at[2]) : at[2];
                c->hit_max = c->hit ? maxf(c->hit_max, at[2]) : at[2];
                c->hit = 1;
            }
            continue;
        }
        select_feed(c, (float)(n == 1   ? GL_POINT_TOKEN
                               : n == 2 ? (reset ? GL_LINE_RESET_TOKEN : GL_LINE_TOKEN)
                                        : GL_POLYGON_TOKEN));
        if (n > 2) {
            select_feed(c, (float)count);
        }
        for (int i = 0; i < count; ++i) {
            select_feed_vertex(c, &v[i]);
        }
    }
}

OP(pass_through)
{
    if (c->render_mode == GL_FEEDBACK) {
        select_feed(c, (float)GL_PASS_THROUGH_TOKEN);
        select_feed(c, w[0].f);
    }
}

/* --- modes -------------------------------------------------------------------------------------------------------- */

void glSelectBuffer(GLsizei n, GLuint *buffer)
{
    GL_ENTER()
    GL_FAIL(n < 0, GL_INVALID_VALUE, )
    GL_FAIL(c->render_mode == GL_SELECT, GL_INVALID_OPERATION, )
    c->select = buffer;
    c->select_size = n;
}

void glFeedbackBuffer(GLsizei n, GLenum type, GLfloat *buffer)
{
    GL_ENTER()
    GL_FAIL(n < 0, GL_INVALID_VALUE, )
    GL_FAIL(type < GL_2D || type > GL_4D_COLOR_TEXTURE, GL_INVALID_ENUM, )
    GL_FAIL(c->render_mode == GL_FEEDBACK, GL_INVALID_OPERATION, )
    c->feedback = buffer;
    c->feedback_size = n;
    c->feedback_type = type;
}

GLint glRenderMode(GLenum mode)
{
    GL_ENTER(0)
    GLint result = 0;
    GL_FAIL(mode < GL_RENDER || mode > GL_SELECT, GL_INVALID_ENUM, 0)
    GL_FAIL((mode == GL_SELECT && c->select == NULL) || (mode == GL_FEEDBACK && c->feedback == NULL),
            GL_INVALID_OPERATION, 0)
    gl_flush_vertices(c);
    if (c->render_mode == GL_SELECT) {
        select_record(c);
        result = c->hits;
    } else if (c->render_mode == GL_FEEDBACK) {
        result = c->feedback_at > c->feedback_size ? -1 : c->feedback_at;
    }
    c->render_mode = mode;
    c->select_at = c->hits = c->feedback_at = c->name_count = c->hit = 0;
    c->hit_min = 1.0f;
    c->hit_max = 0.0f;
    c->dirty = 1;
    return result;
}
