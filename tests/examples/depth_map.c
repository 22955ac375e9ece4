/* depth_map.c: a depth map in memory: triangles in, metres out, nothing else of the library.
 *
 * lmb_draw is the rasterizer alone: it needs a scene, a view and surfaces in memory of yours. Depth is kept
 * reversed (larger is nearer, 0 is nothing) and in tiles of 8x8; lmb_depth_linearize makes rows of it,
 * lmb_depth_view_z metres. */
#include "room.h"

enum { WIDTH = 96, HEIGHT = 64 };

static uint32_t memory[WIDTH * HEIGHT]; /* lmb_depth_bytes(WIDTH, HEIGHT): whole tiles */
static float rows[HEIGHT][WIDTH];

int main(void)
{
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    const lmb_scene scene = room_scene(mesh, material, place, &light);
    lmb_view view;
    lmb_target target;
    memset(&target, 0, sizeof target); /* no ids: a depth map costs none */

    if (lmb_build_check() != LMB_OK || lmb_scene_check(&scene) != LMB_OK ||
        lmb_view_look_at(&view, room_eye, room_middle, room_up, 0.8f, WIDTH, HEIGHT) != LMB_OK ||
        lmb_surface_init(&target.depth, LMB_DEPTH32F, WIDTH, HEIGHT, memory, sizeof memory) != LMB_OK ||
        lmb_surface_clear(&target.depth) != LMB_OK ||
        lmb_draw(&target, lmb_kernels_pick(), &view, &scene, 1, lmb_scene_triangles(&scene), 0, NULL) != LMB_OK ||
        lmb_depth_linearize(rows, sizeof rows, &target.depth) != LMB_OK) {
        return 1;
    }
    const float metres = lmb_depth_view_z(&view, rows[HEIGHT / 2][WIDTH / 2]);
    printf("the middle of the picture is %.3f m away\n", (double)metres);
    const uint64_t hash = lmb_surface_hash(&target.depth); /* of the pixels, whatever the layout */
    return ends_with("depth map", hash, UINT64_C(0x92b55b3ac5b18ac5)) || metres < 3.8f || metres > 3.9f;
}
