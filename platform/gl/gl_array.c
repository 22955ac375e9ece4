/* gl_array.c: vertex arrays and buffer objects. Elements outside a buffer are zeros. */
#include <stddef.h>

#include "gl_context.h"

void gl_set_array(gl_context *c)
{
    for (int i = 0; i < ARRAYS; ++i) {
        c->client.array[i].size = i == ARRAY_NORMAL || i == ARRAY_SECOND                  ? 3
                                  : i == ARRAY_FOG || i == ARRAY_EDGE || i == ARRAY_INDEX ? 1
                                                                                          : 4;
        c->client.array[i].type = i == ARRAY_EDGE ? GL_UNSIGNED_BYTE : GL_FLOAT;
    }
}

static int array_bytes(GLenum type) { return type == GL_DOUBLE ? 8 : gl_type_bytes(type); }

static void array_set(int which, GLint size, GLenum type, GLsizei stride, const void *data, GLint min, GLint max,
                      uint32_t types)
{
    GL_ENTER()
    gl_array *a = &c->client.array[which];
    GL_FAIL(size < min || size > max || stride < 0, GL_INVALID_VALUE, )
    GL_FAIL(type < GL_BYTE || type > GL_DOUBLE || (types >> (type - GL_BYTE) & 1u) == 0, GL_INVALID_ENUM, )
    a->size = size;
    a->type = type;
    a->stride = stride;
    a->data = data;
    a->buffer = c->client.bound;
}
enum { B = 1, UB = 2, S = 4, US = 8, IN = 16, UI = 32, FL = 64, DO = 1024 };
void glVertexPointer(GLint n, GLenum t, GLsizei s, const void *p)
{
    array_set(ARRAY_VERTEX, n, t, s, p, 2, 4, S | IN | FL | DO);
}
void glNormalPointer(GLenum t, GLsizei s, const void *p)
{
    array_set(ARRAY_NORMAL, 3, t, s, p, 3, 3, B | S | IN | FL | DO);
}
void glColorPointer(GLint n, GLenum t, GLsizei s, const void *p)
{
    array_set(ARRAY_COLOUR, n, t, s, p, 3, 4, B | UB | S | US | IN | UI | FL | DO);
}
void glIndexPointer(GLenum t, GLsizei s, const void *p)
{
    array_set(ARRAY_INDEX, 1, t, s, p, 1, 1, UB | S | IN | FL | DO);
}
void glTexCoordPointer(GLint n, GLenum t, GLsizei s, const void *p)
{
    array_set(ARRAY_TEX + (gl_now != NULL ? gl_now->client.active : 0), n, t, s, p, 1, 4, S | IN | FL | DO);
}
void glEdgeFlagPointer(GLsizei s, const void *p) { array_set(ARRAY_EDGE, 1, GL_UNSIGNED_BYTE, s, p, 1, 1, UB); }
void glFogCoordPointer(GLenum t, GLsizei s, const void *p) { array_set(ARRAY_FOG, 1, t, s, p, 1, 1, FL | DO); }
void glSecondaryColorPointer(GLint n, GLenum t, GLsizei s, const void *p)
{
    array_set(ARRAY_SECOND, n, t, s, p, 3, 3, B | UB | S | US | IN | UI | FL | DO);
}
void glVertexPointerEXT(GLint n, GLenum t, GLsizei s, GLsizei k, const void *p)
{
    (void)k;
    glVertexPointer(n, t, s, p);
}
void glNormalPointerEXT(GLenum t, GLsizei s, GLsizei k, const void *p) { (void)k; glNormalPointer(t, s, p); }
void glColorPointerEXT(GLint n, GLenum t, GLsizei s, GLsizei k, const void *p) { (void)k; glColorPointer(n, t, s, p); }
void glIndexPointerEXT(GLenum t, GLsizei s, GLsizei k, const void *p) { (void)k; glIndexPointer(t, s, p); }
void glTexCoordPointerEXT(GLint n, GLenum t, GLsizei s, GLsizei k, const void *p)
{
    (void)k;
    glTexCoordPointer(n, t, s, p);
}
void glEdgeFlagPointerEXT(GLsizei s, GLsizei k, const GLboolean *p) { (void)k; glEdgeFlagPointer(s, p); }

