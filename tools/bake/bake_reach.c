/* bake_reach.c: which sides of surfaces light can come to, and be seen from: the insides of solids are left out. */
#include "bake.h"

#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"

enum { BATCH = 64 };

#define ALBEDO 0.5f  /* of all surfaces */
#define DARK   1e-6f /* of the brightest element: less came through a crack */
#define HIDDEN 0.01  /* of the mean light: is put in order apart */

typedef struct sender {
    float light;
    uint32_t element;
} sender;

typedef struct reach {
    bake *b;
    uint8_t *has_sent; /* an element */
    sender *order;     /* the brightest first */
    float *memory;
    report *r;
} reach;

/* Light goes from points to all that they see: by reciprocity, as much as they see of it. */
static int send(reach *w, const lmb_vec3 *at, const lmb_vec3 *normal, const float *power, int count)
{
    float *row[BATCH] = {NULL};
    for (int k = 0; k < count; ++k) {
        row[k] = w->memory + (size_t)k * w->b->set.elements;
    }
    if (!bake_rows(w->b, at, normal, count, 1, row, w->r)) {
        return 0;
    }
    for (int k = 0; k < count; ++k) {
        for (uint32_t i = 0; i < w->b->element_count; ++i) {
            w->b->element[i].light += row[k][i] > 0.0f ? power[k] * row[k][i] / w->b->element[i].area : 0.0f;
        }
    }
    return 1;
}

/* All around a point in the air. */
static int send_around(reach *w, lmb_vec3 from)
{
    static const float power[6] = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
    lmb_vec3 at[6], normal[6];
    for (int k = 0; k < 6; ++k) {
        const float sign = k % 2 ? -1.0f : 1.0f;
        at[k] = from;
        normal[k] = vec3(k / 2 == 0 ? sign : 0.0f, k / 2 == 1 ? sign : 0.0f, k / 2 == 2 ? sign : 0.0f);
    }
    return send(w, at, normal, power, 6);
}

static int by_light(const void *a, const void *b)
{
    const sender *x = a, *y = b;
    return x->light != y->light ? (x->light > y->light ? -1 : 1) : x->element < y->element ? -1 : 1;
}

/* The brightest elements that have not sent their light yet; returns how many. */
static int next_senders(reach *w, uint32_t chosen[BATCH])
{
    const bake *b = w->b;
    int count = 0;
    for (uint32_t i = 0; i < b->element_count; ++i) {
        w->order[i].element = i;
        w->order[i].light = b->element[i].light;
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
    for (int n = next_senders(w, chosen); n > 0; n = next_senders(w, chosen)) {
        for (int k = 0; k < n; ++k) {
            const bake_element *e = &w->b->element[chosen[k]];
            at[k] = e->middle;
            normal[k] = e->normal;
            power[k] = ALBEDO * e->light * e->area;
        }
        if (!send(w, at, normal, power, n)) {
            return 0;
        }
    }
    return 1;
}

/* A triangle's side stays where one of its elements was reached. */
static int is_side_reached(const reach *w, uint32_t root)
{
    const uint32_t *node = w->b->section[LMB_TRANSFER_PIECES].data;
    if (node[root] & LMB_TRANSFER_LEAF) {
        return w->has_sent[node[root] & ~LMB_TRANSFER_LEAF];
    }
    const uint32_t first = node[root] & ((1u << LMB_TRANSFER_EDGE_BIT) - 1u);
    return is_side_reached(w, first) || is_side_reached(w, first + 1);
}

/* What no light came to is no part of what a node sends, either: its mean is over what light comes to. */
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
        e->is_hidden = (double)e->light < HIDDEN * light / area;
        e->is_dark = !w->has_sent[i];
        e->area = e->is_dark ? 0.0f : e->area;
    }
}

int bake_reach(bake *b, const lmb_vec3 *eyes, uint32_t count, report *r)
{
    reach w = {b, NULL, NULL, NULL, r};
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
    int ok = (w.has_sent != NULL && w.order != NULL && w.memory != NULL) ||
             report_fail(r, "not enough memory for %u elements", (unsigned)b->set.elements);
    b->by_middles = 1; /* what lies half in a solid must not lead into it */
    ok = ok && spread(&w, eyes, count);
    b->by_middles = 0;
    for (size_t i = 0; ok && i < surfaces->count; ++i) {
        if (i % LMB_TRANSFER_SURFACE_WORDS < 2 && surfaces->data[i] != LMB_TRANSFER_NONE &&
            !is_side_reached(&w, surfaces->data[i])) {
            surfaces->data[i] = LMB_TRANSFER_NONE;
        }
    }
    if (ok) {
        sort_out(&w);
        ok = bake_order(b, r);
    }
    free(w.has_sent);
    free(w.order);
    free(w.memory);
    return ok;
}
