/* room_title.h: a title and the number of the frame, written over the room in white with a black shadow. */
#ifndef ROOM_TITLE_H
#define ROOM_TITLE_H

#include <stdint.h>

enum { ROOM_TITLE_X = 4, ROOM_TITLE_Y = 4, ROOM_TITLE_WIDTH = 72, ROOM_TITLE_ROWS = 9 }; /* px */

/* room_title: writes the part of the title that lies in the rows y .. y + rows - 1, which `pixels` begins with. The
 * counter has four digits.
 *
 *   format  LMB_FIXED_RGB888: pixels of 32 bits; other formats of lambent/fixed.h: of 16 bits
 *   width   of a row, at least ROOM_TITLE_X + ROOM_TITLE_WIDTH; otherwise nothing is written */
void room_title(void *pixels, int32_t format, int32_t width, int32_t y, int32_t rows, uint32_t frame);

#endif
