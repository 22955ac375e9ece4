/* gl_pixels.c: clearing, reading, drawing and copying rectangles of pixels, bitmaps, and the raster position. */
#include "gl_context.h"

#define OP(name) void gl_op_##name(gl_context *c, const gl_word *w)
#define CHECK(good, error) \
    if (!(good)) { gl_error(c, error); return; }
enum { PIXELS_COLOUR, PIXELS_DEPTH, PIXELS_STENCIL, PIXELS_BITS, PIXELS_BOTH /* depth and stencil */ };

static int pixels_kind(GLenum format)
{
    return format == GL_DEPTH_COMPONENT ? PIXELS_DEPTH
           : format == GL_STENCIL_INDEX ? PIXELS_STENCIL
           : format == GL_DEPTH_STENCIL ? PIXELS_BOTH
                                        : PIXELS_COLOUR;
}

/* --- codes -------------------------------------------------------------------------------------------------------- */

static float pixels_index(const gl_context *c, float v)
{
    const int32_t shift = clampi(c->s.pixel.index_shift, -31, 31), i = gl_int(v);
    const uint32_t shifted = shift >= 0 ? (uint32_t)i << shift : (uint32_t)i >> -shift;
    return (float)(int32_t)(shifted + (uint32_t)c->s.pixel.index_offset);
}

static float pixels_depth(const gl_context *c, float v)
{
    return gl_unit_range(v * c->s.pixel.depth_scale + c->s.pixel.depth_bias);
}

static float pixels_stencil(const gl_context *c, float v)
{
    const float code = pixels_index(c, v);
    return c->s.pixel.map_stencil ? c->pixel_map[1][gl_int(code) & (c->pixel_map_size[1] - 1)] : code;
}

/* `stencil`: where the second part of GL_DEPTH_STENCIL goes. */
static void pixels_codes(gl_context *c, uint8_t *out, uint8_t *stencil, float (*row)[4], int n, GLenum format)
{
    const int kind = pixels_kind(format);
    for (int i = 0; i < n && format == GL_COLOR_INDEX; ++i) {
        const int32_t at = gl_int(pixels_index(c, row[i][0]));
        for (int k = 0; k < 4; ++k) { /* PIXEL_MAP_I_TO_R and on */
            row[i][k] = c->pixel_map[2 + k][at & (c->pixel_map_size[2 + k] - 1)];
        }
    }
    if (kind == PIXELS_COLOUR && format != GL_COLOR_INDEX) {
        gl_transfer(c, row[0], (size_t)n);
    }
    for (int i = 0; i < n; ++i) {
        if (kind == PIXELS_DEPTH || kind == PIXELS_BOTH) {
            const float d = pixels_depth(c, row[i][0]);
            const float code = kind == PIXELS_BOTH ? pixels_stencil(c, row[i][1]) : 0.0f;
            memcpy(out + 4 * i, &d, 4);
            if (kind == PIXELS_BOTH) {
                memcpy(stencil + 4 * i, &code, 4);
            }
        } else if (kind == PIXELS_STENCIL) {
            const float code = pixels_stencil(c, row[i][0]);
            memcpy(out + 4 * i, &code, 4);
        } else {
            for (int k = 0; k < 4; ++k) {
                out[4 * i + k] = gl_code(row[i][k]);
            }
        }
    }
}

/* Returns whether the transfer leaves colours unchanged. */
static int pixels_is_plain(const gl_context *c)
{
    int plain = !c->s.pixel.map_colour;
    for (int i = 0; i < 4; ++i) {
        plain &= c->s.pixel.scale[i] == 1.0f && c->s.pixel.bias[i] == 0.0f;
    }
    return plain;
}

static int pixels_are_bytes(GLenum format, GLenum type)
{
    return type == GL_UNSIGNED_BYTE && (format == GL_RGBA || format == GL_RGB || format == GL_BGRA);
}

/* A row of a surface as bytes, if all of the row is inside and nothing changes the colours; 0: not so. */
static int pixels_read_bytes(uint8_t *to, const gl_surface *s, int64_t x, int64_t y, int32_t n, GLenum format)
{
    if (x < 0 || y < 0 || n > s->width - x || y >= s->height) {
        return 0;
    }
    const uint8_t *p = s->colour + ((ptrdiff_t)y * s->stride + (ptrdiff_t)x) * 4;
    const int each = format == GL_RGB ? 3 : 4, red = (format == GL_BGRA) != (s->swaps != 0) ? 2 : 0;
    for (int32_t i = 0; i < n; ++i, p += 4, to += each) {
        to[0] = p[red];
        to[1] = p[1];
        to[2] = p[2 - red];
        if (each == 4) {
            to[3] = s->has_alpha ? p[3] : 255;
        }
    }
    return 1;
}

