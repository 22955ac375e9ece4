/* cloud.c: a depth picture as points, and their noise. Layer 6.                                                [M1] */
#include <string.h>

#include "../base/memory_check.h"
#include "../base/vec.h"
#include "cloud.h"

#if LMB_MIXED

#define NEAREST_M 0.01f
#define FARTHEST_M 1000.0f
#define MIN_NOISE 2e-5f    /* 1/m */
#define MAX_NOISE 0.02f
#define DEPTH_STEP_M 0.001f  /* resolution of distances in files, and the best accuracy of sensors */

enum { CURVATURE_STEP_PX = 4, NOISE_BINS = 512 }; /* px between the points of a second difference */

size_t lmb_cloud_bytes(int32_t width, int32_t height)
{
    if (width < 1 || height < 1 || width > LMB_MAX_SIDE || height > LMB_MAX_SIDE) {
        return 0;
    }
    return (size_t)width * (size_t)height * (sizeof(float) + sizeof(lmb_vec3));
}

/* Axes with +y along `up`. x is the camera's x, made level; if that is vertical, it is the direction straight back. */
lmb_axes lmb_axes_upright(lmb_vec3 up)
{
    const lmb_vec3 side = absf(up.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 0, 1);
    const lmb_vec3 x = normalize3(sub3(side, mul3(up, dot3(side, up)))), z = cross3(x, up);
    lmb_axes a;
    a.right = vec3(x.x, up.x, z.x);
    a.up = vec3(x.y, up.y, z.y);
    a.back = vec3(x.z, up.z, z.z);
    return a;
}

lmb_vec3 lmb_axes_turn(const lmb_axes *axes, lmb_vec3 v)
{
    if (axes == NULL) {
        return v;
    }
    return add3(add3(mul3(axes->right, v.x), mul3(axes->up, v.y)), mul3(axes->back, v.z));
}

lmb_vec3 lmb_cloud_ray(const lmb_pinhole *camera, float x, float y)
{
    if (camera == NULL) {
        return vec3(0.0f, 0.0f, -1.0f);
    }
    return vec3((x - camera->cx) / camera->fx, (camera->cy - y) / camera->fy, -1.0f);
}

lmb_vec3 lmb_cloud_point(const lmb_cloud *cloud, int32_t x, int32_t y)
{
    if (!is_measured(cloud, x, y)) {
        return vec3(0, 0, 0);
    }
    const float inverse = cloud->inverse[(size_t)y * (size_t)cloud->camera.width + (size_t)x];
    return mul3(lmb_cloud_ray(&cloud->camera, (float)x, (float)y), 1.0f / inverse);
}

/* A step s in distance z is a step s / z^2 in the inverse. */
float lmb_cloud_sigma(const lmb_cloud *cloud, float inverse)
{
    return (cloud != NULL ? cloud->noise : 0.0f) + DEPTH_STEP_M * inverse * inverse;
}

/* Second difference of three inverses in a line; negative if one is missing. */
static float bend(const float *at, ptrdiff_t step)
{
    const float a = at[-step], b = at[0], c = at[step];
    return a > 0.0f && b > 0.0f && c > 0.0f ? absf(a - 2.0f * b + c) : -1.0f;
}

static void count_bend(uint32_t *bins, uint32_t *count, float v)
{
    if (v >= 0.0f) {
        ++bins[mini((int32_t)(minf(v, 1.0f) * (float)NOISE_BINS / (2.5f * MAX_NOISE)), NOISE_BINS - 1)];
        ++*count;
    }
}

/* On a plane second differences contain only noise, with sqrt(1 + 4 + 1) times its deviation. Most of most pictures is
 * flat over 8 px, and edges are too few to move the median. Half of a normal distribution lies within 0.6745
 * deviations. */
static float find_noise(const lmb_cloud *cloud)
{
    uint32_t bins[NOISE_BINS] = {0}, count = 0, sum = 0;
    const int32_t w = cloud->camera.width, h = cloud->camera.height;
    int32_t i = 0;
    for (int32_t y = CURVATURE_STEP_PX; y < h - CURVATURE_STEP_PX; y += 2) {
        for (int32_t x = CURVATURE_STEP_PX; x < w - CURVATURE_STEP_PX; x += 2) {
            const float *at = cloud->inverse + (size_t)y * (size_t)w + (size_t)x;
            count_bend(bins, &count, bend(at, CURVATURE_STEP_PX));
            count_bend(bins, &count, bend(at, CURVATURE_STEP_PX * (ptrdiff_t)w));
        }
    }
    while (i < NOISE_BINS - 1 && (sum += bins[i]) < count / 2 + 1) {
        ++i;
    }
    const float median = ((float)i + 0.5f) * 2.5f * MAX_NOISE / (float)NOISE_BINS;
    return count == 0 || i == 0 ? MIN_NOISE : clampf(median / (0.6745f * 2.4494897f), MIN_NOISE, MAX_NOISE);
}

static int is_pinhole(const lmb_pinhole *c)
{
    return c->fx > 1e-3f && c->fy > 1e-3f && c->fx < 1e6f && c->fy < 1e6f && is_sane(c->cx) && is_sane(c->cy);
}

lmb_status lmb_cloud_init(lmb_cloud *out, const lmb_pinhole *camera, const float *depth_m, void *memory, size_t bytes)
{
    if (out == NULL || camera == NULL || depth_m == NULL || !is_pinhole(camera) ||
        lmb_cloud_bytes(camera->width, camera->height) == 0) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, lmb_cloud_bytes(camera->width, camera->height));
    if (status != LMB_OK) {
        return status;
    }
    const size_t pixels = (size_t)camera->width * (size_t)camera->height;
    out->camera = *camera;
    out->inverse = (float *)memory;
    out->normal = (lmb_vec3 *)(void *)(out->inverse + pixels);
    for (size_t i = 0; i < pixels; ++i) {
        const int known = depth_m[i] >= NEAREST_M && depth_m[i] <= FARTHEST_M;
        out->inverse[i] = known ? 1.0f / depth_m[i] : 0.0f;
    }
    memset(out->normal, 0, pixels * sizeof *out->normal);
    out->noise = find_noise(out);
    return LMB_OK;
}

#endif
