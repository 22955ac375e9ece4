/* start_nds.c: a Nintendo DS's main processor: memory protection, caches, the memories beside it,
 * initialisation of RAM for C. */
#include "nds.h"

int main(void);
void start(void);

/* Regions of memory protection: base | (bits - 1) << 1 | 1, 2^bits bytes. Main memory is cached with buffered writes;
 * video memory has only buffered writes. */
__asm__(".section .vectors, \"ax\"\n"
        ".arm\n"
        ".globl reset\n"
        "reset:\n"
        "\tmrs r0, cpsr\n" /* system mode, no interrupts */
        "\tbic r0, r0, #0x1f\n"
        "\torr r0, r0, #0xdf\n"
        "\tmsr cpsr_c, r0\n"
        "\tldr r0, =0x2078\n" /* high vectors, everything else off */
        "\tmcr p15, 0, r0, c1, c0, 0\n"
        "\tmov r0, #0\n"
        "\tmcr p15, 0, r0, c7, c5, 0\n" /* invalidates the caches */
        "\tmcr p15, 0, r0, c7, c6, 0\n"
        "\tmcr p15, 0, r0, c7, c10, 4\n"
        "\tldr r0, =0x04000033\n" /* 0: registers and video memory, 64 MiB */
        "\tmcr p15, 0, r0, c6, c0, 0\n"
        "\tldr r0, =0x0200002b\n" /* 1: main memory, 4 MiB */
        "\tmcr p15, 0, r0, c6, c1, 0\n"
        "\tldr r0, =0x0300001b\n" /* 2: data beside the processor, 16 KiB */
        "\tmcr p15, 0, r0, c6, c2, 0\n"
        "\tldr r0, =0x0100001d\n" /* 3: instructions beside it, 32 KiB */
        "\tmcr p15, 0, r0, c6, c3, 0\n"
        "\tldr r0, =0xffff001f\n" /* 4: the BIOS, 64 KiB */
        "\tmcr p15, 0, r0, c6, c4, 0\n"
        "\tmov r0, #0\n"
        "\tmcr p15, 0, r0, c6, c5, 0\n"
        "\tmcr p15, 0, r0, c6, c6, 0\n"
        "\tmcr p15, 0, r0, c6, c7, 0\n"
        "\tldr r0, =0x0300000a\n" /* 16 KiB: 512 << 5 */
        "\tmcr p15, 0, r0, c9, c1, 0\n"
        "\tldr r0, =0x00000020\n" /* from 0 on, 32 MiB: the 32 KiB repeat */
        "\tmcr p15, 0, r0, c9, c1, 1\n"
        "\tmov r0, #0x12\n" /* cached: 1 and 4 */
        "\tmcr p15, 0, r0, c2, c0, 0\n"
        "\tmcr p15, 0, r0, c2, c0, 1\n"
        "\tmov r0, #0x03\n" /* writes are buffered: 0 and 1 */
        "\tmcr p15, 0, r0, c3, c0, 0\n"
        "\tldr r0, =0x33333\n" /* read and write access for all */
        "\tmcr p15, 0, r0, c5, c0, 2\n"
        "\tmcr p15, 0, r0, c5, c0, 3\n"
        "\tldr r0, =0x5307d\n" /* protection, both caches, both memories on */
        "\tmcr p15, 0, r0, c1, c0, 0\n"
        "without_protection:\n" /* qemu starts here, because it has no such memories */
        "\tldr sp, =stack_top\n"
        "\tldr r0, =start\n"
        "\tbx r0\n"
        "\t.pool\n"
        ".text\n");

void start(void)
{
    REGISTER_32(INTERRUPTS) = 0;
    copy_words(fast_begin, fast_end, fast_image);
    fill_words(near_begin, near_end, 0);
    fill_words(bss_begin, bss_end, 0);
    paint_stack();
    nds_begin();
    main();
    for (;;) {
    }
}
