/* mips.c: sizes of a texture's levels, and filling them. Layer 1. */
#include <lambent/scene.h>

#include "codec.h"
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

typedef void (*mean_of_four)(uint8_t out[4], const uint8_t *const from[4]);

/* Mean of four texels: colour weighted by alpha, so that what is invisible does not bleed; where all four are
 * invisible, by 1 each. Alpha is linear: a rounded integer mean. */
static void mean_colour(uint8_t out[4], const uint8_t *const from[4])
{
    int32_t i, k, weight, weights = 0, alpha = from[0][3] + from[1][3] + from[2][3] + from[3][3];
    float sum[3] = {0.0f, 0.0f, 0.0f};
    for (i = 0; i < 4; ++i) {
        weight = alpha ? from[i][3] : 1;
        weights += weight;
        for (k = 0; k < 3; ++k)
            sum[k] += (float)weight * lmb_srgb_decode(from[i][k]);
    }
    for (k = 0; k < 3; ++k)
        out[k] = lmb_srgb_encode(sum[k] / (float)weights);
    out[3] = (uint8_t)((alpha + 2) / 4);
}

/* Codes as they are, rounded: what looks a vector up makes it unit length. */
static void mean_vector(uint8_t out[4], const uint8_t *const from[4])
{
    int32_t k;
    for (k = 0; k < 4; ++k)
        out[k] = (uint8_t)((from[0][k] + from[1][k] + from[2][k] + from[3][k] + 2) / 4);
}

/* One level from the one above it. A side halves rounding down, so an odd one's last texel has no part in it, and a
 * side of 1 is read twice. */
static void half_level(uint8_t *to, const uint8_t *from, int32_t width, int32_t height, mean_of_four mean)
{
    int32_t x, y, to_width = maxi(width >> 1, 1), to_height = maxi(height >> 1, 1);
    for (y = 0; y < to_height; ++y) {
        const uint8_t *row0 = from + (size_t)(2 * y) * (size_t)width * 4;
        const uint8_t *row1 = from + (size_t)mini(2 * y + 1, height - 1) * (size_t)width * 4;
        for (x = 0; x < to_width; ++x, to += 4) {
            size_t x0 = (size_t)(2 * x) * 4, x1 = (size_t)mini(2 * x + 1, width - 1) * 4;
            const uint8_t *box[4];
            box[0] = row0 + x0;
            box[1] = row0 + x1;
            box[2] = row1 + x0;
            box[3] = row1 + x1;
            mean(to, box);
        }
    }
}

static lmb_status fill_levels(uint8_t *texels, int32_t width, int32_t height, int32_t levels, mean_of_four mean)
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
