/* local_cube.c: a map -> lights of 6 x 8 x 8 directions -> irradiance by normal. Floor 6.                 [S14] */
#include <string.h>

#include "../lane/kernels.h"
#include "cube.h"

#if LMB_PROBES

enum { SIDE = LMB_PROBE_SIDE + 2 }; /* with a border */

/* Of a parabola through the middles of three texels in a row, at t -0.5 .. 0.5 from the second. */
static void parabola(float weight[3], uint8_t code)
{
    const float t = (float)code * (1.0f / 255.0f) - 0.5f;
    weight[0] = 0.5f * t * (t - 1.0f);
    weight[1] = 1.0f - t * t;
    weight[2] = 0.5f * t * (t + 1.0f);
}

/* Among the nine texels around its place, so that the lights' sum, mean place and spread are its own: whatever is
 * smooth over three texels comes out right. To four (their spread is wider) is off by a half more, to one by two to
 * three times. */
static void share(float shared[][4], const lmb_probe_share *at, const float light[4])
{
    float across[3], down[3];
    float (*to)[4] = &shared[at->slot];
    parabola(across, at->x);
    parabola(down, at->y);
    for (int i = 0; i < 9; ++i) {
        const float weight = across[i % 3] * down[i / 3];
        for (int c = 0; c < 4; ++c) {
            to[i / 3 * SIDE + i % 3][c] += weight * light[c];
        }
    }
}

/* A border's share goes to the texel that its direction meets. */
static void fold(lmb_probe_lights *inout)
{
    const int32_t n = LMB_PROBE_SIDE;
    memset(inout->rgbw, 0, sizeof inout->rgbw);
    for (int32_t i = 0; i < LMB_PROBE_BORDERED; ++i) {
        const int32_t face = i / (SIDE * SIDE), x = i % SIDE - 1, y = i / SIDE % SIDE - 1;
        cube_place p = {face, x, y};
        if (x < 0 || y < 0 || x >= n || y >= n) {
            p = cube_border(face, x, y, n);
        }
        for (int c = 0; c < 4; ++c) {
            inout->rgbw[c][(p.face * n + p.y) * n + p.x] += inout->shared[i][c];
        }
    }
}

lmb_status lmb_probe_reduce(lmb_probe_lights *out, const float *map, const lmb_probe_table *table)
{
    if (out == NULL || map == NULL || table == NULL) {
        return LMB_ERR_ARG;
    }
    const int32_t width = table->width, count = width * table->height;
    memset(out->shared, 0, sizeof out->shared);
    for (int32_t i = 0; i < count / 4; ++i) {
        const int32_t y = 2 * (i / (width / 2)), at = y * width + 2 * (i % (width / 2));
        float light[4];
        light[3] = 2.0f * (table->area[y] + table->area[y + 1]);
        for (int c = 0; c < 3; ++c) {
            const float *row = map + (size_t)c * (size_t)count + at;
            light[c] = (row[0] + row[1]) * table->area[y] + (row[width] + row[width + 1]) * table->area[y + 1];
        }
        share(out->shared, &table->share[i], light);
    }
    fold(out);
    return LMB_OK;
}

/* The normals first .. first + LMB_TILE_PIXELS - 1 of a cube; those past its end are its last. */
static void set_normals(float normal[3][LMB_TILE_PIXELS], int32_t first, int32_t n)
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t i = mini(first + k, 6 * n * n - 1);
        const lmb_vec3 d = cube_direction(i / (n * n), i % n, i / n % n, n);
        normal[0][k] = d.x;
        normal[1][k] = d.y;
        normal[2][k] = d.z;
    }
}

lmb_status lmb_probe_cosine(float *cube, int32_t n, const lmb_kernels *kernels, const lmb_probe_lights *lights,
                            const lmb_probe_table *table)
{
    if (cube == NULL || kernels == NULL || lights == NULL || table == NULL || n < 1 || n > 64) {
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
