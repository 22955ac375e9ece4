/* draw.c: a range of the scene's triangles into a window. Layer 3.
 *
 * Batches of LMB_BATCH triangles are transformed and set up side by side (setup.inl); small ones are filled in runs
 * (fill_small.inl). Triangles that are clipped, large or have holes go one by one through draw_one.c, in order. Corners
 * are transformed again for each triangle: if eight are transformed at a time, a cache costs as much as it saves
 * (bunny, AVX2: 4.2 ms with a cache, 4.4 without), and takes memory. Backends with one lane have a small cache. */
#include <lambent/raster.h>

#include <string.h>

#include "draw_one.h"
#include "target.h"
#include "triangle.h"

#define GUARD_PX 16383.0f /* from the frame's centre; one px of rounding below the limit of setup.c */

static void set_clip_row(float row[4], lmb_vec3 axis, float sign, const lmb_mat4 *t, lmb_vec3 eye)
{
    const float *m = t->m;
    lmb_vec3 a = mul3(axis, sign);
    for (int c = 0; c < 3; ++c) {
        row[c] = dot3(a, vec3(m[4 * c], m[4 * c + 1], m[4 * c + 2]));
    }
    /* Subtract before rotating: a world far from its origin keeps millimetre precision. */
    row[3] = dot3(a, sub3(vec3(m[12], m[13], m[14]), eye));
}

static void set_setup_job(lmb_setup_job *job, const lmb_target *target, const lmb_view *view, const lmb_mat4 *to_world)
{
    set_clip_row(job->row[0], view->right, 1.0f, to_world, view->eye);
    set_clip_row(job->row[1], view->up, 1.0f, to_world, view->eye);
    set_clip_row(job->row[2], view->back, -1.0f, to_world, view->eye);
    job->scale_x = 1.0f / view->half_width;
    job->scale_y = 1.0f / view->half_height;
    job->guard_x = GUARD_PX * 2.0f / (float)view->frame_width;
    job->guard_y = GUARD_PX * 2.0f / (float)view->frame_height;
    job->snap_x = (float)(view->frame_width * 128);
    job->snap_y = (float)(view->frame_height * 128);
    job->orthographic = view->kind == LMB_ORTHOGRAPHIC;
    job->near_m = view->near_m;
    job->far_m = view->far_m;
    job->depth_scale = job->orthographic ? 1.0f / (view->far_m - view->near_m) : 0.0f;
    job_window(job, view, target);
}

void lmb_draw_instance_set(lmb_draw_instance *d, const lmb_fill_context *c, const lmb_instance *instance,
                           uint32_t flags)
{
    const lmb_material *material = &c->scene->materials[instance->material];
    set_setup_job(&d->job, c->target, c->view, &instance->to_world);
    d->guard.x = d->job.guard_x;
    d->guard.y = d->job.guard_y;
    d->mirrored = is_mirrored(&instance->to_world) != 0;
    d->cull = (flags & LMB_CULL_BACK) != 0 && (material->flags & LMB_DOUBLE_SIDED) == 0;
    d->job.cull = d->cull ? (d->mirrored ? -1 : 1) : 0;
    d->masked = (material->flags & LMB_ALPHA_MASK) != 0;
    d->blends = LMB_MULTISAMPLE && (flags & LMB_BLEND) != 0 && (material->flags & LMB_ALPHA_BLEND) != 0;
    d->mesh = &c->scene->meshes[instance->mesh];
    d->first_id = instance->first_id;
}

/* Draws in order: runs of small triangles with the kernels, the others one by one between them. */
static void draw_batch(const lmb_fill_context *c, const lmb_draw_instance *d, lmb_batch *batch, uint32_t count,
                       uint32_t id, lmb_stats *stats)
{
    const lmb_batch_sets *sets = &batch->sets;
    uint32_t all = (1u << count) - 1, other, done = 0;
    c->kernels->setup(batch, &d->job, d->mesh, id - d->first_id, count);
    other = sets->other | (d->masked ? sets->small : 0);
    for (uint32_t k = 0; k < LMB_BATCH; ++k) {
        batch->id[k] = id + k;
    }
    uint32_t drawn = count_bits_16(d->masked ? sets->drawn & ~sets->small : sets->drawn);
    for (uint32_t k = 0; other >> k != 0; ++k) {
        if ((other >> k) & 1u) {
            fill_batch(c, batch, sets->small & ~other & ((1u << k) - 1) & ~done);
            done = (1u << k) - 1;
            drawn += (uint32_t)lmb_draw_one(c, d, id + k);
        }
    }
    fill_batch(c, batch, sets->small & ~other & ~done);
    if (stats != NULL) {
        stats->triangles += count;
        stats->triangles_dropped += count_bits_16((all & ~sets->in) | sets->dropped);
        stats->triangles_drawn += drawn;
    }
}

