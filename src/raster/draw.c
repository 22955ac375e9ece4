/* draw.c: a range of the scene's triangles into a window: transform once, clip where needed, set up, fill. Floor 3. */
#include <lambent/raster.h>

#include <string.h>

#include "../base/vertex.h"
#include "clip.h"
#include "fill.h"
#include "target.h"
#include "triangle.h"

#define GUARD_PX 16383.0f /* from the frame's middle; one px of rounding short of what setup.c can take */

/* One instance under one view. Rows give metres along right, up and the view's axis, from the eye. */
typedef struct draw_instance {
    float row[3][4];
    float scale_x, scale_y; /* to half width 1 */
    lmb_clip_guard guard;
    float snap_x, snap_y; /* x / w -> 24.8 */
    int32_t orthographic;
    float near_m, far_m, depth_scale;
    int32_t mirrored, cull, masked;
    const lmb_mesh *mesh;
} draw_instance;

static void set_row(float row[4], lmb_vec3 axis, float sign, const lmb_mat4 *t, lmb_vec3 eye)
{
    const float *m = t->m;
    lmb_vec3 a = mul3(axis, sign);
    for (int c = 0; c < 3; ++c) {
        row[c] = dot3(a, vec3(m[4 * c], m[4 * c + 1], m[4 * c + 2]));
    }
    /* Subtract before rotating: a world far from its origin keeps its millimetres. */
    row[3] = dot3(a, sub3(vec3(m[12], m[13], m[14]), eye));
}

static void set_instance(draw_instance *d, const lmb_scene *scene, const lmb_instance *instance, const lmb_view *view,
                         uint32_t flags)
{
    const lmb_material *material = &scene->materials[instance->material];
    set_row(d->row[0], view->right, 1.0f, &instance->to_world, view->eye);
    set_row(d->row[1], view->up, 1.0f, &instance->to_world, view->eye);
    set_row(d->row[2], view->back, -1.0f, &instance->to_world, view->eye);
    d->scale_x = 1.0f / view->half_width;
    d->scale_y = 1.0f / view->half_height;
    d->guard.x = GUARD_PX * 2.0f / (float)view->frame_width;
    d->guard.y = GUARD_PX * 2.0f / (float)view->frame_height;
    d->snap_x = (float)(view->frame_width * 128);
    d->snap_y = (float)(view->frame_height * 128);
    d->orthographic = view->kind == LMB_ORTHOGRAPHIC;
    d->near_m = view->near_m;
    d->far_m = view->far_m;
    d->depth_scale = d->orthographic ? 1.0f / (view->far_m - view->near_m) : 0.0f;
    d->mirrored = is_mirrored(&instance->to_world);
    d->cull = (flags & LMB_CULL_BACK) != 0 && (material->flags & LMB_DOUBLE_SIDED) == 0;
    d->masked = (material->flags & LMB_ALPHA_MASK) != 0;
    d->mesh = &scene->meshes[instance->mesh];
}

static float row_point(const float row[4], lmb_vec3 p) { return row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3]; }

static lmb_clip_vertex transform(const draw_instance *d, uint32_t vertex)
{
    lmb_vec3 p = mesh_position(d->mesh, vertex);
    float x = row_point(d->row[0], p), y = row_point(d->row[1], p), w = row_point(d->row[2], p);
    lmb_clip_vertex v;
    v.x = x * d->scale_x;
    v.y = y * d->scale_y;
    v.z = d->orthographic ? (d->far_m - w) * d->depth_scale : d->near_m;
    v.w = d->orthographic ? 1.0f : w;
    v.code = is_sane(x) && is_sane(y) && is_sane(w) ? lmb_clip_code(&v, &d->guard) : (uint32_t)CLIP_DROP;
    return v;
}

/* The vertex from the cache, or transformed into it. CLIP_DROP for an index outside the mesh. */
static lmb_clip_vertex cached(lmb_raster_scratch *cache, const draw_instance *d, uint32_t corner)
{
    lmb_clip_vertex v;
    uint32_t vertex = mesh_index(d->mesh, corner), slot = vertex & (LMB_VERTEX_CACHE - 1);
    if (cache->tag[slot] == vertex && vertex < d->mesh->vertex_count) {
        v.x = cache->x[slot];
        v.y = cache->y[slot];
        v.z = cache->z[slot];
        v.w = cache->w[slot];
        v.code = cache->code[slot];
        return v;
    }
    if (vertex >= d->mesh->vertex_count) {
        memset(&v, 0, sizeof v);
        v.code = CLIP_DROP;
        return v;
    }
    v = transform(d, vertex);
    cache->tag[slot] = vertex;
    cache->x[slot] = v.x;
    cache->y[slot] = v.y;
    cache->z[slot] = v.z;
    cache->w[slot] = v.w;
    cache->code[slot] = (uint8_t)v.code;
    return v;
}

