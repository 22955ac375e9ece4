/* enclose.h: moves a simple mesh outwards until another one is inside it. */
#ifndef ENCLOSE_H
#define ENCLOSE_H

#include "../common/counted_alloc.h"
#include "simplify.h"

/* mesh_enclose: moves the vertices of `simple` outwards until those of `inner` lie inside or on it; open borders move
 * outwards as well. Faces of both must be turned outwards. Vertices may still stick out if their part of `inner` has no
 * counterpart in `simple`, or is not the one that is nearest.
 *
 *   simple   finite positions, one vertex per position, as simplify_mesh makes it (if you ask for as many triangles
 *            as there are, it only welds); unchanged if it has no triangles
 *   outside  receives the largest distance that a vertex of `inner` sticks out in the end, metres
 *
 * Returns 0: no memory. */
int mesh_enclose(triangle_mesh *simple, const triangle_mesh *inner, double *outside, counted_heap *t);

/* mesh_outside: only measures how far a vertex of `inner` sticks out. */
int mesh_outside(triangle_mesh *simple, const triangle_mesh *inner, double *outside, counted_heap *t);

#endif
