/* gl_osmesa.c: contexts that draw into a program's memory. RGBA and BGRA with rows from the bottom are drawn there
 * directly. Other formats are drawn into the context's memory, and copied when the program calls finish or flush. */
#ifdef __linux__
#define _DEFAULT_SOURCE /* madvise */
#include <sys/mman.h>
#endif
#include <stdlib.h>

#include "gl_wide.h"
#include "include/GL/osmesa.h"

GL_THREAD gl_context *gl_now;

enum { OSMESA_ALIGN = 64 };

typedef struct osmesa_context {
    gl_context c;
} osmesa_context;

static gl_context *osmesa_of(OSMesaContext c) { return (gl_context *)(void *)c; }

static int osmesa_format_is_known(GLenum f)
{
    return f == OSMESA_RGBA || f == OSMESA_BGRA || f == OSMESA_ARGB || f == OSMESA_RGB || f == OSMESA_BGR ||
           f == OSMESA_RGB_565;
}

static int osmesa_bytes(GLenum f) { return f == OSMESA_RGB || f == OSMESA_BGR ? 3 : f == OSMESA_RGB_565 ? 2 : 4; }

/* Asks the system for large pages: a list of a million vertices touches thousands of small ones for the first time. */
static void osmesa_ask_pages(uint8_t *start, size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    const size_t large = (size_t)1 << 21, skip = (large - (uintptr_t)start % large) % large;
    if (bytes > skip + large) {
        (void)madvise(start + skip, (bytes - skip) / large * large, MADV_HUGEPAGE); /* a hint: it may fail */
    }
#else
    (void)start;
    (void)bytes;
#endif
}

/* One block: the context, the group unless another context shares one, and the heap. */
static gl_context *osmesa_create(GLenum format, int depth, int stencil, int accum, gl_context *share)
{
    const size_t head = (sizeof(gl_context) + OSMESA_ALIGN - 1) / OSMESA_ALIGN * OSMESA_ALIGN;
    const size_t group = (sizeof(gl_group) + OSMESA_ALIGN - 1) / OSMESA_ALIGN * OSMESA_ALIGN;
    size_t heap = GL_HEAP_BYTES;
    uint8_t *block = NULL;
    if (!osmesa_format_is_known(format)) {
        return NULL;
    }
    if (share != NULL) {
        block = malloc(head);
    }
    for (; share == NULL && block == NULL && heap >= 1u << 20; heap /= 2) {
        block = malloc(head + group + heap);
        if (block != NULL) {
            break;
        }
    }
    if (block == NULL) {
        return NULL;
    }
    gl_context *c = (gl_context *)(void *)block;
    memset(c, 0, sizeof *c);
    if (share != NULL) {
        c->group = share->group;
        c->owner = share->owner;
    } else {
        c->group = (gl_group *)(void *)(block + head);
        memset(c->group, 0, sizeof *c->group);
        gl_heap_init(&c->group->heap, block + head + group, heap);
        osmesa_ask_pages(block + head + group, heap);
        c->owner = c;
    }
    ++c->group->users;
    c->format = format;
    c->depth_bits = depth;
    c->stencil_bits = stencil;
    c->accum_bits = accum;
    c->y_up = 1;
    gl_state_init(c);
    const char *kernels = getenv("LAMBENT_GL_KERNELS"); /* "none": plain C; for tests: all draw the same */
    c->kernels = kernels != NULL ? lmb_kernels_named(kernels) : lmb_kernels_pick();
    c->wide = gl_wide_pick(c->kernels);
    return c;
}

OSMesaContext OSMesaCreateContextExt(GLenum format, GLint depth, GLint stencil, GLint accum, OSMesaContext share)
{
    return (OSMesaContext)(void *)osmesa_create(format, depth, stencil, accum, osmesa_of(share));
}

OSMesaContext OSMesaCreateContext(GLenum format, OSMesaContext share)
{
    return OSMesaCreateContextExt(format, 24, 8, 0, share);
}

