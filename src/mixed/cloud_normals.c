/* cloud_normals.c: normals of a cloud's points, robust to holes and noise. Layer 6.   [M2] */
#include "plane_fit.h"

#include <string.h>

#if LMB_MIXED

#define MAX_SLOPE_PER_M 1e30f      /* 1/m */
#define MAX_TILT_TANGENT 3.7320508f /* tangent of 75 degrees: max angle between a surface's normal and the ray */

enum { MIN_POINTS = 6, MAX_RADIUS_PX = 6 /* px to each side */, SPAN_PX = 16 /* px */ };

/* Sums of plane_fit for each pixel, with weights of 1 or 0. */
typedef struct depth_sums {
    float w[SPAN_PX], x[SPAN_PX], y[SPAN_PX], xx[SPAN_PX], xy[SPAN_PX], yy[SPAN_PX], q[SPAN_PX], xq[SPAN_PX],
        yq[SPAN_PX];
} depth_sums;

/* The square neighbourhoods of adjacent pixels. Arrays in one struct cannot overlap, so compilers can vectorize. */
typedef struct normal_around {
    const lmb_cloud *cloud;
    int32_t x, y, reach, step; /* px */
    float q[SPAN_PX], sigma[SPAN_PX], tilt[SPAN_PX]; /* tilt: change of the inverse per pixel on the steepest surface */
    float ray_x[SPAN_PX], ray_y;
    float slope[3][SPAN_PX];
    float near[SPAN_PX + 2 * MAX_RADIUS_PX]; /* inverses of a row; 0 beyond the picture */
    float is_in[SPAN_PX];                    /* 1 if a point of the row counts, else 0 */
    depth_sums s;
} normal_around;

/* Replaces values that are not finite by 0: even with weight 0 they would spoil the sums. */
static void read_around_row(normal_around *a, int32_t y)
{
    const int32_t width = a->cloud->camera.width, from = maxi(a->x - MAX_RADIUS_PX, 0),
                  to = mini(a->x + SPAN_PX + MAX_RADIUS_PX, width);
    memset(a->near, 0, sizeof a->near);
    memcpy(a->near + (from - a->x + MAX_RADIUS_PX), a->cloud->inverse + (size_t)y * (size_t)width + from,
           (size_t)(to - from) * sizeof(float));
    for (int i = 0; i < SPAN_PX + 2 * MAX_RADIUS_PX; ++i) {
        a->near[i] = a->near[i] <= MAX_SLOPE_PER_M ? a->near[i] : 0.0f;
    }
}

/* Adds the point i columns to the right of each pixel, if it counts. */
static void add_points(normal_around *a, int32_t i, float right, float ray_y)
{
    for (int k = 0; k < SPAN_PX; ++k) {
        const float w = a->is_in[k], x = w * ((a->ray_x[k] + right) - a->ray_x[k]), y = w * (ray_y - a->ray_y),
                    q = w * (a->near[MAX_RADIUS_PX + i + k] - a->q[k]);
        a->s.w[k] += w;
        a->s.x[k] += x;
        a->s.y[k] += y;
        a->s.xx[k] += x * x;
        a->s.xy[k] += x * y;
        a->s.yy[k] += y * y;
        a->s.q[k] += q;
        a->s.xq[k] += x * q;
        a->s.yq[k] += y * q;
    }
}

/* Selects points within reach of a surface `far` pixels away. */
static void can_reach(normal_around *a, int32_t i, float far)
{
    for (int k = 0; k < SPAN_PX; ++k) {
        const float q = a->near[MAX_RADIUS_PX + i + k];
        a->is_in[k] = (float)((q > 0.0f) & (absf(q - a->q[k]) <= 4.0f * a->sigma[k] + a->tilt[k] * far));
    }
}

/* Selects points on the plane of the first fit. */
static void lies_on(normal_around *a, int32_t i, float right, float ray_y)
{
    for (int k = 0; k < SPAN_PX; ++k) {
        const float q = a->near[MAX_RADIUS_PX + i + k],
                    on = a->slope[0][k] * (a->ray_x[k] + right) + a->slope[1][k] * ray_y + a->slope[2][k];
        a->is_in[k] = (float)((q > 0.0f) & (absf(q - on) <= 2.5f * a->sigma[k]));
    }
}

