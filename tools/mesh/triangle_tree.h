/* triangle_tree.h: finds the point of a mesh nearest to another point. */
#ifndef TRIANGLE_TREE_H
#define TRIANGLE_TREE_H

#include "../common/dvec.h"
#include "../common/counted_alloc.h"
#include "simplify.h"

typedef struct tree_box {
    float low[3], high[3];
} tree_box;

/* A complete binary tree over `order`, halved along each box's longest side; box i's halves are 2 i + 1 and 2 i + 2. */
typedef struct triangle_tree {
    const triangle_mesh *mesh; /* not owned; if you move positions, call triangle_tree_fit */
    uint32_t *order;           /* triangles */
    tree_box *boxes;
    uint32_t levels, box_count;
} triangle_tree;

typedef struct nearest {
    double distance2; /* HUGE_VAL: the mesh is empty, or the other point not finite */
    double weight[3]; /* of the triangle's corners */
    dvec point;
    dvec normal;      /* there; at a corner or an edge a sum over the triangles, weighted by angle, not unit length */
    uint32_t triangle;
} nearest;

/* triangle_tree_build: returns 0: no memory. Positions must be finite. Call triangle_tree_free in any case. */
int triangle_tree_build(triangle_tree *tree, const triangle_mesh *mesh, counted_heap *t);

/* triangle_tree_fit: updates the boxes after positions moved. */
void triangle_tree_fit(triangle_tree *tree);

void triangle_tree_free(triangle_tree *tree, counted_heap *t);

/* triangle_tree_nearest: `guess` is a triangle that may be near, any number below triangle_count; a good guess makes
 * the search faster. */
nearest triangle_tree_nearest(const triangle_tree *tree, dvec from, uint32_t guess);

/* nearest_is_outside: the other point is in front of the surface. */
static inline int nearest_is_outside(const nearest *n, dvec from)
{
    return dvec_dot(n->normal, dvec_sub(from, n->point)) > 0;
}

#endif
