/* gl_target.c: targets of draws: the window's memory, or framebuffer objects; occlusion queries. */
#include "gl_context.h"

#define OP(name) void gl_op_##name(gl_context *c, const gl_word *w)

/* --- surfaces ----------------------------------------------------------------------------------------------------- */

/* The image of a texture attachment, or NULL. */
static gl_image *target_image(gl_context *c, const gl_attachment *a)
{
    gl_texture *t = a->type == GL_TEXTURE ? gl_find(&c->group->textures, a->name) : NULL;
    gl_image *m = t != NULL ? &t->image[a->face][a->level] : NULL;
    return m != NULL && m->texels != NULL && m->width > 0 && m->height > 0 && a->slice < m->depth ? m : NULL;
}

static uint8_t *target_texels(const gl_image *m, int32_t slice)
{
    return m->texels + 4 * (size_t)slice * (size_t)m->width * (size_t)m->height;
}

static void target_size(gl_surface *s, int32_t w, int32_t h, int *any)
{
    s->width = *any ? mini(s->width, w) : w;
    s->height = *any ? mini(s->height, h) : h;
    *any = 1;
}

/* The surface of a framebuffer; NULL: the window. */
void gl_find_surface(gl_context *c, gl_surface *out, const gl_framebuffer *f)
{
    int any = 0;
    if (f == NULL) {
        *out = c->window;
        return;
    }
    memset(out, 0, sizeof *out);
    out->has_alpha = out->is_complete = 1;
    const gl_attachment *parts[3] = {&f->colour, &f->depth, &f->stencil};
    for (int i = 0; i < 3; ++i) {
        const gl_image *m = target_image(c, parts[i]);
        const gl_renderbuffer *r =
            parts[i]->type == GL_RENDERBUFFER_EXT ? gl_find(&c->group->renderbuffers, parts[i]->name) : NULL;
        const int32_t w = m != NULL   ? m->width
                          : r != NULL ? r->width
                                      : 0,
                      h = m != NULL   ? m->height
                          : r != NULL ? r->height
                                      : 0;
        uint8_t *data = m != NULL ? target_texels(m, parts[i]->slice) : r != NULL ? r->data : NULL;
        if (w == 0 || h == 0) {
            continue;
        }
        target_size(out, w, h, &any);
        if (i == 0) {
            out->colour = data;
            out->stride = w;
            out->has_alpha = m != NULL ? m->base == GL_RGBA : r != NULL && gl_base_format(r->internal) == GL_RGBA;
        } else if (i == 1) {
            out->depth = (float *)(void *)data;
            out->depth_stride = m != NULL ? w : gl_depth_stride(w);
        } else {
            out->stencil = r != NULL ? r->stencil : m->stencil;
            out->stencil_stride = w;
        }
    }
}

static int target_is_depth(GLenum f)
{
    return gl_base_format(f) == GL_DEPTH_COMPONENT;
}
static int target_is_stencil(GLenum f)
{
    return f == GL_STENCIL_INDEX || (f >= GL_STENCIL_INDEX1_EXT && f <= GL_STENCIL_INDEX16_EXT) ||
           gl_has_stencil(f);
}

static GLenum target_status(gl_context *c, const gl_framebuffer *f)
{
    int any = 0;
    if (f == NULL) {
        return GL_FRAMEBUFFER_COMPLETE_EXT;
    }
    const gl_attachment *parts[3] = {&f->colour, &f->depth, &f->stencil};
    for (int i = 0; i < 3; ++i) {
        const gl_image *m = target_image(c, parts[i]);
        const gl_renderbuffer *r =
            parts[i]->type == GL_RENDERBUFFER_EXT ? gl_find(&c->group->renderbuffers, parts[i]->name) : NULL;
        if (parts[i]->type == GL_NONE) {
            continue;
        }
        const GLenum internal = m != NULL ? m->internal : r != NULL ? r->internal : 0;
        const int32_t pw = m != NULL   ? m->width
                           : r != NULL ? r->width
                                       : 0,
                      ph = m != NULL   ? m->height
                           : r != NULL ? r->height
                                       : 0;
        const GLenum base = gl_base_format(internal);
        const int fits = i == 0   ? base == GL_RGB || base == GL_RGBA
                         : i == 1 ? target_is_depth(internal)
                                  : target_is_stencil(internal) && (r != NULL || m->stencil != NULL);
        if (pw == 0 || ph == 0 || !fits || (m != NULL && m->border != 0) ||
            (i == 1 && m == NULL && (r == NULL || r->data == NULL))) {
            return GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT_EXT;
        }
        if ((i == 1 && m != NULL && pw % LMB_TILE != 0) || pw > LMB_MAX_SIDE || ph > LMB_MAX_SIDE) {
            return GL_FRAMEBUFFER_UNSUPPORTED_EXT;
        }
        any = 1; /* sizes may differ: draws go to the part that all have */
    }
    if (!any) {
        return GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT_EXT;
    }
    if (f->colour.type == GL_NONE && c->s.colour.draw != GL_NONE) {
        return GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER_EXT;
    }
    return GL_FRAMEBUFFER_COMPLETE_EXT;
}

