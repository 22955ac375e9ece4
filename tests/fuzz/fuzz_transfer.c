/* fuzz_transfer.c: opens a .lmt; if it opens, sends light through it in a small room. */
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../small_transfer.h"
#include "fuzz.h"

enum { MAP = 32, SIDE = 16, MOST = 1 << 20 /* receivers */ };

static uint32_t map_memory[MAP * MAP * 2];
static lmb_transfer_scratch scratch;

static lmb_shadow_map map_of(const lmb_scene *scene)
{
    lmb_shadow_map map;
    fuzz_require(lmb_shadow_map_init(&map, &scene->lights[0], scene, MAP, LMB_ID32, map_memory, sizeof map_memory) ==
                 LMB_OK);
    fuzz_require(lmb_shadow_map_clear(&map) == LMB_OK);
    fuzz_require(lmb_shadow_map_draw(&map, lmb_kernels_pick(), scene, 1, ROOM_TRIANGLES, NULL) == LMB_OK);
    return map;
}

/* Draws the tiles of a picture; light is never negative. */
static void draw(const lmb_transfer_light *light, const lmb_transfer *t, const lmb_scene *scene)
{
    enum { TILES = SIDE / LMB_TILE };
    static uint32_t depth[SIDE * SIDE], id[SIDE * SIDE];
    static lmb_tile tile;
    lmb_target target;
    lmb_view view;
    memset(&target, 0, sizeof target);
    memset(&scratch, 0, sizeof scratch);
    lmb_surface_init(&target.depth, LMB_DEPTH32F, SIDE, SIDE, depth, sizeof depth);
    lmb_surface_init(&target.id, LMB_ID32, SIDE, SIDE, id, sizeof id);
    lmb_surface_clear(&target.depth);
    lmb_surface_clear(&target.id);
    fuzz_require(lmb_view_look_at(&view, vec3(0.2f, 0.5f, 2.5f), vec3(0, 0.5f, 0), vec3(0, 1, 0), 0.8f, SIDE, SIDE) ==
                 LMB_OK);
    lmb_draw(&target, lmb_kernels_pick(), &view, scene, 1, ROOM_TRIANGLES, 0, NULL);
    for (int32_t at = 0; at < TILES * TILES; ++at) {
        lmb_irradiance arrives;
        memset(&arrives, 0, sizeof arrives);
        fuzz_require(lmb_resolve_tile(&tile, lmb_kernels_pick(), &view, scene, &target, at % TILES * LMB_TILE,
                                      at / TILES * LMB_TILE) == LMB_OK);
        fuzz_require(lmb_transfer_tile(&arrives, NULL, lmb_kernels_pick(), &scratch, light, t, scene, &tile) == LMB_OK);
        for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            fuzz_require(!(arrives.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] < 0.0f));
        }
    }
}

/* One frame, with the receivers in two pieces. */
static void light_room(const lmb_transfer *t, void *memory, size_t bytes, float strength)
{
    small_room room;
    lmb_transfer_light light;
    const uint32_t all = t->count[LMB_TRANSFER_RECEIVERS] + t->count[LMB_TRANSFER_CLUSTERS];
    memset(&scratch, 0, sizeof scratch);
    small_room_make(&room);
    for (int c = 0; c < 3; ++c) {
        room.light.intensity[c] *= strength;
    }
    const lmb_shadow_map map = map_of(&room.scene);
    lmb_transfer_fits(t, &room.scene);
    fuzz_require(lmb_transfer_light_init(&light, t, memory, bytes - 1) == LMB_ERR_CAPACITY);
    fuzz_require(lmb_transfer_light_init(&light, t, memory, bytes) == LMB_OK);
    fuzz_require(lmb_transfer_materials(&light, t, &room.scene) == LMB_OK);
    fuzz_require(lmb_transfer_clear(&light, t) == LMB_OK);
    fuzz_require(lmb_transfer_collect(&light, lmb_kernels_pick(), &scratch, t, &room.scene, &room.light, &map, 0, 2, 0,
                                      MAP / 2) == LMB_OK);
    for (int what = LMB_TRANSFER_SEND_EMITTED; what <= LMB_TRANSFER_SEND_RECEIVED; ++what) {
        fuzz_require(lmb_transfer_bounce(&light, t, what) == LMB_OK);
    }
    fuzz_require(lmb_transfer_rest(&light, t, LMB_TRANSFER_SEND_RECEIVED, 8) == LMB_OK);
    fuzz_require(lmb_transfer_send(&light, t) == LMB_OK);
    fuzz_require(lmb_transfer_receivers(&light, lmb_kernels_pick(), t, 0, all / 2) == LMB_OK);
    fuzz_require(lmb_transfer_receivers(&light, lmb_kernels_pick(), t, all / 2, all) == LMB_OK);
    fuzz_require(lmb_transfer_receivers(&light, lmb_kernels_pick(), t, 0, all + 1) == LMB_ERR_ARG);
    draw(&light, t, &room.scene);
}

void fuzz_lmt(const uint8_t *data, size_t size)
{
    lmb_transfer t;
    uint32_t *copy = malloc(size + 4);
    if (copy == NULL) {
        return;
    }
    memcpy(copy, data, size);
    const lmb_status opened = lmb_transfer_open(&t, copy, size);
    fuzz_require(opened == LMB_OK || opened == LMB_ERR_FORMAT);
    if (opened == LMB_OK && t.count[LMB_TRANSFER_RECEIVERS] <= MOST) {
        const size_t bytes = lmb_transfer_light_bytes(&t);
        void *memory = malloc(bytes);
        if (memory != NULL) {
            light_room(&t, memory, bytes, 1.0f);
            light_room(&t, memory, bytes, 1e37f);
        }
        free(memory);
    }
    free(copy);
}
