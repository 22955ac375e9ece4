/* bake_links.c: a row of what arrives of each element -> links to few nodes, whose means stand for their elements. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"

enum { AXES = 3, MAX_LINKS = 4096 };

/* Sums over a node's elements, of one row. */
typedef struct sums {
    float w[AXES]; /* what arrives */
    float a;       /* area */
    float error;   /* squared error of taking the node as one */
} sums;

/* A node as one says that each child gives as much as its area is. The error is what that is off by, times how much
 * light differs among the children. Lit and dark places meet along lines: a node of twice the side is as likely again
 * to hold both. */
static void join(sums *to, const sums child[4], float likely)
{
    memset(to, 0, sizeof *to);
    for (int c = 0; c < 4; ++c) {
        to->a += child[c].a;
        to->error += child[c].error;
        for (int k = 0; k < AXES; ++k) {
            to->w[k] += child[c].w[k];
        }
    }
    for (int c = 0; c < 4 && to->a > 0.0f; ++c) {
        for (int k = 0; k < AXES; ++k) {
            const float off = child[c].w[k] - to->w[k] * (child[c].a / to->a);
            to->error += likely * off * off;
        }
    }
}

static float size_of(const sums *s) { return s->w[0] * s->w[0] + s->w[1] * s->w[1] + s->w[2] * s->w[2]; }

static uint32_t level_of(uint32_t elements, uint32_t *first, uint32_t node)
{
    uint32_t at = 0, level = 0;
    while (node >= at + elements) {
        at += elements;
        elements /= 4;
        ++level;
    }
    *first = at;
    return level;
}

static uint32_t root_of(uint32_t elements)
{
    uint32_t nodes = 0;
    for (uint32_t n = elements; n > 0; n /= 4) {
        nodes += n;
    }
    return nodes - 1;
}

static void set_sums(sums *s, const bake *b, float *const *row, int axes)
{
    const uint32_t n = b->set.elements;
    float likely = 1.0f;
    for (uint32_t i = 0; i < n; ++i) {
        memset(&s[i], 0, sizeof s[i]);
        s[i].a = b->element[i].area;
        for (int k = 0; k < axes; ++k) {
            s[i].w[k] = row[k][i];
        }
    }
    uint32_t below = 0, at = n;
    for (uint32_t count = n / 4; count > 0; count /= 4, likely *= 2.0f) {
        for (uint32_t i = 0; i < count; ++i) {
            join(&s[at + i], &s[below + 4 * i], likely);
        }
        below = at;
        at += count;
    }
}

/* --- a cut: the node with the largest error is taken apart until their sum is small enough ------------------------ */

typedef struct entry {
    float error;
    uint32_t node;
} entry;

static void push(entry *heap, uint32_t *count, entry e)
{
    uint32_t at = (*count)++;
    for (; at > 0 && heap[(at - 1) / 2].error < e.error; at = (at - 1) / 2) {
        heap[at] = heap[(at - 1) / 2];
    }
    heap[at] = e;
}

