/* room_port.h: the functions that main_room.c needs from your port, beside port.h: memory, a screen,
 * a clock, buttons, an end. */
#ifndef ROOM_PORT_H
#define ROOM_PORT_H

#include <stddef.h>
#include <stdint.h>

/* The picture's size and a band's rows, px, and the format from lambent/fixed.h: if it has 16 bits, room.c draws bands
 * directly onto the screen. */
extern const int32_t port_width, port_height, port_rows, port_format;

/* Returns room_bytes or room_bytes_kept of memory for the port's size; port_band_memory: ROOM_BAND_BYTES of the fastest
 * memory, or ROOM_DEPTH_BYTES if the format has 16 bits. Both are aligned to 4 bytes. */
void *port_memory(size_t *bytes);
void *port_band_memory(size_t *bytes);

/* A clock that counts up and may wrap, and the unit: "instructions", "cycles", "us". Return 0 if you have no clock. */
uint32_t port_clock(void);
extern const char *const port_clock_unit;

/* port_show_band: copies a band in 0x00RRGGBB onto the screen that is not shown yet. port_screen_rows: if the format
 * has 16 bits, returns the memory of rows from y on. port_show_frame: shows that screen. */
void port_show_band(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows);
uint16_t *port_screen_rows(int32_t y);
void port_show_frame(void);

/* Held buttons, of room.h; PORT_NO_BUTTONS: there are none, and the program ends after the path. */
#define PORT_NO_BUTTONS 0xffffffffu
uint32_t port_buttons(void);

/* Converts a machine's own word to held buttons of room.h: `bits` are the word's bits for each button, in order. */
static inline uint32_t room_held(uint32_t word, const uint32_t bits[8])
{
    uint32_t held = 0;
    for (int i = 0; i < 8; ++i)
        held |= (uint32_t)((word & bits[i]) != 0) << i;
    return held;
}

#endif
