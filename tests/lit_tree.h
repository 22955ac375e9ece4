/* lit_tree.h: the world's light as a tree of first points, for the tests of the tree and of its cuts. */
#ifndef TEST_LIT_TREE_H
#define TEST_LIT_TREE_H

#include "../src/tree/tree.h"
#include "world.h"

enum { LIT_SIDE = 256, LIT_FACES = 12, LIT_SMALL = LIT_SIDE / 2 /* texels a side, of one face or of all */ };

static uint32_t lit_map_memory[6 * LIT_SMALL * LIT_SMALL * 2], lit_memory[LIT_FACES * LIT_SMALL * LIT_SMALL * 17];
static lmb_shadow_map lit_map; /* of the light that came last */
static lmb_tree lit;
static lmb_tile light_tile;

/* Noise in all of its memory. */
static inline void lit_begin(uint32_t faces, int32_t size, int noise)
{
    memset(lit_memory, noise, sizeof lit_memory);
    CHECK(lmb_tree_init(&lit, faces, size, lit_memory, sizeof lit_memory) == LMB_OK);
}

static inline void lit_draw(const lmb_light *light)
{
    CHECK(lmb_shadow_map_init(&lit_map, light, &world.scene, lit.size, LMB_ID32, lit_map_memory,
                              sizeof lit_map_memory) == LMB_OK);
    lmb_shadow_map_clear(&lit_map);
    CHECK(lmb_shadow_map_draw(&lit_map, picked_kernels(), &world.scene, 1, WORLD_TRIANGLES, NULL) == LMB_OK);
}

static inline lmb_status lit_rows(const lmb_light *light, int32_t face, int32_t first, int32_t past)
{
    return lmb_tree_texels(&lit, picked_kernels(), &light_tile, &world.scene, light, &lit_map, face, lit.faces, first,
                           past);
}

static inline void lit_sum(uint32_t face) { CHECK(lmb_tree_sum(&lit, face) == LMB_OK); }

/* The faces of a shadow map behind those that are there. */
static inline void lit_add(const lmb_light *light)
{
    lit_draw(light);
    for (int32_t f = 0; f < lit_map.faces; ++f) {
        if ((lit_map.drawn >> f) & 1u) {
            CHECK(lit_rows(light, f, 0, lit.size / LMB_TILE) == LMB_OK);
            lit_sum(lit.faces);
            ++lit.faces;
        }
    }
}

/* One light tree: six faces are half as wide. */
static inline void lit_by(const lmb_light *light)
{
    const int32_t faces = lmb_shadow_map_faces(light, &world.scene);
    lit_begin((uint32_t)faces, faces == 1 ? LIT_SIDE : LIT_SMALL, 0);
    lit_add(light);
}

static inline lmb_node lit_node(uint32_t face, int32_t x, int32_t y, int level)
{
    lmb_node n;
    const lmb_node_ref at = {(uint16_t)face, (uint16_t)x, (uint16_t)y, (uint16_t)level};
    if (level > 0) {
        return *tree_node(&lit, at);
    }
    lmb_tree_texel_node(&n, &lit, face, x, y);
    return n;
}

#endif
