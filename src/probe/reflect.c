/* reflect.c: reflection of the world on a rough surface, by reflected direction, as a cube. Layer 5. [S16 S17 S22]
 *
 * The lobe of lmb_glossy for a viewer straight above: D(h) G(l) / 4 around a direction. Rays are distributed in
 * proportion to D / 4 and weighted by Smith's G (Walter et al. 2007, Heitz 2014). Each ray is as wide as its share of
 * the lobe (filtered importance sampling, Krivanek and Colbert 2008). The longer lobe at grazing angles is neglected,
 * as in all such cubes. */
#include <string.h>

#include "../base/poly.h"
#include "../raster/tile.h"
#include "cube.h"
#include "world.h"

#if LMB_PROBES

enum { RINGS = 8, RING_RAYS = 8, CALM_AROUND = 5, RAYS = RINGS * RING_RAYS };
enum { MIRROR_RAYS_A_SIDE = 6 }; /* along each side of a mirror's texel: the value is the mean over the texel */

/* Without peaks a world is smooth and needs fewer rays. A narrower lobe would show a peak, which is the light of a 32nd
 * of a face, as a speck. */
static const float least_calm = 0.03f;

/* A ray around +z: one of RING_RAYS in a ring. */
typedef struct lobe_ray {
    lmb_vec3 to;
    float weight, width; /* rad */
} lobe_ray;

/* Requested width: the root of half of a ray's share. Texels are 1 to 2 times as wide, and bilinear reads spread them
 * over twice their width. */
static const float share_read = 0.7f;

/* Ring i represents the i-th 1 / RINGS of D down to the horizon and lies at the middle: tan^2 of the half vector's
 * angle is a2 u / (1 - u), and 1 at the horizon. Consecutive rings are rotated by half a step. */
static float set_rays(lobe_ray out[RAYS], float alpha, int around)
{
    const float a2 = alpha * alpha, horizon = 1.0f / (1.0f + a2);
    float sum = 0.0f;
    for (int i = 0; i < RINGS * around; ++i) {
        const int ring = i / around;
        const float u = horizon * (((float)ring + 0.5f) / (float)RINGS), tan2 = a2 * u / (1.0f - u),
                    cos2 = 1.0f / (1.0f + tan2);
        const float z = 2.0f * cos2 - 1.0f, round = sqrtf(maxf(1.0f - z * z, 0.0f));
        const float angle = 2.0f * LMB_PI * (((float)(i % around) + 0.5f * (float)(ring % 2)) / (float)around);
        const float t = cos2 * (a2 - 1.0f) + 1.0f, d = a2 / (LMB_PI * (t * t));
        out[i].to = vec3(round * lmb_cos(angle), round * lmb_sin(angle), z);
        out[i].weight = 2.0f * z / (z + sqrtf(a2 + (1.0f - a2) * (z * z)));
        out[i].width = share_read * sqrtf(4.0f * horizon / (d * (float)(RINGS * around)));
        sum += out[i].weight;
    }
    return sum;
}

/* Two directions perpendicular to n and to each other. */
static void frame_of(lmb_vec3 *across, lmb_vec3 *along, lmb_vec3 n)
{
    const lmb_vec3 up = absf(n.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
    *across = normalize3(cross3(up, n));
    *along = cross3(n, *across);
}

static void set_ray_tile(lmb_probe_rays *t, int32_t first, int32_t n, lmb_vec3 at)
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t i = mini(first + k, 6 * n * n - 1);
        lmb_vec3 across, along;
        const lmb_vec3 d = cube_nth_direction(i, n);
        frame_of(&across, &along, d);
        tile_set_vec(t->n, k, d);
        tile_set_vec(t->across, k, across);
        tile_set_vec(t->along, k, along);
        tile_set_vec(t->origin, k, at);
    }
    memset(t->sum, 0, sizeof t->sum);
}

/* Loops over planes, so that compilers vectorize over pixels. */
static void point_ray(lmb_probe_rays *t, const lobe_ray *ray)
{
    const lmb_vec3 to = ray->to;
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            t->direction[c][k] = t->across[c][k] * to.x + t->along[c][k] * to.y + t->n[c][k] * to.z;
        }
    }
}

static void point_fine(lmb_probe_rays *t, int32_t first, int32_t n, int32_t part)
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t i = mini(first + k, 6 * n * n - 1), x = MIRROR_RAYS_A_SIDE * (i % n) + part % MIRROR_RAYS_A_SIDE,
                      y = MIRROR_RAYS_A_SIDE * (i / n % n) + part / MIRROR_RAYS_A_SIDE;
        const lmb_vec3 d = cube_direction(i / (n * n), x, y, MIRROR_RAYS_A_SIDE * n);
        tile_set_vec(t->direction, k, d);
    }
}

static void add_seen(lmb_probe_rays *t, float weight, const lmb_kernels *kernels, const lmb_world_job *job)
{
    kernels->see(t->seen, t->origin, t->direction, job);
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            t->sum[c][k] += weight * t->seen[c][k];
        }
    }
}

