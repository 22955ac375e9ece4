/* start_gba.c: a Game Boy Advance cartridge: header, stacks, initialisation of RAM for C,
 * main; then an endless loop. */
#include "gba.h"

int main(void);
void start(void);

/* The header lacks the logo that the BIOS checks; emulators and development cartridges start without it. The byte at
 * 0xbd makes the sum of 0xa0 .. 0xbd, plus 0x19, a multiple of 256. */
__asm__(".section .vectors, \"ax\"\n"
        ".arm\n"
        ".globl reset\n"
        "reset:\n"
        "\tb 1f\n"
        "\t.space 0xa0 - 4\n"
        "\t.ascii \"LAMBENT ROOM\"\n" /* title */
        "\t.ascii \"LMBE00\"\n"       /* the program's and the maker's code */
        "\t.byte 0x96\n"
        "\t.space 0xbd - 0xb3\n"
        "\t.byte -(0x19 + 'L' + 'A' + 'M' + 'B' + 'E' + 'N' + 'T' + ' ' + 'R' + 'O' + 'O' + 'M' + 'L' + 'M' + 'B' + 'E'"
        " + '0' + '0' + 0x96) & 0xff\n"
        "\t.space 2\n"
        "1:\tldr r0, =0x04000208\n" /* no interrupts */
        "\tmov r1, #0\n"
        "\tstr r1, [r0]\n"
        "\tmov r0, #0x1f\n" /* system mode */
        "\tmsr cpsr_c, r0\n"
        "\tldr sp, =stack_top\n"
        "\tldr r0, =start\n"
        "\tbx r0\n"
        "\t.pool\n"
        ".text\n");

void start(void)
{
    REGISTER_16(WAIT_CONTROL) = 0x4317; /* ROM: 3 wait states, then 1 a halfword, read ahead */
    copy_words(fast_begin, fast_end, fast_image);
    copy_words(data_begin, data_end, data_image);
    copy_words(ewram_begin, ewram_end, ewram_image);
    fill_words(bss_begin, bss_end, 0);
    paint_stack();
    gba_begin();
    main();
    for (;;) {
    }
}
