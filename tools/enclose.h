/* enclose.h: moves a simple mesh outwards until another one is inside it. */
#ifndef ENCLOSE_H
#define ENCLOSE_H

#include "simplify.h"
#include "tally.h"

/* mesh_enclose: moves the vertices of `simple` so that those of `inner` come to lie inside or on it; where it has an
 * open border, the border moves outwards as well. *outside: how far a vertex of `inner` still sticks out, metres.
 * Both have faces that are turned outwards and finite positions; `simple` without triangles stays. 0: no memory. */
int mesh_enclose(triangle_mesh *simple, const triangle_mesh *inner, double *outside, tally *t);

#endif
