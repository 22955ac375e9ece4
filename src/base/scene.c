/* scene.c: checks a scene, counts its triangles, finds its bounds. Layer 1. */
#include <lambent/scene.h>

#include <stddef.h>

#include "light_kind.h"
#include "scene_check.h"
#include "vec.h"
#include "vertex.h"

/* 3 * triangle + k must fit 32 bits. */
#define MAX_MESH_TRIANGLES 0x55555555u

/* False for NaN. */
static int are_within(const float *v, int32_t count, float low, float high)
{
    int32_t i;
    for (i = 0; i < count; ++i)
        if (!(v[i] >= low && v[i] <= high))
            return 0;
    return 1;
}

static int are_numbers_finite(const float *v, int32_t count) { return are_within(v, count, -FLT_MAX, FLT_MAX); }

static int is_number_finite(float v) { return v >= -FLT_MAX && v <= FLT_MAX; }

static int is_finite3(lmb_vec3 v) { return is_number_finite(v.x) && is_number_finite(v.y) && is_number_finite(v.z); }

static int is_aligned(const void *p) { return ((uintptr_t)p & 3u) == 0; }

lmb_status lmb_check_mesh(const lmb_mesh *m)
{
    if (m->position_format > LMB_POSITION_I16 || m->uv_format > LMB_UV_U16 || m->index_format > LMB_INDEX_U32 ||
        m->tangent_format > LMB_TANGENT_SIDED ||
        m->colour_format > (LMB_TEXTURE_FORMATS ? LMB_COLOUR_RGBA16 : LMB_COLOUR_RGBA8))
        return LMB_ERR_FORMAT;
    if ((m->vertex_count && !m->positions) || m->triangle_count > MAX_MESH_TRIANGLES)
        return LMB_ERR_ARG;
    if (m->triangle_count && m->index_format != LMB_INDEX_NONE && !m->indices)
        return LMB_ERR_ARG;
    if (!is_aligned(m->positions) || !is_aligned(m->normals) || !is_aligned(m->tangents) || !is_aligned(m->uvs) ||
        !is_aligned(m->colours) || !is_aligned(m->indices))
        return LMB_ERR_ALIGN;
    if (m->position_format == LMB_POSITION_I16 && !(is_finite3(m->position_scale) && is_finite3(m->position_offset)))
        return LMB_ERR_ARG;
    if (m->uvs && m->uv_format == LMB_UV_U16 && !are_numbers_finite(m->uv_scale, 2))
        return LMB_ERR_ARG;
    if (m->index_format == LMB_INDEX_NONE && m->triangle_count > m->vertex_count / 3)
        return LMB_ERR_SCENE;
    return LMB_OK;
}

static lmb_status check_texture(const lmb_texture *t)
{
    if (!t->texels || t->levels < 1 || t->levels > lmb_texture_level_count(t->width, t->height))
        return LMB_ERR_ARG;
    if (!is_aligned(t->texels))
        return LMB_ERR_ALIGN;
    if (t->wrap_s > LMB_WRAP_MIRROR || t->wrap_t > LMB_WRAP_MIRROR || t->filter > LMB_TRILINEAR ||
        t->format > (LMB_TEXTURE_FORMATS ? LMB_TEXELS_PALETTE4 : LMB_TEXELS_RGBA8))
        return LMB_ERR_FORMAT;
    return LMB_OK;
}

lmb_status lmb_check_material(const lmb_material *m, uint32_t texture_count)
{
    if (!are_within(m->albedo, 3, 0.0f, FLT_MAX) || !are_within(m->emission, 3, 0.0f, FLT_MAX) ||
        !are_within(m->specular, 3, 0.0f, 1.0f) || !are_within(&m->roughness, 1, 0.0f, 1.0f) ||
        !are_within(&m->metallic, 1, 0.0f, 1.0f) || !is_number_finite(m->alpha) || !is_number_finite(m->alpha_cutoff) ||
        !is_number_finite(m->normal_scale))
        return LMB_ERR_ARG;
    if (m->normal_scale != 0.0f && m->normal_map >= texture_count)
        return LMB_ERR_SCENE;
    if (m->emission_map > texture_count || m->metal_map > texture_count)
        return LMB_ERR_SCENE;
    if (m->texture < -1 || (m->texture >= 0 && (uint32_t)m->texture >= texture_count))
        return LMB_ERR_SCENE;
    return LMB_OK;
}

lmb_status lmb_check_light(const lmb_light *l)
{
    if (!light_kind_is(l->kind, LIGHT_KNOWN))
        return LMB_ERR_FORMAT;
    if (!is_finite3(l->position) || !is_finite3(l->direction) || !are_within(l->intensity, 3, 0.0f, FLT_MAX) ||
        !is_number_finite(l->cos_inner) || !is_number_finite(l->cos_outer) || !are_within(&l->range, 1, 0.0f, FLT_MAX))
        return LMB_ERR_ARG;
    return light_shape_is_valid(l) ? LMB_OK : LMB_ERR_ARG;
}

