/* edge_heap.h: the edges of a mesh, the cheapest first. */
#ifndef EDGE_HEAP_H
#define EDGE_HEAP_H

#include <stdint.h>

/* Orders by cost, then by vertices, then by stamp. No two entries are equal, so the pop order depends on nothing
 * else. */
typedef struct heap_edge {
    double cost; /* no NaN */
    uint32_t a, b, stamp;
} heap_edge;

/* An array that you provide. */
typedef struct edge_heap {
    heap_edge *edges;
    uint32_t count, cap;
} edge_heap;

int edge_is_before(const heap_edge *e, const heap_edge *f);

/* edge_heap_push: count < cap. */
void edge_heap_push(edge_heap *h, heap_edge e);

/* edge_heap_pop: count > 0. */
heap_edge edge_heap_pop(edge_heap *h);

/* edge_heap_order: makes a heap after you filled `edges` and `count`. */
void edge_heap_order(edge_heap *h);

#endif
