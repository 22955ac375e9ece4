/* main_live.c: a frame of the demo scene, 160x120 in RGB565, in less than 160 KiB of RAM: direct light of the lamp, and
 * with BAKED 1 (main_baked.c) bounced light, by the transfer that tests/scripts/live.sh bakes.
 *
 * Prints the picture's hash, the instructions for the frame (0: unknown), and the RAM. The hash must be the
 * same on a host. */
#include <lambent/lambent.h>

#include "../../tools/demo/demo_scene.h"
#include "../port_say.h"
#include "count.h"
#include "strips.h"

#ifndef BAKED
#define BAKED 0
#endif

enum { MAP_SIZE = 80 };

#if BAKED
static const uint32_t baked[] = {
#include "baked.inc"
};
static lmb_transfer transfer;
static uint32_t light[6800];
static const char name[] = "demo-baked";
#else
static const char name[] = "demo-direct";
#endif

static uint32_t map_memory[MAP_SIZE * MAP_SIZE * 6 / 4];
static lmb_band_scratch scratch;
static lmb_render render;
static lmb_frame frame;

static lmb_status place_light(void)
{
#if BAKED
    lmb_status s = lmb_transfer_open(&transfer, baked, sizeof baked);
    if (s == LMB_OK)
        s = lmb_transfer_fits(&transfer, demo_scene());
    if (s == LMB_OK)
        s = lmb_transfer_light_init(&frame.transfer_light, &transfer, light, sizeof light);
    if (s == LMB_OK)
        s = lmb_transfer_materials(&frame.transfer_light, &transfer, demo_scene());
    frame.transfer = &transfer;
    return s;
#else
    frame.show = LMB_SHOW_DIRECT;
    return LMB_OK;
#endif
}

static lmb_status place(void)
{
    lmb_status s = lmb_build_check();
    if (s == LMB_OK)
        s = place_strips(&frame);
    frame.kernels = lmb_kernels_pick();
    frame.scene = demo_scene();
    frame.view = demo_view(WIDTH, HEIGHT);
    frame.shadow_map = MAP_SIZE;
    frame.map_memory = map_memory;
    frame.map_bytes = sizeof map_memory;
    frame.id_format = LMB_ID16;
    frame.scratch = &scratch;
    return s == LMB_OK ? place_light() : s;
}

int main(void)
{
    lmb_status s = place();
    count_start();
    if (s == LMB_OK)
        s = lmb_render_frame(&render, &frame);
    const uint32_t taken = count_taken();
    if (s != LMB_OK) {
        return say_error(lmb_status_name(s));
    }
    port_put(name);
    port_put("-160x120-rgb565 ");
    say_hex(lmb_surface_hash(&frame.out));
    say_count("\ninstructions ", taken);
    port_put("\n");
    return say_ram();
}
