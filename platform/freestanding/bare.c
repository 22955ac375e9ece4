/* bare.c: a program without operating system: initialises RAM for C, runs main, measures the used RAM, and exits. */
#include "bare.h"

#include "../port.h"

enum { STACK_PAINT = 0x5a5aa5a5 };

#if defined(__riscv)
#define STACK_POINTER "mv %0, sp"
#else
#define STACK_POINTER "mov %0, sp"
#endif

int main(void);

/* --- semihosting -------------------------------------------------------------------------------------------------- */

enum { SYS_WRITE0 = 0x04, SYS_EXIT_EXTENDED = 0x20, STOPPED_BY_APPLICATION = 0x20026 };

void port_put(const char *text) { semihost(SYS_WRITE0, text); }

static void leave(uint32_t status)
{
    uintptr_t block[2] = {STOPPED_BY_APPLICATION, 0};
    block[1] = status;
    for (;;)
        semihost(SYS_EXIT_EXTENDED, block);
}

void bare_fault(void)
{
    port_put("fault: bad access, stack overflow or undefined instruction\n");
    leave(99);
}

/* --- RAM ---------------------------------------------------------------------------------------------------------- */

static uint32_t bytes_between(const uint32_t *from, const uint32_t *to)
{
    return (uint32_t)((uintptr_t)to - (uintptr_t)from);
}

void port_ram_used(port_ram *out)
{
    const uint32_t *deepest = bss_end;
    while (deepest < ram_end && *deepest == STACK_PAINT)
        ++deepest;
    out->data = bytes_between(data_begin, data_end);
    out->bss = bytes_between(bss_begin, bss_end);
    out->stack = bytes_between(deepest, ram_end);
    out->size = bytes_between(ram_begin, ram_end);
}

/* Paints the stack up to the current stack pointer, so that port_ram_used can measure the depth. */
void bare_run(void)
{
    const uint32_t *image = data_image;
    uint32_t *to, *stack;
    for (to = data_begin; to < data_end;)
        *to++ = *image++;
    for (to = bss_begin; to < bss_end;)
        *to++ = 0;
    __asm__ volatile(STACK_POINTER : "=r"(stack));
    for (to = bss_end; to < stack;)
        *to++ = STACK_PAINT;
    leave((uint32_t)main());
}
