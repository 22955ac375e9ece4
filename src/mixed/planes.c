/* planes.c: planes in a cloud: grown from seeds with parallel neighbours, fitted, joined. Layer 6.        [M3 M4] */
#include "cloud.h"
#include "planes.h"

#include <string.h>

#include "../base/memory_check.h"

#if LMB_MIXED

#define MIN_SEED_COSINE 0.9781476f /* cosine of 12 degrees, max angle between a seed's normal and its neighbours' */
#define GROWS_OVER 0.9063078f /* of 25 degrees, max error of a point's normal from noise */
#define ONE_PLANE 0.9975641f  /* of 4 degrees, max angle between planes that may be joined */
#define REACH_OFF 4.5f        /* standard deviations between adjacent pixels; sensors err by more over more pixels */
#define JOIN_OFF 7.0f
#define APART_OFF 3.5f
#define FIT_OFF 4.0f

enum { SEED_STEP = 6, SEED_NEAREST = 8, FIRST_FIT = 48, /* px, points, points */
       TOUCH_PX = 6, TOUCH_PAIRS = 24 };

size_t lmb_planes_bytes(int32_t width, int32_t height)
{
    return lmb_cloud_bytes(width, height) / sizeof(float) / 4 * (sizeof(int32_t) + 1);
}

/* --- growing ------------------------------------------------------------------------------------------------------ */

typedef struct grower {
    lmb_planes *planes;
    const lmb_cloud *cloud;
    plane_fit sums;
    float slope[3];
    lmb_vec3 normal;
    int32_t count; /* pixels in the queue: the whole region */
    uint8_t label;
} grower;

static int is_label_free(uint8_t label) { return label == 0 || label == LABEL_TRIED; }

/* Do a point's nearest neighbours have about the same normal? */
static int is_seed(const lmb_cloud *cloud, int32_t x, int32_t y)
{
    int32_t near[SEED_NEAREST];
    const lmb_vec3 n = cloud->normal[(size_t)y * (size_t)cloud->camera.width + (size_t)x];
    const int32_t count = lmb_cloud_nearest(near, SEED_NEAREST, cloud, x, y);
    if (count < SEED_NEAREST / 2 || dot3(n, n) == 0.0f) {
        return 0;
    }
    for (int32_t i = 0; i < count; ++i) {
        if (dot3(cloud->normal[near[i]], n) < MIN_SEED_COSINE) {
            return 0;
        }
    }
    return 1;
}

static void add_pixel(grower *g, int32_t at, lmb_vec3 ray)
{
    const float q = g->cloud->inverse[at], sigma = lmb_cloud_sigma(g->cloud, q);
    plane_fit_add(&g->sums, ray.x, ray.y, q, g->cloud->noise * g->cloud->noise / (sigma * sigma));
    g->planes->label[at] = g->label;
    g->planes->queue[g->count++] = at;
}

static void test_pixel(grower *g, int32_t x, int32_t y)
{
    const lmb_pinhole *c = &g->cloud->camera;
    if (x < 0 || y < 0 || x >= c->width || y >= c->height) {
        return;
    }
    const int32_t at = y * c->width + x;
    const lmb_vec3 ray = lmb_cloud_ray(c, (float)x, (float)y);
    if (is_label_free(g->planes->label[at]) && g->cloud->inverse[at] > 0.0f &&
        dot3(g->cloud->normal[at], g->normal) >= GROWS_OVER &&
        plane_off(g->cloud, g->slope, g->cloud->inverse[at], ray) <= REACH_OFF) {
        add_pixel(g, at, ray);
    }
}

/* Starts with the plane through one point. */
static void begin_plane(grower *g, int32_t x, int32_t y)
{
    const int32_t at = y * g->cloud->camera.width + x;
    const lmb_vec3 ray = lmb_cloud_ray(&g->cloud->camera, (float)x, (float)y), n = g->cloud->normal[at];
    const float scale = g->cloud->inverse[at] / dot3(n, ray);
    g->normal = n;
    g->slope[0] = n.x * scale;
    g->slope[1] = n.y * scale;
    g->slope[2] = -n.z * scale;
    g->sums = plane_fit_at(ray.x, ray.y, g->cloud->inverse[at]);
    g->count = 0;
    add_pixel(g, at, ray);
}

