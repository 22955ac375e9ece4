/* blit.c: copies pictures, and writes text in a font of our own. Layer 4. */
#include "draw_part.h"

#include <string.h>

#include "../base/surface_check.h"

#if LMB_DRAW
enum { BLIT_SCALE = 64, GLYPH_COUNT = 95, GLYPH_WIDE = 5, CELL_WIDE = 6, CELL_HIGH = 8 };

static const uint8_t glyphs[GLYPH_COUNT + 1][GLYPH_WIDE] = {
#include "font.inc"
};

/* Pixels of the surface to write, and the image pixel behind each. */
typedef struct blit_job {
    const lmb_surface *to;
    const lmb_blit_image *from;
    lmb_blit_how how;
    int64_t x, y;           /* of the part's corner on the surface */
    int32_t x0, x1, y0, y1; /* columns and rows to write: x0 .. x1 - 1 */
    int32_t bytes;          /* per pixel of the image */
} blit_job;

static uint8_t *blit_place(const lmb_surface *to, int32_t x, int32_t y)
{
    return (uint8_t *)to->data + (ptrdiff_t)y * to->stride_bytes + (ptrdiff_t)x * lmb_pixel_bytes(to->format);
}

/* The image's pixel for pixel (x, y) of the surface. */
static const uint8_t *blit_source(const blit_job *j, int32_t x, int32_t y)
{
    const int32_t sx = j->how.part[0] + (int32_t)((x - j->x) / j->how.scale),
                  sy = j->how.part[1] + (int32_t)((y - j->y) / j->how.scale);
    return (const uint8_t *)j->from->data + (ptrdiff_t)sy * j->from->stride_bytes + (ptrdiff_t)sx * j->bytes;
}

static int blit_is_target(const lmb_surface *to) { return is_colour_format(to->format) && to->format != LMB_RGB32F; }

/* Blends codes onto a pixel, in share `alpha`. */
static void blit_mix(const lmb_surface *to, int32_t x, int32_t y, const uint8_t codes[4], uint32_t alpha, int dithers)
{
    uint8_t *at = blit_place(to, x, y), target[4], made[4];
    const uint32_t was = lmb_draw_pixel_bits(to->format, at);
    uint32_t channels = 0;
    lmb_draw_read_pixel(target, to->format, at);
    for (int i = 0; i < 4; ++i) {
        made[i] = (uint8_t)draw_between(i < 3 ? codes[i] : 255, target[i], alpha);
        channels |= (uint32_t)(made[i] != target[i]) << i;
    }
    const uint32_t mask = lmb_draw_pixel_mask(to->format, channels);
    lmb_draw_put_bits(to->format, at, (was & ~mask) | (lmb_draw_pixel_of(to->format, made, dithers, x, y) & mask));
}

static void blit_pixel(const blit_job *j, int32_t x, int32_t y)
{
    const uint8_t *from = blit_source(j, x, y);
    const int is_palette = j->from->format == LMB_BLIT_PALETTE8;
    const uint32_t bits = is_palette ? *from : lmb_draw_pixel_bits(j->from->format, from);
    const int dithers = (j->how.flags & LMB_BLIT_DITHER) != 0;
    uint8_t codes[4];
    if ((j->how.flags & LMB_BLIT_KEY) != 0 && bits == j->how.key) {
        return;
    }
    if (j->from->format == j->to->format && (j->how.flags & LMB_BLIT_ALPHA) == 0) {
        lmb_draw_put_bits(j->to->format, blit_place(j->to, x, y), bits);
        return;
    }
    if (is_palette) {
        memcpy(codes, j->from->palette + 4 * bits, sizeof codes);
    } else {
        lmb_draw_read_pixel(codes, j->from->format, from);
    }
    if ((j->how.flags & LMB_BLIT_ALPHA) != 0) {
        blit_mix(j->to, x, y, codes, draw_times(codes[3], j->how.alpha), dithers);
    } else {
        lmb_draw_put_bits(j->to->format, blit_place(j->to, x, y),
                          lmb_draw_pixel_of(j->to->format, codes, dithers, x, y));
    }
}

static lmb_status blit_check_image(const lmb_blit_image *from, int32_t bytes)
{
    if (bytes == 0) {
        return LMB_ERR_FORMAT;
    }
    const int32_t stride = from->stride_bytes;
    if (from->data == NULL || from->width < 1 || from->height < 1 || from->width > LMB_MAX_SIDE ||
        from->height > LMB_MAX_SIDE || stride == INT32_MIN || (stride < 0 ? -stride : stride) < from->width * bytes ||
        (from->format == LMB_BLIT_PALETTE8 && from->palette == NULL)) {
        return LMB_ERR_ARG;
    }
    return (uintptr_t)from->data % (uint32_t)bytes != 0 || stride % bytes != 0 ? LMB_ERR_ALIGN : LMB_OK;
}

