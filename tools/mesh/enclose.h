/* enclose.h: moves a simple mesh outwards until another one is inside it. */
#ifndef ENCLOSE_H
#define ENCLOSE_H

#include "../common/counted_alloc.h"
#include "simplify.h"

/* mesh_enclose: moves the vertices of `simple` so that those of `inner` come to lie inside or on it; where it has an
 * open border, the border moves outwards as well. Both have faces that are turned outwards. What is inner's alone, or
 * another part of it than the nearest one, may still stick out.
 *
 *   simple   finite positions, and one vertex in one place, as simplify_mesh makes it (with as many triangles as it
 *            gets, that only welds); stays as it is without triangles.
 *   outside  written: how far a vertex of `inner` sticks out in the end, metres.
 *
 * 0: no memory. */
int mesh_enclose(triangle_mesh *simple, const triangle_mesh *inner, double *outside, counted_heap *t);

/* mesh_outside: only says how far a vertex of `inner` sticks out. */
int mesh_outside(triangle_mesh *simple, const triangle_mesh *inner, double *outside, counted_heap *t);

#endif
