/* halvings.h: a triangle halved again and again: from a place on it to the piece that holds the place. Layer 9. */
#ifndef LMB_TRANSFER_HALVINGS_H
#define LMB_TRANSFER_HALVINGS_H

#include <lambent/transfer.h>

#include "../base/vec.h"
#include "../raster/triangle.h"

/* A triangle of the scene, with its barycentrics as planes of the world. */
typedef struct transfer_triangle {
    lmb_vec3 corner, along[2]; /* b1 = along[0] . (p - corner), b2 = along[1] . (p - corner) */
    lmb_vec3 normal;           /* of the front, unit */
    uint32_t id;
} transfer_triangle;

/* 0 where the id names no triangle with an area. */
static inline int transfer_triangle_of(transfer_triangle *out, const lmb_scene *scene, uint32_t id)
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
    out->id = id;
    return 1;
}

/* The weights of the corners at a point of the triangle's plane: none under 0, their sum 1. */
static inline void transfer_weights(float w[3], const transfer_triangle *t, lmb_vec3 p)
{
    const lmb_vec3 d = sub3(p, t->corner);
    w[1] = clampf(dot3(t->along[0], d), 0.0f, 1.0f);
    w[2] = clampf(dot3(t->along[1], d), 0.0f, 1.0f - w[1]);
    w[0] = 1.0f - w[1] - w[2];
}

/* One halving: which half holds the weights, and the weights there. Edge e goes from corner e to the next one; its
 * middle becomes a corner of both halves, of the first in place of the edge's end, of the second of its beginning. */
static inline uint32_t halving_enter(float w[3], uint32_t node)
{
    const int from = (int)(node >> LMB_TRANSFER_EDGE_BIT & 3u), to = from == 2 ? 0 : from + 1;
    const uint32_t first = node & ((1u << LMB_TRANSFER_EDGE_BIT) - 1u);
    if (w[from] >= w[to]) {
        w[from] -= w[to];
        w[to] *= 2.0f;
        return first;
    }
    w[to] -= w[from];
    w[from] *= 2.0f;
    return first + 1;
}

/* What the leaf says that holds the weights, which become those of its own corners. LMB_TRANSFER_NONE: it lies deeper
 * than any baked one. */
static inline uint32_t halvings_find(const uint32_t *node, uint32_t root, float w[3])
{
    uint32_t at = root;
    for (int i = 0; i < LMB_TRANSFER_MAX_HALVINGS && (node[at] & LMB_TRANSFER_LEAF) == 0; ++i) {
        at = halving_enter(w, node[at]);
    }
    return (node[at] & LMB_TRANSFER_LEAF) != 0 ? node[at] & ~LMB_TRANSFER_LEAF : LMB_TRANSFER_NONE;
}

#endif