/* A row of bytes R G B, R G B A or B G R A without going through floats. */
static void pixels_copy_bytes(uint8_t *to, const uint8_t *from, int n, GLenum format)
{
    const int each = format == GL_RGB ? 3 : 4, red = format == GL_BGRA ? 2 : 0;
    if (format == GL_RGBA) {
        memcpy(to, from, 4 * (size_t)n);
        return;
    }
    for (int i = 0; i < n; ++i, to += 4, from += each) {
        to[0] = from[red];
        to[1] = from[1];
        to[2] = from[2 - red];
        to[3] = each == 4 ? from[3] : 255;
    }
}

uint8_t *gl_read_codes(gl_context *c, int w, int h, int d, int dims, GLenum format, GLenum type, const void *data)
{
    const gl_store s = c->client.unpack;
    const size_t plane = 4 * (size_t)w * (size_t)h * (size_t)d;
    uint8_t *out = gl_alloc(c, (format == GL_DEPTH_STENCIL ? 2 * plane : plane) + 4);
    if (out == NULL) {
        return NULL;
    }
    const int is_bytes = pixels_are_bytes(format, type) && pixels_is_plain(c);
    for (int z = 0; z < d && is_bytes; ++z) {
        for (int y = 0; y < h; ++y) {
            const size_t each = format == GL_RGB ? 3 : 4, align = (size_t)s.align,
                         n = (size_t)(s.row > 0 ? s.row : w) * each;
            const size_t stride = (n + align - 1) / align * align,
                         slice = stride * (size_t)(s.height > 0 && dims == 3 ? s.height : h);
            const uint8_t *from = (const uint8_t *)data + (size_t)((dims == 3 ? s.images : 0) + z) * slice +
                                  (size_t)(s.rows + y) * stride + (size_t)s.pixels * each;
            pixels_copy_bytes(out + 4 * (((size_t)z * (size_t)h + (size_t)y) * (size_t)w), from, w, format);
        }
    }
    for (int z = 0; z < d && !is_bytes; ++z) {
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; x += GL_SIDE_CUBE) {
                gl_store at = s;
                const int n = mini(w - x, GL_SIDE_CUBE);
                at.height = s.height > 0 && dims == 3 ? s.height : h;
                at.images = (dims == 3 ? s.images : 0) + z;
                at.rows = s.rows + y;
                at.row = s.row > 0 ? s.row : w;
                at.pixels = s.pixels + x;
                gl_unpack(c->row[0], &at, n, 1, 1, 3, format, type, data);
                uint8_t *to = out + 4 * (((size_t)z * (size_t)h + (size_t)y) * (size_t)w + (size_t)x);
                pixels_codes(c, to, to + plane, c->row, n, format);
            }
        }
    }
    return out;
}

/* Reads row y, n pixels from x on; zeros outside. */
static void pixels_fetch(const gl_surface *s, float (*row)[4], int64_t x, int64_t y, int32_t n, int kind)
{
    for (int32_t i = 0; i < n; ++i) {
        float *v = row[i];
        const int64_t px = x + i;
        v[0] = v[1] = v[2] = v[3] = 0.0f;
        if (px < 0 || y < 0 || px >= s->width || y >= s->height) {
            continue;
        }
        if (kind == PIXELS_DEPTH || kind == PIXELS_BOTH) {
            v[0] = s->depth != NULL ? s->depth[(ptrdiff_t)y * s->depth_stride + px] : 0.0f;
        }
        if (kind == PIXELS_STENCIL || kind == PIXELS_BOTH) {
            v[kind == PIXELS_BOTH] =
                s->stencil != NULL ? (float)s->stencil[(ptrdiff_t)y * s->stencil_stride + px] : 0.0f;
        }
        if (kind != PIXELS_COLOUR) {
            continue;
        }
        if (s->colour != NULL) {
            const uint8_t *p = s->colour + ((ptrdiff_t)y * s->stride + px) * 4;
            for (int k = 0; k < 4; ++k) {
                v[k] = (float)p[s->swaps && k < 3 ? 2 - k : k] / 255.0f;
            }
            v[3] = s->has_alpha ? v[3] : 1.0f;
        }
    }
}

uint8_t *gl_copy_codes(gl_context *c, int32_t x, int32_t y, int32_t w, int32_t h, GLenum format)
{
    gl_surface s;
    if (w < 0 || h < 0 || w > 2 * LMB_MAX_SIDE || h > 2 * LMB_MAX_SIDE) {
        gl_error(c, GL_INVALID_VALUE);
        return NULL;
    }
    const size_t plane = 4 * (size_t)w * (size_t)h;
    uint8_t *out = gl_alloc(c, (format == GL_DEPTH_STENCIL ? 2 * plane : plane) + 4);
    gl_find_surface(c, &s, c->read_framebuffer);
    for (int32_t j = 0; j < h && out != NULL; ++j) {
        for (int32_t i = 0; i < w; i += GL_SIDE_CUBE) {
            const int32_t n = mini(w - i, GL_SIDE_CUBE);
            pixels_fetch(&s, c->row, (int64_t)x + i, (int64_t)y + j, n, pixels_kind(format));
            uint8_t *to = out + 4 * ((size_t)j * (size_t)w + (size_t)i);
            pixels_codes(c, to, to + plane, c->row, n, format);
        }
    }
    return out;
}

