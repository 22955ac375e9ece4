/* ear_clip.c: cuts a planar polygon into triangles: a fan if it is convex, otherwise ears. */
#include "ear_clip.h"

#include <math.h>
#include <string.h>

/* The polygon projected along the largest axis of the normal, counter-clockwise. */
typedef struct flat {
    const double *points;
    uint32_t n;
    int u, v;    /* the remaining coordinates */
    double area; /* twice */
} flat;

/* Newell's normal, relative to corner 0, so that distant positions lose no digits: twice the area of each
 * projection. */
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

/* The corners that remain. */
typedef struct ring {
    const flat *f;
    uint32_t *next, *prev, left;
    uint64_t steps;                    /* comparisons of a corner with a triangle that may still be made */
    uint8_t dull[POLYGON_MAX_CONCAVE]; /* is no ear; tested again only after a cut beside it */
} ring;

/* Returns whether corner p lies in the triangle. A corner at the position of another (bridges to holes) does not
 * count. */
static int holds(const flat *f, uint32_t a, uint32_t b, uint32_t c, uint32_t p)
{
    return turn(f, a, b, p) >= 0 && turn(f, b, c, p) >= 0 && turn(f, c, a, p) >= 0 && !same_place(f, p, a) &&
           !same_place(f, p, b) && !same_place(f, p, c);
}

/* Returns whether corner b is an ear: a left turn, and no other corner in the triangle. */
static int is_ear(ring *r, uint32_t b)
{
    const uint32_t a = r->prev[b], c = r->next[b];
    uint32_t p;
    if (!(turn(r->f, a, b, c) > 0))
        return 0;
    for (p = r->next[c]; p != a && r->steps > 0; p = r->next[p], --r->steps)
        if (holds(r->f, a, b, c, p))
            return 0;
    return 1;
}

/* Finds the first ear from `at` on. If a ring has none (it crosses itself, or by rounding, or no steps are left),
 * the next corner is cut anyway, so the loop ends. Corners are tested twice, because a cut may have removed the
 * corner in the way. */
static uint32_t find_ear(ring *r, uint32_t at)
{
    uint32_t round, tried;
    for (round = 0; round < 2 && r->steps > 0; ++round) {
        for (tried = 0; tried < r->left; ++tried, at = r->next[at]) {
            if (!r->dull[at] && is_ear(r, at))
                return at;
            r->dull[at] = 1;
        }
        memset(r->dull, 0, sizeof r->dull);
    }
    return at;
}

/* A simple polygon takes about n^2 steps; the limit is twice that, or the steps that are left. Returns 1 if they
 * sufficed. */
static int cut_ears(uint32_t *out, const flat *f, uint32_t *links, uint64_t *steps)
{
    const uint64_t max = 2 * (uint64_t)f->n * f->n < *steps ? 2 * (uint64_t)f->n * f->n : *steps;
    ring r;
    uint32_t at = 0, i;
    memset(&r, 0, sizeof r);
    r.f = f;
    r.next = links;
    r.prev = links + f->n;
    r.left = f->n;
    r.steps = max;
    for (i = 0; i < f->n; ++i) {
        r.next[i] = (i + 1) % f->n;
        r.prev[i] = (i + f->n - 1) % f->n;
    }
    for (; r.left > 3; --r.left) {
        at = find_ear(&r, at);
        *out++ = r.prev[at];
        *out++ = at;
        *out++ = r.next[at];
        r.dull[r.prev[at]] = r.dull[r.next[at]] = 0;
        r.next[r.prev[at]] = r.next[at];
        r.prev[r.next[at]] = r.prev[at];
        at = r.next[r.next[at]]; /* not the neighbour: slivers around one corner */
    }
    *out++ = r.prev[at];
    *out++ = at;
    *out = r.next[at];
    *steps -= max - r.steps;
    return r.steps > 0;
}

int polygon_cut(uint32_t *out, const double *points, uint32_t n, uint32_t *links)
{
    uint64_t steps = UINT64_MAX;
    return polygon_cut_within(out, points, n, links, &steps);
}

int polygon_cut_within(uint32_t *out, const double *points, uint32_t n, uint32_t *links, uint64_t *steps)
{
    const flat f = flatten(points, n);
    const int concave = n > 3 && is_concave(&f);
    uint32_t i;
    if (concave && n <= POLYGON_MAX_CONCAVE)
        return cut_ears(out, &f, links, steps);
    for (i = 1; i + 1 < n; ++i) {
        *out++ = 0;
        *out++ = i;
        *out++ = i + 1;
    }
    return !concave;
}