static entry pop(entry *heap, uint32_t *count)
{
    const entry top = heap[0], last = heap[--*count];
    uint32_t at = 0;
    for (uint32_t child = 1; child < *count; child = 2 * at + 1) {
        child += child + 1 < *count && heap[child + 1].error > heap[child].error;
        if (heap[child].error <= last.error) {
            break;
        }
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = last;
    return top;
}

static uint32_t cut(entry *heap, const sums *s, uint32_t elements, float error2)
{
    uint32_t count = 0, first;
    const uint32_t top = root_of(elements);
    entry root = {s[top].error, top};
    float sum = root.error;
    push(heap, &count, root);
    while (sum > error2 && count + 3 < MAX_LINKS && heap[0].error > 0.0f) {
        const entry e = pop(heap, &count);
        const uint32_t level = level_of(elements, &first, e.node), below = first - (elements >> 2 * (level - 1));
        sum = maxf(sum - e.error, 0.0f);
        for (uint32_t k = 0; k < 4; ++k) {
            const uint32_t child = below + 4 * (e.node - first) + k;
            entry c = {s[child].error, child};
            sum += c.error;
            push(heap, &count, c);
        }
    }
    return count;
}

/* Links that hardly count go, smallest first, as long as the sum of their squares is small enough. */
static int by_size(const void *a, const void *b)
{
    const entry *x = a, *y = b;
    return x->error != y->error ? (x->error < y->error ? -1 : 1) : x->node < y->node ? -1 : 1;
}

static int by_node(const void *a, const void *b)
{
    const entry *x = a, *y = b;
    return x->node < y->node ? -1 : 1;
}

static uint32_t drop_small(entry *heap, const sums *s, uint32_t count, float error2)
{
    uint32_t gone = 0;
    float sum = 0.0f;
    for (uint32_t i = 0; i < count; ++i) {
        heap[i].error = size_of(&s[heap[i].node]);
    }
    qsort(heap, count, sizeof *heap, by_size);
    while (gone < count && sum + heap[gone].error <= error2) {
        sum += heap[gone++].error;
    }
    memmove(heap, heap + gone, (count - gone) * sizeof *heap);
    qsort(heap, count - gone, sizeof *heap, by_node);
    return count - gone;
}

/* --- weights ------------------------------------------------------------------------------------------------------ */

/* What dropped links would have brought goes to those that stay, each as much as it has: light that is lost adds up. */
static void make_up(sums *s, const entry *link, uint32_t count, const sums *all)
{
    for (int k = 0; k < AXES; ++k) {
        float kept = 0.0f, size = 0.0f;
        for (uint32_t i = 0; i < count; ++i) {
            kept += s[link[i].node].w[k];
            size += absf(s[link[i].node].w[k]);
        }
        const float share = size > 0.0f ? (all->w[k] - kept) / size : 0.0f;
        for (uint32_t i = 0; i < count && absf(share) < 0.5f; ++i) {
            s[link[i].node].w[k] += share * absf(s[link[i].node].w[k]);
        }
    }
}

static float scale_for(const sums *s, const entry *link, uint32_t count)
{
    float largest = 0.0f;
    for (int k = 0; k < AXES; ++k) {
        float sum = 0.0f;
        for (uint32_t i = 0; i < count; ++i) {
            sum += absf(s[link[i].node].w[k]);
        }
        largest = maxf(largest, sum);
    }
    return largest / ((float)LMB_TRANSFER_MAX_SUM - 0.5f * (float)count - 1.0f);
}

/* What a link says of each element: the node's weight by area. */
static void spread(const bake *b, float *row, uint32_t node, float weight, float area)
{
    uint32_t first;
    const uint32_t level = level_of(b->set.elements, &first, node), from = (node - first) << 2 * level;
    for (uint32_t i = from; i < from + (1u << 2 * level); ++i) {
        row[i] = area > 0.0f ? weight * (b->element[i].area / area) : 0.0f;
    }
}

static int put_link(bake_words *links, uint32_t node, const int32_t *weight, int axes, report *r)
{
    return bake_put(links, node | ((uint32_t)weight[0] & 0xffffu) << 16, r) &&
           (axes == 1 || bake_put(links, ((uint32_t)weight[1] & 0xffffu) | ((uint32_t)weight[2] & 0xffffu) << 16, r));
}

int bake_links(const bake *b, float *const *row, int axes, bake_words *links, uint32_t *count, float *scale, report *r)
{
    const float error2 = b->set.error * b->set.error;
    sums *s = malloc(((size_t)b->set.elements / 3 * 4 + 2) * sizeof *s);
    entry *heap = malloc((MAX_LINKS + 4) * sizeof *heap);
    int ok = s != NULL && heap != NULL;
    *count = 0;
    *scale = 0.0f;
    if (ok) {
        set_sums(s, b, row, axes);
        const uint32_t chosen = drop_small(heap, s, cut(heap, s, b->set.elements, error2), error2);
        make_up(s, heap, chosen, &s[root_of(b->set.elements)]);
        *scale = scale_for(s, heap, chosen);
        for (int k = 0; k < axes; ++k) {
            memset(row[k], 0, b->set.elements * sizeof *row[k]);
        }
        for (uint32_t i = 0; i < chosen && ok && *scale > 0.0f; ++i) {
            const sums *node = &s[heap[i].node];
            int32_t weight[AXES] = {0, 0, 0};
            for (int k = 0; k < axes; ++k) {
                weight[k] = (int32_t)lrintf(node->w[k] / *scale);
                spread(b, row[k], heap[i].node, (float)weight[k] * *scale, node->a);
            }
            if (weight[0] != 0 || weight[1] != 0 || weight[2] != 0) {
                ok = put_link(links, heap[i].node, weight, axes, r);
                ++*count;
            }
        }
    }
    free(s);
    free(heap);
    return ok || report_fail(r, "not enough memory for the links of a receiver");
}

float bake_surplus(const bake *b, const float *row)
{
    const uint32_t each = b->set.elements / 256 > 0 ? b->set.elements / 256 : 1;
    float sum2 = 0.0f;
    for (uint32_t i = 0; i < b->set.elements; i += each) {
        float sum = 0.0f;
        for (uint32_t k = 0; k < each; ++k) {
            sum += row[i + k];
        }
        sum2 += sum * sum;
    }
    return sqrtf(sum2);
}
