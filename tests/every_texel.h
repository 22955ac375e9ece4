/* every_texel.h: the light of a tree's texels one by one: what cuts are measured against. */
#ifndef TEST_EVERY_TEXEL_H
#define TEST_EVERY_TEXEL_H

#include <string.h>

#include "../src/base/vec.h"
#include "../src/tree/tree.h"

/* A lit texel's quad. */
typedef struct texel_quad {
    lmb_node n;
    lmb_vec3 u, v, middle; /* half sides; where visibility is asked */
    float near2;           /* m2: nearer than this its shape counts */
    const lmb_tree *tree;
    lmb_node_ref at;
} texel_quad;

/* Room for all texels of the tree; returns how many are lit. */
static inline int every_texel(texel_quad *out, const lmb_tree *tree)
{
    const int32_t per_face = tree->size * tree->size;
    int count = 0;
    for (uint32_t face = 0; face < tree->faces; ++face) {
        for (int32_t i = 0; i < per_face; ++i) {
            const int32_t x = i % tree->size, y = i / tree->size;
            texel_quad *q = &out[count];
            memset(&q->at, 0, sizeof q->at);
            q->tree = tree;
            q->at.face = (uint16_t)face;
            q->at.x = (uint16_t)x;
            q->at.y = (uint16_t)y;
            lmb_tree_texel_quad(&q->n, &q->u, &q->v, tree, face, x, y);
            if (flux_sum(q->n.flux) > 0.0f) {
                q->middle = tree_texel(tree, face, x, y)->position;
                q->near2 = LMB_NEAR * LMB_NEAR * (dot3(q->u, q->u) + dot3(q->v, q->v) + 2.0f * absf(dot3(q->u, q->v)));
                if (!tree_is_whole(tree_texel(tree, face, x, y)) && lmb_crease_share(tree, q->at) >= 0.0f) {
                    q->near2 = LMB_NEAR * LMB_NEAR * q->n.radius * q->n.radius;
                }
                ++count;
            }
        }
    }
    return count;
}

/* A texel's exact shape where planes meet in it; under 0: it has none. W/m2 a watt of its quad. */
static inline double crease_factor(const texel_quad *q, lmb_vec3 at, lmb_vec3 face, lmb_vec3 n)
{
    const lmb_texel *t = tree_texel(q->tree, q->at.face, q->at.x, q->at.y);
    lmb_vec3 corner[CREASE_CORNERS];
    double sum = 0.0;
    if (tree_is_whole(t) || lmb_crease_share(q->tree, q->at) < 0.0f) {
        return -1.0;
    }
    for (int part = 0; part < CREASE_PARTS; ++part) {
        const int corners = lmb_crease_part(corner, q->tree, q->at, part);
        sum += (double)lmb_polygon_factor(at, face, n, corner, corners, t->normal);
    }
    return sum / (double)q->n.area;
}

/* W/m2 a watt at pixel k. */
static inline double texel_factor(const texel_quad *q, const lmb_tile *tile, int k)
{
    const lmb_vec3 at = vec3(tile->position[0][k], tile->position[1][k], tile->position[2][k]);
    const lmb_vec3 face = vec3(tile->face[0][k], tile->face[1][k], tile->face[2][k]);
    const lmb_vec3 n = vec3(tile->normal[0][k], tile->normal[1][k], tile->normal[2][k]), d = sub3(q->n.centre, at);
    if (dot3(d, d) < q->near2) {
        const double crease = crease_factor(q, at, face, n);
        return crease >= 0.0 ? crease
                             : (double)lmb_quad_factor(at, face, n, q->n.centre, q->n.normal, q->u, q->v);
    }
    return dot3(face, d) > 0.0f ? (double)lmb_disc_factor(at, n, q->n.centre, q->n.normal, q->n.area) : 0.0;
}

#endif
