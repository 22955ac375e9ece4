/* bake_directed.c: receivers of surfaces with a normal map or a lobe -> clusters, which keep light by direction.
 *
 * These receivers are first divided like all others. Then each receiver that is a corner of such a leaf becomes a
 * cluster, and the two receivers that it is coded against become the parents. A receiver that nothing else needs is
 * removed. */
#include "../common/fvec.h"
#include "bake.h"

#include <stdlib.h>
#include <string.h>

#include "bake_triangle.h"

enum { BATCH = 64, FLAT = 1, DIRECTED = 2, FIRST_HALF = 128, SECOND_HALF = 127 /* of 255 */ };

/* The uses of a receiver, and the cluster and blend that replace it. */
typedef struct need {
    uint8_t as; /* FLAT, DIRECTED or both */
    uint32_t receiver, cluster, blend;
} need;

typedef struct directing {
    bake *b;
    need *need;
    float *area;    /* of a leaf with directed corners, m2; otherwise -1 */
    uint32_t first; /* first cluster that was a receiver */
    report *r;
} directing;

/* --- leaves ------------------------------------------------------------------------------------------------------- */

int bake_takes_direction(const lmb_material *m)
{
    return m->normal_scale != 0.0f || largest3(vec3(m->specular[0], m->specular[1], m->specular[2])) > 0.0f;
}

static void mark_leaves(const directing *d, uint32_t node, float area)
{
    const uint32_t word = d->b->section[LMB_TRANSFER_DIVISIONS].data[node];
    if (word & LMB_TRANSFER_LEAF) {
        d->area[word & ~LMB_TRANSFER_LEAF] = area;
        return;
    }
    const uint32_t half = bake_first(d->b, word);
    const float part = bake_part_of(d->b, word);
    mark_leaves(d, half, part * area);
    mark_leaves(d, half + 1, (1.0f - part) * area);
}

/* Marks large triangles; returns whether there is one. */
static int mark_triangles(const directing *d)
{
    const bake *b = d->b;
    int any = 0;
    for (uint32_t i = 0; i < b->leaves; ++i) {
        d->area[i] = -1.0f;
    }
    for (uint32_t id = 1; id <= lmb_scene_triangles(b->scene); ++id) {
        const uint32_t *surface =
            b->section[LMB_TRANSFER_SURFACES].data + LMB_TRANSFER_SURFACE_WORDS * (size_t)(id - 1);
        lmb_triangle t;
        if (!lmb_triangle_fetch(&t, b->scene, id) || !bake_takes_direction(t.material) || bake_is_small(b, t.corner)) {
            continue;
        }
        for (int back = 0; back < 2; ++back) {
            if (surface[2 + back] != LMB_TRANSFER_NONE) {
                mark_leaves(d, surface[2 + back], triangle_area(t.corner));
                any = 1;
            }
        }
    }
    return any;
}

/* --- receivers ---------------------------------------------------------------------------------------------------- */

/* Marks the receivers that the leaves need, and their parents, which come before them. */
static void find_needs(const directing *d)
{
    const uint32_t *corner = d->b->section[LMB_TRANSFER_CORNERS].data;
    for (uint32_t i = 0; i < LMB_TRANSFER_CORNER_WORDS * d->b->leaves; ++i) {
        const float area = d->area[i / LMB_TRANSFER_CORNER_WORDS];
        d->need[corner[i]].as |= area < 0.0f ? FLAT : DIRECTED;
        d->b->receiver[corner[i]].target.support -= maxf(area, 0.0f) * (1.0f / 3.0f);
    }
    for (uint32_t i = d->b->receiver_count; i-- > 0;) {
        const bake_target *t = &d->b->receiver[i].target;
        for (int k = 0; k < BAKE_PARENTS; ++k) {
            d->need[t->parent[k]].as |= t->share[k] > 0.0f ? d->need[i].as : 0;
        }
    }
}

static int grow_clusters(directing *d, uint32_t more)
{
    bake *b = d->b;
    const uint32_t count = b->cluster_count + more;
    if (count > LMB_TRANSFER_MAX_CLUSTERS) {
        return report_fail(d->r,
                           "%u clusters and receivers with directions, of 65,536: fewer --receivers, or a larger "
                           "--cluster",
                           (unsigned)count);
    }
    bake_cluster *data = realloc(b->cluster, ((size_t)count + 1) * sizeof *data);
    if (data == NULL) {
        return report_fail(d->r, "not enough memory for %u clusters", (unsigned)count);
    }
    b->cluster = data;
    b->cluster_cap = count + 1;
    return 1;
}

/* Adds the cluster of a receiver, and a blend of only this cluster. */
static int add_cluster(directing *d, uint32_t i)
{
    bake *b = d->b;
    bake_words *blends = &b->section[LMB_TRANSFER_BLENDS];
    bake_receiver *from = &b->receiver[i];
    bake_cluster *to = &b->cluster[b->cluster_count];
    memset(to, 0, sizeof *to);
    to->target.row = from->directions;
    from->directions = NULL;
    to->at = from->at;
    to->target.normal = from->target.normal;
    for (int k = 0; k < 2 && from->target.share[k] > 0.0f; ++k) {
        to->target.parent[k] = d->need[from->target.parent[k]].cluster;
        to->target.share[k] = (float)(k == 0 ? FIRST_HALF : SECOND_HALF) * (1.0f / 255.0f);
    }
    d->need[i].cluster = b->cluster_count++;
    d->need[i].blend = (uint32_t)(blends->count / LMB_TRANSFER_BLEND_WORDS);
    return bake_put(blends, d->need[i].cluster, d->r) && bake_put(blends, 0, d->r) && bake_put(blends, 255, d->r);
}

