/* handheld.c: clock, keys and stack depth on a Game Boy Advance and on a Nintendo DS. */
#include "handheld.h"

#include "../demo/room.h"
#include "../demo/room_port.h"

/* Timer 1 counts the overflows of timer 0. */
void handheld_start_clock(void)
{
    REGISTER_16(TIMER_1) = 0;
    REGISTER_16(TIMER_0) = 0;
    REGISTER_16(TIMER_1 + 2) = 0x84;
    REGISTER_16(TIMER_0 + 2) = 0x80;
}

uint32_t port_clock(void)
{
    for (;;) {
        const uint32_t high = REGISTER_16(TIMER_1), low = REGISTER_16(TIMER_0);
        if (REGISTER_16(TIMER_1) == high)
            return high << 16 | low;
    }
}

uint32_t handheld_stack(void)
{
    const uint32_t *deepest = stack_bottom;
    while (deepest < stack_top && *deepest == STACK_PAINT)
        ++deepest;
    return (uint32_t)(stack_top - deepest) * 4;
}

/* The cross; left and right shoulder; A and B. */
uint32_t port_buttons(void)
{
    static const uint32_t key[ROOM_BUTTONS] = {1u << 5, 1u << 4, 1u << 6, 1u << 7, 1u << 9, 1u << 8, 1u << 0, 1u << 1};
    return room_held(~(uint32_t)REGISTER_16(KEYS), key);
}
