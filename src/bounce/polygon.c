/* polygon.c: the exact form factor from a point to a quad or triangle, clipped to the point's horizon. Layer 6.
 *
 * Lambert (1760): E = B / 2 sum over edges of angle x (n . edge normal), the edge's plane through the point. Divided by
 * pi B here, and by the polygon's area: W/m2 a watt of flux. */
#include <lambent/bounce.h>

#include "../base/poly.h"
#include "../base/vec.h"

enum { CORNERS = LMB_TREES ? 8 : 4 };
#define FLAT 1e-3f /* of the half sides */
#define BENT 0.9f  /* cosine of 26 degrees: the next facet of a curve is bent less than that */

/* How far a polygon is moved back from a point that is closer than `min_height` to the plane, m; below 0: no light.
 *
 * A surface that is parallel to the polygon lies in its plane, on either side, and rounding must not lift it out: the
 * form factor would jump to 1. Nor may rounding do that if the polygon's middle is below the point's horizon, as beyond a
 * convex edge. A point on a concave edge gets the light that a point `min_height` above the plane gets. */
static float distance_back(float height, float min_height, lmb_vec3 face, lmb_vec3 axis, lmb_vec3 middle)
{
    if (height > min_height) {
        return 0.0f;
    }
    return height > 0.0f && absf(dot3(face, axis)) < BENT && dot3(face, middle) > 0.0f ? min_height - height : -1.0f;
}

/* Keep what lies above the horizon, n . v >= 0: at most one corner more. */
static int clip_horizon(lmb_vec3 out[CORNERS + 1], const lmb_vec3 *corner, int corners, lmb_vec3 n)
{
    int count = 0;
    for (int i = 0; i < corners; ++i) {
        lmb_vec3 a = corner[i], b = corner[i + 1 < corners ? i + 1 : 0];
        float ha = dot3(n, a), hb = dot3(n, b);
        if (ha >= 0.0f && count <= CORNERS) {
            out[count++] = a;
        }
        if ((ha >= 0.0f) != (hb >= 0.0f) && count <= CORNERS) {
            out[count++] = add3(a, mul3(sub3(b, a), ha / (ha - hb)));
        }
    }
    return count;
}

/* 2 pi x the form factor of a convex polygon, corners relative to the point; negative one way round. */
static float edges_sum(const lmb_vec3 *polygon, int corners, lmb_vec3 face, lmb_vec3 normal)
{
    lmb_vec3 corner[CORNERS + 1];
    float sum = 0.0f;
    const int n = clip_horizon(corner, polygon, corners, face);
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
    const float back = distance_back(-dot3(axis, c), FLAT * (length3(u) + length3(v)), face, axis, c);
    if (!(back >= 0.0f) || !(area > 0.0f)) {
        return 0.0f;
    }
    c = sub3(c, mul3(axis, back));
    quad[0] = sub3(sub3(c, u), v);
    quad[1] = sub3(add3(c, u), v);
    quad[2] = add3(add3(c, u), v);
    quad[3] = add3(sub3(c, u), v);
    float sum = edges_sum(quad, 4, face, normal);
    sum = dot3(side, axis) < 0.0f ? sum : -sum; /* the way round that the corners go, seen from the point */
    return maxf(sum, 0.0f) * 0.15915494f / area;
}

#if LMB_TREES
/* Corners relative to a point that is at min_height `min_height` above their plane; 0: the point gets no light. */
static int corners_from(lmb_vec3 *out, lmb_vec3 at, lmb_vec3 face, const lmb_vec3 *corner, int corners, float min_height,
                        lmb_vec3 axis)
{
    lmb_vec3 sum = vec3(0, 0, 0);
    for (int i = 0; i < corners; ++i) {
        out[i] = sub3(corner[i], at);
        sum = add3(sum, out[i]);
    }
    const float back = distance_back(-dot3(axis, out[0]), min_height, face, axis, sum);
    for (int i = 0; back > 0.0f && i < corners; ++i) {
        out[i] = sub3(out[i], mul3(axis, back));
    }
    return back >= 0.0f;
}

float lmb_polygon_factor(lmb_vec3 at, lmb_vec3 face, lmb_vec3 normal, const lmb_vec3 *corner, int corners,
                         lmb_vec3 axis)
{
    lmb_vec3 own[CORNERS];
    float reach2 = 0.0f;
    if (corner == NULL || corners < 3 || corners > CORNERS) {
        return 0.0f;
    }
    for (int i = 1; i < corners; ++i) {
        reach2 = maxf(reach2, dot3(sub3(corner[i], corner[0]), sub3(corner[i], corner[0])));
    }
    if (!corners_from(own, at, face, corner, corners, FLAT * sqrtf(reach2), axis)) {
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
    if (!(area > 0.0f) || !corners_from(own, at, face, corner, 3, FLAT * sqrtf(area), axis)) {
        return 0.0f;
    }
    const float sum = edges_sum(own, 3, face, normal);
    return maxf(dot3(side, axis) < 0.0f ? sum : -sum, 0.0f) * 0.15915494f / area;
}
#endif
