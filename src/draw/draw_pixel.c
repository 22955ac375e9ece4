/* draw_pixel.c: pixels of display formats as codes R G B A, and back. Layer 4. */
#include "draw_part.h"

#if LMB_DRAW
/* Bayer's 8x8 matrix, as in lmb_store_tile: the lowest bits of x and y count most. */
static uint32_t pixel_rank(int32_t x, int32_t y)
{
    const uint32_t b = (uint32_t)y, a = (uint32_t)x ^ b;
    return (a & 1u) << 5 | (b & 1u) << 4 | (a & 2u) << 2 | (b & 2u) << 1 | (a & 4u) >> 1 | (b & 4u) >> 2;
}

/* A code to 0 .. levels: rounded to nearest, or floor(code / 255 * levels + (rank + 1/2) / 64). */
static uint32_t pixel_level(uint32_t code, uint32_t levels, int dithers, uint32_t rank)
{
    return dithers ? (code * levels * 128u + (2u * rank + 1u) * 255u) / (255u * 128u) : draw_times(code, levels);
}

static uint32_t pixel_green_bits(int32_t format) { return format == LMB_RGB555 ? 5 : 6; }

static int pixel_is_wide(int32_t format) { return format == LMB_RGBA8 || format == LMB_BGRA8; }

uint32_t lmb_draw_pixel_bits(int32_t format, const uint8_t *at)
{
    if (pixel_is_wide(format)) {
        return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
    }
    return format == LMB_RGB565_BE ? (uint32_t)at[0] << 8 | at[1] : *(const uint16_t *)(const void *)at;
}

void lmb_draw_put_bits(int32_t format, uint8_t *at, uint32_t bits)
{
    if (pixel_is_wide(format)) {
        for (int i = 0; i < 4; ++i) {
            at[i] = (uint8_t)(bits >> 8 * i);
        }
    } else if (format == LMB_RGB565_BE) {
        at[0] = (uint8_t)(bits >> 8);
        at[1] = (uint8_t)bits;
    } else {
        *(uint16_t *)(void *)at = (uint16_t)bits;
    }
}

void lmb_draw_read_pixel(uint8_t out[4], int32_t format, const uint8_t *at)
{
    const uint32_t bits = lmb_draw_pixel_bits(format, at), green = pixel_green_bits(format);
    if (pixel_is_wide(format)) {
        const int swaps = format == LMB_BGRA8;
        out[0] = at[swaps ? 2 : 0];
        out[1] = at[1];
        out[2] = at[swaps ? 0 : 2];
        out[3] = at[3];
        return;
    }
    const uint32_t r = bits >> (5 + green) & 31u, g = bits >> 5 & ((1u << green) - 1u), b = bits & 31u;
    out[0] = (uint8_t)(r << 3 | r >> 2);
    out[1] = (uint8_t)(g << (8 - green) | g >> (2 * green - 8));
    out[2] = (uint8_t)(b << 3 | b >> 2);
    out[3] = 255;
}

uint32_t lmb_draw_pixel_of(int32_t format, const uint8_t codes[4], int dithers, int32_t x, int32_t y)
{
    if (pixel_is_wide(format)) {
        const int swaps = format == LMB_BGRA8;
        return (uint32_t)codes[swaps ? 2 : 0] | (uint32_t)codes[1] << 8 | (uint32_t)codes[swaps ? 0 : 2] << 16 |
               (uint32_t)codes[3] << 24;
    }
    const uint32_t rank = pixel_rank(x, y), green = pixel_green_bits(format);
    return pixel_level(codes[0], 31, dithers, rank) << (5 + green) |
           pixel_level(codes[1], (1u << green) - 1u, dithers, rank) << 5 | pixel_level(codes[2], 31, dithers, rank);
}

uint32_t lmb_draw_pixel_mask(int32_t format, uint32_t channels)
{
    uint8_t codes[4];
    for (int i = 0; i < 4; ++i) {
        codes[i] = channels >> i & 1u ? 255 : 0;
    }
    return lmb_draw_pixel_of(format, codes, 0, 0, 0);
}
#endif