static int array_of(const gl_context *c, GLenum name)
{
    switch (name) {
    case GL_VERTEX_ARRAY: return ARRAY_VERTEX;
    case GL_NORMAL_ARRAY: return ARRAY_NORMAL;
    case GL_COLOR_ARRAY: return ARRAY_COLOUR;
    case GL_INDEX_ARRAY: return ARRAY_INDEX;
    case GL_EDGE_FLAG_ARRAY: return ARRAY_EDGE;
    case GL_FOG_COORD_ARRAY: return ARRAY_FOG;
    case GL_SECONDARY_COLOR_ARRAY: return ARRAY_SECOND;
    case GL_TEXTURE_COORD_ARRAY: return ARRAY_TEX + c->client.active;
    default: return -1;
    }
}

static void array_enable(GLenum name, int on)
{
    GL_ENTER()
    const int which = array_of(c, name);
    GL_FAIL(which < 0, GL_INVALID_ENUM, )
    c->client.array[which].on = on;
}
void glEnableClientState(GLenum name) { array_enable(name, 1); }
void glDisableClientState(GLenum name) { array_enable(name, 0); }

void glClientActiveTexture(GLenum t)
{
    GL_ENTER()
    GL_FAIL(t < GL_TEXTURE0 || t >= GL_TEXTURE0 + GL_UNITS, GL_INVALID_ENUM, )
    c->client.active = (int32_t)(t - GL_TEXTURE0);
}

void glInterleavedArrays(GLenum format, GLsizei stride, const void *data)
{
    GL_ENTER()
    /* values of texture, colour, normal, vertex; colour as bytes */
    static const uint8_t table[14][5] = {{0, 0, 0, 2, 0}, {0, 0, 0, 3, 0}, {0, 4, 0, 2, 1}, {0, 4, 0, 3, 1},
                                         {0, 3, 0, 3, 0}, {0, 0, 3, 3, 0}, {0, 4, 3, 3, 0}, {2, 0, 0, 3, 0},
                                         {4, 0, 0, 4, 0}, {2, 4, 0, 3, 1}, {2, 3, 0, 3, 0}, {2, 0, 3, 3, 0},
                                         {2, 4, 3, 3, 0}, {4, 4, 3, 4, 0}};
    GL_FAIL(format < GL_V2F || format > GL_T4F_C4F_N3F_V4F, GL_INVALID_ENUM, )
    GL_FAIL(stride < 0, GL_INVALID_VALUE, )
    const uint8_t *t = table[format - GL_V2F], *p = data;
    const int colour = t[4] ? 4 : 4 * t[1], size = 4 * t[0] + colour + 4 * t[2] + 4 * t[3];
    stride = stride != 0 ? stride : size;
    array_enable(GL_EDGE_FLAG_ARRAY, 0);
    array_enable(GL_INDEX_ARRAY, 0);
    array_enable(GL_TEXTURE_COORD_ARRAY, t[0] != 0);
    array_enable(GL_COLOR_ARRAY, t[1] != 0);
    array_enable(GL_NORMAL_ARRAY, t[2] != 0);
    array_enable(GL_VERTEX_ARRAY, 1);
    if (t[0] != 0) {
        glTexCoordPointer(t[0], GL_FLOAT, stride, p);
    }
    if (t[1] != 0) {
        glColorPointer(t[1], t[4] ? GL_UNSIGNED_BYTE : GL_FLOAT, stride, (const void *)((uintptr_t)p + 4u * t[0]));
    }
    if (t[2] != 0) {
        glNormalPointer(GL_FLOAT, stride, (const void *)((uintptr_t)p + 4u * t[0] + (unsigned)colour));
    }
    glVertexPointer(t[3], GL_FLOAT, stride, (const void *)((uintptr_t)p + 4u * t[0] + (unsigned)colour + 4u * t[2]));
}

/* --- elements ----------------------------------------------------------------------------------------------------- */

