/* gl_texture.c: texture objects, their images and parameters, and the units' environments. */
#include "gl_context.h"

#define OP(name) void gl_op_##name(gl_context *c, const gl_word *w)
#define CHECK(good, error) \
    if (!(good)) { gl_error(c, error); return; }

/* --- objects ------------------------------------------------------------------------------------------------------ */

void gl_texture_init(gl_texture *t, GLuint name, int target)
{
    memset(t, 0, sizeof *t);
    t->name = name;
    t->target = target;
    t->min_filter = GL_NEAREST_MIPMAP_LINEAR;
    t->mag_filter = GL_LINEAR;
    t->wrap[0] = t->wrap[1] = t->wrap[2] = GL_REPEAT;
    t->compare_mode = GL_NONE;
    t->compare_func = GL_LEQUAL;
    t->depth_mode = GL_LUMINANCE;
    if (target == TARGET_RECT) {
        t->min_filter = GL_LINEAR;
        t->wrap[0] = t->wrap[1] = t->wrap[2] = GL_CLAMP_TO_EDGE;
    }
    t->min_lod = -1000.0f;
    t->max_lod = 1000.0f;
    t->max_level = 1000;
    for (int i = 0; i < 4; ++i) {
        t->swizzle[i] = GL_RED + (GLenum)i;
    }
    t->priority = t->anisotropy = 1.0f;
}

static int texture_target(GLenum target)
{
    switch (target) {
    case GL_TEXTURE_1D: return TARGET_1D;
    case GL_TEXTURE_2D: return TARGET_2D;
    case GL_TEXTURE_RECTANGLE_ARB: return TARGET_RECT;
    case GL_TEXTURE_3D: return TARGET_3D;
    case GL_TEXTURE_CUBE_MAP: return TARGET_CUBE;
    default: return -1;
    }
}

/* The same of an image's target; the face of a cube. */
static int texture_image_target(GLenum target, int *face)
{
    *face = 0;
    if (target >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && target <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z) {
        *face = (int)(target - GL_TEXTURE_CUBE_MAP_POSITIVE_X);
        return TARGET_CUBE;
    }
    return target == GL_TEXTURE_CUBE_MAP ? -1 : texture_target(target);
}

static gl_texture *texture_active(const gl_context *c, int target)
{
    return c->s.texture.unit[c->s.texture.active].bound[target];
}

OP(bind_texture)
{
    const int target = texture_target(w[0].u);
    CHECK(target >= 0, GL_INVALID_ENUM)
    gl_texture *t = &c->default_texture[target];
    if (w[1].u != 0) {
        t = gl_find(&c->group->textures, w[1].u);
        CHECK(t == NULL || t->target == target, GL_INVALID_OPERATION)
        if (t == NULL) {
            t = gl_alloc(c, sizeof *t);
            if (t == NULL) {
                return;
            }
            gl_texture_init(t, w[1].u, target);
            if (!gl_put(c, &c->group->textures, w[1].u, t)) {
                gl_free(c, t);
                return;
            }
        }
    }
    c->s.texture.unit[c->s.texture.active].bound[target] = t;
}

OP(active_texture)
{
    CHECK(w[0].u >= GL_TEXTURE0 && w[0].u < GL_TEXTURE0 + GL_UNITS, GL_INVALID_ENUM)
    c->s.texture.active = (int32_t)(w[0].u - GL_TEXTURE0);
}

OP(prioritize)
{
    gl_texture *t = gl_find(&c->group->textures, w[0].u);
    if (t != NULL) {
        t->priority = gl_unit_range(w[1].f);
    }
}

void glGenTextures(GLsizei n, GLuint *names)
{
    GL_ENTER()
    GL_FAIL(n < 0, GL_INVALID_VALUE, )
    const GLuint first = gl_new_names(c, &c->group->textures, n);
    for (GLsizei i = 0; i < n && first != 0; ++i) {
        names[i] = first + (GLuint)i;
    }
}

static void texture_free_images(gl_context *c, gl_texture *t)
{
    for (int f = 0; f < 6; ++f) {
        for (int l = 0; l < GL_LEVELS; ++l) {
            gl_free(c, t->image[f][l].texels);
            gl_free(c, t->image[f][l].stencil);
            t->image[f][l].texels = t->image[f][l].stencil = NULL;
        }
    }
}

void glDeleteTextures(GLsizei n, const GLuint *names)
{
    GL_ENTER()
    GL_FAIL(n < 0, GL_INVALID_VALUE, )
    gl_flush_vertices(c);
    c->dirty = 1;
    for (GLsizei i = 0; i < n; ++i) {
        gl_texture *t = gl_find(&c->group->textures, names[i]);
        gl_remove(&c->group->textures, names[i]);
        if (t == NULL) {
            continue;
        }
        for (int u = 0; u < GL_UNITS; ++u) {
            if (c->s.texture.unit[u].bound[t->target] == t) {
                c->s.texture.unit[u].bound[t->target] = &c->default_texture[t->target];
            }
        }
        if (c->framebuffer != NULL && c->framebuffer->colour.type == GL_TEXTURE &&
            c->framebuffer->colour.name == t->name) {
            c->framebuffer->colour.type = GL_NONE;
        }
        texture_free_images(c, t);
        gl_free(c, t);
    }
}

GLboolean glIsTexture(GLuint name)
{
    GL_ENTER(0)
    return gl_find(&c->group->textures, name) != NULL;
}

GLboolean glAreTexturesResident(GLsizei n, const GLuint *names, GLboolean *residences)
{
    GL_ENTER(0)
    (void)residences;
    GL_FAIL(n < 0, GL_INVALID_VALUE, 0)
    for (GLsizei i = 0; i < n; ++i) {
        GL_FAIL(gl_find(&c->group->textures, names[i]) == NULL, GL_INVALID_VALUE, 0)
    }
    return 1;
}

