/* main_packed.c: draws a scene from `lambent pack OUT.c --name scene_words`, in place in ROM, 96x64 in RGB565 with
 * direct light; no heap. Prints the picture's hash, which is the same on a host, and the RAM. */
#include <lambent/lambent.h>

#include "../port_say.h"

extern const uint32_t scene_words[];
extern const size_t scene_words_bytes;

enum { WIDTH = 96, HEIGHT = 64 };

static uint64_t structs[512], memory[24576]; /* of the scene; of the frame */
static uint32_t picture[WIDTH * HEIGHT / 2];
static lmb_frame frame;
static lmb_render render;

static lmb_status draw(void)
{
    static lmb_pack pack;
    static lmb_scene scene;
    static lmb_frame_settings set;
    lmb_status s = lmb_build_check();
    if (s == LMB_OK)
        s = lmb_pack_open(&pack, scene_words, scene_words_bytes);
    if (s == LMB_OK)
        s = lmb_pack_scene(&scene, &pack, structs, sizeof structs);
    if (s == LMB_OK)
        s = lmb_pack_view(&set.view, &pack, &scene, 0, 0.0f, WIDTH, HEIGHT);
    set.kernels = lmb_kernels_pick();
    set.scene = &scene;
    set.show = LMB_SHOW_DIRECT;
    set.shadow_map = 64;
    if (s == LMB_OK)
        s = lmb_surface_init(&set.out, LMB_RGB565, WIDTH, HEIGHT, picture, sizeof picture);
    if (s == LMB_OK)
        s = lmb_frame_init(&frame, &set, memory, sizeof memory);
    return s == LMB_OK ? lmb_render_frame(&render, &frame) : s;
}

int main(void)
{
    const lmb_status s = draw();
    if (s != LMB_OK) {
        return say_error(lmb_status_name(s));
    }
    port_put("packed-96x64-rgb565 ");
    say_hex(lmb_surface_hash(&frame.out));
    port_put("\n");
    return say_ram();
}