/* --- clearing ----------------------------------------------------------------------------------------------------- */

static void pixels_clear_colour(const gl_context *c, const gl_surface *s, int32_t x0, int32_t y0, int32_t x1,
                                int32_t y1)
{
    uint8_t code[4], bits[4];
    for (int k = 0; k < 4; ++k) {
        const int to = s->swaps && k < 3 ? 2 - k : k;
        code[to] = k == 3 && !s->has_alpha ? 255 : gl_code(c->s.colour.clear[k]);
        bits[to] = (c->s.colour.mask >> k & 1u) != 0 && !(k == 3 && !s->has_alpha) ? 255 : 0;
    }
    if (!s->has_alpha) {
        bits[3] = 255; /* it stays 255 */
    }
    uint32_t all, kept;
    memcpy(&all, code, 4);
    memcpy(&kept, bits, 4);
    kept = ~kept;
    all &= ~kept;
    for (int32_t y = y0; y < y1; ++y) {
        uint32_t *p = (uint32_t *)(void *)(s->colour + (ptrdiff_t)y * s->stride * 4);
        if (y > y0 && kept == 0) { /* a copy of the first row */
            memcpy(p + x0, (uint32_t *)(void *)(s->colour + (ptrdiff_t)y0 * s->stride * 4) + x0, (size_t)(x1 - x0) * 4);
            continue;
        }
        for (int32_t x = x0; x < x1 && kept == 0; ++x) {
            p[x] = all;
        }
        for (int32_t x = x0; x < x1 && kept != 0; ++x) {
            p[x] = (p[x] & kept) | all;
        }
    }
}

static void pixels_clear_accum(gl_context *c, int32_t x0, int32_t y0, int32_t x1, int32_t y1);

OP(clear)
{
    gl_surface s;
    CHECK((w[0].u &
           ~(GLbitfield)(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_ACCUM_BUFFER_BIT)) == 0,
          GL_INVALID_VALUE)
    if (!gl_surface_ready(c, c->framebuffer) || c->render_mode != GL_RENDER) {
        return;
    }
    gl_find_surface(c, &s, c->framebuffer);
    if ((w[0].u & GL_COLOR_BUFFER_BIT) != 0 && gl_is_on(c, CAP_BOUNCED)) {
        gl_bounce_frame(c);
    }
    int32_t x0 = 0, y0 = 0, x1 = s.width, y1 = s.height;
    if (gl_is_on(c, CAP_SCISSOR)) {
        const int32_t *b = c->s.scissor.box;
        x0 = clampi(b[0], 0, s.width);
        y0 = clampi(b[1], 0, s.height);
        x1 = (int32_t)((int64_t)b[0] + b[2] < s.width ? maxi(b[0] + b[2], x0) : s.width);
        y1 = (int32_t)((int64_t)b[1] + b[3] < s.height ? maxi(b[1] + b[3], y0) : s.height);
    }
    if ((w[0].u & GL_COLOR_BUFFER_BIT) != 0 && s.colour != NULL && c->s.colour.draw != GL_NONE) {
        pixels_clear_colour(c, &s, x0, y0, x1, y1);
    }
    for (int32_t y = y0; y < y1 && (w[0].u & GL_DEPTH_BUFFER_BIT) != 0 && s.depth != NULL && c->s.depth.mask; ++y) {
        float *d = s.depth + (ptrdiff_t)y * s.depth_stride, clear = (float)c->s.depth.clear;
        if (y > y0) { /* a copy of the first row */
            memcpy(d + x0, s.depth + (ptrdiff_t)y0 * s.depth_stride + x0, (size_t)(x1 - x0) * sizeof *d);
            continue;
        }
        for (int32_t x = x0; x < x1; ++x) {
            d[x] = clear;
        }
    }
    for (int32_t y = y0; y < y1 && (w[0].u & GL_STENCIL_BUFFER_BIT) != 0 && s.stencil != NULL; ++y) {
        uint8_t *d = s.stencil + (ptrdiff_t)y * s.stencil_stride;
        const uint32_t bits = c->s.stencil.write;
        for (int32_t x = x0; x < x1; ++x) {
            d[x] = (uint8_t)((d[x] & ~bits) | ((uint32_t)c->s.stencil.clear & bits));
        }
    }
    if ((w[0].u & GL_ACCUM_BUFFER_BIT) != 0 && c->framebuffer == NULL) {
        pixels_clear_accum(c, x0, y0, x1, y1);
    }
}

