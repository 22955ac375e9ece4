/* polygon.h: helpers of the form factors of polygons. Layer 5. */
#ifndef POLYGON_H
#define POLYGON_H

#include "../base/poly.h"
#include "../base/vec.h"

enum { POLYGON_CORNERS = LMB_TREES ? 8 : 4 };
#define POLYGON_FLAT 1e-3f /* of the half sides: a point closer to a polygon's plane counts as in the plane */
#define POLYGON_BENT 0.9f  /* cosine of 26 degrees: neighbouring facets of a curved surface are bent by less */

/* Distance (m) by which a polygon is moved back from a point closer to its plane than `min_height`; below 0: no light.
 *
 * A surface that is parallel to the polygon lies in the polygon's plane. Rounding must not lift it out on either side,
 * because the form factor would jump to 1. The same holds if the polygon's centre is below the point's horizon, as
 * beyond a convex edge. A point on a concave edge gets the light of a point `min_height` above the plane. Small builds
 * give it no light, to save code. */
static inline float polygon_back(float height, float min_height, lmb_vec3 face, lmb_vec3 axis, lmb_vec3 middle)
{
    if (height > min_height) {
        return 0.0f;
    }
    return LMB_TREES && height > 0.0f && absf(dot3(face, axis)) < POLYGON_BENT && dot3(face, middle) > 0.0f
               ? min_height - height
               : -1.0f;
}

/* Corners relative to the point, moved back until it is at least `min_height` above their plane. Returns 0 if the point
 * gets no light. */
static inline int polygon_corners(lmb_vec3 *out, lmb_vec3 at, lmb_vec3 face, const lmb_vec3 *corner, int corners,
                                  float min_height, lmb_vec3 axis)
{
    lmb_vec3 sum = vec3(0, 0, 0);
    for (int i = 0; i < corners; ++i) {
        out[i] = sub3(corner[i], at);
        sum = add3(sum, out[i]);
    }
    const float back = polygon_back(-dot3(axis, out[0]), min_height, face, axis, sum);
    for (int i = 0; back > 0.0f && i < corners; ++i) {
        out[i] = sub3(out[i], mul3(axis, back));
    }
    return back >= 0.0f;
}


/* Keep the part above the horizon, n . v >= 0. It has at most one corner more. */
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

#endif
