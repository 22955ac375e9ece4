/* bounce_frame.h: a square frame of the world by cuts, exact occlusion and elements, with its memory.
 *
 * Who includes this says first how large: FRAME px and MAP texels a side, FACES of the tree, ELEMENTS, BVH. */
#ifndef TEST_BOUNCE_FRAME_H
#define TEST_BOUNCE_FRAME_H

#include "world.h"

static uint32_t map_memory[FACES * MAP * MAP * 2], depth_memory[FRAME * FRAME], id_memory[FRAME * FRAME];
static uint32_t tree_memory[FACES * (MAP * MAP * 19 + 64)], bvh_memory[BVH * 29 + 2048];
static uint32_t element_memory[ELEMENTS * 45 + 64];
static lmb_band_scratch scratch;
static lmb_render render;
static float picture[FRAME * FRAME * 3];

static inline lmb_frame bounce_frame(const lmb_view *view, int32_t bounces)
{
    lmb_frame f;
    memset(&f, 0, sizeof f);
    f.kernels = picked_kernels();
    f.scene = &world.scene;
    f.view = *view;
    f.shadow_map = MAP;
    f.grouping.method = LMB_GROUP_CUT;
    f.occlusion = LMB_OCCLUSION_EXACT;
    f.bounces = bounces;
    f.truncated = 1;
    f.map_memory = map_memory;
    f.map_bytes = sizeof map_memory;
    f.scratch = &scratch;
    f.eye = target_of(LMB_DEPTH32F, FRAME, depth_memory, id_memory);
    CHECK(lmb_tree_init(&f.tree, FACES, MAP, tree_memory, sizeof tree_memory) == LMB_OK);
    CHECK(lmb_bvh_init(&f.bvh, BVH, bvh_memory, sizeof bvh_memory) == LMB_OK);
    CHECK(lmb_elements_init(&f.elements, ELEMENTS, element_memory, sizeof element_memory) == LMB_OK);
    CHECK(lmb_surface_init(&f.out, LMB_RGB32F, FRAME, FRAME, picture, sizeof picture) == LMB_OK);
    return f;
}

#endif