/* --- accumulation ------------------------------------------------------------------------------------------------- */

static int pixels_has_accum(gl_context *c)
{
    const size_t bytes = 16 * (size_t)c->window.width * (size_t)c->window.height;
    if (c->accum == NULL && bytes > 0) {
        c->accum = gl_alloc(c, bytes);
        if (c->accum != NULL) {
            memset(c->accum, 0, bytes);
        }
    }
    return c->accum != NULL;
}

static void pixels_clear_accum(gl_context *c, int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    if (!pixels_has_accum(c)) {
        return;
    }
    for (int32_t y = y0; y < y1; ++y) {
        for (int32_t x = x0; x < x1; ++x) {
            memcpy(c->accum + 4 * ((size_t)y * (size_t)c->window.width + (size_t)x), c->s.accum.clear, 16);
        }
    }
}

OP(accum)
{
    const GLenum op = w[0].u;
    const float v = w[1].f;
    CHECK(op >= GL_ACCUM && op <= GL_ADD, GL_INVALID_ENUM)
    CHECK(c->framebuffer == NULL, GL_INVALID_OPERATION)
    if (!pixels_has_accum(c) || c->render_mode != GL_RENDER) {
        return;
    }
    const gl_surface *s = &c->window;
    for (int32_t y = 0; y < s->height; ++y) {
        for (int32_t x = 0; x < s->width; ++x) {
            float *a = c->accum + 4 * ((size_t)y * (size_t)s->width + (size_t)x);
            uint8_t *p = s->colour + ((ptrdiff_t)y * s->stride + x) * 4;
            const int32_t *b = c->s.scissor.box;
            if (gl_is_on(c, CAP_SCISSOR) &&
                (x < b[0] || y < b[1] || (int64_t)x >= (int64_t)b[0] + b[2] || (int64_t)y >= (int64_t)b[1] + b[3])) {
                continue;
            }
            for (int k = 0; k < 4; ++k) {
                const int at = s->swaps && k < 3 ? 2 - k : k;
                const float colour = (float)p[at] / 255.0f;
                switch (op) {
                case GL_ACCUM: a[k] += v * colour; break;
                case GL_LOAD: a[k] = v * colour; break;
                case GL_ADD: a[k] += v; break;
                case GL_MULT: a[k] *= v; break;
                default:
                    if ((c->s.colour.mask >> k & 1u) != 0 && !(k == 3 && !s->has_alpha)) {
                        p[at] = gl_code(a[k] * v);
                    }
                    break;
                }
                a[k] = op == GL_RETURN ? a[k] : clampf(a[k], -1.0f, 1.0f);
            }
        }
    }
}

/* --- reading ------------------------------------------------------------------------------------------------------ */

/* Does a surface lack the buffer of a kind? */
static int pixels_lack(const gl_surface *s, int kind)
{
    return ((kind == PIXELS_DEPTH || kind == PIXELS_BOTH) && s->depth == NULL) ||
           ((kind == PIXELS_STENCIL || kind == PIXELS_BOTH) && s->stencil == NULL);
}

void glReadPixels(GLint x, GLint y, GLsizei w, GLsizei h, GLenum format, GLenum type, void *out)
{
    GL_ENTER()
    gl_surface s;
    const int kind = pixels_kind(format);
    const GLenum error = gl_check_image(format, type);
    GL_FAIL(error != GL_NO_ERROR, error, )
    GL_FAIL(w < 0 || h < 0, GL_INVALID_VALUE, )
    GL_FAIL(format == GL_COLOR_INDEX, GL_INVALID_OPERATION, )
    gl_flush_vertices(c);
    if (!gl_surface_ready(c, c->read_framebuffer) || out == NULL) {
        return;
    }
    gl_find_surface(c, &s, c->read_framebuffer);
    GL_FAIL(pixels_lack(&s, kind) ||
                (kind == PIXELS_COLOUR && (s.colour == NULL || c->s.pixel.read == GL_NONE)), GL_INVALID_OPERATION, )
    const int is_bytes = pixels_are_bytes(format, type) && pixels_is_plain(c);
    for (int32_t j = 0; j < h; ++j) {
        if (is_bytes && pixels_read_bytes(gl_image_row(out, &c->client.pack, w, j, format), &s, x, (int64_t)y + j, w,
                                          format)) {
            continue;
        }
        for (int32_t i = 0; i < w; i += GL_SIDE_CUBE) {
            const int32_t n = mini(w - i, GL_SIDE_CUBE);
            gl_store at = c->client.pack;
            pixels_fetch(&s, c->row, (int64_t)x + i, (int64_t)y + j, n, kind);
            for (int32_t k = 0; k < n && kind != PIXELS_COLOUR; ++k) {
                float *v = c->row[k];
                v[1] = kind == PIXELS_BOTH ? pixels_stencil(c, v[1]) : 0.0f;
                v[0] = kind == PIXELS_STENCIL ? pixels_stencil(c, v[0]) : pixels_depth(c, v[0]);
            }
            if (kind == PIXELS_COLOUR) {
                gl_transfer(c, c->row[0], (size_t)n);
            }
            at.rows += j;
            at.row = at.row > 0 ? at.row : w;
            at.pixels += i;
            gl_pack(out, &at, n, 1, 1, 2, format, type, c->row[0]);
        }
    }
}

