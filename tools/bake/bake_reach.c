/* bake_reach.c: which sides of surfaces light can reach, seen from the lights and cameras; removes the insides of
 * solids. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "bake_share.h"

enum { BATCH = 64, PARTS = 64, WITNESSES = BAKE_NEAREST, SHARED = 1024 /* SHARED elements: slices share a step */ };
#define MIDDLES 0.5 /* cost of a place that uses only middles, in rows of a receiver */
#define GRAZING 0.003f /* least cosine for which two elements surely see each other */
#define BRIGHT 0.01f /* of the mean */
#define OVER   0.05f /* of the smallest edge: height of the sample points over an element */

#define ALBEDO 0.5f  /* assumed for all surfaces */
#define DARK   1e-6f /* of the brightest element: less light came through a crack */
#define HIDDEN 0.01  /* of the mean light: darker elements are sorted apart */

typedef struct sender {
    float light;
    uint32_t element;
} sender;

typedef struct reach {
    bake *b;
    uint8_t *has_sent; /* per element */
    sender *order;     /* brightest first */
    float *memory;
    float *before; /* light of each element before a step */
    float bright; /* more light than this did not come through a crack */
    uint64_t *seen; /* by element: which points of a batch */
    uint32_t *zone; /* by element: itself, or another one that shares light with it */
    report *r;
} reach;

/* Points that send light together, to all or some elements. */
typedef struct sending {
    reach *w;
    const lmb_vec3 *at, *normal;
    const float *power;
    int count, parts;
    float *row[BATCH];
} sending;

/* Excludes pairs in each other's plane, which rounding may connect through the edge of a wall. */
static int are_facing(const bake_element *e, lmb_vec3 at, lmb_vec3 normal)
{
    const lmb_vec3 d = sub3(bake_place(e), at), facing = bake_facing(e);
    const float low = GRAZING * length3(d);
    return dot3(d, normal) > low && dot3(d, facing) < -low;
}

/* By reciprocity each element receives as much as the points see of it. */
static int send_part(void *user, int32_t part, report *r)
{
    const sending *s = user;
    bake *b = s->w->b;
    if (!bake_rows_part(b, s->at, s->normal, s->count, 1, s->row, NULL, part, s->parts, r)) {
        return 0;
    }
    for (uint32_t i = 0; i < b->element_count; ++i) {
        if (!bake_rows_has(b, i, part, s->parts)) {
            continue;
        }
        b->element[i].light = s->w->before[i];
        s->w->seen[i] = 0;
        for (int k = 0; k < s->count; ++k) {
            s->w->seen[i] |= (uint64_t)(s->row[k][i] > 0.0f && are_facing(&b->element[i], s->at[k], s->normal[k])) << k;
            b->element[i].light += s->row[k][i] > 0.0f ? s->power[k] * s->row[k][i] / b->element[i].area : 0.0f;
        }
    }
    return 1;
}

static double weight_of(const void *user, int32_t part)
{
    const sending *s = user;
    (void)part;
    return MIDDLES * (double)s->count / (double)s->parts;
}

static void put_part(const void *user, int32_t part, byte_buffer *to)
{
    const sending *s = user;
    for (uint32_t i = 0; i < s->w->b->element_count; ++i) {
        if (bake_rows_has(s->w->b, i, part, s->parts)) {
            byte_put_float(to, s->w->b->element[i].light);
            byte_put_int(to, (int32_t)(uint32_t)(s->w->seen[i] & 0xffffffffu));
            byte_put_int(to, (int32_t)(uint32_t)(s->w->seen[i] >> 32));
        }
    }
}

static int get_part(void *user, int32_t part, byte_reader *from)
{
    const sending *s = user;
    for (uint32_t i = 0; i < s->w->b->element_count; ++i) {
        if (bake_rows_has(s->w->b, i, part, s->parts)) {
            s->w->b->element[i].light = byte_get_float(from);
            s->w->seen[i] = (uint32_t)byte_get_int(from);
            s->w->seen[i] |= (uint64_t)(uint32_t)byte_get_int(from) << 32;
        }
    }
    return !from->is_short;
}

