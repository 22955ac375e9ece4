/* relief_model.h: a scene flattened to one mesh in world space, as input for reliefs. */
#ifndef RELIEF_MODEL_H
#define RELIEF_MODEL_H

#include <lambent/scene.h>

#include "../common/report.h"
#include "../mesh/simplify.h"

/* A triangle mesh as a scene for the library. Zeroed: empty. Release it with relief_scene_free. */
typedef struct relief_scene {
    lmb_scene scene; /* one instance; points into this struct */
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    int16_t *normals;
    uint8_t *colours;
} relief_scene;

/* relief_flatten: merges all triangles of a scene in world space, with albedos at the corners as colours. Normals are
 * the scene's if all meshes have normals, otherwise smooth: the mean over triangles at a position, weighted by area.
 * Release it with triangle_mesh_free. Returns 1, or 0 with `r` set. */
int relief_flatten(triangle_mesh *out, const lmb_scene *scene, report *r);

/* relief_scene_of: makes a mesh drawable. Keep `mesh` as long as you use `out`, and do not move `out`. Returns 1, or 0
 * with `r` set. */
int relief_scene_of(relief_scene *out, const triangle_mesh *mesh, report *r);
void relief_scene_free(relief_scene *s);

/* relief_divide: divides each triangle into four at the middles of the edges. `out` is a new mesh. */
int relief_divide(triangle_mesh *out, const triangle_mesh *in, report *r);

#endif
