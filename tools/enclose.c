/* enclose.c: for each vertex that sticks out, the nearest triangle is moved until it is reached. */
#include "enclose.h"

#include "triangle_tree.h"

#define ROUNDS 8         /* a round's moves change which triangle is nearest; later rounds find little */
#define UNUSED UINT32_MAX
#define ENOUGH 1e-6      /* of the mesh's size: what may stick out */

/* Towards `from`, so that the triangle's point n gets there with the least moves of its corners: a corner moves in
 * proportion to its weight. */
static void reach(triangle_mesh *m, const nearest *n, dvec step)
{
    const double *w = n->weight, all = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    int k;
    for (k = 0; k < 3; ++k) {
        float *p = m->positions + 3 * (size_t)m->indices[3 * (size_t)n->triangle + (size_t)k];
        const dvec to = dvec_add(dvec_read(p), dvec_mul(step, w[k] / all));
        p[0] = (float)to.x;
        p[1] = (float)to.y;
        p[2] = (float)to.z;
    }
}

static dvec place_on(const triangle_mesh *m, const nearest *n)
{
    dvec sum = dvec_of(0, 0, 0);
    int k;
    for (k = 0; k < 3; ++k)
        sum = dvec_add(sum, dvec_mul(dvec_read(m->positions + 3 * (size_t)m->indices[3 * (size_t)n->triangle + (size_t)k]),
                                     n->weight[k]));
    return sum;
}

/* Found for the vertices that triangles have: others, and what is not finite, get no triangle. */
static void mark_used(nearest *found, const triangle_mesh *inner)
{
    uint32_t i;
    for (i = 0; i < inner->vertex_count; ++i)
        found[i].triangle = UNUSED;
    for (i = 0; i < 3 * inner->triangle_count; ++i) {
        const dvec p = dvec_read(inner->positions + 3 * (size_t)inner->indices[i]);
        if (dvec_dot(p, p) < HUGE_VAL)
            found[inner->indices[i]].triangle = 0;
    }
}

/* How far sticks out what sticks out most. Where a triangle was moved for an earlier vertex, a later one near it needs
 * only the rest. */
static double round_of_moves(triangle_mesh *simple, const triangle_tree *tree, nearest *found, const triangle_mesh *inner)
{
    double most = 0;
    uint32_t v;
    uint32_t guess = 0;
    for (v = 0; v < inner->vertex_count; ++v)
        if (found[v].triangle != UNUSED) {
            found[v] = triangle_tree_nearest(tree, dvec_read(inner->positions + 3 * (size_t)v), guess);
            guess = found[v].triangle;
        }
    for (v = 0; v < inner->vertex_count; ++v) {
        const dvec p = dvec_read(inner->positions + 3 * (size_t)v), out = dvec_unit(dvec_sub(p, found[v].point));
        const double lack = dvec_dot(dvec_sub(p, place_on(simple, &found[v])), out);
        const double distance = sqrt(found[v].distance2);
        if (found[v].triangle == UNUSED || !(found[v].height > 0))
            continue;
        most = distance > most ? distance : most;
        if (lack > 0)
            reach(simple, &found[v], dvec_mul(out, lack));
    }
    return most;
}

static double size_of(const tree_box *b)
{
    return dvec_length(dvec_sub(dvec_read(b->high), dvec_read(b->low)));
}

int mesh_enclose(triangle_mesh *simple, const triangle_mesh *inner, double *outside, tally *t)
{
    triangle_tree tree;
    nearest *found = tally_take(t, inner->vertex_count, sizeof *found);
    const int ok = triangle_tree_build(&tree, simple, t) && found;
    int i;
    if (ok)
        mark_used(found, inner);
    *outside = 0;
    for (i = 0; ok && simple->triangle_count && i < ROUNDS; ++i) {
        *outside = round_of_moves(simple, &tree, found, inner);
        triangle_tree_fit(&tree);
        if (*outside <= ENOUGH * size_of(&tree.boxes[0]))
            break;
    }
    triangle_tree_free(&tree, t);
    tally_give(t, found, inner->vertex_count, sizeof *found);
    return ok;
}
