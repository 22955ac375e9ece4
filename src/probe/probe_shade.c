/* probe_shade.c: small cubes with borders, and their light on the pixels of a tile. Layer 5.      [S17 S21 S22] */
#include <string.h>

#include "../base/memory_check.h"
#include "../direct/glossy.h"
#include "../raster/plane.h"
#include "../raster/tile.h"
#include "cube.h"
#include "world.h"

#if LMB_PROBES

/* --- cubes -------------------------------------------------------------------------------------------------------- */

size_t lmb_probe_cube_bytes(int32_t n)
{
    return n < 1 || n > 256 ? 0 : 6 * (size_t)(n + 2) * (size_t)(n + 2) * 4 * sizeof(float);
}

static size_t index_of_texel(int32_t face, int32_t x, int32_t y, int32_t n)
{
    return (size_t)((face * (n + 2) + y + 1) * (n + 2) + x + 1);
}

/* Copies each border texel from the interior texel in the same direction. A corner is the mean of the three texels that
 * meet there, so the three faces agree. */
static void set_cube_border(float (*texel)[4], int32_t n)
{
    const int32_t side = n + 2, around = 4 * (n + 1);
    for (int32_t i = 0; i < 6 * around; ++i) {
        const int32_t face = i / around, k = i % (n + 1), edge = i % around / (n + 1);
        const int32_t x = edge == 0 ? k : edge == 1 ? n : edge == 2 ? n - 1 - k : -1;
        const int32_t y = edge == 0 ? -1 : edge == 1 ? k : edge == 2 ? n : n - 1 - k;
        const cube_place p = cube_border(face, x, y, n);
        for (int c = 0; c < 4; ++c) {
            texel[index_of_texel(face, x, y, n)][c] = texel[index_of_texel(p.face, p.x, p.y, n)][c];
        }
    }
    for (int32_t i = 0; i < 24; ++i) {
        const int32_t face = i / 4, x = i & 1 ? n : -1, y = i & 2 ? n : -1;
        const int32_t in_x = clampi(x, 0, n - 1), in_y = clampi(y, 0, n - 1);
        for (int c = 0; c < 4; ++c) {
            texel[(face * side + y + 1) * side + x + 1][c] =
                (texel[index_of_texel(face, in_x, in_y, n)][c] + texel[index_of_texel(face, x, in_y, n)][c] +
                 texel[index_of_texel(face, in_x, y, n)][c]) *
                (1.0f / 3.0f);
        }
    }
}

lmb_status lmb_probe_cube_init(lmb_probe_cube *out, const float *planes, int32_t n, void *memory, size_t bytes)
{
    if (out == NULL || planes == NULL || lmb_probe_cube_bytes(n) == 0) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, lmb_probe_cube_bytes(n));
    if (status != LMB_OK) {
        return status;
    }
    float (*texel)[4] = (float (*)[4])memory;
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        float *to = texel[index_of_texel(i / (n * n), i % n, i / n % n, n)];
        to[0] = planes[i];
        to[1] = planes[6 * n * n + i];
        to[2] = planes[12 * n * n + i];
        to[3] = 1.0f;
    }
    set_cube_border(texel, n);
    out->texel = (const float *)memory;
    out->side = n;
    return LMB_OK;
}

static void sample_cube(lmb_world_job *out, const lmb_probe_cube *cube)
{
    out->texels = cube->texel;
    out->format = LMB_WORLD_F32;
    out->side = cube->side;
    out->cube_at = 0;
    out->means = 0;
}

/* --- a tile's pixels ---------------------------------------------------------------------------------------------- */

lmb_status lmb_probe_light_tile(lmb_irradiance *inout, const lmb_kernels *kernels, lmb_probe_rays *scratch,
                                const lmb_tile *tile, uint64_t pixels, const lmb_probe_cube *cube)
{
    lmb_world_job job;
    if (inout == NULL || scratch == NULL || kernels == NULL || tile == NULL || cube == NULL || cube->texel == NULL) {
        return LMB_ERR_ARG;
    }
    sample_cube(&job, cube);
    kernels->world_radiance(scratch->seen, (float (*)[LMB_TILE_PIXELS])tile->normal, &job);
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] += maxf(scratch->seen[c][k], 0.0f); /* filters may be negative beside sharp lights */
        }
    }
    return LMB_OK;
}

/* Sets the mirrored view directions. Pixels without a lobe get a dummy direction. */
static void reflect(float out[3][LMB_TILE_PIXELS], const lmb_glossy *glossy, const lmb_tile *tile)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int has = (int)(glossy->pixels >> k & 1u);
        const lmb_vec3 n = tile_vec(tile->normal, k), v = has ? tile_vec(glossy->towards, k) : n;
        const lmb_vec3 r = has ? sub3(mul3(n, 2.0f * dot3(n, v)), v) : vec3(0.0f, 1.0f, 0.0f);
        tile_set_vec(out, k, r);
    }
}

/* --- facets smaller than pixels ----------------------------------------------------------------------------------- */

#define FACET_RATIO (4.0f / 3.0f) /* ratio of the whole change to the facets' part */

/* Pixels with a triangle that none of the four neighbours in the tile shows. Several triangles lie in each, except in
 * some at the tile's edge. */
static uint64_t crowded(const lmb_tile *t, uint64_t pixels)
{
    for (int step = 1; step <= LMB_TILE; step += LMB_TILE - 1) {
        for (int k = 0; k + step < LMB_TILE_PIXELS; ++k) {
            const int is_row_end = step == 1 && k % LMB_TILE == LMB_TILE - 1;
            if (!is_row_end && t->id[k] == t->id[k + step]) {
                pixels &= ~((uint64_t)1 << k | (uint64_t)1 << (k + step));
            }
        }
    }
    return pixels;
}

