/* plane_outline.c: the pixels of a plane, including holes, and the plane's size. Layer 6.       [M4 M5] */
#include "planes.h"

#if LMB_MIXED

#define BELONGS_OFF 4.5f
#define MIN_OWN_COSINE 0.7071068f /* cosine of 45 degrees: points turned farther belong to another surface */

enum { NEAR_PX = 8, MAX_SPECK_PX = 12 };

static const int32_t step_x[4] = {-1, 1, 0, 0}, step_y[4] = {0, 0, -1, 1};

/* --- the plane of each pixel -------------------------------------------------------------------------------------- */

/* Of a pixel's plane and the planes a few pixels away, returns the one with the best fit. Regions grow across edges as
 * far as noise allows. */
static uint8_t best_of_near(const lmb_planes *p, const lmb_cloud *cloud, int32_t x, int32_t y)
{
    const lmb_pinhole *c = &cloud->camera;
    const int32_t at = y * c->width + x;
    const lmb_vec3 ray = lmb_cloud_ray(c, (float)x, (float)y);
    uint8_t best = p->label[at];
    float min = plane_off(cloud, p->plane[best - 1].slope, cloud->inverse[at], ray);
    for (int32_t k = 0; k < 4; ++k) {
        const int32_t i = x + NEAR_PX * step_x[k], j = y + NEAR_PX * step_y[k];
        const uint8_t other = i < 0 || j < 0 || i >= c->width || j >= c->height ? 0 : p->label[j * c->width + i];
        if (other != 0 && other != best) {
            const float off = plane_off(cloud, p->plane[other - 1].slope, cloud->inverse[at], ray);
            best = off < min ? other : best;
            min = minf(off, min);
        }
    }
    return min <= BELONGS_OFF ? best : 0;
}

static void settle(lmb_planes *p, const lmb_cloud *cloud)
{
    const lmb_pinhole *c = &cloud->camera;
    for (int32_t y = 0; y < c->height; ++y) {
        for (int32_t x = 0; x < c->width; ++x) {
            const int32_t at = y * c->width + x;
            if (p->label[at] != 0 && cloud->inverse[at] > 0.0f) {
                p->label[at] = best_of_near(p, cloud, x, y);
            }
        }
    }
}

static int may_join(const lmb_planes *p, const lmb_cloud *cloud, int32_t at, uint8_t label)
{
    const lmb_pinhole *c = &cloud->camera;
    const lmb_flat *plane = &p->plane[label - 1];
    const lmb_vec3 n = cloud->normal[at], ray = lmb_cloud_ray(c, (float)(at % c->width), (float)(at / c->width));
    return cloud->inverse[at] > 0.0f && (dot3(n, n) == 0.0f || dot3(n, plane->normal) >= MIN_OWN_COSINE) &&
           plane_off(cloud, plane->slope, cloud->inverse[at], ray) <= BELONGS_OFF;
}

/* Assigns points at edges to adjacent planes: their normals are means of two surfaces. */
static void spread_planes(lmb_planes *p, const lmb_cloud *cloud)
{
    const int32_t w = cloud->camera.width, h = cloud->camera.height;
    int32_t count = 0;
    for (int32_t at = 0; at < w * h; ++at) {
        if (p->label[at] != 0) {
            p->queue[count++] = at;
        }
    }
    for (int32_t i = 0; i < count; ++i) {
        const int32_t at = p->queue[i];
        for (int32_t k = 0; k < 4; ++k) {
            const int32_t x = at % w + step_x[k], y = at / w + step_y[k], to = y * w + x;
            if (x >= 0 && y >= 0 && x < w && y < h && p->label[to] == 0 && may_join(p, cloud, to, p->label[at])) {
                p->label[to] = p->label[at];
                p->queue[count++] = to;
            }
        }
    }
}

/* --- holes -------------------------------------------------------------------------------------------------------- */

/* Connected pixels without a plane, all measured or all not; beside: neighbours in each plane. */
typedef struct gap {
    int32_t first, count;       /* range in the queue */
    int32_t beside[LMB_MAX_PLANES + 1];
    int measured;
} gap;

