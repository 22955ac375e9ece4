/* pack_encode.c: a texture's levels in 16 bits, or in 4 bits with a palette. Uses only integers, so every machine gives
 * the same bytes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pack.h"

enum { COLOURS = 16, ROUNDS = 12, BITS = 5, CELLS = 2 << 3 * BITS };

/* --- 16 bits ------------------------------------------------------------------------------------------------------ */

static uint32_t nearest(uint32_t code, uint32_t limit) { return (code * limit * 2 + 255) / 510; }

static int64_t put_rgb565(pack_buffer *out, const uint8_t *rgba, size_t texels, size_t judged)
{
    int64_t error = 0;
    for (size_t i = 0; i < texels; i += 2) {
        uint16_t pair[2] = {0, 0};
        for (size_t k = i; k < i + 2 && k < texels; ++k) {
            const uint8_t *p = rgba + 4 * k;
            const uint32_t r = nearest(p[0], 31), g = nearest(p[1], 63), b = nearest(p[2], 31);
            const int off[3] = {(int)(r << 3 | r >> 2) - p[0], (int)(g << 2 | g >> 4) - p[1],
                                (int)(b << 3 | b >> 2) - p[2]};
            pair[k - i] = (uint16_t)(r << 11 | g << 5 | b);
            error += k < judged ? off[0] * off[0] + off[1] * off[1] + off[2] * off[2] : 0;
        }
        pack_put(out, pair, sizeof pair);
    }
    return error;
}

/* --- 4 bits ------------------------------------------------------------------------------------------------------- */

/* A cluster of similar texels, or a colour of the palette: sums of R G B A, and the number of texels. */
typedef struct bunch {
    int64_t sum[4], count;
    int colour[4];
} bunch;

static void mean_of(bunch *b)
{
    for (int k = 0; k < 4 && b->count > 0; ++k) {
        b->colour[k] = (int)((2 * b->sum[k] + b->count) / (2 * b->count));
    }
}

static int64_t distance(const int *a, const int *b)
{
    int64_t sum = 0;
    for (int k = 0; k < 4; ++k) {
        sum += (int64_t)(a[k] - b[k]) * (a[k] - b[k]);
    }
    return sum;
}

static int nearest_of(const bunch *palette, int count, const int *colour, int64_t *how_far)
{
    int best = 0;
    *how_far = INT64_MAX;
    for (int i = 0; i < count; ++i) {
        const int64_t far = distance(palette[i].colour, colour);
        if (far < *how_far) {
            *how_far = far;
            best = i;
        }
    }
    return best;
}

/* Texels of a level. */
static size_t level_texels(const lmb_texture *t, int32_t level)
{
    return (size_t)(t->width >> level > 1 ? t->width >> level : 1) *
           (size_t)(t->height >> level > 1 ? t->height >> level : 1);
}

/* Sorts the texels of all levels into cells of 32 x 32 x 32 colours, separately for each half of alpha. Each level
 * counts as much as the largest one, because a texture far away shows only a small level. Returns the number of cells
 * with texels, which come first. */
static int find_cells(bunch *cell, const lmb_texture *t, int alpha)
{
    const uint8_t *p = t->texels;
    int count = 0;
    for (int32_t level = 0; level < t->levels; ++level) {
        const int64_t times = (int64_t)(level_texels(t, 0) / level_texels(t, level));
        for (size_t i = level_texels(t, level); i > 0; --i, p += 4) {
            const int a = alpha ? p[3] : 255;
            bunch *c = &cell[(((a >> 7) << BITS | p[0] >> 3) << BITS | p[1] >> 3) << BITS | p[2] >> 3];
            for (int k = 0; k < 4; ++k) {
                c->sum[k] += times * (k < 3 ? p[k] : a);
            }
            c->count += times;
        }
    }
    for (int i = 0; i < CELLS; ++i) {
        if (cell[i].count > 0) {
            cell[count] = cell[i];
            mean_of(&cell[count++]);
        }
    }
    return count;
}

/* Chooses initial colours: first the most frequent one, then repeatedly the cell with the largest error, texels times
 * distance. */
static int first_colours(bunch *palette, const bunch *cell, int cells)
{
    int count = 0;
    while (count < COLOURS) {
        int64_t gain = 0, far;
        int worst = -1;
        for (int i = 0; i < cells; ++i) {
            nearest_of(palette, count, cell[i].colour, &far);
            far = count == 0 ? cell[i].count : cell[i].count * far;
            if (far > gain) {
                gain = far;
                worst = i;
            }
        }
        if (worst < 0) {
            break;
        }
        palette[count++] = cell[worst];
    }
    return count;
}