/* Triangles first .. past - 1 of an instance. */
static void draw_triangles(const lmb_fill_context *c, const lmb_draw_instance *d, lmb_batch *batch, uint32_t first,
                           uint32_t past, lmb_stats *stats)
{
    while (first < past) {
        uint32_t count = past - first < LMB_BATCH ? past - first : LMB_BATCH;
        draw_batch(c, d, batch, count, first, stats);
        first += count;
    }
}

#if LMB_CULLING
enum { CLUSTERS_ASK = 16 };

/* If nothing is hidden, reading bounds takes small triangles longer than drawing does, so only some clusters after an
 * entirely hidden one read them. Raising bounds takes even longer: one cluster in four does. */
static int32_t cluster_bounds(lmb_cluster_place *place)
{
    if (place->asks == 0) {
        return LMB_BOUNDS_IDLE;
    }
    --place->asks;
    return place->asked++ % 4 == 0 ? LMB_BOUNDS_RAISED : LMB_BOUNDS_READ;
}

/* The same, but skips clusters that do not show in the window. */
static void draw_clusters(lmb_fill_context *c, const lmb_draw_instance *d, lmb_batch *batch,
                          const lmb_cluster *clusters, uint32_t first, uint32_t past, lmb_stats *stats)
{
    while (first < past) {
        const uint32_t cluster = (first - d->first_id) / LMB_CLUSTER, left = past - first;
        const uint32_t rest = LMB_CLUSTER - (first - d->first_id) % LMB_CLUSTER, count = left < rest ? left : rest;
        const int hidden = lmb_cluster_is_hidden(&clusters[cluster], &d->job, &c->window, c->kernels);
        if (hidden == LMB_CLUSTER_SHOWN) {
            c->window.bounds = cluster_bounds(&c->place);
            draw_triangles(c, d, batch, first, first + count, stats);
        } else if (stats != NULL) {
            stats->triangles += count;
        }
        c->place.asks = hidden == LMB_CLUSTER_HIDDEN ? CLUSTERS_ASK : c->place.asks;
        first += count;
    }
}
#endif

#if LMB_TREES
enum { MIN_AHEAD = 64, EACH_AHEAD = 29 };

/* Draws the depths of every 29th large triangle with holes first, slightly farther away. Most pixels behind these
 * triangles then fail the depth test, in any order of the triangles, and need no test of alpha. The main draw must
 * cover the same triangles, because these depths may not remain. Both therefore drop triangles by kernels->setup. */
static void draw_ahead(lmb_fill_context *c, const lmb_draw_instance *d, lmb_batch *batch, uint32_t first,
                       uint32_t past)
{
    c->is_ahead = 1;
    for (uint32_t id = first; past - first >= MIN_AHEAD && id < past && past - id > EACH_AHEAD; id += EACH_AHEAD) {
        c->kernels->setup(batch, &d->job, d->mesh, id - d->first_id, 1);
        if (((batch->sets.other | batch->sets.small) & 1u) != 0) {
            (void)lmb_draw_one(c, d, id);
        }
    }
    c->is_ahead = 0;
}
#endif

static void draw_instance_range(lmb_fill_context *c, lmb_batch *batch, const lmb_instance *instance, uint32_t first,
                                uint32_t past, uint32_t flags, lmb_stats *stats)
{
    lmb_draw_instance d;
    lmb_draw_instance_set(&d, c, instance, flags);
#if LMB_PLAIN_LANES == 1
    memset(batch->sets.kept, 0, sizeof batch->sets.kept);
#endif
#if LMB_CULLING
    if (c->culling != NULL && c->culling->clusters != NULL) {
        draw_clusters(c, &d, batch, lmb_cluster_find(&c->place, c->culling, c->scene, instance->mesh), first, past,
                      stats);
        return;
    }
#endif
#if LMB_TREES
    if (d.masked) {
        draw_ahead(c, &d, batch, first, past);
    }
#endif
    draw_triangles(c, &d, batch, first, past, stats);
}