static void trace_hole(lmb_planes *p, const lmb_cloud *cloud, gap *hole)
{
    const int32_t w = cloud->camera.width, h = cloud->camera.height;
    for (int32_t i = 0; i < hole->count; ++i) {
        const int32_t at = p->queue[i];
        for (int32_t k = 0; k < 4; ++k) {
            const int32_t x = at % w + step_x[k], y = at / w + step_y[k], to = y * w + x;
            if (x < 0 || y < 0 || x >= w || y >= h || p->label[to] == LABEL_HOLE) {
                continue;
            }
            if (p->label[to] == 0 && (cloud->inverse[to] > 0.0f) == hole->measured) {
                p->label[to] = LABEL_HOLE;
                p->queue[hole->count++] = to;
            } else {
                ++hole->beside[p->label[to]];
            }
        }
    }
}

/* The plane around a hole, or 0. It must own nine in ten of the surrounding pixels, around specks more than half. */
static uint8_t pixels_around(const gap *hole)
{
    int32_t best = 0, all = hole->beside[0];
    for (int32_t i = 1; i <= LMB_MAX_PLANES; ++i) {
        all += hole->beside[i];
        best = hole->beside[i] > hole->beside[best] || best == 0 ? i : best;
    }
    const int speck = hole->count <= MAX_SPECK_PX;
    const int32_t max = hole->beside[best];
    return (speck ? 2 * max > all : !hole->measured && 10 * max >= 9 * all) ? (uint8_t)best : 0;
}

static void fill_holes(lmb_planes *p, const lmb_cloud *cloud)
{
    const int32_t pixels = cloud->camera.width * cloud->camera.height;
    for (int32_t at = 0; at < pixels; ++at) {
        if (p->label[at] == 0) {
            gap hole = {0, 1, {0}, cloud->inverse[at] > 0.0f};
            p->queue[0] = at;
            p->label[at] = LABEL_HOLE;
            trace_hole(p, cloud, &hole);
            const uint8_t label = pixels_around(&hole);
            for (int32_t i = 0; label != 0 && i < hole.count; ++i) {
                p->label[p->queue[i]] = label;
            }
        }
    }
    for (int32_t at = 0; at < pixels; ++at) {
        p->label[at] = p->label[at] == LABEL_HOLE ? 0 : p->label[at];
    }
}

void lmb_planes_outline(lmb_planes *planes, const lmb_cloud *cloud)
{
    settle(planes, cloud);
    spread_planes(planes, cloud);
    fill_holes(planes, cloud);
}

/* --- measures ----------------------------------------------------------------------------------------------------- */

void lmb_planes_farthest(float min[LMB_MAX_PLANES], const lmb_planes *planes, const lmb_cloud *cloud)
{
    const size_t pixels = (size_t)cloud->camera.width * (size_t)cloud->camera.height;
    for (int32_t i = 0; i < LMB_MAX_PLANES; ++i) {
        min[i] = 1e30f;
    }
    for (size_t at = 0; at < pixels; ++at) {
        if (planes->label[at] != 0 && cloud->inverse[at] > 0.0f) {
            float *of = &min[planes->label[at] - 1];
            *of = minf(*of, cloud->inverse[at]);
        }
    }
}

/* Sets `across` to the direction in the plane nearest to the camera's x. */
static void set_plane_axes(lmb_flat *p)
{
    const lmb_vec3 side = absf(p->normal.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 0, -1);
    p->across = normalize3(sub3(side, mul3(p->normal, dot3(side, p->normal))));
    p->along = cross3(p->normal, p->across);
}

/* Weighted sum of a plane's pixels. The weight is a pixel's area on the plane, up to a factor common to the plane:
 * proportional to the cube of the distance (z^2 of the pixel, and z for the slant n . ray = -distance / z). */
typedef struct middle {
    float x, y, z, weight;
} middle;

static void add_middle(middle *m, lmb_vec3 p, float weight)
{
    m->x += p.x * weight;
    m->y += p.y * weight;
    m->z += p.z * weight;
    m->weight += weight;
}

/* Intersects a pixel's ray with a plane. Holes towards the horizon are clamped to the farthest measured point: `min`,
 * an inverse distance. Returns the inverse distance of the intersection. */