static int blit_how_is_good(const lmb_blit_how *how, const lmb_blit_image *from)
{
    const int32_t *p = how->part;
    return how->scale >= 1 && how->scale <= BLIT_SCALE && how->flags <= LMB_BLIT_FLAGS && p[0] >= 0 && p[1] >= 0 &&
           p[2] >= 0 && p[3] >= 0 && p[2] <= from->width && p[3] <= from->height && p[0] <= from->width - p[2] &&
           p[1] <= from->height - p[3];
}

/* Range first .. past - 1 of a surface's side, covered by `size` pixels from `at`. */
static void blit_span(int32_t *first, int32_t *past, int64_t at, int64_t size, int32_t side)
{
    const int64_t end = at + size;
    *first = at < 0 ? 0 : at > side ? side : (int32_t)at;
    *past = end < 0 ? 0 : end > side ? side : (int32_t)end;
}

/* Byte range of a rectangle, from the first byte to behind the last. The corners a and b are inside. */
static void blit_bytes(uintptr_t *low, uintptr_t *high, const uint8_t *a, const uint8_t *b, int32_t stride, size_t row)
{
    *low = (uintptr_t)(stride < 0 ? b : a);
    *high = (uintptr_t)(stride < 0 ? a : b) + row;
}

/* 1 if the job writes bytes that it reads. */
static int blit_overlaps(const blit_job *j)
{
    const int32_t wide = j->x1 - j->x0, source_wide = (int32_t)((j->x1 - 1 - j->x) / j->how.scale) -
                                                      (int32_t)((j->x0 - j->x) / j->how.scale) + 1;
    uintptr_t a, b, c, d;
    blit_bytes(&a, &b, blit_place(j->to, j->x0, j->y0), blit_place(j->to, j->x0, j->y1 - 1), j->to->stride_bytes,
               (size_t)wide * (size_t)lmb_pixel_bytes(j->to->format));
    blit_bytes(&c, &d, blit_source(j, j->x0, j->y0), blit_source(j, j->x0, j->y1 - 1), j->from->stride_bytes,
               (size_t)source_wide * (size_t)j->bytes);
    return a < d && c < b;
}

/* Copies in the order that reads each pixel before it is overwritten. */
static void blit_run(const blit_job *j)
{
    const int back = (uintptr_t)blit_place(j->to, j->x0, j->y0) > (uintptr_t)blit_source(j, j->x0, j->y0);
    const int rows_back = back != (j->to->stride_bytes < 0),
              plain = j->from->format == j->to->format && j->how.scale == 1 &&
                      (j->how.flags & (LMB_BLIT_KEY | LMB_BLIT_ALPHA)) == 0;
    for (int32_t n = 0; n < j->y1 - j->y0; ++n) {
        const int32_t y = rows_back ? j->y1 - 1 - n : j->y0 + n;
        if (plain) {
            memmove(blit_place(j->to, j->x0, y), blit_source(j, j->x0, y), (size_t)(j->x1 - j->x0) * (size_t)j->bytes);
            continue;
        }
        for (int32_t k = 0; k < j->x1 - j->x0; ++k) {
            blit_pixel(j, back ? j->x1 - 1 - k : j->x0 + k, y);
        }
    }
}

static lmb_status blit_check_target(const lmb_surface *to)
{
    if (to == NULL || to->data == NULL) {
        return LMB_ERR_ARG;
    }
    if (!blit_is_target(to)) {
        return LMB_ERR_FORMAT;
    }
    return to->layout == LMB_LINEAR && lmb_surface_is_valid(to) ? LMB_OK : LMB_ERR_ARG;
}

lmb_status lmb_blit(const lmb_surface *to, int32_t x, int32_t y, const lmb_blit_image *from, const lmb_blit_how *how)
{
    blit_job j;
    lmb_status status = blit_check_target(to);
    if (status != LMB_OK || from == NULL) {
        return status != LMB_OK ? status : LMB_ERR_ARG;
    }
    const int is_colour = is_colour_format(from->format) && from->format != LMB_RGB32F;
    memset(&j, 0, sizeof j);
    j.bytes = from->format == LMB_BLIT_PALETTE8 ? 1 : is_colour ? lmb_pixel_bytes(from->format) : 0;
    status = blit_check_image(from, j.bytes);
    if (status != LMB_OK) {
        return status;
    }
    j.to = to;
    j.from = from;
    j.x = x;
    j.y = y;
    j.how.scale = 1;
    j.how.part[2] = from->width;
    j.how.part[3] = from->height;
    j.how = how != NULL ? *how : j.how;
    if (!blit_how_is_good(&j.how, from)) {
        return LMB_ERR_ARG;
    }
    blit_span(&j.x0, &j.x1, x, (int64_t)j.how.part[2] * j.how.scale, to->width);
    blit_span(&j.y0, &j.y1, y, (int64_t)j.how.part[3] * j.how.scale, to->height);
    if (j.x0 >= j.x1 || j.y0 >= j.y1) {
        return LMB_OK;
    }
    const int alike = j.how.scale == 1 && from->format == to->format && from->stride_bytes == to->stride_bytes;
    if (!alike && blit_overlaps(&j)) {
        return LMB_ERR_ARG;
    }
    blit_run(&j);
    return LMB_OK;
}

