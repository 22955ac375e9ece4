/* footprint.h: a position or a step on a shadow map, on the surface shown there. Layer 4. */
#ifndef LMB_DIRECT_FOOTPRINT_H
#define LMB_DIRECT_FOOTPRINT_H

#include "../base/vec.h"

#define GRAZE 0.02f /* a texel's footprint stretches no further below this cosine */

/* The point of a plane (given by a point `on` it and the normal) over the point (sx, sy) of the map's plane at distance
 * 1 (m for suns). */
static inline lmb_vec3 footprint_over(const lmb_view *v, lmb_vec3 on, lmb_vec3 normal, float sx, float sy)
{
    const lmb_vec3 across = add3(mul3(v->right, sx), mul3(v->up, sy)), p = sub3(on, v->eye);
    if (v->kind == LMB_PERSPECTIVE) {
        const lmb_vec3 ray = sub3(across, v->back);
        return add3(v->eye, mul3(ray, dot3(normal, p) / dot3(normal, ray)));
    }
    const float w = dot3(normal, sub3(p, across)) / -dot3(normal, v->back);
    return add3(v->eye, sub3(across, mul3(v->back, w)));
}

/* The step on the surface for a step by one texel of the map along (sx, sy): along the surface's plane. */
static inline lmb_vec3 footprint(const lmb_view *v, lmb_vec3 p, lmb_vec3 n, lmb_vec3 step)
{
    lmb_vec3 ray = v->kind == LMB_PERSPECTIVE ? sub3(p, v->eye) : mul3(v->back, -1.0f);
    float w = v->kind == LMB_PERSPECTIVE ? maxf(-dot3(v->back, ray), 0.0f) : 1.0f;
    float slope = dot3(n, ray), min = GRAZE * length3(ray);
    slope = slope < 0.0f ? minf(slope, -min) : maxf(slope, min);
    return mul3(sub3(step, mul3(ray, dot3(n, step) / slope)), w);
}

/* A texel's sides on the surface at p with normal n, in a map of `size` texels. */
static inline void footprint_sides(lmb_vec3 *along_x, lmb_vec3 *along_y, const lmb_view *v, int32_t size, lmb_vec3 p,
                                   lmb_vec3 n)
{
    *along_x = footprint(v, p, n, mul3(v->right, 2.0f * v->half_width / (float)size));
    *along_y = footprint(v, p, n, mul3(v->up, 2.0f * v->half_height / (float)size));
}

#endif
