/* count.h: counts instructions by the system timer of a Cortex-M under qemu -icount shift=0: an instruction takes 1 ns,
 * and the timer of the mps2 boards ticks every 40. Elsewhere 0. */
#ifndef CORTEX_M_COUNT_H
#define CORTEX_M_COUNT_H

#include <stdint.h>

#if defined(__arm__) && !defined(__linux__)
enum { COUNT_PER_TICK = 40, COUNT_MASK = 0xffffff };
static volatile uint32_t *const count_timer = (volatile uint32_t *)0xe000e010u; /* control, reload, value */

static inline void count_start(void)
{
    count_timer[1] = COUNT_MASK;
    count_timer[2] = 0;
    count_timer[0] = 5; /* on, with the processor's clock */
}

/* Instructions since count_start, up to 671 million. */
static inline uint32_t count_taken(void) { return (COUNT_MASK - count_timer[2]) * COUNT_PER_TICK; }
#else
static inline void count_start(void) {}
static inline uint32_t count_taken(void) { return 0; }
#endif

#endif
