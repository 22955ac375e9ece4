/* arm_calibrate.h: loops of known cost, to check counts and models of cycles: CALIBRATE_TURNS turns of a subtraction
 * and a jump, then CALIBRATE_LOADS turns that also load, each from the next line of 32 bytes.
 *
 * From the fastest memory, a turn of the first loop takes 4 cycles on an ARM7TDMI and an ARM946E-S. A turn of the
 * second takes 7 plus the memory's wait states on the former, and 5 plus the cost of a miss on the latter. */
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
    /* Marks the end of the count by an address; does nothing. */                                                  \
    __attribute__((noinline, target("arm"), section(".fast"))) void port_calibrated(void) { __asm__ volatile(""); }

#endif
