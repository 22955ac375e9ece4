/* plane_fit.c: least squares of inverse distances over a picture. Layer 6.                                  [M2 M4]
 *
 * A plane n . p = d seen along (x, y, -1) is at inverse distance (n.x x + n.y y - n.z) / d, which is affine in the ray.
 * So the fit has three unknowns and solves two equations and a mean. It needs no eigenvectors, and the noise is uniform
 * (lmb_cloud). */
#include "plane_fit.h"

#if LMB_MIXED

void lmb_plane_fit_join(plane_fit *into, const plane_fit *from)
{
    into->w += from->w;
    into->x += from->x;
    into->y += from->y;
    into->xx += from->xx;
    into->xy += from->xy;
    into->yy += from->yy;
    into->q += from->q;
    into->xq += from->xq;
    into->yq += from->yq;
}

int lmb_plane_fit_solve(float slope[3], const plane_fit *f)
{
    if (!(f->w > 0.0f)) {
        return 0;
    }
    const float i = 1.0f / f->w, x = f->x * i, y = f->y * i, q = f->q * i;
    const float xx = f->xx * i - x * x, yy = f->yy * i - y * y, xy = f->xy * i - x * y;
    const float xq = f->xq * i - x * q, yq = f->yq * i - y * q, det = xx * yy - xy * xy;
    if (!(det > 1e-4f * (xx + yy) * (xx + yy)) || !(xx + yy > 1e-12f)) {
        return 0; /* the points form a strip a hundred times as long as wide */
    }
    slope[0] = (xq * yy - yq * xy) / det;
    slope[1] = (yq * xx - xq * xy) / det;
    slope[2] = f->q0 + q - slope[0] * (f->x0 + x) - slope[1] * (f->y0 + y);
    return 1;
}

lmb_vec3 lmb_plane_normal(float *distance, const float slope[3])
{
    const lmb_vec3 n = vec3(-slope[0], -slope[1], slope[2]);
    const float length = length3(n);
    *distance = length > 1e-9f ? 1.0f / length : 1e9f;
    return mul3(n, *distance);
}

#endif
