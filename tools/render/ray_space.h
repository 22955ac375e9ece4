/* ray_space.h: the nearest triangle on a ray, by the library's BVH. */
#ifndef RAY_SPACE_H
#define RAY_SPACE_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* The triangles of a scene. One thread at a time. */
typedef struct ray_space {
    const lmb_scene *scene;
    lmb_bvh bvh;
    void *memory;
    uint32_t *stack; /* nodes: each is on it at most once */
} ray_space;

/* ray_space_make: builds the BVH. Returns 1, or 0 with `r` set. ray_space_free releases it. */
int ray_space_make(ray_space *out, const lmb_scene *scene, report *r);
void ray_space_free(ray_space *s);

/* ray_nearest: the nearest triangle on a ray, farther than `noise` from its plane: its place in bvh.triangle + 1,
 * and the distance, m; 0: none within `reach_m`. Rays pass through the holes of masked triangles. */
uint32_t ray_nearest(float *far_m, ray_space *s, lmb_vec3 from, lmb_vec3 along, float noise, float reach_m);

#endif