/* --- the raster position ------------------------------------------------------------------------------------------ */

static void pixels_set_raster(gl_context *c, const gl_made *m, int lit)
{
    const gl_vertex *v = &c->s.current.v;
    memcpy(c->s.current.raster_colour, lit ? m->colour[0] : v->colour, 4 * sizeof(float));
    for (int i = 0; i < 3; ++i) {
        c->s.current.raster_second[i] = lit ? m->second[0][i] : gl_is_on(c, CAP_COLOR_SUM) ? v->second[i] : 0.0f;
    }
    for (int i = 0; i < 4; ++i) {
        c->s.current.raster_colour[i] = gl_unit_range(c->s.current.raster_colour[i]);
    }
    for (int u = 0; u < GL_UNITS; ++u) {
        memcpy(c->s.current.raster_tex[u], c->s.texture.unit[u].on != 0 ? m->tex[u] : v->tex[u], 4 * sizeof(float));
    }
}

OP(raster_pos)
{
    gl_made m;
    gl_vertex v = c->s.current.v;
    int in = 1;
    memset(&m, 0, sizeof m);
    memcpy(v.at, w, sizeof v.at);
    gl_update_matrices(c);
    gl_matrix_point(m.eye, c->modelview.m[c->modelview.top], v.at);
    gl_matrix_point(m.clip, c->projection.m[c->projection.top], m.eye);
    for (int i = 0; i < 3; ++i) {
        in &= m.clip[i] >= -m.clip[3] && m.clip[i] <= m.clip[3];
    }
    for (int i = 0; i < GL_CLIP_PLANES; ++i) {
        const float *p = c->s.transform.plane[i];
        in &=
            !gl_is_on(c, CAP_CLIP + i) || p[0] * m.eye[0] + p[1] * m.eye[1] + p[2] * m.eye[2] + p[3] * m.eye[3] >= 0.0f;
    }
    c->s.current.raster_valid = in;
    if (!in) {
        return;
    }
    gl_window_place(c, m.clip, c->s.current.raster);
    c->s.current.raster[3] = m.clip[3];
    c->s.current.raster_distance = c->s.fog.source == GL_FOG_COORD ? v.fog : absf(m.eye[2]);
    if (gl_is_on(c, CAP_LIGHTING)) {
        gl_light_vertex(c, &v, &m);
    }
    gl_gen_vertex(c, v.at, &v, &m);
    pixels_set_raster(c, &m, gl_is_on(c, CAP_LIGHTING));
    if (c->render_mode == GL_SELECT) {
        c->hit = 1;
        c->hit_min = minf(c->hit_min, c->s.current.raster[2]);
        c->hit_max = maxf(c->hit_max, c->s.current.raster[2]);
    }
}

OP(window_pos)
{
    const float near = (float)c->s.viewport.range[0], far = (float)c->s.viewport.range[1];
    gl_made m;
    memset(&m, 0, sizeof m);
    for (int u = 0; u < GL_UNITS; ++u) {
        memcpy(m.tex[u], c->s.current.v.tex[u], sizeof m.tex[u]);
    }
    c->s.current.raster[0] = w[0].f;
    c->s.current.raster[1] = w[1].f;
    c->s.current.raster[2] = near + (far - near) * gl_unit_range(w[2].f);
    c->s.current.raster[3] = 1.0f;
    c->s.current.raster_valid = 1;
    c->s.current.raster_distance = c->s.fog.source == GL_FOG_COORD ? c->s.current.v.fog : 0.0f;
    pixels_set_raster(c, &m, 0);
}

/* --- drawing ------------------------------------------------------------------------------------------------------ */

