/* moving.c: an animation: first the camera moves, then the light. Unchanged results are kept from frame to frame.
 *
 * You tell lmb_render_reuse about changes by `revision` numbers: raise a light's number when it moves, an instance's
 * when it does. The call keeps the other results (the shadow map and first points while only the camera moves) and
 * gives the bytes of a frame drawn from nothing. This example checks that. */
#include "room.h"

#include <stdlib.h>

static lmb_render kept, fresh;

/* Makes a frame with its own memory. */
static lmb_status make_frame(lmb_frame *out, lmb_frame_settings *settings)
{
    const size_t bytes = lmb_frame_bytes(settings);
    return lmb_frame_init(out, settings, malloc(bytes), bytes);
}

int main(void)
{
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    const lmb_scene scene = room_scene(mesh, material, place, &light);
    lmb_frame_settings settings;
    lmb_frame moving, still;
    uint64_t all = 0;
    int maps_kept = 0;

    memset(&settings, 0, sizeof settings);
    settings.kernels = lmb_kernels_pick();
    settings.scene = &scene;
    settings.shadow_map = 128;
    settings.tree = 32;
    lmb_view_look_at(&settings.view, room_eye, room_middle, room_up, 0.8f, 64, 48);
    if (make_frame(&moving, &settings) != LMB_OK || make_frame(&still, &settings) != LMB_OK) {
        return 1;
    }
    for (int i = 0; i < 6; ++i) {
        if (i < 3) {
            const lmb_vec3 eye = {room_eye.x - 0.1f * (float)i, room_eye.y, room_eye.z};
            lmb_view_look_at(&moving.view, eye, room_middle, room_up, 0.8f, 64, 48);
        } else {
            light.position.x += 0.1f;
            ++light.revision;
        }
        still.view = moving.view;
        lmb_status status = lmb_render_reuse(&kept, &moving); /* `kept` is zeroed before the first frame */
        maps_kept += (kept.light_state[0] & LMB_SHADOW_MAP_REUSED) != 0;
        for (int more = status == LMB_OK; more; more = status == LMB_MORE) {
            status = lmb_render_step(&kept, 1000); /* a game would do other work in between */
        }
        const uint64_t hash = lmb_surface_hash(&moving.out);
        if (status != LMB_OK || lmb_render_frame(&fresh, &still) != LMB_OK || hash != lmb_surface_hash(&still.out)) {
            return 1;
        }
        all = all * 31 + hash;
    }
    free(moving.scratch); /* the block begins with the scratches */
    free(still.scratch);
    const uint64_t expected = BY_CONFIG(UINT64_C(0xece5ae6e3d60c85f), UINT64_C(0xf0f7faf78bb0b8e7));
    printf("6 frames, the light's map kept in %d of them\n", maps_kept);
    return maps_kept != 2 || ends_with("moving", all, expected);
}
