/* gl_call.c: entry points of all calls that a display list can hold, with their type variants.
 *
 * A variant converts its arguments to floats or ints and passes them on as words. */
#include "gl_context.h"

#define F(v) {.f = (float)(v)}
#define I(v) {.i = (int32_t)(v)}
#define U(v) {.u = (uint32_t)(v)}
#define DO(op, ...) \
    do { \
        if (gl_now != NULL) { \
            const gl_word words_of[] = {__VA_ARGS__}; \
            gl_do(gl_now, OP_##op, words_of, (int32_t)(sizeof words_of / sizeof words_of[0])); \
        } \
    } while (0)
#define DO_0(op) do { if (gl_now != NULL) gl_do(gl_now, OP_##op, NULL, 0); } while (0)

/* Integers to -1 .. 1 or 0 .. 1. */
#define NORM_b(v) ((2.0f * (float)(v) + 1.0f) / 255.0f)
#define NORM_s(v) ((2.0f * (float)(v) + 1.0f) / 65535.0f)
#define NORM_i(v) ((float)((2.0 * (double)(v) + 1.0) / 4294967295.0))
#define NORM_f(v) (v)
#define NORM_d(v) ((float)(v))
#define NORM_ub(v) ((float)(v) / 255.0f)
#define NORM_us(v) ((float)(v) / 65535.0f)
#define NORM_ui(v) ((float)((double)(v) / 4294967295.0))
#define PLAIN(v) ((float)(v))

/* --- vertices ----------------------------------------------------------------------------------------------------- */

static void call_vertex(float x, float y, float z, float w)
{
    gl_context *c = gl_now;
    if (c == NULL) {
        return;
    }
    if (c->count < c->open) {
        float *to = c->at_of[c->count++];
        to[0] = x;
        to[1] = y;
        to[2] = z;
        to[3] = w;
        return;
    }
    const float at[4] = {x, y, z, w};
    if (c->list_mode == 0) {
        gl_vertex_at(c, at);
    } else {
        gl_list_vertex(c, at);
    }
}

/* The current values, if a call sets them at once; NULL: a list is compiled, or there is no context. */
static inline gl_vertex *call_current(void)
{
    gl_context *c = gl_now;
    if (c == NULL || c->list_mode != 0) {
        return NULL;
    }
    c->open = 0;
    return &c->s.current.v;
}

static void call_colour(float r, float g, float b, float a)
{
    gl_vertex *v = call_current();
    if (v == NULL) {
        DO(colour, F(r), F(g), F(b), F(a));
        return;
    }
    v->colour[0] = r;
    v->colour[1] = g;
    v->colour[2] = b;
    v->colour[3] = a;
}

static void call_normal(float x, float y, float z)
{
    gl_vertex *v = call_current();
    if (v == NULL) {
        DO(normal, F(x), F(y), F(z));
        return;
    }
    v->normal[0] = x;
    v->normal[1] = y;
    v->normal[2] = z;
}

static void call_tex(GLenum unit, float s, float t, float r, float q)
{
    DO(tex_coord, U(unit), F(s), F(t), F(r), F(q));
}
static void call_tex_2(float s, float t)
{
    gl_vertex *v = call_current();
    if (v == NULL) {
        DO(tex_coord_2, F(s), F(t));
        return;
    }
    v->tex[0][0] = s;
    v->tex[0][1] = t;
    v->tex[0][2] = 0.0f;
    v->tex[0][3] = 1.0f;
}
static void call_raster(float x, float y, float z, float w) { DO(raster_pos, F(x), F(y), F(z), F(w)); }
static void call_window(float x, float y, float z) { DO(window_pos, F(x), F(y), F(z)); }
static void call_second(float r, float g, float b) { DO(second, F(r), F(g), F(b)); }

/* NAME2..4 of a type and of pointers to it. */
#define FOUR(name, call, t, T) \
    void name##2##t(T x, T y) { call((float)x, (float)y, 0.0f, 1.0f); } \
    void name##3##t(T x, T y, T z) { call((float)x, (float)y, (float)z, 1.0f); } \
    void name##4##t(T x, T y, T z, T w) { call((float)x, (float)y, (float)z, (float)w); } \
    void name##2##t##v(const T *v) { name##2##t(v[0], v[1]); } \
    void name##3##t##v(const T *v) { name##3##t(v[0], v[1], v[2]); } \
    void name##4##t##v(const T *v) { name##4##t(v[0], v[1], v[2], v[3]); }
#define TYPES(X, ...) \
    X(__VA_ARGS__, s, GLshort) X(__VA_ARGS__, i, GLint) X(__VA_ARGS__, f, GLfloat) X(__VA_ARGS__, d, GLdouble)
TYPES(FOUR, glVertex, call_vertex)
TYPES(FOUR, glRasterPos, call_raster)

#define WINDOW(name, call, t, T) \
    void name##2##t(T x, T y) { call((float)x, (float)y, 0.0f); } \
    void name##3##t(T x, T y, T z) { call((float)x, (float)y, (float)z); } \
    void name##2##t##v(const T *v) { name##2##t(v[0], v[1]); } \
    void name##3##t##v(const T *v) { name##3##t(v[0], v[1], v[2]); }
TYPES(WINDOW, glWindowPos, call_window)

#define TEX(name, call, t, T) \
    void glTexCoord1##t(T s) { call_tex(GL_TEXTURE0, (float)s, 0.0f, 0.0f, 1.0f); } \
    void glTexCoord2##t(T s, T u) { call_tex_2((float)s, (float)u); } \
    void glTexCoord3##t(T s, T u, T r) { call_tex(GL_TEXTURE0, (float)s, (float)u, (float)r, 1.0f); } \
    void glTexCoord4##t(T s, T u, T r, T q) { call_tex(GL_TEXTURE0, (float)s, (float)u, (float)r, (float)q); } \
    void glTexCoord1##t##v(const T *v) { glTexCoord1##t(v[0]); } \
    void glTexCoord2##t##v(const T *v) { glTexCoord2##t(v[0], v[1]); } \
    void glTexCoord3##t##v(const T *v) { glTexCoord3##t(v[0], v[1], v[2]); } \
    void glTexCoord4##t##v(const T *v) { glTexCoord4##t(v[0], v[1], v[2], v[3]); } \
    void glMultiTexCoord1##t(GLenum n, T s) { call_tex(n, (float)s, 0.0f, 0.0f, 1.0f); } \
    void glMultiTexCoord2##t(GLenum n, T s, T u) { call_tex(n, (float)s, (float)u, 0.0f, 1.0f); } \
    void glMultiTexCoord3##t(GLenum n, T s, T u, T r) { call_tex(n, (float)s, (float)u, (float)r, 1.0f); } \
    void glMultiTexCoord4##t(GLenum n, T s, T u, T r, T q) { call_tex(n, (float)s, (float)u, (float)r, (float)q); } \
    void glMultiTexCoord1##t##v(GLenum n, const T *v) { glMultiTexCoord1##t(n, v[0]); } \
    void glMultiTexCoord2##t##v(GLenum n, const T *v) { glMultiTexCoord2##t(n, v[0], v[1]); } \
    void glMultiTexCoord3##t##v(GLenum n, const T *v) { glMultiTexCoord3##t(n, v[0], v[1], v[2]); } \
    void glMultiTexCoord4##t##v(GLenum n, const T *v) { glMultiTexCoord4##t(n, v[0], v[1], v[2], v[3]); }
TYPES(TEX, , )

#define COLOUR(t, T) \
    void glColor3##t(T r, T g, T b) { call_colour(NORM_##t(r), NORM_##t(g), NORM_##t(b), 1.0f); } \
    void glColor4##t(T r, T g, T b, T a) { call_colour(NORM_##t(r), NORM_##t(g), NORM_##t(b), NORM_##t(a)); } \
    void glColor3##t##v(const T *v) { glColor3##t(v[0], v[1], v[2]); } \
    void glColor4##t##v(const T *v) { glColor4##t(v[0], v[1], v[2], v[3]); } \
    void glSecondaryColor3##t(T r, T g, T b) { call_second(NORM_##t(r), NORM_##t(g), NORM_##t(b)); } \
    void glSecondaryColor3##t##v(const T *v) { glSecondaryColor3##t(v[0], v[1], v[2]); }
COLOUR(b, GLbyte) COLOUR(s, GLshort) COLOUR(i, GLint) COLOUR(f, GLfloat) COLOUR(d, GLdouble) COLOUR(ub, GLubyte)
COLOUR(us, GLushort) COLOUR(ui, GLuint)

#define NORMAL(t, T) \
    void glNormal3##t(T x, T y, T z) { call_normal(NORM_##t(x), NORM_##t(y), NORM_##t(z)); } \
    void glNormal3##t##v(const T *v) { glNormal3##t(v[0], v[1], v[2]); }
NORMAL(b, GLbyte) NORMAL(s, GLshort) NORMAL(i, GLint) NORMAL(f, GLfloat) NORMAL(d, GLdouble)

void glFogCoordf(GLfloat v) { DO(fog_coord, F(v)); }
void glFogCoordd(GLdouble v) { DO(fog_coord, F(v)); }
void glFogCoordfv(const GLfloat *v) { DO(fog_coord, F(*v)); }
void glFogCoorddv(const GLdouble *v) { DO(fog_coord, F(*v)); }
void glEdgeFlag(GLboolean v) { DO(edge, F(v != 0)); }
void glEdgeFlagv(const GLboolean *v) { DO(edge, F(*v != 0)); }

#define RECT(name, call, t, T) \
    void glRect##t(T x1, T y1, T x2, T y2) { DO(rect, F(x1), F(y1), F(x2), F(y2)); } \
    void glRect##t##v(const T *a, const T *b) { glRect##t(a[0], a[1], b[0], b[1]); }
TYPES(RECT, , )

void glBegin(GLenum mode) { DO(begin, U(mode), U(0)); }
void glEnd(void) { DO(end, U(0)); }

/* --- parameters with one or more values --------------------------------------------------------------------------- */

/* Number of values of a parameter. */
static int call_values(GLenum name)
{
    switch (name) {
    case GL_AMBIENT: case GL_DIFFUSE: case GL_SPECULAR: case GL_EMISSION: case GL_POSITION: case GL_AMBIENT_AND_DIFFUSE:
    case GL_LIGHT_MODEL_AMBIENT: case GL_FOG_COLOR: case GL_TEXTURE_ENV_COLOR: case GL_TEXTURE_BORDER_COLOR:
    case GL_OBJECT_PLANE: case GL_EYE_PLANE: case GL_TEXTURE_SWIZZLE_RGBA_EXT:
        return 4;
    case GL_SPOT_DIRECTION: case GL_COLOR_INDEXES: case GL_POINT_DISTANCE_ATTENUATION:
        return 3;
    default:
        return 1;
    }
}

static int call_is_colour(GLenum name)
{
    return call_values(name) == 4 && name != GL_POSITION && name != GL_OBJECT_PLANE && name != GL_EYE_PLANE &&
           name != GL_TEXTURE_SWIZZLE_RGBA_EXT;
}

#define FILL(v, name) \
    float f[4] = {0.0f, 0.0f, 0.0f, 0.0f}; \
    for (int k = 0; k < call_values(name); ++k) f[k] = (float)(v)[k]
#define FILL_INT(v, name) \
    float f[4] = {0.0f, 0.0f, 0.0f, 0.0f}; \
    for (int k = 0; k < call_values(name); ++k) f[k] = call_is_colour(name) ? NORM_i((v)[k]) : (float)(v)[k]
/* Calls (A, name, values): one float or int, several. If a scalar sets a vector parameter, zeros follow. */
#define PARAMETERS_2(call, op) \
    static void op##_of(GLenum a, GLenum n, const float f[4]) \
    { \
        DO(op, U(a), U(n), F(f[0]), F(f[1]), F(f[2]), F(f[3])); \
    } \
    static void op##_one(GLenum a, GLenum n, float v) \
    { \
        const float f[4] = {v, 0.0f, 0.0f, 0.0f}; \
        op##_of(a, n, f); \
    } \
    void call##f(GLenum a, GLenum n, GLfloat v) { op##_one(a, n, v); } \
    void call##i(GLenum a, GLenum n, GLint v) { op##_one(a, n, (float)v); } \
    void call##fv(GLenum a, GLenum n, const GLfloat *v) \
    { \
        FILL(v, n); \
        op##_of(a, n, f); \
    } \
    void call##iv(GLenum a, GLenum n, const GLint *v) \
    { \
        FILL_INT(v, n); \
        op##_of(a, n, f); \
    }
PARAMETERS_2(glLight, light)
PARAMETERS_2(glMaterial, material)
PARAMETERS_2(glTexEnv, tex_env)
PARAMETERS_2(glTexGen, tex_gen)
PARAMETERS_2(glTexParameter, tex_parameter)
void glTexGend(GLenum a, GLenum n, GLdouble v) { glTexGenf(a, n, (float)v); }
void glTexGendv(GLenum a, GLenum n, const GLdouble *v) { FILL(v, n); glTexGenfv(a, n, f); }

#define PARAMETERS_1(call, op) \
    static void op##_of(GLenum n, const float f[4]) { DO(op, U(n), F(f[0]), F(f[1]), F(f[2]), F(f[3])); } \
    static void op##_one(GLenum n, float v) \
    { \
        const float f[4] = {v, 0.0f, 0.0f, 0.0f}; \
        op##_of(n, f); \
    } \
    void call##f(GLenum n, GLfloat v) { op##_one(n, v); } \
    void call##i(GLenum n, GLint v) { op##_one(n, (float)v); } \
    void call##fv(GLenum n, const GLfloat *v) { FILL(v, n); op##_of(n, f); } \
    void call##iv(GLenum n, const GLint *v) { FILL_INT(v, n); op##_of(n, f); }
PARAMETERS_1(glLightModel, light_model)
PARAMETERS_1(glFog, fog)
PARAMETERS_1(glPointParameter, point_parameter)
void glPixelTransferf(GLenum n, GLfloat v) { DO(pixel_transfer, U(n), F(v)); }
void glPixelTransferi(GLenum n, GLint v) { DO(pixel_transfer, U(n), F(v)); }

/* --- plain state -------------------------------------------------------------------------------------------------- */

static int call_is_array(GLenum cap)
{
    return (cap >= GL_VERTEX_ARRAY && cap <= GL_EDGE_FLAG_ARRAY) || cap == GL_FOG_COORD_ARRAY ||
           cap == GL_SECONDARY_COLOR_ARRAY;
}

/* GL_EXT_vertex_array switches arrays by these calls too; lists do not hold that. */
void glEnable(GLenum cap)
{
    if (call_is_array(cap)) {
        glEnableClientState(cap);
    } else {
        DO(enable, U(cap), I(1));
    }
}

void glDisable(GLenum cap)
{
    if (call_is_array(cap)) {
        glDisableClientState(cap);
    } else {
        DO(enable, U(cap), I(0));
    }
}
void glAlphaFunc(GLenum f, GLclampf v) { DO(alpha_func, U(f), F(v)); }
void glBlendFunc(GLenum s, GLenum d) { DO(blend_func, U(s), U(d), U(s), U(d)); }
void glBlendFuncSeparate(GLenum s, GLenum d, GLenum sa, GLenum da) { DO(blend_func, U(s), U(d), U(sa), U(da)); }
void glBlendEquation(GLenum e) { DO(blend_equation, U(e), U(e)); }
void glBlendEquationSeparateEXT(GLenum rgb, GLenum alpha) { DO(blend_equation, U(rgb), U(alpha)); }
void glBlendColor(GLclampf r, GLclampf g, GLclampf b, GLclampf a) { DO(blend_colour, F(r), F(g), F(b), F(a)); }
void glClear(GLbitfield bits) { DO(clear, U(bits)); }
void glClearColor(GLclampf r, GLclampf g, GLclampf b, GLclampf a) { DO(clear_colour, F(r), F(g), F(b), F(a)); }
void glClearDepth(GLclampd d) { DO(clear_depth, F(d)); }
void glClearStencil(GLint s) { DO(clear_stencil, I(s)); }
void glClearAccum(GLfloat r, GLfloat g, GLfloat b, GLfloat a) { DO(clear_accum, F(r), F(g), F(b), F(a)); }
void glColorMask(GLboolean r, GLboolean g, GLboolean b, GLboolean a)
{
    DO(colour_mask, U((r != 0) | (g != 0) << 1 | (b != 0) << 2 | (a != 0) << 3));
}
void glColorMaterial(GLenum face, GLenum mode) { DO(colour_material, U(face), U(mode)); }
void glCullFace(GLenum m) { DO(cull_face, U(m)); }
void glDepthFunc(GLenum f) { DO(depth_func, U(f)); }
void glDepthMask(GLboolean m) { DO(depth_mask, U(m != 0)); }
void glDepthRange(GLclampd n, GLclampd f) { DO(depth_range, F(n), F(f)); }
void glDrawBuffer(GLenum b) { DO(draw_buffer, U(b)); }
void glReadBuffer(GLenum b) { DO(read_buffer, U(b)); }
void glFrontFace(GLenum m) { DO(front_face, U(m)); }
void glHint(GLenum t, GLenum m) { DO(hint, U(t), U(m)); }
void glLineStipple(GLint f, GLushort p) { DO(line_stipple, I(f), U(p)); }
void glLineWidth(GLfloat w) { DO(line_width, F(w)); }
void glListBase(GLuint b) { DO(list_base, U(b)); }
void glLogicOp(GLenum o) { DO(logic_op, U(o)); }
void glPixelZoom(GLfloat x, GLfloat y) { DO(pixel_zoom, F(x), F(y)); }
void glPointSize(GLfloat s) { DO(point_size, F(s)); }
void glPolygonMode(GLenum f, GLenum m) { DO(polygon_mode, U(f), U(m)); }
void glPolygonOffset(GLfloat f, GLfloat u) { DO(polygon_offset, F(f), F(u)); }
void glPolygonOffsetEXT(GLfloat f, GLfloat u) { DO(polygon_offset, F(f), F(u * 16777215.0f)); }
void glPushAttrib(GLbitfield m) { DO(push_attrib, U(m)); }
void glPopAttrib(void) { DO_0(pop_attrib); }
void glScissor(GLint x, GLint y, GLsizei w, GLsizei h) { DO(scissor, I(x), I(y), I(w), I(h)); }
void glShadeModel(GLenum m) { DO(shade_model, U(m)); }
void glStencilFunc(GLenum f, GLint r, GLuint m) { DO(stencil_func, U(f), I(r), U(m)); }
void glStencilMask(GLuint m) { DO(stencil_mask, U(m)); }
void glStencilOp(GLenum a, GLenum b, GLenum d) { DO(stencil_op, U(a), U(b), U(d)); }
void glBindTexture(GLenum t, GLuint n) { DO(bind_texture, U(t), U(n)); }
void glActiveTexture(GLenum t) { DO(active_texture, U(t)); }
void glViewport(GLint x, GLint y, GLsizei w, GLsizei h) { DO(viewport, I(x), I(y), I(w), I(h)); }
void glAccum(GLenum o, GLfloat v) { DO(accum, U(o), F(v)); }
void glInitNames(void) { DO_0(init_names); }
void glLoadName(GLuint n) { DO(load_name, U(n)); }
void glPushName(GLuint n) { DO(push_name, U(n)); }
void glPopName(void) { DO_0(pop_name); }
void glPassThrough(GLfloat v) { DO(pass_through, F(v)); }
void glSampleCoverage(GLclampf v, GLboolean invert) { DO(sample_coverage, F(v), I(invert != 0)); }
void glClipPlane(GLenum p, const GLdouble *e) { DO(clip_plane, U(p), F(e[0]), F(e[1]), F(e[2]), F(e[3])); }
void glCallList(GLuint n) { DO(call_list, U(n)); }
void glBeginQuery(GLenum t, GLuint n) { DO(begin_query, U(t), U(n)); }
void glEndQuery(GLenum t) { DO(end_query, U(t)); }
void glPrioritizeTextures(GLsizei n, const GLuint *names, const GLclampf *p)
{
    for (GLsizei i = 0; i < n; ++i) {
        DO(prioritize, U(names[i]), F(p[i]));
    }
    if (n < 0 && gl_now != NULL) {
        gl_fail(gl_now, GL_INVALID_VALUE);
    }
}

static uint32_t call_list_name(GLenum type, const void *names, size_t i)
{
    const uint8_t *b = names;
    switch (type) {
    case GL_BYTE: return (uint32_t)((const int8_t *)names)[i];
    case GL_UNSIGNED_BYTE: return b[i];
    case GL_SHORT: return (uint32_t)((const int16_t *)names)[i];
    case GL_UNSIGNED_SHORT: return ((const uint16_t *)names)[i];
    case GL_INT: case GL_UNSIGNED_INT: return ((const uint32_t *)names)[i];
    case GL_FLOAT: return (uint32_t)gl_int(((const float *)names)[i]);
    case GL_2_BYTES: return (uint32_t)b[2 * i] << 8 | b[2 * i + 1];
    case GL_3_BYTES: return (uint32_t)b[3 * i] << 16 | (uint32_t)b[3 * i + 1] << 8 | b[3 * i + 2];
    default:
        return (uint32_t)b[4 * i] << 24 | (uint32_t)b[4 * i + 1] << 16 | (uint32_t)b[4 * i + 2] << 8 | b[4 * i + 3];
    }
}

/* Each name is an operation, which adds the list base when it runs. */
void glCallLists(GLsizei n, GLenum type, const void *names)
{
    gl_context *c = gl_now;
    if (c == NULL) {
        return;
    }
    GL_FAIL_LISTED(n < 0, GL_INVALID_VALUE)
    GL_FAIL_LISTED(type < GL_BYTE || type > GL_4_BYTES, GL_INVALID_ENUM)
    for (size_t i = 0; i < (size_t)n; ++i) {
        DO(call_lists, U(call_list_name(type, names, i)));
    }
}

static void call_with_data(int op, gl_word *w, int32_t words, const void *data, size_t bytes)
{
    if (gl_now != NULL) {
        gl_do_data(gl_now, op, w, words, data, bytes);
    }
}

void glPolygonStipple(const GLubyte *mask)
{
    uint8_t bits[128];
    gl_word w[2];
    GL_ENTER_LISTED()
    const gl_store *s = &c->client.unpack;
    const size_t row = (size_t)((s->row > 0 ? s->row : 32) + 7) / 8, align = (size_t)s->align,
                 stride = (row + align - 1) / align * align;
    for (size_t i = 0; i < 128; ++i) {
        const uint8_t *from = mask + stride * (i / 4 + (size_t)s->rows);
        uint8_t byte = 0;
        for (size_t b = 0; b < 8; ++b) {
            const size_t at = i % 4 * 8 + b + (size_t)s->pixels;
            const int bit = s->lsb ? from[at / 8] >> (at & 7) & 1 : from[at / 8] >> (7 - (at & 7)) & 1;
            byte = (uint8_t)(byte << 1 | bit);
        }
        bits[i] = byte;
    }
    call_with_data(OP_polygon_stipple, w, 2, bits, 128);
}

static void call_pixel_map(GLenum map, GLsizei n, const float *v)
{
    gl_word w[4] = {U(map), I(n)};
    call_with_data(OP_pixel_map, w, 4, v, (size_t)n * sizeof *v);
}

#define PIXEL_MAP(t, T, NORM) \
    void glPixelMap##t(GLenum map, GLsizei n, const T *v) \
    { \
        float f[GL_PIXEL_MAP] = {0.0f}; \
        GL_ENTER_LISTED() \
        GL_FAIL_LISTED(n < 1 || n > GL_PIXEL_MAP, GL_INVALID_VALUE) \
        const int index = map == GL_PIXEL_MAP_I_TO_I || map == GL_PIXEL_MAP_S_TO_S; \
        for (int i = 0; i < n; ++i) f[i] = index ? (float)v[i] : NORM(v[i]); \
        call_pixel_map(map, n, f); \
    }
PIXEL_MAP(fv, GLfloat, NORM_f) PIXEL_MAP(uiv, GLuint, NORM_ui) PIXEL_MAP(usv, GLushort, NORM_us)

/* --- matrices ----------------------------------------------------------------------------------------------------- */

static void call_matrix(int op, const float *m)
{
    gl_word w[16];
    memcpy(w, m, sizeof w);
    if (gl_now != NULL) {
        gl_do(gl_now, op, w, 16);
    }
}

static void call_matrix_d(int op, const double *m, int turns)
{
    float f[16];
    for (int i = 0; i < 16; ++i) {
        f[i] = (float)m[turns ? i % 4 * 4 + i / 4 : i];
    }
    call_matrix(op, f);
}

static void call_matrix_turned(int op, const float *m)
{
    float f[16];
    for (int i = 0; i < 16; ++i) {
        f[i] = m[i % 4 * 4 + i / 4];
    }
    call_matrix(op, f);
}

void glLoadMatrixf(const GLfloat *m) { call_matrix(OP_load_matrix, m); }
void glLoadMatrixd(const GLdouble *m) { call_matrix_d(OP_load_matrix, m, 0); }
void glMultMatrixf(const GLfloat *m) { call_matrix(OP_mult_matrix, m); }
void glMultMatrixd(const GLdouble *m) { call_matrix_d(OP_mult_matrix, m, 0); }
void glLoadTransposeMatrixf(const GLfloat m[16]) { call_matrix_turned(OP_load_matrix, m); }
void glLoadTransposeMatrixd(const GLdouble m[16]) { call_matrix_d(OP_load_matrix, m, 1); }
void glMultTransposeMatrixf(const GLfloat m[16]) { call_matrix_turned(OP_mult_matrix, m); }
void glMultTransposeMatrixd(const GLdouble m[16]) { call_matrix_d(OP_mult_matrix, m, 1); }
void glLoadIdentity(void)
{
    static const float one[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    call_matrix(OP_load_matrix, one);
}
void glMatrixMode(GLenum m) { DO(matrix_mode, U(m)); }
void glPushMatrix(void) { DO_0(push_matrix); }
void glPopMatrix(void) { DO_0(pop_matrix); }

void glOrtho(GLdouble l, GLdouble r, GLdouble b, GLdouble t, GLdouble n, GLdouble f)
{
    if (gl_now != NULL && (l == r || b == t || n == f)) {
        gl_fail(gl_now, GL_INVALID_VALUE);
        return;
    }
    const double m[16] = {2 / (r - l), 0, 0, 0, 0, 2 / (t - b), 0, 0, 0, 0, -2 / (f - n), 0,
                          -(r + l) / (r - l), -(t + b) / (t - b), -(f + n) / (f - n), 1};
    call_matrix_d(OP_mult_matrix, m, 0);
}

void glFrustum(GLdouble l, GLdouble r, GLdouble b, GLdouble t, GLdouble n, GLdouble f)
{
    if (gl_now != NULL && (l == r || b == t || n == f || n <= 0 || f <= 0)) {
        gl_fail(gl_now, GL_INVALID_VALUE);
        return;
    }
    const double m[16] = {2 * n / (r - l), 0, 0, 0, 0, 2 * n / (t - b), 0, 0,
                          (r + l) / (r - l), (t + b) / (t - b), -(f + n) / (f - n), -1, 0, 0, -2 * f * n / (f - n), 0};
    call_matrix_d(OP_mult_matrix, m, 0);
}

void glTranslatef(GLfloat x, GLfloat y, GLfloat z)
{
    const float m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
    call_matrix(OP_mult_matrix, m);
}

void glScalef(GLfloat x, GLfloat y, GLfloat z)
{
    const float m[16] = {x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1};
    call_matrix(OP_mult_matrix, m);
}

/* Whole quarter turns are exact. */
void glRotatef(GLfloat angle, GLfloat x, GLfloat y, GLfloat z)
{
    const float length = lmb_sqrt(x * x + y * y + z * z);
    float turn = angle - 360.0f * floorf(angle / 360.0f); /* 0 .. 360 */
    if (!(length > 0.0f) || !(turn >= 0.0f && turn <= 360.0f)) {
        return;
    }
    const int quarter = (int)(turn / 90.0f);
    const float rest = (turn - 90.0f * (float)quarter) * (LMB_PI / 180.0f);
    const float s0 = rest == 0.0f ? 0.0f : lmb_sin(rest), c0 = rest == 0.0f ? 1.0f : lmb_cos(rest);
    const float s = quarter % 4 == 0 ? s0 : quarter % 4 == 1 ? c0 : quarter % 4 == 2 ? -s0 : -c0;
    const float k = quarter % 4 == 0 ? c0 : quarter % 4 == 1 ? -s0 : quarter % 4 == 2 ? -c0 : s0;
    x /= length;
    y /= length;
    z /= length;
    const float o = 1.0f - k;
    const float m[16] = {x * x * o + k, y * x * o + z * s, x * z * o - y * s, 0,
                         x * y * o - z * s, y * y * o + k, y * z * o + x * s, 0,
                         x * z * o + y * s, y * z * o - x * s, z * z * o + k, 0, 0, 0, 0, 1};
    call_matrix(OP_mult_matrix, m);
}
void glTranslated(GLdouble x, GLdouble y, GLdouble z) { glTranslatef((float)x, (float)y, (float)z); }
void glScaled(GLdouble x, GLdouble y, GLdouble z) { glScalef((float)x, (float)y, (float)z); }
void glRotated(GLdouble a, GLdouble x, GLdouble y, GLdouble z) { glRotatef((float)a, (float)x, (float)y, (float)z); }

/* --- evaluators --------------------------------------------------------------------------------------------------- */

#define EVAL(t, T) \
    void glEvalCoord1##t(T u) { DO(eval_coord, I(1), F(u), F(0)); } \
    void glEvalCoord2##t(T u, T v) { DO(eval_coord, I(2), F(u), F(v)); } \
    void glEvalCoord1##t##v(const T *u) { glEvalCoord1##t(u[0]); } \
    void glEvalCoord2##t##v(const T *u) { glEvalCoord2##t(u[0], u[1]); } \
    void glMapGrid1##t(GLint n, T a, T b) { DO(map_grid, I(1), I(n), F(a), F(b), I(1), F(0), F(0)); } \
    void glMapGrid2##t(GLint n, T a, T b, GLint m, T d, T e) { DO(map_grid, I(2), I(n), F(a), F(b), I(m), F(d), F(e)); }
EVAL(f, GLfloat) EVAL(d, GLdouble)
void glEvalPoint1(GLint i) { DO(eval_point, I(1), I(i), I(0)); }
void glEvalPoint2(GLint i, GLint j) { DO(eval_point, I(2), I(i), I(j)); }
void glEvalMesh1(GLenum mode, GLint a, GLint b) { DO(eval_mesh, I(1), U(mode), I(a), I(b), I(0), I(0)); }
void glEvalMesh2(GLenum mode, GLint a, GLint b, GLint d, GLint e)
{
    DO(eval_mesh, I(2), U(mode), I(a), I(b), I(d), I(e));
}

/* Values of a map's points. */
static int call_map_values(GLenum target)
{
    static const int values[9] = {4, 1, 3, 1, 2, 3, 4, 3, 4};
    const GLenum k = target >= GL_MAP2_COLOR_4 ? target - GL_MAP2_COLOR_4 : target - GL_MAP1_COLOR_4;
    return k < 9 ? values[k] : 0;
}

#define MAPS(t, T) \
    void glMap1##t(GLenum target, T u1, T u2, GLint stride, GLint order, const T *points) \
    { \
        float f[GL_MAP_ORDER * 4]; \
        const int n = call_map_values(target); \
        GL_ENTER_LISTED() \
        GL_FAIL_LISTED(n == 0 || target >= GL_MAP2_COLOR_4, GL_INVALID_ENUM) \
        GL_FAIL_LISTED(u1 == u2 || stride < n || order < 1 || order > GL_MAP_ORDER, GL_INVALID_VALUE) \
        for (int i = 0; i < order * n; ++i) \
            f[i] = (float)points[i / n * stride + i % n]; \
        gl_word w[10] = {U(target), F(u1), F(u2), I(order), F(0), F(1), I(1), I(n)}; \
        call_with_data(OP_map, w, 10, f, (size_t)(order * n) * sizeof *f); \
    } \
    void glMap2##t(GLenum target, T u1, T u2, GLint us, GLint uo, T v1, T v2, GLint vs, GLint vo, const T *points) \
    { \
        float f[GL_MAP_ORDER * GL_MAP_ORDER * 4]; \
        const int n = call_map_values(target); \
        GL_ENTER_LISTED() \
        GL_FAIL_LISTED(n == 0 || target < GL_MAP2_COLOR_4, GL_INVALID_ENUM) \
        GL_FAIL_LISTED(u1 == u2 || v1 == v2 || us < n || vs < n || uo < 1 || uo > GL_MAP_ORDER || vo < 1 || \
                           vo > GL_MAP_ORDER, \
                       GL_INVALID_VALUE) \
        for (int i = 0; i < uo * vo * n; ++i) \
            f[i] = (float)points[i / (vo * n) * us + i / n % vo * vs + i % n]; \
        gl_word w[10] = {U(target), F(u1), F(u2), I(uo), F(v1), F(v2), I(vo), I(n)}; \
        call_with_data(OP_map, w, 10, f, (size_t)(uo * vo * n) * sizeof *f); \
    }
MAPS(f, GLfloat) MAPS(d, GLdouble)

/* --- colour indices: stored, but never drawn ---------------------------------------------------------------------- */

#define INDEX(t, T) \
    void glIndex##t(T v) { (void)v; } \
    void glIndex##t##v(const T *v) { (void)v; }
INDEX(s, GLshort) INDEX(i, GLint) INDEX(f, GLfloat) INDEX(d, GLdouble) INDEX(ub, GLubyte)

void glIndexMask(GLuint mask)
{
    (void)mask;
    DO(fail, U(GL_NO_ERROR));
}

void glClearIndex(GLfloat v)
{
    (void)v;
    DO(fail, U(GL_NO_ERROR));
}
