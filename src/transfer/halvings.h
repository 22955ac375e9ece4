/* halvings.h: a triangle halved repeatedly: from a point on the triangle to the piece that contains it. Layer 7. */
#ifndef LMB_TRANSFER_HALVINGS_H
#define LMB_TRANSFER_HALVINGS_H

#include <lambent/transfer.h>

#include <string.h>

#include "../base/vec.h"
#include "../raster/triangle.h"

/* Returns 0 if the id names no triangle with an area. */
static inline int transfer_triangle_of(lmb_transfer_triangle *out, const lmb_scene *scene, uint32_t id)
{
    lmb_triangle t;
    float area;
    if (!lmb_triangle_fetch(&t, scene, id) || !lmb_triangle_shape(&out->normal, &area, &t)) {
        return 0;
    }
    const lmb_vec3 e1 = sub3(t.corner[1], t.corner[0]), e2 = sub3(t.corner[2], t.corner[0]);
    const float per = 0.5f / area;
    out->corner = t.corner[0];
    out->along[0] = mul3(cross3(e2, out->normal), per);
    out->along[1] = mul3(cross3(out->normal, e1), per);
    return 1;
}

/* The same through a cache, indexed by the low bits of the id, because walls and floors recur in every row. NULL if
 * there is no triangle. */
static inline const lmb_transfer_triangle *transfer_triangle_kept(lmb_transfer_kept *kept, const lmb_scene *scene,
                                                                  uint32_t id)
{
    const uint32_t at = id % LMB_TRANSFER_KEPT;
    if (kept->id[at] != id) {
        kept->id[at] = transfer_triangle_of(&kept->triangle[at], scene, id) ? id : 0;
    }
    return kept->id[at] == id ? &kept->triangle[at] : NULL;
}

/* Halves edge `from`, which runs from corner `from` to the next corner, `to`. The middle of the edge replaces the
 * edge's end in the first half and the edge's start in the second. A cut divides the edge elsewhere: at `part` of the
 * length. */
typedef struct transfer_halving {
    int from, is_wall;
    uint32_t first; /* of two halves, which are adjacent */
    float part, ratio; /* ratio: (1 - part) / part */
} transfer_halving;

static inline int halving_to(int from) { return from == 2 ? 0 : from + 1; }

static inline transfer_halving halving_of(const lmb_transfer *t, uint32_t node)
{
    transfer_halving h = {(int)(node >> LMB_TRANSFER_EDGE_BIT & 3u), 0, 0, 0.5f, 1.0f};
    h.first = node & ((1u << LMB_TRANSFER_EDGE_BIT) - 1u);
    if (h.from == (int)LMB_TRANSFER_CUT) {
        const uint32_t *cut = t->section[LMB_TRANSFER_CUTS] + LMB_TRANSFER_CUT_WORDS * (size_t)h.first;
        h.from = (int)(cut[0] >> LMB_TRANSFER_EDGE_BIT & 3u);
        h.is_wall = (cut[0] & LMB_TRANSFER_WALL) != 0;
        h.first = cut[0] & ((1u << LMB_TRANSFER_EDGE_BIT) - 1u);
        memcpy(&h.part, &cut[1], sizeof h.part);
        h.ratio = (1.0f - h.part) / h.part;
    }
    return h;
}

/* Weights of a point. A half keeps one corner, which loses `less` times the weight of the corner that moves. The new
 * corner gets `more` times the weight of the one that moves. */
typedef struct transfer_half {
    int keeps, moves; /* corners */
    float less, more;
} transfer_half;

static inline transfer_half half_of(const transfer_halving *h, int second)
{
    const int to = halving_to(h->from), is_cut = h->part != 0.5f;
    transfer_half half = {second ? to : h->from, second ? h->from : to, 1.0f, 2.0f};
    if (is_cut) {
        half.less = second ? 1.0f / h->ratio : h->ratio;
        half.more = 1.0f / (second ? 1.0f - h->part : h->part);
    }
    return half;
}

#endif
