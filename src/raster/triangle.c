/* triangle.c: from an id back to its triangle. Layer 3. */
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

const lmb_material *lmb_material_of(const lmb_scene *scene, uint32_t id)
{
    const lmb_instance *instance = lmb_instance_of(scene, id);
    return instance == NULL ? NULL : &scene->materials[instance->material];
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

#if LMB_TREES || LMB_TRANSFER
int lmb_triangle_shape(lmb_vec3 *normal, float *area, const lmb_triangle *t)
{
    const lmb_vec3 n = cross3(sub3(t->corner[1], t->corner[0]), sub3(t->corner[2], t->corner[0]));
    const float longest = largest3(n);
    for (int k = 0; k < 3; ++k) {
        if (!is_sane(t->corner[k].x) || !is_sane(t->corner[k].y) || !is_sane(t->corner[k].z)) {
            return 0;
        }
    }
    if (!(longest > 1e-30f)) {
        return 0;
    }
    const lmb_vec3 scaled = mul3(n, 1.0f / longest); /* so that no square is too small or too large */
    *normal = normalize3(scaled);
    *area = 0.5f * longest * length3(scaled);
    return 1;
}
#endif
