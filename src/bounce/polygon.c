/* polygon.c: the exact form factor from a point to a quad or triangle, clipped to the point's horizon. Layer 5.
 *
 * Lambert (1760): E = B / 2 sum over edges of angle x (n . edge normal), with the plane of an edge through the point.
 * Here divided by pi B and by the polygon's area: W/m2 per watt of flux. */
#include <lambent/bounce.h>

#include "polygon.h"

/* 2 pi x the form factor of a convex polygon, corners relative to the point; negative for one winding. */
static float edges_sum(const lmb_vec3 *polygon, int corners, lmb_vec3 face, lmb_vec3 normal)
{
    lmb_vec3 corner[POLYGON_CORNERS + 1];
    float sum = 0.0f;
    const int n = polygon_clip(corner, polygon, corners, face);
    for (int i = 0; i < n; ++i) {
        lmb_vec3 a = corner[i], b = corner[i + 1 < n ? i + 1 : 0], edge = cross3(a, b);
        float sine = length3(edge);
        if (sine > 1e-18f) {
            sum += lmb_atan2(sine, dot3(a, b)) * (dot3(normal, edge) / sine);
        }
    }
    return sum;
}

float lmb_quad_factor(lmb_vec3 at, lmb_vec3 face, lmb_vec3 normal, lmb_vec3 centre, lmb_vec3 axis, lmb_vec3 u,
                      lmb_vec3 v)
{
    lmb_vec3 c = sub3(centre, at), side = cross3(u, v), quad[4];
    const float area = 4.0f * length3(side);
    const float back = polygon_back(-dot3(axis, c), POLYGON_FLAT * (length3(u) + length3(v)), face, axis, c);
    if (!(back >= 0.0f) || !(area > 0.0f)) {
        return 0.0f;
    }
    if (LMB_TREES) {
        c = sub3(c, mul3(axis, back));
    }
    quad[0] = sub3(sub3(c, u), v);
    quad[1] = sub3(add3(c, u), v);
    quad[2] = add3(add3(c, u), v);
    quad[3] = add3(sub3(c, u), v);
    float sum = edges_sum(quad, 4, face, normal);
    sum = dot3(side, axis) < 0.0f ? sum : -sum; /* winding as seen from the point */
    return maxf(sum, 0.0f) * 0.15915494f / area;
}

#if LMB_TREES
float lmb_polygon_factor(lmb_vec3 at, lmb_vec3 face, lmb_vec3 normal, const lmb_vec3 *corner, int corners,
                         lmb_vec3 axis)
{
    lmb_vec3 own[POLYGON_CORNERS];
    float reach2 = 0.0f;
    if (corner == NULL || corners < 3 || corners > POLYGON_CORNERS) {
        return 0.0f;
    }
    for (int i = 1; i < corners; ++i) {
        reach2 = maxf(reach2, dot3(sub3(corner[i], corner[0]), sub3(corner[i], corner[0])));
    }
    if (!polygon_corners(own, at, face, corner, corners, POLYGON_FLAT * sqrtf(reach2), axis)) {
        return 0.0f;
    }
    return maxf(-edges_sum(own, corners, face, normal), 0.0f) * 0.15915494f;
}

float lmb_triangle_factor(lmb_vec3 at, lmb_vec3 face, lmb_vec3 normal, const lmb_vec3 corner[3], lmb_vec3 axis)
{
    lmb_vec3 own[3];
    if (corner == NULL) {
        return 0.0f;
    }
    const lmb_vec3 side = cross3(sub3(corner[1], corner[0]), sub3(corner[2], corner[0]));
    const float area = 0.5f * length3(side);
    if (!(area > 0.0f) || !polygon_corners(own, at, face, corner, 3, POLYGON_FLAT * sqrtf(area), axis)) {
        return 0.0f;
    }
    const float sum = edges_sum(own, 3, face, normal);
    return maxf(dot3(side, axis) < 0.0f ? sum : -sum, 0.0f) * 0.15915494f / area;
}

lmb_vec3 lmb_triangle_vector(lmb_vec3 at, lmb_vec3 face, const lmb_vec3 corner[3], lmb_vec3 axis)
{
    lmb_vec3 own[3], clipped[POLYGON_CORNERS + 1], sum = vec3(0.0f, 0.0f, 0.0f);
    float reach2 = 0.0f;
    if (corner == NULL) {
        return sum;
    }
    for (int i = 1; i < 3; ++i) {
        reach2 = maxf(reach2, dot3(sub3(corner[i], corner[0]), sub3(corner[i], corner[0])));
    }
    if (!polygon_corners(own, at, face, corner, 3, POLYGON_FLAT * sqrtf(reach2), axis)) {
        return sum;
    }
    const int n = polygon_clip(clipped, own, 3, face);
    for (int i = 0; i < n; ++i) {
        const lmb_vec3 a = clipped[i], b = clipped[i + 1 < n ? i + 1 : 0], edge = cross3(a, b);
        const float sine = length3(edge);
        if (sine > 1e-18f) {
            const float angle = lmb_atan2(sine, dot3(a, b));
            sum = add3(sum, vec3(angle * (edge.x / sine), angle * (edge.y / sine), angle * (edge.z / sine)));
        }
    }
    return mul3(sum, -0.15915494f);
}
#endif
