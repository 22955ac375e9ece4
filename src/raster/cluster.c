/* cluster.c: boxes around runs of a mesh's triangles, and whether a window shows any of one. Layer 3.
 *
 * A corner goes from model space to the window by sums, products and quotients that each round monotonically. So the
 * same operations on the ends of intervals bound the results for every corner in the box, without a margin. A cluster
 * that is partly clipped is never hidden, because cut corners come from other operations. */
#include "cluster.h"

#if LMB_CULLING
#include "../base/vec.h"
#include "../base/vertex.h"

/* Kernels read as many bounds as they have lanes, also past the last tile. */
enum { SPARE_BOUNDS = 15 };

uint32_t lmb_culling_tiles(const lmb_target *target)
{
    if (target == NULL || target->depth.width <= 0 || target->depth.height <= 0 ||
        target->depth.width > LMB_MAX_SIDE || target->depth.height > LMB_MAX_SIDE) {
        return 0;
    }
    return (uint32_t)((target->depth.width + LMB_TILE - 1) / LMB_TILE) *
               (uint32_t)((target->depth.height + LMB_TILE - 1) / LMB_TILE) +
           SPARE_BOUNDS;
}

static uint32_t mesh_clusters(const lmb_mesh *mesh)
{
    return mesh->triangle_count / LMB_CLUSTER + (mesh->triangle_count % LMB_CLUSTER != 0);
}

uint32_t lmb_culling_clusters(const lmb_scene *scene)
{
    uint32_t n = 0;
    for (uint32_t m = 0; scene != NULL && m < scene->mesh_count; ++m) {
        n += mesh_clusters(&scene->meshes[m]);
    }
    return n;
}

const lmb_cluster *lmb_cluster_find(lmb_cluster_place *place, const lmb_culling *culling, const lmb_scene *scene,
                                    uint32_t mesh)
{
    if (place->clusters == NULL || place->mesh > mesh) {
        place->clusters = culling->clusters;
        place->mesh = 0;
    }
    for (; place->mesh < mesh; ++place->mesh) {
        place->clusters += mesh_clusters(&scene->meshes[place->mesh]);
    }
    return place->clusters;
}

/* Box of triangles first .. past - 1. If drawing would drop one of them, the box is so large that it is never skipped:
 * such triangles are counted. */
static lmb_cluster cluster_of(const lmb_mesh *mesh, uint32_t first, uint32_t past)
{
    const lmb_cluster unbounded = {{-3e38f, -3e38f, -3e38f}, {3e38f, 3e38f, 3e38f}};
    lmb_cluster c = {{3e38f, 3e38f, 3e38f}, {-3e38f, -3e38f, -3e38f}};
    for (uint32_t i = 3 * first; i < 3 * past; ++i) {
        const uint32_t vertex = mesh_index(mesh, i);
        if (vertex >= mesh->vertex_count) {
            return unbounded;
        }
        const lmb_vec3 p = mesh_position(mesh, vertex);
        if (!is_sane(p.x) || !is_sane(p.y) || !is_sane(p.z)) {
            return unbounded;
        }
        c.low = min3(c.low, p);
        c.high = max3(c.high, p);
    }
    return c;
}

lmb_status lmb_clusters_build(lmb_cluster *out, uint32_t count, const lmb_scene *scene)
{
    if (out == NULL || scene == NULL) {
        return LMB_ERR_ARG;
    }
    if (count < lmb_culling_clusters(scene)) {
        return LMB_ERR_CAPACITY;
    }
    for (uint32_t m = 0; m < scene->mesh_count; ++m) {
        const lmb_mesh *mesh = &scene->meshes[m];
        for (uint32_t first = 0; first < mesh->triangle_count; first += LMB_CLUSTER) {
            const uint32_t left = mesh->triangle_count - first;
            *out++ = cluster_of(mesh, first, first + (left < LMB_CLUSTER ? left : LMB_CLUSTER));
        }
    }
    return LMB_OK;
}

typedef struct interval {
    float low, high;
} interval;

static interval interval_times(float factor, float low, float high)
{
    const float a = factor * low, b = factor * high;
    const interval r = {minf(a, b), maxf(a, b)};
    return r;
}

static interval interval_add(interval a, interval b)
{
    const interval r = {a.low + b.low, a.high + b.high};
    return r;
}

/* A row of the instance over the box, with the order of sums of setup.inl. */
static interval row_over(const float row[4], const lmb_cluster *c)
{
    const interval x = interval_times(row[0], c->low.x, c->high.x), y = interval_times(row[1], c->low.y, c->high.y),
                   z = interval_times(row[2], c->low.z, c->high.z), last = {row[3], row[3]};
    return interval_add(interval_add(interval_add(x, y), z), last);
}

