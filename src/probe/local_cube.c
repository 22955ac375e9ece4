/* local_cube.c: a map -> lights of 6 x 8 x 8 directions -> irradiance by normal. Layer 5.                 [S14] */
#include <string.h>

#include "../lane/kernels.h"
#include "../raster/tile.h"
#include "cube.h"

#if LMB_PROBES

/* Adds the share of each border texel to the interior texel in the same direction. */
static void fold_bright_texels(lmb_probe_lights *inout, const lmb_probe_table *table)
{
    memset(inout->rgbw, 0, sizeof inout->rgbw);
    for (int32_t i = 0; i < LMB_PROBE_BORDERED; ++i) {
        for (int c = 0; c < 4; ++c) {
            inout->rgbw[c][table->fold[i]] += inout->shared[i][c];
        }
    }
}

/* --- peaks -------------------------------------------------------------------------------------------------------- */

/* Two by two texels with this many times the mean light become a separate light. */
static const float min_light_contrast = 4.0f;

/* The strongest peaks, unsorted. */
typedef struct strongest {
    int32_t x[LMB_PROBE_PEAKS], y[LMB_PROBE_PEAKS], count;
    float light[LMB_PROBE_PEAKS]; /* red + green + blue, W/m2 */
} strongest;

/* Keeps a peak; if the list is full, the weakest is dropped. */
static void keep_strongest(strongest *inout, int32_t x, int32_t y, float light)
{
    int32_t at = 0;
    if (inout->count < LMB_PROBE_PEAKS) {
        at = inout->count++;
    } else {
        for (int32_t i = 1; i < LMB_PROBE_PEAKS; ++i) {
            at = inout->light[i] < inout->light[at] ? i : at;
        }
        if (light <= inout->light[at]) {
            return;
        }
    }
    inout->x[at] = x;
    inout->y[at] = y;
    inout->light[at] = light;
}

static void find_strongest(strongest *out, const float *map, const lmb_probe_table *t, float limit)
{
    const size_t plane = (size_t)t->width * (size_t)t->height;
    out->count = 0;
    for (int32_t y = 0; y < t->height; y += 2) {
        for (int32_t x = 0; x < t->width; x += 2) {
            const float *red = map + y * t->width + x, *green = red + plane, *blue = green + plane;
            const int32_t under = t->width;
            const float light = t->area[y] * (red[0] + red[1] + (green[0] + green[1]) + (blue[0] + blue[1])) +
                                t->area[y + 1] * (red[under] + red[under + 1] + (green[under] + green[under + 1]) +
                                                  (blue[under] + blue[under + 1]));
            if (light > limit) {
                keep_strongest(out, x, y, light);
            }
        }
    }
}

/* Sets a peak to the light and direction of two by two texels. */
static void set_peak(lmb_probe_lights *out, int32_t peak, const float *map, const lmb_probe_table *t, int32_t x,
                     int32_t y)
{
    const int32_t count = t->width * t->height;
    float to[3] = {0.0f, 0.0f, 0.0f}, rgb[3] = {0.0f, 0.0f, 0.0f};
    for (int i = 0; i < 4; ++i) {
        const int32_t at = (y + i / 2) * t->width + x + i % 2;
        float light = 0.0f;
        for (int c = 0; c < 3; ++c) {
            const float one = t->area[y + i / 2] * map[c * count + at];
            rgb[c] += one;
            light += one;
        }
        for (int c = 0; c < 3; ++c) {
            to[c] += light * ((float)t->direction[c * count + at] * (2.0f / 65535.0f) - 1.0f);
        }
    }
    const lmb_vec3 d = normalize3(vec3(to[0], to[1], to[2]));
    const float numbers[6] = {d.x, d.y, d.z, rgb[0], rgb[1], rgb[2]};
    for (int c = 0; c < 6; ++c) {
        out->peak[c][peak] = numbers[c];
    }
}

/* Removes a peak's light from the nine texels to which `share` added it. */
static void take_back(lmb_probe_lights *inout, const lmb_probe_share *at, int32_t peak)
{
    enum { SIDE = LMB_PROBE_SIDE + 2 };
    const float x = (float)at->x * (1.0f / 255.0f) - 0.5f, y = (float)at->y * (1.0f / 255.0f) - 0.5f;
    const float across[3] = {0.5f * x * (x - 1.0f), 1.0f - x * x, 0.5f * x * (x + 1.0f)},
                down[3] = {0.5f * y * (y - 1.0f), 1.0f - y * y, 0.5f * y * (y + 1.0f)};
    for (int i = 0; i < 9; ++i) {
        for (int c = 0; c < 3; ++c) {
            inout->shared[at->slot + i / 3 * SIDE + i % 3][c] -= down[i / 3] * across[i % 3] * inout->peak[3 + c][peak];
        }
    }
}

static float light_of(const lmb_probe_lights *l)
{
    float sum = 0.0f;
    for (int32_t i = 0; i < LMB_PROBE_BORDERED; ++i) {
        sum += l->shared[i][0] + l->shared[i][1] + l->shared[i][2];
    }
    return sum;
}

static void part_peaks(lmb_probe_lights *inout, const float *map, const lmb_probe_table *table)
{
    strongest found;
    const float mean = light_of(inout) / (float)(table->width / 2 * (table->height / 2));
    find_strongest(&found, map, table, maxf(min_light_contrast * mean, 1e-20f));
    inout->peaks = found.count;
    for (int32_t i = 0; i < found.count; ++i) {
        set_peak(inout, i, map, table, found.x[i], found.y[i]);
        take_back(inout, &table->share[found.y[i] / 2 * (table->width / 2) + found.x[i] / 2], i);
    }
}

lmb_status lmb_probe_reduce(lmb_probe_lights *out, const lmb_kernels *kernels, const float *map,
                            const lmb_probe_table *table)
{
    if (out == NULL || kernels == NULL || map == NULL || table == NULL || table->share == NULL) {
        return LMB_ERR_ARG;
    }
    memset(out->shared, 0, sizeof out->shared);
    kernels->share(out->shared, map, table);
    part_peaks(out, map, table);
    fold_bright_texels(out, table);
    return LMB_OK;
}

/* Normals first .. first + LMB_TILE_PIXELS - 1 of a cube; indices past the end repeat the last normal. */
static void set_normals(float normal[3][LMB_TILE_PIXELS], int32_t first, int32_t n)
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t i = mini(first + k, 6 * n * n - 1);
        const lmb_vec3 d = cube_nth_direction(i, n);
        tile_set_vec(normal, k, d);
    }
}

lmb_status lmb_probe_cosine(float *cube, int32_t n, const lmb_kernels *kernels, const lmb_probe_lights *lights,
                            const lmb_probe_table *table)
{
    if (cube == NULL || kernels == NULL || lights == NULL || table == NULL || table->light == NULL || n < 1 || n > 64 ||
        lights->peaks < 0 || lights->peaks > LMB_PROBE_PEAKS) {
        return LMB_ERR_ARG;
    }
    for (int32_t first = 0; first < 6 * n * n; first += LMB_TILE_PIXELS) {
        float normal[3][LMB_TILE_PIXELS], out[3][LMB_TILE_PIXELS];
        const int32_t count = mini(6 * n * n - first, LMB_TILE_PIXELS);
        set_normals(normal, first, n);
        kernels->cosine(out, normal, lights, table->light);
        for (int c = 0; c < 3; ++c) {
            memcpy(cube + (size_t)c * 6 * (size_t)(n * n) + first, out[c], (size_t)count * sizeof **out);
        }
    }
    return LMB_OK;
}

#endif