/* Replaces each colour by the mean of the cells nearest to it, several times (k-means). */
static void refine(bunch *palette, int count, const bunch *cell, int cells)
{
    for (int round = 0; round < ROUNDS; ++round) {
        for (int i = 0; i < count; ++i) {
            memset(palette[i].sum, 0, sizeof palette[i].sum);
            palette[i].count = 0;
        }
        for (int i = 0; i < cells; ++i) {
            int64_t far;
            bunch *p = &palette[nearest_of(palette, count, cell[i].colour, &far)];
            for (int k = 0; k < 4; ++k) {
                p->sum[k] += cell[i].sum[k];
            }
            p->count += cell[i].count;
        }
        for (int i = 0; i < count; ++i) {
            mean_of(&palette[i]);
        }
    }
}

/* Collects the texture's colours. Returns their number, or 0 if there are too many. */
static int own_colours(bunch *palette, const uint8_t *rgba, size_t texels, int alpha)
{
    int count = 0;
    for (size_t i = 0; i < texels; ++i) {
        const int colour[4] = {rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2], alpha ? rgba[4 * i + 3] : 255};
        int64_t far;
        nearest_of(palette, count, colour, &far);
        if (far > 0 && count == COLOURS) {
            return 0;
        }
        if (far > 0) {
            memcpy(palette[count++].colour, colour, sizeof colour);
        }
    }
    return count;
}

static int make_palette(bunch *palette, const lmb_texture *t, int alpha)
{
    int count = own_colours(palette, t->texels, lmb_texture_bytes(t->width, t->height, t->levels) / 4, alpha);
    if (count > 0) {
        return count;
    }
    bunch *cell = calloc(CELLS, sizeof *cell);
    if (cell == NULL) {
        return 0;
    }
    const int cells = find_cells(cell, t, alpha);
    count = first_colours(palette, cell, cells);
    refine(palette, count, cell, cells);
    free(cell);
    return count;
}

static int64_t put_level(pack_buffer *out, const bunch *palette, int count, const uint8_t *rgba, size_t texels,
                         int alpha)
{
    int64_t error = 0;
    for (size_t i = 0; i < texels; i += 8) { /* bytes of a word, unless the level ends in it */
        uint8_t byte[4] = {0, 0, 0, 0};
        size_t k = i;
        for (; k < i + 8 && k < texels; ++k) {
            const uint8_t *p = rgba + 4 * k;
            const int colour[4] = {p[0], p[1], p[2], alpha ? p[3] : 255};
            int64_t far;
            byte[(k - i) / 2] |= (uint8_t)(nearest_of(palette, count, colour, &far) << 4 * ((k - i) & 1u));
            error += far;
        }
        memcpy(out->data + out->size, byte, (k - i + 1) / 2);
        out->size += (k - i + 1) / 2;
    }
    return error;
}

/* Encodes all levels into one block, because levels start at any byte and pack_put adds zeros. Returns the root of the
 * mean square error of the first level, or half of that of another level, if that is larger; -1 if memory is short. */
static double put_palette4(pack_buffer *out, const lmb_texture *t, int alpha)
{
    const size_t bytes = lmb_texture_format_bytes(LMB_TEXELS_PALETTE4, t->width, t->height, t->levels);
    bunch palette[COLOURS];
    pack_buffer own = {NULL, 0, 0, 0};
    double worst = 0.0;
    memset(palette, 0, sizeof palette);
    const int count = make_palette(palette, t, alpha);
    own.data = count > 0 ? malloc(bytes) : NULL;
    if (own.data == NULL) {
        return -1.0;
    }
    for (int i = 0; i < COLOURS; ++i) {
        for (int k = 0; k < 4; ++k) {
            own.data[own.size++] = (uint8_t)palette[i].colour[k];
        }
    }
    const uint8_t *from = t->texels;
    for (int32_t level = 0; level < t->levels; ++level) {
        const size_t texels = level_texels(t, level);
        const int64_t off = put_level(&own, palette, count, from, texels, alpha);
        const double rms = sqrt((double)off / (double)texels / (alpha ? 4.0 : 3.0));
        worst = fmax(worst, level == 0 ? rms : 0.5 * rms);
        from += 4 * texels;
    }
    pack_put(out, own.data, own.size);
    free(own.data);
    return worst;
}

double pack_encode(pack_buffer *out, const lmb_texture *t, int format, int alpha)
{
    const size_t texels = lmb_texture_bytes(t->width, t->height, t->levels) / 4, judged = level_texels(t, 0);
    if (format == LMB_TEXELS_PALETTE4) {
        return put_palette4(out, t, alpha);
    }
    return sqrt((double)put_rgb565(out, t->texels, texels, judged) / (double)judged / 3.0);
}
