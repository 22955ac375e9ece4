/* relight_samples.h: reduces an object to few vertices and the triangles between them. */
#ifndef RELIGHT_SAMPLES_H
#define RELIGHT_SAMPLES_H

#include "relight_hidden.h"

enum { SAMPLES_MAX = 4096 /* an object with more vertices is reduced to about this many */ };

/* samples_take: chooses the parts' samples and sets the weights of each vertex's nearest ones. The parts must have
 * their vertices. If all vertices fit, each is a sample and there is no proxy. Returns 1, or 0 if memory is short. */
int samples_take(hidden *inout);

#endif
