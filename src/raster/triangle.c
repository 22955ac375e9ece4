/* triangle.c: from an id back to its triangle. Floor 3. */
#include "triangle.h"

#include "../base/vertex.h"

const lmb_instance *lmb_instance_of(const lmb_scene *scene, uint32_t id)
{
    uint32_t lo = 0, hi = scene->instance_count; /* the owner is in [lo, hi) */
    if (id == 0 || hi == 0) {
        return NULL;
    }
    while (hi - lo > 1) {
        uint32_t mid = lo + (hi - lo) / 2;
        if (scene->instances[mid].first_id <= id) {
            lo = mid;
        } else {
            hi = mid;
        }
    }
    /* Instances of empty meshes share a first id with the next one: the search ends on the last of them. */
    const lmb_instance *instance = &scene->instances[lo];
    return id - instance->first_id < scene->meshes[instance->mesh].triangle_count ? instance : NULL;
}

int lmb_triangle_fetch(lmb_triangle *out, const lmb_scene *scene, uint32_t id)
{
    const lmb_instance *instance = lmb_instance_of(scene, id);
    if (instance == NULL) {
        return 0;
    }
    out->id = id;
    out->instance = instance;
    out->mesh = &scene->meshes[instance->mesh];
    out->material = &scene->materials[instance->material];
    for (uint32_t k = 0; k < 3; ++k) {
        uint32_t vertex = mesh_index(out->mesh, 3 * (id - instance->first_id) + k);
        if (vertex >= out->mesh->vertex_count) {
            return 0;
        }
        out->vertex[k] = vertex;
        out->corner[k] = transform_point(&instance->to_world, mesh_position(out->mesh, vertex));
    }
    return 1;
}
