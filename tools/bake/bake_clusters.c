/* bake_clusters.c: small triangles -> clusters by place and normal, and the blends that light triangle corners. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "bake_share.h"
#include "bake_triangle.h"

enum { BATCH = 64, NEIGHBOURS = 4, TARGET = 2000, SHARING = 4 };
#define ALIKE 0.6f /* least cosine between normals that share a cluster */
#define BLEND 0.3f /* least cosine between a corner's normal and a cluster that lights it */
#define REACH 1.3f /* cells */
#define ACROSS 1.1 /* cost of a cluster's three rows, in rows of a receiver */

typedef struct clusters {
    bake *b;
    uint32_t *slot; /* cluster + 1 */
    uint32_t mask;
    bake_sight sight;
    report *r;
} clusters;

static uint32_t hash_of(const int32_t cell[3])
{
    uint32_t h = (uint32_t)cell[0] * 73856093u ^ (uint32_t)cell[1] * 19349663u ^ (uint32_t)cell[2] * 83492791u;
    return h ^ h >> 15;
}

static void cell_of(int32_t cell[3], const bake *b, lmb_vec3 p)
{
    const float per = 1.0f / b->set.cluster_m;
    cell[0] = bake_cell(p.x, per);
    cell[1] = bake_cell(p.y, per);
    cell[2] = bake_cell(p.z, per);
}

static int add_cluster(clusters *c, lmb_vec3 at, lmb_vec3 normal)
{
    int32_t cell[3];
    cell_of(cell, c->b, at);
    bake *b = c->b;
    uint32_t *slot = &c->slot[hash_of(cell) & c->mask];
    for (uint32_t i = *slot; i != 0; i = b->cluster[i - 1].next) {
        const bake_cluster *k = &b->cluster[i - 1];
        if (memcmp(k->cell, cell, sizeof cell) == 0 && dot3(k->target.normal, normal) > ALIKE &&
            bake_sees_over(&c->sight, b, k->at, k->target.normal, at, normal)) {
            return 1;
        }
    }
    if (b->cluster_count == LMB_TRANSFER_MAX_CLUSTERS) {
        return report_fail(c->r, "over 65,536 clusters of small triangles: a larger --cluster");
    }
    if (b->cluster_count == b->cluster_cap) {
        const uint32_t cap = b->cluster_cap > 0 ? 2 * b->cluster_cap : 256;
        bake_cluster *data = realloc(b->cluster, cap * sizeof *data);
        if (data == NULL) {
            return report_fail(c->r, "not enough memory for %u clusters", (unsigned)cap);
        }
        b->cluster = data;
        b->cluster_cap = cap;
    }
    bake_cluster *k = &b->cluster[b->cluster_count++];
    memset(k, 0, sizeof *k);
    k->at = at;
    k->target.normal = normal;
    memcpy(k->cell, cell, sizeof cell);
    k->next = *slot;
    *slot = b->cluster_count;
    return 1;
}

/* --- rows --------------------------------------------------------------------------------------------------------- */

static int by_generation(const void *a, const void *b)
{
    const bake_cluster *x = a, *y = b;
    if (x->generation != y->generation) {
        return x->generation < y->generation ? -1 : 1;
    }
    return x->key != y->key ? (x->key < y->key ? -1 : 1) : x->next < y->next ? -1 : 1;
}

/* Puts parents first, then neighbours next to each other, because they see the same geometry. Rebuilds the slots. */
static void put_in_order(clusters *c)
{
    bake *b = c->b;
    if (b->cluster_count == 0) {
        return;
    }
    for (uint32_t i = 0; i < b->cluster_count; ++i) {
        b->cluster[i].key = bake_key(b->scene, b->cluster[i].at, b->cluster[i].target.normal);
        b->cluster[i].next = i;
    }
    bake_generations(b->cluster, b->cluster_count, b->set.cluster_m);
    qsort(b->cluster, b->cluster_count, sizeof *b->cluster, by_generation);
    memset(c->slot, 0, ((size_t)c->mask + 1) * sizeof *c->slot);
    for (uint32_t i = 0; i < b->cluster_count; ++i) {
        uint32_t *slot = &c->slot[hash_of(b->cluster[i].cell) & c->mask];
        b->cluster[i].next = *slot;
        *slot = i + 1;
    }
}

