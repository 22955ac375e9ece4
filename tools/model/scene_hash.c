/* scene_hash.c: a hash of everything that a scene draws. */
#include "scene_hash.h"

#include <string.h>

#define HASH_OF(hash, member) scene_hash_bytes(hash, &(member), sizeof(member))

uint64_t scene_hash_bytes(uint64_t hash, const void *data, size_t size)
{
    const uint8_t *p = data;
    for (size_t i = 0; i < size; ++i) {
        hash = (hash ^ p[i]) * UINT64_C(0x100000001b3);
    }
    return hash;
}

/* Hashes an array that may be NULL. */
static uint64_t hash_array(uint64_t hash, const void *data, size_t count, size_t each)
{
    const uint64_t n = data != NULL ? count : 0;
    hash = HASH_OF(hash, n);
    return n > 0 ? scene_hash_bytes(hash, data, count * each) : hash;
}

static uint64_t hash_mesh(uint64_t hash, const lmb_mesh *m)
{
    const size_t vertices = m->vertex_count, corners = 3 * (size_t)m->triangle_count;
    hash = HASH_OF(hash, m->position_format);
    hash = HASH_OF(hash, m->uv_format);
    hash = HASH_OF(hash, m->index_format);
    if (m->tangents != NULL && m->tangent_format != LMB_TANGENT_BY_UV) /* hashes of other meshes do not change */
        hash = HASH_OF(hash, m->tangent_format);
    hash = hash_array(hash, m->positions, vertices, m->position_format == LMB_POSITION_F32 ? 12 : 8);
    hash = hash_array(hash, m->normals, vertices, 4);
    hash = hash_array(hash, m->tangents, vertices, 4);
    hash = hash_array(hash, m->uvs, vertices, m->uv_format == LMB_UV_F32 ? 8 : 4);
    if (m->colours != NULL && m->colour_format != LMB_COLOUR_RGBA8)
        hash = HASH_OF(hash, m->colour_format);
    hash = hash_array(hash, m->colours, vertices, m->colour_format == LMB_COLOUR_RGBA8 ? 4 : 8);
    hash = hash_array(hash, m->indices, corners, m->index_format == LMB_INDEX_U16 ? 2 : 4);
    hash = HASH_OF(hash, m->position_scale);
    hash = HASH_OF(hash, m->position_offset);
    return HASH_OF(hash, m->uv_scale);
}

static uint64_t hash_material(uint64_t hash, const lmb_material *m)
{
    hash = HASH_OF(hash, m->albedo);
    hash = HASH_OF(hash, m->alpha);
    hash = HASH_OF(hash, m->alpha_cutoff);
    hash = HASH_OF(hash, m->texture);
    hash = HASH_OF(hash, m->flags);
    hash = HASH_OF(hash, m->normal_map);
    hash = HASH_OF(hash, m->normal_scale);
    hash = HASH_OF(hash, m->emission);
    hash = HASH_OF(hash, m->specular);
    hash = HASH_OF(hash, m->roughness);
    hash = HASH_OF(hash, m->emission_map);
    hash = HASH_OF(hash, m->metal_map);
    return HASH_OF(hash, m->metallic);
}

static uint64_t hash_texture(uint64_t hash, const lmb_texture *t)
{
    hash = HASH_OF(hash, t->wrap_s);
    hash = HASH_OF(hash, t->wrap_t);
    hash = HASH_OF(hash, t->filter);
    hash = HASH_OF(hash, t->width);
    hash = t->format != LMB_TEXELS_RGBA8 ? HASH_OF(hash, t->format) : hash;
    return hash_array(hash, t->texels, 1, lmb_texture_format_bytes(t->format, t->width, t->height, t->levels));
}

static uint64_t hash_light(uint64_t hash, const lmb_light *l)
{
    hash = HASH_OF(hash, l->position);
    hash = HASH_OF(hash, l->direction);
    hash = HASH_OF(hash, l->intensity);
    hash = HASH_OF(hash, l->cos_inner);
    hash = HASH_OF(hash, l->cos_outer);
    hash = HASH_OF(hash, l->kind);
    return l->range > 0.0f ? HASH_OF(hash, l->range) : hash;
}

uint64_t scene_hash(const lmb_scene *s)
{
    static const uint32_t version = LMB_VERSION;
    uint64_t hash = HASH_OF(UINT64_C(0xcbf29ce484222325), version);
    for (uint32_t i = 0; i < s->mesh_count; ++i) {
        hash = hash_mesh(hash, &s->meshes[i]);
    }
    for (uint32_t i = 0; i < s->material_count; ++i) {
        hash = hash_material(hash, &s->materials[i]);
    }
    for (uint32_t i = 0; i < s->texture_count; ++i) {
        hash = hash_texture(hash, &s->textures[i]);
    }
    for (uint32_t i = 0; i < s->instance_count; ++i) {
        hash = HASH_OF(hash, s->instances[i].to_world);
        hash = HASH_OF(hash, s->instances[i].mesh);
        hash = HASH_OF(hash, s->instances[i].material);
    }
    for (uint32_t i = 0; i < s->light_count; ++i) {
        hash = hash_light(hash, &s->lights[i]);
    }
    return hash;
}

uint64_t scene_hash_view(uint64_t hash, const lmb_view *v)
{
    hash = HASH_OF(hash, v->eye);
    hash = HASH_OF(hash, v->right);
    hash = HASH_OF(hash, v->up);
    hash = HASH_OF(hash, v->half_width);
    hash = HASH_OF(hash, v->half_height);
    hash = HASH_OF(hash, v->kind);
    hash = HASH_OF(hash, v->frame_width);
    return HASH_OF(hash, v->frame_height);
}
