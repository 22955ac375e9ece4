/* tree.h: where a tree's nodes lie. Floor 6. */
#ifndef LMB_BOUNCE_TREE_H
#define LMB_BOUNCE_TREE_H

#include <lambent/tree.h>

/* Nodes of a face of size x size texels: a quarter, a sixteenth, ... of the texels, down to one. */
static inline size_t tree_nodes(int32_t size) { return ((size_t)size * (size_t)size - 1) / 3; }

static inline const lmb_texel *tree_texel(const lmb_tree *t, uint32_t face, int32_t x, int32_t y)
{
    const size_t size = (size_t)t->size;
    return &t->texel[(face * size + (size_t)y) * size + (size_t)x];
}

/* The face's level 1, 2, ...: nodes of 2, 4, ... texels a side. Levels before it have size^2 / 4, / 16, ... nodes. */
static inline lmb_node *tree_level(const lmb_tree *t, uint32_t face, int level)
{
    const size_t all = (size_t)t->size * (size_t)t->size, side = (size_t)t->size >> (level - 1);
    return t->node + face * tree_nodes(t->size) + (all - side * side) / 3;
}

static inline const lmb_node *tree_node(const lmb_tree *t, lmb_tree_place at)
{
    return tree_level(t, at.face, at.level) + (size_t)at.y * ((size_t)t->size >> at.level) + at.x;
}

static inline int tree_root_level(const lmb_tree *t)
{
    int level = 0;
    while ((t->size >> level) > 1) {
        ++level;
    }
    return level;
}

/* A texel as a node of its own; and the half sides of its quad, whose middle is the node's centre. */
void lmb_tree_texel_quad(lmb_node *out, lmb_vec3 *u, lmb_vec3 *v, const lmb_tree *tree, uint32_t face, int32_t x,
                         int32_t y);
void lmb_tree_texel_node(lmb_node *out, const lmb_tree *tree, uint32_t face, int32_t x, int32_t y);

static inline float flux_sum(const float flux[3]) { return flux[0] + flux[1] + flux[2]; }

#endif
