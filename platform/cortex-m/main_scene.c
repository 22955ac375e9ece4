/* main_scene.c: draws your packed scene (`lambent pack OUT.c --name scene_words`) from ROM, 160x120 in RGB565 with
 * bounced light from fixed groups: the settings of that row in the table of platform/README.md. No heap.
 *
 * Prints the frame's memory as that table counts it, the used part of MEMORY_KIB, the picture's hash and the RAM. The
 * hash is the same on a host. If the scene does not fit, the program prints why. */
#include <lambent/lambent.h>

#include "../port_say.h"

extern const uint32_t scene_words[];
extern const size_t scene_words_bytes;

#ifndef MEMORY_KIB
#define MEMORY_KIB 384 /* for the scene's structs and the frame; a frame with one spot light takes 371 */
#endif
enum { WIDTH = 160, HEIGHT = 120 };

static uint64_t memory[MEMORY_KIB * 128];
static lmb_pack pack;
static lmb_scene scene;
static lmb_frame frame;
static lmb_render render;

static lmb_frame_settings settings(void)
{
    static lmb_frame_settings s; /* zeros */
    s.kernels = lmb_kernels_pick();
    s.scene = &scene;
    s.format = LMB_RGB565;
    s.quality = LMB_QUALITY_FIXED;
    s.shadow_map = 128;
    return s;
}

static int too_large(size_t bytes)
{
    say_count("MEMORY_KIB is ", MEMORY_KIB);
    say_count("; this scene needs ", (uint32_t)((bytes + 1023) / 1024));
    port_put("\n");
    return 1;
}

static int failed(const char *what, lmb_status s)
{
    port_put(what);
    return say_error(lmb_status_name(s));
}

int main(void)
{
    lmb_status s = lmb_build_check();
    if (s != LMB_OK)
        return failed("this build draws other pixels: ", s);
    if ((s = lmb_pack_open(&pack, scene_words, scene_words_bytes)) != LMB_OK)
        return failed("scene_words is no packed scene of this byte order: ", s);
    const size_t structs = (lmb_pack_bytes(&pack) + 7) / 8 * 8;
    if (structs > sizeof memory)
        return too_large(structs);
    if ((s = lmb_pack_scene(&scene, &pack, memory, structs)) != LMB_OK)
        return failed("scene_words: ", s);
    if (pack.count[LMB_PACK_CAMERAS] == 0 || scene.light_count == 0)
        return say_error(scene.light_count ? "the scene has no camera" : "the scene has no light");

    lmb_frame_settings set = settings();
    if ((s = lmb_pack_view(&set.view, &pack, &scene, 0, 0.0f, WIDTH, HEIGHT)) != LMB_OK)
        return failed("the scene's camera: ", s);
    const size_t bytes = lmb_frame_bytes(&set);
    if (structs + bytes > sizeof memory)
        return too_large(structs + bytes);
    if ((s = lmb_frame_init(&frame, &set, memory + structs / 8, bytes)) != LMB_OK)
        return failed("the frame: ", s);
    if ((s = lmb_render_frame(&render, &frame)) != LMB_OK)
        return failed("the picture: ", s);

    say_count("frame ", (uint32_t)bytes);
    say_count(" bytes (", (uint32_t)((bytes + 512) / 1024));
    say_count(" KiB), with the scene's structs ", (uint32_t)(structs + bytes));
    say_count(" of ", (uint32_t)sizeof memory);
    port_put("\nscene-160x120-rgb565 ");
    say_hex(lmb_surface_hash(&frame.out));
    port_put("\n");
    return say_ram();
}