static int interval_is_sane(interval a) { return a.low > -1048576.0f && a.high < 1048576.0f; }

/* Corners before the division, as in setup_point. */
typedef struct cluster_points {
    interval x, y, z, w;
} cluster_points;

/* Returns 0 if a corner may be absurd. */
static int cluster_project(cluster_points *out, const lmb_cluster *c, const lmb_setup_job *job)
{
    const interval x = row_over(job->row[0], c), y = row_over(job->row[1], c), along = row_over(job->row[2], c);
    out->x = interval_times(job->scale_x, x.low, x.high);
    out->y = interval_times(job->scale_y, y.low, y.high);
    out->w = along;
    out->z.low = out->z.high = job->near_m;
    if (job->orthographic) {
        out->z.low = (job->far_m - along.high) * job->depth_scale;
        out->z.high = (job->far_m - along.low) * job->depth_scale;
        out->w.low = out->w.high = 1.0f;
    }
    return interval_is_sane(x) && interval_is_sane(y) && interval_is_sane(along);
}

/* 1 if all of it is outside one plane. */
static int cluster_is_outside(const cluster_points *p, const lmb_setup_job *job)
{
    const float wide = job->guard_x * p->w.high, high = job->guard_y * p->w.high;
    return p->w.high - p->z.low < 0.0f || wide + p->x.high < 0.0f || wide - p->x.low < 0.0f ||
           high - p->y.low < 0.0f || high + p->y.high < 0.0f;
}

/* 1 if all of it is inside all planes. */
static int cluster_is_inside(const cluster_points *p, const lmb_setup_job *job)
{
    const float wide = job->guard_x * p->w.low, high = job->guard_y * p->w.low;
    return p->w.low > 0.0f && p->w.low - p->z.high >= 0.0f && wide + p->x.low >= 0.0f && wide - p->x.high >= 0.0f &&
           high - p->y.high >= 0.0f && high + p->y.low >= 0.0f;
}

static interval interval_product(interval a, interval positive)
{
    const interval r = {a.low * (a.low < 0.0f ? positive.high : positive.low),
                        a.high * (a.high < 0.0f ? positive.low : positive.high)};
    return r;
}

/* First and last tile of the window with a pixel centre between two 24.8 positions. Returns 0 if there is none. */
static int cluster_tiles(int32_t *first, int32_t *last, float low, float high, int32_t origin, int32_t window,
                         int32_t tiles)
{
    const int32_t first_px = (((int32_t)floorf(low) + 255 - origin) >> 8) - window,
                  last_px = (((int32_t)floorf(high) - origin) >> 8) - window;
    *first = maxi(first_px, 0) / LMB_TILE;
    *last = mini(last_px, tiles * LMB_TILE - 1) / LMB_TILE;
    return first_px <= last_px && last_px >= 0 && first_px < tiles * LMB_TILE;
}

float lmb_depth_as_held(const lmb_fill_window *w, float d)
{
    if (w->first.depth_format == LMB_DEPTH32F) {
        return d;
    }
    return floorf(maxf(minf(d * w->d_scale + w->d_bias, 65535.0f), 0.0f));
}

int lmb_cluster_is_hidden(const lmb_cluster *c, const lmb_setup_job *job, const lmb_fill_window *w,
                          const lmb_kernels *kernels)
{
    lmb_tile_box box;
    cluster_points p;
    if (!cluster_project(&p, c, job)) {
        return LMB_CLUSTER_SHOWN;
    }
    if (cluster_is_outside(&p, job)) {
        return LMB_CLUSTER_OUTSIDE;
    }
    if (!cluster_is_inside(&p, job)) {
        return LMB_CLUSTER_SHOWN;
    }
    const interval inverse = {1.0f / p.w.high, 1.0f / p.w.low};
    const interval x = interval_product(p.x, inverse), y = interval_product(p.y, inverse);
    if (!cluster_tiles(&box.x0, &box.x1, x.low * job->snap_x + 0.5f, x.high * job->snap_x + 0.5f, w->origin_x, w->x0,
                       w->tiles_x) ||
        !cluster_tiles(&box.y0, &box.y1, 0.5f - y.high * job->snap_y, 0.5f - y.low * job->snap_y, w->origin_y, w->y0,
                       w->tiles_y)) {
        return LMB_CLUSTER_OUTSIDE;
    }
    if (w->farthest == NULL) {
        return LMB_CLUSTER_SHOWN;
    }
    return kernels->culled_box(w, &box, lmb_depth_as_held(w, interval_product(p.z, inverse).high)) ? LMB_CLUSTER_HIDDEN
                                                                                              : LMB_CLUSTER_SHOWN;
}
#endif
