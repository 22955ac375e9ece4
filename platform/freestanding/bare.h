/* bare.h: what a port without operating system shares with bare.c. Addresses come from its linker script. */
#ifndef BARE_H
#define BARE_H

#include <stdint.h>

extern uint32_t data_image[], data_begin[], data_end[], bss_begin[], bss_end[], ram_begin[], ram_end[];

/* The port's: a trap that the debugger, or qemu, answers, with its answer. `argument` as the operation has it. */
uintptr_t semihost(uint32_t operation, const void *argument);

/* From a working stack and FPU: fills RAM, runs main, leaves with its status. Never returns. */
void bare_run(void);

/* For every vector of a fault: says so and leaves with 99. */
void bare_fault(void);

#endif
