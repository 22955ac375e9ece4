/* port_null.c: a port that does nothing: copy the folder, and fill in the code as the comments say, in this order. It
 * builds with any compiler and draws the room into nothing. platform/README.md has the steps. */
#include "../demo/room.h"
#include "../demo/room_port.h"
#include "../port.h"

enum { WIDTH = 160, HEIGHT = 120, ROWS = 8, ROOM_BYTES = 24576 };

/* 1. Start, if no system calls main. Your entry sets the stack pointer, turns the FPU on, copies .data from ROM, clears
 * .bss, calls main and passes main's result to 3. Run no other C code before memory is clear. */

/* 2. Output: text to a serial line, a debugger, a log. Do this first: you need it to find all other errors. */
void port_put(const char *text) { (void)text; }

/* 3. The end, if main returns to no system: stop the emulator, or loop for ever. */

/* 4. A clock that counts up: cycles or microseconds. If you leave it at 0, the room is still drawn. */
uint32_t port_clock(void) { return 0; }
const char *const port_clock_unit = "of no clock";

/* 5. A screen, and memory to draw in. You choose the picture's size, up to ROOM_MAX_WIDTH x ROOM_MAX_HEIGHT. The
 * band is accessed most, so give it the fastest memory: 4 bytes of colour and 2 of depth a pixel. The room can
 * draw directly onto a screen of 16 bits: return its format from lambent/fixed.h, and the memory of its rows; then
 * the band holds only depths. */
const int32_t port_width = WIDTH, port_height = HEIGHT, port_rows = ROWS, port_format = LMB_FIXED_RGB888;

/* At least room_bytes() of memory; otherwise the room prints an error. */
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

/* Converts rows y .. y + rows - 1 of the picture, 0x00RRGGBB, to the screen's own format: room_rgb555 and room_rgb565
 * make a row of 16 bits. Without a screen you can send them as the body of a PPM file. */
void port_show_band(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    (void)user, (void)rgb, (void)width, (void)y, (void)rows;
}

uint16_t *port_screen_rows(int32_t y) { return (void)y, NULL; }

/* The picture is complete: wait for the display, and show it. */
void port_show_frame(void) {}

/* 6. Buttons, of room.h. Without any, the program ends after the path. */
uint32_t port_buttons(void) { return PORT_NO_BUTTONS; }

/* 7. RAM used by the program: zeros if you cannot measure it. platform/freestanding/bare.c measures it. */
void port_ram_used(port_ram *out)
{
    static const port_ram unknown;
    *out = unknown;
}