/* --- zones -------------------------------------------------------------------------------------------------------- */

static uint32_t zone_of(reach *w, uint32_t i)
{
    while (w->zone[i] != i) {
        w->zone[i] = w->zone[w->zone[i]];
        i = w->zone[i];
    }
    return i;
}

static void unite(reach *w, uint32_t a, uint32_t b)
{
    a = zone_of(w, a);
    b = zone_of(w, b);
    w->zone[a > b ? a : b] = a > b ? b : a;
}

/* Joins elements with those that sent light to them: everything a point sees is one zone. `from`: the senders, or
 * NULL if all points are one place in the air. */
static void unite_seen(reach *w, const uint32_t *from)
{
    uint32_t first = LMB_TRANSFER_NONE;
    for (uint32_t i = 0; i < w->b->element_count; ++i) {
        for (uint64_t bits = w->seen[i]; from != NULL && bits != 0; bits &= bits - 1) {
            unite(w, from[lowest_bit(bits)], i);
        }
        if (from == NULL && w->seen[i] != 0) {
            first = first == LMB_TRANSFER_NONE ? i : first;
            unite(w, first, i);
        }
    }
}

/* Numbers zones from 1 on, by their first elements. Single elements get none, because nothing is known of them. */
static int set_zones(reach *w)
{
    const bake *b = w->b;
    uint32_t *size = calloc(b->element_count + 1, sizeof *size);
    for (uint32_t i = 0; size != NULL && i < b->element_count; ++i) {
        ++size[zone_of(w, i)];
    }
    for (uint32_t i = 0; size != NULL && i < b->element_count; ++i) {
        b->element[i].zone = size[zone_of(w, i)] > 1 ? 1 + zone_of(w, i) : BAKE_NO_ZONE;
    }
    free(size);
    return size != NULL || report_fail(w->r, "not enough memory for %u elements", (unsigned)b->element_count);
}

/* Sends light from points to all that they see. */
static int send(reach *w, const lmb_vec3 *at, const lmb_vec3 *normal, const float *power, int count,
                const uint32_t *from)
{
    bake_share *share = w->b->set.elements >= SHARED ? w->b->share : NULL;
    const int slices = share != NULL ? (int)share->slice.count : 1;
    sending s = {w, at, normal, power, count, slices < BAKE_PARTS ? slices : BAKE_PARTS, {NULL}};
    const bake_step step = {s.parts, weight_of, send_part, put_part, get_part, &s};
    for (int k = 0; k < count; ++k) {
        s.row[k] = w->memory + (size_t)k * w->b->set.elements;
    }
    for (uint32_t i = 0; i < w->b->element_count; ++i) {
        w->before[i] = w->b->element[i].light;
    }
    const int ok = bake_share_step(share, &step, w->r);
    if (ok) {
        unite_seen(w, from);
    }
    return ok;
}

/* Sends light in all directions from a point in the air. */
static int send_around(reach *w, lmb_vec3 from)
{
    static const float power[6] = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
    lmb_vec3 at[6], normal[6];
    for (int k = 0; k < 6; ++k) {
        const float sign = k % 2 ? -1.0f : 1.0f;
        at[k] = from;
        normal[k] = vec3(k / 2 == 0 ? sign : 0.0f, k / 2 == 1 ? sign : 0.0f, k / 2 == 2 ? sign : 0.0f);
    }
    return send(w, at, normal, power, 6, NULL);
}

static int by_light(const void *a, const void *b)
{
    const sender *x = a, *y = b;
    return x->light != y->light ? (x->light > y->light ? -1 : 1) : x->element < y->element ? -1 : 1;
}

