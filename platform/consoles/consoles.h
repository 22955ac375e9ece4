/* consoles.h: shared by ports to consoles that load programs into RAM: linker symbols, the end, buttons. */
#ifndef CONSOLES_H
#define CONSOLES_H

#include <stdint.h>

/* From the linker script: the program's image, the memory to clear, free memory up to stack_end, the stack up to
 * stack_top. The start-up fills the stack with STACK_PAINT, to measure its depth. */
extern uint32_t image_begin[], bss_begin[], bss_end[], stack_end[], stack_top[];

enum { STACK_PAINT = 0x5a5aa5a5 };

/* The port defines it: bytes of RAM. */
extern const uint32_t console_ram_bytes;

/* The start-up calls it with main's status. */
void port_leave(uint32_t status);

#endif
