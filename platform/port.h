/* port.h: the functions that a program needs from a machine; the start-up of each platform/ folder provides them. */
#ifndef PORT_H
#define PORT_H

#include <stdint.h>

/* RAM used by the program, in bytes. If your port cannot measure it, leave all at 0. */
typedef struct port_ram {
    uint32_t data, bss; /* from the linker */
    uint32_t stack;     /* deepest so far, measured */
    uint32_t size;      /* total */
} port_ram;

/* port_put: prints text to the port's user; adds no newline. */
void port_put(const char *text);

void port_ram_used(port_ram *out);

#endif