static float array_value(const uint8_t *p, GLenum type, int norm)
{
    int16_t s;
    uint16_t us;
    int32_t i;
    uint32_t u;
    float f;
    double d;
    switch (type) {
    case GL_BYTE: return norm ? (2.0f * (float)(int8_t)*p + 1.0f) / 255.0f : (float)(int8_t)*p;
    case GL_UNSIGNED_BYTE: return norm ? (float)*p / 255.0f : (float)*p;
    case GL_SHORT: memcpy(&s, p, 2); return norm ? (2.0f * (float)s + 1.0f) / 65535.0f : (float)s;
    case GL_UNSIGNED_SHORT: memcpy(&us, p, 2); return norm ? (float)us / 65535.0f : (float)us;
    case GL_INT: memcpy(&i, p, 4); return norm ? (float)((2.0 * (double)i + 1.0) / 4294967295.0) : (float)i;
    case GL_UNSIGNED_INT: memcpy(&u, p, 4); return norm ? (float)((double)u / 4294967295.0) : (float)u;
    case GL_DOUBLE: memcpy(&d, p, 8); return (float)d;
    default: memcpy(&f, p, 4); return f;
    }
}

/* Reads the values of element i; values that an array lacks stay unchanged. */
static void array_fetch(const gl_array *a, uint32_t i, int norm, float *out)
{
    const size_t bytes = (size_t)array_bytes(a->type), each = bytes * (size_t)a->size;
    const size_t at = (size_t)i * (a->stride != 0 ? (size_t)a->stride : each);
    const uint8_t *p = a->data;
    if (a->buffer != NULL) {
        const size_t offset = (size_t)(uintptr_t)a->data;
        if (offset > a->buffer->bytes || at > a->buffer->bytes - offset || each > a->buffer->bytes - offset - at) {
            for (int k = 0; k < a->size; ++k) {
                out[k] = 0.0f;
            }
            return;
        }
        p = a->buffer->data + offset;
    } else if (p == NULL) {
        return;
    }
    for (int k = 0; k < a->size; ++k) {
        out[k] = array_value(p + at + (size_t)k * bytes, a->type, norm);
    }
}

static void array_send(gl_context *c, int op, int unit, const float *v, int n)
{
    gl_word w[5];
    int at = 0;
    if (op == OP_tex_coord) {
        w[at++].u = GL_TEXTURE0 + (GLenum)unit;
    }
    for (int k = 0; k < n; ++k) {
        w[at++].f = v[k];
    }
    gl_do(c, op, w, at);
}