/* --- completeness ------------------------------------------------------------------------------------------------- */

static int texture_same(const gl_image *a, const gl_image *b, int32_t w, int32_t h, int32_t d)
{
    return b->texels != NULL && b->width == w && b->height == h && b->depth == d && b->internal == a->internal &&
           b->border == a->border;
}

int gl_texture_is_complete(const gl_texture *t)
{
    if (t->base_level >= GL_LEVELS || t->base_level > t->max_level) {
        return 0;
    }
    const gl_image *base = &t->image[0][t->base_level];
    const int faces = t->target == TARGET_CUBE ? 6 : 1;
    if (base->texels == NULL || base->width == 0 || base->height == 0 || base->depth == 0 ||
        (faces == 6 && base->width != base->height)) {
        return 0;
    }
    for (int f = 0; f < faces; ++f) {
        int32_t w = base->width, h = base->height, d = base->depth;
        for (int l = t->base_level;; ++l) {
            if (!texture_same(base, &t->image[f][l], w, h, d)) {
                return 0;
            }
            if (t->min_filter == GL_NEAREST || t->min_filter == GL_LINEAR || (w == 1 && h == 1 && d == 1) ||
                l >= t->max_level || l + 1 >= GL_LEVELS) {
                break;
            }
            w = maxi(w / 2, 1);
            h = maxi(h / 2, 1);
            d = maxi(d / 2, 1);
        }
    }
    return 1;
}

void gl_find_textures(gl_context *c)
{
    for (int i = 0; i < GL_UNITS; ++i) {
        const gl_unit *u = &c->s.texture.unit[i];
        c->unit_texture[i] = NULL;
        for (int t = TARGETS - 1; t >= 0; --t) {
            if ((u->on >> t & 1u) != 0) {
                c->unit_texture[i] = gl_texture_is_complete(u->bound[t]) ? u->bound[t] : NULL;
                break;
            }
        }
    }
}

/* --- formats ------------------------------------------------------------------------------------------------------ */

GLenum gl_base_format(GLenum f)
{
    static const GLenum compressed[6] = {GL_ALPHA, GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_INTENSITY, GL_RGB, GL_RGBA};
    switch (f) {
    case 1: case GL_LUMINANCE: return GL_LUMINANCE;
    case 2: case GL_LUMINANCE_ALPHA: return GL_LUMINANCE_ALPHA;
    case 3: case GL_RGB: case GL_R3_G3_B2: return GL_RGB;
    case 4: case GL_RGBA: return GL_RGBA;
    case GL_ALPHA: return GL_ALPHA;
    case GL_INTENSITY: return GL_INTENSITY;
    case GL_DEPTH_COMPONENT: case GL_DEPTH_COMPONENT16: case GL_DEPTH_COMPONENT24: case GL_DEPTH_COMPONENT32:
    case GL_DEPTH_COMPONENT32F: case GL_DEPTH_STENCIL: case GL_DEPTH24_STENCIL8: case GL_DEPTH32F_STENCIL8:
        return GL_DEPTH_COMPONENT;
    default: break;
    }
    return f >= GL_ALPHA4 && f <= GL_ALPHA16                            ? GL_ALPHA
           : f >= GL_LUMINANCE4 && f <= GL_LUMINANCE16                  ? GL_LUMINANCE
           : f >= GL_LUMINANCE4_ALPHA4 && f <= GL_LUMINANCE16_ALPHA16   ? GL_LUMINANCE_ALPHA
           : f >= GL_INTENSITY4 && f <= GL_INTENSITY16                  ? GL_INTENSITY
           : f >= GL_RGB4 && f <= GL_RGB16                              ? GL_RGB
           : f >= GL_RGBA2 && f <= GL_RGBA16                            ? GL_RGBA
           : f >= GL_COMPRESSED_ALPHA && f <= GL_COMPRESSED_RGBA        ? compressed[f - GL_COMPRESSED_ALPHA]
                                                                        : 0;
}

int gl_has_stencil(GLenum f) { return f == GL_DEPTH_STENCIL || f == GL_DEPTH24_STENCIL8 || f == GL_DEPTH32F_STENCIL8; }

static int texture_is_depth_format(GLenum format) { return format == GL_DEPTH_COMPONENT || format == GL_DEPTH_STENCIL; }

/* A code as the base format keeps it. */
static void texture_keep(uint8_t out[4], const uint8_t in[4], GLenum base)
{
    const uint8_t r = in[0], a = in[3];
    memcpy(out, in, 4);
    switch (base) {
    case GL_ALPHA: out[0] = out[1] = out[2] = 255; break;
    case GL_LUMINANCE: out[1] = out[2] = r; out[3] = 255; break;
    case GL_LUMINANCE_ALPHA: out[1] = out[2] = r; out[3] = a; break;
    case GL_INTENSITY: out[1] = out[2] = out[3] = r; break;
    case GL_RGB: out[3] = 255; break;
    default: break;
    }
}

static size_t texture_texels(const gl_image *m, int target)
{
    const size_t b = 2 * (size_t)m->border;
    return ((size_t)m->width + b) * ((size_t)m->height + (target == TARGET_1D ? 0 : b)) *
           ((size_t)m->depth + (target == TARGET_3D ? b : 0));
}

/* --- images ------------------------------------------------------------------------------------------------------- */

static int texture_size_is_good(int32_t size, int32_t border, int32_t largest)
{
    return size - 2 * border >= 0 && size - 2 * border <= largest;
}

static int32_t texture_largest(int kind)
{
    return kind == TARGET_3D ? GL_SIDE_3D : kind == TARGET_CUBE ? GL_SIDE_CUBE : GL_SIDE;
}

