/* ram_program.c: memory and exit of a program in a console's RAM, with the stack at the end of RAM. */
#include "../demo/room.h"
#include "../demo/room_port.h"
#include "../port.h"
#include "consoles.h"

/* All memory between the program and the stack. */
void *port_memory(size_t *bytes)
{
    *bytes = (size_t)((uintptr_t)stack_end - (uintptr_t)bss_end);
    return bss_end;
}

void port_ram_used(port_ram *out)
{
    const uint32_t *deepest = stack_end;
    while (deepest < stack_top && *deepest == STACK_PAINT)
        ++deepest;
    out->data = (uint32_t)((uintptr_t)bss_begin - (uintptr_t)image_begin);
    out->bss = (uint32_t)((uintptr_t)bss_end - (uintptr_t)bss_begin);
    out->bss += (uint32_t)room_bytes_kept(port_width, port_height);
    out->stack = (uint32_t)((uintptr_t)stack_top - (uintptr_t)deepest);
    out->size = console_ram_bytes;
}

void port_leave(uint32_t status) { port_put(status ? "left: failed\n" : "left: done\n"); }
