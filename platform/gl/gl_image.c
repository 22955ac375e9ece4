/* gl_image.c: pixels in a program's memory, by format and type, as floats and back. */
#include "gl_context.h"

int gl_format_values(GLenum f)
{
    switch (f) {
    case GL_RED: case GL_GREEN: case GL_BLUE: case GL_ALPHA: case GL_LUMINANCE: case GL_DEPTH_COMPONENT:
    case GL_STENCIL_INDEX: case GL_COLOR_INDEX:
        return 1;
    case GL_LUMINANCE_ALPHA: case GL_DEPTH_STENCIL: return 2;
    case GL_RGB: case GL_BGR: return 3;
    case GL_RGBA: case GL_BGRA: case GL_ABGR_EXT: return 4;
    default: return 0;
    }
}

/* Packed types: bytes, and the bits of each value from the first. */
typedef struct image_packed {
    GLenum type;
    int32_t bytes, values, reversed;
    uint8_t bits[4];
} image_packed;
static const image_packed image_packs[] = {
    {GL_UNSIGNED_BYTE_3_3_2, 1, 3, 0, {3, 3, 2, 0}}, {GL_UNSIGNED_BYTE_2_3_3_REV, 1, 3, 1, {3, 3, 2, 0}},
    {GL_UNSIGNED_SHORT_5_6_5, 2, 3, 0, {5, 6, 5, 0}}, {GL_UNSIGNED_SHORT_5_6_5_REV, 2, 3, 1, {5, 6, 5, 0}},
    {GL_UNSIGNED_SHORT_4_4_4_4, 2, 4, 0, {4, 4, 4, 4}}, {GL_UNSIGNED_SHORT_4_4_4_4_REV, 2, 4, 1, {4, 4, 4, 4}},
    {GL_UNSIGNED_SHORT_5_5_5_1, 2, 4, 0, {5, 5, 5, 1}}, {GL_UNSIGNED_SHORT_1_5_5_5_REV, 2, 4, 1, {5, 5, 5, 1}},
    {GL_UNSIGNED_INT_8_8_8_8, 4, 4, 0, {8, 8, 8, 8}}, {GL_UNSIGNED_INT_8_8_8_8_REV, 4, 4, 1, {8, 8, 8, 8}},
    {GL_UNSIGNED_INT_10_10_10_2, 4, 4, 0, {10, 10, 10, 2}}, {GL_UNSIGNED_INT_2_10_10_10_REV, 4, 4, 1, {10, 10, 10, 2}},
    {GL_UNSIGNED_INT_24_8, 4, 2, 0, {24, 8, 0, 0}},
    {GL_FLOAT_32_UNSIGNED_INT_24_8_REV, 8, 2, 0, {32, 8, 0, 0}} /* a float, then the code in the low byte */};

static const image_packed *image_pack(GLenum type)
{
    if (type <= GL_DOUBLE) {
        return NULL;
    }
    for (size_t i = 0; i < sizeof image_packs / sizeof image_packs[0]; ++i) {
        if (image_packs[i].type == type) {
            return &image_packs[i];
        }
    }
    return NULL;
}

int gl_type_is_packed(GLenum type) { return image_pack(type) != NULL; }

int gl_type_bytes(GLenum t)
{
    switch (t) {
    case GL_BYTE: case GL_UNSIGNED_BYTE: return 1;
    case GL_SHORT: case GL_UNSIGNED_SHORT: return 2;
    case GL_INT: case GL_UNSIGNED_INT: case GL_FLOAT: return 4;
    default: return gl_type_is_packed(t) ? image_pack(t)->bytes : 0;
    }
}

GLenum gl_check_image(GLenum format, GLenum type)
{
    const image_packed *p = image_pack(type);
    const int values = gl_format_values(format);
    if (type == GL_BITMAP) {
        return format == GL_COLOR_INDEX || format == GL_STENCIL_INDEX ? GL_NO_ERROR
               : values == 0 ? GL_INVALID_ENUM : GL_INVALID_ENUM;
    }
    if (p != NULL && format == GL_RG) { /* a format of later versions, which fits no packed type */
        return GL_INVALID_OPERATION;
    }
    if (values == 0 || gl_type_bytes(type) == 0) {
        return GL_INVALID_ENUM;
    }
    if (p != NULL) {
        const int fits = p->values == 2   ? format == GL_DEPTH_STENCIL
                         : p->values == 3 ? format == GL_RGB
                                          : format == GL_RGBA || format == GL_BGRA || format == GL_ABGR_EXT;
        return fits ? GL_NO_ERROR : GL_INVALID_OPERATION;
    }
    return format == GL_DEPTH_STENCIL ? GL_INVALID_OPERATION : GL_NO_ERROR;
}