/* Grows the region from the first pixel. The plane is refitted each time the region has doubled. */
static void grow_plane(grower *g, int32_t x, int32_t y)
{
    int32_t next_fit = FIRST_FIT;
    float distance;
    begin_plane(g, x, y);
    for (int32_t i = 0; i < g->count; ++i) {
        const int32_t at = g->planes->queue[i], px = at % g->cloud->camera.width, py = at / g->cloud->camera.width;
        test_pixel(g, px - 1, py);
        test_pixel(g, px + 1, py);
        test_pixel(g, px, py - 1);
        test_pixel(g, px, py + 1);
        if (g->count >= next_fit) {
            if (lmb_plane_fit_solve(g->slope, &g->sums)) {
                g->normal = lmb_plane_normal(&distance, g->slope);
            }
            next_fit = 2 * g->count;
        }
    }
    (void)lmb_plane_fit_solve(g->slope, &g->sums);
}

static void relabel(lmb_planes *planes, const lmb_cloud *cloud, uint8_t from, uint8_t to)
{
    const size_t pixels = (size_t)cloud->camera.width * (size_t)cloud->camera.height;
    for (size_t i = 0; i < pixels; ++i) {
        planes->label[i] = planes->label[i] == from ? to : planes->label[i];
    }
}

/* Makes a plane of a region that is large enough. If the array is full, the plane replaces the smallest. */
static void keep_plane(grower *g, int32_t min)
{
    lmb_planes *p = g->planes;
    int32_t at = p->count;
    for (int32_t i = 0; p->count == LMB_MAX_PLANES && i < LMB_MAX_PLANES; ++i) {
        at = at == LMB_MAX_PLANES || p->plane[i].pixels < p->plane[at].pixels ? i : at;
    }
    const int fits = g->count >= min && (at == p->count || p->plane[at].pixels < g->count);
    if (fits && at < p->count) {
        relabel(p, g->cloud, (uint8_t)(at + 1), LABEL_TRIED);
    }
    for (int32_t i = 0; i < g->count; ++i) {
        p->label[p->queue[i]] = fits ? (uint8_t)(at + 1) : LABEL_TRIED;
    }
    if (fits) {
        p->plane[at].pixels = g->count;
        memcpy(p->plane[at].slope, g->slope, sizeof g->slope);
        p->count += at == p->count;
    }
}

static void grow_all(lmb_planes *planes, const lmb_cloud *cloud, int32_t min)
{
    grower g;
    memset(&g, 0, sizeof g);
    g.planes = planes;
    g.cloud = cloud;
    g.label = LABEL_HOLE;
    for (int32_t y = SEED_STEP / 2; y < cloud->camera.height; y += SEED_STEP) {
        for (int32_t x = SEED_STEP / 2; x < cloud->camera.width; x += SEED_STEP) {
            if (planes->label[y * cloud->camera.width + x] == 0 && is_seed(cloud, x, y)) {
                grow_plane(&g, x, y);
                keep_plane(&g, min);
            }
        }
    }
    relabel(planes, cloud, LABEL_TRIED, 0);
}

/* --- fitting and joining ------------------------------------------------------------------------------------------ */

static void add_near_pixel(plane_fit *sums, const lmb_flat *p, const lmb_cloud *cloud, int32_t x, int32_t y, float off)
{
    const float q = cloud->inverse[y * cloud->camera.width + x];
    const lmb_vec3 ray = lmb_cloud_ray(&cloud->camera, (float)x, (float)y);
    if (plane_off(cloud, p->slope, q, ray) <= off) {
        const float sigma = lmb_cloud_sigma(cloud, q);
        plane_fit_add(sums, ray.x, ray.y, q, cloud->noise * cloud->noise / (sigma * sigma));
    }
}

/* Fits a plane's pixels that lie within `off` deviations. Returns 0 if they give no plane. Sums rows separately, so
 * that at most 8192 terms are added to one float. */
