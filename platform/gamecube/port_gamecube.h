/* port_gamecube.h: shared by the files of the GameCube port. */
#ifndef PORT_GAMECUBE_H
#define PORT_GAMECUBE_H

#include <stdint.h>

/* gamecube_row: converts a row of room.h's colours, a multiple of 16, for the video interface: two pixels become Y, Cb,
 * Y, Cr. `out` is aligned to 32 bytes. */
void gamecube_row(uint32_t *out, const uint32_t *rgb, int32_t width);

#endif
