/* handheld.h: shared by the Game Boy Advance and the Nintendo DS: timers, keys, and loops of the start-up. */
#ifndef HANDHELD_H
#define HANDHELD_H

#include <stdint.h>

#define REGISTER_8(address) (*(volatile uint8_t *)(address))
#define REGISTER_16(address) (*(volatile uint16_t *)(address))
#define REGISTER_32(address) (*(volatile uint32_t *)(address))

enum {
    TIMER_0 = 0x04000100, /* counter; control is 2 bytes on */
    TIMER_1 = 0x04000104,
    KEYS = 0x04000130,    /* 0 if held */
    STACK_PAINT = 0x5a5aa5a5
};

/* Starts port_clock. */
void handheld_start_clock(void);

/* From the linker script. */
extern uint32_t stack_bottom[], stack_top[];

/* Deepest stack so far, bytes. */
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

/* Paints from the lower end up to the current stack pointer. */
static inline void paint_stack(void)
{
    uint32_t *stack;
    __asm__ volatile("mov %0, sp" : "=r"(stack));
    fill_words(stack_bottom, stack, STACK_PAINT);
}

#endif
