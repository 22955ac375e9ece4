/* start.c: a Cortex-M: vectors, reset, semihosting. */
#include "../freestanding/bare.h"

void reset(void);

uintptr_t semihost(uint32_t operation, const void *argument)
{
    register uintptr_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

/* Enables the FPU first, because a compiler may clear .bss with FPU registers. */
void reset(void)
{
#if defined(__ARM_FP)
    volatile uint32_t *cpacr = (volatile uint32_t *)0xe000ed88u;
    *cpacr |= 0xfu << 20;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
#endif
#if defined(__ARM_FEATURE_MVE)
    /* Helium: turns tail predication off (FPSCR.LTPSIZE = 4); otherwise instructions would skip lanes. */
    uint32_t fpscr;
    __asm__ volatile("vmrs %0, fpscr" : "=r"(fpscr));
    fpscr = (fpscr & ~(7u << 16)) | 4u << 16;
    __asm__ volatile("vmsr fpscr, %0" ::"r"(fpscr) : "memory");
#endif
    bare_run();
}

typedef void (*vector)(void);
__attribute__((section(".vectors"), used)) static const vector vectors[16] = {
    (vector)(uintptr_t)ram_end, reset, bare_fault, bare_fault, bare_fault, bare_fault, bare_fault, 0,
    0, 0, 0, bare_fault, bare_fault, 0, bare_fault, bare_fault};
