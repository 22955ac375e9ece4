/* tree.h: the layout of a tree's nodes. Layer 6. */
#ifndef LMB_TREE_TREE_H
#define LMB_TREE_TREE_H

#include <lambent/elements.h>

/* Nodes of a face of size x size texels: a quarter, a sixteenth, ... of the texels, down to one. */
static inline size_t tree_nodes(int32_t size) { return ((size_t)size * (size_t)size - 1) / 3; }

/* The shadow maps' faces, behind the texels: facets are read from them again. */
static inline lmb_target *tree_shown(const lmb_tree *t)
{
    return (lmb_target *)(void *)(t->texel + t->face_cap * (size_t)t->size * (size_t)t->size);
}

static inline const lmb_texel *tree_texel(const lmb_tree *t, uint32_t face, int32_t x, int32_t y)
{
    const size_t size = (size_t)t->size;
    return &t->texel[(face * size + (size_t)y) * size + (size_t)x];
}

/* Level 1, 2, ... of the face: nodes of 2, 4, ... texels a side. Lower levels have size^2 / 4, / 16, ... nodes. */
static inline lmb_node *tree_level(const lmb_tree *t, uint32_t face, int level)
{
    const size_t all = (size_t)t->size * (size_t)t->size, side = (size_t)t->size >> (level - 1);
    return t->node + face * tree_nodes(t->size) + (all - side * side) / 3;
}

static inline const lmb_node *tree_node(const lmb_tree *t, lmb_node_ref at)
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

/* Every other bit, from bit 0 on. */
static inline uint32_t tree_even_bits(uint32_t v)
{
    v &= 0x55555555u;
    v = (v | v >> 1) & 0x33333333u;
    v = (v | v >> 2) & 0x0f0f0f0fu;
    v = (v | v >> 4) & 0x00ff00ffu;
    return (v | v >> 8) & 0xffffu;
}

static inline uint32_t tree_spread_bits(uint32_t v)
{
    v = (v | v << 8) & 0x00ff00ffu;
    v = (v | v << 4) & 0x0f0f0f0fu;
    v = (v | v << 2) & 0x33333333u;
    return (v | v << 1) & 0x55555555u;
}

/* Row-major index of the texel with number i along the Z curve: 4^l neighbours there are a node of level l. */
static inline size_t tree_along_z(const lmb_tree *t, uint32_t i)
{
    return (size_t)tree_even_bits(i >> 1) * (size_t)t->size + tree_even_bits(i);
}

/* The element at texel (x, y); NULL if the tree is of a map. */
static inline const lmb_element *tree_element(const lmb_tree *t, int32_t x, int32_t y)
{
    return t->element == NULL ? NULL : &t->element[tree_spread_bits((uint32_t)x) | tree_spread_bits((uint32_t)y) << 1];
}

/* Neighbours in lmb_texel.side, and the value if there is no edge. */
enum { SIDE_LEFT, SIDE_RIGHT, SIDE_UP, SIDE_DOWN, SIDE_WHOLE = 128 };

static inline int tree_is_whole(const lmb_texel *t)
{
    return t->side[0] == SIDE_WHOLE && t->side[1] == SIDE_WHOLE && t->side[2] == SIDE_WHOLE && t->side[3] == SIDE_WHOLE;
}

/* Finds the edges between a face's texels and sets their sides. */
void lmb_crease_find(const lmb_tree *tree, uint32_t face);

/* The exact shape of a texel that is not whole. lmb_crease_share: the area in the map, in texels; < 0 if the plane runs
 * away from the light too steeply and there is no shape. lmb_crease_part: part 0 .. CREASE_PARTS - 1 as corners,
 * counter-clockwise seen from the light; returns their number, or 0 for none. Part 0 lies in the texel's own cell, the
 * others in neighbouring cells. */
enum { CREASE_PARTS = 5, CREASE_CORNERS = 8 };
float lmb_crease_share(const lmb_tree *tree, lmb_node_ref at);
int lmb_crease_part(lmb_vec3 corner[CREASE_CORNERS], const lmb_tree *tree, lmb_node_ref at, int part);

/* A texel as a node, and the half sides of its quad around the node's centre. If planes meet in the texel, the flux is
 * that of the exact shape, which is not a quad: returns 1. */
int lmb_tree_texel_quad(lmb_node *out, lmb_vec3 *u, lmb_vec3 *v, const lmb_tree *tree, uint32_t face, int32_t x,
                        int32_t y);
void lmb_tree_texel_node(lmb_node *out, const lmb_tree *tree, uint32_t face, int32_t x, int32_t y);

/* Flux below 2^-80 W counts as 0, as in a shadow map: quotients by flux stay finite, and kernels meet no denormals. */
static inline float flux_or_none(float w) { return w < 8.2718061e-25f ? 0.0f : w; }

static inline float flux_sum(const float flux[3]) { return flux[0] + flux[1] + flux[2]; }

struct lmb_elements;

/* Presents elements first .. first + count - 1, as far as they exist, as pixels of a tile. */
void lmb_elements_as_tile(lmb_tile *tile, const struct lmb_elements *elements, uint32_t first, uint32_t count);

#endif