int gl_surface_ready(gl_context *c, const gl_framebuffer *f)
{
    if (target_status(c, f) != GL_FRAMEBUFFER_COMPLETE_EXT) {
        gl_error(c, GL_INVALID_FRAMEBUFFER_OPERATION_EXT);
        return 0;
    }
    return 1;
}

/* --- framebuffer objects ------------------------------------------------------------------------------------------ */

#define GENERATE(call, table) \
    void call(GLsizei n, GLuint *names) \
    { \
        GL_ENTER() \
        GL_FAIL(n < 0, GL_INVALID_VALUE, ) \
        const GLuint first = gl_new_names(c, table, n); \
        for (GLsizei i = 0; i < n && first != 0; ++i) names[i] = first + (GLuint)i; \
    }
GENERATE(glGenFramebuffersEXT, &c->framebuffers)
GENERATE(glGenRenderbuffersEXT, &c->group->renderbuffers)
GENERATE(glGenQueries, &c->queries)

/* The object of a name, created if new. */
static void *target_object(gl_context *c, gl_table *t, GLuint name, size_t bytes)
{
    void *o = gl_find(t, name);
    if (o == NULL) {
        o = gl_alloc(c, bytes);
        if (o == NULL || !gl_put(c, t, name, o)) {
            return NULL;
        }
        memset(o, 0, bytes);
        memcpy(o, &name, sizeof name);
    }
    return o;
}

void glBindFramebufferEXT(GLenum target, GLuint name)
{
    GL_ENTER()
    GL_FAIL(target != GL_FRAMEBUFFER_EXT && target != GL_READ_FRAMEBUFFER && target != GL_DRAW_FRAMEBUFFER,
            GL_INVALID_ENUM, )
    gl_flush_vertices(c);
    gl_framebuffer *f = name != 0 ? target_object(c, &c->framebuffers, name, sizeof *f) : NULL;
    if (name != 0 && f == NULL) {
        return;
    }
    if (target != GL_READ_FRAMEBUFFER) {
        c->s.colour.draw = (f != NULL) != (c->framebuffer != NULL) ? (f != NULL ? GL_COLOR_ATTACHMENT0_EXT : GL_FRONT)
                                                                   : c->s.colour.draw;
        c->framebuffer = f;
    }
    if (target != GL_DRAW_FRAMEBUFFER) {
        c->s.pixel.read = (f != NULL) != (c->read_framebuffer != NULL)
                              ? (f != NULL ? GL_COLOR_ATTACHMENT0_EXT : GL_FRONT)
                              : c->s.pixel.read;
        c->read_framebuffer = f;
    }
    c->dirty = 1;
}

void glDeleteFramebuffersEXT(GLsizei n, const GLuint *names)
{
    GL_ENTER()
    GL_FAIL(n < 0, GL_INVALID_VALUE, )
    gl_flush_vertices(c);
    for (GLsizei i = 0; i < n; ++i) {
        gl_framebuffer *f = gl_find(&c->framebuffers, names[i]);
        gl_remove(&c->framebuffers, names[i]);
        if (f != NULL && f == c->framebuffer) {
            c->framebuffer = NULL;
            c->s.colour.draw = GL_FRONT;
        }
        if (f != NULL && f == c->read_framebuffer) {
            c->read_framebuffer = NULL;
            c->s.pixel.read = GL_FRONT;
        }
        gl_free(c, f);
    }
    c->dirty = 1;
}

GLboolean glIsFramebufferEXT(GLuint name)
{
    GL_ENTER(0)
    return gl_find(&c->framebuffers, name) != NULL;
}

