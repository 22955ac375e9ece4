/* surface.c: sizes, clearing, linearizing, hashing and comparing a caller's pixels. Layer 1.
 *
 * In both layouts the eight pixels that start at a multiple of 8 are contiguous in memory (fewer at the end of a row).
 * All loops here work on such runs, so tiled surfaces need no separate code. */
#include <string.h>

#include "surface_check.h"

#include "vec.h"

#define HASH_START UINT64_C(0xcbf29ce484222325) /* FNV-1a's offset basis and prime */
#define HASH_PRIME UINT64_C(0x100000001b3)

int32_t lmb_pixel_bytes(int32_t format)
{
    switch (format) {
    case LMB_RGB565:
    case LMB_RGB555:
    case LMB_RGB565_BE:
    case LMB_DEPTH16:
    case LMB_ID16: return 2;
    case LMB_RGBA8:
    case LMB_BGRA8:
    case LMB_R32F:
    case LMB_DEPTH32F:
    case LMB_ID32: return 4;
    case LMB_RGB32F: return 12;
    default: return 0;
    }
}

/* Depth and id formats, which have whole tiles. */
static int is_tile_format(int32_t format) { return format >= LMB_DEPTH32F && format <= LMB_ID32; }

static int is_surface_size(int32_t width, int32_t height)
{
    return width >= 1 && width <= LMB_MAX_SIDE && height >= 1 && height <= LMB_MAX_SIDE;
}

static int32_t round_up(int32_t v, int32_t step) { return (v + step - 1) / step * step; }

/* Bytes from one row to the next: rows of tiles for depth and id, otherwise rows of pixels. */
static int32_t packed_stride(int32_t format, int32_t width)
{
    int32_t pixel = lmb_pixel_bytes(format);
    return is_tile_format(format) ? round_up(width, LMB_TILE) * LMB_TILE * pixel : round_up(width * pixel, 4);
}

size_t lmb_surface_bytes(int32_t format, int32_t width, int32_t height)
{
    int32_t rows;
    if (!is_surface_size(width, height) || !lmb_pixel_bytes(format))
        return 0;
    rows = is_tile_format(format) ? round_up(height, LMB_TILE) / LMB_TILE : height;
    return (size_t)packed_stride(format, width) * (size_t)rows;
}

size_t lmb_depth_bytes(int32_t width, int32_t height) { return lmb_surface_bytes(LMB_DEPTH32F, width, height); }

lmb_status lmb_surface_init(lmb_surface *out, int32_t format, int32_t width, int32_t height, void *data, size_t bytes)
{
    if (!out || !data || !is_surface_size(width, height))
        return LMB_ERR_ARG;
    if (!lmb_pixel_bytes(format))
        return LMB_ERR_FORMAT;
    if ((uintptr_t)data & 3u)
        return LMB_ERR_ALIGN;
    if (bytes < lmb_surface_bytes(format, width, height))
        return LMB_ERR_CAPACITY;
    out->data = data;
    out->width = width;
    out->height = height;
    out->stride_bytes = packed_stride(format, width);
    out->format = (uint8_t)format;
    out->layout = is_tile_format(format) ? LMB_TILED : LMB_LINEAR;
    out->reserved = 0;
    return LMB_OK;
}

/* Checks that only depth and id are tiled, rows do not overlap, and pixels are aligned. */
int lmb_surface_is_valid(const lmb_surface *s)
{
    int32_t tile, min;
    if (!s || !s->data || !is_surface_size(s->width, s->height) || !lmb_pixel_bytes(s->format) || s->layout > LMB_TILED)
        return 0;
    tile = mini(lmb_pixel_bytes(s->format), 4);
    if ((uintptr_t)s->data % (uintptr_t)tile != 0 || s->stride_bytes % tile != 0)
        return 0;
    tile = is_tile_format(s->format);
    if (!tile)
        return s->layout == LMB_LINEAR && (s->stride_bytes >= s->width * lmb_pixel_bytes(s->format) ||
                                           s->stride_bytes <= -s->width * lmb_pixel_bytes(s->format));
    min = packed_stride(s->format, s->width);
    /* Draws compute offsets in rows of tiles, eight rows of pixels, which must fit 32 bits too. */
    return s->stride_bytes >= (s->layout == LMB_TILED ? min : min / LMB_TILE) &&
           s->stride_bytes <= INT32_MAX / LMB_TILE;
}

/* The run of pixels that starts at (x, y), x a multiple of 8. */
static unsigned char *run_at(const lmb_surface *s, int32_t x, int32_t y)
{
    int32_t pixel = lmb_pixel_bytes(s->format);
    if (s->layout == LMB_LINEAR)
        return (unsigned char *)s->data + (ptrdiff_t)y * s->stride_bytes + (ptrdiff_t)x * pixel;
    return (unsigned char *)s->data + (ptrdiff_t)(y / LMB_TILE) * s->stride_bytes +
           ((ptrdiff_t)x * LMB_TILE + (ptrdiff_t)(y % LMB_TILE) * LMB_TILE) * pixel;
}

static int32_t run_length(const lmb_surface *s, int32_t x) { return mini(s->width - x, LMB_TILE); }

