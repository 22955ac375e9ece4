/* port.h: what a program needs from the machine it runs on; each platform/ folder has a start-up that gives it. */
#ifndef PORT_H
#define PORT_H

#include <stdint.h>

/* RAM that the program takes, in bytes. A port that cannot tell leaves all at 0. */
typedef struct port_ram {
    uint32_t data, bss; /* from the linker */
    uint32_t stack;     /* deepest so far, measured */
    uint32_t size;      /* what there is */
} port_ram;

/* port_put: text to wherever the port's user reads it; no newline is added. */
void port_put(const char *text);

void port_ram_used(port_ram *out);

#endif