GLenum glCheckFramebufferStatusEXT(GLenum target)
{
    GL_ENTER(0)
    GL_FAIL(target != GL_FRAMEBUFFER_EXT && target != GL_READ_FRAMEBUFFER && target != GL_DRAW_FRAMEBUFFER,
            GL_INVALID_ENUM, 0)
    return target_status(c, target == GL_READ_FRAMEBUFFER ? c->read_framebuffer : c->framebuffer);
}

static void target_attach(GLenum target, GLenum attachment, const gl_attachment *a)
{
    GL_ENTER()
    gl_framebuffer *f = target == GL_READ_FRAMEBUFFER ? c->read_framebuffer : c->framebuffer;
    GL_FAIL(target != GL_FRAMEBUFFER_EXT && target != GL_READ_FRAMEBUFFER && target != GL_DRAW_FRAMEBUFFER,
            GL_INVALID_ENUM, )
    GL_FAIL(f == NULL, GL_INVALID_OPERATION, )
    GL_FAIL(attachment > GL_COLOR_ATTACHMENT0_EXT && attachment <= GL_COLOR_ATTACHMENT15_EXT, GL_INVALID_OPERATION, )
    GL_FAIL(attachment != GL_COLOR_ATTACHMENT0_EXT && attachment != GL_DEPTH_ATTACHMENT_EXT &&
                attachment != GL_STENCIL_ATTACHMENT_EXT && attachment != GL_DEPTH_STENCIL_ATTACHMENT, GL_INVALID_ENUM, )
    gl_flush_vertices(c);
    c->dirty = 1;
    if (attachment == GL_COLOR_ATTACHMENT0_EXT) {
        f->colour = *a;
    }
    if (attachment == GL_DEPTH_ATTACHMENT_EXT || attachment == GL_DEPTH_STENCIL_ATTACHMENT) {
        f->depth = *a;
    }
    if (attachment == GL_STENCIL_ATTACHMENT_EXT || attachment == GL_DEPTH_STENCIL_ATTACHMENT) {
        f->stencil = *a;
    }
}

static void target_attach_texture(GLenum target, GLenum attachment, GLenum kind, GLuint name, GLint level, GLint slice)
{
    GL_ENTER()
    gl_attachment a = {name != 0 ? GL_TEXTURE : GL_NONE, name, level, 0, slice};
    if (name != 0) {
        const gl_texture *t = gl_find(&c->group->textures, name);
        GL_FAIL(t == NULL, GL_INVALID_OPERATION, )
        if (kind >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && kind <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z) {
            a.face = (int32_t)(kind - GL_TEXTURE_CUBE_MAP_POSITIVE_X);
            kind = GL_TEXTURE_CUBE_MAP;
        }
        static const GLenum kinds[TARGETS] = {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_RECTANGLE_ARB, GL_TEXTURE_3D,
                                               GL_TEXTURE_CUBE_MAP};
        GL_FAIL(kinds[t->target] != kind, GL_INVALID_OPERATION, )
        GL_FAIL(level < 0 || level >= GL_LEVELS || slice < 0 || slice >= GL_SIDE_3D, GL_INVALID_VALUE, )
    }
    target_attach(target, attachment, &a);
}

void glFramebufferTexture1DEXT(GLenum t, GLenum a, GLenum k, GLuint n, GLint l)
{
    target_attach_texture(t, a, k, n, l, 0);
}
void glFramebufferTexture2DEXT(GLenum t, GLenum a, GLenum k, GLuint n, GLint l)
{
    target_attach_texture(t, a, k, n, l, 0);
}
void glFramebufferTexture3DEXT(GLenum t, GLenum a, GLenum k, GLuint n, GLint l, GLint z)
{
    target_attach_texture(t, a, k, n, l, z);
}
void glFramebufferTextureLayer(GLenum t, GLenum at, GLuint name, GLint level, GLint slice)
{
    GL_ENTER()
    const gl_texture *texture = name != 0 ? gl_find(&c->group->textures, name) : NULL;
    GL_FAIL(name != 0 && (texture == NULL || texture->target != TARGET_3D), GL_INVALID_OPERATION, )
    target_attach_texture(t, at, GL_TEXTURE_3D, name, level, slice);
}
void glFramebufferRenderbufferEXT(GLenum t, GLenum at, GLenum kind, GLuint name)
{
    GL_ENTER()
    const gl_attachment a = {name != 0 ? GL_RENDERBUFFER_EXT : GL_NONE, name, 0, 0, 0};
    GL_FAIL(kind != GL_RENDERBUFFER_EXT, GL_INVALID_ENUM, )
    GL_FAIL(name != 0 && gl_find(&c->group->renderbuffers, name) == NULL, GL_INVALID_OPERATION, )
    target_attach(t, at, &a);
}