/* Chooses the brightest elements that have not sent their light yet, except those partly inside a solid; returns how
 * many. */
static int next_senders(reach *w, uint32_t chosen[BATCH])
{
    const bake *b = w->b;
    int count = 0;
    for (uint32_t i = 0; i < b->element_count; ++i) {
        w->order[i].element = i;
        w->order[i].light = b->element[i].is_stood_on ? 0.0f : b->element[i].light;
    }
    qsort(w->order, b->element_count, sizeof *w->order, by_light);
    for (uint32_t i = 0; i < b->element_count && count < BATCH; ++i) {
        const uint32_t e = w->order[i].element;
        if (!w->has_sent[e] && w->order[i].light > DARK * w->order[0].light) {
            w->has_sent[e] = 1;
            chosen[count++] = e;
        }
    }
    return count;
}

static int spread(reach *w, const lmb_vec3 *eyes, uint32_t count)
{
    const lmb_scene *s = w->b->scene;
    const lmb_vec3 middle = mul3(add3(s->bounds_min, s->bounds_max), 0.5f);
    lmb_vec3 at[BATCH], normal[BATCH];
    float power[BATCH];
    uint32_t chosen[BATCH];
    for (uint32_t i = 0; i < count; ++i) {
        if (!send_around(w, eyes[i])) {
            return 0;
        }
    }
    for (uint32_t i = 0; i < s->light_count; ++i) {
        const lmb_light *l = &s->lights[i];
        const lmb_vec3 far = sub3(middle, mul3(l->direction, length3(sub3(s->bounds_max, s->bounds_min))));
        if (!send_around(w, l->kind == LMB_LIGHT_DIRECTIONAL ? far : l->position)) {
            return 0;
        }
    }
    uint32_t done = 0;
    for (int n = next_senders(w, chosen); n > 0; n = next_senders(w, chosen), done += (uint32_t)n) {
        progress_tell("surfaces", (double)done / (double)w->b->element_count);
        for (int k = 0; k < n; ++k) {
            const bake_element *e = &w->b->element[chosen[k]];
            at[k] = bake_place(e);
            normal[k] = bake_facing(e);
            power[k] = ALBEDO * e->light * e->area;
        }
        if (!send(w, at, normal, power, n, chosen)) {
            return 0;
        }
    }
    return 1;
}

/* A side of a triangle stays if one of its elements was reached. */
static int is_side_reached(const reach *w, uint32_t root)
{
    const uint32_t *node = w->b->section[LMB_TRANSFER_PIECES].data;
    if (node[root] & LMB_TRANSFER_LEAF) {
        const uint32_t e = node[root] & ~LMB_TRANSFER_LEAF;
        return w->b->element[e].is_stood_on ? w->b->element[e].open > 0.0f : w->has_sent[e];
    }
    const uint32_t first = bake_first(w->b, node[root]);
    return is_side_reached(w, first) || is_side_reached(w, first + 1);
}

/* Leaves of cuts that no light reaches, as the floor under a box, need one element each. */
static void close_leaves(const reach *w, uint32_t root, uint32_t cut, uint32_t back)
{
    bake_cut *c = &w->b->cut[cut];
    const uint32_t word = w->b->section[LMB_TRANSFER_PIECES].data[root];
    if (c->first == 0) {
        c->is_closed[back] = !is_side_reached(w, root);
        return;
    }
    const uint32_t first = bake_first(w->b, word);
    close_leaves(w, first, c->first, back);
    close_leaves(w, first + 1, c->first + 1, back);
}

static void close_cuts(const reach *w, int ok)
{
    const bake *b = w->b;
    for (uint32_t id = 1; ok && id <= lmb_scene_triangles(b->scene); ++id) {
        const uint32_t *root = b->section[LMB_TRANSFER_SURFACES].data + LMB_TRANSFER_SURFACE_WORDS * (size_t)(id - 1);
        for (uint32_t back = 0; back < 2 && b->cut_root[id - 1] > 0; ++back) {
            if (root[back] != LMB_TRANSFER_NONE) {
                close_leaves(w, root[back], b->cut_root[id - 1], back);
            }
        }
    }
}

