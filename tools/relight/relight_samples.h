/* relight_samples.h: few vertices of an object, and the triangles between them, in place of many. */
#ifndef RELIGHT_SAMPLES_H
#define RELIGHT_SAMPLES_H

#include "relight_hidden.h"

enum { SAMPLES_MAX = 4096 /* an object with more vertices is thinned to about as many */ };

/* samples_take: the parts' samples, and each vertex's share of those near it. Parts have their vertices. If all of them
 * fit, each is its own sample, and there is no proxy. 1, or 0: out of memory. */
int samples_take(hidden *inout);

#endif