/* Start of rows and slices. */
typedef struct image_layout {
    size_t row, slice, skip, pixel;
} image_layout;

static image_layout image_lay(const gl_store *s, int w, int h, int dims, GLenum format, GLenum type)
{
    image_layout l;
    const size_t n = (size_t)(s->row > 0 ? s->row : w), a = (size_t)s->align;
    const size_t value = (size_t)gl_type_bytes(type);
    l.pixel = gl_type_is_packed(type) ? value : value * (size_t)gl_format_values(format);
    l.row = type == GL_BITMAP ? (n + 7) / 8 : n * l.pixel;
    if (value < a || type == GL_BITMAP) {
        l.row = (l.row + a - 1) / a * a;
    }
    l.slice = l.row * (size_t)(dims == 3 && s->height > 0 ? s->height : h);
    l.skip = (size_t)s->rows * l.row + (type == GL_BITMAP ? 0 : (size_t)s->pixels * l.pixel);
    l.skip += dims == 3 ? (size_t)s->images * l.slice : 0;
    return l;
}

/* A code of 1, 2 or 4 bytes. */
static uint32_t image_load(const uint8_t *p, int bytes, int swap)
{
    uint8_t b[4] = {0};
    uint16_t v16;
    uint32_t v32;
    for (int i = 0; i < bytes && i < 4; ++i) {
        b[i] = p[swap ? bytes - 1 - i : i];
    }
    if (bytes == 1) {
        return b[0];
    }
    if (bytes == 2) {
        memcpy(&v16, b, 2);
        return v16;
    }
    memcpy(&v32, b, 4);
    return v32;
}

static void image_save(uint8_t *p, uint32_t v, int bytes, int swap)
{
    uint8_t b[4] = {0};
    const uint16_t v16 = (uint16_t)v;
    if (bytes == 1) {
        b[0] = (uint8_t)v;
    } else if (bytes == 2) {
        memcpy(b, &v16, 2);
    } else {
        memcpy(b, &v, 4);
    }
    for (int i = 0; i < bytes; ++i) {
        p[swap ? bytes - 1 - i : i] = b[i];
    }
}

/* A code as a float; a float has 24 bits: the low ones of a larger code. */
static float image_index(uint32_t u) { return (float)(u < 1u << 24 ? u : u & 0xffffffu); }

/* A value as a float; indices stay whole. */
static float image_value(const uint8_t *p, GLenum type, int swap, int index)
{
    const uint32_t u = image_load(p, gl_type_bytes(type), swap);
    float f;
    switch (type) {
    case GL_UNSIGNED_BYTE: return index ? (float)u : (float)u / 255.0f;
    case GL_BYTE: return index ? (float)(int8_t)u : (2.0f * (float)(int8_t)u + 1.0f) / 255.0f;
    case GL_UNSIGNED_SHORT: return index ? (float)u : (float)u / 65535.0f;
    case GL_SHORT: return index ? (float)(int16_t)u : (2.0f * (float)(int16_t)u + 1.0f) / 65535.0f;
    case GL_UNSIGNED_INT: return index ? image_index(u) : (float)((double)u / 4294967295.0);
    case GL_INT: return index ? image_index(u) : (float)((2.0 * (double)(int32_t)u + 1.0) / 4294967295.0);
    default:
        memcpy(&f, &u, sizeof f);
        return f;
    }
}