OSMesaContext OSMesaCreateContextAttribs(const int *a, OSMesaContext share)
{
    int format = OSMESA_RGBA, depth = 0, stencil = 0, accum = 0, major = 1, minor = 0;
    for (; a != NULL && a[0] != 0; a += 2) {
        switch (a[0]) {
        case OSMESA_FORMAT: format = a[1]; break;
        case OSMESA_DEPTH_BITS: depth = a[1]; break;
        case OSMESA_STENCIL_BITS: stencil = a[1]; break;
        case OSMESA_ACCUM_BITS: accum = a[1]; break;
        case OSMESA_PROFILE:
            if (a[1] != OSMESA_COMPAT_PROFILE) {
                return NULL;
            }
            break;
        case OSMESA_CONTEXT_MAJOR_VERSION: major = a[1]; break;
        case OSMESA_CONTEXT_MINOR_VERSION: minor = a[1]; break;
        default: return NULL;
        }
    }
    if (depth < 0 || stencil < 0 || accum < 0 || major > 1 || (major == 1 && minor > 5)) {
        return NULL;
    }
    return OSMesaCreateContextExt((GLenum)format, depth, stencil, accum, share);
}

/* --- the window --------------------------------------------------------------------------------------------------- */

static int osmesa_draws_there(const gl_context *c)
{
    return (c->format == OSMESA_RGBA || c->format == OSMESA_BGRA) && (uintptr_t)c->user % 4 == 0;
}

static void osmesa_free_window(gl_context *c)
{
    gl_free(c, c->own);
    gl_free(c, c->window.depth);
    gl_free(c, c->window.stencil);
    gl_free(c, c->accum);
    gl_free(c, c->depth_codes);
    c->own = NULL;
    c->depth_codes = NULL;
    c->accum = NULL;
    memset(&c->window, 0, sizeof c->window);
}

static int32_t osmesa_row(const gl_context *c) { return c->row_length > 0 ? c->row_length : c->window.width; }

/* Address of the window's row y in the program's memory. */
static uint8_t *osmesa_user_row(const gl_context *c, int32_t y)
{
    const int32_t row = c->y_up ? y : c->window.height - 1 - y;
    return (uint8_t *)c->user + (size_t)row * (size_t)osmesa_row(c) * (size_t)osmesa_bytes(c->format);
}

static void osmesa_copy_row(const gl_context *c, uint8_t *to, uint8_t *own, int out)
{
    static const uint8_t places[3][4] = {{1, 2, 3, 0}, {0, 1, 2, 3}, {2, 1, 0, 3}}; /* ARGB, RGB(A), BGR(A) */
    const int bytes = osmesa_bytes(c->format);
    const uint8_t *place = places[c->format == OSMESA_ARGB                              ? 0
                                  : c->format == OSMESA_BGR || c->format == OSMESA_BGRA ? 2
                                                                                        : 1];
    for (int32_t x = 0; x < c->window.width; ++x, to += bytes, own += 4) {
        if (bytes == 2) {
            uint16_t v;
            if (out) {
                v = (uint16_t)((own[0] * 31u + 127u) / 255u << 11 | (own[1] * 63u + 127u) / 255u << 5 |
                               (own[2] * 31u + 127u) / 255u);
                memcpy(to, &v, 2);
            } else {
                memcpy(&v, to, 2);
                const uint32_t r = v >> 11 & 31u, g = v >> 5 & 63u, b = v & 31u;
                own[0] = (uint8_t)(r << 3 | r >> 2);
                own[1] = (uint8_t)(g << 2 | g >> 4);
                own[2] = (uint8_t)(b << 3 | b >> 2);
                own[3] = 255;
            }
            continue;
        }
        for (int k = 0; k < 4; ++k) {
            if (k < bytes || bytes == 4) {
                if (out) {
                    to[place[k]] = own[k];
                } else {
                    own[k] = to[place[k]];
                }
            } else if (!out) {
                own[k] = 255;
            }
        }
    }
}

static void osmesa_copy(gl_context *c, int out)
{
    for (int32_t y = 0; y < c->window.height && c->own != NULL; ++y) {
        osmesa_copy_row(c, osmesa_user_row(c, y), c->own + 4 * (size_t)y * (size_t)c->window.width, out);
    }
}