static int keep_row(bake_target *t, size_t words, report *r)
{
    t->row = t->row != NULL ? t->row : malloc(words * sizeof *t->row);
    return t->row != NULL || report_fail(r, "not enough memory for the light at clusters");
}

/* Clusters in the order of their rows, in batches. */
typedef struct cluster_step {
    bake *b;
    bake_cluster *const *cluster;
    uint32_t all;
    float *memory;
} cluster_step;

static uint32_t past_of(const cluster_step *c, int32_t batch)
{
    return bake_past(batch, BATCH, c->all);
}

static int make_batch(void *user, int32_t batch, report *r)
{
    const cluster_step *c = user;
    const uint32_t n = c->b->set.elements, first = (uint32_t)batch * BATCH, count = past_of(c, batch) - first;
    float *row[3 * BATCH];
    lmb_vec3 at[BATCH], normal[BATCH];
    progress_tell("clusters", (double)first / (double)c->all);
    for (uint32_t k = 0; k < BATCH; ++k) {
        const bake_cluster *own = c->cluster[first + (k < count ? k : 0)];
        at[k] = own->at;
        normal[k] = own->target.normal;
    }
    for (uint32_t k = 0; k < 3 * BATCH; ++k) {
        row[k] = c->memory + (size_t)k * n;
    }
    int ok = bake_rows(c->b, at, normal, (int)count, 3, row, NULL, r);
    for (uint32_t k = 0; ok && k < count; ++k) {
        bake_target *t = &c->cluster[first + k]->target;
        ok = keep_row(t, 3 * (size_t)n, r);
        for (size_t i = 0; ok && i < 3 * (size_t)n; ++i) {
            t->row[i] = bake_short(row[3 * k][i]);
        }
    }
    return ok;
}

static double weight_of(const void *user, int32_t batch)
{
    return ACROSS * (double)(past_of(user, batch) - (uint32_t)batch * BATCH);
}

static void put_batch(const void *user, int32_t batch, byte_buffer *to)
{
    const cluster_step *c = user;
    for (uint32_t i = (uint32_t)batch * BATCH; i < past_of(c, batch); ++i) {
        if (c->cluster[i]->target.row != NULL) {
            bake_put_halves(to, c->cluster[i]->target.row, 3 * (size_t)c->b->set.elements);
        }
    }
}

static int get_batch(void *user, int32_t batch, byte_reader *from)
{
    const cluster_step *c = user;
    const size_t words = 3 * (size_t)c->b->set.elements;
    report unheard = {""};
    int ok = 1;
    for (uint32_t i = (uint32_t)batch * BATCH; ok && i < past_of(c, batch); ++i) {
        bake_target *t = &c->cluster[i]->target;
        ok = keep_row(t, words, &unheard) && bake_get_halves(t->row, words, from);
    }
    return ok;
}

int bake_cluster_rows(bake *b, bake_cluster *const *cluster, uint32_t all, report *r)
{
    cluster_step c = {b, cluster, all, malloc(3 * BATCH * (size_t)b->set.elements * sizeof(float))};
    const bake_step step = {(int32_t)((all + BATCH - 1) / BATCH), weight_of, make_batch, put_batch, get_batch, &c};
    const int ok =
        (c.memory != NULL || report_fail(r, "not enough memory for %u elements", (unsigned)b->set.elements)) &&
        bake_share_step(b->share, &step, r);
    free(c.memory);
    return ok;
}

static int make_rows(clusters *c)
{
    const uint32_t all = c->b->cluster_count;
    bake_cluster **order = malloc(((size_t)all + 1) * sizeof *order);
    int ok = order != NULL || report_fail(c->r, "not enough memory for %u clusters", (unsigned)all);
    for (uint32_t i = 0; ok && i < all; ++i) {
        order[i] = &c->b->cluster[i];
    }
    ok = ok && bake_cluster_rows(c->b, order, all, c->r);
    free(order);
    return ok;
}