static uint32_t image_code(float v, GLenum type, int index)
{
    uint32_t u;
    const double d = (double)v;
    switch (type) {
    case GL_UNSIGNED_BYTE: return index ? (uint32_t)gl_int(v) & 255u : gl_code(v);
    case GL_BYTE:
        return (uint32_t)(index ? gl_int(v) & 127
                                : gl_int(floorf((255.0f * clampf(v, -1.0f, 1.0f) - 1.0f) * 0.5f + 0.5f)));
    case GL_UNSIGNED_SHORT:
        return index ? (uint32_t)gl_int(v) & 0xffffu : (uint32_t)(gl_unit_range(v) * 65535.0f + 0.5f);
    case GL_SHORT:
        return (uint32_t)(index ? gl_int(v) & 32767
                                : gl_int(floorf((65535.0f * clampf(v, -1.0f, 1.0f) - 1.0f) * 0.5f + 0.5f)));
    case GL_UNSIGNED_INT:
        return index ? (uint32_t)gl_int(v) : (uint32_t)((d > 0.0 ? d < 1.0 ? d : 1.0 : 0.0) * 4294967295.0 + 0.5);
    case GL_INT:
        return index ? (uint32_t)gl_int(v)
                     : (uint32_t)(int32_t)((d > 0.0    ? d < 1.0 ? d : 1.0
                                            : d > -1.0 ? d
                                                       : -1.0) *
                                           2147483647.0);
    default:
        memcpy(&u, &v, sizeof u);
        return u;
    }
}

/* Values in the format's order into R G B A. */
static void image_order_in(float out[4], const float v[4], GLenum format)
{
    out[0] = out[1] = out[2] = 0.0f;
    out[3] = 1.0f;
    switch (format) {
    case GL_RED: case GL_DEPTH_COMPONENT: case GL_STENCIL_INDEX: case GL_COLOR_INDEX: out[0] = v[0]; break;
    case GL_GREEN: out[1] = v[0]; break;
    case GL_BLUE: out[2] = v[0]; break;
    case GL_ALPHA: out[3] = v[0]; break;
    case GL_LUMINANCE: case GL_LUMINANCE_ALPHA:
        out[0] = out[1] = out[2] = v[0];
        out[3] = format == GL_LUMINANCE ? 1.0f : v[1];
        break;
    case GL_DEPTH_STENCIL: out[0] = v[0]; out[1] = v[1]; break;
    case GL_BGR: case GL_BGRA:
        out[0] = v[2];
        out[1] = v[1];
        out[2] = v[0];
        out[3] = format == GL_BGRA ? v[3] : 1.0f;
        break;
    case GL_ABGR_EXT:
        for (int i = 0; i < 4; ++i) {
            out[i] = v[3 - i];
        }
        break;
    default: memcpy(out, v, (format == GL_RGB ? 3 : 4) * sizeof *v); break;
    }
}

static void image_order_out(float out[4], const float v[4], GLenum format)
{
    switch (format) {
    case GL_GREEN: out[0] = v[1]; break;
    case GL_BLUE: out[0] = v[2]; break;
    case GL_ALPHA: out[0] = v[3]; break;
    case GL_LUMINANCE: case GL_LUMINANCE_ALPHA:
        out[0] = v[0] + v[1] + v[2];
        out[1] = v[3];
        break;
    case GL_BGR: case GL_BGRA:
        out[0] = v[2];
        out[1] = v[1];
        out[2] = v[0];
        out[3] = v[3];
        break;
    case GL_ABGR_EXT:
        for (int i = 0; i < 4; ++i) {
            out[i] = v[3 - i];
        }
        break;
    default: memcpy(out, v, 4 * sizeof *v); break;
    }
}

static int image_is_index(GLenum format) { return format == GL_STENCIL_INDEX || format == GL_COLOR_INDEX; }

