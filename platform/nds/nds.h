/* nds.h: a Nintendo DS's registers that the room needs, and the places of nds.ld. */
#ifndef NDS_H
#define NDS_H

#include <stdint.h>

#define REGISTER_8(address) (*(volatile uint8_t *)(address))
#define REGISTER_16(address) (*(volatile uint16_t *)(address))
#define REGISTER_32(address) (*(volatile uint32_t *)(address))

enum {
    DISPLAY_CONTROL = 0x04000000, /* 0x00020000: the main screen shows bank A of video RAM, 0x00060000: bank B */
    TIMER_0 = 0x04000100,         /* its count, and its control 2 bytes on */
    TIMER_1 = 0x04000104,
    KEYS = 0x04000130,            /* 0 where held */
    INTERRUPTS = 0x04000208,
    BANK_A = 0x04000240, /* how video RAM is used; bank B's follows */
    POWER = 0x04000304,
    VIDEO_RAM = 0x06800000, /* bank A, 128 KiB; then B */
    BANK_BYTES = 0x20000
};

enum { STACK_PAINT = 0x5a5aa5a5 };

/* Code and data in the memories beside the processor, with their images in main memory. */
extern uint32_t fast_image[], fast_begin[], fast_end[], near_begin[], near_end[], bss_begin[], bss_end[];
extern uint32_t data_begin[], data_end[], image_begin[], main_top[], stack_bottom[], stack_top[];

/* Before main: the clock starts, the screen is on. */
void nds_begin(void);

#endif