void gl_window_out(gl_context *c) { osmesa_copy(c, 1); }

/* Sets the addresses of the window's rows. */
void gl_set_window(gl_context *c)
{
    gl_surface *s = &c->window;
    c->dirty = 1;
    s->has_alpha = c->format == OSMESA_RGBA || c->format == OSMESA_BGRA || c->format == OSMESA_ARGB;
    s->is_complete = 1;
    if (osmesa_draws_there(c)) {
        s->swaps = c->format == OSMESA_BGRA;
        s->stride = c->y_up ? osmesa_row(c) : -osmesa_row(c);
        s->colour = osmesa_user_row(c, 0);
        return;
    }
    if (c->own == NULL) {
        c->own = gl_alloc(c, 4 * (size_t)s->width * (size_t)s->height);
        osmesa_copy(c, 0);
    }
    s->swaps = 0;
    s->stride = s->width;
    s->colour = c->own;
}

static int osmesa_make_buffers(gl_context *c, int32_t w, int32_t h)
{
    gl_surface *s = &c->window;
    const size_t n = (size_t)w * (size_t)h;
    osmesa_free_window(c);
    s->width = w;
    s->height = h;
    const size_t depths = (size_t)gl_depth_stride(w) * (size_t)h;
    s->depth_stride = gl_depth_stride(w);
    s->stencil_stride = w;
    s->depth = c->depth_bits > 0 ? gl_alloc(c, 4 * depths) : NULL;
    s->stencil = c->stencil_bits > 0 ? gl_alloc(c, n) : NULL;
    if ((s->depth == NULL && c->depth_bits > 0) || (s->stencil == NULL && c->stencil_bits > 0)) {
        return 0;
    }
    for (size_t i = 0; i < depths && s->depth != NULL; ++i) {
        s->depth[i] = 1.0f;
    }
    if (s->stencil != NULL) {
        memset(s->stencil, 0, n);
    }
    return 1;
}

GLboolean OSMesaMakeCurrent(OSMesaContext context, void *buffer, GLenum type, GLsizei w, GLsizei h)
{
    gl_context *c = osmesa_of(context);
    if (gl_now != NULL) {
        gl_flush_vertices(gl_now);
        gl_window_out(gl_now);
    }
    if (c == NULL) {
        gl_now = NULL;
        return 1;
    }
    const int is_565 = c->format == OSMESA_RGB_565;
    if (buffer == NULL || w < 1 || h < 1 || w > LMB_MAX_SIDE || h > LMB_MAX_SIDE ||
        type != (is_565 ? GL_UNSIGNED_SHORT_5_6_5 : GL_UNSIGNED_BYTE)) {
        return 0;
    }
    const int first = c->window.width == 0, moved = c->user != buffer;
    c->user = buffer;
    if (c->window.width != w || c->window.height != h) {
        if (!osmesa_make_buffers(c, w, h)) {
            osmesa_free_window(c);
            return 0;
        }
    } else if (moved) {
        gl_free(c, c->own);
        c->own = NULL;
    }
    gl_now = c;
    gl_set_window(c);
    if (c->window.colour == NULL) {
        osmesa_free_window(c);
        gl_now = NULL;
        return 0;
    }
    if (first) {
        c->s.viewport.box[2] = c->s.scissor.box[2] = w;
        c->s.viewport.box[3] = c->s.scissor.box[3] = h;
    }
    return 1;
}

void OSMesaDestroyContext(OSMesaContext context)
{
    gl_context *c = osmesa_of(context);
    if (c == NULL) {
        return;
    }
    if (gl_now == c) {
        gl_flush_vertices(c);
        gl_window_out(c);
        gl_now = NULL;
    }
    gl_context *owner = c->owner;
    osmesa_free_window(c);
    gl_bounce_free(c);
    c->is_destroyed = 1;
    --c->group->users;
    if (owner->group->users == 0) { /* the block with the group goes last */
        if (owner != c) {
            free(owner);
        }
        free(c);
    } else if (owner != c) {
        free(c);
    }
}

