/* fuzz_relief.c: a .lmr in either byte order, opened and drawn. */
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../src/base/vec.h"
#include "fuzz.h"

enum { SIDE = 16 };

/* Every pixel is one of three kinds, and there is no NaN. */
static void draw(const lmb_relief *relief, const lmb_relief_how *how)
{
    enum { TILES = SIDE / LMB_TILE };
    static uint32_t depth[SIDE * SIDE], id[SIDE * SIDE];
    static lmb_tile tile;
    lmb_target target;
    lmb_relief_stats stats = {0, 0, 0, 0};
    lmb_scene scene;
    lmb_view view;
    memset(&target, 0, sizeof target);
    lmb_surface_init(&target.depth, LMB_DEPTH32F, SIDE, SIDE, depth, sizeof depth);
    lmb_surface_init(&target.id, LMB_ID32, SIDE, SIDE, id, sizeof id);
    lmb_surface_clear(&target.depth);
    lmb_surface_clear(&target.id);
    lmb_relief_scene(&scene, relief);
    fuzz_require(lmb_view_look_at(&view, vec3(2, 1.5f, 2.5f), vec3(0, 0, 0), vec3(0, 1, 0), 0.8f, SIDE, SIDE) ==
                 LMB_OK);
    if (relief->mesh.triangle_count > 10000 || lmb_scene_check(&scene) != LMB_OK) {
        return;
    }
    lmb_draw(&target, lmb_kernels_pick(), &view, &scene, 1, relief->mesh.triangle_count, 0, NULL);
    for (int32_t at = 0; at < TILES * TILES; ++at) {
        fuzz_require(lmb_resolve_tile(&tile, lmb_kernels_pick(), &view, &scene, &target, at % TILES * LMB_TILE,
                                      at / TILES * LMB_TILE) == LMB_OK);
        fuzz_require(lmb_relief_tile(&tile, lmb_kernels_pick(), relief, &view, how, &stats) == LMB_OK);
    }
    fuzz_require(stats.hits + stats.missed + stats.holes == stats.pixels);
}

void fuzz_lmr(const uint8_t *data, size_t size)
{
    static lmb_relief relief;
    uint32_t *copy = malloc(size + 4);
    if (copy == NULL) {
        return;
    }
    memcpy(copy, data, size);
    const lmb_status swapped = lmb_relief_swap(copy, size), opened = lmb_relief_open(&relief, copy, size);
    fuzz_require((swapped == LMB_OK) == (opened == LMB_OK || opened == LMB_ERR_CAPACITY));
    if (opened == LMB_OK) {
        static const lmb_relief_how once = {.steps = 1}, own = {.pick = LMB_RELIEF_EYE_RAY, .sampling = 1},
                                    max = {.steps = 32, .pick = LMB_RELIEF_EYE_RAY, .views = 8, .keep = 1};
        draw(&relief, NULL);
        draw(&relief, &once);
        draw(&relief, &own);
        draw(&relief, &max);
    }
    free(copy);
}
