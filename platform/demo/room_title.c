/* room_title.c: the title, glyph by glyph with lmb_text, which needs no float and no memory. */
#include "room_title.h"

#include <lambent/draw.h>
#include <lambent/fixed.h>

enum { CELL = 6, NONE = 0, DARK = 1 }; /* px; codes of LMB_RGB555 */

/* The glyph and its shadow. */
static void set_glyph(uint16_t glyph[ROOM_TITLE_ROWS][CELL], char c)
{
    static const uint8_t white[4] = {255, 255, 255, 255}, dark[4] = {0, 0, 8, 255};
    const lmb_surface to = {glyph, CELL, ROOM_TITLE_ROWS, CELL * 2, LMB_RGB555, LMB_LINEAR, 0};
    const char text[2] = {c, 0};
    for (int i = 0; i < ROOM_TITLE_ROWS * CELL; ++i)
        glyph[i / CELL][i % CELL] = NONE;
    lmb_text(&to, 1, 1, text, 1, dark);
    lmb_text(&to, 0, 0, text, 1, white);
}

static void put_pixel(void *pixels, int32_t format, int32_t at, int is_dark)
{
    if (format == LMB_FIXED_RGB888)
        ((uint32_t *)pixels)[at] = is_dark ? 0 : 0xffffff;
    else if (format == LMB_FIXED_RGBA5551)
        ((uint16_t *)pixels)[at] = is_dark ? 1 : 0xffff;
    else
        ((uint16_t *)pixels)[at] = is_dark ? 0 : 0x7fff;
}

void room_title(void *pixels, int32_t format, int32_t width, int32_t y, int32_t rows, uint32_t frame)
{
    char text[] = "lambent 0000";
    uint16_t glyph[ROOM_TITLE_ROWS][CELL];
    if (width < ROOM_TITLE_X + ROOM_TITLE_WIDTH || y >= ROOM_TITLE_Y + ROOM_TITLE_ROWS || y + rows <= ROOM_TITLE_Y)
        return;
    for (int i = 11; i > 7; --i, frame /= 10)
        text[i] = (char)('0' + frame % 10);
    for (int32_t i = 0; text[i] != 0; ++i) {
        set_glyph(glyph, text[i]);
        for (int32_t k = 0; k < ROOM_TITLE_ROWS * CELL; ++k) {
            const int32_t row = ROOM_TITLE_Y + k / CELL - y, code = glyph[k / CELL][k % CELL];
            if (code != NONE && row >= 0 && row < rows)
                put_pixel(pixels, format, row * width + ROOM_TITLE_X + CELL * i + k % CELL, code == DARK);
        }
    }
}