/* The format of an attachment's image; 0: there is none. */
static GLenum target_internal(gl_context *c, const gl_attachment *a)
{
    const gl_image *m = target_image(c, a);
    const gl_renderbuffer *r = a->type == GL_RENDERBUFFER_EXT ? gl_find(&c->group->renderbuffers, a->name) : NULL;
    return m != NULL ? m->internal : r != NULL ? r->internal : 0;
}

/* Bits and kinds of an attachment's values: part 0 colour, 1 depth, 2 stencil. */
static int target_component(GLenum name, GLenum internal, int part, GLint *out)
{
    const int colour = part == 0 && internal != 0;
    switch (name) {
    case GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE: case GL_FRAMEBUFFER_ATTACHMENT_GREEN_SIZE:
    case GL_FRAMEBUFFER_ATTACHMENT_BLUE_SIZE:
        *out = colour ? 8 : 0;
        return 1;
    case GL_FRAMEBUFFER_ATTACHMENT_ALPHA_SIZE: *out = colour && gl_base_format(internal) == GL_RGBA ? 8 : 0; return 1;
    case GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE: *out = target_is_depth(internal) ? 32 : 0; return 1;
    case GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE: *out = target_is_stencil(internal) ? 8 : 0; return 1;
    case GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE:
        *out = part == 0 ? GL_UNSIGNED_NORMALIZED : part == 1 ? GL_FLOAT : GL_INDEX;
        return 1;
    case GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING: *out = GL_LINEAR; return 1;
    default: return 0;
    }
}

/* The window's buffers as attachments. */
static void target_get_window(gl_context *c, GLenum attachment, GLenum name, GLint *out)
{
    const int part = attachment == GL_DEPTH ? 1 : attachment == GL_STENCIL ? 2 : 0;
    static const GLenum formats[3] = {GL_RGBA8, GL_DEPTH_COMPONENT32F, GL_STENCIL_INDEX8_EXT};
    GL_FAIL(part == 0 && attachment != GL_FRONT_LEFT && attachment != GL_BACK_LEFT && attachment != GL_FRONT_RIGHT &&
                attachment != GL_BACK_RIGHT,
            GL_INVALID_ENUM, )
    const int has = part == 0   ? attachment == GL_FRONT_LEFT || attachment == GL_BACK_LEFT
                    : part == 1 ? c->window.depth != NULL
                                : c->window.stencil != NULL;
    if (name == GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE_EXT) {
        *out = has ? GL_FRAMEBUFFER_DEFAULT : GL_NONE;
        return;
    }
    GL_FAIL(!has, GL_INVALID_OPERATION, )
    GL_FAIL(!target_component(name, part == 0 && !c->window.has_alpha ? GL_RGB8 : formats[part], part, out),
            GL_INVALID_ENUM, )
}

static void target_get_attachment(gl_context *c, const gl_attachment *a, int part, GLenum name, GLint *out)
{
    const int is_texture = a->type == GL_TEXTURE;
    const GLenum internal = target_internal(c, a);
    if (name == GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE_EXT) {
        *out = (GLint)a->type;
    } else if (name == GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME_EXT) {
        *out = a->type != GL_NONE ? (GLint)a->name : 0;
    } else if (a->type == GL_NONE) {
        gl_error(c, GL_INVALID_OPERATION);
    } else if (name == GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL_EXT && is_texture) {
        *out = a->level;
    } else if (name == GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_CUBE_MAP_FACE_EXT && is_texture) {
        const gl_texture *t = gl_find(&c->group->textures, a->name);
        *out = t != NULL && t->target == TARGET_CUBE ? (GLint)GL_TEXTURE_CUBE_MAP_POSITIVE_X + a->face : 0;
    } else if (name == GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_3D_ZOFFSET_EXT && is_texture) {
        *out = a->slice;
    } else if (!target_component(name, internal, part, out)) {
        gl_error(c, GL_INVALID_ENUM);
    }
}

