/* lookup.h: looks up parts of a scene: the triangle of an id, a vertex of a mesh, the colour of a texture.
 *
 * lmb_draw writes ids. These calls return the material, the corners and the texels behind an id, for programs that
 * bake, pick or explain, and for your own shading.
 *
 * Stability: experimental. */
#ifndef LMB_LOOKUP_H
#define LMB_LOOKUP_H

#include "scene.h"

/* A triangle of a scene. */
typedef struct lmb_triangle {
    const lmb_instance *instance;
    const lmb_mesh *mesh;
    const lmb_material *material;
    uint32_t id;
    uint32_t vertex[3]; /* of the mesh */
    lmb_vec3 corner[3]; /* world, m */
} lmb_triangle;

/* A vertex, decoded from the mesh's streams. */
typedef struct lmb_vertex {
    lmb_vec3 position; /* model space, m */
    lmb_vec3 normal;   /* model space, unit; (0, 0, 0) without a stream */
    float uv[2];       /* (0, 0) without a stream */
    float colour[4];   /* linear RGBA, 0 .. 1; white without a stream */
} lmb_vertex;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_triangle_fetch: find the triangle of an id.
 *
 *   out    set if the id has an instance, even if the call returns 0 because of an index outside the mesh.
 *   scene  checked by lmb_scene_check; `out` points into it.
 * Returns 1, or 0 if the id is none of the scene's or an index lies outside the mesh, or if a pointer is null.
 * Corners may be infinite or NaN if the vertices are. Cost: a binary search over the instances. */
int lmb_triangle_fetch(lmb_triangle *out, const lmb_scene *scene, uint32_t id);

/* lmb_triangle_shape: the unit normal of a triangle's front, and the area, m2.
 *
 * Returns 1; or 0 if a corner is not finite or over 2^20 m away, if twice the area is under 1e-30 m2, or if a pointer
 * is null: then the outputs are unchanged. Missing in builds without trees, baked light and mixed.h. */
int lmb_triangle_shape(lmb_vec3 *normal, float *area, const lmb_triangle *triangle);

/* lmb_triangle_alpha: the opacity of a triangle where pixel (x, y) sees it: material x texture x vertices, not clamped.
 *
 *   view  the frame's camera, as in lmb_draw; (x, y) counts from the frame's first pixel.
 *   id    need not be the surface that the pixel shows.
 * If the pixel's centre is outside the triangle, the value of a point on the edge is returned. Returns 0 if the id has
 * no triangle or a pointer is null. The texture's level is that of colours; for materials that are only masked, and in
 * builds without LMB_MULTISAMPLE, it is 0. Cost: a binary search, and a texture lookup. */
float lmb_triangle_alpha(const lmb_view *view, const lmb_scene *scene, uint32_t id, int32_t x, int32_t y);

/* lmb_mesh_vertex: decode a vertex of a mesh.
 *
 *   mesh  of a checked scene.
 * Returns 1, or 0 if there is no such vertex or a pointer is null: then `out` is unchanged. */
int lmb_mesh_vertex(lmb_vertex *out, const lmb_mesh *mesh, uint32_t vertex);

/* lmb_mesh_index: the vertex of a corner; triangle t has the corners 3 * t .. 3 * t + 2. Returns 0xffffffff if the mesh
 * has no such corner or is null. The vertex may lie outside a mesh that has invalid indices. */
uint32_t lmb_mesh_index(const lmb_mesh *mesh, uint32_t corner);

/* lmb_texture_sample: the colour of a texture at (u, v), filtered and wrapped as the texture states.
 *
 *   out      linear R G B, 0 .. 1, and alpha.
 *   texture  of a checked scene, or a copy with another filter.
 *   lod      mip level, 0 the finest; used if the filter is LMB_TRILINEAR.
 * A coordinate that is not finite counts as 0. A null texture, or one without texels, gives zeros.
 * lmb_normal_map_sample: the same for linear codes: x y z, each -1 .. 1, not of unit length; out[3] is undefined. For
 * a metal_map, 0.5 + 0.5 * out[1] is the roughness and 0.5 + 0.5 * out[2] the metalness.
 * Cost: up to eight texels. */
void lmb_texture_sample(float out[4], const lmb_texture *texture, float u, float v, float lod);
void lmb_normal_map_sample(float out[4], const lmb_texture *texture, float u, float v, float lod);

#ifdef __cplusplus
}
#endif
#endif