/* Checks of an image's arguments. */
static GLenum texture_check(GLenum target, int kind, GLint level, GLenum internal, int32_t w, int32_t h, int32_t d,
                            GLint border)
{
    const int32_t largest = texture_largest(kind) >> clampi(level, 0, GL_LEVELS);
    (void)target;
    if (kind < 0) {
        return GL_INVALID_ENUM;
    }
    if (level < 0 || level >= GL_LEVELS || gl_base_format(internal) == 0 || border < 0 || border > 1 || w < 0 ||
        h < 0 || d < 0 || !texture_size_is_good(w, border, largest) ||
        (kind != TARGET_1D && !texture_size_is_good(h, border, largest)) ||
        (kind == TARGET_3D && !texture_size_is_good(d, border, largest)) || (kind == TARGET_CUBE && w != h)) {
        return GL_INVALID_VALUE;
    }
    if (kind == TARGET_RECT && (level != 0 || border != 0)) {
        return GL_INVALID_VALUE;
    }
    if (gl_base_format(internal) == GL_DEPTH_COMPONENT && (kind == TARGET_3D || kind == TARGET_CUBE)) {
        return GL_INVALID_OPERATION;
    }
    return GL_NO_ERROR;
}

static void texture_set_image(gl_image *m, int kind, GLenum internal, int32_t w, int32_t h, int32_t d, int32_t border)
{
    m->width = w - 2 * border;
    m->height = kind == TARGET_1D ? 1 : h - 2 * border;
    m->depth = kind == TARGET_3D ? d - 2 * border : 1;
    m->border = border;
    m->internal = internal;
    m->base = gl_base_format(internal);
}

static void texture_make_mips(gl_context *c, gl_texture *t, int face);

/* Room for an image's texels; their values are not set. */
static int texture_alloc(gl_context *c, gl_image *m, size_t n)
{
    m->texels = gl_alloc(c, 4 * n + 4);
    m->stencil = m->texels != NULL && gl_has_stencil(m->internal) ? gl_alloc(c, n + 4) : NULL;
    if (m->texels == NULL) {
        m->width = m->height = 0;
    } else if (m->stencil != NULL) {
        memset(m->stencil, 0, n);
    }
    return m->texels != NULL;
}

static uint8_t texture_stencil_code(const uint8_t *from)
{
    float code;
    memcpy(&code, from, sizeof code);
    return (uint8_t)(gl_int(code) & 255);
}

/* w: target, level, internal, width, height, depth, border, 1 if stencil codes follow, data of 4 bytes a texel. */
OP(tex_image)
{
    int face;
    const int kind = texture_image_target(w[0].u, &face);
    gl_texture *t = texture_active(c, kind);
    gl_image *m = &t->image[face][w[1].i];
    const uint8_t *from = gl_data_of(w + 8);
    gl_free(c, m->texels);
    gl_free(c, m->stencil);
    m->texels = m->stencil = NULL;
    texture_set_image(m, kind, w[2].u, w[3].i, w[4].i, w[5].i, w[6].i);
    const size_t n = texture_texels(m, kind);
    if (!texture_alloc(c, m, n)) {
        return;
    }
    for (size_t i = 0; i < n && m->stencil != NULL && from != NULL && w[7].i; ++i) {
        m->stencil[i] = texture_stencil_code(from + 4 * (n + i));
    }
    if (from == NULL) {
        memset(m->texels, 0, 4 * n);
    } else if (m->base == GL_DEPTH_COMPONENT || m->base == GL_RGBA) {
        memcpy(m->texels, from, 4 * n);
    } else {
        for (size_t i = 0; i < n; ++i) {
            texture_keep(m->texels + 4 * i, from + 4 * i, m->base);
        }
    }
    if (t->generate && w[1].i == t->base_level) {
        texture_make_mips(c, t, face);
    }
}

OP(tex_sub_image)
{
    int face;
    const int kind = texture_image_target(w[0].u, &face);
    gl_texture *t = texture_active(c, kind);
    CHECK(w[1].i >= 0 && w[1].i < GL_LEVELS, GL_INVALID_VALUE)
    gl_image *m = &t->image[face][w[1].i];
    const uint8_t *from = gl_data_of(w + 9);
    const int32_t b = m->border, bj = kind == TARGET_1D ? 0 : b, bk = kind == TARGET_3D ? b : 0;
    const int32_t x = w[2].i + b, y = w[3].i + bj, z = w[4].i + bk;
    const int32_t row = m->width + 2 * b, rows = m->height + 2 * bj, slices = m->depth + 2 * bk;
    CHECK(m->texels != NULL, GL_INVALID_OPERATION)
    CHECK(x >= 0 && y >= 0 && z >= 0 && w[5].i <= row - x && w[6].i <= rows - y && w[7].i <= slices - z,
          GL_INVALID_VALUE)
    if (from == NULL) {
        return;
    }
    const size_t plane = 4 * (size_t)w[5].i * (size_t)w[6].i * (size_t)w[7].i;
    for (int32_t k = 0; k < w[7].i; ++k) {
        for (int32_t j = 0; j < w[6].i; ++j) {
            const size_t at = ((size_t)(z + k) * (size_t)rows + (size_t)(y + j)) * (size_t)row + (size_t)x;
            uint8_t *to = m->texels + 4 * at;
            for (int32_t i = 0; i < w[5].i && m->stencil != NULL && w[8].i; ++i) {
                m->stencil[at + (size_t)i] = texture_stencil_code(from + plane + 4 * i);
            }
            for (int32_t i = 0; i < w[5].i; ++i, from += 4, to += 4) {
                if (m->base == GL_DEPTH_COMPONENT) {
                    memcpy(to, from, 4);
                } else {
                    texture_keep(to, from, m->base);
                }
            }
        }
    }
    if (t->generate && w[1].i == t->base_level) {
        texture_make_mips(c, t, face);
    }
}

