/* room_port.h: what main_room.c needs from a machine, beside port.h: memory, a screen, a clock, buttons, an end. */
#ifndef ROOM_PORT_H
#define ROOM_PORT_H

#include <stddef.h>
#include <stdint.h>

/* The picture's size and a band's rows, px; its format, of lambent/fixed.h: where it has 16 bits, bands of room.c are drawn
 * straight onto the screen. */
extern const int32_t port_width, port_height, port_rows, port_format;

/* room_bytes or room_bytes_kept of memory for the port's size, and of the fastest ROOM_BAND_BYTES, or ROOM_DEPTH_BYTES
 * where the format has 16 bits. Each lies on 4 bytes. */
void *port_memory(size_t *bytes);
void *port_band_memory(size_t *bytes);

/* A clock that counts up and may wrap, and what it counts: "instructions", "cycles", "us". It may stand still at 0. */
uint32_t port_clock(void);
extern const char *const port_clock_unit;

/* A band in 0x00RRGGBB onto the screen that is not shown yet; or, of a format of 16 bits, where on it rows from y on lie.
 * Then that screen is shown. */
void port_show_band(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows);
uint16_t *port_screen_rows(int32_t y);
void port_show_frame(void);

/* Buttons that are held, of room.h; PORT_NO_BUTTONS: there are none, and the program ends after its path. */
#define PORT_NO_BUTTONS 0xffffffffu
uint32_t port_buttons(void);

/* What is held of room.h's buttons, by the bits of a machine's own word that mean each of them, in their order. */
static inline uint32_t room_held(uint32_t word, const uint32_t bits[8])
{
    uint32_t held = 0;
    for (int i = 0; i < 8; ++i)
        held |= (uint32_t)((word & bits[i]) != 0) << i;
    return held;
}

#endif
