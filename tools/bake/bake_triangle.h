/* bake_triangle.h: a triangle's area, middle and longest edge. */
#ifndef BAKE_TRIANGLE_H
#define BAKE_TRIANGLE_H

#include "../common/fvec.h"

static inline float triangle_area(const lmb_vec3 corner[3])
{
    return 0.5f * length3(cross3(sub3(corner[1], corner[0]), sub3(corner[2], corner[0])));
}

static inline lmb_vec3 triangle_middle(const lmb_vec3 corner[3])
{
    return mul3(add3(add3(corner[0], corner[1]), corner[2]), 1.0f / 3.0f);
}

/* Returns the length of the longest edge, which runs from corner *from to the next. */
static inline float triangle_longest(int *from, const lmb_vec3 corner[3])
{
    float longest = -1.0f;
    *from = 0;
    for (int k = 0; k < 3; ++k) {
        const lmb_vec3 e = sub3(corner[(k + 1) % 3], corner[k]);
        if (dot3(e, e) > longest) {
            longest = dot3(e, e);
            *from = k;
        }
    }
    return sqrtf(longest);
}

#endif
