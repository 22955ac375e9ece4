/* depth_map.c: a depth map in memory: triangles in, metres out, nothing else of the library.
 *
 * lmb_draw is only the rasterizer: it needs a scene, a view and surfaces in your memory. Depth is reversed (larger is
 * nearer, 0 is the background) and stored in tiles of 8x8. lmb_depth_linearize converts tiles to rows, and
 * lmb_depth_view_z converts depth to metres. */
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
    memset(&target, 0, sizeof target); /* without ids, a depth map needs no memory for them */

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
    const uint64_t hash = lmb_surface_hash(&target.depth); /* hash of the pixels, independent of the layout */
    return ends_with("depth map", hash, UINT64_C(0x92b55b3ac5b18ac5)) || metres < 3.8f || metres > 3.9f;
}
