/* cloud_normals.c: normals of a cloud's points, in spite of holes and noise. Layer 6. [M2] */
#include "plane_fit.h"

#if LMB_MIXED

#define STEEPEST 3.7320508f /* tangent of 75 degrees: what a surface may be turned from the ray */

enum { MIN_POINTS = 6, MOST = 6 /* px to each side */ };

/* The square of points around one. */
typedef struct around {
    const lmb_cloud *cloud;
    int32_t x, y, reach, step; /* px */
    float q, sigma, tilt;      /* tilt: of the inverse a pixel, for the steepest surface */
} around;

/* The first round keeps what a surface can reach (slope NULL), the second what lies on the plane. */
static int keeps(const around *a, int32_t i, int32_t j, float q, lmb_vec3 ray, const float *slope)
{
    if (!(q > 0.0f)) {
        return 0;
    }
    if (slope == NULL) {
        const int32_t far = maxi(i < 0 ? -i : i, j < 0 ? -j : j);
        return absf(q - a->q) <= 4.0f * a->sigma + a->tilt * (float)far;
    }
    return absf(q - plane_inverse(slope, ray.x, ray.y)) <= 2.5f * a->sigma;
}

/* Rays differ by their column and row alone: a division each of these, not of each pixel. */
static int fit_around(float out[3], const around *a, const float *slope)
{
    const lmb_pinhole *c = &a->cloud->camera;
    const lmb_vec3 middle = lmb_cloud_ray(c, (float)a->x, (float)a->y);
    const int32_t x0 = maxi(-a->reach, -(a->x / a->step) * a->step), x1 = mini(a->reach, c->width - 1 - a->x);
    plane_fit f = plane_fit_at(middle.x, middle.y, a->q);
    float ray_x[2 * MOST + 1];
    int32_t count = 0;
    for (int32_t i = x0; i <= x1; i += a->step) {
        ray_x[i + MOST] = middle.x + (float)i / c->fx;
    }
    for (int32_t j = -a->reach; j <= a->reach; j += a->step) {
        const int32_t y = a->y + j;
        if (y < 0 || y >= c->height) {
            continue;
        }
        const float *row = a->cloud->inverse + (size_t)y * (size_t)c->width + a->x;
        const float ray_y = middle.y - (float)j / c->fy;
        for (int32_t i = x0; i <= x1; i += a->step) {
            const lmb_vec3 ray = vec3(ray_x[i + MOST], ray_y, -1.0f);
            if (keeps(a, i, j, row[i], ray, slope)) {
                plane_fit_add(&f, ray.x, ray.y, row[i], 1.0f);
                ++count;
            }
        }
    }
    return count >= MIN_POINTS && lmb_plane_fit_solve(out, &f);
}

static lmb_vec3 normal_at(const lmb_cloud *cloud, int32_t x, int32_t y)
{
    const lmb_pinhole *c = &cloud->camera;
    const int32_t wide = mini(maxi((int32_t)(c->fx / 90.0f), 2), MOST);
    around a = {cloud, x, y, wide > 3 ? wide & ~1 : wide, wide > 3 ? 2 : 1, 0.0f, 0.0f, 0.0f};
    float first[3], slope[3], distance;
    a.q = cloud->inverse[(size_t)y * (size_t)c->width + (size_t)x];
    if (!(a.q > 0.0f)) {
        return vec3(0, 0, 0);
    }
    a.sigma = lmb_cloud_sigma(cloud, a.q);
    a.tilt = a.q * STEEPEST / minf(c->fx, c->fy);
    if (!fit_around(first, &a, NULL)) {
        return vec3(0, 0, 0);
    }
    const int again = fit_around(slope, &a, first);
    return lmb_plane_normal(&distance, again ? slope : first);
}

lmb_status lmb_cloud_normals(const lmb_cloud *cloud, int32_t y0, int32_t y1)
{
    if (cloud == NULL || cloud->inverse == NULL || y0 < 0 || y1 < y0) {
        return LMB_ERR_ARG;
    }
    for (int32_t y = y0; y < y1 && y < cloud->camera.height; ++y) {
        for (int32_t x = 0; x < cloud->camera.width; ++x) {
            cloud->normal[(size_t)y * (size_t)cloud->camera.width + (size_t)x] = normal_at(cloud, x, y);
        }
    }
    return LMB_OK;
}

#endif