static void image_unpack_pixel(float out[4], const uint8_t *p, GLenum format, GLenum type, int swap)
{
    float v[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    const image_packed *k = image_pack(type);
    if (type == GL_FLOAT_32_UNSIGNED_INT_24_8_REV) {
        v[0] = image_value(p, GL_FLOAT, swap, 0);
        v[1] = (float)(image_load(p + 4, 4, swap) & 255u);
    } else if (k != NULL) {
        const uint32_t u = image_load(p, k->bytes, swap);
        int at = k->reversed ? 0 : 8 * k->bytes;
        for (int i = 0; i < k->values; ++i) {
            at -= k->reversed ? 0 : k->bits[i];
            const uint32_t largest = (1u << k->bits[i]) - 1u, code = u >> at & largest;
            v[i] = k->values == 2 && i == 1 ? (float)code : (float)((double)code / (double)largest);
            at += k->reversed ? k->bits[i] : 0;
        }
    } else {
        const int n = gl_format_values(format), bytes = gl_type_bytes(type), index = image_is_index(format);
        for (int i = 0; i < n; ++i) {
            v[i] = image_value(p + i * bytes, type, swap, index);
        }
    }
    image_order_in(out, v, format);
}

static void image_pack_pixel(uint8_t *p, const float in[4], GLenum format, GLenum type, int swap)
{
    float v[4];
    const image_packed *k = image_pack(type);
    image_order_out(v, in, format);
    if (type == GL_FLOAT_32_UNSIGNED_INT_24_8_REV) {
        image_save(p, image_code(v[0], GL_FLOAT, 0), 4, swap);
        image_save(p + 4, (uint32_t)gl_int(v[1]) & 255u, 4, swap);
        return;
    }
    for (int i = 0; i < 4 && !image_is_index(format) && format != GL_DEPTH_STENCIL; ++i) {
        v[i] = gl_unit_range(v[i]); /* of luminance too, which is a sum */
    }
    if (k != NULL) {
        uint32_t u = 0;
        int at = k->reversed ? 0 : 8 * k->bytes;
        for (int i = 0; i < k->values; ++i) {
            at -= k->reversed ? 0 : k->bits[i];
            const uint32_t largest = (1u << k->bits[i]) - 1u;
            u |= (k->values == 2 && i == 1 ? (uint32_t)v[i] & 255u
                                           : (uint32_t)((double)gl_unit_range(v[i]) * (double)largest + 0.5))
                 << at;
            at += k->reversed ? k->bits[i] : 0;
        }
        image_save(p, u, k->bytes, swap);
        return;
    }
    for (int i = 0; i < gl_format_values(format); ++i) {
        image_save(p + i * gl_type_bytes(type), image_code(v[i], type, image_is_index(format)), gl_type_bytes(type),
                   swap);
    }
}

uint8_t *gl_image_row(void *data, const gl_store *s, int w, int y, GLenum format)
{
    const image_layout l = image_lay(s, w, 1, 2, format, GL_UNSIGNED_BYTE);
    return (uint8_t *)data + l.skip + (size_t)y * l.row;
}

size_t gl_image_bytes(const gl_store *s, int w, int h, int d, GLenum format, GLenum type)
{
    const image_layout l = image_lay(s, w, h, 3, format, type);
    if (w <= 0 || h <= 0 || d <= 0) {
        return 0;
    }
    return l.skip + l.slice * (size_t)(d - 1) + l.row * (size_t)(h - 1) +
           (type == GL_BITMAP ? (size_t)(w + s->pixels + 7) / 8 : l.pixel * (size_t)w);
}

/* A row of floats R G B A or of bytes in that order: most images. */
static int image_unpack_fast(float *out, const uint8_t *row, int w, GLenum format, GLenum type, int swap)
{
    const int n = format == GL_RGBA ? 4 : format == GL_RGB ? 3 : 0;
    if (n == 0 || swap || (type != GL_FLOAT && type != GL_UNSIGNED_BYTE)) {
        return 0;
    }
    if (type == GL_FLOAT && n == 4) {
        memcpy(out, row, 4 * sizeof *out * (size_t)w);
        return 1;
    }
    for (int x = 0; x < w; ++x, out += 4) {
        out[3] = 1.0f;
        for (int i = 0; i < n && type == GL_UNSIGNED_BYTE; ++i) {
            out[i] = (float)row[n * x + i] / 255.0f;
        }
        if (type == GL_FLOAT) {
            memcpy(out, row + 12 * (size_t)x, 12);
        }
    }
    return 1;
}

void gl_unpack(float *out, const gl_store *s, int w, int h, int d, int dims, GLenum format, GLenum type,
               const void *data)
{
    const image_layout l = image_lay(s, w, h, dims, format, type);
    const uint8_t *from = (const uint8_t *)data + l.skip;
    for (int z = 0; z < d; ++z) {
        for (int y = 0; y < h; ++y) {
            const uint8_t *row = from + (size_t)z * l.slice + (size_t)y * l.row;
            if (image_unpack_fast(out, row, w, format, type, s->swap)) {
                out += 4 * (size_t)w;
                continue;
            }
            for (int x = 0; x < w; ++x, out += 4) {
                if (type == GL_BITMAP) {
                    const int at = x + s->pixels, shift = s->lsb ? at & 7 : 7 - (at & 7);
                    out[0] = (float)(row[at / 8] >> shift & 1);
                    out[1] = out[2] = 0.0f;
                    out[3] = 1.0f;
                } else {
                    image_unpack_pixel(out, row + (size_t)x * l.pixel, format, type, s->swap);
                }
            }
        }
    }
}

void gl_pack(void *data, const gl_store *s, int w, int h, int d, int dims, GLenum format, GLenum type,
             const float *from)
{
    const image_layout l = image_lay(s, w, h, dims, format, type);
    uint8_t *to = (uint8_t *)data + l.skip;
    for (int z = 0; z < d; ++z) {
        for (int y = 0; y < h; ++y) {
            uint8_t *row = to + (size_t)z * l.slice + (size_t)y * l.row;
            if (format == GL_RGBA && type == GL_UNSIGNED_BYTE) {
                for (int x = 0; x < 4 * w; ++x, ++from) {
                    row[x] = gl_code(*from);
                }
                continue;
            }
            for (int x = 0; x < w; ++x, from += 4) {
                if (type == GL_BITMAP) {
                    const int at = x + s->pixels, shift = s->lsb ? at & 7 : 7 - (at & 7);
                    row[at / 8] = (uint8_t)((row[at / 8] & ~(1 << shift)) | (((int)from[0] & 1) << shift));
                } else {
                    image_pack_pixel(row + (size_t)x * l.pixel, from, format, type, s->swap);
                }
            }
        }
    }
}

/* --- transfer ----------------------------------------------------------------------------------------------------- */

void gl_transfer(const gl_context *c, float *v, size_t pixels)
{
    int plain = !c->s.pixel.map_colour;
    for (int i = 0; i < 4; ++i) {
        plain &= c->s.pixel.scale[i] == 1.0f && c->s.pixel.bias[i] == 0.0f;
    }
    for (size_t p = 0; p < pixels && !plain; ++p, v += 4) {
        for (int i = 0; i < 4; ++i) {
            v[i] = v[i] * c->s.pixel.scale[i] + c->s.pixel.bias[i];
            if (c->s.pixel.map_colour) {
                const int n = c->pixel_map_size[6 + i];
                v[i] = c->pixel_map[6 + i][(int)(gl_unit_range(v[i]) * (float)(n - 1) + 0.5f)];
            }
        }
    }
}

void glPixelStorei(GLenum name, GLint v)
{
    GL_ENTER()
    gl_store *p = &c->client.pack, *u = &c->client.unpack;
    int32_t *to[] = {&u->swap, &u->lsb, &u->row, &u->rows, &u->pixels, &u->align,
                     &p->swap, &p->lsb, &p->row, &p->rows, &p->pixels, &p->align};
    int32_t *at = name >= GL_UNPACK_SWAP_BYTES && name <= GL_UNPACK_ALIGNMENT ? to[name - GL_UNPACK_SWAP_BYTES]
                  : name >= GL_PACK_SWAP_BYTES && name <= GL_PACK_ALIGNMENT   ? to[6 + name - GL_PACK_SWAP_BYTES]
                  : name == GL_UNPACK_IMAGE_HEIGHT ? &u->height : name == GL_UNPACK_SKIP_IMAGES ? &u->images
                  : name == GL_PACK_IMAGE_HEIGHT   ? &p->height : name == GL_PACK_SKIP_IMAGES   ? &p->images : NULL;
    GL_FAIL(at == NULL, GL_INVALID_ENUM, )
    const int is_align = at == &u->align || at == &p->align;
    const int is_flag = at == &u->swap || at == &u->lsb || at == &p->swap || at == &p->lsb;
    GL_FAIL((is_align && v != 1 && v != 2 && v != 4 && v != 8) || (!is_flag && v < 0), GL_INVALID_VALUE, )
    *at = is_flag ? v != 0 : v;
}

void glPixelStoref(GLenum name, GLfloat v)
{
    glPixelStorei(name, gl_int(floorf(v + 0.5f)));
}
