/* bake_links.c: a row of arriving light per element -> links to few nodes that stand for the mean of their elements. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

enum { AXES = 3, MAX_LINKS = 4096 };
#define FOREIGN 1e30f /* error of a node with elements of several zones, which do not see each other */
#define FAINT 1e-20f /* squared: rounding noise of light along a plane */
#define ACROSS 0.35f /* weight of an error across the normal, for surfaces tilted by up to about 50 degrees */

/* Sums over a node's elements, of one row. */
typedef struct sums {
    float w[AXES]; /* arriving light; 3 axes: along the linker's axes */
    float a;       /* area */
    float error;   /* squared error of using the node as a whole */
} sums;

/* A node that is to be linked, or split. */
typedef struct entry {
    float error;
    uint32_t node;
} entry;

struct bake_linker {
    const bake *b;
    int axes;
    lmb_vec3 axis[AXES]; /* the last is the normal */
    sums *sum;
    entry heap[MAX_LINKS + 4];
};

bake_linker *bake_linker_new(const bake *b, report *r)
{
    bake_linker *l = calloc(1, sizeof *l);
    if (l != NULL) {
        l->b = b;
        l->sum = malloc(((size_t)b->set.elements / 3 * 4 + 2) * sizeof *l->sum);
    }
    if (l == NULL || l->sum == NULL) {
        bake_linker_free(l);
        report_fail(r, "not enough memory for links to %u elements", (unsigned)b->set.elements);
        return NULL;
    }
    return l;
}

void bake_linker_free(bake_linker *l)
{
    if (l != NULL) {
        free(l->sum);
        free(l);
    }
}

static float size_of(const sums *s) { return s->w[0] * s->w[0] + s->w[1] * s->w[1] + s->w[2] * s->w[2]; }

/* Using a node as a whole assumes that each child sends light in proportion to area. The error is the deviation,
 * weighted by how much light differs among the children. Lit and dark places meet along lines, so a node of twice
 * the side is twice as likely to contain both. */
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

/* Errors count in full along the normal, and less across it. */
static void set_axes(bake_linker *l, int axes, lmb_vec3 normal)
{
    l->axes = axes;
    l->axis[2] = normal;
    l->axis[0] = normalize3(cross3(normal, absf(normal.x) < 0.7f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f)));
    l->axis[1] = cross3(normal, l->axis[0]);
}

static void set_leaf(const bake_linker *l, sums *s, float *const *row, uint32_t i)
{
    memset(s, 0, sizeof *s);
    s->a = bake_open_area(&l->b->element[i]);
    s->w[0] = row[0][i];
    if (l->axes == AXES) {
        const lmb_vec3 v = vec3(row[0][i], row[1][i], row[2][i]);
        s->w[0] = ACROSS * dot3(v, l->axis[0]);
        s->w[1] = ACROSS * dot3(v, l->axis[1]);
        s->w[2] = dot3(v, l->axis[2]);
    }
}

static void set_sums(bake_linker *l, float *const *row)
{
    const uint32_t n = l->b->set.elements;
    float likely = 1.0f;
    for (uint32_t i = 0; i < n; ++i) {
        set_leaf(l, &l->sum[i], row, i);
    }
    uint32_t below = 0, at = n;
    for (uint32_t count = n / 4; count > 0; count /= 4, likely *= 2.0f) {
        for (uint32_t i = 0; i < count; ++i) {
            sums *s = &l->sum[at + i];
            join(s, &l->sum[below + 4 * i], likely);
            if (l->b->node_zone[at + i] == BAKE_ZONES && (s->error > FAINT || size_of(s) > FAINT)) {
                s->error = FOREIGN;
            }
        }
        below = at;
        at += count;
    }
}

/* --- a cut: the node with the largest error is taken apart until each is small enough ----------------------------- */

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

static uint32_t cut(bake_linker *l, float price)
{
    const uint32_t elements = l->b->set.elements, top = root_of(elements);
    const sums *s = l->sum;
    const entry root = {s[top].error, top};
    uint32_t count = 0, first;
    push(l->heap, &count, root);
    while (count + 3 < MAX_LINKS && l->heap[0].error > price) {
        const entry e = pop(l->heap, &count);
        const uint32_t level = level_of(elements, &first, e.node), below = first - (elements >> 2 * (level - 1));
        for (uint32_t k = 0; k < 4; ++k) {
            const uint32_t child = below + 4 * (e.node - first) + k;
            const entry c = {s[child].error, child};
            push(l->heap, &count, c);
        }
    }
    return count;
}