/* Response of the lobe around r to light from d, per W/m2: D(h) G / 4 of the whole lobe. */
static float lobe_at(lmb_vec3 r, lmb_vec3 d, float a2)
{
    const float z = dot3(r, d), t = 0.5f * (1.0f + z) * (a2 - 1.0f) + 1.0f;
    return z > 0.0f ? a2 / (4.0f * LMB_PI * (t * t)) * (2.0f * z / (z + sqrtf(a2 + (1.0f - a2) * (z * z)))) : 0.0f;
}

/* Adds peaks exactly, because a few rays would miss them or count them several times. `lobe`: sum that the rays'
 * weights represent. */
static void add_peaks(lmb_probe_rays *t, const lmb_world_job *job, const lmb_world *world, lmb_vec3 at, float alpha,
                      float lobe)
{
    for (int32_t i = 0; i < world->peaks; ++i) {
        lmb_vec3 to;
        const float times = lmb_world_see_peak(&to, job, world, &world->peak[i], at) * lobe;
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const float part = times * lobe_at(tile_vec((const float(*)[LMB_TILE_PIXELS])t->n, k), to, alpha * alpha);
            for (int c = 0; c < 3; ++c) {
                t->sum[c][k] += part * world->peak[i].flux[c];
            }
        }
    }
}

static void store_cube_texels(float *cube, const lmb_probe_rays *t, int32_t first, int32_t texels, float scale)
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS && first + k < texels; ++k) {
        for (int c = 0; c < 3; ++c) {
            cube[c * texels + first + k] = maxf(t->sum[c][k] * scale, 0.0f);
        }
    }
}

int32_t lmb_probe_glossy_side(float roughness)
{
    return roughness < 0.1f ? 0 : roughness < 0.3f ? 64 : roughness < 0.6f ? 16 : 8;
}

static void mirror(float *cube, int32_t n, lmb_probe_rays *t, const lmb_kernels *kernels, const lmb_world_query *query,
                   lmb_vec3 at)
{
    lmb_world_job job;
    lmb_world_ask(&job, query->world, LMB_WORLD_ALL, 0.5f * LMB_PI / (float)(MIRROR_RAYS_A_SIDE * n), query->blend);
    job.means = 1;
    for (int32_t first = 0; first < 6 * n * n; first += LMB_TILE_PIXELS) {
        set_ray_tile(t, first, n, at);
        for (int32_t part = 0; part < MIRROR_RAYS_A_SIDE * MIRROR_RAYS_A_SIDE; ++part) {
            point_fine(t, first, n, part);
            add_seen(t, 1.0f, kernels, &job);
        }
        store_cube_texels(cube, t, first, 6 * n * n, 1.0f / (float)(MIRROR_RAYS_A_SIDE * MIRROR_RAYS_A_SIDE));
    }
}

static void blur(float *cube, int32_t n, lmb_probe_rays *t, const lmb_kernels *kernels, const lmb_world_query *query,
                 lmb_vec3 at, float alpha)
{
    lobe_ray rays[RAYS];
    const int32_t of = alpha < least_calm || query->world->peaks == 0 ? LMB_WORLD_ALL : LMB_WORLD_CALM;
    const int around = of == LMB_WORLD_CALM ? CALM_AROUND : RING_RAYS;
    const float weights = set_rays(rays, alpha, around), lobe = (1.0f + alpha * alpha) * (float)(RINGS * around);
    lmb_world_job job;
    for (int32_t first = 0; first < 6 * n * n; first += LMB_TILE_PIXELS) {
        set_ray_tile(t, first, n, at);
        for (int i = 0; i < RINGS * around; ++i) {
            lmb_world_ask(&job, query->world, of, rays[i].width, query->blend);
            point_ray(t, &rays[i]);
            add_seen(t, rays[i].weight, kernels, &job);
        }
        if (of == LMB_WORLD_CALM) {
            add_peaks(t, &job, query->world, at, alpha, lobe);
        }
        store_cube_texels(cube, t, first, 6 * n * n, 1.0f / weights);
    }
}

lmb_status lmb_probe_reflect(float *cube, int32_t n, const lmb_kernels *kernels, lmb_probe_rays *scratch,
                             const lmb_world_query *query, lmb_vec3 at, float roughness)
{
    if (cube == NULL || scratch == NULL || kernels == NULL || query == NULL || query->world == NULL ||
        query->world->texels == NULL ||
        lmb_probe_cube_bytes(n) == 0 || !is_place(at) || query->world->peaks < 0 ||
        query->world->peaks > LMB_WORLD_PEAKS || !(roughness >= 0.0f && roughness <= 1.0f)) {
        return LMB_ERR_ARG;
    }
    const float alpha = roughness * roughness;
    if (alpha < LMB_MIN_ALPHA) {
        mirror(cube, n, scratch, kernels, query, at);
    } else {
        blur(cube, n, scratch, kernels, query, at, alpha);
    }
    return LMB_OK;
}

#endif
