/* triangle.h: from an id back to its triangle. Layer 3. */
#ifndef LMB_RASTER_TRIANGLE_H
#define LMB_RASTER_TRIANGLE_H

#include <lambent/raster.h>

#include "../base/vec.h"
#include "../base/vertex.h"

typedef struct lmb_triangle {
    const lmb_instance *instance;
    const lmb_mesh *mesh;
    const lmb_material *material;
    uint32_t id;
    uint32_t vertex[3]; /* of the mesh */
    lmb_vec3 corner[3]; /* world, m */
} lmb_triangle;

/* The instance that owns an id, or NULL. Binary search: instances are numbered in order. */
const lmb_instance *lmb_instance_of(const lmb_scene *scene, uint32_t id);

/* Its material, or NULL: tiles hold ids that are none of the scene's, as lmb_relief_nearer leaves them. */
const lmb_material *lmb_material_of(const lmb_scene *scene, uint32_t id);

/* The front's unit normal and the area, m2; 0 where a corner is absurd or the triangle a speck: twice its area under
 * 1e-30 m2, where squares are no normal numbers. */
int lmb_triangle_shape(lmb_vec3 *normal, float *area, const lmb_triangle *triangle);

/* 1, or 0 where the id names no drawable triangle. */
int lmb_triangle_fetch(lmb_triangle *out, const lmb_scene *scene, uint32_t id);

/* Moves each place of a tile that lies beside the triangle that shows there into that triangle, past its nearest point
 * by as much; returns those pixels. Rasters snap corners, so near an edge a pixel may show a triangle that its ray just
 * misses. The place on that triangle's plane then lies past a fold, on the other side of the next triangle. */
uint64_t lmb_tile_onto_triangles(lmb_tile *inout, const lmb_scene *scene);
lmb_vec3 lmb_place_onto_triangle(const lmb_scene *scene, uint32_t id, lmb_vec3 at); /* the same for one place */

/* lmb_triangle_fetch where its instance is known. */
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

/* The front's normal, as long as its *longest component is 1, and how long that was: about twice the area. 0 as in
 * lmb_triangle_shape. Signs are as good as random, so they are not branched on. */
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
