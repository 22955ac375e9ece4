/* relief_model.h: a scene as reliefs are made of it: one mesh in the world. */
#ifndef RELIEF_MODEL_H
#define RELIEF_MODEL_H

#include <lambent/scene.h>

#include "../common/report.h"
#include "../mesh/simplify.h"

/* A triangle mesh as the library draws it. Zeroed it is empty; relief_scene_free releases it. */
typedef struct relief_scene {
    lmb_scene scene; /* one instance; points into this struct */
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    int16_t *normals;
    uint8_t *colours;
} relief_scene;

/* relief_flatten: all triangles of a scene in the world, with its albedos at corners as colours. Normals are the
 * scene's where each mesh has them, else smooth: the mean of the triangles at a place, by area. triangle_mesh_free
 * releases it. 1, or 0 with `r` set. */
int relief_flatten(triangle_mesh *out, const lmb_scene *scene, report *r);

/* relief_scene_of: draw a mesh. `mesh` stays as long as `out`, which must not move. 1, or 0 with `r` set. */
int relief_scene_of(relief_scene *out, const triangle_mesh *mesh, report *r);
void relief_scene_free(relief_scene *s);

/* relief_divide: each triangle in four, at the middles of its edges. `out` is a mesh of its own. */
int relief_divide(triangle_mesh *out, const triangle_mesh *in, report *r);

#endif
