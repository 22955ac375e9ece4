/* polygon.c: the exact form factor from a point to a quad, clipped to the point's horizon. Floor 6.
 *
 * Lambert (1760): E = B / 2 sum over edges of angle x (n . edge normal), the edge's plane through the point. Divided by
 * pi B here, and by the quad's area: W/m2 a watt of flux. */
#include <lambent/bounce.h>

#include "../base/poly.h"
#include "../base/vec.h"

#define FLAT 1e-3f /* of the quad's half sides */

/* Keep what lies above the horizon, n . v >= 0: at most one corner more. */
static int clip_horizon(lmb_vec3 out[5], const lmb_vec3 quad[4], lmb_vec3 n)
{
    int count = 0;
    for (int i = 0; i < 4; ++i) {
        lmb_vec3 a = quad[i], b = quad[(i + 1) & 3];
        float ha = dot3(n, a), hb = dot3(n, b);
        if (ha >= 0.0f && count < 5) {
            out[count++] = a;
        }
        if ((ha >= 0.0f) != (hb >= 0.0f) && count < 5) {
            out[count++] = add3(a, mul3(sub3(b, a), ha / (ha - hb)));
        }
    }
    return count;
}

float lmb_quad_factor(lmb_vec3 at, lmb_vec3 face, lmb_vec3 normal, lmb_vec3 centre, lmb_vec3 axis, lmb_vec3 u,
                      lmb_vec3 v)
{
    lmb_vec3 c = sub3(centre, at), side = cross3(u, v), corner[5], quad[4];
    float area = 4.0f * length3(side), height = -dot3(axis, c), sum = 0.0f;
    /* A point in the quad's own plane sees its edge. Rounding must not lift it: the factor would jump to 1 / area. */
    if (!(height > FLAT * (length3(u) + length3(v))) || !(area > 0.0f)) {
        return 0.0f;
    }
    quad[0] = sub3(sub3(c, u), v);
    quad[1] = sub3(add3(c, u), v);
    quad[2] = add3(add3(c, u), v);
    quad[3] = add3(sub3(c, u), v);
    int n = clip_horizon(corner, quad, face);
    for (int i = 0; i < n; ++i) {
        lmb_vec3 a = corner[i], b = corner[i + 1 < n ? i + 1 : 0], edge = cross3(a, b);
        float sine = length3(edge);
        if (sine > 1e-18f) {
            sum += lmb_atan2(sine, dot3(a, b)) * (dot3(normal, edge) / sine);
        }
    }
    sum = dot3(side, axis) < 0.0f ? sum : -sum; /* the way round that the corners go, seen from the point */
    return maxf(sum, 0.0f) * 0.15915494f / area;
}
