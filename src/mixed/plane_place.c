/* plane_place.c: chooses the plane below an object, and the position. Layer 6.           [M5] */
#include "planes.h"

#if LMB_MIXED

#define MIN_UP 0.34202014f /* cosine of 70 degrees: max tilt of a floor from the camera's up */
#define MIN_LEVEL_COSINE 0.90630779f /* of 25 degrees: max tilt of level planes */
#define MAX_WALL_COSINE  0.17364818f /* of 80 degrees: min tilt of walls */

enum { CLEAR_STEP = 4 /* px */, CIRCLE_POINTS = 8 /* points of a circle */ };

/* Score of a direction as up: level planes count in full, walls half, because most pictures show more wall than floor.
 * Directions nearer to the camera's up score more: if the camera is tilted by less than 45 degrees, floors then win
 * over walls. */
static float says_up(const lmb_planes *planes, lmb_vec3 up)
{
    const float tall = maxf(up.y - MIN_UP, 0.0f);
    float sum = 0.0f;
    for (int32_t i = 0; i < planes->count && tall > 0.0f; ++i) {
        const float d = absf(dot3(planes->plane[i].normal, up)),
                    says = d > MIN_LEVEL_COSINE ? (d - MIN_LEVEL_COSINE) / (1.0f - MIN_LEVEL_COSINE)
                                                : 0.5f * maxf(1.0f - d / MAX_WALL_COSINE, 0.0f);
        sum += (float)planes->plane[i].pixels * says;
    }
    return sum * tall * tall;
}

static lmb_vec3 towards_up(lmb_vec3 v) { return v.y < 0.0f ? mul3(v, -1.0f) : v; }

/* The direction with the best score: the normal of a floor or ceiling, or the common direction of two walls if neither
 * is visible. Noise along two walls grows with 1 / sine of the angle between them, so such pairs are weighted with the
 * squared sine. */
lmb_vec3 lmb_planes_up(const lmb_planes *planes)
{
    lmb_vec3 up = vec3(0, 1, 0);
    float max = 0.0f;
    for (int32_t i = 0; planes != NULL && i < planes->count; ++i) {
        for (int32_t k = i; k < planes->count; ++k) {
            const lmb_vec3 n = planes->plane[i].normal, both = cross3(n, planes->plane[k].normal),
                           one = towards_up(i == k ? n : normalize3(both));
            const float says = says_up(planes, one) * (i == k ? 1.0f : dot3(both, both));
            if (says > max) {
                max = says;
                up = one;
            }
        }
    }
    return up;
}

int32_t lmb_planes_floor(const lmb_planes *planes)
{
    const lmb_vec3 up = lmb_planes_up(planes);
    int32_t best = -1;
    float max = 0.0f;
    for (int32_t i = 0; planes != NULL && i < planes->count; ++i) {
        const lmb_flat *p = &planes->plane[i];
        const float size = (float)p->pixels * minf(dot3(p->normal, up) - MIN_LEVEL_COSINE, p->normal.y - MIN_UP);
        if (size > max) {
            max = size;
            best = i;
        }
    }
    return best;
}

int lmb_planes_anchor(lmb_vec3 *out, const lmb_planes *planes, const lmb_pinhole *camera, int32_t p, float x, float y)
{
    if (out == NULL || planes == NULL || camera == NULL || p < 0 || p >= planes->count) {
        return 0;
    }
    const lmb_vec3 ray = lmb_cloud_ray(camera, x, y);
    const float inverse = plane_inverse(planes->plane[p].slope, ray.x, ray.y);
    if (!(inverse > 1e-3f)) {
        return 0;
    }
    *out = mul3(ray, 1.0f / inverse);
    return 1;
}

/* --- the position ------------------------------------------------------------------------------------------------- */

/* An upright object to be placed. */
typedef struct standing_place {
    const lmb_planes *planes;
    const lmb_cloud *cloud;
    int32_t p;
    float radius, height; /* m */
} standing_place;

