/* triangle.c: from an id back to its triangle. Layer 3. */
#include "triangle.h"

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
    return instance != NULL && triangle_of(out, scene, instance, id);
}

#if LMB_TREES || LMB_TRANSFER
int lmb_triangle_shape(lmb_vec3 *normal, float *area, const lmb_triangle *t)
{
    lmb_vec3 n;
    float longest;
    if (!triangle_cross(&n, &longest, t)) {
        return 0;
    }
    *normal = normalize3(n);
    *area = 0.5f * longest * length3(n);
    return 1;
}
#endif
