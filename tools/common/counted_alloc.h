/* counted_alloc.h: heap memory with a count of the bytes. */
#ifndef COUNTED_ALLOC_H
#define COUNTED_ALLOC_H

#include <stdint.h>
#include <stdlib.h>

typedef struct counted_heap {
    uint64_t bytes, highest; /* allocated now; the peak */
} counted_heap;

static inline void counted_add(counted_heap *t, uint64_t bytes)
{
    t->bytes += bytes;
    if (t->bytes > t->highest)
        t->highest = t->bytes;
}

/* counted_alloc: returns count * size zeroed bytes, at least one; NULL if memory is short. */
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
