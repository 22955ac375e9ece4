/* hull_point.c: a quadratic programme of three unknowns, one plane after the other (Seidel 1991): if the best point so
 * far is beyond plane i, then the best one lies on plane i, and there the programme has an unknown less. */
#include "hull_point.h"

static double error_slope(quadric q, dvec at, dvec along) { return dvec_dot(dvec_add(quadric_turned(q, at), q.b), along); }

/* On the line of two planes, `on` + s * along. */
static int least_on_line(dvec *at, quadric q, dvec on, dvec along, const half_space *spaces, int count, double slack)
{
    double low = -HUGE_VAL, high = HUGE_VAL, s;
    int i;
    for (i = 0; i < count; ++i) {
        const double slope = dvec_dot(spaces[i].normal, along);
        const double need = spaces[i].least - dvec_dot(spaces[i].normal, on);
        if (slope > 1e-9 && need / slope > low)
            low = need / slope;
        else if (slope < -1e-9 && need / slope < high)
            high = need / slope;
        else if (slope >= -1e-9 && slope <= 1e-9 && need > slack)
            return 0;
    }
    if (low > high + slack)
        return 0;
    s = -error_slope(q, on, along) / dvec_dot(quadric_turned(q, along), along);
    s = s > low ? s : low;
    s = s < high ? s : high;
    *at = dvec_add(on, dvec_mul(along, s));
    return 1;
}

/* A unit vector across n. */
static dvec across(dvec n)
{
    const double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    return dvec_unit(dvec_cross(n, x <= y && x <= z ? dvec_of(1, 0, 0) : y <= z ? dvec_of(0, 1, 0) : dvec_of(0, 0, 1)));
}

static dvec least_in_plane(quadric q, dvec on, dvec u, dvec v)
{
    const dvec qu = quadric_turned(q, u), qv = quadric_turned(q, v);
    const double a = dvec_dot(qu, u), b = dvec_dot(qu, v), d = dvec_dot(qv, v);
    const double e = -error_slope(q, on, u), f = -error_slope(q, on, v), over = a * d - b * b;
    return dvec_add(on, dvec_add(dvec_mul(u, (e * d - b * f) / over), dvec_mul(v, (a * f - b * e) / over)));
}

static double shortage(half_space s, dvec p) { return s.least - dvec_dot(s.normal, p); }

/* On plane k, inside those before it. */
static int least_on_plane(dvec *at, quadric q, dvec near, const half_space *spaces, int k, double slack)
{
    const dvec n = spaces[k].normal, u = across(n), v = dvec_cross(n, u);
    int i;
    dvec p = least_in_plane(q, dvec_add(near, dvec_mul(n, shortage(spaces[k], near))), u, v);
    for (i = 0; i < k; ++i) {
        const double lack = shortage(spaces[i], p), cosine = dvec_dot(n, spaces[i].normal), sine2 = 1 - cosine * cosine;
        if (lack <= slack)
            continue;
        if (sine2 < 1e-12)
            return 0;
        /* From p along the plane, at a right angle to the line, until space i begins. */
        p = dvec_add(p, dvec_mul(dvec_sub(spaces[i].normal, dvec_mul(n, cosine)), lack / sine2));
        if (!least_on_line(&p, q, p, dvec_unit(dvec_cross(n, spaces[i].normal)), spaces, i, slack))
            return 0;
    }
    *at = p;
    return 1;
}

int hull_point(dvec *at, quadric q, dvec near, const half_space *spaces, int count, double slack)
{
    dvec p;
    int i;
    if (!quadric_least(&p, q, near))
        return 0;
    for (i = 0; i < count; ++i)
        if (shortage(spaces[i], p) > slack && !least_on_plane(&p, q, near, spaces, i, slack))
            return 0;
    for (i = 0; i < count; ++i)
        if (!(shortage(spaces[i], p) <= 4 * slack))
            return 0;
    *at = p;
    return 1;
}
