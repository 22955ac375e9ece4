/* mips.c: sizes of a texture's levels, and filling them. Layer 1. */
#include <lambent/scene.h>

#include "codec.h"
#include "halve.h"
#include "vec.h"

int32_t lmb_texture_level_count(int32_t width, int32_t height)
{
    int32_t side = maxi(width, height), levels = 1;
    if (width < 1 || height < 1 || side > LMB_MAX_SIDE)
        return 0;
    while ((side >>= 1) > 0)
        ++levels;
    return levels;
}

size_t lmb_texture_bytes(int32_t width, int32_t height, int32_t levels)
{
    size_t texels = 0;
    int32_t i;
    if (levels < 1 || levels > lmb_texture_level_count(width, height))
        return 0;
    for (i = 0; i < levels; ++i)
        texels += (size_t)maxi(width >> i, 1) * (size_t)maxi(height >> i, 1);
    return texels * 4;
}

size_t lmb_texture_format_bytes(int32_t format, int32_t width, int32_t height, int32_t levels)
{
    const size_t rgba = lmb_texture_bytes(width, height, levels);
    size_t nibbles = 64;
    if (format == LMB_TEXELS_RGBA8)
        return rgba;
    if (format == LMB_TEXELS_RGB565)
        return rgba / 2;
    if (format != LMB_TEXELS_PALETTE4 || rgba == 0)
        return 0;
    for (int32_t i = 0; i < levels; ++i)
        nibbles += ((size_t)maxi(width >> i, 1) * (size_t)maxi(height >> i, 1) + 1) / 2;
    return nibbles;
}

/* The texels that one texel of the next level covers, with the weight of each. */
typedef struct {
    const uint8_t *from;
    size_t row; /* bytes */
    halve_taps x, y;
} mip_box;

typedef void (*mean_of_codes)(uint8_t out[4], const mip_box *b);

static const uint8_t *box_texel(const mip_box *b, int32_t i, int32_t j) { return b->from + (size_t)j * b->row + 4 * i; }

static int32_t box_part(const mip_box *b, int32_t i, int32_t j) { return b->x.part[i] * b->y.part[j]; }

/* The rounded mean of one channel's codes, in integers of at most 8191 * 8191 * 255. */
static uint8_t mean_code(const mip_box *b, int channel)
{
    const int64_t whole = (int64_t)b->x.whole * b->y.whole;
    int64_t sum = whole / 2;
    for (int32_t j = 0; j < b->y.count; ++j) {
        for (int32_t i = 0; i < b->x.count; ++i)
            sum += (int64_t)box_part(b, i, j) * box_texel(b, i, j)[channel];
    }
    return (uint8_t)(sum / whole);
}

/* Colour weighted by alpha, so that invisible texels do not bleed. If all are invisible, each has weight 1. Alpha is
 * linear. */
static void mean_colour(uint8_t out[4], const mip_box *b)
{
    float weights = 0.0f, sum[3] = {0.0f, 0.0f, 0.0f};
    int visible = 0;
    for (int32_t j = 0; j < b->y.count; ++j) {
        for (int32_t i = 0; i < b->x.count; ++i)
            visible |= box_texel(b, i, j)[3];
    }
    for (int32_t j = 0; j < b->y.count; ++j) {
        for (int32_t i = 0; i < b->x.count; ++i) {
            const uint8_t *texel = box_texel(b, i, j);
            const float weight = (float)box_part(b, i, j) * (float)(visible ? texel[3] : 1);
            weights += weight;
            for (int k = 0; k < 3; ++k)
                sum[k] += weight * lmb_srgb_decode(texel[k]);
        }
    }
    for (int k = 0; k < 3; ++k)
        out[k] = lmb_srgb_encode(sum[k] / weights);
    out[3] = mean_code(b, 3);
}

/* The rounded mean of the codes; a lookup makes the vector unit length. */
static void mean_vector(uint8_t out[4], const mip_box *b)
{
    for (int k = 0; k < 4; ++k)
        out[k] = mean_code(b, k);
}

/* One level from the one above it. */
static void half_level(uint8_t *to, const uint8_t *from, int32_t width, int32_t height, mean_of_codes mean)
{
    const int32_t to_width = maxi(width / 2, 1), to_height = maxi(height / 2, 1);
    mip_box b;
    b.row = (size_t)width * 4;
    for (int32_t y = 0; y < to_height; ++y) {
        b.y = halve_axis(height, y);
        for (int32_t x = 0; x < to_width; ++x, to += 4) {
            b.x = halve_axis(width, x);
            b.from = from + (size_t)b.y.first * b.row + (size_t)b.x.first * 4;
            mean(to, &b);
        }
    }
}

static lmb_status fill_levels(uint8_t *texels, int32_t width, int32_t height, int32_t levels, mean_of_codes mean)
{
    int32_t i;
    if (!texels || lmb_texture_bytes(width, height, levels) == 0)
        return LMB_ERR_ARG;
    for (i = 1; i < levels; ++i) {
        int32_t from_width = maxi(width >> (i - 1), 1), from_height = maxi(height >> (i - 1), 1);
        uint8_t *to = texels + (size_t)from_width * (size_t)from_height * 4;
        half_level(to, texels, from_width, from_height, mean);
        texels = to;
    }
    return LMB_OK;
}

lmb_status lmb_texture_mips(uint8_t *texels, int32_t width, int32_t height, int32_t levels)
{
    return fill_levels(texels, width, height, levels, mean_colour);
}

lmb_status lmb_normal_map_mips(uint8_t *texels, int32_t width, int32_t height, int32_t levels)
{
    return fill_levels(texels, width, height, levels, mean_vector);
}
