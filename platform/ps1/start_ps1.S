/* start_ps1.S: entry of a PlayStation program; makes no BIOS call. */
    .set noreorder
    .set noat

    .section .start, "ax"
    .global start
start:
    mtc0  $0, $12               /* Status: no interrupts, no coprocessors */
    nop
#include "../consoles/begin_mips.S"
    jal   main
    nop
    jal   port_leave
    move  $4, $2
3:  b     3b
    nop
