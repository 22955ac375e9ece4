/* bake_code.c: rows of arriving light -> links, which encode the difference from the parents. */
#include "bake.h"

#include <stdlib.h>

#include "../../platform/host/pool.h"
#include "../common/fvec.h"

#define SHARE 0.25f /* share of a child's area that is added to the parents */
#define PARTS 1e-4f /* of all area: a receiver with this support has links of `error` each */

typedef struct coder {
    bake *b;
    uint8_t *target;
    size_t each;
    int axes;
    const uint32_t *order; /* of one generation */
    uint32_t own;          /* their number */
    bake_linker *linker[POOL_MAX];
    float *memory[POOL_MAX];
    uint8_t has_failed[POOL_MAX];
    report said[POOL_MAX];
} coder;

static bake_target *target_at(const coder *c, uint32_t i) { return (bake_target *)(void *)(c->target + i * c->each); }

/* Adds `times` the row predicted by the parents. */
static void add_parents(const coder *c, const bake_target *t, float *row, float times)
{
    const size_t n = (size_t)c->axes * c->b->set.elements;
    for (int k = 0; k < BAKE_PARENTS; ++k) {
        const float share = t->share[k] * times;
        const uint16_t *from = share != 0.0f ? target_at(c, t->parent[k])->row : NULL;
        for (size_t i = 0; from != NULL && i < n; ++i) {
            row[i] += share * bake_long(from[i]);
        }
    }
}

static void code_one(void *user, int index, int worker)
{
    coder *c = user;
    const bake *b = c->b;
    if (worker == 0) {
        progress_tell("links", (double)index / (double)c->own);
    }
    const uint32_t n = b->set.elements;
    bake_target *t = target_at(c, c->order[index]);
    float *row[3] = {c->memory[worker], c->memory[worker] + n, c->memory[worker] + 2 * (size_t)n};
    const float price = b->set.error * b->set.error * (PARTS * b->area / maxf(t->support, 1e-6f * PARTS * b->area));
    for (size_t i = 0; i < (size_t)c->axes * n; ++i) {
        row[0][i] = bake_long(t->row[i]);
    }
    add_parents(c, t, row[0], -1.0f);
    t->link.count = 0;
    if (!bake_links(c->linker[worker], row, c->axes, t->normal, price, &t->link, &t->links, &t->scale,
                    &c->said[worker])) {
        c->has_failed[worker] = 1;
        return;
    }
    add_parents(c, t, row[0], 1.0f);
    for (size_t i = 0; i < (size_t)c->axes * n; ++i) {
        t->row[i] = bake_short(row[0][i]);
    }
}

/* Adds the area of a target to the parents, because the target has to correct their errors. */
static void hand_up(coder *c, uint32_t count)
{
    for (uint32_t i = count; i-- > 0;) {
        const bake_target *t = target_at(c, i);
        for (int k = 0; k < BAKE_PARENTS; ++k) {
            if (t->share[k] > 0.0f) {
                target_at(c, t->parent[k])->support += SHARE * t->share[k] * t->support;
            }
        }
    }
}

/* Sets the distance of each target from those without parents; returns the largest. */
static uint32_t set_generations(const coder *c, uint32_t *generation, uint32_t count)
{
    uint32_t last = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const bake_target *t = target_at(c, i);
        generation[i] = 0;
        for (int k = 0; k < BAKE_PARENTS; ++k) {
            if (t->share[k] > 0.0f && generation[t->parent[k]] >= generation[i]) {
                generation[i] = generation[t->parent[k]] + 1;
            }
        }
        last = generation[i] > last ? generation[i] : last;
    }
    return last;
}

static int code_all(coder *c, uint32_t *generation, uint32_t *order, uint32_t count, report *r)
{
    const uint32_t last = set_generations(c, generation, count);
    if (!c->b->is_coded) {
        hand_up(c, count);
    }
    c->order = order;
    for (uint32_t g = 0; g <= last; ++g) {
        uint32_t own = 0;
        for (uint32_t i = 0; i < count; ++i) {
            if (generation[i] == g) {
                order[own++] = i;
            }
        }
        c->own = own;
        pool_run(c->b->set.threads, (int)own, code_one, c);
        for (int k = 0; k < c->b->set.threads; ++k) {
            if (c->has_failed[k]) {
                *r = c->said[k];
                return 0;
            }
        }
    }
    return 1;
}

int bake_code(bake *b, bake_target *target, size_t each, uint32_t count, int axes, report *r)
{
    coder *c = calloc(1, sizeof *c);
    uint32_t *memory = malloc(2 * (size_t)(count + 1) * sizeof *memory);
    int ok = (c != NULL && memory != NULL) || report_fail(r, "not enough memory for %u receivers", (unsigned)count);
    for (int k = 0; ok && k < b->set.threads; ++k) {
        c->linker[k] = bake_linker_new(b, r);
        c->memory[k] = malloc(3 * (size_t)b->set.elements * sizeof *c->memory[k]);
        ok = c->linker[k] != NULL &&
             (c->memory[k] != NULL || report_fail(r, "not enough memory for %u elements", (unsigned)b->set.elements));
    }
    if (ok) {
        c->b = b;
        c->target = (uint8_t *)target;
        c->each = each;
        c->axes = axes;
        ok = count == 0 || code_all(c, memory, memory + count, count, r);
    }
    for (int k = 0; c != NULL && k < b->set.threads; ++k) {
        bake_linker_free(c->linker[k]);
        free(c->memory[k]);
    }
    free(c);
    free(memory);
    return ok;
}

int bake_code_all(bake *b, report *r)
{
    const int ok =
        (b->receiver_count == 0 ||
         bake_code(b, &b->receiver[0].target, sizeof *b->receiver, b->receiver_count, 1, r)) &&
        (b->cluster_count == 0 || bake_code(b, &b->cluster[0].target, sizeof *b->cluster, b->cluster_count, 3, r));
    b->is_coded = 1;
    return ok;
}