void glGetFramebufferAttachmentParameterivEXT(GLenum target, GLenum attachment, GLenum name, GLint *out)
{
    GL_ENTER()
    const gl_framebuffer *f = target == GL_READ_FRAMEBUFFER ? c->read_framebuffer : c->framebuffer;
    GL_FAIL(target != GL_FRAMEBUFFER_EXT && target != GL_READ_FRAMEBUFFER && target != GL_DRAW_FRAMEBUFFER,
            GL_INVALID_ENUM, )
    if (f == NULL) {
        target_get_window(c, attachment, name, out);
        return;
    }
    const gl_attachment *parts[3] = {&f->colour, &f->depth, &f->stencil};
    const int both = attachment == GL_DEPTH_STENCIL_ATTACHMENT;
    const int part = attachment == GL_COLOR_ATTACHMENT0_EXT            ? 0
                     : attachment == GL_DEPTH_ATTACHMENT_EXT || both  ? 1
                     : attachment == GL_STENCIL_ATTACHMENT_EXT        ? 2
                                                                       : -1;
    GL_FAIL(attachment > GL_COLOR_ATTACHMENT0_EXT && attachment <= GL_COLOR_ATTACHMENT15_EXT, GL_INVALID_OPERATION, )
    GL_FAIL(part < 0, GL_INVALID_ENUM, )
    GL_FAIL(both && memcmp(&f->depth, &f->stencil, sizeof f->depth) != 0, GL_INVALID_OPERATION, )
    target_get_attachment(c, parts[part], part, name, out);
}

/* --- renderbuffers ------------------------------------------------------------------------------------------------ */

void glBindRenderbufferEXT(GLenum target, GLuint name)
{
    GL_ENTER()
    GL_FAIL(target != GL_RENDERBUFFER_EXT, GL_INVALID_ENUM, )
    c->renderbuffer = name != 0 ? target_object(c, &c->group->renderbuffers, name, sizeof(gl_renderbuffer)) : NULL;
}

void glDeleteRenderbuffersEXT(GLsizei n, const GLuint *names)
{
    GL_ENTER()
    GL_FAIL(n < 0, GL_INVALID_VALUE, )
    gl_flush_vertices(c);
    c->dirty = 1;
    for (GLsizei i = 0; i < n; ++i) {
        gl_renderbuffer *r = gl_find(&c->group->renderbuffers, names[i]);
        gl_remove(&c->group->renderbuffers, names[i]);
        if (r != NULL) {
            c->renderbuffer = c->renderbuffer == r ? NULL : c->renderbuffer;
            gl_free(c, r->data);
            gl_free(c, r->stencil);
            gl_free(c, r);
        }
    }
}

GLboolean glIsRenderbufferEXT(GLuint name)
{
    GL_ENTER(0)
    return gl_find(&c->group->renderbuffers, name) != NULL;
}

void glRenderbufferStorageEXT(GLenum target, GLenum internal, GLsizei w, GLsizei h)
{
    glRenderbufferStorageMultisample(target, 0, internal, w, h);
}

/* A pixel has one sample at most. */
void glRenderbufferStorageMultisample(GLenum target, GLsizei samples, GLenum internal, GLsizei w, GLsizei h)
{
    GL_ENTER()
    gl_renderbuffer *r = c->renderbuffer;
    const GLenum base = gl_base_format(internal);
    GL_FAIL(target != GL_RENDERBUFFER_EXT, GL_INVALID_ENUM, )
    GL_FAIL(r == NULL, GL_INVALID_OPERATION, )
    GL_FAIL(!(base == GL_RGB || base == GL_RGBA || target_is_depth(internal) || target_is_stencil(internal)) ||
                internal <= 4,
            GL_INVALID_ENUM, )
    GL_FAIL(w < 0 || h < 0 || w > GL_SIDE_CUBE || h > GL_SIDE_CUBE || samples < 0 || samples > 1, GL_INVALID_VALUE, )
    gl_flush_vertices(c);
    c->dirty = 1;
    const size_t n = (size_t)(target_is_depth(internal) ? gl_depth_stride(w) : w) * (size_t)h;
    gl_free(c, r->data);
    gl_free(c, r->stencil);
    r->data = target_is_stencil(internal) && !target_is_depth(internal) ? NULL : gl_alloc(c, 4 * n + 4);
    r->stencil = target_is_stencil(internal) ? gl_alloc(c, n + 4) : NULL;
    if (r->data != NULL) {
        memset(r->data, 0, 4 * n);
    }
    if (r->stencil != NULL) {
        memset(r->stencil, 0, n);
    }
    r->internal = internal;
    r->samples = samples;
    r->width = r->data != NULL || r->stencil != NULL ? w : 0;
    r->height = h;
}

