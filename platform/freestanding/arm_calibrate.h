/* arm_calibrate.h: loops of known cost, by which counts and models of cycles are checked: CALIBRATE_TURNS turns of a
 * subtraction and a jump, then CALIBRATE_LOADS of a load, a line of 32 bytes further each time, and these two.
 *
 * On an ARM7TDMI and an ARM946E-S from the fastest memory a turn of the first takes 4 cycles. One of the second takes 7
 * on the first, and the memory's wait states; 5 on the second, and what a miss takes. */
#ifndef ARM_CALIBRATE_H
#define ARM_CALIBRATE_H

#include <stdint.h>

enum { CALIBRATE_TURNS = 10000, CALIBRATE_LOADS = 256 };

void port_calibrate(const uint32_t *from);
void port_calibrated(void);

#define ARM_CALIBRATE                                                                                              \
    __attribute__((noinline, target("arm"), section(".fast"))) void port_calibrate(const uint32_t *from)          \
    {                                                                                                              \
        uint32_t turns = CALIBRATE_TURNS, loads = CALIBRATE_LOADS, word;                                           \
        __asm__ volatile("1:\tsubs %0, %0, #1\n\tbne 1b\n2:\tldr %3, [%2], #32\n\tsubs %1, %1, #1\n\tbne 2b"       \
                         : "+r"(turns), "+r"(loads), "+r"(from), "=&r"(word)                                       \
                         :                                                                                         \
                         : "cc", "memory");                                                                        \
    }                                                                                                              \
    /* Where the count ends: it has a place, and no work. */                                                       \
    __attribute__((noinline, target("arm"), section(".fast"))) void port_calibrated(void) { __asm__ volatile(""); }

#endif