/* For three pixels in a row, `step` apart, adds the change of normals between facets, and the whole change. */
static void add_change(float facets[LMB_TILE_PIXELS], float all[LMB_TILE_PIXELS], const lmb_tile *t, int k, int step)
{
    const lmb_vec3 before = tile_vec(t->normal, k - step), after = tile_vec(t->normal, k + step);
    const lmb_vec3 along = sub3(after, before), off = sub3(add3(before, after), mul3(tile_vec(t->normal, k), 2.0f));
    for (int i = k - step; i <= k + step; i += step) {
        facets[i] += dot3(off, off);
        all[i] += dot3(along, along);
    }
}

/* A pixel with several facets shows only one of them. The reflection of all is estimated as the mean over surrounding
 * pixels: their normals are samples of the facets. The mean counts to the extent that normals jump between facets
 * instead of bending smoothly. */
static void spread_normals(lmb_probe_rays *rays, const lmb_tile *t, uint64_t pixels)
{
    float *facets = rays->origin[0], *all = rays->origin[1]; /* reuses memory; so does `direction` */
    const uint64_t several = crowded(t, pixels);
    if (several == 0) {
        return;
    }
    memcpy(rays->direction, rays->seen, sizeof rays->seen);
    memset(rays->origin, 0, sizeof rays->origin);
    for (int step = 1; step <= LMB_TILE; step += LMB_TILE - 1) {
        for (int k = step; k + step < LMB_TILE_PIXELS; ++k) {
            const uint64_t three = (uint64_t)1 << k | (uint64_t)1 << (k - step) | (uint64_t)1 << (k + step);
            if ((k / step + 1) % LMB_TILE > 1 && (pixels & three) == three) {
                add_change(facets, all, t, k, step);
            }
        }
    }
    for (uint64_t bits = several; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits), x = k % LMB_TILE;
        const float part = minf(FACET_RATIO * facets[k] / maxf(all[k], 1e-12f), 1.0f);
        float sum[3] = {0.0f, 0.0f, 0.0f}, weights = 0.0f;
        for (int i = 0; i < 9; ++i) {
            const int at = k + LMB_TILE * (i / 3 - 1) + i % 3 - 1;
            if (at >= 0 && at < LMB_TILE_PIXELS && (unsigned)(at % LMB_TILE - x + 1) < 3u && (pixels >> at & 1u) != 0) {
                const float weight = i == 4 ? 4.0f : i % 2 == 1 ? 2.0f : 1.0f;
                for (int c = 0; c < 3; ++c) {
                    sum[c] += weight * rays->direction[c][at];
                }
                weights += weight;
            }
        }
        for (int c = 0; c < 3; ++c) {
            rays->seen[c][k] += part * (sum[c] / weights - rays->seen[c][k]);
        }
    }
}

/* --- reflections and background ----------------------------------------------------------------------------------- */

lmb_status lmb_probe_glossy_tile(lmb_glossy *inout, const lmb_kernels *kernels, lmb_probe_rays *scratch,
                                 const lmb_tile *tile, uint64_t pixels, const lmb_probe_cube *cube,
                                 const lmb_world_query *query)
{
    lmb_world_job job;
    if (inout == NULL || scratch == NULL || kernels == NULL || tile == NULL ||
        (cube == NULL ? query == NULL || query->world == NULL || query->world->texels == NULL : cube->texel == NULL)) {
        return LMB_ERR_ARG;
    }
    reflect(scratch->direction, inout, tile);
    if (cube != NULL) {
        sample_cube(&job, cube);
        kernels->world_radiance(scratch->seen, scratch->direction, &job);
    } else {
        lmb_world_ask(&job, query->world, LMB_WORLD_ALL, query->ray_width, query->blend);
        kernels->see(scratch->seen, (float (*)[LMB_TILE_PIXELS])tile->position, scratch->direction, &job);
    }
    spread_normals(scratch, tile, pixels & inout->pixels);
    for (uint64_t bits = pixels & inout->pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] += glossy_share(inout, c, k) * scratch->seen[c][k];
        }
    }
    return LMB_OK;
}

/* Sets the view rays of a tile's pixels: unit directions. */
static void view_rays(lmb_probe_rays *out, const lmb_view *view, int32_t x, int32_t y)
{
    lmb_rays rays;
    lmb_resolve_rays(&rays, view, x, y);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float across = (float)(k % LMB_TILE), down = (float)(k / LMB_TILE);
        const lmb_vec3 from = add3(rays.origin, add3(mul3(rays.ox, across), mul3(rays.oy, down)));
        const lmb_vec3 at = add3(view->eye, from);
        const lmb_vec3 to = normalize3(add3(rays.direction, add3(mul3(rays.rx, across), mul3(rays.ry, down))));
        tile_set_vec(out->origin, k, at);
        tile_set_vec(out->direction, k, to);
    }
}

lmb_status lmb_probe_background(float inout[3][LMB_TILE_PIXELS], const lmb_kernels *kernels, lmb_probe_rays *scratch,
                                const lmb_tile *tile, const lmb_view *view, const lmb_world_query *query)
{
    lmb_world_job job;
    if (inout == NULL || scratch == NULL || kernels == NULL || tile == NULL || view == NULL || query == NULL ||
        query->world == NULL || query->world->texels == NULL) {
        return LMB_ERR_ARG;
    }
    view_rays(scratch, view, tile->x, tile->y);
    lmb_world_ask(&job, query->world, LMB_WORLD_ALL, query->ray_width, query->blend);
    kernels->see(scratch->seen, scratch->origin, scratch->direction, &job);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        for (int c = 0; c < 3 && tile->id[k] == 0; ++c) {
            inout[c][k] = scratch->seen[c][k];
        }
    }
    return LMB_OK;
}

#endif
