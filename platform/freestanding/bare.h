/* bare.h: shared by bare.c and a port without operating system. Addresses come from the port's linker script. */
#ifndef BARE_H
#define BARE_H

#include <stdint.h>

extern uint32_t data_image[], data_begin[], data_end[], bss_begin[], bss_end[], ram_begin[], ram_end[];

/* Your port defines it: a trap that the debugger, or qemu, answers; returns the answer. The
 * operation defines `argument`. */
uintptr_t semihost(uint32_t operation, const void *argument);

/* Call it with a working stack and FPU: fills RAM, runs main, and exits with main's status. Never returns. */
void bare_run(void);

/* For every vector of a fault: prints a line and exits with 99. */
void bare_fault(void);

#endif