static void texture_image(GLenum target, GLint level, GLenum internal, int32_t w, int32_t h, int32_t d, int dims,
                          GLint border, GLenum format, GLenum type, const void *data)
{
    GL_ENTER_LISTED()
    int face;
    const int proxy = target == GL_PROXY_TEXTURE_1D   ? TARGET_1D
                      : target == GL_PROXY_TEXTURE_2D ? TARGET_2D
                      : target == GL_PROXY_TEXTURE_RECTANGLE_ARB ? TARGET_RECT
                      : target == GL_PROXY_TEXTURE_3D ? TARGET_3D
                      : target == GL_PROXY_TEXTURE_CUBE_MAP ? TARGET_CUBE : -1;
    const int kind = proxy >= 0 ? proxy : texture_image_target(target, &face);
    const int wanted = kind == TARGET_1D ? 1 : kind == TARGET_3D ? 3 : 2;
    GL_FAIL_LISTED(kind < 0 || wanted != dims, GL_INVALID_ENUM)
    GLenum error = gl_check_image(format, type);
    GL_FAIL_LISTED(error != GL_NO_ERROR, error)
    error = texture_check(target, kind, level, internal, w, h, d, border);
    const int32_t largest = texture_largest(kind) + 2 * (border == 1);
    const int is_large = w > largest || (dims > 1 && h > largest) || (dims > 2 && d > largest);
    if (proxy >= 0 && error == GL_NO_ERROR && (uint64_t)w * (uint64_t)h * (uint64_t)d > c->group->heap.bytes / 8) {
        memset(&c->proxy[kind], 0, sizeof c->proxy[kind]); /* too large for the heap */
        return;
    }
    if (proxy >= 0 && (error == GL_NO_ERROR || (is_large && level >= 0 && (border == 0 || border == 1)))) {
        memset(&c->proxy[kind], 0, sizeof c->proxy[kind]);
        if (error == GL_NO_ERROR) {
            texture_set_image(&c->proxy[kind], kind, internal, w, h, d, border);
        }
        return;
    }
    GL_FAIL_LISTED(error != GL_NO_ERROR, error)
    GL_FAIL_LISTED((gl_base_format(internal) == GL_DEPTH_COMPONENT) != texture_is_depth_format(format) ||
                       format == GL_STENCIL_INDEX,
                   GL_INVALID_OPERATION)
    uint8_t *codes = data != NULL ? gl_read_codes(c, w, h, d, dims, format, type, data) : NULL;
    const int both = format == GL_DEPTH_STENCIL;
    gl_word words[10] = {{.u = target}, {.i = level}, {.u = internal}, {.i = w},
                         {.i = h},      {.i = d},     {.i = border},   {.i = both}};
    if (data == NULL || codes != NULL) {
        gl_do_data(c, OP_tex_image, words, 10, codes, (both ? 8 : 4) * (size_t)w * (size_t)h * (size_t)d);
    }
    gl_free(c, codes);
}

void glTexImage1D(GLenum t, GLint l, GLint in, GLsizei w, GLint b, GLenum f, GLenum ty, const void *p)
{
    texture_image(t, l, (GLenum)in, w, 1, 1, 1, b, f, ty, p);
}
void glTexImage2D(GLenum t, GLint l, GLint in, GLsizei w, GLsizei h, GLint b, GLenum f, GLenum ty, const void *p)
{
    texture_image(t, l, (GLenum)in, w, h, 1, 2, b, f, ty, p);
}
void glTexImage3D(GLenum t, GLint l, GLint in, GLsizei w, GLsizei h, GLsizei d, GLint b, GLenum f, GLenum ty,
                  const void *p)
{
    texture_image(t, l, (GLenum)in, w, h, d, 3, b, f, ty, p);
}
void glTexImage3DEXT(GLenum t, GLint l, GLenum in, GLsizei w, GLsizei h, GLsizei d, GLint b, GLenum f, GLenum ty,
                     const void *p)
{
    texture_image(t, l, in, w, h, d, 3, b, f, ty, p);
}

static void texture_sub_image(GLenum target, GLint level, int32_t x, int32_t y, int32_t z, int32_t w, int32_t h,
                              int32_t d, int dims, GLenum format, GLenum type, const void *data)
{
    GL_ENTER_LISTED()
    int face;
    const int kind = texture_image_target(target, &face);
    GL_FAIL_LISTED(kind < 0 || (kind == TARGET_1D ? 1 : kind == TARGET_3D ? 3 : 2) != dims, GL_INVALID_ENUM)
    const GLenum error = gl_check_image(format, type);
    GL_FAIL_LISTED(error != GL_NO_ERROR, error)
    GL_FAIL_LISTED(level < 0 || level >= GL_LEVELS || w < 0 || h < 0 || d < 0 || w > GL_SIDE + 2 ||
                       h > GL_SIDE + 2 || d > GL_SIDE + 2,
                   GL_INVALID_VALUE)
    const gl_image *m = &texture_active(c, kind)->image[face][level];
    GL_FAIL_LISTED(c->list_mode == 0 && m->texels != NULL &&
                       (m->base == GL_DEPTH_COMPONENT) != texture_is_depth_format(format),
                   GL_INVALID_OPERATION)
    const int both = format == GL_DEPTH_STENCIL;
    uint8_t *codes = data != NULL ? gl_read_codes(c, w, h, d, dims, format, type, data) : NULL;
    gl_word words[11] = {{.u = target}, {.i = level}, {.i = x}, {.i = y},   {.i = z},
                         {.i = w},      {.i = h},     {.i = d}, {.i = both}};
    if (data == NULL || codes != NULL) {
        gl_do_data(c, OP_tex_sub_image, words, 11, codes, (both ? 8 : 4) * (size_t)w * (size_t)h * (size_t)d);
    }
    gl_free(c, codes);
}

