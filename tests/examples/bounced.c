/* bounced.c: bounced light by the best path that the library has, in one block of memory.
 *
 * Fill in the settings; zeros are defaults. lmb_frame_bytes returns the size of the memory, and lmb_frame_init divides
 * it. You may set fields without memory (exposure, error, ...) in the frame afterwards. The block and the frame's state
 * are yours: here on the heap, or static on a machine without one. */
#include "room.h"

#include <stdlib.h>

static lmb_render state; /* 0.8 KiB a light of the configuration */

int main(void)
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
    if (lmb_scene_check(&scene) != LMB_OK ||
        lmb_view_look_at(&settings.view, room_eye, room_middle, room_up, 0.8f, 96, 64) != LMB_OK) {
        return 1;
    }
    const size_t bytes = lmb_frame_bytes(&settings);
    void *block = malloc(bytes);
    if (lmb_frame_init(&frame, &settings, block, bytes) != LMB_OK) {
        return 1;
    }
    frame.exposure_ev = 0.5f;
    const lmb_status status = lmb_render_frame(&state, &frame);
    const uint64_t expected = BY_CONFIG(UINT64_C(0x9253f982e0c2c5fe), UINT64_C(0x4374e95b3d46c3b9));
    const uint64_t hash = lmb_surface_hash(&frame.out); /* RGBA8 in the block, unless you set settings.out */
    printf("%s, %lu KiB, maps of %d x %d, a tree of %d x %d\n", lmb_status_name(status), (unsigned long)(bytes / 1024),
           (int)frame.shadow_map, (int)frame.shadow_map, (int)frame.tree.size, (int)frame.tree.size);
    free(block);
    return status != LMB_OK || ends_with("bounced light", hash, expected);
}