/* --- elements that other geometry touches ------------------------------------------------------------------------- */

/* Finds the nearest reached elements that face it and that it faces. */
static void find_witnesses(bake_nearest *out, const reach *w, const bake_element *e)
{
    out->count = 0;
    out->limit = WITNESSES;
    for (uint32_t i = 0; i < w->b->element_count; ++i) {
        const bake_element *o = &w->b->element[i];
        const lmb_vec3 place = bake_place(o), d = sub3(place, e->middle);
        const float d2 = dot3(d, d);
        if (w->has_sent[i] && !o->is_stood_on && dot3(d, e->normal) >= 0.1f * sqrtf(d2) && dot3(d, o->normal) <= 0.0f &&
            bake_is_near(out, d2)) {
            bake_nearest_put(out, place, d2);
        }
    }
}

/* The middles of 64 parts of an element, and points just above them. */
static void set_parts(const bake *b, const bake_element *e, lmb_vec3 at[PARTS], lmb_tile *tile)
{
    const lmb_vec3 u = mul3(sub3(e->corner[1], e->corner[0]), 0.125f),
                   v = mul3(sub3(e->corner[2], e->corner[0]), 0.125f);
    const lmb_vec3 up = mul3(e->normal, OVER * b->set.smallest_m);
    int count = 0;
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 15 - 2 * y; ++x) {
            const float third = x % 2 == 0 ? 1.0f / 3.0f : 2.0f / 3.0f;
            const lmb_vec3 p = add3(e->corner[0], add3(mul3(u, (float)(x / 2) + third), mul3(v, (float)y + third)));
            at[count] = p;
            tile->position[0][count] = p.x + up.x;
            tile->position[1][count] = p.y + up.y;
            tile->position[2][count] = p.z + up.z;
            tile->depth[count] = 1.0f;
            tile->id[count++] = 1;
        }
    }
    tile->hits = count;
}

/* Parts that see a lit surface are open. */
static void open_element(const reach *w, bake_element *e, lmb_tile *tile, lmb_traversal *traversal)
{
    bake_nearest witness;
    lmb_vec3 at[PARTS], sum = vec3(0.0f, 0.0f, 0.0f);
    uint64_t hidden = ~(uint64_t)0;
    bake_bound(traversal);
    find_witnesses(&witness, w, e);
    set_parts(w->b, e, at, tile);
    const float noise = lmb_tile_noise(tile, hidden);
    for (int k = 0; k < witness.count && hidden != 0; ++k) {
        hidden &= lmb_occluded_tile(w->b->kernels, traversal, &w->b->bvh, tile, hidden, witness.at[k],
                                    noise + lmb_place_noise(witness.at[k], 0.0f));
    }
    const int open = PARTS - count_bits(hidden);
    for (uint64_t bits = ~hidden; bits != 0; bits &= bits - 1) {
        sum = add3(sum, at[lowest_bit(bits)]);
    }
    if (open == 0 && e->light > w->bright) { /* the middle is lit, but not from these witnesses */
        return;
    }
    e->open = (float)open * (1.0f / (float)PARTS);
    e->middle = open > 0 ? mul3(sum, 1.0f / (float)open) : e->middle;
}

static int open_elements(reach *w)
{
    lmb_tile *tile = calloc(1, sizeof *tile);
    lmb_traversal traversal;
    memset(&traversal, 0, sizeof traversal);
    for (uint32_t i = 0; i < w->b->element_count; ++i) {
        w->bright += BRIGHT * w->b->element[i].light / (float)w->b->element_count;
    }
    for (uint32_t i = 0; tile != NULL && i < w->b->element_count; ++i) {
        if (w->b->element[i].is_stood_on) {
            open_element(w, &w->b->element[i], tile, &traversal);
        }
    }
    bake_count_coarse(w->b, traversal.coarse);
    free(tile);
    return tile != NULL || report_fail(w->r, "not enough memory for a tile");
}

