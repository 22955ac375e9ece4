/* bake_receivers.c: large triangles -> receivers; halves them until arriving light is nearly linear in between. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/pool.h"
#include "../common/fvec.h"
#include "bake_share.h"
#include "bake_triangle.h"

enum { BATCH = 64, DEPTH = 24, SEARCH = 6, ROUND = 64, PLACES = 4 };
#define DIM    0.25f /* of the mean light: in darker places errors count less */
#define BURIED 2.0f /* times the light of the brightest corner: if an inner point has more, the corners are buried */
#define WAIT   0.1f  /* of the worst error: smaller errors wait, because receivers may run out */
#define PER_CORNER 1.5f /* further receivers of a scene with thin elements, for each receiver at a corner */
#define LOOK   0.45 /* cost of a sample point, in rows of a receiver */
#define ACROSS 1.1 /* cost of a receiver's three rows */
#define STANDS 0.1f /* surplus of a triangle that geometry touches; differences between corners are no estimate there */

enum { WHOLE, DIRECTED, SAMPLE };

/* A triangle of the division. */
typedef struct piece {
    lmb_vec3 corner[3], normal;
    uint32_t receiver[3], node;
    uint32_t mid; /* receiver at the midpoint of the longest edge */
    int from, depth;
    int must_split; /* other geometry touches it */
    int takes_direction; /* its receivers keep light by direction */
    int is_shared;  /* a neighbour made `mid` */
    float surplus, error;
    uint32_t source; /* node of the element pieces that contains this piece; both trees halve alike */
    float light;     /* the most that reaches an element there */
} piece;

typedef struct pieces {
    piece *data;
    size_t count, cap;
} pieces;

/* A receiver to be made, or a sample point. */
typedef struct wanted {
    lmb_vec3 at, normal;
    uint32_t parent[3], receiver; /* receiver NONE: a sample, compared with the mean of three parents */
    size_t piece;
    int kind;     /* WHOLE, DIRECTED: a receiver; SAMPLE */
    uint32_t key; /* position on a Z curve, by the octant of the normal */
    float surplus;
    size_t number;
} wanted;

typedef struct divider {
    bake *b;
    pieces now, waiting, leaves; /* to be sampled; with their errors; done */
    wanted *queue;
    size_t queued, queue_cap;
    uint32_t *slot; /* hash table by place: receiver + 1 */
    uint32_t mask;
    bake_sight sight;
    float light; /* mean over the elements */
    report *r;
} divider;

/* --- lists -------------------------------------------------------------------------------------------------------- */

static int grow(void **data, size_t *cap, size_t count, size_t each, report *r)
{
    if (count < *cap) {
        return 1;
    }
    const size_t more = *cap > 0 ? 2 * *cap : 256;
    void *p = realloc(*data, more * each);
    if (p == NULL) {
        return report_fail(r, "not enough memory for %.0f parts of the division", (double)more);
    }
    *data = p;
    *cap = more;
    return 1;
}

/* Calls qsort only if there are items: the list may be NULL otherwise. */
static void sort(void *data, size_t count, size_t each, int (*compare)(const void *, const void *))
{
    if (count > 0) {
        qsort(data, count, each, compare);
    }
}

static int add_piece(pieces *list, const piece *p, report *r)
{
    if (!grow((void **)&list->data, &list->cap, list->count, sizeof *list->data, r)) {
        return 0;
    }
    list->data[list->count++] = *p;
    return 1;
}

static int enqueue(divider *d, const wanted *w)
{
    if (!grow((void **)&d->queue, &d->queue_cap, d->queued, sizeof *d->queue, d->r)) {
        return 0;
    }
    d->queue[d->queued++] = *w;
    return 1;
}

/* --- receivers by place ------------------------------------------------------------------------------------------- */

static int is_there(const bake *b, const bake_receiver *v, lmb_vec3 at, lmb_vec3 normal)
{
    const lmb_vec3 d = sub3(v->place, at);
    const float reach = 0.3f * b->set.smallest_m;
    return dot3(d, d) < reach * reach && dot3(v->target.normal, normal) > 0.99f;
}

static uint32_t hash_of(const bake *b, lmb_vec3 at, int dx, int dy, int dz)
{
    const float per = 1.0f / b->set.smallest_m;
    const uint32_t x = (uint32_t)bake_cell(at.x, per) + (uint32_t)dx, y = (uint32_t)bake_cell(at.y, per) + (uint32_t)dy,
                   z = (uint32_t)bake_cell(at.z, per) + (uint32_t)dz;
    uint32_t h = x * 73856093u ^ y * 19349663u ^ z * 83492791u;
    return h ^ h >> 15;
}

