/* start_cortex_a.c: a Cortex-A of 32 bits: vectors, reset, semihosting. Caches and MMU stay off. */
#include "../freestanding/bare.h"

/* Eight vectors; the first is reset. Enables NEON and VFP first (CPACR, FPEXC.EN, no flush to zero), because a compiler
 * may clear memory with their registers. Then sets the address of the vectors (VBAR). */
__asm__(".section .vectors, \"ax\"\n"
        ".arm\n"
        ".fpu neon\n"
        ".balign 32\n"
        ".globl reset\n"
        "vectors:\n"
        "reset:\n"
        "\tb start\n"
        "\tb fault\n"
        "\tb fault\n"
        "\tb fault\n"
        "\tb fault\n"
        "\tb fault\n"
        "\tb fault\n"
        "\tb fault\n"
        "start:\n"
        "\tldr sp, =ram_end\n"
        "\tmrc p15, 0, r0, c1, c0, 2\n"
        "\torr r0, r0, #0xf00000\n"
        "\tmcr p15, 0, r0, c1, c0, 2\n"
        "\tisb\n"
        "\tmov r0, #0x40000000\n"
        "\tvmsr fpexc, r0\n"
        "\tmov r0, #0\n"
        "\tvmsr fpscr, r0\n"
        "\tldr r0, =vectors\n"
        "\tmcr p15, 0, r0, c12, c0, 0\n"
        "\tldr r0, =bare_run\n"
        "\tblx r0\n"
        "fault:\n"
        "\tldr sp, =ram_end\n"
        "\tldr r0, =bare_fault\n"
        "\tblx r0\n"
        "\t.ltorg\n"
        ".text\n");

/* In ARM state; Thumb state has another number. */
__attribute__((target("arm"))) uintptr_t semihost(uint32_t operation, const void *argument)
{
    register uintptr_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("svc 0x123456" : "+r"(r0) : "r"(r1) : "memory", "lr");
    return r0;
}
