/* tone.c: radiance -> display pixels. Layer 8. */
#include <lambent/compose.h>

#include <string.h>

#include "../base/poly.h"
#include "../base/surface_check.h"
#include "../base/vec.h"
#include "../lane/kernels.h"

/* Bayer's 8x8 index matrix (1973): a permutation of 0 .. 63. */
static const uint8_t bayer[LMB_TILE_PIXELS] = {
    0,  32, 8,  40, 2,  34, 10, 42, 48, 16, 56, 24, 50, 18, 58, 26, 12, 44, 4,  36, 14, 46, 6,  38, 60, 28, 52, 20,
    62, 30, 54, 22, 3,  35, 11, 43, 1,  33, 9,  41, 51, 19, 59, 27, 49, 17, 57, 25, 15, 47, 7,  39, 13, 45, 5,  37,
    63, 31, 55, 23, 61, 29, 53, 21};

/* Quantizes an 8-bit code to `levels` + 1 steps with ordered dither. k: index of the pixel in the tile. */
static uint32_t dither_code(uint8_t code, uint32_t levels, int k)
{
    /* floor(code / 255 * levels + (bayer + 1/2) / 64) in integers. */
    return ((uint32_t)code * levels * 128u + (2u * bayer[k] + 1u) * 255u) / (255u * 128u);
}

/* The pixels of a tile inside a surface, and the position of the first. */
typedef struct picture_part {
    int32_t first_x, last_x, first_y, last_y; /* in the tile */
    int32_t x, y;                             /* position of the tile's pixel 0 in the surface */
} picture_part;

static uint8_t *row_of_picture(const lmb_surface *out, const picture_part *p, int32_t y)
{
    return (uint8_t *)out->data + (ptrdiff_t)(p->y + y) * out->stride_bytes;
}

static void store_linear(const lmb_surface *out, const picture_part *p, const lmb_radiance *in)
{
    for (int32_t y = p->first_y; y <= p->last_y; ++y) {
        float *to = (float *)(void *)row_of_picture(out, p, y) + 3 * (p->x + p->first_x);
        for (int32_t x = p->first_x; x <= p->last_x; ++x) {
            for (int c = 0; c < 3; ++c) {
                *to++ = in->rgb[c][y * LMB_TILE + x];
            }
        }
    }
}

/* Shifts in the kernel's colours: red in the low bits, then green, blue, 255. */
enum { GREEN = 8, BLUE = 16 };

static uint32_t swap_red(uint32_t colour)
{
    return (colour & 0xff00ff00u) | (colour & 255u) << BLUE | (colour >> BLUE & 255u);
}

/* Does red come first in memory? Compilers resolve this at compile time. */
static int is_little_endian(void)
{
    const uint32_t one = 1;
    return *(const uint8_t *)&one == 1;
}

/* Stores `count` pixels. */
static void put_565_row(uint8_t *to, const uint32_t *colour, int32_t count)
{
    if (is_little_endian() && count == LMB_TILE) {
        memcpy(to, colour, LMB_TILE * sizeof *colour);
        return;
    }
    for (int32_t k = 0; k < count; ++k, to += 4) {
        to[0] = (uint8_t)colour[k];
        to[1] = (uint8_t)(colour[k] >> GREEN);
        to[2] = (uint8_t)(colour[k] >> BLUE);
        to[3] = 255;
    }
}

static void store_bytes(const lmb_surface *out, const picture_part *p, uint32_t colour[LMB_TILE_PIXELS])
{
    for (int k = 0; out->format == LMB_BGRA8 && k < LMB_TILE_PIXELS; ++k) {
        colour[k] = swap_red(colour[k]);
    }
    for (int32_t y = p->first_y; y <= p->last_y; ++y) {
        put_565_row(row_of_picture(out, p, y) + 4 * (p->x + p->first_x), colour + y * LMB_TILE + p->first_x,
                    p->last_x - p->first_x + 1);
    }
}

static void store_dithered(const lmb_surface *out, const picture_part *p, const uint32_t colour[LMB_TILE_PIXELS])
{
    const uint32_t green_bits = out->format == LMB_RGB555 ? 5 : 6;
    for (int32_t y = p->first_y; y <= p->last_y; ++y) {
        uint16_t *to = (uint16_t *)(void *)row_of_picture(out, p, y) + p->x + p->first_x;
        for (int32_t k = y * LMB_TILE + p->first_x; k <= y * LMB_TILE + p->last_x; ++k) {
            uint32_t red = dither_code((uint8_t)colour[k], 31, k),
                     blue = dither_code((uint8_t)(colour[k] >> BLUE), 31, k);
            uint32_t green = dither_code((uint8_t)(colour[k] >> GREEN), (1u << green_bits) - 1u, k);
            const uint32_t pixel = (red << (5 + green_bits)) | (green << 5) | blue;
            if (out->format == LMB_RGB565_BE) {
                ((uint8_t *)to)[0] = (uint8_t)(pixel >> 8);
                ((uint8_t *)to)[1] = (uint8_t)pixel;
            } else {
                *to = (uint16_t)pixel;
            }
            ++to;
        }
    }
}

/* Within a frame's size, so differences do not overflow. */
static int is_code_near(int32_t v) { return v >= -LMB_MAX_FRAME && v <= 2 * LMB_MAX_FRAME; }

lmb_status lmb_store_tile(const lmb_surface *out, const lmb_kernels *kernels, int32_t x0, int32_t y0,
                          const lmb_radiance *in, int32_t x, int32_t y, float exposure_ev)
{
    uint32_t colour[LMB_TILE_PIXELS];
    if (out == NULL || kernels == NULL || out->data == NULL || in == NULL || out->layout != LMB_LINEAR ||
        !lmb_surface_is_valid(out) || !is_code_near(x0) || !is_code_near(y0) || !is_code_near(x) || !is_code_near(y)) {
        return LMB_ERR_ARG;
    }
    if (!is_colour_format(out->format)) {
        return LMB_ERR_FORMAT;
    }
    const picture_part part = {maxi(x0 - x, 0), mini(out->width - 1 - (x - x0), LMB_TILE - 1),
                               maxi(y0 - y, 0), mini(out->height - 1 - (y - y0), LMB_TILE - 1),
                               x - x0,          y - y0};
    if (out->format == LMB_RGB32F) {
        store_linear(out, &part, in);
        return LMB_OK;
    }
    kernels->encode(colour, in, lmb_exp2(exposure_ev));
    if (out->format == LMB_RGBA8 || out->format == LMB_BGRA8) {
        store_bytes(out, &part, colour);
    } else {
        store_dithered(out, &part, colour);
    }
    return LMB_OK;
}