static int add_clusters(directing *d)
{
    uint32_t more = 0;
    for (uint32_t i = 0; i < d->b->receiver_count; ++i) {
        more += (d->need[i].as & DIRECTED) != 0;
    }
    int ok = grow_clusters(d, more);
    for (uint32_t i = 0; i < d->b->receiver_count && ok; ++i) {
        ok = (d->need[i].as & DIRECTED) == 0 || add_cluster(d, i);
    }
    return ok;
}

/* Removes receivers that no flat leaf needs. */
static void drop_receivers(directing *d)
{
    bake *b = d->b;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < b->receiver_count; ++i) {
        bake_target *t = &b->receiver[i].target;
        if ((d->need[i].as & FLAT) == 0) {
            free(t->row);
            free(b->receiver[i].directions);
            continue;
        }
        for (int k = 0; k < BAKE_PARENTS; ++k) {
            t->parent[k] = t->share[k] > 0.0f ? d->need[t->parent[k]].receiver : 0;
        }
        t->support = maxf(t->support, 0.0f);
        d->need[i].receiver = kept;
        b->receiver[kept++] = b->receiver[i];
    }
    b->receiver_count = kept;
}

/* --- corners ------------------------------------------------------------------------------------------------------ */

static int put_corner(directing *d, bake_words *to, uint32_t receiver, float area)
{
    const need *n = &d->need[receiver];
    if (area >= 0.0f) {
        d->b->cluster[n->cluster].target.support += area * (1.0f / 3.0f);
    }
    return bake_put(to, area < 0.0f ? n->receiver : n->blend, d->r);
}

/* Orders leaves: those of receivers, of meshes, with directions; `place` becomes the new index of each. */
static int put_corners(directing *d, bake_words *to, uint32_t *place)
{
    bake *b = d->b;
    const bake_words *from = &b->section[LMB_TRANSFER_CORNERS];
    const uint32_t all = (uint32_t)(from->count / LMB_TRANSFER_CORNER_WORDS);
    for (int kind = 0; kind < 3; ++kind) {
        for (uint32_t i = kind == 1 ? b->leaves : 0; i < (kind == 1 ? all : b->leaves); ++i) {
            const uint32_t *corner = from->data + LMB_TRANSFER_CORNER_WORDS * (size_t)i;
            const float area = kind == 1 ? -1.0f : d->area[i];
            if (kind != 1 && (area < 0.0f) != (kind == 0)) {
                continue;
            }
            place[i] = (uint32_t)(to->count / LMB_TRANSFER_CORNER_WORDS);
            for (int k = 0; k < 3; ++k) {
                if (!(kind == 1 ? bake_put(to, corner[k], d->r) : put_corner(d, to, corner[k], area))) {
                    return 0;
                }
            }
        }
    }
    return 1;
}

static int move_corners(directing *d)
{
    bake *b = d->b;
    bake_words *corners = &b->section[LMB_TRANSFER_CORNERS], *divisions = &b->section[LMB_TRANSFER_DIVISIONS];
    bake_words moved = {NULL, 0, 0};
    uint32_t *place = malloc((corners->count / LMB_TRANSFER_CORNER_WORDS + 1) * sizeof *place), left = 0;
    const int ok =
        (place != NULL || report_fail(d->r, "not enough memory for corners")) && put_corners(d, &moved, place);
    for (size_t i = 0; i < divisions->count && ok; ++i) {
        if (divisions->data[i] & LMB_TRANSFER_LEAF) {
            divisions->data[i] = LMB_TRANSFER_LEAF | place[divisions->data[i] & ~LMB_TRANSFER_LEAF];
        }
    }
    for (uint32_t i = 0; i < b->leaves; ++i) {
        left += d->area[i] < 0.0f;
    }
    b->leaves = left;
    free(place);
    free(corners->data);
    *corners = moved;
    return ok;
}

/* --- rows --------------------------------------------------------------------------------------------------------- */

static int by_key(const void *a, const void *b)
{
    const bake_cluster *x = *(bake_cluster *const *)a, *y = *(bake_cluster *const *)b;
    return x->key != y->key ? (x->key < y->key ? -1 : 1) : x < y ? -1 : 1;
}

/* Computes the rows that the division left out. Puts neighbours next to each other, because they see the same
 * geometry. */
static int make_rows(directing *d)
{
    bake *b = d->b;
    uint32_t count = 0;
    bake_cluster **order = malloc(((size_t)b->cluster_count - d->first + 1) * sizeof *order);
    if (order == NULL) {
        return report_fail(d->r, "not enough memory for %u receivers", (unsigned)(b->cluster_count - d->first));
    }
    for (uint32_t i = d->first; i < b->cluster_count; ++i) {
        if (b->cluster[i].target.row == NULL) {
            order[count] = &b->cluster[i];
            order[count]->key = bake_key(b->scene, order[count]->at, order[count]->target.normal);
            ++count;
        }
    }
    qsort(order, count, sizeof *order, by_key);
    const int ok = bake_cluster_rows(b, order, count, d->r);
    free(order);
    return ok;
}

int bake_directed(bake *b, report *r)
{
    directing d = {b, NULL, NULL, b->cluster_count, r};
    d.need = calloc((size_t)b->receiver_count + 1, sizeof *d.need);
    d.area = malloc(((size_t)b->leaves + 1) * sizeof *d.area);
    int ok = (d.need != NULL && d.area != NULL) || report_fail(r, "not enough memory for directions");
    if (ok && mark_triangles(&d)) {
        find_needs(&d);
        ok = add_clusters(&d);
        if (ok) {
            drop_receivers(&d);
            ok = move_corners(&d) && make_rows(&d);
        }
    }
    free(d.need);
    free(d.area);
    return ok;
}