static void add_around_row(normal_around *a, int32_t j, int is_again)
{
    const float ray_y = a->ray_y - (float)j / a->cloud->camera.fy;
    for (int32_t i = -a->reach; i <= a->reach; i += a->step) {
        const float right = (float)i / a->cloud->camera.fx;
        if (is_again) {
            lies_on(a, i, right, ray_y);
        } else {
            can_reach(a, i, (float)maxi(i < 0 ? -i : i, j < 0 ? -j : j));
        }
        add_points(a, i, right, ray_y);
    }
}

static void add_all(normal_around *a, int is_again)
{
    memset(&a->s, 0, sizeof a->s);
    for (int32_t j = -a->reach; j <= a->reach; j += a->step) {
        if (a->y + j >= 0 && a->y + j < a->cloud->camera.height) {
            read_around_row(a, a->y + j);
            add_around_row(a, j, is_again);
        }
    }
}

static int solve_slope(float slope[3], const normal_around *a, int k)
{
    const depth_sums *s = &a->s;
    const plane_fit f = {a->ray_x[k], a->ray_y, a->q[k], s->w[k], s->x[k], s->y[k], s->xx[k], s->xy[k], s->yy[k],
                         s->q[k], s->xq[k], s->yq[k]};
    return s->w[k] >= (float)MIN_POINTS && lmb_plane_fit_solve(slope, &f);
}

static void begin_around(normal_around *a, const lmb_cloud *cloud, int32_t x, int32_t y)
{
    const lmb_pinhole *c = &cloud->camera;
    const int32_t wide = mini(maxi((int32_t)(c->fx / 90.0f), 2), MAX_RADIUS_PX);
    memset(a, 0, sizeof *a);
    a->cloud = cloud;
    a->x = x;
    a->y = y;
    a->reach = wide > 3 ? wide & ~1 : wide;
    a->step = wide > 3 ? 2 : 1;
    for (int32_t k = 0; k < SPAN_PX; ++k) {
        const lmb_vec3 ray = lmb_cloud_ray(c, (float)(x + k), (float)y);
        a->q[k] = x + k < c->width ? cloud->inverse[(size_t)y * (size_t)c->width + (size_t)(x + k)] : 0.0f;
        a->ray_x[k] = ray.x;
        a->ray_y = ray.y;
        a->sigma[k] = lmb_cloud_sigma(cloud, a->q[k]);
        a->tilt[k] = a->q[k] * MAX_TILT_TANGENT / minf(c->fx, c->fy);
    }
}

/* Normals of adjacent pixels: from a first fit, then from a second without the outliers of the first. */
static void find_span(lmb_vec3 *out, const lmb_cloud *cloud, int32_t x, int32_t y, int32_t count)
{
    normal_around a;
    float first[SPAN_PX][3], again[3], distance;
    int32_t is_found[SPAN_PX];
    begin_around(&a, cloud, x, y);
    add_all(&a, 0);
    for (int32_t k = 0; k < SPAN_PX; ++k) {
        is_found[k] = a.q[k] > 0.0f && solve_slope(first[k], &a, k);
        for (int c = 0; c < 3; ++c) {
            a.slope[c][k] = is_found[k] ? first[k][c] : 0.0f;
        }
    }
    add_all(&a, 1);
    for (int32_t k = 0; k < count; ++k) {
        out[k] =
            is_found[k] ? lmb_plane_normal(&distance, solve_slope(again, &a, k) ? again : first[k]) : vec3(0, 0, 0);
    }
}

lmb_status lmb_cloud_normals(const lmb_cloud *cloud, int32_t y0, int32_t y1)
{
    if (cloud == NULL || cloud->inverse == NULL || y0 < 0 || y1 < y0) {
        return LMB_ERR_ARG;
    }
    const int32_t width = cloud->camera.width;
    for (int32_t y = y0; y < y1 && y < cloud->camera.height; ++y) {
        for (int32_t x = 0; x < width; x += SPAN_PX) {
            find_span(cloud->normal + (size_t)y * (size_t)width + (size_t)x, cloud, x, y, mini(SPAN_PX, width - x));
        }
    }
    return LMB_OK;
}

#endif
