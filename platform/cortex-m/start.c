/* start.c: a Cortex-M4F from reset to main and out again: vectors, FPU, RAM, semihosting, and floorf. */
#include "../port.h"

enum { STACK_PAINT = 0x5a5aa5a5 };

/* Addresses from m4f.ld. */
extern uint32_t data_image[], data_begin[], data_end[], bss_begin[], bss_end[], ram_begin[], ram_end[];

int main(void);
void reset(void);
void fault(void);
float floorf(float x);

/* --- semihosting: a breakpoint that the debugger, or qemu, answers ------------------------------------------------ */

enum { SYS_WRITE0 = 0x04, SYS_EXIT_EXTENDED = 0x20, STOPPED_BY_APPLICATION = 0x20026 };

static void semihost(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void port_put(const char *text) { semihost(SYS_WRITE0, text); }

static void leave(uint32_t status)
{
    uint32_t block[2] = {STOPPED_BY_APPLICATION, 0};
    block[1] = status;
    for (;;)
        semihost(SYS_EXIT_EXTENDED, block);
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

/* --- start -------------------------------------------------------------------------------------------------------- */

/* The FPU comes first: a compiler may clear .bss with its registers. The stack is painted up to where it stands now,
 * so that port_ram_used can find how deep it went. */
void reset(void)
{
    volatile uint32_t *cpacr = (volatile uint32_t *)0xe000ed88u;
    const uint32_t *image = data_image;
    uint32_t *to, *stack;
    *cpacr |= 0xfu << 20;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
    for (to = data_begin; to < data_end;)
        *to++ = *image++;
    for (to = bss_begin; to < bss_end;)
        *to++ = 0;
    __asm__ volatile("mov %0, sp" : "=r"(stack));
    for (to = bss_end; to < stack;)
        *to++ = STACK_PAINT;
    leave((uint32_t)main());
}

void fault(void)
{
    port_put("fault: bad access, stack overflow or undefined instruction\n");
    leave(99);
}

typedef void (*vector)(void);
__attribute__((section(".vectors"), used)) static const vector vectors[16] = {
    (vector)(uintptr_t)ram_end, reset, fault, fault, fault, fault, fault, 0, 0, 0, 0, fault, fault, 0, fault, fault};

/* The M4's FPU has a square root but no rounding to integers. From 2^23 on a float is whole; NaN goes through. */
float floorf(float x)
{
    float whole;
    if (!(x > -8388608.0f && x < 8388608.0f))
        return x;
    whole = (float)(int32_t)x;
    return whole == x ? x : whole < x ? whole : whole - 1.0f;
}
