/* triangle.h: from an id back to its triangle. Layer 3. */
#ifndef LMB_RASTER_TRIANGLE_H
#define LMB_RASTER_TRIANGLE_H

#include <lambent/raster.h>

#include "../base/vec.h"

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

#endif
