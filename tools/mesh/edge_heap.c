/* edge_heap.c: a binary heap over an array. */
#include "edge_heap.h"

int edge_is_before(const heap_edge *e, const heap_edge *f)
{
    if (e->cost < f->cost || e->cost > f->cost)
        return e->cost < f->cost;
    if (e->a != f->a)
        return e->a < f->a;
    return e->b != f->b ? e->b < f->b : e->stamp < f->stamp;
}

/* Puts e at i or further down. */
static void sink(edge_heap *h, uint32_t i, heap_edge e)
{
    for (;;) {
        uint64_t child = 2 * (uint64_t)i + 1;
        if (child + 1 < h->count && edge_is_before(&h->edges[child + 1], &h->edges[child]))
            ++child;
        if (child >= h->count || edge_is_before(&e, &h->edges[child]))
            break;
        h->edges[i] = h->edges[child];
        i = (uint32_t)child;
    }
    h->edges[i] = e;
}

void edge_heap_push(edge_heap *h, heap_edge e)
{
    uint32_t i = h->count++;
    while (i && edge_is_before(&e, &h->edges[(i - 1) / 2])) {
        h->edges[i] = h->edges[(i - 1) / 2];
        i = (i - 1) / 2;
    }
    h->edges[i] = e;
}

heap_edge edge_heap_pop(edge_heap *h)
{
    const heap_edge first = h->edges[0];
    if (--h->count)
        sink(h, 0, h->edges[h->count]);
    return first;
}

void edge_heap_order(edge_heap *h)
{
    uint32_t i;
    for (i = h->count / 2; i-- > 0;)
        sink(h, i, h->edges[i]);
}
