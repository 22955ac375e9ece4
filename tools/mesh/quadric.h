/* quadric.h: sums of squared distances to planes (Garland and Heckbert 1997), and their minimum. */
#ifndef QUADRIC_H
#define QUADRIC_H

#include "../common/dvec.h"

/* Error at p: p'A p + 2 b'p + c, weight times square metres. The rounding error equals a distance of 1e-8 times the
 * distance to the origin: less than that of the binary32 input positions. */
typedef struct quadric {
    double xx, xy, xz, yy, yz, zz; /* A */
    dvec b;
    double c;
} quadric;

/* weight (normal'p - normal'on)^2; normal of unit length. */
static inline quadric quadric_plane(dvec normal, dvec on, double weight)
{
    const double d = -dvec_dot(normal, on);
    const dvec n = dvec_mul(normal, weight);
    quadric q;
    q.xx = n.x * normal.x;
    q.xy = n.x * normal.y;
    q.xz = n.x * normal.z;
    q.yy = n.y * normal.y;
    q.yz = n.y * normal.z;
    q.zz = n.z * normal.z;
    q.b = dvec_mul(n, d);
    q.c = weight * d * d;
    return q;
}

static inline quadric quadric_sum(quadric p, quadric q)
{
    p.xx += q.xx;
    p.xy += q.xy;
    p.xz += q.xz;
    p.yy += q.yy;
    p.yz += q.yz;
    p.zz += q.zz;
    p.b = dvec_add(p.b, q.b);
    p.c += q.c;
    return p;
}

/* A p */
static inline dvec quadric_turned(quadric q, dvec p)
{
    return dvec_of(q.xx * p.x + q.xy * p.y + q.xz * p.z, q.xy * p.x + q.yy * p.y + q.yz * p.z,
                   q.xz * p.x + q.yz * p.y + q.zz * p.z);
}

/* Rounding may make it negative, and a NaN would break the heap: both become 0. */
static inline double quadric_error(quadric q, dvec p)
{
    const double e = dvec_dot(quadric_turned(q, p), p) + 2 * dvec_dot(q.b, p) + q.c;
    return e > 0 ? e : 0;
}

static inline double quadric_trace(quadric q) { return q.xx + q.yy + q.zz; }

/* Adds the squared distance to `to`, which pulls the minimum there as far as the planes leave it free. */
static inline quadric quadric_drawn(quadric q, dvec to, double weight)
{
    q.xx += weight;
    q.yy += weight;
    q.zz += weight;
    q.b = dvec_sub(q.b, dvec_mul(to, weight));
    q.c += weight * dvec_dot(to, to);
    return q;
}

/* Finds the minimum of a positive definite q by LDL'. Solves for the step from `near`, so that positions far from
 * the origin lose no digits. Returns 0: not definite. */
static inline int quadric_min(dvec *min, quadric q, dvec near)
{
    const dvec g = dvec_add(quadric_turned(q, near), q.b);
    const double l10 = q.xy / q.xx, l20 = q.xz / q.xx;
    const double d1 = q.yy - l10 * q.xy, l21 = (q.yz - l20 * q.xy) / d1;
    const double d2 = q.zz - l20 * q.xz - l21 * l21 * d1;
    double x, y, z;
    if (!(q.xx > 0 && d1 > 0 && d2 > 0))
        return 0;
    y = -g.y + l10 * g.x;
    z = (-g.z + l20 * g.x - l21 * y) / d2;
    y = y / d1 - l21 * z;
    x = -g.x / q.xx - l10 * y - l20 * z;
    *min = dvec_add(near, dvec_of(x, y, z));
    return 1;
}

#endif