static int fit_plane(float slope[3], const lmb_planes *planes, const lmb_cloud *cloud, int32_t label, float off)
{
    const lmb_flat *p = &planes->plane[label - 1];
    const lmb_pinhole *c = &cloud->camera;
    const lmb_vec3 middle = lmb_cloud_ray(c, 0.5f * (float)(p->x0 + p->x1), 0.5f * (float)(p->y0 + p->y1));
    plane_fit all = plane_fit_at(middle.x, middle.y, plane_inverse(p->slope, middle.x, middle.y));
    for (int32_t y = p->y0; y < p->y1; ++y) {
        plane_fit row = plane_fit_at(all.x0, all.y0, all.q0);
        for (int32_t x = p->x0; x < p->x1; ++x) {
            const int32_t at = y * c->width + x;
            if (planes->label[at] == label && cloud->inverse[at] > 0.0f) {
                add_near_pixel(&row, p, cloud, x, y, off);
            }
        }
        lmb_plane_fit_join(&all, &row);
    }
    return lmb_plane_fit_solve(slope, &all);
}

static void fit_all(lmb_planes *planes, const lmb_cloud *cloud)
{
    lmb_planes_boxes(planes, &cloud->camera);
    for (int32_t i = 0; i < planes->count; ++i) {
        lmb_flat *p = &planes->plane[i];
        float slope[3];
        if (fit_plane(slope, planes, cloud, i + 1, FIT_OFF)) {
            memcpy(p->slope, slope, sizeof slope);
        }
        p->normal = lmb_plane_normal(&p->distance, p->slope);
    }
}

/* Number of close pixel pairs that lie on planes i and k, i < k; saturates at 255. */
typedef struct touching {
    uint8_t pairs[LMB_MAX_PLANES][LMB_MAX_PLANES];
} touching;

static void add_pair(touching *t, uint8_t a, uint8_t b)
{
    if (a != 0 && b != 0 && a != b) {
        uint8_t *pairs = &t->pairs[mini(a, b) - 1][maxi(a, b) - 1];
        *pairs = (uint8_t)mini(*pairs + 1, 255);
    }
}

static void find_touching(touching *t, const lmb_planes *planes, const lmb_pinhole *c)
{
    memset(t, 0, sizeof *t);
    for (int32_t y = 0; y < c->height; ++y) {
        const uint8_t *row = planes->label + (size_t)y * (size_t)c->width;
        for (int32_t x = 0; x < c->width; ++x) {
            add_pair(t, row[x], x + TOUCH_PX < c->width ? row[x + TOUCH_PX] : 0);
            add_pair(t, row[x], y + TOUCH_PX < c->height ? row[x + TOUCH_PX * c->width] : 0);
        }
    }
}

/* Are both planes parts of one surface? They have similar normals, and each lies on the other's continuation. The limit
 * `off` is smaller if they do not touch: then they are parts of a surface behind another object, otherwise a surface
 * bent by the sensor. */
static int are_one(const lmb_cloud *cloud, const lmb_flat *a, const lmb_flat *b, float off)
{
    const lmb_vec3 at = mul3(b->centre, -1.0f / b->centre.z);
    const float q = -1.0f / b->centre.z;
    return dot3(a->normal, b->normal) >= ONE_PLANE && plane_off(cloud, a->slope, q, at) <= off;
}

static void remove_plane(lmb_planes *planes, const lmb_cloud *cloud, int32_t i, uint8_t into)
{
    relabel(planes, cloud, (uint8_t)(i + 1), into);
    for (--planes->count; i < planes->count; ++i) {
        planes->plane[i] = planes->plane[i + 1];
        relabel(planes, cloud, (uint8_t)(i + 2), (uint8_t)(i + 1));
    }
}

/* Joins the first two planes that are parts of one surface. */
static int join_two(lmb_planes *planes, const lmb_cloud *cloud)
{
    touching t;
    float min[LMB_MAX_PLANES];
    lmb_planes_centres(min, planes, cloud);
    find_touching(&t, planes, &cloud->camera);
    for (int32_t i = 0; i < planes->count; ++i) {
        for (int32_t k = i + 1; k < planes->count; ++k) {
            const float off = t.pairs[i][k] >= TOUCH_PAIRS ? JOIN_OFF : APART_OFF;
            if (are_one(cloud, &planes->plane[i], &planes->plane[k], off) &&
                are_one(cloud, &planes->plane[k], &planes->plane[i], off)) {
                remove_plane(planes, cloud, k, (uint8_t)(i + 1));
                return 1;
            }
        }
    }
    return 0;
}