/* The padding of colour rows stays unchanged, because it may belong to another surface. */
lmb_status lmb_surface_clear(const lmb_surface *surface)
{
    int32_t y, rows, width, row_bytes;
    if (!lmb_surface_is_valid(surface))
        return LMB_ERR_ARG;
    if (is_tile_format(surface->format)) {
        rows = round_up(surface->height, LMB_TILE) / (surface->layout == LMB_TILED ? LMB_TILE : 1);
        width = round_up(surface->width, LMB_TILE) * (surface->layout == LMB_TILED ? LMB_TILE : 1);
    } else {
        rows = surface->height;
        width = surface->width;
    }
    row_bytes = width * lmb_pixel_bytes(surface->format);
    if (surface->stride_bytes == row_bytes) { /* one call for all rows: twice as fast as one for each */
        memset(surface->data, 0, (size_t)row_bytes * (size_t)rows);
        return LMB_OK;
    }
    for (y = 0; y < rows; ++y)
        memset((unsigned char *)surface->data + (ptrdiff_t)y * surface->stride_bytes, 0, (size_t)row_bytes);
    return LMB_OK;
}

lmb_status lmb_depth_linearize(void *out, size_t bytes, const lmb_surface *surface)
{
    unsigned char *to = (unsigned char *)out;
    int32_t x, y, pixel;
    if (!out || !lmb_surface_is_valid(surface))
        return LMB_ERR_ARG;
    if (!is_tile_format(surface->format))
        return LMB_ERR_FORMAT;
    pixel = lmb_pixel_bytes(surface->format);
    if (bytes < (size_t)surface->width * (size_t)surface->height * (size_t)pixel)
        return LMB_ERR_CAPACITY;
    for (y = 0; y < surface->height; ++y) {
        for (x = 0; x < surface->width; x += LMB_TILE) {
            size_t run = (size_t)run_length(surface, x) * (size_t)pixel;
            memcpy(to, run_at(surface, x, y), run);
            to += run;
        }
    }
    return LMB_OK;
}

/* Perspective: d = near / w. Orthographic: d = (far - w) / (far - near). 0 if nothing was drawn. */
float lmb_depth_view_z(const lmb_view *view, float d)
{
    if (!view || !(d > 0.0f))
        return 0.0f;
    if (view->kind == LMB_ORTHOGRAPHIC)
        return view->far_m - d * (view->far_m - view->near_m);
    return view->near_m / d;
}

static uint64_t hash_byte(uint64_t hash, uint32_t byte) { return (hash ^ (byte & 255u)) * HASH_PRIME; }

/* Values of 2 or 4 bytes are read in the target's byte order and hashed low byte first. */
static uint64_t hash_values(uint64_t hash, const unsigned char *at, int32_t count, int32_t value_bytes)
{
    int32_t i;
    for (i = 0; i < count; ++i, at += value_bytes) {
        if (value_bytes == 4) {
            uint32_t v;
            memcpy(&v, at, sizeof v);
            hash = hash_byte(hash_byte(hash_byte(hash_byte(hash, v), v >> 8), v >> 16), v >> 24);
        } else if (value_bytes == 2) {
            uint16_t v;
            memcpy(&v, at, sizeof v);
            hash = hash_byte(hash_byte(hash, v), (uint32_t)v >> 8);
        } else {
            hash = hash_byte(hash, at[0]);
        }
    }
    return hash;
}

/* Bytes of one value of a pixel: 1 if the format defines the order of bytes. */
static int32_t value_bytes_of(int32_t format)
{
    return format >= LMB_RGB565_BE && format <= LMB_BGRA8 ? 1 : mini(lmb_pixel_bytes(format), 4);
}

uint64_t lmb_surface_hash(const lmb_surface *surface)
{
    uint64_t hash = HASH_START;
    int32_t x, y, pixel, value;
    if (!lmb_surface_is_valid(surface))
        return 0;
    pixel = lmb_pixel_bytes(surface->format);
    value = value_bytes_of(surface->format);
    for (y = 0; y < surface->height; ++y)
        for (x = 0; x < surface->width; x += LMB_TILE)
            hash = hash_values(hash, run_at(surface, x, y), run_length(surface, x) * (pixel / value), value);
    return hash;
}

/* Pixels of a run before the first that differs; `count` if none does. */
static int32_t equal_pixels(const unsigned char *a, const unsigned char *b, int32_t count, int32_t pixel)
{
    int32_t i = 0;
    if (memcmp(a, b, (size_t)(count * pixel)) == 0)
        return count;
    while (memcmp(a + i * pixel, b + i * pixel, (size_t)pixel) == 0)
        ++i;
    return i;
}

int32_t lmb_surface_diff(int32_t *x, int32_t *y, const lmb_surface *a, const lmb_surface *b)
{
    int32_t i, j, run, same, pixel;
    if (!x || !y || !lmb_surface_is_valid(a) || !lmb_surface_is_valid(b) || a->width != b->width ||
        a->height != b->height)
        return LMB_ERR_ARG;
    if (a->format != b->format)
        return LMB_ERR_FORMAT;
    pixel = lmb_pixel_bytes(a->format);
    for (j = 0; j < a->height; ++j) {
        for (i = 0; i < a->width; i += LMB_TILE) {
            run = run_length(a, i);
            same = equal_pixels(run_at(a, i, j), run_at(b, i, j), run, pixel);
            if (same < run) {
                *x = i + same;
                *y = j;
                return 1;
            }
        }
    }
    return 0;
}