/* The pixel of the image at a pixel of the window. */
static uint64_t pixels_shade(void *user, const lmb_draw_pixels_of *p, uint8_t out[64][4])
{
    const gl_context *c = user;
    uint64_t kept = p->mask;
    const int plain = !gl_is_on(c, CAP_FOG) && !gl_unit_is_on(c, 0) && !gl_unit_is_on(c, 1) && !gl_unit_is_on(c, 2) &&
                      !gl_unit_is_on(c, 3);
    for (uint64_t bits = p->mask; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const int32_t i = clampi((int32_t)floorf(((float)(p->x + (k & 7)) + 0.5f - c->drawing.x) / c->drawing.zoom[0]),
                                 0, c->drawing.width - 1);
        const int32_t j = clampi((int32_t)floorf(((float)(p->y + (k >> 3)) + 0.5f - c->drawing.y) / c->drawing.zoom[1]),
                                 0, c->drawing.height - 1);
        if (c->drawing.kind == PIXELS_BITS) {
            const size_t at = (size_t)j * (size_t)((c->drawing.width + 7) / 8) + (size_t)i / 8;
            if ((c->drawing.codes[at] >> (7 - i % 8) & 1) == 0) {
                kept &= ~((uint64_t)1 << k);
            }
            memcpy(out[k], c->drawing.colour, 4);
            continue;
        }
        if (c->drawing.kind == PIXELS_DEPTH) {
            memcpy(out[k], c->drawing.colour, 4);
            continue;
        }
        const uint8_t *code = c->drawing.codes + 4 * ((size_t)j * (size_t)c->drawing.width + (size_t)i);
        memcpy(out[k], code, 4);
        if (!plain) {
            float colour[4];
            for (int n = 0; n < 4; ++n) {
                colour[n] = (float)code[n] / 255.0f;
            }
            gl_shade_raster(c, colour);
            for (int n = 0; n < 4; ++n) {
                out[k][n] = gl_code(colour[n]);
            }
        }
    }
    return kept;
}

/* draw.h's state for a rectangle in the window. */
static int pixels_begin(gl_context *c)
{
    c->dirty = 1;
    gl_set_draw(c);
    c->dirty = 1;
    const int32_t width = c->drawn.width, height = c->drawn.height;
    if (!(c->target.colour.data != NULL || c->target.depth.data != NULL) || width < 1 || height < 1) {
        return 0;
    }
    lmb_draw_state *d = &c->draw;
    if (!c->draws) {
        return 0;
    }
    memset(&d->to_clip, 0, sizeof d->to_clip);
    d->to_clip.m[0] = 2.0f / (float)width;
    d->to_clip.m[5] = -2.0f / (float)height;
    d->to_clip.m[10] = d->to_clip.m[15] = 1.0f;
    d->to_clip.m[12] = -1.0f;
    d->to_clip.m[13] = 1.0f;
    d->viewport[0] = d->viewport[1] = 0;
    d->viewport[2] = width;
    d->viewport[3] = height;
    d->depth_range[0] = 0.0f;
    d->depth_range[1] = 1.0f;
    d->planes = 0;
    d->offset_slope = d->offset_units = 0.0f;
    d->flags &= ~(uint32_t)(LMB_DRAW_CULL_BACK | LMB_DRAW_CULL_FRONT | LMB_DRAW_FLAT);
    d->shader = pixels_shade;
    d->shader_user = c;
    return 1;
}

static void pixels_rectangle(gl_context *c, float x0, float y0, float x1, float y1, float z)
{
    const float at[4][4] = {{x0, y0, z, 1.0f}, {x1, y0, z, 1.0f}, {x1, y1, z, 1.0f}, {x0, y1, z, 1.0f}};
    lmb_draw_vertices v;
    memset(&v, 0, sizeof v);
    memcpy(c->eye_of, at, sizeof at);
    v.positions = c->eye_of;
    v.position_format = LMB_DRAW_F32X4;
    v.count = 4;
    (void)lmb_draw_list(&c->target, &c->draw, &v, LMB_DRAW_QUADS, NULL, NULL);
}

static void pixels_set_drawing(gl_context *c, const uint8_t *codes, int32_t w, int32_t h, int kind)
{
    float colour[4];
    memcpy(colour, c->s.current.raster_colour, sizeof colour);
    gl_shade_raster(c, colour);
    for (int k = 0; k < 4; ++k) {
        c->drawing.colour[k] = gl_code(colour[k]);
    }
    c->drawing.codes = codes;
    c->drawing.width = w;
    c->drawing.height = h;
    c->drawing.kind = kind;
    c->drawing.x = c->s.current.raster[0];
    c->drawing.y = c->s.current.raster[1];
    c->drawing.zoom[0] = kind == PIXELS_BITS ? 1.0f : c->s.pixel.zoom[0];
    c->drawing.zoom[1] = kind == PIXELS_BITS ? 1.0f : c->s.pixel.zoom[1];
}