/* --- text --------------------------------------------------------------------------------------------------------- */

static const uint8_t *text_glyph(char c)
{
    const uint32_t code = (uint8_t)c;
    return glyphs[code >= 32 && code < 32 + GLYPH_COUNT ? code - 32 : GLYPH_COUNT];
}

/* The ink of a text. With four bytes a pixel, `codes` are in the order of the surface's. */
typedef struct text_ink {
    const lmb_surface *to;
    uint8_t codes[4], alpha;
    int32_t scale;
    int is_wide;
} text_ink;

/* Blends onto a pixel of four bytes. */
static void text_mix(uint8_t *at, const text_ink *ink)
{
    if (ink->alpha == 255) {
        memcpy(at, ink->codes, 4);
        return;
    }
    for (int i = 0; i < 4; ++i) {
        at[i] = (uint8_t)draw_between(ink->codes[i], at[i], ink->alpha);
    }
}

/* The square for one pixel of a glyph. */
static void text_square(const text_ink *ink, int64_t x, int64_t y)
{
    const lmb_surface *to = ink->to;
    int32_t x0, x1, y0, y1;
    blit_span(&x0, &x1, x, ink->scale, to->width);
    blit_span(&y0, &y1, y, ink->scale, to->height);
    for (int32_t at_y = y0; at_y < y1; ++at_y) {
        for (int32_t at_x = x0; at_x < x1; ++at_x) {
            if (ink->is_wide) {
                text_mix(blit_place(to, at_x, at_y), ink);
            } else {
                blit_mix(to, at_x, at_y, ink->codes, ink->alpha, 0);
            }
        }
    }
}

static void text_put(const text_ink *ink, int64_t x, int64_t y, char c)
{
    const lmb_surface *to = ink->to;
    const uint8_t *glyph = text_glyph(c);
    const int32_t wide = CELL_WIDE * ink->scale, high = CELL_HIGH * ink->scale;
    if (x >= to->width || y >= to->height || x + wide <= 0 || y + high <= 0) {
        return;
    }
    /* Most text: whole cells of pixels of four bytes. */
    const int is_inside = DRAW_FULL && ink->is_wide && ink->scale == 1 && x >= 0 && y >= 0 &&
                          x + CELL_WIDE <= to->width && y + CELL_HIGH <= to->height;
    uint8_t *cell = is_inside ? blit_place(to, (int32_t)x, (int32_t)y) : NULL;
    for (int column = 0; column < GLYPH_WIDE; ++column) {
        for (uint32_t bits = glyph[column]; bits != 0; bits &= bits - 1) {
            const int row = lowest_bit(bits);
            if (is_inside) {
                text_mix(cell + (ptrdiff_t)row * to->stride_bytes + 4 * column, ink);
            } else {
                text_square(ink, x + column * ink->scale, y + row * ink->scale);
            }
        }
    }
}

lmb_status lmb_text(const lmb_surface *to, int32_t x, int32_t y, const char *text, int32_t scale,
                    const uint8_t colour[4])
{
    const lmb_status status = blit_check_target(to);
    int64_t at_x = x, at_y = y;
    if (status != LMB_OK || text == NULL || colour == NULL || scale < 1 || scale > BLIT_SCALE) {
        return status != LMB_OK ? status : LMB_ERR_ARG;
    }
    text_ink ink = {
        to, {colour[0], colour[1], colour[2], colour[3]}, colour[3], scale, lmb_pixel_bytes(to->format) == 4};
    if (ink.is_wide) { /* opaque */
        const int swaps = to->format == LMB_BGRA8;
        ink.codes[0] = colour[swaps ? 2 : 0];
        ink.codes[2] = colour[swaps ? 0 : 2];
        ink.codes[3] = 255;
    }
    for (; *text != 0; ++text) {
        if (*text == '\n') {
            at_x = x;
            at_y += CELL_HIGH * scale;
        } else {
            text_put(&ink, at_x, at_y, *text);
            at_x += CELL_WIDE * scale;
        }
    }
    return LMB_OK;
}

int32_t lmb_text_width(const char *text)
{
    int32_t wide = 0, widest = 0;
    for (; text != NULL && *text != 0; ++text) {
        wide = *text == '\n' ? 0 : mini(wide + CELL_WIDE, INT32_MAX - CELL_WIDE);
        widest = maxi(widest, wide);
    }
    return widest;
}
#endif
