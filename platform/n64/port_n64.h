/* port_n64.h: what the parts of the Nintendo 64's port share. */
#ifndef PORT_N64_H
#define PORT_N64_H

#include <stdint.h>

/* n64_row: a row of room.h's colours, a multiple of 8 of them; out lies on 16 bytes. */
void n64_row(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y);

#endif