/* Codes go into the stencil and depths, if they are there, into the depth buffer: whole pixels of the zoomed image. */
static void pixels_draw_direct(gl_context *c, const uint8_t *stencil, const uint8_t *depth)
{
    const gl_surface *s = &c->drawn;
    const int32_t *b = c->s.scissor.box;
    for (int32_t y = 0; y < s->height && s->stencil != NULL; ++y) {
        for (int32_t x = 0; x < s->width; ++x) {
            const float u = floorf(((float)x + 0.5f - c->drawing.x) / c->drawing.zoom[0]),
                        v = floorf(((float)y + 0.5f - c->drawing.y) / c->drawing.zoom[1]);
            float code;
            if (!(u >= 0.0f && v >= 0.0f && u < (float)c->drawing.width && v < (float)c->drawing.height) ||
                (gl_is_on(c, CAP_SCISSOR) &&
                 (x < b[0] || y < b[1] || (int64_t)x >= (int64_t)b[0] + b[2] || (int64_t)y >= (int64_t)b[1] + b[3]))) {
                continue;
            }
            const size_t at = 4 * ((size_t)v * (size_t)c->drawing.width + (size_t)u);
            memcpy(&code, stencil + at, 4);
            if (depth != NULL && s->depth != NULL && c->s.depth.mask) {
                memcpy(&s->depth[(ptrdiff_t)y * s->depth_stride + x], depth + at, 4);
            }
            uint8_t *to = &s->stencil[(ptrdiff_t)y * s->stencil_stride + x];
            *to = (uint8_t)((*to & ~c->s.stencil.write) | ((uint32_t)gl_int(code) & c->s.stencil.write & 255u));
        }
    }
}

static void pixels_draw_depth(gl_context *c)
{
    for (int32_t j = 0; j < c->drawing.height; ++j) {
        const uint8_t *row = c->drawing.codes + 4 * (size_t)j * (size_t)c->drawing.width;
        for (int32_t i = 0, n; i < c->drawing.width; i += n) { /* a run of n equal depths is a rectangle */
            float z;
            memcpy(&z, row + 4 * (size_t)i, 4);
            for (n = 1; i + n < c->drawing.width && memcmp(row + 4 * (size_t)(i + n), &z, 4) == 0; ++n) {
            }
            const float x0 = c->drawing.x + c->drawing.zoom[0] * (float)i,
                        y0 = c->drawing.y + c->drawing.zoom[1] * (float)j;
            pixels_rectangle(c, x0, y0, x0 + c->drawing.zoom[0] * (float)n, y0 + c->drawing.zoom[1], z);
        }
    }
}

static void pixels_draw(gl_context *c, const uint8_t *codes, int32_t w, int32_t h, int kind)
{
    if (w == 0 || h == 0 || !c->s.current.raster_valid || !gl_surface_ready(c, c->framebuffer)) {
        return;
    }
    if (c->render_mode == GL_FEEDBACK && kind != PIXELS_BITS) {
        gl_select_primitive(c, NULL, GL_DRAW_PIXEL_TOKEN, 0);
    }
    if (c->render_mode != GL_RENDER || !pixels_begin(c)) {
        return;
    }
    pixels_set_drawing(c, codes, w, h, kind);
    const float x1 = c->drawing.x + c->drawing.zoom[0] * (float)w, y1 = c->drawing.y + c->drawing.zoom[1] * (float)h;
    if (kind == PIXELS_STENCIL) {
        pixels_draw_direct(c, codes, NULL);
    } else if (kind == PIXELS_BOTH) {
        pixels_draw_direct(c, codes + 4 * (size_t)w * (size_t)h, codes);
    } else if (kind == PIXELS_DEPTH) {
        pixels_draw_depth(c);
    } else if (absf(x1) < 1e6f && absf(y1) < 1e6f && absf(c->drawing.x) < 1e6f && absf(c->drawing.y) < 1e6f) {
        pixels_rectangle(c, c->drawing.x, c->drawing.y, x1, y1, c->s.current.raster[2]);
    }
}

OP(draw_pixels) { pixels_draw(c, gl_data_of(w + 3), w[0].i, w[1].i, w[2].i); }

void glDrawPixels(GLsizei w, GLsizei h, GLenum format, GLenum type, const void *data)
{
    GL_ENTER_LISTED()
    const GLenum error = gl_check_image(format, type);
    GL_FAIL_LISTED(error != GL_NO_ERROR, error)
    GL_FAIL_LISTED(w < 0 || h < 0 || w > 2 * LMB_MAX_SIDE || h > 2 * LMB_MAX_SIDE, GL_INVALID_VALUE)
    gl_find_surface(c, &c->drawn, c->framebuffer);
    const int kind = pixels_kind(format);
    GL_FAIL_LISTED(pixels_lack(&c->drawn, kind), GL_INVALID_OPERATION)
    if (data == NULL) {
        return;
    }
    uint8_t *codes = gl_read_codes(c, w, h, 1, 2, format, type, data);
    gl_word words[5] = {{.i = w}, {.i = h}, {.i = kind}};
    if (codes != NULL) {
        gl_do_data(c, OP_draw_pixels, words, 5, codes, (kind == PIXELS_BOTH ? 8 : 4) * (size_t)w * (size_t)h);
    }
    gl_free(c, codes);
}

