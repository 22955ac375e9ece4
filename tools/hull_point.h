/* hull_point.h: where a quadric is least on the outer side of some planes. */
#ifndef HULL_POINT_H
#define HULL_POINT_H

#include "quadric.h"

typedef struct half_space {
    dvec normal; /* unit */
    double least; /* points p with normal'p >= least are inside */
} half_space;

/* hull_point: q positive definite; `slack`: metres by which a plane may be missed. 0: no such point. */
int hull_point(dvec *at, quadric q, dvec near, const half_space *spaces, int count, double slack);

#endif
