/* io_jpeg_idct.c: from JPEG coefficients to samples, and from samples to RGBA. Rounding follows the integer transform
 * and the smooth upsampling of most decoders (libjpeg's "islow" and "fancy"), so that a texture has the same bytes here
 * as elsewhere. */
#include "io_jpeg.h"

#include <string.h>

/* v / 2^n, rounded down; C99 leaves the right shift of negative numbers to the compiler. */
static int64_t shift_down(int64_t v, int n)
{
    return v >= 0 ? v >> n : -((-v + ((int64_t)1 << n) - 1) >> n);
}

static uint8_t clamp_byte(int64_t v)
{
    return (uint8_t)(v < 0 ? 0 : v > 255 ? 255 : v);
}

/* --- inverse cosine transform --- */

/* c(k) = sqrt(2) cos(k pi / 16); factors of 2^13, rounded. */
#define DCT_BITS 13
enum {
    C6          = 4433,  /*  c6                   */
    C2_LESS_C6  = 6270,  /*  c2 - c6              */
    C2_PLUS_C6  = 15137, /*  c2 + c6              */
    C3          = 9633,  /*  c3                   */
    IN7         = 2446,  /* -c1 + c3 + c5 - c7    */
    IN5         = 16819, /*  c1 + c3 - c5 + c7    */
    IN3         = 25172, /*  c1 + c3 + c5 - c7    */
    IN1         = 12299, /*  c1 + c3 - c5 - c7    */
    IN7_AND_IN1 = 7373,  /*  c3 - c7              */
    IN5_AND_IN3 = 20995, /*  c1 + c3              */
    IN7_AND_IN3 = 16069, /*  c3 + c5              */
    IN5_AND_IN1 = 3196   /*  c3 - c5              */
};

/* Eight values, scaled by sqrt(8) * 2^13 (Loeffler, Ligtenberg, Moschytz 1989: 12 multiplications), in place.
 * Each pass grows them by less than 2^17; from 2^31 (a coefficient times a 16-bit quantizer) the first leaves 2^48,
 * 2^37 after its rounding, the second 2^54. */
static void transform_8(int64_t x[8])
{
    int64_t turn = (x[2] + x[6]) * C6, cosine = turn + x[2] * C2_LESS_C6, sine = turn - x[6] * C2_PLUS_C6;
    int64_t sum = (x[0] + x[4]) * (1 << DCT_BITS), difference = (x[0] - x[4]) * (1 << DCT_BITS);
    int64_t even[4], odd[4];
    int64_t all = (x[1] + x[3] + x[5] + x[7]) * C3;
    int64_t a = (x[7] + x[1]) * IN7_AND_IN1, b = (x[5] + x[3]) * IN5_AND_IN3;
    int64_t c = all - (x[7] + x[3]) * IN7_AND_IN3, d = all - (x[5] + x[1]) * IN5_AND_IN1;
    int i;

    even[0] = sum + cosine;
    even[1] = difference + sine;
    even[2] = difference - sine;
    even[3] = sum - cosine;
    odd[0] = x[1] * IN1 - a + d;
    odd[1] = x[3] * IN3 - b + c;
    odd[2] = x[5] * IN5 - b + d;
    odd[3] = x[7] * IN7 - a + c;
    for (i = 0; i < 4; ++i) {
        x[i] = even[i] + odd[i];
        x[7 - i] = even[i] - odd[i];
    }
}

/* One column of the block, with two more bits than the result needs. */
static void transform_column(int64_t *out, const int16_t *block, const uint16_t *quant)
{
    int64_t x[8];
    int i, any = 0;
    for (i = 0; i < 8; ++i) {
        x[i] = (int64_t)block[8 * i] * quant[8 * i];
        any |= i > 0 && x[i] != 0;
    }
    if (!any) { /* same as the formula; true for most columns */
        for (i = 0; i < 8; ++i) out[8 * i] = x[0] * 4;
        return;
    }
    transform_8(x);
    for (i = 0; i < 8; ++i) out[8 * i] = shift_down(x[i] + (1 << (DCT_BITS - 3)), DCT_BITS - 2);
}

void jpeg_inverse_dct(uint8_t *out, size_t stride, const int16_t block[64], const uint16_t quant[64])
{
    static const int16_t nothing[64];
    int64_t rows[64];
    int i, k;
    if (memcmp(block + 1, nothing + 1, sizeof nothing - sizeof *nothing) == 0) { /* same as the formula */
        const int64_t mean = (int64_t)block[0] * quant[0] * (4 << DCT_BITS);
        const uint8_t v = clamp_byte(shift_down(mean + (1 << (DCT_BITS + 4)), DCT_BITS + 5) + 128);
        for (i = 0; i < 8; ++i, out += stride) memset(out, v, 8);
        return;
    }
    for (i = 0; i < 8; ++i) transform_column(rows + i, block + i, quant + i);
    for (i = 0; i < 8; ++i, out += stride) {
        int64_t *x = rows + 8 * i;
        transform_8(x);
        for (k = 0; k < 8; ++k) /* 2 extra bits, and 8 = sqrt(8) twice */
            out[k] = clamp_byte(shift_down(x[k] + (1 << (DCT_BITS + 4)), DCT_BITS + 5) + 128);
    }
}

