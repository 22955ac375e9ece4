/* port_room.c: room_port.h on a machine with libc: frames of any size, set by the build's ROOM_SIZE. If you set
 * ROOM_PICTURES, the folder gets the frames as pictures, with ROOM_COLOURS=555 in 5 bits a colour. After the path it
 * draws a frame for each number of ROOM_HELD, which are held buttons. */
#include "../demo/room_port.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../demo/room.h"

#ifndef ROOM_WIDTH
#define ROOM_WIDTH  320
#define ROOM_HEIGHT 240
#define ROOM_ROWS   16
#endif

const int32_t port_width = ROOM_WIDTH, port_height = ROOM_HEIGHT, port_rows = ROOM_ROWS,
              port_format = LMB_FIXED_RGB888;
const char *const port_clock_unit = "us";

static uint8_t picture[ROOM_HEIGHT][ROOM_WIDTH][3];

static uint8_t widened(unsigned bits) { return (uint8_t)(bits << 3 | bits >> 2); }

static void put_555(const uint32_t *rgb, int32_t y)
{
    uint16_t row[ROOM_WIDTH];
    room_rgb555(row, rgb, ROOM_WIDTH, y);
    for (int32_t x = 0; x < ROOM_WIDTH; ++x)
        for (int i = 0; i < 3; ++i)
            picture[y][x][i] = widened(row[x] >> 5 * i & 31u);
}

static void *get(size_t *bytes, size_t wanted)
{
    *bytes = wanted;
    return malloc(wanted);
}

void *port_memory(size_t *bytes) { return get(bytes, room_bytes(ROOM_WIDTH, ROOM_HEIGHT)); }

void *port_band_memory(size_t *bytes) { return get(bytes, ROOM_BAND_BYTES(ROOM_WIDTH, ROOM_ROWS)); }

uint32_t port_clock(void) { return (uint32_t)((double)clock() * 1e6 / (double)CLOCKS_PER_SEC); }

void port_show_band(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    (void)user;
    if (getenv("ROOM_COLOURS")) {
        for (int32_t i = 0; i < rows; ++i)
            put_555(rgb + i * width, y + i);
        return;
    }
    for (int32_t i = 0; i < width * rows; ++i) {
        uint8_t *out = picture[y + i / width][i % width];
        out[0] = (uint8_t)(rgb[i] >> 16), out[1] = (uint8_t)(rgb[i] >> 8), out[2] = (uint8_t)rgb[i];
    }
}

uint16_t *port_screen_rows(int32_t y) { return (void)y, NULL; } /* only for a format of 16 bits */

void port_show_frame(void)
{
    static int frame;
    const char *folder = getenv("ROOM_PICTURES"); /* for frame_00.ppm and on */
    char name[512];
    if (folder == NULL || snprintf(name, sizeof name, "%s/frame_%02d.ppm", folder, frame++) >= (int)sizeof name)
        return;
    FILE *file = fopen(name, "wb");
    if (file != NULL) {
        fprintf(file, "P6\n%d %d\n255\n", ROOM_WIDTH, ROOM_HEIGHT);
        fwrite(picture, sizeof picture, 1, file);
        fclose(file);
    }
}

uint32_t port_buttons(void)
{
    static const char *at;
    char *end;
    if (at == NULL && (at = getenv("ROOM_HELD")) == NULL)
        return PORT_NO_BUTTONS;
    const unsigned long held = strtoul(at, &end, 10);
    if (end == at)
        return PORT_NO_BUTTONS;
    at = end;
    return (uint32_t)held;
}
