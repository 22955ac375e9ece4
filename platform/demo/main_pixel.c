/* main_pixel.c: the room with light at each pixel, 160 x 120, on any machine: frame 0 of the path, and also frames 30
 * and 59 if PIXEL_FRAMES is 3, with hashes and costs. */
#include "../port.h"
#include "../port_say.h"
#include "room_pixel.h"
#include "room_port.h"
#include "room_say.h"

#ifndef PIXEL_FRAMES
#define PIXEL_FRAMES 3
#endif

enum { WIDTH = 160, HEIGHT = 120 };

static const char *const stage_names[ROOM_PIXEL_STAGES] = {"map", "light", "fill", "show"};
static room_pixel shown;
static uint32_t memory[ROOM_PIXEL_WORDS(WIDTH)];
static uint32_t hash;

static void show(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    hash = room_hash(hash, rgb, width * rows);
    port_show_band(user, rgb, width, y, rows);
}

int main(void)
{
    static const int32_t frames[] = {0, 30, 59};
    lmb_status s = room_pixel_open(&shown, WIDTH, HEIGHT, memory);
    shown.clock = port_clock;
    for (int i = 0; i < PIXEL_FRAMES && s == LMB_OK; ++i) {
        room_pose pose;
        room_path(&pose, frames[i]);
        hash = ROOM_HASH;
        s = room_pixel_draw(&shown, &pose, show, NULL);
        if (s == LMB_OK) {
            port_show_frame();
            say_frame(frames[i], hash, stage_names, shown.taken, ROOM_PIXEL_STAGES);
        }
    }
    if (s != LMB_OK) {
        port_put("room, light by pixel: ");
        return say_error(lmb_status_name(s));
    }
    if (say_ram() != 0)
        return 1;
    port_put("end of path\n");
    return 0;
}
