/* tone.c: radiance -> the pixels of a display. Floor 7. */
#include <lambent/compose.h>

#include "../base/codec.h"
#include "../base/poly.h"
#include "../base/surface_check.h"
#include "../base/vec.h"

/* Bayer's 8x8 index matrix (1973): 0 .. 63, each once. */
static const uint8_t bayer[LMB_TILE_PIXELS] = {
    0,  32, 8,  40, 2,  34, 10, 42, 48, 16, 56, 24, 50, 18, 58, 26, 12, 44, 4,  36, 14, 46, 6,  38, 60, 28, 52, 20,
    62, 30, 54, 22, 3,  35, 11, 43, 1,  33, 9,  41, 51, 19, 59, 27, 49, 17, 57, 25, 15, 47, 7,  39, 13, 45, 5,  37,
    63, 31, 55, 23, 61, 29, 53, 21};

/* An 8-bit code to `levels` + 1 steps; the dither decides what lies between. k is the pixel's place in its tile. */
static uint32_t dither(uint8_t code, uint32_t levels, int k)
{
    /* floor(code / 255 * levels + (bayer + 1/2) / 64) in whole numbers. */
    return ((uint32_t)code * levels * 128u + (2u * bayer[k] + 1u) * 255u) / (255u * 128u);
}

static void store_bytes(uint8_t *p, const uint8_t code[3], int32_t format)
{
    p[0] = code[format == LMB_BGRA8 ? 2 : 0];
    p[1] = code[1];
    p[2] = code[format == LMB_BGRA8 ? 0 : 2];
    p[3] = 255;
}

static void store_pixel(const lmb_surface *out, int32_t x, int32_t y, const float linear[3], float gain, int k)
{
    uint8_t *row = (uint8_t *)out->data + (ptrdiff_t)y * out->stride_bytes, code[3];
    if (out->format == LMB_RGB32F) {
        float *p = (float *)(void *)row + 3 * x;
        p[0] = linear[0];
        p[1] = linear[1];
        p[2] = linear[2];
        return;
    }
    for (int c = 0; c < 3; ++c) {
        code[c] = lmb_srgb_encode(linear[c] * gain);
    }
    if (out->format == LMB_RGBA8 || out->format == LMB_BGRA8) {
        store_bytes(row + 4 * x, code, out->format);
        return;
    }
    uint32_t green_bits = out->format == LMB_RGB565 ? 6 : 5;
    uint32_t red = dither(code[0], 31, k), green = dither(code[1], (1u << green_bits) - 1u, k), blue = dither(code[2], 31, k);
    ((uint16_t *)(void *)row)[x] = (uint16_t)((red << (5 + green_bits)) | (green << 5) | blue);
}

lmb_status lmb_store_tile(const lmb_surface *out, int32_t x0, int32_t y0, const lmb_radiance *in, int32_t x, int32_t y,
                          float exposure_ev)
{
    if (out == NULL || out->data == NULL || in == NULL || out->layout != LMB_LINEAR ||
        !lmb_surface_is_sound(out)) {
        return LMB_ERR_ARG;
    }
    if (out->format != LMB_RGB32F && out->format != LMB_RGBA8 && out->format != LMB_BGRA8 && out->format != LMB_RGB565 &&
        out->format != LMB_RGB555) {
        return LMB_ERR_FORMAT;
    }
    float gain = lmb_exp2(exposure_ev);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        int32_t px = x + k % LMB_TILE - x0, py = y + k / LMB_TILE - y0;
        if (px >= 0 && py >= 0 && px < out->width && py < out->height) {
            float linear[3] = {in->rgb[0][k], in->rgb[1][k], in->rgb[2][k]};
            store_pixel(out, px, py, linear, gain, k);
        }
    }
    return LMB_OK;
}
