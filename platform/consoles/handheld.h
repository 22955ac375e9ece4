/* handheld.h: what the Game Boy Advance and the Nintendo DS have alike: timers, keys, and a start-up's loops. */
#ifndef HANDHELD_H
#define HANDHELD_H

#include <stdint.h>

#define REGISTER_8(address) (*(volatile uint8_t *)(address))
#define REGISTER_16(address) (*(volatile uint16_t *)(address))
#define REGISTER_32(address) (*(volatile uint32_t *)(address))

enum {
    TIMER_0 = 0x04000100, /* its count, and its control 2 bytes on */
    TIMER_1 = 0x04000104,
    KEYS = 0x04000130,    /* 0 where held */
    STACK_PAINT = 0x5a5aa5a5
};

/* port_clock counts from here on. */
void handheld_start_clock(void);

/* From the linker script. */
extern uint32_t stack_bottom[], stack_top[];

/* The deepest so far, bytes. */
uint32_t handheld_stack(void);

static inline void copy_words(uint32_t *to, const uint32_t *end, const uint32_t *from)
{
    while (to < end)
        *to++ = *from++;
}

static inline void fill_words(uint32_t *to, const uint32_t *end, uint32_t value)
{
    while (to < end)
        *to++ = value;
}

/* From the deepest place up to the stack at hand. */
static inline void paint_stack(void)
{
    uint32_t *stack;
    __asm__ volatile("mov %0, sp" : "=r"(stack));
    fill_words(stack_bottom, stack, STACK_PAINT);
}

#endif