void glTexSubImage1D(GLenum t, GLint l, GLint x, GLsizei w, GLenum f, GLenum ty, const void *p)
{
    texture_sub_image(t, l, x, 0, 0, w, 1, 1, 1, f, ty, p);
}
void glTexSubImage2D(GLenum t, GLint l, GLint x, GLint y, GLsizei w, GLsizei h, GLenum f, GLenum ty, const void *p)
{
    texture_sub_image(t, l, x, y, 0, w, h, 1, 2, f, ty, p);
}
void glTexSubImage3D(GLenum t, GLint l, GLint x, GLint y, GLint z, GLsizei w, GLsizei h, GLsizei d, GLenum f, GLenum ty,
                     const void *p)
{
    texture_sub_image(t, l, x, y, z, w, h, d, 3, f, ty, p);
}

/* --- copies of the drawn picture ---------------------------------------------------------------------------------- */

static GLenum texture_copy_format(int depth, int both)
{
    return both ? GL_DEPTH_STENCIL : depth ? GL_DEPTH_COMPONENT : GL_RGBA;
}

static void texture_run_with(gl_context *c, void (*op)(gl_context *, const gl_word *), gl_word *w, int words,
                             uint8_t *codes)
{
    const uint64_t at = (uintptr_t)codes;
    memcpy(&w[words - 2], &at, sizeof at);
    if (codes != NULL) {
        op(c, w);
    }
    gl_free(c, codes);
}

/* w: target, level, internal, x, y, width, height, border, dims */
OP(copy_tex_image)
{
    int face;
    const int kind = texture_image_target(w[0].u, &face), dims = w[8].i;
    CHECK(kind >= 0 && kind != TARGET_3D && (kind == TARGET_1D) == (dims == 1), GL_INVALID_ENUM)
    CHECK(w[2].u > 4, GL_INVALID_ENUM)
    CHECK(gl_base_format(w[2].u) != 0, GL_INVALID_ENUM)
    const GLenum error = texture_check(w[0].u, kind, w[1].i, w[2].u, w[5].i, w[6].i, 1, w[7].i);
    CHECK(error == GL_NO_ERROR, error)
    if (!gl_surface_ready(c, c->read_framebuffer)) {
        return;
    }
    const int depth = gl_base_format(w[2].u) == GL_DEPTH_COMPONENT, both = gl_has_stencil(w[2].u);
    gl_word words[10] = {w[0], w[1], w[2], w[5], w[6], {.i = 1}, w[7], {.i = both}};
    texture_run_with(c, gl_op_tex_image, words, 10,
                     gl_copy_codes(c, w[3].i, w[4].i, w[5].i, w[6].i, texture_copy_format(depth, both)));
}

/* w: target, level, x, y, z of the texture, x, y, width, height, dims */
OP(copy_tex_sub_image)
{
    int face;
    const int kind = texture_image_target(w[0].u, &face);
    CHECK(kind >= 0 && (kind == TARGET_1D ? 1 : kind == TARGET_3D ? 3 : 2) == w[9].i, GL_INVALID_ENUM)
    CHECK(w[1].i >= 0 && w[1].i < GL_LEVELS && w[7].i >= 0 && w[8].i >= 0 && w[7].i <= GL_SIDE + 2 &&
              w[8].i <= GL_SIDE + 2,
          GL_INVALID_VALUE)
    if (!gl_surface_ready(c, c->read_framebuffer)) {
        return;
    }
    const gl_image *m = &texture_active(c, kind)->image[face][w[1].i];
    const int depth = m->base == GL_DEPTH_COMPONENT, both = m->stencil != NULL;
    gl_word words[11] = {w[0], w[1], w[2], w[3], w[4], w[7], w[8], {.i = 1}, {.i = both}};
    texture_run_with(c, gl_op_tex_sub_image, words, 11,
                     gl_copy_codes(c, w[5].i, w[6].i, w[7].i, w[8].i, texture_copy_format(depth, both)));
}

#define U(v) {.u = (v)}
#define I(v) {.i = (v)}
static void texture_do_copy(int op, const gl_word *w, int n)
{
    if (gl_now != NULL) {
        gl_do(gl_now, op, w, n);
    }
}
void glCopyTexImage1D(GLenum t, GLint l, GLenum in, GLint x, GLint y, GLsizei w, GLint b)
{
    const gl_word words[] = {U(t), I(l), U(in), I(x), I(y), I(w), I(1), I(b), I(1)};
    texture_do_copy(OP_copy_tex_image, words, 9);
}
void glCopyTexImage2D(GLenum t, GLint l, GLenum in, GLint x, GLint y, GLsizei w, GLsizei h, GLint b)
{
    const gl_word words[] = {U(t), I(l), U(in), I(x), I(y), I(w), I(h), I(b), I(2)};
    texture_do_copy(OP_copy_tex_image, words, 9);
}
void glCopyTexSubImage1D(GLenum t, GLint l, GLint tx, GLint x, GLint y, GLsizei w)
{
    const gl_word words[] = {U(t), I(l), I(tx), I(0), I(0), I(x), I(y), I(w), I(1), I(1)};
    texture_do_copy(OP_copy_tex_sub_image, words, 10);
}
void glCopyTexSubImage2D(GLenum t, GLint l, GLint tx, GLint ty, GLint x, GLint y, GLsizei w, GLsizei h)
{
    const gl_word words[] = {U(t), I(l), I(tx), I(ty), I(0), I(x), I(y), I(w), I(h), I(2)};
    texture_do_copy(OP_copy_tex_sub_image, words, 10);
}
void glCopyTexSubImage3D(GLenum t, GLint l, GLint tx, GLint ty, GLint tz, GLint x, GLint y, GLsizei w, GLsizei h)
{
    const gl_word words[] = {U(t), I(l), I(tx), I(ty), I(tz), I(x), I(y), I(w), I(h), I(3)};
    texture_do_copy(OP_copy_tex_sub_image, words, 10);
}

