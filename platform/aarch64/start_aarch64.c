/* start_aarch64.c: an AArch64 processor in EL1: vectors, reset, semihosting. Caches and MMU stay off. */
#include "../freestanding/bare.h"

/* Enables NEON first (CPACR_EL1.FPEN), because a compiler may clear memory with NEON registers. All sixteen vectors, of
 * 128 bytes each, are fault handlers. */
__asm__(".section .vectors, \"ax\"\n"
        ".globl reset\n"
        "reset:\n"
        "\tmov x0, #(3 << 20)\n"
        "\tmsr cpacr_el1, x0\n"
        "\tisb\n"
        "\tmsr fpcr, xzr\n"
        "\tadr x0, vectors\n"
        "\tmsr vbar_el1, x0\n"
        "\tisb\n"
        "\tldr x0, =ram_end\n"
        "\tmov sp, x0\n"
        "\tb bare_run\n"
        "fault:\n"
        "\tldr x0, =ram_end\n"
        "\tmov sp, x0\n"
        "\tb bare_fault\n"
        "\t.ltorg\n"
        ".balign 2048\n"
        "vectors:\n"
        ".rept 16\n"
        "\tb fault\n"
        "\t.balign 128\n"
        ".endr\n"
        ".text\n");

uintptr_t semihost(uint32_t operation, const void *argument)
{
    register uintptr_t x0 __asm__("x0") = operation;
    register const void *x1 __asm__("x1") = argument;
    __asm__ volatile("hlt #0xf000" : "+r"(x0) : "r"(x1) : "memory");
    return x0;
}
