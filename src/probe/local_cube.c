/* local_cube.c: a map -> lights of 6 x 8 x 8 directions -> irradiance by normal. Layer 6.                 [S14] */
#include <string.h>

#include "../lane/kernels.h"
#include "../map/cube.h"

#if LMB_PROBES

/* A border's share goes to the texel that its direction meets. */
static void fold(lmb_probe_lights *inout, const lmb_probe_table *table)
{
    memset(inout->rgbw, 0, sizeof inout->rgbw);
    for (int32_t i = 0; i < LMB_PROBE_BORDERED; ++i) {
        for (int c = 0; c < 4; ++c) {
            inout->rgbw[c][table->fold[i]] += inout->shared[i][c];
        }
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
    fold(out, table);
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
    if (cube == NULL || kernels == NULL || lights == NULL || table == NULL || table->light == NULL || n < 1 || n > 64) {
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