/* --- smaller levels ----------------------------------------------------------------------------------------------- */

static void texture_halve(uint8_t *to, const gl_image *m, int32_t w, int32_t h, int32_t d)
{
    for (int32_t z = 0; z < d; ++z) {
        for (int32_t y = 0; y < h; ++y) {
            for (int32_t x = 0; x < w; ++x, to += 4) {
                uint32_t sum[4] = {4, 4, 4, 4};
                float depth = 0.0f;
                for (int n = 0; n < 8; ++n) {
                    const int32_t i = mini(2 * x + (n & 1), m->width - 1),
                                  j = mini(2 * y + (n >> 1 & 1), m->height - 1),
                                  k = mini(2 * z + (n >> 2), m->depth - 1);
                    const uint8_t *p =
                        m->texels + 4 * (((size_t)k * (size_t)m->height + (size_t)j) * (size_t)m->width + (size_t)i);
                    float v;
                    memcpy(&v, p, sizeof v);
                    depth += m->base == GL_DEPTH_COMPONENT ? v * 0.125f : 0.0f;
                    for (int q = 0; q < 4; ++q) {
                        sum[q] += p[q];
                    }
                }
                if (m->base == GL_DEPTH_COMPONENT) {
                    memcpy(to, &depth, sizeof depth);
                } else {
                    for (int q = 0; q < 4; ++q) {
                        to[q] = (uint8_t)(sum[q] / 8);
                    }
                }
            }
        }
    }
}

static void texture_make_mips(gl_context *c, gl_texture *t, int face)
{
    for (int l = t->base_level; l + 1 < GL_LEVELS && l < t->max_level; ++l) {
        const gl_image *m = &t->image[face][l];
        gl_image *next = &t->image[face][l + 1];
        const int32_t w = maxi(m->width / 2, 1), h = maxi(m->height / 2, 1), d = maxi(m->depth / 2, 1);
        if (m->texels == NULL || m->border != 0 || (m->width <= 1 && m->height <= 1 && m->depth <= 1)) {
            return;
        }
        uint8_t *texels = gl_alloc(c, 4 * (size_t)w * (size_t)h * (size_t)d);
        if (texels == NULL) {
            return;
        }
        texture_halve(texels, m, w, h, d);
        gl_free(c, next->texels);
        gl_free(c, next->stencil);
        *next = *m;
        next->stencil = NULL;
        next->texels = texels;
        next->width = w;
        next->height = h;
        next->depth = d;
    }
}

void glGenerateMipmapEXT(GLenum target)
{
    GL_ENTER()
    const int kind = texture_target(target);
    GL_FAIL(kind < 0 || kind == TARGET_RECT, GL_INVALID_ENUM, )
    gl_flush_vertices(c);
    c->dirty = 1;
    gl_texture *t = texture_active(c, kind);
    GL_FAIL(kind == TARGET_CUBE && t->image[0][0].texels == NULL, GL_INVALID_OPERATION, )
    for (int f = 0; f < (kind == TARGET_CUBE ? 6 : 1); ++f) {
        texture_make_mips(c, t, f);
    }
}

/* --- parameters --------------------------------------------------------------------------------------------------- */

static int texture_is_wrap(GLenum v)
{
    return v == GL_REPEAT || v == GL_CLAMP || v == GL_CLAMP_TO_EDGE || v == GL_CLAMP_TO_BORDER ||
           v == GL_MIRRORED_REPEAT;
}

static int texture_is_swizzle(GLenum v) { return v <= GL_ONE || (v >= GL_RED && v <= GL_ALPHA); }

