/* main_room.c: the room on any machine: the whole path once, with hashes and costs; then buttons steer. A title and a
 * frame counter lie over the picture; hashes are of the picture without them. */
#include "../port.h"
#include "../port_say.h"
#include "room.h"
#include "room_port.h"
#include "room_say.h"
#include "room_title.h"

static const char *const stage_names[ROOM_STAGES] = {"transform", "light", "fill", "show"};
static room shown;
static uint32_t frame; /* of the path, then one more for each with a held button */
static uint16_t *screen;

/* The band is the room's own, and is not read again after it was shown. */
static void show(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    const uint32_t from = port_clock();
    room_title(shown.band, port_format, width, y, rows, frame);
    port_show_band(user, rgb, width, y, rows);
    shown.taken[ROOM_SHOW] += port_clock() - from;
}

static uint16_t *screen_rows(int32_t y)
{
    uint16_t *rows = port_screen_rows(y);
    screen = y == 0 ? rows : screen;
    return rows;
}

static void draw(const room_pose *pose)
{
    room_see(&shown, pose);
    if (port_format == LMB_FIXED_RGB888)
        room_put_bands(&shown, show, NULL);
    else
        room_draw_on(&shown, port_format, screen_rows);
    const uint32_t from = port_clock();
    if (port_format != LMB_FIXED_RGB888)
        room_title(screen, port_format, port_width, 0, port_height, frame);
    port_show_frame();
    shown.taken[ROOM_SHOW] += port_clock() - from;
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
        frame = (uint32_t)i;
        room_path(&pose, i);
        draw(&pose);
        if (i == 0 || i == 30 || i == 59)
            say_frame(i, room_frame_hash(&shown), stage_names, shown.taken, ROOM_STAGES);
    }
    if (say_ram() != 0)
        return 1;
    port_put("end of path\n");
    for (uint32_t held; (held = port_buttons()) != PORT_NO_BUTTONS;) {
        if (held) { /* so that you can draw the same frames elsewhere */
            say_count("held ", held);
            port_put("\n");
        }
        frame += held != 0;
        room_steer(&pose, held);
        draw(&pose);
    }
    return 0;
}
