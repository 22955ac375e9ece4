/* triangle.c: from an id back to the triangle. Layer 3. */
#include "triangle.h"

#include <string.h>

#include "tile.h"

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
    const lmb_instance *instance = scene != NULL ? lmb_instance_of(scene, id) : NULL;
    return instance != NULL && out != NULL && triangle_of(out, scene, instance, id);
}

#if LMB_LIVE
int lmb_triangle_is_flat(const lmb_scene *scene, uint32_t id)
{
    lmb_triangle t;
    const int16_t *n;
    if (!lmb_triangle_fetch(&t, scene, id)) {
        return 0;
    }
    n = t.mesh->normals;
    return t.material->normal_scale == 0.0f &&
           (n == NULL || (memcmp(n + 2 * (size_t)t.vertex[0], n + 2 * (size_t)t.vertex[1], 2 * sizeof *n) == 0 &&
                          memcmp(n + 2 * (size_t)t.vertex[0], n + 2 * (size_t)t.vertex[2], 2 * sizeof *n) == 0));
}
#endif

#if LMB_TREES || LMB_TRANSFER || LMB_MIXED
int lmb_triangle_shape(lmb_vec3 *normal, float *area, const lmb_triangle *t)
{
    lmb_vec3 n;
    float longest;
    if (normal == NULL || area == NULL || t == NULL || !triangle_cross(&n, &longest, t)) {
        return 0;
    }
    *normal = normalize3(n);
    *area = 0.5f * longest * length3(n);
    return 1;
}
#endif

#if LMB_TREES
static int is_inside_triangle(const lmb_triangle *t, lmb_vec3 normal, lmb_vec3 at)
{
    int inside = 1;
    for (int i = 0; i < 3; ++i) {
        const lmb_vec3 from = t->corner[i], edge = sub3(t->corner[i < 2 ? i + 1 : 0], from);
        inside &= dot3(cross3(normal, edge), sub3(at, from)) >= 0.0f;
    }
    return inside;
}

#define POSITION_ROUNDING 2.3841858e-7f /* 2^-22 of the coordinates: possible rounding of a position */

/* Moves a point of a triangle's plane from outside the triangle into it: past the nearest point by as much as it was
 * outside. On an edge it would also lie in the neighbour's plane, and behind the neighbour at a silhouette. */
static lmb_vec3 into_triangle(const lmb_triangle *t, lmb_vec3 normal, lmb_vec3 at)
{
    lmb_vec3 on = at;
    float nearest = 3e38f;
    for (int i = 0; i < 3; ++i) {
        const lmb_vec3 from = t->corner[i], edge = sub3(t->corner[i < 2 ? i + 1 : 0], from), d = sub3(at, from);
        if (dot3(cross3(normal, edge), d) < 0.0f) {
            const float share = clampf(dot3(d, edge) / dot3(edge, edge), 0.0f, 1.0f);
            const lmb_vec3 to = add3(from, mul3(edge, share)), off = sub3(at, to);
            const float distance2 = dot3(off, off);
            on = distance2 < nearest ? to : on;
            nearest = minf(nearest, distance2);
        }
    }
    const float distance = sqrtf(nearest);
    if (!(nearest < 3e38f && distance > 0.0f)) {
        return on;
    }
    const float past = maxf(distance, POSITION_ROUNDING * largest3(at)) / distance;
    const lmb_vec3 in = add3(on, mul3(sub3(on, at), past));
    return is_inside_triangle(t, normal, in) ? in : on;
}

lmb_vec3 lmb_place_onto_triangle(const lmb_scene *scene, uint32_t id, lmb_vec3 at)
{
    lmb_triangle t;
    lmb_vec3 normal;
    float area;
    return lmb_triangle_fetch(&t, scene, id) && lmb_triangle_shape(&normal, &area, &t) ? into_triangle(&t, normal, at)
                                                                                        : at;
}

/* 1 if one triangle contains the whole tile. It is convex, so the corner pixels decide. */
static int is_within_one(const lmb_tile *tile, const lmb_scene *scene)
{
    static const int corner[4] = {0, LMB_TILE - 1, LMB_TILE_PIXELS - LMB_TILE, LMB_TILE_PIXELS - 1};
    lmb_triangle t;
    lmb_vec3 normal;
    float area;
    uint32_t other = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        other |= tile->id[k] ^ tile->id[0];
    }
    if (other != 0 || !lmb_triangle_fetch(&t, scene, tile->id[0]) || !lmb_triangle_shape(&normal, &area, &t)) {
        return 0;
    }
    for (int i = 0; i < 4 && other == 0; ++i) {
        const lmb_vec3 at = tile_vec(tile->position, corner[i]), on = into_triangle(&t, normal, at);
        other |= on.x != at.x || on.y != at.y || on.z != at.z;
    }
    return other == 0;
}

uint64_t lmb_tile_onto_triangles(lmb_tile *inout, const lmb_scene *scene)
{
    const lmb_tile *in = inout;
    uint64_t moved = 0;
    uint32_t known = 0;
    int is_shape = 0;
    lmb_triangle t;
    lmb_vec3 normal = vec3(0, 0, 0);
    if (is_within_one(inout, scene)) {
        return 0;
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 at = tile_vec(in->position, k);
        float area;
        if (inout->id[k] != 0 && inout->id[k] != known) {
            known = inout->id[k];
            is_shape = lmb_triangle_fetch(&t, scene, known) && lmb_triangle_shape(&normal, &area, &t);
        }
        if (inout->id[k] != 0 && is_shape) {
            const lmb_vec3 on = into_triangle(&t, normal, at);
            moved |= (uint64_t)(on.x != at.x || on.y != at.y || on.z != at.z) << k;
            tile_set_vec(inout->position, k, on);
        }
    }
    return moved;
}
#endif
