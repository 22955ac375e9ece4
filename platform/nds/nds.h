/* nds.h: registers of a Nintendo DS that the room needs, and the symbols of nds.ld. */
#ifndef NDS_H
#define NDS_H

#include "../consoles/handheld.h"

enum {
    DISPLAY_CONTROL = 0x04000000, /* 0x00020000: the main screen shows bank A of video RAM, 0x00060000: bank B */
    INTERRUPTS = 0x04000208,
    BANK_A = 0x04000240, /* use of video RAM; bank B's follows */
    POWER = 0x04000304,
    VIDEO_RAM = 0x06800000, /* bank A, 128 KiB; then B */
    BANK_BYTES = 0x20000
};

/* Code and data in the memories beside the processor, with images in main memory. */
extern uint32_t fast_image[], fast_begin[], fast_end[], fast_top[], near_begin[], near_end[], bss_begin[], bss_end[];
extern uint32_t data_begin[], data_end[], image_begin[], main_top[];

/* Before main: starts the clock and turns the screen on. */
void nds_begin(void);

#endif