/* --- blends ------------------------------------------------------------------------------------------------------- */

typedef struct candidate {
    uint32_t cluster;
    float weight;
} candidate;

static void offer(candidate best[NEIGHBOURS], uint32_t number, float weight)
{
    int at = NEIGHBOURS - 1;
    if (weight <= best[at].weight) {
        return;
    }
    for (; at > 0 && best[at - 1].weight < weight; --at) {
        best[at] = best[at - 1];
    }
    best[at].cluster = number;
    best[at].weight = weight;
}

/* If no cluster is within reach, offers the nearest that does not face away, or the nearest if all do. */
static void offer_nearest(candidate best[NEIGHBOURS], const clusters *c, lmb_vec3 p, lmb_vec3 n)
{
    for (uint32_t i = 0; i < c->b->cluster_count; ++i) {
        const lmb_vec3 d = sub3(c->b->cluster[i].at, p);
        const float away = dot3(c->b->cluster[i].target.normal, n) > 0.0f ? 1.0f : 1e6f;
        offer(best, i, 1.0f / (away * (dot3(d, d) + 1e-12f)));
    }
    for (int k = 1; k < NEIGHBOURS; ++k) {
        best[k].weight = 0.0f;
    }
}

/* Writes four clusters and their weights, which sum to 255. They light `area` around a corner. Clusters that the
 * triangle's middle, `inside`, does not see lie behind a wall and are skipped, unless it sees none. */
static int put_blend(clusters *c, lmb_vec3 p, lmb_vec3 n, lmb_vec3 inside, float area)
{
    candidate best[NEIGHBOURS] = {{0, 0.0f}, {0, 0.0f}, {0, 0.0f}, {0, 0.0f}};
    bake_words *w = &c->b->section[LMB_TRANSFER_BLENDS];
    int32_t middle[3];
    float sum = 0.0f;
    cell_of(middle, c->b, p);
    for (int i = 0; i < 54 && (i < 27 || best[0].weight == 0.0f); ++i) {
        const int32_t cell[3] = {middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 % 3 - 1};
        for (uint32_t k = c->slot[hash_of(cell) & c->mask]; k != 0; k = c->b->cluster[k - 1].next) {
            const bake_cluster *o = &c->b->cluster[k - 1];
            const float far = length3(sub3(o->at, p)) / (REACH * c->b->set.cluster_m),
                        cosine = dot3(o->target.normal, n);
            if (memcmp(o->cell, cell, sizeof cell) == 0 && far < 1.0f && cosine > BLEND) {
                const float v = (1.0f - far) * (1.0f - far) * (cosine - BLEND) * (cosine - BLEND);
                if (v * v > best[NEIGHBOURS - 1].weight &&
                    (i >= 27 || bake_sees_over(&c->sight, c->b, inside, n, o->at, o->target.normal))) {
                    offer(best, k - 1, v * v);
                }
            }
        }
    }
    if (best[0].weight == 0.0f) {
        offer_nearest(best, c, p, n);
    }
    for (int k = 0; k < NEIGHBOURS; ++k) {
        sum += best[k].weight;
    }
    uint32_t left = 255, weights = 0;
    for (int k = NEIGHBOURS - 1; k >= 0 && sum > 0.0f; --k) {
        const uint32_t own = k == 0 ? left : (uint32_t)(best[k].weight / sum * 255.0f + 0.5f);
        weights |= (own > left ? left : own) << 8 * k;
        c->b->cluster[best[k].cluster].target.support += area * best[k].weight / sum;
        left -= own > left ? left : own;
    }
    return bake_put(w, best[0].cluster | best[1].cluster << 16, c->r) &&
           bake_put(w, best[2].cluster | best[3].cluster << 16, c->r) && bake_put(w, weights, c->r);
}

/* --- triangles ---------------------------------------------------------------------------------------------------- */

