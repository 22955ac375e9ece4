/* small.h: a BVH of 16-byte nodes: its build, and the sides of its boxes. Layer 4. */
#ifndef LMB_OCCLUSION_SMALL_H
#define LMB_OCCLUSION_SMALL_H

#include <lambent/occlusion.h>

/* Builds inout->small, as lmb_bvh_build. */
lmb_status lmb_small_build(lmb_bvh *inout, const lmb_scene *scene);
#if !LMB_LIVE
#define lmb_small_build(b, scene) ((void)sizeof(lmb_small_build(b, scene)), LMB_ERR_ARG)
#endif

/* The triangle of an id, as lmb_bvh.triangle has it; 0 if it blocks nothing. */
int lmb_small_triangle(lmb_bvh_triangle *out, const lmb_scene *scene, uint32_t id);

/* Coordinate of a step along axis h, m. */
static inline float lmb_small_side(const lmb_bvh *b, int h, uint16_t step)
{
    return b->small_low[h] + (float)step * b->small_step[h];
}

#endif
