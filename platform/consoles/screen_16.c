/* screen_16.c: copies rows of 0x00RRGGBB onto a screen of 16 bits, for the room by pixel: its renderer does not
 * draw onto the screen itself. */
#include "../demo/room.h"
#include "../demo/room_port.h"

/* Moves red from the low five bits to the high ones, and blue the other way; sets the last bit. */
static uint16_t turned(uint32_t c) { return (uint16_t)(c << 11 | (c & 0x3e0u) << 1 | (c >> 9 & 0x3eu) | 1u); }

void port_show_band(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    (void)user;
    for (int32_t i = 0; i < rows; ++i) {
        uint16_t *to = port_screen_rows(y + i);
        room_rgb555(to, rgb + i * width, width, y + i);
        for (int32_t x = 0; port_format == LMB_FIXED_RGBA5551 && x < width; ++x)
            to[x] = turned(to[x]);
    }
}
