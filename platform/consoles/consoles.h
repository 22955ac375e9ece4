/* consoles.h: what ports to consoles share whose programs lie in RAM: the linker's places, the end, buttons. */
#ifndef CONSOLES_H
#define CONSOLES_H

#include <stdint.h>

/* From the linker script: the program's image, what is cleared, free memory up to stack_end, the stack up to stack_top.
 * The start-up fills the stack with STACK_PAINT, so that its depth can be told. */
extern uint32_t image_begin[], bss_begin[], bss_end[], stack_end[], stack_top[];

enum { STACK_PAINT = 0x5a5aa5a5 };

/* RAM of the machine, bytes: the port's. */
extern const uint32_t console_ram_bytes;

/* Called by the start-up with main's status. */
void port_leave(uint32_t status);

#endif