/* Finds a receiver near a place that a receiver at `own` would see, so that no wall lies between them; or NONE. */
static uint32_t find(divider *d, lmb_vec3 at, lmb_vec3 own, lmb_vec3 normal)
{
    for (int i = 0; i < 27; ++i) {
        uint32_t h = hash_of(d->b, at, i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        for (; d->slot[h & d->mask] != 0; ++h) {
            const uint32_t v = d->slot[h & d->mask] - 1;
            if (is_there(d->b, &d->b->receiver[v], at, normal) &&
                bake_sees(&d->sight, d->b, own, d->b->receiver[v].at, normal)) {
                return v;
            }
        }
    }
    return LMB_TRANSFER_NONE;
}

static uint32_t add_receiver(divider *d, lmb_vec3 place, lmb_vec3 at, const piece *p, uint32_t a, uint32_t b,
                             int shared)
{
    const lmb_vec3 normal = p->normal;
    bake *k = d->b;
    size_t cap = k->receiver_cap;
    const wanted w = {at, normal, {a, b, LMB_TRANSFER_NONE}, k->receiver_count, (size_t)-1,
                      p->takes_direction ? DIRECTED : WHOLE, 0, 0.0f, 0};
    if (k->receiver_count >= d->mask / 2 ||
        !grow((void **)&k->receiver, &cap, k->receiver_count, sizeof *k->receiver, d->r) || !enqueue(d, &w)) {
        report_fail(d->r, "too many receivers: %u", (unsigned)k->receiver_count);
        return LMB_TRANSFER_NONE;
    }
    k->receiver_cap = (uint32_t)cap;
    bake_receiver *v = &k->receiver[k->receiver_count];
    memset(v, 0, sizeof *v);
    v->place = place;
    v->at = at;
    v->target.normal = normal;
    for (int i = 0; i < 2 && a != LMB_TRANSFER_NONE; ++i) {
        v->target.parent[i] = i == 0 ? a : b;
        v->target.share[i] = 0.5f;
    }
    uint32_t h = hash_of(k, place, 0, 0, 0);
    for (; shared && d->slot[h & d->mask] != 0; ++h) {
    }
    if (shared) {
        d->slot[h & d->mask] = k->receiver_count + 1;
    }
    return k->receiver_count++;
}

static uint32_t receiver_at(divider *d, lmb_vec3 at, const piece *p, uint32_t a, uint32_t b)
{
    const lmb_vec3 own = bake_pulled(d->b, at, triangle_middle(p->corner));
    const uint32_t there = find(d, at, own, p->normal);
    return there != LMB_TRANSFER_NONE ? there : add_receiver(d, at, own, p, a, b, 1);
}

/* --- geometry that touches a triangle ----------------------------------------------------------------------------- */

/* A corner that does not see the anchor of the leaf is replaced by the last visible point on the way to it. */
static int mend_corner(divider *d, piece *p, int k, lmb_vec3 anchor, uint32_t parent)
{
    const lmb_vec3 corner = d->b->receiver[p->receiver[k]].at;
    float low = 0.0f, high = 1.0f;
    if (bake_sees(&d->sight, d->b, anchor, corner, p->normal)) {
        return 1;
    }
    for (int i = 0; i < SEARCH; ++i) {
        const float half = 0.5f * (low + high);
        const lmb_vec3 at = add3(anchor, mul3(sub3(corner, anchor), half));
        *(bake_sees(&d->sight, d->b, anchor, at, p->normal) ? &low : &high) = half;
    }
    const lmb_vec3 at = bake_pulled(d->b, add3(anchor, mul3(sub3(corner, anchor), low)), anchor);
    const uint32_t there = find(d, at, anchor, p->normal);
    p->receiver[k] =
        there != LMB_TRANSFER_NONE
            ? there
            : add_receiver(d, at, at, p, parent, parent, 0);
    return p->receiver[k] != LMB_TRANSFER_NONE;
}

/* The anchor is the leaf's middle. If geometry covers the middle, it is the corner with most light. If a point
 * within the leaf gets much more light, all corners are buried and the anchor is that point. */
static int mend_corners(divider *d, piece *p, const float light[PLACES])
{
    lmb_vec3 place[PLACES];
    float highest = -1.0f;
    int best = 0, open = 0;
    bake_quarters(place, p->corner);
    for (int k = 0; k < 3; ++k) {
        const float own = d->b->receiver[p->receiver[k]].light;
        best = own > highest ? k : best;
        highest = maxf(highest, own);
    }
    for (int k = 1; k < PLACES; ++k) {
        open = light[k] > light[open] ? k : open;
    }
    const uint32_t parent = p->receiver[best];
    const lmb_vec3 corner = d->b->receiver[parent].at;
    const int is_buried = light[open] > BURIED * highest;
    lmb_vec3 anchor = place[open];
    if (!is_buried) {
        anchor = bake_sees(&d->sight, d->b, place[0], corner, p->normal) ? place[0] : corner;
    }
    for (int k = 0; k < 3; ++k) {
        if ((is_buried || k != best) && !mend_corner(d, p, k, anchor, parent)) {
            return 0;
        }
    }
    return 1;
}

/* --- rows --------------------------------------------------------------------------------------------------------- */

/* One batch of points and their rows. */
typedef struct batch {
    divider *d;
    wanted *wanted;
    float *const *row;
    const float *times; /* NULL: rows are whole */
} batch;

/* Stores three rows by axis, which lie one after another. The first becomes the row along the normal. */
static void put_directions(uint16_t *to, float *row, uint32_t n, lmb_vec3 normal)
{
    for (size_t i = 0; i < 3 * (size_t)n; ++i) {
        to[i] = bake_short(row[i]);
    }
    for (uint32_t i = 0; i < n; ++i) {
        row[i] = maxf(dot3(vec3(row[i], row[n + i], row[2 * (size_t)n + i]), normal), 0.0f);
    }
}

/* Stores the row of a receiver. If it has parents, the surplus measures the difference from their mean. */
static void settle(void *user, int index, int worker)
{
    const batch *k = user;
    const bake *b = k->d->b;
    const uint32_t n = b->set.elements;
    wanted *w = &k->wanted[index];
    const int is_directed = w->kind == DIRECTED;
    float *row = k->row[is_directed ? 3 * index : index];
    const int parents = w->parent[0] == LMB_TRANSFER_NONE ? 0 : w->parent[2] == LMB_TRANSFER_NONE ? 2 : 3;
    (void)worker;
    if (is_directed) {
        put_directions(b->receiver[w->receiver].directions, row, n, w->normal);
    }
    if (w->receiver != LMB_TRANSFER_NONE) {
        bake_receiver *v = &b->receiver[w->receiver];
        v->light = 0.0f;
        for (uint32_t i = 0; i < n; ++i) {
            v->target.row[i] = bake_short(row[i]);
            v->light += row[i] * b->element[i].light;
        }
    }
    for (int p = 0; p < parents && w->piece != (size_t)-1; ++p) {
        const uint16_t *from = b->receiver[w->parent[p]].target.row;
        for (uint32_t i = 0; i < n; ++i) {
            row[i] -= bake_long(from[i]) * (1.0f / (float)parents);
        }
    }
    for (uint32_t i = 0; k->times != NULL && i < n; ++i) {
        row[i] *= k->times[i];
    }
    w->surplus = parents > 0 && w->piece != (size_t)-1 ? bake_surplus(b, row) : 0.0f;
}

static int by_key(const void *a, const void *b)
{
    const wanted *x = a, *y = b;
    if (x->kind != y->kind) {
        return x->kind < y->kind ? -1 : 1;
    }
    if (x->key != y->key) {
        return x->key < y->key ? -1 : 1;
    }
    return x->number < y->number ? -1 : x->number > y->number;
}

static int keep_rows(divider *d, const wanted *w, int count, report *r)
{
    const size_t n = d->b->set.elements;
    int ok = 1;
    for (int k = 0; k < count && w[k].kind != SAMPLE; ++k) {
        bake_receiver *v = &d->b->receiver[w[k].receiver];
        v->target.row = v->target.row != NULL ? v->target.row : malloc(n * sizeof *v->target.row);
        if (w[k].kind == DIRECTED && v->directions == NULL) {
            v->directions = malloc(3 * n * sizeof *v->directions);
            ok = ok && v->directions != NULL;
        }
        ok = ok && v->target.row != NULL;
    }
    return ok || report_fail(r, "not enough memory for %u receivers", (unsigned)d->b->receiver_count);
}

/* The queue, split into batches. */
typedef struct queue_step {
    divider *d;
    size_t *first; /* index per batch; then the end */
    int32_t batches;
    float *memory, *row[3 * BATCH];
} queue_step;

static int count_of(const queue_step *q, int32_t i) { return (int)(q->first[i + 1] - q->first[i]); }

/* Drops the parents if one is in another zone: light of another zone does not help to predict this receiver. */
static void part_zones(const bake *b, bake_target *t)
{
    t->zone = bake_zone_of(b, t->row, 1);
    for (int k = 0; k < BAKE_PARENTS; ++k) {
        const uint32_t other = t->share[k] > 0.0f ? b->receiver[t->parent[k]].target.zone : BAKE_NO_ZONE;
        if (other != BAKE_NO_ZONE && other != t->zone) {
            memset(t->share, 0, sizeof t->share);
        }
    }
}

static void tell_pieces(const queue_step *q, int32_t number)
{
    for (size_t i = q->first[number]; i < q->first[number + 1]; ++i) {
        const wanted *w = &q->d->queue[i];
        piece *p = w->piece != (size_t)-1 ? &q->d->now.data[w->piece] : NULL;
        if (w->receiver != LMB_TRANSFER_NONE) {
            part_zones(q->d->b, &q->d->b->receiver[w->receiver].target);
        }
        if (p != NULL) {
            p->surplus = maxf(p->surplus, w->surplus);
        }
    }
}

/* Computes the rows of a batch. Sample points use only a quarter of the far elements. */
static int make_batch(void *user, int32_t number, report *r)
{
    const queue_step *q = user;
    divider *d = q->d;
    wanted *w = &d->queue[q->first[number]];
    const int count = count_of(q, number);
    float *times = w->kind == SAMPLE ? q->memory + BATCH * (size_t)d->b->set.elements : NULL;
    lmb_vec3 at[BATCH], normal[BATCH];
    batch k = {d, w, q->row, times};
    for (int i = 0; i < count; ++i) {
        at[i] = w[i].at;
        normal[i] = w[i].normal;
    }
    if (!keep_rows(d, w, count, r) ||
        !bake_rows(d->b, at, normal, count, w->kind == DIRECTED ? 3 : 1, q->row, times, r)) {
        return 0;
    }
    pool_run(d->b->set.threads, count, settle, &k);
    tell_pieces(q, number);
    return 1;
}

static double weight_of(const void *user, int32_t number)
{
    const queue_step *q = user;
    static const double cost[] = {1.0, ACROSS, LOOK}; /* by kind */
    return (double)count_of(q, number) * cost[q->d->queue[q->first[number]].kind];
}

static void put_batch(const void *user, int32_t number, byte_buffer *to)
{
    const queue_step *q = user;
    for (size_t i = q->first[number]; i < q->first[number + 1]; ++i) {
        const wanted *w = &q->d->queue[i];
        const bake_receiver *v = w->receiver != LMB_TRANSFER_NONE ? &q->d->b->receiver[w->receiver] : NULL;
        byte_put_float(to, w->surplus);
        if (v != NULL && v->target.row != NULL) {
            byte_put_float(to, v->light);
            bake_put_halves(to, v->target.row, q->d->b->set.elements);
            if (v->directions != NULL) {
                bake_put_halves(to, v->directions, 3 * (size_t)q->d->b->set.elements);
            }
        }
    }
}

static int get_batch(void *user, int32_t number, byte_reader *from)
{
    const queue_step *q = user;
    report unheard = {""};
    int ok = keep_rows(q->d, &q->d->queue[q->first[number]], count_of(q, number), &unheard);
    for (size_t i = q->first[number]; ok && i < q->first[number + 1]; ++i) {
        wanted *w = &q->d->queue[i];
        bake_receiver *v = w->receiver != LMB_TRANSFER_NONE ? &q->d->b->receiver[w->receiver] : NULL;
        w->surplus = byte_get_float(from);
        if (v != NULL) {
            v->light = byte_get_float(from);
            ok = bake_get_halves(v->target.row, q->d->b->set.elements, from) &&
                 (v->directions == NULL ||
                  bake_get_halves(v->directions, 3 * (size_t)q->d->b->set.elements, from));
        }
        ok = ok && !from->is_short;
    }
    if (ok) {
        tell_pieces(q, number);
    }
    return ok;
}

/* Batches hold neighbours, because they see the same geometry. They never mix kinds. */
static int put_batches(queue_step *q)
{
    const divider *d = q->d;
    q->first = malloc((d->queued + 1) * sizeof *q->first);
    if (q->first == NULL) {
        return report_fail(d->r, "not enough memory for %.0f points", (double)d->queued);
    }
    for (size_t i = 0; i < d->queued; ++i) {
        const wanted *w = &d->queue[q->batches > 0 ? q->first[q->batches - 1] : 0];
        if (q->batches == 0 || i - q->first[q->batches - 1] == BATCH ||
            d->queue[i].kind != w->kind) {
            q->first[q->batches++] = i;
        }
    }
    q->first[q->batches] = d->queued;
    return 1;
}

/* Computes all rows of the queue. */
static int make_rows(divider *d)
{
    for (size_t i = 0; i < d->queued; ++i) {
        d->queue[i].key = bake_key(d->b->scene, d->queue[i].at, d->queue[i].normal);
        d->queue[i].number = i;
    }
    sort(d->queue, d->queued, sizeof *d->queue, by_key);
    const uint32_t n = d->b->set.elements;
    queue_step q = {d, NULL, 0, malloc(3 * BATCH * (size_t)n * sizeof(float)), {NULL}};
    int ok =
        (q.memory != NULL || report_fail(d->r, "not enough memory for %u elements", (unsigned)n)) && put_batches(&q);
    for (int k = 0; k < 3 * BATCH; ++k) {
        q.row[k] = ok ? q.memory + (size_t)k * n : NULL;
    }
    const bake_step step = {q.batches, weight_of, make_batch, put_batch, get_batch, &q};
    ok = ok && bake_share_step(d->b->share, &step, d->r);
    free(q.memory);
    free(q.first);
    d->queued = 0;
    return ok;
}

/* --- division ----------------------------------------------------------------------------------------------------- */

/* Queues the sample points of a piece: the midpoint of the longest edge, unless a neighbour did, and the middle. */
static int look_at(divider *d, size_t i)
{
    piece *p = &d->now.data[i];
    const float longest = triangle_longest(&p->from, p->corner);
    const int to = (p->from + 1) % 3;
    p->mid = LMB_TRANSFER_NONE;
    p->surplus = 0.0f;
    p->must_split = p->is_shared = 0;
    if (longest <= d->b->set.smallest_m || p->depth == DEPTH) {
        return 1;
    }
    const lmb_vec3 mid = mul3(add3(p->corner[p->from], p->corner[to]), 0.5f), middle = triangle_middle(p->corner);
    const size_t before = d->queued;
    p->must_split = !bake_stands_free(&d->sight, d->b, p->corner, p->normal);
    p->mid = receiver_at(d, mid, p, p->receiver[p->from], p->receiver[to]);
    p->is_shared = d->queued == before;
    if (!p->is_shared) {
        d->queue[before].piece = i;
    }
    const wanted w = {middle, p->normal, {p->receiver[0], p->receiver[1], p->receiver[2]}, LMB_TRANSFER_NONE, i,
                      SAMPLE, 0,         0.0f,                                              0};
    return p->mid != LMB_TRANSFER_NONE && enqueue(d, &w);
}

/* Sets a leaf's index in the file. The corners are mended when all leaves exist. */
static int put_leaf(divider *d, const piece *p)
{
    d->b->section[LMB_TRANSFER_DIVISIONS].data[p->node] = LMB_TRANSFER_LEAF | (uint32_t)d->leaves.count;
    return add_piece(&d->leaves, p, d->r);
}

/* Leaves that geometry touches, and the light at points within each. */
typedef struct mending {
    divider *d;
    uint32_t *leaf;
    uint32_t count;
    float (*light)[PLACES];
    float *memory;
} mending;

static uint32_t past_of(const mending *m, int32_t number)
{
    return bake_past(number, BATCH / PLACES, m->count);
}

/* Lights the points of BATCH / PLACES leaves. */
static int light_places(void *user, int32_t number, report *r)
{
    const mending *m = user;
    const bake *b = m->d->b;
    const uint32_t n = b->set.elements, first = (uint32_t)number * (BATCH / PLACES), some = past_of(m, number) - first;
    lmb_vec3 at[BATCH] = {{0.0f, 0.0f, 0.0f}}, normal[BATCH] = {{0.0f, 0.0f, 0.0f}};
    float *row[BATCH] = {NULL}, *times = m->memory + BATCH * (size_t)n;
    for (uint32_t i = 0; i < PLACES * some; ++i) {
        const piece *p = &m->d->leaves.data[m->leaf[first + i / PLACES]];
        row[i] = m->memory + (size_t)i * n;
        normal[i] = p->normal;
        if (i % PLACES == 0) {
            bake_quarters(at + i, p->corner);
        }
    }
    if (!bake_rows(b, at, normal, (int)(PLACES * some), 1, row, times, r)) {
        return 0;
    }
    for (uint32_t i = 0; i < PLACES * some; ++i) {
        float light = 0.0f;
        for (uint32_t e = 0; e < n; ++e) {
            light += row[i][e] * times[e] * b->element[e].light;
        }
        m->light[first + i / PLACES][i % PLACES] = light;
    }
    return 1;
}

static double light_weight(const void *user, int32_t number)
{
    return LOOK * (double)(PLACES * (past_of(user, number) - (uint32_t)number * (BATCH / PLACES)));
}

static void put_light(const void *user, int32_t number, byte_buffer *to)
{
    const mending *m = user;
    for (uint32_t i = (uint32_t)number * (BATCH / PLACES); i < past_of(m, number); ++i) {
        byte_put_floats(to, m->light[i], PLACES);
    }
}

static int get_light(void *user, int32_t number, byte_reader *from)
{
    const mending *m = user;
    for (uint32_t i = (uint32_t)number * (BATCH / PLACES); i < past_of(m, number); ++i) {
        byte_get_floats(m->light[i], from, PLACES);
    }
    return !from->is_short;
}

/* Tests from the middle, like the mending of a leaf: the first triangle at a corner defines the position. */
static int sees_corners(divider *d, const piece *p)
{
    const lmb_vec3 middle = triangle_middle(p->corner);
    for (int k = 0; k < 3; ++k) {
        if (!bake_sees(&d->sight, d->b, middle, d->b->receiver[p->receiver[k]].at, p->normal)) {
            return 0;
        }
    }
    return 1;
}

static int mend_leaves(divider *d)
{
    mending m = {d, malloc((d->leaves.count + 1) * sizeof *m.leaf), 0, NULL,
                 malloc((BATCH + 1) * (size_t)d->b->set.elements * sizeof *m.memory)};
    for (uint32_t i = 0; m.leaf != NULL && i < d->leaves.count; ++i) {
        m.leaf[m.count] = i;
        m.count += !sees_corners(d, &d->leaves.data[i]);
    }
    m.light = malloc(((size_t)m.count + 1) * sizeof *m.light);
    int ok = (m.leaf != NULL && m.light != NULL && m.memory != NULL) ||
             report_fail(d->r, "not enough memory for %u elements", (unsigned)d->b->set.elements);
    const bake_step step = {(int32_t)((m.count + BATCH / PLACES - 1) / (BATCH / PLACES)), light_weight, light_places,
                            put_light, get_light, &m};
    ok = ok && bake_share_step(d->b->share, &step, d->r);
    for (uint32_t i = 0; ok && i < m.count; ++i) {
        ok = mend_corners(d, &d->leaves.data[m.leaf[i]], m.light[i]);
    }
    free(m.leaf);
    free(m.light);
    free(m.memory);
    return ok;
}

/* Writes the leaves into the sections of the file. */
static int put_leaves(divider *d)
{
    for (size_t i = 0; i < d->leaves.count; ++i) {
        const piece *p = &d->leaves.data[i];
        for (int k = 0; k < 3; ++k) {
            d->b->receiver[p->receiver[k]].target.support += triangle_area(p->corner) * (1.0f / 3.0f);
            if (!bake_put(&d->b->section[LMB_TRANSFER_CORNERS], p->receiver[k], d->r)) {
                return 0;
            }
        }
    }
    return 1;
}

/* Returns the most light that reaches an element below a node of the pieces. */
static float brightest(const bake *b, uint32_t node)
{
    const uint32_t word = b->section[LMB_TRANSFER_PIECES].data[node];
    if (word & LMB_TRANSFER_LEAF) {
        return b->element[word & ~LMB_TRANSFER_LEAF].light;
    }
    const uint32_t first = bake_first(b, word);
    return maxf(brightest(b, first), brightest(b, first + 1));
}

/* Sets the half's own part of the elements. If geometry touches an element and covers the middle, the light there is
 * no measure. */
static void enter_source(const bake *b, piece *half, uint32_t h)
{
    const uint32_t *node = b->section[LMB_TRANSFER_PIECES].data, word = node[half->source];
    if (word & LMB_TRANSFER_LEAF) {
        return;
    }
    half->source = bake_first(b, word) + h;
    const uint32_t own = node[half->source];
    if ((own & LMB_TRANSFER_LEAF) == 0 || !b->element[own & ~LMB_TRANSFER_LEAF].is_stood_on) {
        half->light = brightest(b, half->source);
    }
}

/* Splits a piece into halves, which are sampled next; `last`: they are leaves. */
static int split(divider *d, const piece *p, int last)
{
    bake_words *w = &d->b->section[LMB_TRANSFER_DIVISIONS];
    const int to = (p->from + 1) % 3;
    const lmb_vec3 mid = mul3(add3(p->corner[p->from], p->corner[to]), 0.5f);
    const uint32_t first = (uint32_t)w->count;
    if (!bake_put(w, 0, d->r) || !bake_put(w, 0, d->r)) {
        return 0;
    }
    w->data[p->node] = (uint32_t)p->from << LMB_TRANSFER_EDGE_BIT | first;
    for (uint32_t h = 0; h < 2; ++h) {
        const int k = h == 0 ? to : p->from;
        piece half = *p;
        half.corner[k] = mid;
        half.receiver[k] = p->mid;
        half.node = first + h;
        ++half.depth;
        enter_source(d->b, &half, h);
        if (!(last ? put_leaf(d, &half) : add_piece(&d->now, &half, d->r))) {
            return 0;
        }
    }
    return 1;
}

/* Squared errors add up by area. They count less if the elements get little light: perhaps through a crack into a
 * solid. */
static float error_of(const divider *d, const piece *p)
{
    const float share = triangle_area(p->corner) / d->b->area * 1000.0f;
    const float surplus = p->must_split ? STANDS : p->surplus;
    return surplus * surplus * share * minf(p->light / (DIM * d->light), 1.0f);
}

static int by_error(const void *a, const void *b)
{
    const piece *x = a, *y = b;
    return x->error != y->error ? (x->error < y->error ? -1 : 1) : x->node < y->node ? -1 : 1;
}

/* Keeps neighbours together for the rows. */
static int by_place(const void *a, const void *b)
{
    const piece *x = a, *y = b;
    return x->node < y->node ? -1 : 1;
}

/* Measures how far the midpoints that a neighbour made differ from the mean of the edge's ends. */
static int compare_shared(divider *d)
{
    const uint32_t n = d->b->set.elements;
    float *row = malloc(n * sizeof *row);
    for (size_t i = 0; row != NULL && i < d->now.count; ++i) {
        piece *p = &d->now.data[i];
        const bake_receiver *v = d->b->receiver;
        if (p->mid == LMB_TRANSFER_NONE || !p->is_shared) {
            continue;
        }
        const uint16_t *mid = v[p->mid].target.row, *from = v[p->receiver[p->from]].target.row,
                       *to = v[p->receiver[(p->from + 1) % 3]].target.row;
        for (uint32_t k = 0; k < n; ++k) {
            row[k] = bake_long(mid[k]) - 0.5f * bake_long(from[k]) - 0.5f * bake_long(to[k]);
        }
        p->surplus = maxf(p->surplus, bake_surplus(d->b, row));
    }
    free(row);
    return row != NULL || report_fail(d->r, "not enough memory for %u elements", (unsigned)n);
}

/* Samples the current pieces. Those that can be halved wait with their errors; the others are leaves. */
static int look_at_all(divider *d)
{
    sort(d->now.data, d->now.count, sizeof *d->now.data, by_place);
    for (size_t i = 0; i < d->now.count; ++i) {
        progress_again();
        if (!look_at(d, i)) {
            return 0;
        }
    }
    if (!make_rows(d) || !compare_shared(d)) {
        return 0;
    }
    for (size_t i = 0; i < d->now.count; ++i) {
        piece *p = &d->now.data[i];
        p->error = error_of(d, p);
        if (!(p->mid == LMB_TRANSFER_NONE ? put_leaf(d, p) : add_piece(&d->waiting, p, d->r))) {
            return 0;
        }
    }
    d->now.count = 0;
    return make_rows(d);
}

/* Halves the pieces with the largest errors. If all are good enough, d->now stays empty. */
static int halve_worst(divider *d)
{
    const float enough = d->b->set.division * d->b->set.division;
    const size_t limit = d->waiting.count / 4 + ROUND;
    sort(d->waiting.data, d->waiting.count, sizeof *d->waiting.data, by_error);
    const float worst = d->waiting.count > 0 ? d->waiting.data[d->waiting.count - 1].error : 0.0f;
    for (size_t i = 0; i < limit && d->waiting.count > 0 && d->b->receiver_count < d->b->set.receivers; ++i) {
        const piece p = d->waiting.data[d->waiting.count - 1];
        if (p.error <= maxf(enough, WAIT * worst)) {
            break;
        }
        --d->waiting.count;
        if (!split(d, &p, 0)) {
            return 0;
        }
    }
    return 1;
}

/* --- roots -------------------------------------------------------------------------------------------------------- */

/* Adds the parts of a cut triangle. A part gets new receivers at the corners, or shares those that are visible from
 * it. */
static int add_parts(divider *d, const piece *p, uint32_t cut)
{
    const bake_cut c = d->b->cut[cut];
    uint32_t first;
    if (c.first == 0) {
        piece own = *p;
        for (int k = 0; k < 3; ++k) {
            own.receiver[k] = receiver_at(d, p->corner[k], p, LMB_TRANSFER_NONE, LMB_TRANSFER_NONE);
            if (own.receiver[k] == LMB_TRANSFER_NONE) {
                return 0;
            }
        }
        return add_piece(&d->now, &own, d->r);
    }
    if (!bake_divide(d->b, &d->b->section[LMB_TRANSFER_DIVISIONS], p->node, &c, &first, d->r)) {
        return 0;
    }
    for (uint32_t h = 0; h < 2; ++h) {
        piece half = *p;
        half.corner[h == 0 ? (c.from + 1) % 3 : c.from] = bake_cut_at(&c, p->corner);
        half.node = first + h;
        enter_source(d->b, &half, h);
        if (!add_parts(d, &half, c.first + h)) {
            return 0;
        }
    }
    return 1;
}

static int add_root(divider *d, const lmb_triangle *t, lmb_vec3 normal, uint32_t id, uint32_t back)
{
    bake_words *divisions = &d->b->section[LMB_TRANSFER_DIVISIONS];
    piece p;
    memset(&p, 0, sizeof p);
    memcpy(p.corner, t->corner, sizeof p.corner);
    p.normal = mul3(normal, back ? -1.0f : 1.0f);
    p.takes_direction = bake_takes_direction(t->material);
    p.node = (uint32_t)divisions->count;
    p.source = d->b->section[LMB_TRANSFER_SURFACES].data[4 * (id - 1) + back];
    p.light = brightest(d->b, p.source);
    d->b->section[LMB_TRANSFER_SURFACES].data[4 * (id - 1) + 2 + back] = p.node;
    return bake_put(divisions, 0, d->r) && add_parts(d, &p, d->b->cut_root[id - 1]);
}

static int add_roots(divider *d)
{
    const bake *b = d->b;
    const uint32_t all = lmb_scene_triangles(b->scene);
    for (uint32_t id = 1; id <= all; ++id) {
        lmb_triangle t;
        lmb_vec3 normal;
        float area;
        if (!lmb_triangle_fetch(&t, b->scene, id) || !lmb_triangle_shape(&normal, &area, &t) ||
            bake_is_small(b, t.corner)) {
            continue;
        }
        for (uint32_t back = 0; back < 2; ++back) {
            if (b->section[LMB_TRANSFER_SURFACES].data[4 * (id - 1) + back] != LMB_TRANSFER_NONE &&
                !add_root(d, &t, normal, id, back)) {
                return 0;
            }
        }
    }
    for (size_t i = 0; i < d->queued; ++i) {
        d->queue[i].piece = (size_t)-1;
    }
    if (b->set.receivers == 0) {
        d->b->set.receivers = b->receiver_count + b->set.dividing +
                              (b->has_thin ? (uint32_t)(PER_CORNER * (float)b->receiver_count) : 0);
    }
    if (b->receiver_count > b->set.receivers) {
        return report_fail(d->r, "%u receivers are wanted before any division, and --receivers allows %u; raise it, or "
                           "light more triangles by clusters with a larger --cluster",
                           (unsigned)b->receiver_count, (unsigned)b->set.receivers);
    }
    return make_rows(d);
}

static float mean_light(const bake *b)
{
    double light = 0.0, area = 0.0;
    for (uint32_t i = 0; i < b->element_count; ++i) {
        light += (double)(b->element[i].light * bake_open_area(&b->element[i]));
        area += (double)bake_open_area(&b->element[i]);
    }
    return area > 0.0 && light > 0.0 ? (float)(light / area) : 1.0f;
}

int bake_receivers(bake *b, report *r)
{
    divider d;
    memset(&d, 0, sizeof d);
    d.b = b;
    d.r = r;
    d.light = mean_light(b);
    d.mask = (1u << 20) - 1;
    d.slot = calloc((size_t)d.mask + 1, sizeof *d.slot);
    progress_tell("receivers", 0.0);
    int ok = d.slot != NULL || report_fail(r, "not enough memory for receivers");
    ok = ok && bake_sight_begin(&d.sight, r) && add_roots(&d);
    while (ok && d.now.count > 0) {
        progress_tell("receivers", (double)minf((float)b->receiver_count / (float)b->set.receivers, 1.0f));
        ok = look_at_all(&d) && halve_worst(&d);
    }
    for (size_t i = 0; ok && i < d.waiting.count; ++i) { /* their midpoints exist: use them too */
        ok = split(&d, &d.waiting.data[i], 1);
    }
    ok = ok && make_rows(&d) && mend_leaves(&d) && put_leaves(&d) && make_rows(&d);
    free(d.slot);
    bake_sight_end(&d.sight, b);
    b->leaves = (uint32_t)(b->section[LMB_TRANSFER_CORNERS].count / LMB_TRANSFER_CORNER_WORDS);
    free(d.queue);
    free(d.now.data);
    free(d.waiting.data);
    free(d.leaves.data);
    return ok;
}