static int by_node(const void *a, const void *b)
{
    const entry *x = a, *y = b;
    return x->node < y->node ? -1 : 1;
}

/* Drops links with little weight. */
static uint32_t drop_small(bake_linker *l, uint32_t count, float price)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (size_of(&l->sum[l->heap[i].node]) > price) {
            l->heap[kept++] = l->heap[i];
        }
    }
    qsort(l->heap, kept, sizeof *l->heap, by_node);
    return kept;
}

/* --- weights ------------------------------------------------------------------------------------------------------ */

/* Distributes the light of dropped links over the others in proportion, because losses accumulate. */
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

/* Converts weights from the linker's axes to those of rows. */
static void turn_back(const bake_linker *l, uint32_t count)
{
    for (uint32_t i = 0; l->axes == AXES && i < count; ++i) {
        float *w = l->sum[l->heap[i].node].w;
        const lmb_vec3 across = add3(mul3(l->axis[0], w[0]), mul3(l->axis[1], w[1]));
        const lmb_vec3 turned = add3(mul3(across, 1.0f / ACROSS), mul3(l->axis[2], w[2]));
        w[0] = turned.x;
        w[1] = turned.y;
        w[2] = turned.z;
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

/* Distributes the weight of a node over the elements below it, by area. */
static void spread(const bake *b, float *row, uint32_t node, float weight, float area)
{
    uint32_t first;
    const uint32_t level = level_of(b->set.elements, &first, node), from = (node - first) << 2 * level;
    for (uint32_t i = from; i < from + (1u << 2 * level); ++i) {
        row[i] = area > 0.0f ? weight * (bake_open_area(&b->element[i]) / area) : 0.0f;
    }
}

static int put_link(bake_words *links, uint32_t node, const int32_t *weight, int axes, report *r)
{
    return bake_put(links, node | ((uint32_t)weight[0] & 0xffffu) << 16, r) &&
           (axes == 1 || bake_put(links, ((uint32_t)weight[1] & 0xffffu) | ((uint32_t)weight[2] & 0xffffu) << 16, r));
}

int bake_links(bake_linker *l, float *const *row, int axes, lmb_vec3 normal, float price, bake_words *links,
               uint32_t *count, float *scale, report *r)
{
    int ok = 1;
    set_axes(l, axes, normal);
    set_sums(l, row);
    const uint32_t chosen = drop_small(l, cut(l, price), price);
    make_up(l->sum, l->heap, chosen, &l->sum[root_of(l->b->set.elements)]);
    turn_back(l, chosen);
    *count = 0;
    *scale = scale_for(l->sum, l->heap, chosen);
    for (int k = 0; k < axes; ++k) {
        memset(row[k], 0, l->b->set.elements * sizeof *row[k]);
    }
    for (uint32_t i = 0; i < chosen && ok && *scale > 0.0f; ++i) {
        const sums *node = &l->sum[l->heap[i].node];
        int32_t weight[AXES] = {0, 0, 0};
        for (int k = 0; k < axes; ++k) {
            weight[k] = (int32_t)lrintf(node->w[k] / *scale);
            spread(l->b, row[k], l->heap[i].node, (float)weight[k] * *scale, node->a);
        }
        if (weight[0] != 0 || weight[1] != 0 || weight[2] != 0) {
            ok = put_link(links, l->heap[i].node, weight, axes, r);
            ++*count;
        }
    }
    return ok;
}

/* Sums squares over groups of a 256th of the elements, and of four. Light near these receivers has finer detail. */
float bake_surplus(const bake *b, const float *row)
{
    const uint32_t each = b->set.elements / 256 > 4 ? b->set.elements / 256 : 4;
    float sum2 = 0.0f;
    for (uint32_t i = 0; i < b->set.elements; i += each) {
        float sum = 0.0f;
        for (uint32_t k = i; k < i + each; k += 4) {
            const float four = row[k] + row[k + 1] + row[k + 2] + row[k + 3];
            sum2 += four * four;
            sum += four;
        }
        sum2 += sum * sum;
    }
    return sqrtf(sum2);
}