static int visit(clusters *c, int (*each)(clusters *, const lmb_triangle *, lmb_vec3, uint32_t, uint32_t))
{
    const uint32_t all = lmb_scene_triangles(c->b->scene);
    for (uint32_t id = 1; id <= all; ++id) {
        lmb_triangle t;
        lmb_vec3 normal;
        float area;
        if (!lmb_triangle_fetch(&t, c->b->scene, id) || !lmb_triangle_shape(&normal, &area, &t) ||
            !bake_is_small(c->b, t.corner)) {
            continue;
        }
        for (uint32_t back = 0; back < 2; ++back) {
            if (c->b->section[LMB_TRANSFER_SURFACES].data[4 * (id - 1) + back] != LMB_TRANSFER_NONE &&
                !each(c, &t, mul3(normal, back ? -1.0f : 1.0f), id, back)) {
                return 0;
            }
        }
    }
    return 1;
}

/* Adds a triangle to a cluster at a point that light reaches. Triangles without such a point use clusters around
 * them. */
static int cluster_triangle(clusters *c, const lmb_triangle *t, lmb_vec3 normal, uint32_t id, uint32_t back)
{
    const uint32_t open = c->b->small_open == NULL ? 1u : c->b->small_open[2 * (id - 1) + back];
    lmb_vec3 place[4];
    bake_quarters(place, t->corner);
    for (int k = 0; k < 4; ++k) {
        if ((open >> k & 1u) != 0) {
            return add_cluster(c, place[k], normal);
        }
    }
    return 1;
}

/* Adds a leaf with separate blends for the corners. */
static int bind_triangle(clusters *c, const lmb_triangle *t, lmb_vec3 normal, uint32_t id, uint32_t back)
{
    bake *b = c->b;
    bake_words *divisions = &b->section[LMB_TRANSFER_DIVISIONS], *corners = &b->section[LMB_TRANSFER_CORNERS];
    b->section[LMB_TRANSFER_SURFACES].data[4 * (id - 1) + 2 + back] = (uint32_t)divisions->count;
    if (!bake_put(divisions, LMB_TRANSFER_LEAF | (uint32_t)(corners->count / LMB_TRANSFER_CORNER_WORDS), c->r)) {
        return 0;
    }
    for (int k = 0; k < 3; ++k) {
        const uint32_t blend = (uint32_t)(b->section[LMB_TRANSFER_BLENDS].count / LMB_TRANSFER_BLEND_WORDS);
        if (!bake_put(corners, blend, c->r) ||
            !put_blend(c, t->corner[k], normal, triangle_middle(t->corner), triangle_area(t->corner) * (1.0f / 3.0f))) {
            return 0;
        }
    }
    return 1;
}

int bake_clusters(bake *b, report *r)
{
    clusters c;
    memset(&c, 0, sizeof c);
    c.b = b;
    c.mask = (1u << 18) - 1;
    c.r = r;
    c.slot = calloc((size_t)c.mask + 1, sizeof *c.slot);
    int ok = (c.slot != NULL || report_fail(r, "not enough memory for clusters")) && bake_sight_begin(&c.sight, r);
    while (ok) {
        b->cluster_count = 0;
        memset(c.slot, 0, ((size_t)c.mask + 1) * sizeof *c.slot);
        ok = visit(&c, cluster_triangle);
        if (ok && b->cluster_count == 0 && b->small_open != NULL) { /* none is open: treat all alike */
            free(b->small_open);
            b->small_open = NULL;
            continue;
        }
        if (b->has_cluster_m || b->cluster_count >= TARGET || b->cluster_count * SHARING > b->small_count ||
            b->set.cluster_m < b->set.smallest_m) {
            break;
        }
        b->set.cluster_m *= 0.8f;
    }
    if (ok) {
        put_in_order(&c);
    }
    ok = ok && make_rows(&c) && bake_parents(b, r) && visit(&c, bind_triangle);
    free(c.slot);
    bake_sight_end(&c.sight, b);
    return ok;
}