/* --- upsampling --- */

static const uint8_t *sample_row(const jpeg_component *c, uint32_t y)
{
    return c->samples + (size_t)y * c->blocks_x * 8;
}

/* Twice as wide: 3/4 of the nearer sample, 1/4 of the farther. With `tall` the same is done between the rows. */
static void smooth_wider(uint8_t *out, const jpeg_component *c, const uint8_t *near, const uint8_t *far, int tall)
{
    uint32_t i, step = tall ? 3 : 1, shift = tall ? 4 : 2, to_left = tall ? 8 : 1, to_right = tall ? 7 : 2;
    uint32_t left, here, right;
    here = left = near[0] * step + (tall ? far[0] : 0u);
    for (i = 0; i < c->width; ++i, left = here, here = right) {
        uint32_t next = i + 1 < c->width ? i + 1 : i;
        right = near[next] * step + (tall ? far[next] : 0u);
        out[2 * i] = (uint8_t)((3 * here + left + to_left) >> shift);
        out[2 * i + 1] = (uint8_t)((3 * here + right + to_right) >> shift);
    }
}

/* Row y of the picture from one component. `out` has room for width + 4. */
static void upsample_row(uint8_t *out, const jpeg_reader *j, const jpeg_component *c, uint32_t y)
{
    uint32_t wider = j->h_max / c->h, taller = j->v_max / c->v, row = y / taller, x, other = row;
    const uint8_t *near = sample_row(c, row), *far;

    if (y % taller) other = row + 1 < c->height ? row + 1 : row;
    else if (row > 0) other = row - 1;
    far = sample_row(c, other);
    if (wider == 2 && taller <= 2 && c->width > 2) {
        smooth_wider(out, c, near, far, taller == 2);
    } else if (wider == 1 && taller == 2) {
        for (x = 0; x < j->width; ++x) out[x] = (uint8_t)((3u * near[x] + far[x] + 1u + y % 2) >> 2);
    } else if (wider == 1) {
        memcpy(out, near, j->width);
    } else {
        for (x = 0; x < j->width; ++x) out[x] = near[x >> (wider == 4 ? 2 : 1)];
    }
}

/* --- colour --- */

/* v / 2^16 + y as a byte; 256 are added before the shift and taken off behind it, as |v| is under 256 * 2^16. */
static uint8_t colour_byte(int32_t y, int32_t v)
{
    int32_t sum = y + ((v + (1 << 24)) >> 16) - 256;
    return (uint8_t)(sum < 0 ? 0 : sum > 255 ? 255 : sum);
}

/* JFIF's YCbCr, factors of 2^16: 1.402, 0.34414, 0.71414, 1.772. */
static void ycc_to_rgb(uint8_t *texel, int32_t y, int32_t cb, int32_t cr)
{
    const int32_t half = 1 << 15;
    texel[0] = colour_byte(y, 91881 * cr + half);
    texel[1] = colour_byte(y, half - 22554 * cb - 46802 * cr);
    texel[2] = colour_byte(y, 116130 * cb + half);
}

/* Three rows of samples, `pitch` apart, unchanged or from YCbCr. */
static void colour_row(uint8_t *texels, const uint8_t *row, size_t pitch, uint32_t n, int is_ycc)
{
    for (; n > 0; --n, ++row, texels += 4) {
        const uint8_t a = row[0], b = row[pitch], c = row[2 * pitch];
        if (is_ycc) {
            ycc_to_rgb(texels, a, b - 128, c - 128);
        } else {
            texels[0] = a;
            texels[1] = b;
            texels[2] = c;
        }
        texels[3] = 255;
    }
}

/* Converts four rows of CMYK or YCCK. 255 is no ink. */
static void ink_row(uint8_t *texels, const uint8_t *row, size_t pitch, uint32_t n, int is_ycc)
{
    for (; n > 0; --n, ++row, texels += 4) {
        const uint32_t black = row[3 * pitch];
        colour_row(texels, row, pitch, 1, is_ycc);
        for (int c = 0; c < 3; ++c) {
            const uint32_t ink = is_ycc ? 255u - texels[c] : texels[c];
            texels[c] = (uint8_t)((ink * black + 127u) / 255u);
        }
    }
}

void jpeg_colour_rows(uint8_t *texels, const jpeg_reader *j, int is_ycc, uint8_t *rows)
{
    size_t pitch = (size_t)j->width + 4;
    uint32_t y, k;
    for (y = 0; y < j->height; ++y, texels += 4 * (size_t)j->width) {
        for (k = 0; k < j->count; ++k) upsample_row(rows + k * pitch, j, &j->components[k], y);
        (j->count == 4 ? ink_row : colour_row)(texels, rows, j->count == 1 ? 0 : pitch, j->width, is_ycc);
    }
}