static void array_element(gl_context *c, uint32_t i)
{
    const gl_array *a = c->client.array;
    static const struct { int which, op, values, norm; } parts[] = {
        {ARRAY_NORMAL, OP_normal, 3, 1}, {ARRAY_COLOUR, OP_colour, 4, 1}, {ARRAY_SECOND, OP_second, 3, 1},
        {ARRAY_FOG, OP_fog_coord, 1, 0}, {ARRAY_EDGE, OP_edge, 1, 0}};
    for (size_t k = 0; k < sizeof parts / sizeof parts[0]; ++k) {
        if (a[parts[k].which].on) {
            float v[4] = {0.0f, 0.0f, 0.0f, 1.0f};
            array_fetch(&a[parts[k].which], i, parts[k].norm, v);
            array_send(c, parts[k].op, 0, v, parts[k].values);
        }
    }
    for (int u = 0; u < GL_UNITS; ++u) {
        if (a[ARRAY_TEX + u].on) {
            float v[4] = {0.0f, 0.0f, 0.0f, 1.0f};
            array_fetch(&a[ARRAY_TEX + u], i, 0, v);
            array_send(c, OP_tex_coord, u, v, 4);
        }
    }
    if (a[ARRAY_VERTEX].on) {
        float v[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        array_fetch(&a[ARRAY_VERTEX], i, 0, v);
        array_send(c, OP_vertex, 0, v, 4);
    }
}

void glArrayElement(GLint i)
{
    if (gl_now != NULL) {
        array_element(gl_now, (uint32_t)i);
    }
}

static uint32_t array_index(GLenum type, const uint8_t *p, size_t i)
{
    uint16_t s;
    uint32_t u;
    if (type == GL_UNSIGNED_BYTE) {
        return p[i];
    }
    if (type == GL_UNSIGNED_SHORT) {
        memcpy(&s, p + 2 * i, 2);
        return s;
    }
    memcpy(&u, p + 4 * i, 4);
    return u;
}

/* --- elements of many --------------------------------------------------------------------------------------------- */

/* An array that is on, and the floats of a vertex that it sets. */
typedef struct array_source {
    const uint8_t *p; /* NULL: element values are unset */
    uint64_t end;     /* bytes of a buffer from p on; arrays of the program's memory have no end */
    size_t stride;
    int32_t size, bytes, values, norm; /* values of an element; bytes of a value; floats set */
    GLenum type;
    size_t to; /* in gl_vertex */
} array_source;

typedef struct array_sources {
    array_source of[ARRAYS];
    int32_t count;
} array_sources;

static void array_set_source(array_sources *s, const gl_array *a, size_t to, int32_t values, int norm)
{
    array_source *d = &s->of[s->count];
    if (!a->on) {
        return;
    }
    ++s->count;
    d->size = a->size;
    d->bytes = array_bytes(a->type);
    d->stride = a->stride != 0 ? (size_t)a->stride : (size_t)(d->bytes * d->size);
    d->type = a->type;
    d->values = values;
    d->norm = norm;
    d->to = to;
    d->p = a->data;
    d->end = UINT64_MAX;
    if (a->buffer != NULL) {
        const size_t offset = (size_t)(uintptr_t)a->data;
        d->end = offset > a->buffer->bytes ? 0 : a->buffer->bytes - offset;
        d->p = d->end != 0 ? a->buffer->data + offset : a->buffer->data;
    }
}

/* The arrays that are on; that of positions is the last one. */
static void array_set_sources(array_sources *s, const gl_context *c)
{
    const gl_array *a = c->client.array;
    s->count = 0;
    array_set_source(s, &a[ARRAY_NORMAL], offsetof(gl_vertex, normal), 3, 1);
    array_set_source(s, &a[ARRAY_COLOUR], offsetof(gl_vertex, colour), 4, 1);
    array_set_source(s, &a[ARRAY_SECOND], offsetof(gl_vertex, second), 3, 1);
    array_set_source(s, &a[ARRAY_FOG], offsetof(gl_vertex, fog), 1, 0);
    array_set_source(s, &a[ARRAY_EDGE], offsetof(gl_vertex, edge), 1, 0);
    for (size_t u = 0; u < GL_UNITS; ++u) {
        array_set_source(s, &a[ARRAY_TEX + u], offsetof(gl_vertex, tex) + 4 * u * sizeof(float), 4, 0);
    }
    array_set_source(s, &a[ARRAY_VERTEX], offsetof(gl_vertex, at), 4, 0);
}

/* Reads element i; elements outside a buffer are zeros. */
static inline void array_read(const array_source *s, uint32_t i, float *to)
{
    const uint64_t at = (uint64_t)i * s->stride;
    const int is_out = at > s->end || (uint64_t)(s->bytes * s->size) > s->end - at;
    float v[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    const uint8_t *p = is_out || s->p == NULL ? NULL : s->p + at;
    if (is_out) {
        memset(v, 0, (size_t)s->size * sizeof *v);
    } else if (p == NULL) {
        /* unset */
    } else if (s->type == GL_FLOAT && s->size == 3) {
        memcpy(v, p, 3 * sizeof *v);
    } else if (s->type == GL_FLOAT && s->size == 2) {
        memcpy(v, p, 2 * sizeof *v);
    } else if (s->type == GL_UNSIGNED_BYTE && s->size == 4 && s->norm) {
        for (int k = 0; k < 4; ++k) {
            v[k] = (float)p[k] / 255.0f;
        }
    } else {
        for (int k = 0; k < s->size; ++k) {
            v[k] = array_value(p + k * s->bytes, s->type, s->norm);
        }
    }
    if (s->values == 4) {
        memcpy(to, v, 4 * sizeof *v);
    } else {
        memcpy(to, v, (size_t)s->values * sizeof *v);
    }
}

/* Sets the values of element i. */
static inline void array_read_all(gl_vertex *to, const array_sources *s, uint32_t i)
{
    for (int k = 0; k < s->count; ++k) {
        array_read(&s->of[k], i, (float *)(void *)((uint8_t *)to + s->of[k].to));
    }
}

static inline uint32_t array_name(uint32_t first, GLenum type, const uint8_t *p, size_t n)
{
    return p != NULL ? array_index(type, p, n) : first + (uint32_t)n;
}

/* The texture coordinates of all elements need no shader: with one, all triangles of a batch would take it. */
static int array_is_plain(const gl_context *c, const array_sources *s, GLsizei count, GLenum type, const uint8_t *p)
{
    const gl_matrices *m = &c->texture[0];
    const array_source *from = NULL;
    gl_vertex v = c->s.current.v;
    if (c->s.texture.unit[0].on == 0) {
        return 1;
    }
    for (int k = 0; k < s->count; ++k) {
        from = s->of[k].to == offsetof(gl_vertex, tex) ? &s->of[k] : from;
    }
    for (GLsizei i = 0; i < (from != NULL ? count : 1); ++i) {
        float t[4];
        if (from != NULL) {
            array_read(from, array_index(type, p, (size_t)i), v.tex[0]);
        }
        gl_matrix_point(t, m->m[m->top], v.tex[0]);
        if (t[3] != 1.0f) {
            return 0;
        }
    }
    return c->s.texture.unit[0].gen == 0;
}

/* The vertex of an element of this call, whose vertices begin at `from`. */
static inline uint32_t array_slot(gl_context *c, const array_sources *s, int32_t from, uint32_t name)
{
    int32_t *slot = &c->slot_of[name & (GL_SLOTS - 1)];
    if (*slot >= from && *slot < c->count && c->name_of[*slot] == name) {
        return (uint32_t)*slot;
    }
    const int32_t at = c->count++;
    gl_vertex *look = &c->look[c->looks];
    *look = c->s.current.v;
    array_read_all(look, s, name);
    c->look_from[c->looks++] = at;
    memcpy(c->at_of[at], look->at, sizeof look->at);
    c->name_of[at] = name;
    *slot = at;
    return (uint32_t)at;
}

/* Filled primitives: vertices that several share are transformed and lit once. */
static void array_draw_shared(gl_context *c, const array_sources *s, GLenum mode, uint32_t count, GLenum type,
                              const uint8_t *p)
{
    const uint32_t each = gl_order_each(mode), past = gl_order_past(mode, count);
    if (!gl_order_begin(c, mode)) {
        return;
    }
    int32_t from = c->count;
    for (uint32_t n = 0; n < past; ++n) {
        uint32_t place[4];
        if (c->count + 4 > GL_BATCH || c->orders + 4 > GL_ORDERS) {
            gl_flush_vertices(c);
            from = 0;
        }
        gl_order_places(place, mode, n);
        for (uint32_t k = 0; k < each; ++k) {
            place[k] = array_slot(c, s, from, array_index(type, p, place[k]));
        }
        memcpy(&c->order_of[c->orders], place, each * sizeof place[0]);
        c->orders += (int32_t)each;
    }
}

/* Draws elements of arrays. p: NULL: first, first + 1, ... */
static void array_run(gl_context *c, const array_sources *s, GLenum mode, uint32_t first, GLsizei count, GLenum type,
                      const uint8_t *p)
{
    const gl_word begin[2] = {{.u = mode}, {.u = 1}}, end = {.u = 1};
    if (p != NULL && !c->is_inside && gl_can_order(c, mode) && array_is_plain(c, s, count, type, p)) {
        array_draw_shared(c, s, mode, (uint32_t)count, type, p);
        return;
    }
    gl_op_begin(c, begin);
    for (GLsizei i = 0; i < count && c->is_inside; ++i) {
        gl_vertex v = c->s.current.v;
        array_read_all(&v, s, array_name(first, type, p, (size_t)i));
        gl_vertex_of(c, v.at, &v);
    }
    if (c->is_inside) {
        gl_op_end(c, &end);
    }
    c->open = 0;
}

/* p: NULL: first, first + 1, ... */
static void array_draw(gl_context *c, GLenum mode, uint32_t first, GLsizei count, GLenum type, const uint8_t *p)
{
    const gl_word begin[2] = {{.u = mode}, {.u = 1}}, end = {.u = 1};
    const gl_vertex kept = c->s.current.v;
    if (!c->client.array[ARRAY_VERTEX].on || count == 0) {
        gl_fail(c, GL_NO_ERROR); /* an error if a list runs it after glBegin */
        return;
    }
    const gl_buffer *positions = c->client.array[ARRAY_VERTEX].buffer;
    c->reads_static = positions != NULL && positions->usage == GL_STATIC_DRAW;
    if (c->list_mode == 0) {
        array_sources s;
        array_set_sources(&s, c);
        array_run(c, &s, mode, first, count, type, p);
        c->reads_static = 0;
        return;
    }
    gl_do(c, OP_begin, begin, 2);
    for (GLsizei i = 0; i < count; ++i) {
        array_element(c, array_name(first, type, p, (size_t)i));
    }
    if (c->is_inside || c->list_mode == GL_COMPILE) {
        gl_do(c, OP_end, &end, 1);
    }
    c->s.current.v = kept;
    c->open = 0;
    c->reads_static = 0;
}

void glDrawArrays(GLenum mode, GLint first, GLsizei count)
{
    GL_ENTER_LISTED()
    GL_FAIL_LISTED(mode > GL_POLYGON, GL_INVALID_ENUM)
    GL_FAIL_LISTED(count < 0 || first < 0, GL_INVALID_VALUE)
    array_draw(c, mode, (uint32_t)first, count, 0, NULL);
}

void glDrawElements(GLenum mode, GLsizei count, GLenum type, const void *indices)
{
    GL_ENTER_LISTED()
    const uint8_t *p = indices;
    const gl_buffer *b = c->client.bound_elements;
    GL_FAIL_LISTED(mode > GL_POLYGON ||
                       (type != GL_UNSIGNED_BYTE && type != GL_UNSIGNED_SHORT && type != GL_UNSIGNED_INT),
                   GL_INVALID_ENUM)
    GL_FAIL_LISTED(count < 0, GL_INVALID_VALUE)
    if (b != NULL) {
        const size_t offset = (size_t)(uintptr_t)indices, bytes = (size_t)count * (size_t)gl_type_bytes(type);
        GL_FAIL_LISTED(offset > b->bytes || bytes > b->bytes - offset, GL_INVALID_OPERATION)
        p = b->data + offset;
    }
    if (p != NULL) {
        array_draw(c, mode, 0, count, type, p);
    }
}

void glDrawRangeElements(GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type, const void *indices)
{
    GL_ENTER_LISTED()
    GL_FAIL_LISTED(end < start, GL_INVALID_VALUE)
    glDrawElements(mode, count, type, indices);
}

void glMultiDrawArrays(GLenum mode, const GLint *first, const GLsizei *count, GLsizei n)
{
    GL_ENTER_LISTED()
    GL_FAIL_LISTED(n < 0, GL_INVALID_VALUE)
    for (GLsizei i = 0; i < n; ++i) {
        GL_FAIL_LISTED(count[i] < 0, GL_INVALID_VALUE)
    }
    for (GLsizei i = 0; i < n; ++i) {
        glDrawArrays(mode, first[i], count[i]);
    }
}

void glMultiDrawElements(GLenum mode, const GLsizei *count, GLenum type, const void *const *indices, GLsizei n)
{
    GL_ENTER_LISTED()
    GL_FAIL_LISTED(n < 0, GL_INVALID_VALUE)
    for (GLsizei i = 0; i < n; ++i) {
        GL_FAIL_LISTED(count[i] < 0, GL_INVALID_VALUE)
    }
    for (GLsizei i = 0; i < n; ++i) {
        glDrawElements(mode, count[i], type, indices[i]);
    }
}

void glLockArraysEXT(GLint first, GLsizei count) { (void)first; (void)count; }
void glUnlockArraysEXT(void) {}

void glGetPointerv(GLenum name, void **out)
{
    GL_ENTER()
    static const struct { GLenum name; int which;
    } names[] = {{GL_VERTEX_ARRAY_POINTER, ARRAY_VERTEX},          {GL_NORMAL_ARRAY_POINTER, ARRAY_NORMAL},
                 {GL_COLOR_ARRAY_POINTER, ARRAY_COLOUR},           {GL_INDEX_ARRAY_POINTER, ARRAY_INDEX},
                 {GL_EDGE_FLAG_ARRAY_POINTER, ARRAY_EDGE},         {GL_FOG_COORD_ARRAY_POINTER, ARRAY_FOG},
                 {GL_SECONDARY_COLOR_ARRAY_POINTER, ARRAY_SECOND}, {GL_TEXTURE_COORD_ARRAY_POINTER, ARRAY_TEX}};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        if (names[i].name == name) {
            *out = (void *)(uintptr_t)c->client
                       .array[names[i].which + (names[i].which == ARRAY_TEX ? c->client.active : 0)]
                       .data;
            return;
        }
    }
    if (name == GL_SELECTION_BUFFER_POINTER) {
        *out = c->select;
    } else if (name == GL_FEEDBACK_BUFFER_POINTER) {
        *out = c->feedback;
    } else {
        gl_error(c, GL_INVALID_ENUM);
    }
}

/* --- buffers ------------------------------------------------------------------------------------------------------ */

static gl_buffer **array_bound(gl_context *c, GLenum target)
{
    return target == GL_ARRAY_BUFFER           ? &c->client.bound
           : target == GL_ELEMENT_ARRAY_BUFFER ? &c->client.bound_elements
                                               : NULL;
}

void glGenBuffers(GLsizei n, GLuint *names)
{
    GL_ENTER()
    GL_FAIL(n < 0, GL_INVALID_VALUE, )
    const GLuint first = gl_new_names(c, &c->group->buffers, n);
    for (GLsizei i = 0; i < n && first != 0; ++i) {
        names[i] = first + (GLuint)i;
    }
}

void glBindBuffer(GLenum target, GLuint name)
{
    GL_ENTER()
    gl_buffer **bound = array_bound(c, target);
    GL_FAIL(bound == NULL, GL_INVALID_ENUM, )
    gl_buffer *b = gl_find(&c->group->buffers, name);
    if (name != 0 && b == NULL) {
        b = gl_alloc(c, sizeof *b);
        if (b == NULL || !gl_put(c, &c->group->buffers, name, b)) {
            return;
        }
        memset(b, 0, sizeof *b);
        b->name = name;
        b->usage = GL_STATIC_DRAW;
        b->access = GL_READ_WRITE;
    }
    *bound = name != 0 ? b : NULL;
}

void glDeleteBuffers(GLsizei n, const GLuint *names)
{
    GL_ENTER()
    GL_FAIL(n < 0, GL_INVALID_VALUE, )
    for (GLsizei i = 0; i < n; ++i) {
        gl_buffer *b = gl_find(&c->group->buffers, names[i]);
        gl_remove(&c->group->buffers, names[i]);
        if (b == NULL) {
            continue;
        }
        for (int k = 0; k < ARRAYS; ++k) {
            if (c->client.array[k].buffer == b) {
                c->client.array[k].buffer = NULL;
                c->client.array[k].data = NULL;
            }
        }
        c->client.bound = c->client.bound == b ? NULL : c->client.bound;
        c->client.bound_elements = c->client.bound_elements == b ? NULL : c->client.bound_elements;
        for (int s = 0; s < c->client_count; ++s) {
            gl_client *old = &c->client_saved[s];
            for (int k = 0; k < ARRAYS; ++k) {
                if (old->array[k].buffer == b) {
                    old->array[k].buffer = NULL;
                    old->array[k].data = NULL;
                }
            }
            old->bound = old->bound == b ? NULL : old->bound;
            old->bound_elements = old->bound_elements == b ? NULL : old->bound_elements;
        }
        gl_free(c, b->data);
        gl_free(c, b);
    }
}

GLboolean glIsBuffer(GLuint name)
{
    GL_ENTER(0)
    return gl_find(&c->group->buffers, name) != NULL;
}

#define BOUND(result) \
    GL_ENTER(result) \
    gl_buffer **at = array_bound(c, target); \
    GL_FAIL(at == NULL, GL_INVALID_ENUM, result) \
    gl_buffer *b = *at; \
    GL_FAIL(b == NULL, GL_INVALID_OPERATION, result)

void glBufferData(GLenum target, GLsizeiptr bytes, const void *data, GLenum usage)
{
    GL_ENTER()
    gl_buffer **at = array_bound(c, target);
    GL_FAIL(at == NULL || usage < GL_STREAM_DRAW || usage > GL_DYNAMIC_COPY || (usage & 3u) == 3u, GL_INVALID_ENUM, )
    GL_FAIL(bytes < 0, GL_INVALID_VALUE, )
    gl_buffer *b = *at;
    GL_FAIL(b == NULL, GL_INVALID_OPERATION, )
    uint8_t *more = gl_alloc(c, (size_t)bytes + 1);
    if (more == NULL) {
        return;
    }
    gl_free(c, b->data);
    b->data = more;
    b->bytes = (size_t)bytes;
    b->usage = usage;
    b->is_mapped = 0;
    if (data != NULL) {
        memcpy(more, data, b->bytes);
    } else {
        memset(more, 0, b->bytes);
    }
}

static int array_fits(const gl_buffer *b, GLintptr offset, GLsizeiptr bytes)
{
    return offset >= 0 && bytes >= 0 && (size_t)offset <= b->bytes && (size_t)bytes <= b->bytes - (size_t)offset;
}

void glBufferSubData(GLenum target, GLintptr offset, GLsizeiptr bytes, const void *data)
{
    BOUND()
    GL_FAIL(!array_fits(b, offset, bytes), GL_INVALID_VALUE, )
    GL_FAIL(b->is_mapped, GL_INVALID_OPERATION, )
    if (bytes > 0 && data != NULL) {
        memcpy(b->data + offset, data, (size_t)bytes);
    }
}

void glGetBufferSubData(GLenum target, GLintptr offset, GLsizeiptr bytes, void *data)
{
    BOUND()
    GL_FAIL(!array_fits(b, offset, bytes), GL_INVALID_VALUE, )
    GL_FAIL(b->is_mapped, GL_INVALID_OPERATION, )
    if (bytes > 0 && data != NULL) {
        memcpy(data, b->data + offset, (size_t)bytes);
    }
}

void *glMapBuffer(GLenum target, GLenum access)
{
    BOUND(NULL)
    GL_FAIL(access < GL_READ_ONLY || access > GL_READ_WRITE, GL_INVALID_ENUM, NULL)
    GL_FAIL(b->is_mapped || b->data == NULL, GL_INVALID_OPERATION, NULL)
    b->is_mapped = 1;
    b->access = access;
    return b->data;
}

GLboolean glUnmapBuffer(GLenum target)
{
    BOUND(0)
    GL_FAIL(!b->is_mapped, GL_INVALID_OPERATION, 0)
    b->is_mapped = 0;
    return 1;
}

void glGetBufferParameteriv(GLenum target, GLenum name, GLint *out)
{
    BOUND()
    switch (name) {
    case GL_BUFFER_SIZE: *out = (GLint)b->bytes; break;
    case GL_BUFFER_USAGE: *out = (GLint)b->usage; break;
    case GL_BUFFER_ACCESS: *out = (GLint)b->access; break;
    case GL_BUFFER_MAPPED: *out = b->is_mapped; break;
    default: gl_error(c, GL_INVALID_ENUM); break;
    }
}

void glGetBufferPointerv(GLenum target, GLenum name, void **out)
{
    BOUND()
    GL_FAIL(name != GL_BUFFER_MAP_POINTER, GL_INVALID_ENUM, )
    *out = b->is_mapped ? b->data : NULL;
}