/* Joins parts that see a lit surface. */
static void join_elements(bake *b)
{
    for (uint32_t i = 0; i < b->element_count; ++i) {
        bake_join(b, &b->element[i]);
    }
}

/* Area without light sends nothing, so it counts in no mean of a node. */
static void sort_out(const reach *w)
{
    bake *b = w->b;
    double light = 0.0, area = 0.0;
    for (uint32_t i = 0; i < b->element_count; ++i) {
        light += (double)(b->element[i].light * b->element[i].area);
        area += (double)b->element[i].area;
    }
    for (uint32_t i = 0; i < b->element_count; ++i) {
        bake_element *e = &b->element[i];
        e->is_hidden = !e->is_stood_on && (double)e->light < HIDDEN * light / area;
        e->is_dark = e->is_stood_on ? !(e->open > 0.0f) : !w->has_sent[i];
        e->area = e->is_dark ? 0.0f : e->area;
    }
}

static int find_reached(bake *b, const lmb_vec3 *eyes, uint32_t count, report *r)
{
    reach w = {b, NULL, NULL, NULL, NULL, 0.0f, NULL, NULL, r};
    bake_words *surfaces = &b->section[LMB_TRANSFER_SURFACES];
    if (count + b->scene->light_count == 0) {
        for (uint32_t i = 0; i < b->element_count; ++i) {
            b->element[i].light = 1.0f;
        }
        return 1;
    }
    w.has_sent = calloc(b->set.elements, 1);
    w.order = malloc(b->set.elements * sizeof *w.order);
    w.memory = malloc((size_t)BATCH * b->set.elements * sizeof *w.memory);
    w.before = malloc(b->set.elements * sizeof *w.before);
    w.seen = calloc(b->set.elements, sizeof *w.seen);
    w.zone = malloc(b->set.elements * sizeof *w.zone);
    for (uint32_t i = 0; w.zone != NULL && i < b->set.elements; ++i) {
        w.zone[i] = i;
    }
    int ok = (w.has_sent != NULL && w.order != NULL && w.memory != NULL && w.before != NULL && w.seen != NULL &&
              w.zone != NULL) ||
             report_fail(r, "not enough memory for %u elements", (unsigned)b->set.elements);
    b->by_middles = 1; /* elements partly in a solid must not lead into it */
    ok = ok && spread(&w, eyes, count);
    b->by_middles = 0;
    ok = ok && open_elements(&w) && bake_smalls(b, r) && set_zones(&w);
    close_cuts(&w, ok);
    for (size_t i = 0; ok && i < surfaces->count; ++i) {
        const size_t back = i % LMB_TRANSFER_SURFACE_WORDS;
        if (back < 2 && surfaces->data[i] != LMB_TRANSFER_NONE &&
            b->small_open[2 * (i / LMB_TRANSFER_SURFACE_WORDS) + back] == 0 &&
            !is_side_reached(&w, surfaces->data[i])) {
            surfaces->data[i] = LMB_TRANSFER_NONE;
        }
    }
    if (ok) {
        join_elements(b);
        sort_out(&w);
        ok = bake_order(b, r);
    }
    free(w.has_sent);
    free(w.order);
    free(w.memory);
    free(w.before);
    free(w.seen);
    free(w.zone);
    return ok;
}

/* The first pass removes whole sides; then all elements lie on the rest. */
int bake_reach(bake *b, const lmb_vec3 *eyes, uint32_t count, report *r)
{
    return bake_cuts(b, r) && bake_elements(b, r) && find_reached(b, eyes, count, r) && bake_elements(b, r) &&
           find_reached(b, eyes, count, r) && bake_zones(b, r);
}
