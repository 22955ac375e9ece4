/* ear_clip.c: cuts a planar polygon into triangles: a fan where it is convex, ears where it is not. */
#include "ear_clip.h"

#include <math.h>

/* The polygon seen along the axis that its normal follows best, counter-clockwise. */
typedef struct flat {
    const double *points;
    uint32_t n;
    int u, v;    /* the coordinates that stay */
    double area; /* twice */
} flat;

/* Newell's normal, from corner 0, so that a place far away costs no digits: twice the area of each projection. */
static void newell(double normal[3], const double *p, uint32_t n)
{
    uint32_t i;
    int k;
    normal[0] = normal[1] = normal[2] = 0;
    for (i = 1; i + 1 < n; ++i) {
        const double *q = p + 3 * (size_t)i;
        for (k = 0; k < 3; ++k) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            normal[k] += (q[u] - p[u]) * (q[3 + v] - p[v]) - (q[v] - p[v]) * (q[3 + u] - p[u]);
        }
    }
}

static flat flatten(const double *points, uint32_t n)
{
    double normal[3];
    flat f;
    int axis;
    newell(normal, points, n);
    axis = fabs(normal[0]) > fabs(normal[1]) ? 0 : 1;
    if (fabs(normal[2]) >= fabs(normal[axis]))
        axis = 2;
    f.points = points;
    f.n = n;
    f.area = fabs(normal[axis]);
    f.u = normal[axis] < 0 ? (axis + 2) % 3 : (axis + 1) % 3;
    f.v = normal[axis] < 0 ? (axis + 1) % 3 : (axis + 2) % 3;
    return f;
}

/* Twice the signed area of three corners: positive is a left turn at b. */
static double turn(const flat *f, uint32_t a, uint32_t b, uint32_t c)
{
    const double *pa = f->points + 3 * (size_t)a, *pb = f->points + 3 * (size_t)b, *pc = f->points + 3 * (size_t)c;
    return (pb[f->u] - pa[f->u]) * (pc[f->v] - pa[f->v]) - (pb[f->v] - pa[f->v]) * (pc[f->u] - pa[f->u]);
}

/* 1e-9 of the area is rounding, not a dent; a NaN is no dent either. */
static int is_concave(const flat *f)
{
    uint32_t i;
    for (i = 0; i < f->n; ++i)
        if (turn(f, i, (i + 1) % f->n, (i + 2) % f->n) < -1e-9 * f->area)
            return 1;
    return 0;
}

static int same_place(const flat *f, uint32_t a, uint32_t b)
{
    const double *pa = f->points + 3 * (size_t)a, *pb = f->points + 3 * (size_t)b;
    return pa[f->u] == pb[f->u] && pa[f->v] == pb[f->v];
}

/* Is corner b of the remaining ring an ear: a left turn whose triangle holds no other corner? Corners in the same
 * place (bridges to holes) do not count. */
static int is_ear(const flat *f, const uint32_t *next, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t p;
    if (!(turn(f, a, b, c) > 0))
        return 0;
    for (p = next[c]; p != a; p = next[p]) {
        if (same_place(f, p, a) || same_place(f, p, b) || same_place(f, p, c))
            continue;
        if (turn(f, a, b, p) >= 0 && turn(f, b, c, p) >= 0 && turn(f, c, a, p) >= 0)
            return 0;
    }
    return 1;
}

/* A ring without an ear (it crosses itself, or rounding) loses its next corner all the same, so this ends. */
static void cut_ears(uint32_t *out, const flat *f, uint32_t *links)
{
    uint32_t *next = links, *prev = links + f->n, left = f->n, at = 0, tried = 0, i;
    for (i = 0; i < f->n; ++i) {
        next[i] = (i + 1) % f->n;
        prev[i] = (i + f->n - 1) % f->n;
    }
    while (left > 3) {
        if (tried < left && !is_ear(f, next, prev[at], at, next[at])) {
            at = next[at];
            ++tried;
            continue;
        }
        *out++ = prev[at];
        *out++ = at;
        *out++ = next[at];
        next[prev[at]] = next[at];
        prev[next[at]] = prev[at];
        at = next[next[at]]; /* not the neighbour: slivers around one corner */
        --left;
        tried = 0;
    }
    *out++ = prev[at];
    *out++ = at;
    *out = next[at];
}

int polygon_cut(uint32_t *out, const double *points, uint32_t n, uint32_t *links)
{
    const flat f = flatten(points, n);
    const int concave = n > 3 && is_concave(&f);
    uint32_t i;
    if (concave && n <= POLYGON_MAX_CONCAVE) {
        cut_ears(out, &f, links);
        return 1;
    }
    for (i = 1; i + 1 < n; ++i) {
        *out++ = 0;
        *out++ = i;
        *out++ = i + 1;
    }
    return !concave;
}
