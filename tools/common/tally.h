/* tally.h: memory from the heap, counted. */
#ifndef TALLY_H
#define TALLY_H

#include <stdint.h>
#include <stdlib.h>

typedef struct tally {
    uint64_t bytes, highest; /* held; the most that was held at once */
} tally;

static inline void tally_add(tally *t, uint64_t bytes)
{
    t->bytes += bytes;
    if (t->bytes > t->highest)
        t->highest = t->bytes;
}

/* count * size zeroed bytes, at least one; NULL where there is no memory. */
static inline void *tally_take(tally *t, uint64_t count, size_t size)
{
    void *p = count < SIZE_MAX / size ? calloc(count ? (size_t)count : 1, size) : NULL;
    if (p)
        tally_add(t, count * size);
    return p;
}

static inline void tally_give(tally *t, void *p, uint64_t count, size_t size)
{
    if (p)
        t->bytes -= count * size;
    free(p);
}

#endif
