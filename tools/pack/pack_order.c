/* pack_order.c: reorders triangles so that few vertices are fetched twice.
 *
 * Emits all triangles around one vertex, then those around another vertex still in the cache: Sander, Nehab and Barczak
 * 2007. Time is linear in the number of triangles. */
#include <stdlib.h>
#include <string.h>

#include "pack.h"

enum { CACHE = 16 };

typedef struct orderer {
    const uint32_t *index;
    uint32_t *first, *around; /* by vertex: the triangles around it */
    uint32_t *left;           /* by vertex: triangles not yet emitted */
    uint32_t *stamp;          /* by vertex: time at which it entered the cache */
    uint32_t *ended;          /* stack of vertices met */
    uint8_t *is_put;          /* by triangle */
    uint32_t vertices, triangles, time, ends, cursor;
} orderer;

static void find_around(orderer *o)
{
    for (uint32_t i = 0; i < 3 * o->triangles; ++i) {
        ++o->left[o->index[i]];
    }
    for (uint32_t v = 0, at = 0; v < o->vertices; ++v) {
        o->first[v] = at;
        at += o->left[v];
        o->left[v] = 0;
    }
    for (uint32_t i = 0; i < 3 * o->triangles; ++i) {
        const uint32_t v = o->index[i];
        o->around[o->first[v] + o->left[v]++] = i / 3;
    }
}

/* The next vertex: from the last fan, the one longest in the cache that stays there for all triangles around it; else
 * one from the stack, else any. UINT32_MAX: done. */
static uint32_t next_vertex(orderer *o, uint32_t from)
{
    uint32_t best = UINT32_MAX, oldest = 0;
    for (uint32_t i = from; i < o->ends; ++i) {
        const uint32_t v = o->ended[i], age = o->time - o->stamp[v];
        const uint32_t priority = age + 2 * o->left[v] <= CACHE ? age + 1 : 1;
        if (o->left[v] > 0 && priority > oldest) {
            oldest = priority;
            best = v;
        }
    }
    while (best == UINT32_MAX && o->ends > 0) {
        const uint32_t v = o->ended[--o->ends];
        best = o->left[v] > 0 ? v : best;
    }
    for (; best == UINT32_MAX && o->cursor < o->vertices; ++o->cursor) {
        best = o->left[o->cursor] > 0 ? o->cursor : best;
    }
    return best;
}

static void put_all(orderer *o, uint32_t *out)
{
    uint32_t *to = out;
    for (uint32_t v = next_vertex(o, 0); v != UINT32_MAX;) {
        const uint32_t from = o->ends, past = o->first[v + 1];
        for (uint32_t i = o->first[v]; i < past; ++i) {
            const uint32_t t = o->around[i];
            for (int k = 0; k < 3 && !o->is_put[t]; ++k) {
                const uint32_t corner = o->index[3 * t + (uint32_t)k];
                *to++ = corner;
                --o->left[corner];
                o->ended[o->ends++] = corner;
                if (o->time - o->stamp[corner] > CACHE) {
                    o->stamp[corner] = o->time++;
                }
            }
            o->is_put[t] = 1;
        }
        v = next_vertex(o, from);
    }
}

int pack_order(uint32_t *index, uint32_t triangles, uint32_t vertices)
{
    const size_t corners = 3 * (size_t)triangles, n = (size_t)vertices + 1;
    uint32_t *memory = calloc(3 * n + 3 * corners + 1, sizeof *memory);
    uint8_t *is_put = calloc((size_t)triangles + 1, 1);
    orderer o;
    memset(&o, 0, sizeof o);
    if (memory != NULL && is_put != NULL && triangles > 0) {
        o.index = index;
        o.first = memory;
        o.left = o.first + n;
        o.stamp = o.left + n;
        o.around = o.stamp + n;
        o.ended = o.around + corners;
        uint32_t *out = o.ended + corners;
        o.is_put = is_put;
        o.vertices = vertices;
        o.triangles = triangles;
        o.time = CACHE + 1;
        find_around(&o);
        o.first[vertices] = (uint32_t)corners;
        put_all(&o, out);
        memcpy(index, out, corners * sizeof *index);
    }
    const int ok = memory != NULL && is_put != NULL;
    free(memory);
    free(is_put);
    return ok;
}

uint64_t pack_fetched(const uint32_t *index, uint32_t triangles, uint32_t *scratch, uint32_t vertices)
{
    uint32_t time = CACHE + 1;
    memset(scratch, 0, (size_t)vertices * sizeof *scratch);
    for (size_t i = 0; i < 3 * (size_t)triangles; ++i) {
        if (time - scratch[index[i]] > CACHE) {
            scratch[index[i]] = time++;
        }
    }
    return time - (CACHE + 1);
}
