/* port_gamecube.h: what the parts of the GameCube's port share. */
#ifndef PORT_GAMECUBE_H
#define PORT_GAMECUBE_H

#include <stdint.h>

/* gamecube_row: a row of room.h's colours, a multiple of 16 of them, as the video interface takes it: of each two
 * pixels
 * Y, Cb, Y, Cr; out lies on 32 bytes. */
void gamecube_row(uint32_t *out, const uint32_t *rgb, int32_t width);

#endif
