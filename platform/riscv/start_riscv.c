/* start_riscv.c: a RISC-V hart of 32 or 64 bits in machine mode: reset, semihosting. */
#include "../freestanding/bare.h"

void fault(void);

/* mstatus.FS = 3: enables the float registers. */
__asm__(".section .vectors, \"ax\"\n"
        ".globl reset\n"
        "reset:\n"
        "\tlla sp, ram_end\n"
        "\tli t0, 0x6000\n"
        "\tcsrs mstatus, t0\n"
        "\tcsrw fcsr, zero\n"
        "\tlla t0, fault\n"
        "\tcsrw mtvec, t0\n"
        "\tj bare_run\n"
        ".text\n");

/* mtvec holds an address aligned to 4. */
__attribute__((aligned(4), used)) void fault(void) { bare_fault(); }

/* The call must be three instructions of four bytes each, in one page. */
uintptr_t semihost(uint32_t operation, const void *argument)
{
    register uintptr_t a0 __asm__("a0") = operation;
    register const void *a1 __asm__("a1") = argument;
    __asm__ volatile(".option push\n\t.option norvc\n\t.balign 16\n\t"
                     "slli x0, x0, 0x1f\n\tebreak\n\tsrai x0, x0, 7\n\t.option pop"
                     : "+r"(a0)
                     : "r"(a1)
                     : "memory");
    return a0;
}