/* Sets the context except for culling. */
static lmb_status set_context(lmb_fill_context *out, const lmb_target *target, const lmb_kernels *kernels,
                              const lmb_view *view, const lmb_scene *scene, uint32_t first_id)
{
    if (target == NULL || kernels == NULL || view == NULL || scene == NULL || first_id == 0) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = lmb_target_check(target, view, lmb_scene_triangles(scene));
    if (status == LMB_OK) {
        out->target = target;
        out->kernels = kernels;
        out->view = view;
        out->scene = scene;
        out->window = lmb_target_window(target, view);
#if LMB_TREES
        out->is_ahead = 0;
#endif
    }
    return status;
}

static void draw_id_range(lmb_fill_context *context, uint32_t first_id, uint32_t count, uint32_t flags,
                          lmb_stats *stats)
{
    const lmb_scene *scene = context->scene;
    if (scene->instance_count == 0) {
        return;
    }
    const lmb_instance *end = scene->instances + scene->instance_count;
    const lmb_instance *instance = lmb_instance_of(scene, first_id);
    uint32_t past = count > UINT32_MAX - first_id ? UINT32_MAX : first_id + count;
    lmb_batch batch;
    for (; instance != NULL && instance < end && instance->first_id < past; ++instance) {
        uint32_t own_past = instance->first_id + scene->meshes[instance->mesh].triangle_count;
        uint32_t from = first_id > instance->first_id ? first_id : instance->first_id;
        draw_instance_range(context, &batch, instance, from, past < own_past ? past : own_past, flags, stats);
    }
}

lmb_status lmb_draw(const lmb_target *target, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                    uint32_t first_id, uint32_t count, uint32_t flags, lmb_stats *stats)
{
    lmb_fill_context context;
    const lmb_status status = set_context(&context, target, kernels, view, scene, first_id);
    if (status == LMB_OK) {
#if LMB_CULLING
        context.culling = NULL;
#endif
        draw_id_range(&context, first_id, count, flags, stats);
    }
    return status;
}

#if LMB_CULLING
static lmb_status check_culling(const lmb_culling *culling, const lmb_target *target, const lmb_scene *scene)
{
    return (culling->farthest != NULL && culling->tiles < lmb_culling_tiles(target)) ||
                   (culling->clusters != NULL && culling->cluster_count < lmb_culling_clusters(scene))
               ? LMB_ERR_CAPACITY
               : LMB_OK;
}

/* `context`: set for the window. */
static void draw_in_bounds(lmb_fill_context *context, const lmb_culling *culling, uint32_t first_id, uint32_t count,
                           uint32_t flags, lmb_stats *stats)
{
    const int has_bounds = culling != NULL && culling->farthest != NULL;
    context->culling = culling;
    context->place.clusters = NULL;
    context->place.asked = context->place.asks = 0;
    context->window.farthest = has_bounds ? culling->farthest : NULL;
    context->window.bounds = has_bounds ? LMB_BOUNDS_RAISED : LMB_BOUNDS_IDLE;
    draw_id_range(context, first_id, count, flags, stats);
}

/* Resets the window and its bounds. */
static void clear_window(const lmb_fill_context *c, const lmb_culling *culling)
{
    lmb_surface_clear(&c->target->depth);
    if (c->target->id.data != NULL) {
        lmb_surface_clear(&c->target->id);
    }
    if (culling != NULL && culling->farthest != NULL) {
        memset(culling->farthest, 0, (size_t)c->window.tiles_x * (size_t)c->window.tiles_y * sizeof *culling->farthest);
    }
}

lmb_status lmb_draw_culled(const lmb_target *target, const lmb_kernels *kernels, const lmb_view *view,
                           const lmb_scene *scene, uint32_t first_id, uint32_t count, uint32_t flags, int32_t clear,
                           const lmb_culling *culling, lmb_stats *stats)
{
    lmb_fill_context context;
    lmb_status status = set_context(&context, target, kernels, view, scene, first_id);
    if (status == LMB_OK && culling != NULL) {
        status = check_culling(culling, target, scene);
    }
    if (status != LMB_OK) {
        return status;
    }
    if (clear) {
        clear_window(&context, culling);
    }
    draw_in_bounds(&context, culling, first_id, count, flags, stats);
    return LMB_OK;
}
#endif
