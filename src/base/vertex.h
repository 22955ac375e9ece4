/* vertex.h: reads one vertex or index of a mesh in any stream format. Layer 1.
 *
 * Streams are 4-byte aligned and tightly packed (lmb_scene_check), so plain typed reads suffice. Indices are returned
 * as stored: compare them with vertex_count before you decode a vertex. */
#ifndef LMB_BASE_VERTEX_H
#define LMB_BASE_VERTEX_H

#include <lambent/scene.h>

#include "vec.h"

/* Model space, metres. */
static inline lmb_vec3 mesh_position(const lmb_mesh *m, uint32_t vertex)
{
    if (m->position_format == LMB_POSITION_F32) {
        const float *f = (const float *)m->positions + (size_t)vertex * 3;
        return vec3(f[0], f[1], f[2]);
    } else {
        const int16_t *i = (const int16_t *)m->positions + (size_t)vertex * 4;
        const lmb_vec3 *s = &m->position_scale, *o = &m->position_offset;
        return vec3((float)i[0] * s->x + o->x, (float)i[1] * s->y + o->y, (float)i[2] * s->z + o->z);
    }
}

/* Texture coordinates; (0, 0) without a stream. Divides first, so that code 65535 is exactly uv_scale. */
static inline void mesh_uv(const lmb_mesh *m, uint32_t vertex, float out[2])
{
    const float *f = (const float *)m->uvs;
    const uint16_t *u = (const uint16_t *)m->uvs;
    size_t i = (size_t)vertex * 2;
    if (!m->uvs) {
        out[0] = out[1] = 0.0f;
    } else if (m->uv_format == LMB_UV_F32) {
        out[0] = f[i];
        out[1] = f[i + 1];
    } else {
        out[0] = (float)u[i] / 65535.0f * m->uv_scale[0];
        out[1] = (float)u[i + 1] / 65535.0f * m->uv_scale[1];
    }
}

/* Unit normal, model space; (0, 0, 0) without a stream: use the triangle's normal. */
static inline lmb_vec3 mesh_normal(const lmb_mesh *m, uint32_t vertex)
{
    return m->normals ? lmb_octahedral_decode(m->normals + (size_t)vertex * 2) : vec3(0.0f, 0.0f, 0.0f);
}

/* Unit vector towards larger u, model space, of a mesh with this stream. */
static inline lmb_vec3 mesh_tangent(const lmb_mesh *m, uint32_t vertex)
{
    return lmb_octahedral_decode(m->tangents + (size_t)vertex * 2);
}

/* For LMB_TANGENT_SIDED: 1 if the second axis is normal x tangent, -1 if it is the opposite. */
static inline float mesh_tangent_side(const lmb_mesh *m, uint32_t vertex)
{
    return (m->tangents[(size_t)vertex * 2] & 1) != 0 ? 1.0f : -1.0f;
}

static inline int mesh_colours_are_wide(const lmb_mesh *m)
{
    return LMB_TEXTURE_FORMATS && m->colour_format == LMB_COLOUR_RGBA16;
}

/* Channel k of a vertex in LMB_COLOUR_RGBA16, linear. */
static inline float mesh_wide_colour(const lmb_mesh *m, uint32_t vertex, int k)
{
    const float v = (float)((const uint16_t *)(const void *)m->colours)[(size_t)vertex * 4 + (size_t)k] / 65535.0f;
    return k < 3 ? v * v : v;
}

/* Linear RGBA, 0 .. 1; white without a stream. */
static inline void mesh_colour(const lmb_mesh *m, uint32_t vertex, float out[4])
{
    int32_t k;
    if (mesh_colours_are_wide(m) && m->colours) {
        for (k = 0; k < 4; ++k)
            out[k] = mesh_wide_colour(m, vertex, k);
        return;
    }
    for (k = 0; k < 4; ++k)
        out[k] = m->colours ? (float)m->colours[(size_t)vertex * 4 + (size_t)k] / 255.0f : 1.0f;
}

/* Vertex index of corner 3 * triangle + k; the corner itself if the mesh has no indices. */
static inline uint32_t mesh_index(const lmb_mesh *m, uint32_t corner)
{
    if (m->index_format == LMB_INDEX_U16)
        return ((const uint16_t *)m->indices)[corner];
    if (m->index_format == LMB_INDEX_U32)
        return ((const uint32_t *)m->indices)[corner];
    return corner;
}

/* Vertex indices of a triangle. */
static inline void mesh_triangle(const lmb_mesh *m, uint32_t triangle, uint32_t vertex[3])
{
    const size_t first = (size_t)triangle * 3;
    if (m->index_format == LMB_INDEX_U32) {
        const uint32_t *index = (const uint32_t *)m->indices + first;
        vertex[0] = index[0];
        vertex[1] = index[1];
        vertex[2] = index[2];
        return;
    }
    for (uint32_t i = 0; i < 3; ++i) {
        vertex[i] = mesh_index(m, 3 * triangle + i);
    }
}

/* Prefetch hints: the vertices of several triangles lie far apart in memory, and each would cause a cache miss. They
 * are always inlined: gcc treats a function that only prefetches as free of effects and drops calls to it. Builds for
 * size have no hints. */
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define MESH_SOON(p) __builtin_prefetch(p)
#define MESH_HINT    static inline __attribute__((always_inline))
#else
#define MESH_SOON(p) ((void)(p))
#define MESH_HINT    static inline
#endif

MESH_HINT void mesh_index_soon(const lmb_mesh *m, uint32_t corner)
{
    MESH_SOON((const uint8_t *)m->indices + (size_t)corner * (m->index_format == LMB_INDEX_U16 ? 2 : 4));
}

MESH_HINT void mesh_vertex_soon(const lmb_mesh *m, uint32_t vertex)
{
    MESH_SOON((const uint8_t *)m->positions + (size_t)vertex * (m->position_format == LMB_POSITION_F32 ? 12 : 8));
    if (m->colours != NULL) {
        MESH_SOON(m->colours + (size_t)vertex * (mesh_colours_are_wide(m) ? 8 : 4));
    }
    if (m->uvs != NULL) {
        MESH_SOON((const uint8_t *)m->uvs + (size_t)vertex * (m->uv_format == LMB_UV_F32 ? 8 : 4));
    }
}

#endif
