/* main_room.c: the room on any machine: its path once, with hashes and costs, then as buttons steer. */
#include "../port.h"
#include "../port_say.h"
#include "room.h"
#include "room_port.h"
#include "room_say.h"

static const char *const stage_names[ROOM_STAGES] = {"transform", "light", "fill", "show"};
static room shown;
static uint32_t hash, asked; /* of the frame at hand; whether anybody asks for it */

static void show(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    if (asked)
        hash = room_hash(hash, rgb, width * rows);
    const uint32_t from = port_clock();
    port_show_band(user, rgb, width, y, rows);
    shown.taken[ROOM_SHOW] += port_clock() - from;
}

static void draw(const room_pose *pose)
{
    shown.taken[ROOM_SHOW] = 0;
    room_draw(&shown, pose, show, NULL);
    port_show_frame();
}

int main(void)
{
    size_t bytes, band_bytes;
    room_pose pose;
    void *memory = port_memory(&bytes), *band = port_band_memory(&band_bytes);
    if (room_open(&shown, port_width, port_height, port_rows, memory, bytes, band, band_bytes) != 0) {
        port_put("room: too little memory, or damaged data\n");
        return 1;
    }
    shown.clock = port_clock;
    for (int32_t i = 0; i < ROOM_FRAMES; ++i) {
        room_path(&pose, i);
        asked = i == 0 || i == 30 || i == 59;
        hash = ROOM_HASH;
        draw(&pose);
        if (asked)
            say_frame(i, hash, stage_names, shown.taken, ROOM_STAGES);
    }
    if (say_ram() != 0)
        return 1;
    port_put("end of path\n");
    for (uint32_t held; (held = port_buttons()) != PORT_NO_BUTTONS;) {
        if (held) { /* so that who reads it can draw the same frames elsewhere */
            say_count("held ", held);
            port_put("\n");
        }
        room_steer(&pose, held);
        draw(&pose);
    }
    return 0;
}