static float meet(lmb_vec3 *out, const lmb_flat *p, const lmb_pinhole *c, int32_t x, int32_t y, float min)
{
    const lmb_vec3 ray = lmb_cloud_ray(c, (float)x, (float)y);
    const float q = maxf(plane_inverse(p->slope, ray.x, ray.y), min);
    *out = mul3(ray, q > 1e-3f ? 1.0f / q : 0.0f);
    return q;
}

static void find_centre(lmb_flat *p, const lmb_planes *planes, const lmb_pinhole *c, int32_t label, float min)
{
    middle all = {0, 0, 0, 0};
    for (int32_t y = p->y0; y < p->y1; ++y) {
        middle row = {0, 0, 0, 0};
        for (int32_t x = p->x0; x < p->x1; ++x) {
            if (planes->label[y * c->width + x] == label) {
                lmb_vec3 at;
                const float q = meet(&at, p, c, x, y, min);
                add_middle(&row, at, q > 1e-3f ? 1.0f / (q * q * q) : 0.0f);
            }
        }
        add_middle(&all, vec3(row.x, row.y, row.z), 1.0f);
        all.weight += row.weight - 1.0f;
    }
    p->centre = all.weight > 0.0f ? mul3(vec3(all.x, all.y, all.z), 1.0f / all.weight) : vec3(0, 0, -1);
}

static void find_extent(lmb_flat *p, const lmb_planes *planes, const lmb_pinhole *c, int32_t label, float min)
{
    p->low[0] = p->low[1] = p->high[0] = p->high[1] = 0.0f;
    for (int32_t y = p->y0; y < p->y1; ++y) {
        for (int32_t x = p->x0; x < p->x1; ++x) {
            lmb_vec3 at;
            if (planes->label[y * c->width + x] == label && meet(&at, p, c, x, y, min) > 1e-3f) {
                const lmb_vec3 d = sub3(at, p->centre);
                const float u = dot3(d, p->across), v = dot3(d, p->along);
                p->low[0] = minf(p->low[0], u);
                p->low[1] = minf(p->low[1], v);
                p->high[0] = maxf(p->high[0], u);
                p->high[1] = maxf(p->high[1], v);
            }
        }
    }
}

void lmb_planes_boxes(lmb_planes *planes, const lmb_pinhole *c)
{
    for (int32_t i = 0; i < planes->count; ++i) {
        lmb_flat *p = &planes->plane[i];
        p->pixels = p->x1 = p->y1 = 0;
        p->x0 = c->width;
        p->y0 = c->height;
    }
    for (int32_t y = 0; y < c->height; ++y) {
        for (int32_t x = 0; x < c->width; ++x) {
            const uint8_t label = planes->label[y * c->width + x];
            if (label != 0) {
                lmb_flat *p = &planes->plane[label - 1];
                p->x0 = mini(p->x0, x);
                p->y0 = mini(p->y0, y);
                p->x1 = maxi(p->x1, x + 1);
                p->y1 = maxi(p->y1, y + 1);
                ++p->pixels;
            }
        }
    }
}

void lmb_planes_centres(float min[LMB_MAX_PLANES], lmb_planes *planes, const lmb_cloud *cloud)
{
    lmb_planes_farthest(min, planes, cloud);
    for (int32_t i = 0; i < planes->count; ++i) {
        lmb_flat *p = &planes->plane[i];
        min[i] = min[i] < 1e30f ? (1.0f - PLANE_MOVES) * min[i] : 0.0f;
        find_centre(p, planes, &cloud->camera, i + 1, min[i]);
    }
}

void lmb_planes_measure(lmb_planes *planes, const lmb_cloud *cloud)
{
    float min[LMB_MAX_PLANES];
    lmb_planes_boxes(planes, &cloud->camera);
    lmb_planes_centres(min, planes, cloud);
    for (int32_t i = 0; i < planes->count; ++i) {
        lmb_flat *p = &planes->plane[i];
        p->normal = lmb_plane_normal(&p->distance, p->slope);
        set_plane_axes(p);
        find_extent(p, planes, &cloud->camera, i + 1, min[i]);
    }
}

#endif
