/* counted_alloc.h: memory from the heap, counted. */
#ifndef COUNTED_ALLOC_H
#define COUNTED_ALLOC_H

#include <stdint.h>
#include <stdlib.h>

typedef struct counted_heap {
    uint64_t bytes, highest; /* held; the most that was held at once */
} counted_heap;

static inline void counted_add(counted_heap *t, uint64_t bytes)
{
    t->bytes += bytes;
    if (t->bytes > t->highest)
        t->highest = t->bytes;
}

/* count * size zeroed bytes, at least one; NULL where there is no memory. */
static inline void *counted_alloc(counted_heap *t, uint64_t count, size_t size)
{
    void *p = count < SIZE_MAX / size ? calloc(count ? (size_t)count : 1, size) : NULL;
    if (p)
        counted_add(t, count * size);
    return p;
}

static inline void counted_free(counted_heap *t, void *p, uint64_t count, size_t size)
{
    if (p)
        t->bytes -= count * size;
    free(p);
}

#endif
