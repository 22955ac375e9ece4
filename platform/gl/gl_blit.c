/* gl_blit.c: glBlitFramebuffer: a rectangle of one framebuffer into a rectangle of another, scaled and mirrored. */
#include "gl_context.h"

enum { BLIT_MAX = 1 << 24 /* px from zero */ };

/* One axis: pixels first .. end of the target, and where target pixel i lies in the source. */
typedef struct blit_axis {
    int32_t first, end;
    float from, step;
    int32_t low, size; /* of the source inside the buffer: low .. size - 1 */
} blit_axis;

static blit_axis blit_plan(int32_t s0, int32_t s1, int32_t d0, int32_t d1, int32_t source, int32_t target)
{
    blit_axis a;
    a.step = d0 != d1 ? (float)(s1 - s0) / (float)(d1 - d0) : 0.0f;
    a.from = (float)s0 - a.step * (float)d0;
    a.first = clampi(mini(d0, d1), 0, target);
    a.end = clampi(maxi(d0, d1), 0, target);
    a.low = clampi(mini(s0, s1), 0, source);
    a.size = clampi(maxi(s0, s1), 0, source);
    return a;
}

/* The source's coordinate of a target pixel's centre. */
static float blit_place(const blit_axis *a, int32_t i) { return a->from + a->step * ((float)i + 0.5f); }

/* The nearest source pixel, or -1 outside. */
static int32_t blit_nearest(const blit_axis *a, int32_t i)
{
    const int32_t at = (int32_t)floorf(blit_place(a, i));
    return at >= a->low && at < a->size ? at : -1;
}

/* Codes of 4 bytes, rows of `width`; linear only if `x` and `y` lie inside. */
static void blit_linear(uint8_t out[4], const uint8_t *codes, int32_t width, const blit_axis *ax, const blit_axis *ay,
                        int32_t i, int32_t j)
{
    const float x = blit_place(ax, i) - 0.5f, y = blit_place(ay, j) - 0.5f;
    const float fx = floorf(x), fy = floorf(y), u = x - fx, v = y - fy;
    const int32_t x0 = clampi((int32_t)fx, ax->low, ax->size - 1), x1 = clampi((int32_t)fx + 1, ax->low, ax->size - 1),
                  y0 = clampi((int32_t)fy, ay->low, ay->size - 1), y1 = clampi((int32_t)fy + 1, ay->low, ay->size - 1);
    const uint8_t *p[4] = {codes + 4 * ((ptrdiff_t)y0 * width + x0), codes + 4 * ((ptrdiff_t)y0 * width + x1),
                           codes + 4 * ((ptrdiff_t)y1 * width + x0), codes + 4 * ((ptrdiff_t)y1 * width + x1)};
    for (int k = 0; k < 4; ++k) {
        const float a = (float)p[0][k] + u * ((float)p[1][k] - (float)p[0][k]),
                    b = (float)p[2][k] + u * ((float)p[3][k] - (float)p[2][k]);
        out[k] = (uint8_t)(a + v * (b - a) + 0.5f);
    }
}

static void blit_colour(const gl_surface *to, const gl_surface *from, const uint8_t *codes, const blit_axis *ax,
                        const blit_axis *ay, int linear)
{
    for (int32_t j = ay->first; j < ay->end; ++j) {
        const int32_t y = blit_nearest(ay, j);
        for (int32_t i = ax->first; i < ax->end && y >= 0; ++i) {
            const int32_t x = blit_nearest(ax, i);
            uint8_t *p = to->colour + 4 * ((ptrdiff_t)j * to->stride + i), v[4];
            if (x < 0) {
                continue;
            }
            if (linear) {
                blit_linear(v, codes, from->width, ax, ay, i, j);
            } else {
                memcpy(v, codes + 4 * ((ptrdiff_t)y * from->width + x), 4);
            }
            const int swaps = to->swaps != from->swaps;
            p[0] = v[swaps ? 2 : 0];
            p[1] = v[1];
            p[2] = v[swaps ? 0 : 2];
            p[3] = to->has_alpha && from->has_alpha ? v[3] : 255;
        }
    }
}

/* Depths or stencil codes: elements of `bytes`, which are not mixed. */
static void blit_elements(uint8_t *to, int32_t to_stride, const uint8_t *from, int32_t width, size_t bytes,
                          const blit_axis *ax, const blit_axis *ay)
{
    for (int32_t j = ay->first; j < ay->end; ++j) {
        const int32_t y = blit_nearest(ay, j);
        for (int32_t i = ax->first; i < ax->end && y >= 0; ++i) {
            const int32_t x = blit_nearest(ax, i);
            if (x >= 0) {
                memcpy(to + bytes * (size_t)((ptrdiff_t)j * to_stride + i),
                       from + bytes * (size_t)((ptrdiff_t)y * width + x), bytes);
            }
        }
    }
}