void glGetRenderbufferParameterivEXT(GLenum target, GLenum name, GLint *out)
{
    GL_ENTER()
    const gl_renderbuffer *r = c->renderbuffer;
    GL_FAIL(target != GL_RENDERBUFFER_EXT, GL_INVALID_ENUM, )
    GL_FAIL(r == NULL, GL_INVALID_OPERATION, )
    const int depth = target_is_depth(r->internal), stencil = target_is_stencil(r->internal),
              colour = r->internal != 0 && !depth && !stencil;
    switch (name) {
    case GL_RENDERBUFFER_WIDTH_EXT: *out = r->width; break;
    case GL_RENDERBUFFER_HEIGHT_EXT: *out = r->height; break;
    case GL_RENDERBUFFER_SAMPLES: *out = r->samples; break;
    case GL_RENDERBUFFER_INTERNAL_FORMAT_EXT: *out = r->internal != 0 ? (GLint)r->internal : GL_RGBA; break;
    case GL_RENDERBUFFER_RED_SIZE_EXT:
    case GL_RENDERBUFFER_GREEN_SIZE_EXT:
    case GL_RENDERBUFFER_BLUE_SIZE_EXT:
        *out = colour ? 8 : 0;
        break;
    case GL_RENDERBUFFER_ALPHA_SIZE_EXT: *out = colour && gl_base_format(r->internal) == GL_RGBA ? 8 : 0; break;
    case GL_RENDERBUFFER_DEPTH_SIZE_EXT: *out = depth ? 24 : 0; break;
    case GL_RENDERBUFFER_STENCIL_SIZE_EXT: *out = stencil ? 8 : 0; break;
    default: gl_error(c, GL_INVALID_ENUM); break;
    }
}

/* --- queries ------------------------------------------------------------------------------------------------------ */

OP(begin_query)
{
    GL_FAIL(w[0].u != GL_SAMPLES_PASSED, GL_INVALID_ENUM, )
    GL_FAIL(c->query != NULL || w[1].u == 0, GL_INVALID_OPERATION, )
    gl_query *q = target_object(c, &c->queries, w[1].u, sizeof *q);
    if (q != NULL) {
        q->passed = 0;
        c->query = q;
    }
}

OP(end_query)
{
    GL_FAIL(w[0].u != GL_SAMPLES_PASSED, GL_INVALID_ENUM, )
    GL_FAIL(c->query == NULL, GL_INVALID_OPERATION, )
    c->query = NULL;
}

void glDeleteQueries(GLsizei n, const GLuint *names)
{
    GL_ENTER()
    GL_FAIL(n < 0, GL_INVALID_VALUE, )
    gl_flush_vertices(c);
    c->dirty = 1;
    for (GLsizei i = 0; i < n; ++i) {
        gl_query *q = gl_find(&c->queries, names[i]);
        c->query = q != NULL && c->query == q ? NULL : c->query;
        gl_remove(&c->queries, names[i]);
        gl_free(c, q);
    }
}

GLboolean glIsQuery(GLuint name)
{
    GL_ENTER(0)
    return gl_find(&c->queries, name) != NULL;
}

void glGetQueryiv(GLenum target, GLenum name, GLint *out)
{
    GL_ENTER()
    GL_FAIL(target != GL_SAMPLES_PASSED || (name != GL_CURRENT_QUERY && name != GL_QUERY_COUNTER_BITS),
            GL_INVALID_ENUM, )
    *out = name == GL_QUERY_COUNTER_BITS ? 32 : c->query != NULL ? (GLint)c->query->name : 0;
}

void glGetQueryObjectuiv(GLuint id, GLenum name, GLuint *out)
{
    GL_ENTER()
    const gl_query *q = gl_find(&c->queries, id);
    GL_FAIL(q == NULL || q == c->query, GL_INVALID_OPERATION, )
    GL_FAIL(name != GL_QUERY_RESULT && name != GL_QUERY_RESULT_AVAILABLE, GL_INVALID_ENUM, )
    *out = name == GL_QUERY_RESULT_AVAILABLE ? 1u : q->passed < 0xffffffffu ? (GLuint)q->passed : 0xffffffffu;
}

void glGetQueryObjectiv(GLuint id, GLenum name, GLint *out)
{
    GLuint v = (GLuint)*out;
    glGetQueryObjectuiv(id, name, &v);
    *out = v < 0x7fffffffu ? (GLint)v : 0x7fffffff;
}
