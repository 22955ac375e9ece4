/* polygon.h: what the form factors of polygons are made of. Layer 6. */
#ifndef POLYGON_H
#define POLYGON_H

#include "../base/poly.h"
#include "../base/vec.h"

enum { POLYGON_CORNERS = LMB_TREES ? 8 : 4 };
#define POLYGON_FLAT 1e-3f /* of the half sides: as high over a polygon's plane a point is in it */

/* Keep what lies above the horizon, n . v >= 0: at most one corner more. */
static inline int polygon_clip(lmb_vec3 out[POLYGON_CORNERS + 1], const lmb_vec3 *corner, int corners, lmb_vec3 n)
{
    int count = 0;
    for (int i = 0; i < corners; ++i) {
        lmb_vec3 a = corner[i], b = corner[i + 1 < corners ? i + 1 : 0];
        float ha = dot3(n, a), hb = dot3(n, b);
        if (ha >= 0.0f && count <= POLYGON_CORNERS) {
            out[count++] = a;
        }
        if ((ha >= 0.0f) != (hb >= 0.0f) && count <= POLYGON_CORNERS) {
            out[count++] = add3(a, mul3(sub3(b, a), ha / (ha - hb)));
        }
    }
    return count;
}

/* polygon_vector: the form factor of a triangle along each axis, with its sign: that along any direction is the dot
 * product. Corners go round `axis`, its normal; clipped to the horizon of `face`. */
static inline lmb_vec3 polygon_vector(lmb_vec3 at, lmb_vec3 face, const lmb_vec3 triangle[3], lmb_vec3 axis)
{
    lmb_vec3 own[3], corner[POLYGON_CORNERS + 1], sum = vec3(0.0f, 0.0f, 0.0f);
    float reach2 = 0.0f;
    for (int i = 0; i < 3; ++i) {
        own[i] = sub3(triangle[i], at);
        reach2 = maxf(reach2, dot3(sub3(own[i], own[0]), sub3(own[i], own[0])));
    }
    if (!(-dot3(axis, own[0]) > POLYGON_FLAT * sqrtf(reach2))) {
        return sum;
    }
    const int n = polygon_clip(corner, own, 3, face);
    for (int i = 0; i < n; ++i) {
        const lmb_vec3 a = corner[i], b = corner[i + 1 < n ? i + 1 : 0], edge = cross3(a, b);
        const float sine = length3(edge);
        if (sine > 1e-18f) {
            const float angle = lmb_atan2(sine, dot3(a, b));
            sum = add3(sum, vec3(angle * (edge.x / sine), angle * (edge.y / sine), angle * (edge.z / sine)));
        }
    }
    return mul3(sum, -0.15915494f);
}

#endif