static lmb_screen_vertex snap(const draw_instance *d, const lmb_clip_vertex *v)
{
    lmb_screen_vertex s;
    float inverse = 1.0f / v->w;
    s.x_24_8 = (int32_t)floorf(v->x * inverse * d->snap_x + 0.5f);
    s.y_24_8 = (int32_t)floorf(0.5f - v->y * inverse * d->snap_y);
    s.d = v->z * inverse;
    return s;
}

static int fill_polygon(const lmb_fill_context *c, const draw_instance *d, const lmb_clip_vertex *polygon, int n,
                        uint32_t id)
{
    lmb_screen_vertex first = snap(d, &polygon[0]), before = snap(d, &polygon[1]);
    int drawn = 0;
    for (int i = 2; i < n; ++i) {
        lmb_screen_vertex next = snap(d, &polygon[i]);
        lmb_setup setup;
        if (lmb_setup_triangle(&setup, &first, &before, &next) && !(d->cull && setup.back != d->mirrored)) {
            lmb_fill_triangle(c, &setup, id, d->masked);
            drawn = 1;
        }
        before = next;
    }
    return drawn;
}

/* LMB_MORE: dropped; LMB_OK: drawn or invisible. */
static int draw_triangle(const lmb_fill_context *c, lmb_raster_scratch *cache, const draw_instance *d, uint32_t triangle,
                         uint32_t id, lmb_stats *stats)
{
    lmb_clip_vertex polygon[LMB_CLIP_MAX];
    uint32_t any = 0, all = CLIP_ALL | CLIP_DROP;
    int n = 3;
    for (uint32_t k = 0; k < 3; ++k) {
        polygon[k] = cached(cache, d, 3 * triangle + k);
        any |= polygon[k].code;
        all &= polygon[k].code;
    }
    if (any & CLIP_DROP) {
        ++stats->triangles_dropped;
        return 0;
    }
    if (all) {
        return 0;
    }
    if (any) {
        n = lmb_clip_polygon(polygon, any, &d->guard);
    }
    return n >= 3 && fill_polygon(c, d, polygon, n, id);
}

static void draw_instance_range(const lmb_fill_context *c, lmb_raster_scratch *cache, const lmb_instance *instance,
                                uint32_t first, uint32_t last, uint32_t flags, lmb_stats *stats)
{
    draw_instance d;
    set_instance(&d, c->scene, instance, c->view, flags);
    memset(cache->tag, 0xff, sizeof cache->tag); /* no mesh has vertex 2^32 - 1 */
    for (uint32_t id = first; id < last; ++id) {
        ++stats->triangles;
        if (draw_triangle(c, cache, &d, id - instance->first_id, id, stats)) {
            ++stats->triangles_drawn;
        }
    }
}

lmb_status lmb_draw(const lmb_target *target, const lmb_kernels *kernels, lmb_raster_scratch *scratch,
                    const lmb_view *view, const lmb_scene *scene, uint32_t first_id, uint32_t count, uint32_t flags,
                    lmb_stats *stats)
{
    lmb_stats unread;
    lmb_fill_context context;
    if (target == NULL || kernels == NULL || scratch == NULL || view == NULL || scene == NULL || first_id == 0) {
        return LMB_ERR_ARG;
    }
    lmb_status status = lmb_target_check(target, view, lmb_scene_triangles(scene));
    if (status != LMB_OK) {
        return status;
    }
    memset(&unread, 0, sizeof unread);
    context.target = target;
    context.kernels = kernels;
    context.view = view;
    context.scene = scene;
    context.d16_scale = context.d16_bias = 0.0f;
    if (target->depth.format == LMB_DEPTH16) {
        lmb_depth16_coding(&context.d16_scale, &context.d16_bias, view);
    }
    const lmb_instance *end = scene->instances + scene->instance_count;
    const lmb_instance *instance = lmb_instance_of(scene, first_id);
    uint32_t past = count > UINT32_MAX - first_id ? UINT32_MAX : first_id + count;
    for (; instance != NULL && instance < end && instance->first_id < past; ++instance) {
        uint32_t own_past = instance->first_id + scene->meshes[instance->mesh].triangle_count;
        uint32_t from = first_id > instance->first_id ? first_id : instance->first_id;
        draw_instance_range(&context, scratch, instance, from, past < own_past ? past : own_past, flags,
                            stats != NULL ? stats : &unread);
    }
    return LMB_OK;
}