OP(tex_parameter)
{
    const int kind = texture_target(w[0].u);
    const float f = w[2].f;
    const GLenum v = (GLenum)gl_int(f);
    CHECK(kind >= 0, GL_INVALID_ENUM)
    gl_texture *t = texture_active(c, kind);
    switch (w[1].u) {
    case GL_TEXTURE_MIN_FILTER:
        CHECK(v == GL_NEAREST || v == GL_LINEAR ||
                  (v >= GL_NEAREST_MIPMAP_NEAREST && v <= GL_LINEAR_MIPMAP_LINEAR && kind != TARGET_RECT),
              GL_INVALID_ENUM)
        t->min_filter = v;
        break;
    case GL_TEXTURE_MAG_FILTER:
        CHECK(v == GL_NEAREST || v == GL_LINEAR, GL_INVALID_ENUM)
        t->mag_filter = v;
        break;
    case GL_TEXTURE_WRAP_S: case GL_TEXTURE_WRAP_T: case GL_TEXTURE_WRAP_R:
        CHECK(texture_is_wrap(v) && !(kind == TARGET_RECT && (v == GL_REPEAT || v == GL_MIRRORED_REPEAT)),
              GL_INVALID_ENUM)
        t->wrap[w[1].u == GL_TEXTURE_WRAP_R ? 2 : w[1].u - GL_TEXTURE_WRAP_S] = v;
        break;
    case GL_TEXTURE_BORDER_COLOR:
        for (int i = 0; i < 4; ++i) {
            t->border[i] = gl_unit_range(w[2 + i].f);
        }
        break;
    case GL_TEXTURE_PRIORITY: t->priority = gl_unit_range(f); break;
    case GL_TEXTURE_MIN_LOD: t->min_lod = f; break;
    case GL_TEXTURE_MAX_LOD: t->max_lod = f; break;
    case GL_TEXTURE_LOD_BIAS: t->lod_bias = f; break;
    case GL_TEXTURE_BASE_LEVEL:
        CHECK(f >= 0.0f && !(kind == TARGET_RECT && f != 0.0f), GL_INVALID_VALUE)
        t->base_level = gl_int(f);
        break;
    case GL_TEXTURE_MAX_LEVEL:
        CHECK(f >= 0.0f, GL_INVALID_VALUE)
        t->max_level = gl_int(f);
        break;
    case GL_TEXTURE_MAX_ANISOTROPY_EXT:
        CHECK(f >= 1.0f, GL_INVALID_VALUE)
        t->anisotropy = f;
        break;
    case GL_TEXTURE_SWIZZLE_R_EXT: case GL_TEXTURE_SWIZZLE_G_EXT: case GL_TEXTURE_SWIZZLE_B_EXT:
    case GL_TEXTURE_SWIZZLE_A_EXT:
        CHECK(texture_is_swizzle(v), GL_INVALID_ENUM)
        t->swizzle[w[1].u - GL_TEXTURE_SWIZZLE_R_EXT] = v;
        break;
    case GL_TEXTURE_SWIZZLE_RGBA_EXT:
        for (int i = 0; i < 4; ++i) {
            CHECK(texture_is_swizzle((GLenum)gl_int(w[2 + i].f)), GL_INVALID_ENUM)
        }
        for (int i = 0; i < 4; ++i) {
            t->swizzle[i] = (GLenum)gl_int(w[2 + i].f);
        }
        break;
    case GL_GENERATE_MIPMAP: t->generate = f != 0.0f; break;
    case GL_TEXTURE_COMPARE_MODE:
        CHECK(v == GL_NONE || v == GL_COMPARE_R_TO_TEXTURE, GL_INVALID_ENUM)
        t->compare_mode = v;
        break;
    case GL_TEXTURE_COMPARE_FUNC:
        CHECK(v >= GL_NEVER && v <= GL_ALWAYS, GL_INVALID_ENUM)
        t->compare_func = v;
        break;
    case GL_DEPTH_TEXTURE_MODE:
        CHECK(v == GL_LUMINANCE || v == GL_INTENSITY || v == GL_ALPHA, GL_INVALID_ENUM)
        t->depth_mode = v;
        break;
    default: gl_error(c, GL_INVALID_ENUM); break;
    }
}

/* --- environments ------------------------------------------------------------------------------------------------- */

static int texture_is_combine(GLenum v, int alpha)
{
    return v == GL_REPLACE || v == GL_MODULATE || v == GL_ADD || v == GL_ADD_SIGNED || v == GL_INTERPOLATE ||
           v == GL_SUBTRACT || (!alpha && (v == GL_DOT3_RGB || v == GL_DOT3_RGBA));
}

static void texture_set_combine(gl_context *c, gl_unit *u, GLenum name, GLenum v)
{
    if (name >= GL_SRC0_RGB && name <= GL_SRC2_ALPHA) { /* 0x8580 .. 2 and 0x8588 .. A */
        const int half = name >= GL_SRC0_ALPHA, n = (int)(name - (half ? GL_SRC0_ALPHA : GL_SRC0_RGB));
        CHECK(n < 3, GL_INVALID_ENUM)
        CHECK(v == GL_TEXTURE || v == GL_CONSTANT || v == GL_PRIMARY_COLOR || v == GL_PREVIOUS ||
                  (v >= GL_TEXTURE0 && v < GL_TEXTURE0 + GL_UNITS), GL_INVALID_ENUM)
        u->source[half][n] = v;
        return;
    }
    const int half = name >= GL_OPERAND0_ALPHA, n = (int)(name - (half ? GL_OPERAND0_ALPHA : GL_OPERAND0_RGB));
    CHECK(n >= 0 && n < 3, GL_INVALID_ENUM)
    CHECK(v == GL_SRC_ALPHA || v == GL_ONE_MINUS_SRC_ALPHA ||
              (!half && (v == GL_SRC_COLOR || v == GL_ONE_MINUS_SRC_COLOR)),
          GL_INVALID_ENUM)
    u->operand[half][n] = v;
}

OP(tex_env)
{
    gl_unit *u = &c->s.texture.unit[c->s.texture.active];
    const float f = w[2].f;
    const GLenum v = (GLenum)gl_int(f);
    if (w[0].u == GL_POINT_SPRITE_ARB && w[1].u == GL_COORD_REPLACE_ARB) {
        u->replaces = f != 0.0f;
        return;
    }
    if (w[0].u == GL_TEXTURE_FILTER_CONTROL) {
        CHECK(w[1].u == GL_TEXTURE_LOD_BIAS, GL_INVALID_ENUM)
        u->lod_bias = f;
        return;
    }
    CHECK(w[0].u == GL_TEXTURE_ENV, GL_INVALID_ENUM)
    switch (w[1].u) {
    case GL_TEXTURE_ENV_MODE:
        CHECK(v == GL_MODULATE || v == GL_REPLACE || v == GL_DECAL || v == GL_BLEND || v == GL_ADD || v == GL_COMBINE,
              GL_INVALID_ENUM)
        u->mode = v;
        break;
    case GL_TEXTURE_ENV_COLOR:
        for (int i = 0; i < 4; ++i) {
            u->colour[i] = gl_unit_range(w[2 + i].f);
        }
        break;
    case GL_COMBINE_RGB: case GL_COMBINE_ALPHA:
        CHECK(texture_is_combine(v, w[1].u == GL_COMBINE_ALPHA), GL_INVALID_ENUM)
        u->combine[w[1].u - GL_COMBINE_RGB] = v;
        break;
    case GL_RGB_SCALE: case GL_ALPHA_SCALE:
        CHECK(f == 1.0f || f == 2.0f || f == 4.0f, GL_INVALID_VALUE)
        u->scale[w[1].u == GL_ALPHA_SCALE] = f;
        break;
    default:
        if (w[1].u >= GL_SRC0_RGB && w[1].u <= GL_OPERAND2_ALPHA) {
            texture_set_combine(c, u, w[1].u, v);
        } else {
            gl_error(c, GL_INVALID_ENUM);
        }
        break;
    }
}

