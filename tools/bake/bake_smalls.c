/* bake_smalls.c: the places of small triangles that light reaches, because meshes extend into walls and each other. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/pool.h"
#include "../common/fvec.h"
#include "bake_triangle.h"

enum { QUARTERS = 4, TOGETHER = LMB_TILE_PIXELS / QUARTERS, WITNESSES = 24, BRIGHTEST = 40 };
#define OVER  0.05f /* of the smallest edge: height of the sample points */
#define FAINT 0.01  /* of the mean light: darker elements are not used as witnesses */

/* A side of a small triangle, or part of one, in an element with others. */
typedef struct side {
    uint32_t element, number; /* 2 (id - 1) + back, or LMB_TRANSFER_NONE */
    uint32_t part;            /* or LMB_TRANSFER_NONE */
} side;

typedef struct smalls {
    bake *b;
    side *list;
    uint32_t count;
    uint32_t *job; /* sides processed together: index of the first of each job, and the end */
    uint32_t jobs;
    float faint;
    lmb_tile *tile[POOL_MAX];
    lmb_traversal *traversal[POOL_MAX];
} smalls;

void bake_quarters(lmb_vec3 out[4], const lmb_vec3 corner[3])
{
    out[0] = triangle_middle(corner);
    for (int k = 0; k < 3; ++k) {
        out[1 + k] = mul3(add3(out[0], corner[k]), 0.5f);
    }
}

/* Finds lit elements that might be visible from around an element: the nearest, or those that would send it the most
 * light. Between books, all near ones may lie on the other side of a board. */
static void find_witnesses(bake_nearest *out, const smalls *w, uint32_t element, int by_light)
{
    const bake_element *e = &w->b->element[element];
    out->count = 0;
    out->limit = by_light ? BRIGHTEST : WITNESSES;
    for (uint32_t i = 0; i < w->b->element_count; ++i) {
        const bake_element *o = &w->b->element[i];
        const lmb_vec3 at = bake_place(o), d = sub3(at, e->middle);
        const float d2 = dot3(d, d), from = -dot3(d, o->normal), to = dot3(d, e->normal);
        if (i == element || !(o->light > w->faint) || o->is_stood_on || from < 0.0f || to < 0.0f) {
            continue;
        }
        const float sent = o->light * o->area * from * to;
        const float far = !by_light ? d2 : sent > 0.0f ? d2 * d2 / sent : HUGE_VALF;
        if (bake_is_near(out, far)) {
            bake_nearest_put(out, at, far);
        }
    }
}

static int side_shape(lmb_vec3 corner[3], lmb_vec3 *normal, const bake *b, const side *s)
{
    lmb_triangle t;
    float area;
    if (s->part != LMB_TRANSFER_NONE) {
        memcpy(corner, b->part[s->part].corner, 3 * sizeof *corner);
        *normal = b->part[s->part].normal;
        return 1;
    }
    if (!lmb_triangle_fetch(&t, b->scene, s->number / 2 + 1) || !lmb_triangle_shape(normal, &area, &t)) {
        return 0;
    }
    memcpy(corner, t.corner, 3 * sizeof *corner);
    *normal = mul3(*normal, s->number % 2 ? -1.0f : 1.0f);
    return 1;
}

static void put_places(lmb_tile *tile, const bake *b, const side *s)
{
    lmb_vec3 corner[3], normal, place[QUARTERS];
    if (!side_shape(corner, &normal, b, s)) {
        return;
    }
    bake_quarters(place, corner);
    for (int k = 0; k < QUARTERS; ++k) {
        const lmb_vec3 p = add3(place[k], mul3(normal, OVER * b->set.smallest_m));
        const float at[3] = {p.x, p.y, p.z}, n[3] = {normal.x, normal.y, normal.z};
        for (int c = 0; c < 3; ++c) {
            tile->position[c][tile->hits] = at[c];
            tile->face[c][tile->hits] = n[c];
        }
        tile->depth[tile->hits] = 1.0f;
        tile->id[tile->hits++] = 1;
    }
}

static uint64_t before(const lmb_tile *tile, lmb_vec3 q)
{
    uint64_t out = 0;
    for (int k = 0; k < tile->hits; ++k) {
        const lmb_vec3 p = vec3(tile->position[0][k], tile->position[1][k], tile->position[2][k]);
        const lmb_vec3 n = vec3(tile->face[0][k], tile->face[1][k], tile->face[2][k]);
        out |= (uint64_t)(dot3(sub3(q, p), n) > 0.0f) << k;
    }
    return out;
}

/* Sets the share and middle of the quarters that light reaches. */
static void open_part(bake_part *p, uint32_t own)
{
    const int count = count_bits(own);
    lmb_vec3 place[QUARTERS], sum = vec3(0.0f, 0.0f, 0.0f);
    bake_quarters(place, p->corner);
    for (int k = 0; k < QUARTERS; ++k) {
        sum = (own >> k & 1u) != 0 ? add3(sum, place[k]) : sum;
    }
    p->open = (float)count * (1.0f / QUARTERS);
    p->middle = count > 0 ? mul3(sum, 1.0f / (float)count) : p->middle;
}

/* Adds the places of `all` that see one of the witnesses. */
static uint64_t open_places(const bake *b, lmb_traversal *traversal, const lmb_tile *tile, const bake_nearest *witness,
                            uint64_t open, uint64_t all)
{
    const float noise = lmb_tile_noise(tile, all);
    for (int k = 0; k < witness->count && open != all; ++k) {
        const lmb_vec3 at = witness->at[k];
        const uint64_t ask = all & ~open & before(tile, at);
        if (ask != 0) {
            open |= ask & ~lmb_occluded_tile(b->kernels, traversal, &b->bvh, tile, ask, at,
                                             noise + lmb_place_noise(at, 0.0f));
        }
    }
    return open;
}