OP(copy_pixels)
{
    const GLenum formats[3] = {GL_RGBA, GL_DEPTH_COMPONENT, GL_STENCIL_INDEX};
    const int both = w[4].u == GL_DEPTH_STENCIL, kind = both ? PIXELS_BOTH : (int)(w[4].u - GL_COLOR);
    CHECK(both || (w[4].u >= GL_COLOR && w[4].u <= GL_STENCIL), GL_INVALID_ENUM)
    CHECK(w[2].i >= 0 && w[3].i >= 0, GL_INVALID_VALUE)
    if (!gl_surface_ready(c, c->read_framebuffer) || !c->s.current.raster_valid) {
        return;
    }
    gl_surface s;
    gl_find_surface(c, &s, c->read_framebuffer);
    CHECK(!pixels_lack(&s, kind), GL_INVALID_OPERATION)
    if (c->render_mode == GL_FEEDBACK) {
        gl_select_primitive(c, NULL, GL_COPY_PIXEL_TOKEN, 0);
        return;
    }
    uint8_t *codes = gl_copy_codes(c, w[0].i, w[1].i, w[2].i, w[3].i, both ? GL_DEPTH_STENCIL : formats[kind]);
    if (codes != NULL) {
        pixels_draw(c, codes, w[2].i, w[3].i, kind);
    }
    gl_free(c, codes);
}

void glCopyPixels(GLint x, GLint y, GLsizei w, GLsizei h, GLenum type)
{
    const gl_word words[] = {{.i = x}, {.i = y}, {.i = w}, {.i = h}, {.u = type}};
    if (gl_now != NULL) {
        gl_do(gl_now, OP_copy_pixels, words, 5);
    }
}

/* w: width, height, origin, move, bits */
OP(bitmap)
{
    const uint8_t *bits = gl_data_of(w + 6);
    if (!c->s.current.raster_valid) {
        return;
    }
    if (c->render_mode == GL_FEEDBACK) {
        gl_select_primitive(c, NULL, GL_BITMAP_TOKEN, 0);
    }
    if (c->render_mode == GL_RENDER && bits != NULL && w[0].i > 0 && w[1].i > 0 &&
        gl_surface_ready(c, c->framebuffer) && pixels_begin(c)) {
        c->draw.flags |= LMB_DRAW_DISCARDS;
        pixels_set_drawing(c, bits, w[0].i, w[1].i, PIXELS_BITS);
        c->drawing.x = floorf(c->s.current.raster[0] + 1e-4f - w[2].f);
        c->drawing.y = floorf(c->s.current.raster[1] + 1e-4f - w[3].f);
        if (absf(c->drawing.x) < 1e6f && absf(c->drawing.y) < 1e6f) {
            pixels_rectangle(c, c->drawing.x, c->drawing.y, c->drawing.x + (float)w[0].i, c->drawing.y + (float)w[1].i,
                             c->s.current.raster[2]);
        }
    }
    c->s.current.raster[0] += w[4].f;
    c->s.current.raster[1] += w[5].f;
}

void glBitmap(GLsizei w, GLsizei h, GLfloat x, GLfloat y, GLfloat dx, GLfloat dy, const GLubyte *bits)
{
    GL_ENTER_LISTED()
    GL_FAIL_LISTED(w < 0 || h < 0 || w > LMB_MAX_SIDE || h > LMB_MAX_SIDE, GL_INVALID_VALUE)
    gl_word words[8] = {{.i = w}, {.i = h}, {.f = x}, {.f = y}, {.f = dx}, {.f = dy}};
    const size_t row = (size_t)(w + 7) / 8, bytes = row * (size_t)h;
    const gl_store *s = &c->client.unpack;
    uint8_t *copy = bits != NULL && bytes > 0 ? gl_alloc(c, bytes) : NULL;
    if (copy != NULL) {
        memset(copy, 0, bytes);
        for (int j = 0; j < h; ++j) {
            const size_t align = (size_t)s->align, stride = ((size_t)(s->row > 0 ? s->row : w) + 7) / 8;
            const uint8_t *from = bits + (stride + align - 1) / align * align * (size_t)(j + s->rows);
            for (int i = 0; i < w; ++i) {
                const int at = i + s->pixels, shift = s->lsb ? at & 7 : 7 - (at & 7);
                copy[(size_t)j * row + (size_t)i / 8] |= (uint8_t)((from[at / 8] >> shift & 1) << (7 - i % 8));
            }
        }
    }
    gl_do_data(c, OP_bitmap, words, 8, copy, bytes);
    gl_free(c, copy);
}
