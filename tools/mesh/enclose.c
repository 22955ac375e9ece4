/* enclose.c: moves the nearest triangle of each vertex that sticks out, until it reaches the vertex. */
#include "enclose.h"

#include "triangle_tree.h"

#define UNUSED UINT32_MAX
#define ROUNDS 4    /* searches for the nearest triangles; more would gain little: two sides of a thin sheet that
                     * pass through each other would push each other apart */
#define SWEEPS 8    /* passes over the results of a search. The first take a part of the way, the last the whole */
#define STEP   0.15 /* many vertices at once overshoot by a tenth less */
#define ENOUGH 1e-6 /* of the mesh's size: may still stick out */

typedef struct sticker {
    nearest on;  /* on the simple mesh; triangle UNUSED: no triangle has the vertex, or it is not finite */
    dvec normal; /* of the faces at the vertex, by area */
} sticker;

static dvec vertex_of(const triangle_mesh *m, uint32_t v) { return dvec_read(m->positions + 3 * (size_t)v); }

static void find_normals(sticker *found, const triangle_mesh *inner)
{
    uint32_t i, k;
    for (i = 0; i < inner->vertex_count; ++i)
        found[i].on.triangle = UNUSED;
    for (i = 0; i < inner->triangle_count; ++i) {
        const uint32_t *v = inner->indices + 3 * (size_t)i;
        const dvec n = dvec_turn(vertex_of(inner, v[0]), vertex_of(inner, v[1]), vertex_of(inner, v[2]));
        if (!(dvec_dot(n, n) < HUGE_VAL))
            continue;
        for (k = 0; k < 3; ++k) {
            found[v[k]].normal = dvec_add(found[v[k]].normal, n);
            found[v[k]].on.triangle = 0;
        }
    }
}

/* Above the nearest triangle, and on the outside of the inner surface. If the vertex normal points back at the
 * triangle, the vertex belongs to the other side of a thin sheet, or to something inside. */
static int sticks_out(const sticker *s, dvec p)
{
    return s->on.triangle != UNUSED && nearest_is_outside(&s->on, p)
        && dvec_dot(s->normal, dvec_sub(p, s->on.point)) >= 0;
}

/* Finds the nearest triangle of each vertex. Returns the largest distance that a vertex sticks out. */
static double search(sticker *found, const triangle_tree *tree, const triangle_mesh *inner)
{
    double max = 0;
    uint32_t v, guess = 0;
    for (v = 0; v < inner->vertex_count; ++v) {
        const dvec p = vertex_of(inner, v);
        if (found[v].on.triangle == UNUSED)
            continue;
        found[v].on = triangle_tree_nearest(tree, p, guess);
        guess = found[v].on.triangle;
        if (sticks_out(&found[v], p) && found[v].on.distance2 > max)
            max = found[v].on.distance2;
    }
    return sqrt(max);
}

/* Moves a point of the triangle by `step` with the smallest moves of the corners: in proportion to their weights. */
static void move_point(triangle_mesh *m, const nearest *n, dvec step)
{
    const double *w = n->weight, all = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    int k;
    for (k = 0; k < 3; ++k) {
        const uint32_t v = m->indices[3 * (size_t)n->triangle + (size_t)k];
        dvec_write(m->positions + 3 * (size_t)v, dvec_add(vertex_of(m, v), dvec_mul(step, w[k] / all)));
    }
}

static dvec moved_point(const triangle_mesh *m, const nearest *n)
{
    const uint32_t *v = m->indices + 3 * (size_t)n->triangle;
    const dvec ab = dvec_add(dvec_mul(vertex_of(m, v[0]), n->weight[0]), dvec_mul(vertex_of(m, v[1]), n->weight[1]));
    return dvec_add(ab, dvec_mul(vertex_of(m, v[2]), n->weight[2]));
}

/* One projection after the other (Kaczmarz 1937): if a triangle has moved for one vertex, the next needs less. */
static void sweep(triangle_mesh *simple, const sticker *found, const triangle_mesh *inner, double step)
{
    uint32_t v;
    for (v = 0; v < inner->vertex_count; ++v) {
        const dvec p = vertex_of(inner, v), out = dvec_unit(dvec_sub(p, found[v].on.point));
        double lack;
        if (!sticks_out(&found[v], p))
            continue;
        lack = dvec_dot(dvec_sub(p, moved_point(simple, &found[v].on)), out);
        if (lack > 0)
            move_point(simple, &found[v].on, dvec_mul(out, lack * step));
    }
}

static double size_of(const tree_box *b) { return dvec_length(dvec_sub(dvec_read(b->high), dvec_read(b->low))); }

static int enclose(triangle_mesh *simple, const triangle_mesh *inner, double *outside, int rounds, counted_heap *t)
{
    triangle_tree tree;
    sticker *found = counted_alloc(t, inner->vertex_count, sizeof *found);
    const int ok = triangle_tree_build(&tree, simple, t) && found;
    int round, i;
    *outside = 0;
    if (ok && simple->triangle_count) {
        find_normals(found, inner);
        *outside = search(found, &tree, inner);
        for (round = 0; round < rounds && *outside > ENOUGH * size_of(&tree.boxes[0]); ++round) {
            for (i = 1; i <= SWEEPS; ++i)
                sweep(simple, found, inner, i < SWEEPS ? STEP : 1);
            triangle_tree_fit(&tree);
            *outside = search(found, &tree, inner);
        }
    }
    triangle_tree_free(&tree, t);
    counted_free(t, found, inner->vertex_count, sizeof *found);
    return ok;
}

int mesh_enclose(triangle_mesh *simple, const triangle_mesh *inner, double *outside, counted_heap *t)
{
    return enclose(simple, inner, outside, ROUNDS, t);
}

int mesh_outside(triangle_mesh *simple, const triangle_mesh *inner, double *outside, counted_heap *t)
{
    return enclose(simple, inner, outside, 0, t);
}