/* A place is open if it sees a lit element. */
static void look(void *user, int index, int worker)
{
    const smalls *w = user;
    lmb_tile *tile = w->tile[worker];
    const side *s = w->list + w->job[index];
    const uint32_t count = w->job[index + 1] - w->job[index];
    bake_nearest witness;
    uint64_t open = 0;
    bake_bound(w->traversal[worker]);
    tile->hits = 0;
    for (uint32_t i = 0; i < count; ++i) {
        put_places(tile, w->b, &s[i]);
    }
    const uint64_t all = ~(uint64_t)0 >> (LMB_TILE_PIXELS - QUARTERS * (int)count);
    for (int by_light = 0; by_light < 2 && open != all; ++by_light) {
        find_witnesses(&witness, w, s->element, by_light);
        open = open_places(w->b, w->traversal[worker], tile, &witness, open, all);
    }
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t own = (uint32_t)(open >> QUARTERS * i) & ((1u << QUARTERS) - 1u);
        if (s[i].number != LMB_TRANSFER_NONE) {
            w->b->small_open[s[i].number] = (uint8_t)own;
        }
        if (s[i].part != LMB_TRANSFER_NONE) {
            open_part(&w->b->part[s[i].part], own);
        }
    }
}

static int by_element(const void *a, const void *b)
{
    const side *x = a, *y = b;
    if (x->element != y->element) {
        return x->element < y->element ? -1 : 1;
    }
    return x->number != y->number ? (x->number < y->number ? -1 : 1) : x->part < y->part ? -1 : 1;
}

static void add_side(smalls *w, uint32_t element, uint32_t number, uint32_t part)
{
    const side s = {element, number, part};
    w->list[w->count++] = s;
}

/* Lists all existing sides, grouped by element. */
static void put_sides(smalls *w)
{
    const bake *b = w->b;
    const uint32_t *root = b->section[LMB_TRANSFER_SURFACES].data, *node = b->section[LMB_TRANSFER_PIECES].data;
    for (uint32_t i = 0; i < b->part_count; ++i) {
        add_side(w, b->part[i].element, b->part[i].side, i);
        if (b->part[i].side != LMB_TRANSFER_NONE) {
            w->b->small_open[b->part[i].side] = 1; /* exists */
        }
    }
    for (uint32_t id = 1; id <= lmb_scene_triangles(b->scene); ++id) {
        lmb_triangle t;
        if (!lmb_triangle_fetch(&t, b->scene, id) || !bake_is_small(b, t.corner)) {
            continue;
        }
        for (uint32_t back = 0; back < 2; ++back) {
            uint32_t at = root[LMB_TRANSFER_SURFACE_WORDS * (id - 1) + back];
            while (at != LMB_TRANSFER_NONE && (node[at] & LMB_TRANSFER_LEAF) == 0) {
                at = bake_first(b, node[at]);
            }
            if (at != LMB_TRANSFER_NONE && b->small_open[2 * (id - 1) + back] == 0) {
                add_side(w, node[at] & ~LMB_TRANSFER_LEAF, 2 * (id - 1) + back, LMB_TRANSFER_NONE);
            }
        }
    }
    if (w->count > 0) {
        qsort(w->list, w->count, sizeof *w->list, by_element);
    }
    for (uint32_t i = 0; i < w->count; ++i) {
        const uint32_t first = w->jobs > 0 ? w->job[w->jobs - 1] : 0;
        if (w->jobs == 0 || i - first == TOGETHER || w->list[i].element != w->list[first].element) {
            w->job[w->jobs++] = i;
        }
    }
    w->job[w->jobs] = w->count;
}

static int make(smalls *w, report *r)
{
    const size_t sides = 2 * (size_t)lmb_scene_triangles(w->b->scene), all = sides + w->b->part_count;
    int ok = 1;
    w->list = malloc(all * sizeof *w->list + 1);
    w->job = malloc((all + 1) * sizeof *w->job);
    free(w->b->small_open);
    w->b->small_open = calloc(sides + 1, 1);
    for (int k = 0; k < w->b->set.threads; ++k) {
        w->tile[k] = calloc(1, sizeof *w->tile[k]);
        w->traversal[k] = calloc(1, sizeof *w->traversal[k]);
        ok = ok && w->tile[k] != NULL && w->traversal[k] != NULL;
    }
    return (ok && w->list != NULL && w->job != NULL && w->b->small_open != NULL) ||
           report_fail(r, "not enough memory for %.0f sides of triangles", (double)sides);
}

int bake_smalls(bake *b, report *r)
{
    smalls w;
    double light = 0.0;
    memset(&w, 0, sizeof w);
    w.b = b;
    for (uint32_t i = 0; i < b->element_count; ++i) {
        light += (double)b->element[i].light / (double)b->element_count;
    }
    w.faint = (float)(FAINT * light);
    const int ok = make(&w, r);
    if (ok) {
        put_sides(&w);
        pool_run(b->set.threads, (int)w.jobs, look, &w);
    }
    for (int k = 0; k < b->set.threads; ++k) {
        bake_count_coarse(b, ok ? w.traversal[k]->coarse : 0);
        free(w.tile[k]);
        free(w.traversal[k]);
    }
    free(w.list);
    free(w.job);
    return ok;
}