/* Ids are contiguous from 1, so that bisection finds the instance of an id. */
static lmb_status check_instances(const lmb_scene *scene)
{
    uint32_t i, next_id = 1, triangles;
    for (i = 0; i < scene->instance_count; ++i) {
        const lmb_instance *in = &scene->instances[i];
        if (!are_numbers_finite(in->to_world.m, 16))
            return LMB_ERR_ARG;
        if (in->mesh >= scene->mesh_count || in->material >= scene->material_count || in->first_id != next_id)
            return LMB_ERR_SCENE;
        triangles = scene->meshes[in->mesh].triangle_count;
        if (triangles > (uint32_t)LMB_MAX_TRIANGLES - (next_id - 1))
            return LMB_ERR_ARG;
        next_id += triangles;
    }
    return LMB_OK;
}

/* A count above 0 needs its array. */
static int has_arrays(const lmb_scene *s)
{
    return (s->meshes || !s->mesh_count) && (s->materials || !s->material_count) &&
           (s->textures || !s->texture_count) && (s->instances || !s->instance_count) &&
           (s->lights || !s->light_count);
}

/* Builds without trees do not read the core. */
static int is_core(const lmb_core *c)
{
    return !LMB_TREES || c->faces == 0 ||
           (c->faces > 0 && c->faces <= LMB_CORE_FACES && is_finite3(c->low) && is_finite3(c->high) &&
            is_finite3(c->wide_low) && is_finite3(c->wide_high) && c->low.x <= c->high.x && c->low.y <= c->high.y &&
            c->low.z <= c->high.z && c->wide_low.x <= c->wide_high.x && c->wide_low.y <= c->wide_high.y &&
            c->wide_low.z <= c->wide_high.z);
}

lmb_status lmb_check_bounds(const lmb_scene *s)
{
    return is_finite3(s->bounds_min) && is_finite3(s->bounds_max) && s->bounds_min.x <= s->bounds_max.x &&
                   s->bounds_min.y <= s->bounds_max.y && s->bounds_min.z <= s->bounds_max.z && is_core(&s->core)
               ? LMB_OK
               : LMB_ERR_ARG;
}

lmb_status lmb_scene_check(const lmb_scene *scene)
{
    lmb_status status = LMB_OK;
    uint32_t i;
    if (!scene || !has_arrays(scene) || lmb_check_bounds(scene) != LMB_OK)
        return LMB_ERR_ARG;
    for (i = 0; i < scene->mesh_count && status == LMB_OK; ++i)
        status = lmb_check_mesh(&scene->meshes[i]);
    for (i = 0; i < scene->texture_count && status == LMB_OK; ++i)
        status = check_texture(&scene->textures[i]);
    for (i = 0; i < scene->material_count && status == LMB_OK; ++i)
        status = lmb_check_material(&scene->materials[i], scene->texture_count);
    for (i = 0; i < scene->light_count && status == LMB_OK; ++i)
        status = lmb_check_light(&scene->lights[i]);
    return status == LMB_OK ? check_instances(scene) : status;
}

uint32_t lmb_scene_triangles(const lmb_scene *scene)
{
    const lmb_instance *last;
    if (!scene || scene->instance_count == 0)
        return 0;
    last = &scene->instances[scene->instance_count - 1];
    return last->first_id - 1 + scene->meshes[last->mesh].triangle_count;
}

/* Is the colour at byte offset `at` not black in at least one material? */
static int any_coloured(const lmb_scene *scene, size_t at)
{
    int any = 0;
    for (uint32_t i = 0; scene != NULL && i < scene->material_count; ++i) {
        const float *c = (const float *)((const char *)&scene->materials[i] + at);
        any |= c[0] > 0.0f || c[1] > 0.0f || c[2] > 0.0f;
    }
    return any;
}

int lmb_scene_emits(const lmb_scene *scene) { return any_coloured(scene, offsetof(lmb_material, emission)); }

int lmb_scene_is_glossy(const lmb_scene *scene) { return any_coloured(scene, offsetof(lmb_material, specular)); }

/* World positions that are not finite or beyond 2^20 m are ignored: draws drop such triangles. */
void lmb_scene_bounds(lmb_vec3 *out_min, lmb_vec3 *out_max, const lmb_scene *scene)
{
    lmb_vec3 lo = vec3(FLT_MAX, FLT_MAX, FLT_MAX), hi = vec3(-FLT_MAX, -FLT_MAX, -FLT_MAX);
    uint32_t i, v;
    if (!out_min || !out_max)
        return;
    for (i = 0; scene && i < scene->instance_count; ++i) {
        const lmb_instance *in = &scene->instances[i];
        const lmb_mesh *mesh = &scene->meshes[in->mesh];
        for (v = 0; v < mesh->vertex_count; ++v) {
            lmb_vec3 p = transform_point(&in->to_world, mesh_position(mesh, v));
            if (!is_place(p))
                continue;
            lo = min3(lo, p);
            hi = max3(hi, p);
        }
    }
    if (lo.x > hi.x)
        lo = hi = vec3(0.0f, 0.0f, 0.0f);
    *out_min = lo;
    *out_max = hi;
}