static void drop_small(lmb_planes *planes, const lmb_cloud *cloud, int32_t min)
{
    for (int32_t i = planes->count - 1; i >= 0; --i) {
        if (planes->plane[i].pixels < min) {
            remove_plane(planes, cloud, i, 0);
        }
    }
}

/* Sorts planes and labels by size, the largest first; ties keep the order of discovery. */
static void sort_planes(lmb_planes *planes, const lmb_cloud *cloud)
{
    for (int32_t i = 0; i < planes->count; ++i) {
        int32_t best = i;
        for (int32_t k = i + 1; k < planes->count; ++k) {
            best = planes->plane[k].pixels > planes->plane[best].pixels ? k : best;
        }
        if (best != i) {
            const lmb_flat swap = planes->plane[i];
            planes->plane[i] = planes->plane[best];
            planes->plane[best] = swap;
            relabel(planes, cloud, (uint8_t)(i + 1), LABEL_TRIED);
            relabel(planes, cloud, (uint8_t)(best + 1), (uint8_t)(i + 1));
            relabel(planes, cloud, LABEL_TRIED, (uint8_t)(best + 1));
        }
    }
}

/* --- the whole ---------------------------------------------------------------------------------------------------- */

lmb_status lmb_planes_find(lmb_planes *out, const lmb_cloud *cloud, void *memory, size_t bytes)
{
    if (out == NULL || cloud == NULL || cloud->inverse == NULL) {
        return LMB_ERR_ARG;
    }
    const int32_t w = cloud->camera.width, h = cloud->camera.height;
    const int32_t min = maxi(w * h / 256, 32);
    const lmb_status status = check_memory(memory, bytes, lmb_planes_bytes(w, h));
    if (status != LMB_OK) {
        return status;
    }
    memset(out, 0, sizeof *out);
    out->queue = (int32_t *)memory;
    out->label = (uint8_t *)(out->queue + (size_t)w * (size_t)h);
    memset(out->label, 0, (size_t)w * (size_t)h);
    grow_all(out, cloud, min);
    fit_all(out, cloud);
    while (join_two(out, cloud)) {
        fit_all(out, cloud);
    }
    lmb_planes_outline(out, cloud);
    fit_all(out, cloud);
    lmb_planes_measure(out, cloud);
    drop_small(out, cloud, min);
    sort_planes(out, cloud);
    return LMB_OK;
}

/* New inverse distance of a pixel: that of the plane, but near the measured one, `inverse`. In holes (`inverse` 0) the
 * plane counts as no farther than `min`, because towards the horizon the distance is unbounded. */
static float moved_to(float plane, float inverse, float min)
{
    return inverse > 0.0f ? clampf(plane, inverse * (1.0f - PLANE_MOVES), inverse * (1.0f + PLANE_MOVES))
                          : maxf(plane, min);
}

void lmb_planes_move(const lmb_cloud *cloud, const lmb_planes *planes)
{
    if (!are_labels(planes, cloud)) {
        return;
    }
    const lmb_pinhole *c = &cloud->camera;
    float min[LMB_MAX_PLANES];
    lmb_planes_farthest(min, planes, cloud);
    for (int32_t y = 0; y < c->height; ++y) {
        for (int32_t x = 0; x < c->width; ++x) {
            const size_t at = (size_t)y * (size_t)c->width + (size_t)x;
            if (planes->label[at] != 0) {
                const lmb_flat *p = &planes->plane[planes->label[at] - 1];
                const lmb_vec3 ray = lmb_cloud_ray(c, (float)x, (float)y);
                cloud->inverse[at] = moved_to(plane_inverse(p->slope, ray.x, ray.y), cloud->inverse[at],
                                              min[planes->label[at] - 1]);
                cloud->normal[at] = p->normal;
            }
        }
    }
}

#endif