OSMesaContext OSMesaGetCurrentContext(void) { return (OSMesaContext)(void *)gl_now; }

void OSMesaPixelStore(GLint name, GLint value)
{
    gl_context *c = gl_now;
    if (c == NULL) {
        return;
    }
    gl_flush_vertices(c);
    if (name == OSMESA_Y_UP) {
        c->y_up = value != 0;
    } else if (name == OSMESA_ROW_LENGTH && value >= 0) {
        c->row_length = value;
    } else {
        gl_error(c, GL_INVALID_VALUE);
        return;
    }
    gl_set_window(c);
}

void OSMesaGetIntegerv(GLint name, GLint *out)
{
    const gl_context *c = gl_now;
    if (c == NULL) {
        return;
    }
    switch (name) {
    case OSMESA_WIDTH: *out = c->window.width; break;
    case OSMESA_HEIGHT: *out = c->window.height; break;
    case OSMESA_FORMAT: *out = (GLint)c->format; break;
    case OSMESA_TYPE: *out = c->format == OSMESA_RGB_565 ? GL_UNSIGNED_SHORT_5_6_5 : GL_UNSIGNED_BYTE; break;
    case OSMESA_ROW_LENGTH: *out = c->row_length; break;
    case OSMESA_Y_UP: *out = c->y_up; break;
    case OSMESA_MAX_WIDTH: case OSMESA_MAX_HEIGHT: *out = LMB_MAX_SIDE; break;
    default: gl_error(gl_now, GL_INVALID_ENUM); break;
    }
}

/* Integers of 4 bytes, with 24-bit depth in the low bits of 32, or of 2 bytes for 16 bits; a copy. */
GLboolean OSMesaGetDepthBuffer(OSMesaContext context, GLint *width, GLint *height, GLint *bytes, void **out)
{
    gl_context *c = osmesa_of(context);
    *width = *height = *bytes = 0;
    *out = NULL;
    if (c == NULL || c->window.depth == NULL) {
        return 0;
    }
    const size_t n = (size_t)c->window.width * (size_t)c->window.height;
    const int wide = c->depth_bits > 16;
    if (gl_now == c) {
        gl_flush_vertices(c);
    }
    if (c->depth_codes == NULL) {
        c->depth_codes = gl_alloc(c, 4 * n);
    }
    for (size_t i = 0; i < n && c->depth_codes != NULL; ++i) {
        const size_t row = i / (size_t)c->window.width, column = i % (size_t)c->window.width;
        const double d = (double)c->window.depth[row * (size_t)c->window.depth_stride + column];
        if (wide) {
            ((uint32_t *)c->depth_codes)[i] = (uint32_t)(d * (c->depth_bits > 24 ? 4294967295.0 : 16777215.0) + 0.5);
        } else {
            ((uint16_t *)c->depth_codes)[i] = (uint16_t)(d * 65535.0 + 0.5);
        }
    }
    if (c->depth_codes == NULL) {
        return 0;
    }
    *width = c->window.width;
    *height = c->window.height;
    *bytes = wide ? 4 : 2;
    *out = c->depth_codes;
    return 1;
}

GLboolean OSMesaGetColorBuffer(OSMesaContext context, GLint *width, GLint *height, GLint *format, void **out)
{
    gl_context *c = osmesa_of(context);
    *width = *height = *format = 0;
    *out = NULL;
    if (c == NULL || c->user == NULL) {
        return 0;
    }
    if (gl_now == c) {
        gl_flush_vertices(c);
        gl_window_out(c);
    }
    *width = c->window.width;
    *height = c->window.height;
    *format = (GLint)c->format;
    *out = c->user;
    return 1;
}

void OSMesaColorClamp(GLboolean enable) { (void)enable; }
void OSMesaPostprocess(OSMesaContext c, const char *filter, unsigned enable)
{
    (void)c;
    (void)filter;
    (void)enable;
}

void glFinish(void)
{
    GL_ENTER()
    gl_flush_vertices(c);
    gl_window_out(c);
}

void glFlush(void) { glFinish(); }
