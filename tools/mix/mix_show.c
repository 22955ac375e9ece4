/* mix_show.c: pictures for --show: planes, environment, voxels. */
#include "mix_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void tell_planes(const mix_job *j)
{
    report_note(j->o.is_quiet, "depth is noisy by %.4f 1/m", (double)j->cloud.noise);
    for (int32_t i = 0; i < j->planes.count; ++i) {
        const lmb_flat *p = &j->planes.plane[i];
        report_note(j->o.is_quiet,
                    "plane %2d: %.2f x %.2f m, %.3f m from the camera, faces %.3f,%.3f,%.3f; %d pixels about %d,%d",
                    (int)i + 1, (double)(p->high[0] - p->low[0]), (double)(p->high[1] - p->low[1]),
                    (double)p->distance, (double)p->normal.x, (double)p->normal.y, (double)p->normal.z, (int)p->pixels,
                    (int)((p->x0 + p->x1) / 2), (int)((p->y0 + p->y1) / 2));
    }
    const int32_t floor = mix_floor(j);
    report_note(j->o.is_quiet || floor < 0, "an object would stand on plane %d, which faces up", (int)floor + 1);
}

int mix_show_planes(mix_job *j, report *r)
{
    static const float colours[6][3] = {{0.9f, 0.2f, 0.15f}, {0.15f, 0.7f, 0.2f}, {0.15f, 0.3f, 0.9f},
                                        {0.9f, 0.7f, 0.1f},  {0.7f, 0.2f, 0.8f},  {0.1f, 0.7f, 0.8f}};
    if (!mix_image(&j->picture, j->frame.light.width, j->frame.light.height, r)) {
        return 0;
    }
    tell_planes(j);
    for (size_t i = 0; i < (size_t)j->picture.width * (size_t)j->picture.height; ++i) {
        const uint8_t label = j->planes.label[i];
        const float *p = j->frame.light.pixels + 3 * i;
        const float grey = 0.2f + 0.8f * (p[0] + p[1] + p[2]) / 3.0f, dark = label > 6 ? 0.55f : 1.0f;
        for (size_t c = 0; c < 3; ++c) {
            j->picture.pixels[3 * i + c] = label == 0 ? 0.3f * grey : dark * grey * colours[(label - 1) % 6][c];
        }
    }
    return 1;
}

int mix_show_env(mix_job *j, report *r)
{
    const int32_t n = j->env[0].size;
    if (!mix_image(&j->picture, n, 6 * n, r)) {
        return 0;
    }
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        const float s = (2.0f * (float)(i % n) + 1.0f) / (float)n - 1.0f,
                    t = (2.0f * (float)(i / n % n) + 1.0f) / (float)n - 1.0f;
        const lmb_vec3 all[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
        lmb_env_sample(j->picture.pixels + 3 * i, &j->env[0], all[i / (n * n)], 0.0f);
    }
    return 1;
}

/* --- voxels ------------------------------------------------------------------------------------------------------- */

#define NARROW 0.01f /* tangent of half the angle of the cones that view them */

/* Distance along a camera ray to the cube, m; 0 inside it, or if the ray misses it. */
static float cube_begins(const lmb_voxels *v, lmb_vec3 ray)
{
    const float side = v->leaf * (float)(1 << v->depth), way[3] = {ray.x, ray.y, ray.z},
                low[3] = {v->low.x, v->low.y, v->low.z};
    float in = 0.0f, out = 1e9f;
    for (int i = 0; i < 3; ++i) {
        const float a = low[i] / way[i], b = (low[i] + side) / way[i];
        if (way[i] != 0.0f) {
            in = fmaxf(in, fminf(a, b));
            out = fminf(out, fmaxf(a, b));
        }
    }
    return in < out ? in : 0.0f;
}

/* A tile of points at which rays of the photo enter the cube, facing along them. */
static void aim(lmb_tile *tile, float direction[3][LMB_TILE_PIXELS], const mix_job *j, int32_t x, int32_t y)
{
    memset(tile, 0, sizeof *tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        lmb_vec3 ray = lmb_cloud_ray(&j->frame.camera, (float)(x + k % LMB_TILE), (float)(y + k / LMB_TILE));
        const float length = sqrtf(ray.x * ray.x + ray.y * ray.y + 1.0f);
        ray = lmb_axes_turn(&j->axes, (lmb_vec3){ray.x / length, ray.y / length, ray.z / length});
        const float at = cube_begins(&j->voxels, ray), way[3] = {ray.x, ray.y, ray.z};
        for (int i = 0; i < 3; ++i) {
            tile->position[i][k] = at * way[i];
            tile->face[i][k] = tile->normal[i][k] = direction[i][k] = way[i];
        }
        tile->depth[k] = 1.0f;
        tile->id[k] = 1;
    }
}

typedef struct look {
    lmb_tile tile;
    float direction[3][LMB_TILE_PIXELS];
    lmb_cone_seen seen;
    lmb_cone_width width;
} look;

int mix_show_voxels(mix_job *j, report *r)
{
    const lmb_cone_trace trace = {j->o.kernels, &j->voxels, LMB_VOXEL_WITH, LMB_VOXEL_WITH, NULL, j->scratch, 1};
    look *l = mix_take(j, sizeof *l, r);
    const int32_t w = j->frame.light.width, h = j->frame.light.height;
    if (l == NULL || !mix_image(&j->picture, w, h, r)) {
        return 0;
    }
    if (j->voxels.count == 0 || lmb_cone_width_init(&l->width, &j->voxels, NARROW) != LMB_OK) {
        return report_fail(r, "--show voxels: they are made about an object; add --object MESH");
    }
    for (int32_t i = 0; i < (w + LMB_TILE - 1) / LMB_TILE * ((h + LMB_TILE - 1) / LMB_TILE); ++i) {
        const int32_t across = (w + LMB_TILE - 1) / LMB_TILE, x = i % across * LMB_TILE, y = i / across * LMB_TILE;
        aim(&l->tile, l->direction, j, x, y);
        lmb_cones_trace(&l->seen, &trace, &l->width, &l->tile, l->direction);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
            for (int c = 0; c < 3 && px < w && py < h; ++c) {
                j->picture.pixels[3 * ((size_t)py * (size_t)w + (size_t)px) + (size_t)c] = l->seen.rgb[c][k];
            }
        }
    }
    return 1;
}
