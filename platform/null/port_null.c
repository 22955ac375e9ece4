/* port_null.c: a port that does nothing: copy its folder, and fill in what the comments say, in their order. It builds
 * by any compiler, and its room draws into nothing. platform/README.md has the steps. */
#include "../demo/room.h"
#include "../demo/room_port.h"
#include "../port.h"

enum { WIDTH = 160, HEIGHT = 120, ROWS = 8, ROOM_BYTES = 24576 };

/* 1. Start, where no system calls main. The entry sets the stack pointer, turns the FPU on, copies .data from ROM,
 * clears .bss, calls main and goes to 3 with what main returns. No other C may run before memory is clear. */

/* 2. Output: text to a serial line, a debugger, a log. The first thing to get going: all else is found by it. */
void port_put(const char *text) { (void)text; }

/* 3. The end, where main returns to no system: tell the emulator to stop, or wait for ever. */

/* 4. A clock that counts up: cycles or microseconds. At 0 it is no clock, and the room draws all the same. */
uint32_t port_clock(void) { return 0; }
const char *const port_clock_unit = "of no clock";

/* 5. A screen, and memory to draw in. The picture's size is yours, up to ROOM_MAX_WIDTH x ROOM_MAX_HEIGHT. The band is
 * read and written most: it wants the fastest memory. 4 bytes of colour and 2 of depth a pixel. A screen of 16 bits may be
 * drawn on straight: name its format, one of lambent/fixed.h, and where its rows are; then the band has depths alone. */
const int32_t port_width = WIDTH, port_height = HEIGHT, port_rows = ROWS, port_format = LMB_FIXED_RGB888;

/* room_bytes() of them at least, or the room says so. */
static uint32_t memory[ROOM_BYTES / 4], band[ROOM_BAND_BYTES(WIDTH, ROWS) / 4];

void *port_memory(size_t *bytes)
{
    *bytes = sizeof memory;
    return memory;
}

void *port_band_memory(size_t *bytes)
{
    *bytes = sizeof band;
    return band;
}

/* Rows y .. y + rows - 1 of the picture, 0x00RRGGBB, into the screen's own format: room_rgb555 and room_rgb565 make a
 * row of 16 bits. Without a screen: send them as the body of a PPM file. */
void port_show_band(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    (void)user, (void)rgb, (void)width, (void)y, (void)rows;
}

uint16_t *port_screen_rows(int32_t y) { return (void)y, NULL; }

/* The picture is whole: wait for the display, and show it. */
void port_show_frame(void) {}

/* 6. Buttons, of room.h. Without any the program ends after its path. */
uint32_t port_buttons(void) { return PORT_NO_BUTTONS; }

/* 7. RAM that the program took: zeros where nothing tells. platform/freestanding/bare.c measures it. */
void port_ram_used(port_ram *out)
{
    static const port_ram unknown;
    *out = unknown;
}
