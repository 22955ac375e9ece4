/* gba.h: a Game Boy Advance's registers that the room needs, and the places of gba.ld. */
#ifndef GBA_H
#define GBA_H

#include <stdint.h>

#define REGISTER_16(address) (*(volatile uint16_t *)(address))
#define REGISTER_32(address) (*(volatile uint32_t *)(address))

enum {
    DISPLAY_CONTROL = 0x04000000, /* mode 3: a picture of 240 x 160 halfwords at VIDEO_RAM */
    DMA_3_FROM = 0x040000d4,
    DMA_3_TO = 0x040000d8,
    DMA_3_COUNT = 0x040000dc, /* words, and how, in the upper half */
    TIMER_2 = 0x04000108,     /* its count, and its control 2 bytes on */
    TIMER_3 = 0x0400010c,
    KEYS = 0x04000130,        /* 0 where held */
    WAIT_CONTROL = 0x04000204,
    VIDEO_RAM = 0x06000000
};

#define DMA_NOW_BY_WORDS 0x84000000u

enum { STACK_PAINT = 0x5a5aa5a5 };

/* Before main: starts the clock, and says what loops of known cost take by it. */
void gba_begin(void);

/* Code in the fast 32 KiB of RAM, data there, and data in the slow 256 KiB, each with its image in ROM. */
extern uint32_t fast_image[], fast_begin[], fast_end[], data_image[], data_begin[], data_end[], bss_begin[], bss_end[];
extern uint32_t ewram_image[], ewram_begin[], ewram_end[], ewram_top[], stack_bottom[], stack_top[];

#endif