/* --- reading back ------------------------------------------------------------------------------------------------- */

/* A texel as glGetTexImage packs it. */
static void texture_get_texel(float v[4], const gl_image *m, const uint8_t *p, GLenum format)
{
    if (m->base == GL_DEPTH_COMPONENT) {
        memcpy(v, p, sizeof *v);
        v[1] = format == GL_DEPTH_STENCIL ? (float)m->stencil[(p - m->texels) / 4] : 0.0f;
        return;
    }
    for (int i = 0; i < 4; ++i) {
        v[i] = (float)p[i] / 255.0f;
    }
    if (format == GL_LUMINANCE || format == GL_LUMINANCE_ALPHA) {
        v[1] = v[2] = 0.0f; /* luminance is red */
    }
    if (m->base == GL_LUMINANCE || m->base == GL_LUMINANCE_ALPHA || m->base == GL_INTENSITY || m->base == GL_ALPHA) {
        v[1] = v[2] = 0.0f; /* read as red */
        v[0] = m->base == GL_ALPHA ? 0.0f : v[0];
        v[3] = m->base == GL_INTENSITY ? 1.0f : v[3];
    }
}

void glGetTexImage(GLenum target, GLint level, GLenum format, GLenum type, void *out)
{
    GL_ENTER()
    int face;
    const int kind = texture_image_target(target, &face);
    GL_FAIL(kind < 0, GL_INVALID_ENUM, )
    GL_FAIL(level < 0 || level >= GL_LEVELS, GL_INVALID_VALUE, )
    const GLenum error = gl_check_image(format, type);
    GL_FAIL(error != GL_NO_ERROR, error, )
    const gl_image *m = &texture_active(c, kind)->image[face][level];
    if (m->texels == NULL || out == NULL) {
        return;
    }
    GL_FAIL((m->base == GL_DEPTH_COMPONENT) != texture_is_depth_format(format) || format == GL_STENCIL_INDEX ||
                format == GL_COLOR_INDEX || (format == GL_DEPTH_STENCIL && m->stencil == NULL),
            GL_INVALID_OPERATION, )
    const int32_t b = m->border, w = m->width + 2 * b, h = m->height + (kind == TARGET_1D ? 0 : 2 * b),
                  d = m->depth + (kind == TARGET_3D ? 2 * b : 0);
    const uint8_t *p = m->texels;
    gl_store s = c->client.pack;
    const int32_t images = kind == TARGET_3D ? s.images : 0, rows = s.rows, pixels = s.pixels;
    s.height = kind == TARGET_3D && s.height > 0 ? s.height : h;
    s.row = s.row > 0 ? s.row : w;
    for (int32_t z = 0; z < d; ++z) {
        for (int32_t y = 0; y < h; ++y) {
            for (int32_t x = 0; x < w; x += GL_SIDE_CUBE) {
                const int32_t n = mini(w - x, GL_SIDE_CUBE);
                for (int32_t k = 0; k < n; ++k, p += 4) {
                    texture_get_texel(c->row[k], m, p, format);
                }
                s.images = images + z;
                s.rows = rows + y;
                s.pixels = pixels + x;
                gl_pack(out, &s, n, 1, 1, 3, format, type, c->row[0]);
            }
        }
    }
}

/* --- compressed images: refused ----------------------------------------------------------------------------------- */

#define REFUSE { if (gl_now != NULL) gl_error(gl_now, GL_INVALID_ENUM); }
void glCompressedTexImage1D(GLenum t, GLint l, GLenum f, GLsizei w, GLint b, GLsizei n, const void *p)
{ (void)t; (void)l; (void)f; (void)w; (void)b; (void)n; (void)p; REFUSE }
void glCompressedTexImage2D(GLenum t, GLint l, GLenum f, GLsizei w, GLsizei h, GLint b, GLsizei n, const void *p)
{ (void)t; (void)l; (void)f; (void)w; (void)h; (void)b; (void)n; (void)p; REFUSE }
void glCompressedTexImage3D(GLenum t, GLint l, GLenum f, GLsizei w, GLsizei h, GLsizei d, GLint b, GLsizei n,
                            const void *p)
{ (void)t; (void)l; (void)f; (void)w; (void)h; (void)d; (void)b; (void)n; (void)p; REFUSE }
void glCompressedTexSubImage1D(GLenum t, GLint l, GLint x, GLsizei w, GLenum f, GLsizei n, const void *p)
{ (void)t; (void)l; (void)x; (void)w; (void)f; (void)n; (void)p; REFUSE }
void glCompressedTexSubImage2D(GLenum t, GLint l, GLint x, GLint y, GLsizei w, GLsizei h, GLenum f, GLsizei n,
                               const void *p)
{ (void)t; (void)l; (void)x; (void)y; (void)w; (void)h; (void)f; (void)n; (void)p; REFUSE }
void glCompressedTexSubImage3D(GLenum t, GLint l, GLint x, GLint y, GLint z, GLsizei w, GLsizei h, GLsizei d, GLenum f,
                               GLsizei n, const void *p)
{ (void)t; (void)l; (void)x; (void)y; (void)z; (void)w; (void)h; (void)d; (void)f; (void)n; (void)p; REFUSE }
void glGetCompressedTexImage(GLenum t, GLint l, void *p)
{
    (void)t; (void)l; (void)p;
    if (gl_now != NULL) {
        gl_error(gl_now, GL_INVALID_OPERATION);
    }
}
