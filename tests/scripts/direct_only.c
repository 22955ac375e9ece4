/* direct_only.c: prints the hash of a small frame: direct_only [full]. Full frames show bounced light if the library has
 * it. */
#include "../examples/room.h"

#include <stdlib.h>

static lmb_render state;

int main(int argc, char **argv)
{
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    const lmb_scene scene = room_scene(mesh, material, place, &light);
    lmb_frame_settings settings;
    lmb_frame frame;

    memset(&settings, 0, sizeof settings);
    settings.kernels = lmb_kernels_pick();
    settings.scene = &scene;
    settings.show = argc > 1 && strcmp(argv[1], "full") == 0 ? LMB_SHOW_FULL : LMB_SHOW_DIRECT;
    if (lmb_scene_check(&scene) != LMB_OK ||
        lmb_view_look_at(&settings.view, room_eye, room_middle, room_up, 0.8f, 96, 64) != LMB_OK) {
        return 1;
    }
    const size_t bytes = lmb_frame_bytes(&settings);
    void *block = malloc(bytes);
    lmb_status status = lmb_frame_init(&frame, &settings, block, bytes);
    if (status == LMB_OK) {
        status = lmb_render_frame(&state, &frame);
    }
    if (status != LMB_OK) {
        printf("%s\n", lmb_status_name(status));
        return 1;
    }
    printf("%016llx\n", (unsigned long long)lmb_surface_hash(&frame.out));
    free(block);
    return 0;
}
