/* triangle.h: from an id back to the triangle. Layer 3. */
#ifndef LMB_RASTER_TRIANGLE_H
#define LMB_RASTER_TRIANGLE_H

#include <lambent/lookup.h>
#include <lambent/raster.h>

#include "../base/vec.h"
#include "../base/vertex.h"

/* The instance that owns an id, or NULL. Binary search: instances are numbered in order. */
const lmb_instance *lmb_instance_of(const lmb_scene *scene, uint32_t id);

/* The material of an id, or NULL: tiles hold ids that are none of the scene's, as lmb_relief_nearer leaves them. */
const lmb_material *lmb_material_of(const lmb_scene *scene, uint32_t id);

/* Moves each position of a tile that lies outside the pixel's triangle into the triangle, past the nearest point by as
 * much. Returns those pixels. Rasterization snaps corners, so near an edge a pixel may show a triangle that its ray
 * just misses. The position on that triangle's plane then lies past a fold, on the other side of the next triangle. */
uint64_t lmb_tile_onto_triangles(lmb_tile *inout, const lmb_scene *scene);
lmb_vec3 lmb_place_onto_triangle(const lmb_scene *scene, uint32_t id, lmb_vec3 at); /* the same for one place */

/* 1 if all points of a triangle have one normal: its corners do, and no map changes it. */
int lmb_triangle_is_flat(const lmb_scene *scene, uint32_t id);

/* lmb_triangle_fetch for a known instance. */
static inline int triangle_of(lmb_triangle *out, const lmb_scene *scene, const lmb_instance *instance, uint32_t id)
{
    out->id = id;
    out->instance = instance;
    out->mesh = &scene->meshes[instance->mesh];
    out->material = &scene->materials[instance->material];
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t vertex = mesh_index(out->mesh, 3 * (id - instance->first_id) + k);
        if (vertex >= out->mesh->vertex_count) {
            return 0;
        }
        out->vertex[k] = vertex;
        out->corner[k] = transform_point(&instance->to_world, mesh_position(out->mesh, vertex));
    }
    return 1;
}

/* The front's normal, scaled so that the largest component is 1. *longest: the component before scaling, about twice
 * the area. Returns 0 as lmb_triangle_shape does. Signs are as good as random, so there is no branch on them. */
static inline int triangle_cross(lmb_vec3 *normal, float *longest, const lmb_triangle *t)
{
    const lmb_vec3 n = cross3(sub3(t->corner[1], t->corner[0]), sub3(t->corner[2], t->corner[0]));
    const float largest = maxf(maxf(maxf(n.x, -n.x), maxf(n.y, -n.y)), maxf(n.z, -n.z));
    for (int k = 0; k < 3; ++k) {
        if (!is_place(t->corner[k])) {
            return 0;
        }
    }
    if (!(largest > 1e-30f)) {
        return 0;
    }
    *longest = largest;
    *normal = mul3(n, 1.0f / largest); /* so that no square is too small or too large */
    return 1;
}

#endif
