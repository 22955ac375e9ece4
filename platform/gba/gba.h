/* gba.h: registers of a Game Boy Advance that the room needs, and the symbols of gba.ld. */
#ifndef GBA_H
#define GBA_H

#include "../consoles/handheld.h"

enum {
    DISPLAY_CONTROL = 0x04000000, /* mode 3: a picture of 240 x 160 halfwords at VIDEO_RAM */
    DMA_3_FROM = 0x040000d4,
    DMA_3_TO = 0x040000d8,
    DMA_3_COUNT = 0x040000dc, /* number of words; mode in the upper half */
    WAIT_CONTROL = 0x04000204,
    VIDEO_RAM = 0x06000000
};

#define DMA_NOW_BY_WORDS 0x84000000u

/* Before main: starts the clock, and prints the time of loops of known cost. */
void gba_begin(void);

/* Code in the fast 32 KiB of RAM, data there, and data in the slow 256 KiB, each with an image in ROM. */
extern uint32_t fast_image[], fast_begin[], fast_end[], data_image[], data_begin[], data_end[], bss_begin[], bss_end[];
extern uint32_t ewram_image[], ewram_begin[], ewram_end[], ewram_top[];

#endif
