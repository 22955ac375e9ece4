/* own_shading.c: your own shading of the pixels that lambent resolves: a drawing in three tones.
 *
 * A draw leaves depth and a triangle's id in each pixel. lmb_resolve_tile gives you the attributes of the pixels of an
 * 8x8 tile: 64 positions, normals, albedos, in planes. You decide how to use them: here they become a colour. */
#include "room.h"

enum { WIDTH = 96, HEIGHT = 64 }; /* whole tiles: no pixel is past the edge */

static uint32_t depth_memory[WIDTH * HEIGHT], id_memory[WIDTH * HEIGHT], picture[WIDTH * HEIGHT];
static lmb_tile tile; /* 7 KiB: keep it off small stacks */

/* sRGB bytes of pixel k: its albedo in a light, a middle or a dark tone; paper colour for the background. */
static void shade(uint8_t out[4], const lmb_tile *t, int k)
{
    const float facing = 0.6f * t->normal[1][k] - 0.5f * t->normal[0][k] + 0.4f * t->normal[2][k];
    const int tone = facing > 0.5f ? 255 : facing > 0.1f ? 180 : 110;
    for (int c = 0; c < 3; ++c) {
        out[c] = (uint8_t)(t->id[k] == 0 ? 245 : (int)(t->albedo[c][k] * (float)tone));
    }
    out[3] = 255;
}

int main(void)
{
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    const lmb_scene scene = room_scene(mesh, material, place, &light);
    const lmb_kernels *kernels = lmb_kernels_pick();
    lmb_view view;
    lmb_target target;
    lmb_surface out;
    memset(&target, 0, sizeof target);
    if (lmb_view_look_at(&view, room_eye, room_middle, room_up, 0.8f, WIDTH, HEIGHT) != LMB_OK ||
        lmb_surface_init(&target.depth, LMB_DEPTH32F, WIDTH, HEIGHT, depth_memory, sizeof depth_memory) != LMB_OK ||
        lmb_surface_init(&target.id, LMB_ID32, WIDTH, HEIGHT, id_memory, sizeof id_memory) != LMB_OK ||
        lmb_surface_init(&out, LMB_RGBA8, WIDTH, HEIGHT, picture, sizeof picture) != LMB_OK ||
        lmb_draw(&target, kernels, &view, &scene, 1, lmb_scene_triangles(&scene), 0, NULL) != LMB_OK) {
        return 1;
    }
    for (int y = 0; y < HEIGHT; y += LMB_TILE) {
        for (int x = 0; x < WIDTH; x += LMB_TILE) {
            if (lmb_resolve_tile(&tile, kernels, &view, &scene, &target, x, y) != LMB_OK) {
                return 1;
            }
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                const int px = x + k % LMB_TILE, py = y + k / LMB_TILE;
                shade((uint8_t *)&picture[py * WIDTH + px], &tile, k);
            }
        }
    }
    return ends_with("own shading", lmb_surface_hash(&out), UINT64_C(0x5d3f39460fd357c3));
}