/* A copy of a buffer without padding: the two rectangles may overlap. */
static uint8_t *blit_copy(gl_context *c, const void *from, int32_t stride, int32_t w, int32_t h, size_t bytes)
{
    uint8_t *copy = gl_alloc(c, bytes * (size_t)w * (size_t)h + 4);
    for (int32_t y = 0; y < h && copy != NULL; ++y) {
        memcpy(copy + bytes * (size_t)w * (size_t)y, (const uint8_t *)from + bytes * (size_t)stride * (size_t)y,
               bytes * (size_t)w);
    }
    return copy;
}

static void blit_scissor(const gl_context *c, blit_axis *ax, blit_axis *ay)
{
    const int32_t *b = c->s.scissor.box;
    if (!gl_is_on(c, CAP_SCISSOR)) {
        return;
    }
    ax->first = maxi(ax->first, b[0]);
    ay->first = maxi(ay->first, b[1]);
    ax->end = (int64_t)b[0] + b[2] < ax->end ? b[0] + b[2] : ax->end;
    ay->end = (int64_t)b[1] + b[3] < ay->end ? b[1] + b[3] : ay->end;
}

static void blit_all(gl_context *c, const gl_surface *from, const gl_surface *to, const blit_axis *ax,
                     const blit_axis *ay, GLbitfield mask, int linear)
{
    uint8_t *copy;
    if ((mask & GL_COLOR_BUFFER_BIT) != 0 && from->colour != NULL && to->colour != NULL &&
        c->s.colour.draw != GL_NONE && c->s.pixel.read != GL_NONE) {
        copy = blit_copy(c, from->colour, from->stride, from->width, from->height, 4);
        if (copy != NULL) {
            blit_colour(to, from, copy, ax, ay, linear);
        }
        gl_free(c, copy);
    }
    if ((mask & GL_DEPTH_BUFFER_BIT) != 0 && from->depth != NULL && to->depth != NULL) {
        copy = blit_copy(c, from->depth, from->depth_stride, from->width, from->height, 4);
        if (copy != NULL) {
            blit_elements((uint8_t *)to->depth, to->depth_stride, copy, from->width, 4, ax, ay);
        }
        gl_free(c, copy);
    }
    if ((mask & GL_STENCIL_BUFFER_BIT) != 0 && from->stencil != NULL && to->stencil != NULL) {
        copy = blit_copy(c, from->stencil, from->stencil_stride, from->width, from->height, 1);
        if (copy != NULL) {
            blit_elements(to->stencil, to->stencil_stride, copy, from->width, 1, ax, ay);
        }
        gl_free(c, copy);
    }
}

void glBlitFramebufferEXT(GLint sx0, GLint sy0, GLint sx1, GLint sy1, GLint dx0, GLint dy0, GLint dx1, GLint dy1,
                          GLbitfield mask, GLenum filter)
{
    GL_ENTER()
    gl_surface from, to;
    const GLint at[8] = {sx0, sy0, sx1, sy1, dx0, dy0, dx1, dy1};
    GL_FAIL((mask & ~(GLbitfield)(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)) != 0,
            GL_INVALID_VALUE, )
    GL_FAIL(filter != GL_NEAREST && filter != GL_LINEAR, GL_INVALID_ENUM, )
    GL_FAIL(filter == GL_LINEAR && (mask & (GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)) != 0,
            GL_INVALID_OPERATION, )
    gl_flush_vertices(c);
    if (!gl_surface_ready(c, c->read_framebuffer) || !gl_surface_ready(c, c->framebuffer)) {
        return;
    }
    for (int i = 0; i < 8; ++i) {
        if (at[i] < -BLIT_MAX || at[i] > BLIT_MAX) {
            return;
        }
    }
    gl_find_surface(c, &from, c->read_framebuffer);
    gl_find_surface(c, &to, c->framebuffer);
    blit_axis ax = blit_plan(sx0, sx1, dx0, dx1, from.width, to.width),
              ay = blit_plan(sy0, sy1, dy0, dy1, from.height, to.height);
    blit_scissor(c, &ax, &ay);
    blit_all(c, &from, &to, &ax, &ay, mask, filter == GL_LINEAR);
    c->dirty = 1;
}