/* Pixel that shows a point, or -1. */
static int32_t pixel_of_place(const lmb_pinhole *c, lmb_vec3 at)
{
    if (!(at.z < -1e-3f)) {
        return -1;
    }
    const float x = c->cx - c->fx * at.x / at.z + 0.5f, y = c->cy + c->fy * at.y / at.z + 0.5f;
    return x >= 0.0f && y >= 0.0f && x < (float)c->width && y < (float)c->height
               ? (int32_t)y * c->width + (int32_t)x
               : -1;
}

/* Point k of the rim, `radius` from a position on the plane and `height` above it. */
static lmb_vec3 rim_point(const standing_place *s, lmb_vec3 at, int32_t k, float radius, float height)
{
    static const float turn[CIRCLE_POINTS][2] = {{1, 0},  {0.7071f, 0.7071f},   {0, 1},  {-0.7071f, 0.7071f},
                                                 {-1, 0}, {-0.7071f, -0.7071f}, {0, -1}, {0.7071f, -0.7071f}};
    const lmb_flat *plane = &s->planes->plane[s->p];
    const lmb_vec3 out = add3(mul3(plane->across, radius * turn[k][0]), mul3(plane->along, radius * turn[k][1]));
    return add3(add3(at, out), mul3(plane->normal, height));
}

/* Is the plane visible on the circle and on one of half the radius? */
static int foot_is_clear(const standing_place *s, lmb_vec3 at)
{
    for (int32_t k = 0; k < 2 * CIRCLE_POINTS; ++k) {
        const float radius = k < CIRCLE_POINTS ? s->radius : 0.5f * s->radius;
        const int32_t pixel = pixel_of_place(&s->cloud->camera, rim_point(s, at, k % CIRCLE_POINTS, radius, 0.0f));
        if (pixel < 0 || s->planes->label[pixel] != s->p + 1) {
            return 0;
        }
    }
    return 1;
}

/* Does the body lie in the picture, half way up and at the top, with nothing measured in front of it? */
static int body_is_clear(const standing_place *s, lmb_vec3 at)
{
    for (int32_t k = 0; k < 2 * CIRCLE_POINTS && s->height > 0.0f; ++k) {
        const lmb_vec3 rim =
            rim_point(s, at, k % CIRCLE_POINTS, s->radius, k < CIRCLE_POINTS ? s->height : 0.5f * s->height);
        const int32_t pixel = pixel_of_place(&s->cloud->camera, rim);
        const float q = pixel < 0 ? 0.0f : s->cloud->inverse[pixel];
        if (pixel < 0 || q + 1.0f / rim.z > 2.0f * lmb_cloud_sigma(s->cloud, q)) {
            return 0;
        }
    }
    return 1;
}

int lmb_planes_clear(lmb_vec3 *out, const lmb_planes *planes, const lmb_cloud *cloud, int32_t p, float radius_m,
                     float height_m)
{
    const standing_place s = {planes, cloud, p, radius_m, height_m};
    float min = 1e30f;
    if (out == NULL || !are_labels(planes, cloud) || p < 0 || p >= planes->count) {
        return 0;
    }
    const lmb_flat *plane = &planes->plane[p];
    if (foot_is_clear(&s, plane->centre) && body_is_clear(&s, plane->centre)) {
        *out = plane->centre;
        return 1;
    }
    for (int32_t y = plane->y0; y < plane->y1; y += CLEAR_STEP) {
        for (int32_t x = plane->x0; x < plane->x1; x += CLEAR_STEP) {
            lmb_vec3 at;
            if (planes->label[y * cloud->camera.width + x] != p + 1 ||
                !lmb_planes_anchor(&at, planes, &cloud->camera, p, (float)x, (float)y)) {
                continue;
            }
            const lmb_vec3 d = sub3(at, plane->centre);
            if (dot3(d, d) < min && foot_is_clear(&s, at) && body_is_clear(&s, at)) {
                min = dot3(d, d);
                *out = at;
            }
        }
    }
    return min < 1e30f;
}

#endif
