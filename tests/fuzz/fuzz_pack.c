/* fuzz_pack.c: opens a .lmp; if it opens, poses and draws the scene, reads it as a model, and packs the parts again. */
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../tools/model/model.h"
#include "../../tools/pack/pack.h"
#include "fuzz.h"

enum { SIDE = 16, MOST = 10000 /* triangles */, MEMORY = 1 << 20 };

static void draw(const lmb_scene *scene, const lmb_view *view)
{
    enum { TILES = SIDE / LMB_TILE };
    static uint32_t depth[SIDE * SIDE], id[SIDE * SIDE];
    static lmb_tile tile;
    lmb_target target;
    memset(&target, 0, sizeof target);
    lmb_surface_init(&target.depth, LMB_DEPTH32F, SIDE, SIDE, depth, sizeof depth);
    lmb_surface_init(&target.id, LMB_ID32, SIDE, SIDE, id, sizeof id);
    lmb_surface_clear(&target.depth);
    lmb_surface_clear(&target.id);
    const uint32_t all = lmb_scene_triangles(scene);
    if (all == 0 || all > MOST ||
        lmb_draw(&target, lmb_kernels_pick(), view, scene, 1, all, 0, NULL) != LMB_OK) {
        return;
    }
    for (int32_t at = 0; at < TILES * TILES; ++at) {
        fuzz_require(lmb_resolve_tile(&tile, lmb_kernels_pick(), view, scene, &target, at % TILES * LMB_TILE,
                                      at / TILES * LMB_TILE) == LMB_OK);
    }
}

/* Poses the scene at some times, for each camera. */
static void play(const lmb_pack *file)
{
    static const float times[] = {-1.0f, 0.0f, 0.4f, 1.5f, 1e30f};
    const size_t bytes = lmb_pack_bytes(file);
    void *memory = bytes <= MEMORY ? malloc(bytes + 1) : NULL;
    lmb_scene scene;
    lmb_view view;
    if (memory != NULL && bytes > 0) {
        fuzz_require(lmb_pack_scene(&scene, file, memory, bytes - 1) == LMB_ERR_CAPACITY);
        fuzz_require(lmb_pack_scene(&scene, file, memory, bytes) == LMB_OK);
        for (size_t i = 0; i < sizeof times / sizeof *times; ++i) {
            const lmb_status posed = lmb_pack_pose(&scene, file, times[i]);
            fuzz_require(posed == LMB_OK || posed == LMB_ERR_SCENE);
            fuzz_require(lmb_scene_check(&scene) == LMB_OK);
            for (uint32_t c = 0; c < 4 && c < file->count[LMB_PACK_CAMERAS]; ++c) {
                if (lmb_pack_view(&view, file, &scene, c, times[i], SIDE, SIDE) == LMB_OK) {
                    draw(&scene, &view);
                }
            }
        }
    }
    free(memory);
}

/* The parts that `lambent pack` reads give a valid file again, and so does that file. */
static void take(const lmb_pack *pack_in)
{
    pack parts;
    file_bytes file = {NULL, 0};
    lmb_pack again;
    report r = {""};
    memset(&parts, 0, sizeof parts);
    if (pack_take(&parts, pack_in, "a.lmp", &r) && pack_file(&file, &parts, &r)) {
        fuzz_require(lmb_pack_open(&again, file.data, file.size) == LMB_OK);
        fuzz_require(again.bytes[LMB_PACK_VERTICES] == pack_in->bytes[LMB_PACK_VERTICES] / 4 * 4 ||
                     pack_in->bytes[LMB_PACK_VERTICES] % 4 != 0);
    } else {
        fuzz_failed(&r, r.text[0] == 'a' ? "a.lmp: " : "not enough memory");
    }
    file_free(&file);
    pack_free(&parts);
}

void fuzz_lmp(const uint8_t *data, size_t size)
{
    lmb_pack opened;
    model m;
    model_notes notes;
    report r = {""};
    uint32_t *copy = malloc(size + 4);
    if (copy == NULL) {
        return;
    }
    memcpy(copy, data, size);
    const lmb_status status = lmb_pack_open(&opened, copy, size);
    fuzz_require(status == LMB_OK || status == LMB_ERR_FORMAT);
    if (status == LMB_OK) {
        play(&opened);
        take(&opened);
    }
    if (size >= 4 && memcmp(data, "LMP", 3) == 0) {
        const int is_read = model_read(&m, "a.lmp", NULL, data, size, &notes, &r);
        fuzz_require(!is_read || status == LMB_OK);
        if (!is_read) {
            fuzz_failed(&r, "a.lmp: ");
        }
        model_free(&m);
    }
    free(copy);
}
