/* bios_ps1.S: our own replacement for the console's BIOS in an emulator of the PlayStation: sets up the bus and the
 * instruction cache, and jumps to the address of the emulator's loader.
 *
 * The loader is beetle-psx's. It replaces the BIOS' shell at 0xbfc06990, copies a program (PS-X EXE) to RAM and jumps
 * to its first instruction. */
    .set noreorder
    .set noat

    .section .text, "ax"
    .global bios
bios:
    lui   $8, 0x1f80            /* wait states as set by the console's ROM: expansion, ROM, RAM */
    li    $9, 0x1325
    sw    $9, 0x100c($8)
    lui   $9, 0x0013
    ori   $9, $9, 0x243f
    sw    $9, 0x1010($8)
    li    $9, 0xb88
    sw    $9, 0x1060($8)

/* Invalidates the instruction cache: while the cache is isolated, stores go to its tags, one
 * for each line of 16 bytes. */
    lui   $10, 0xfffe
    li    $9, 0x804
    sw    $9, 0x130($10)
    lui   $9, 0x0001
    mtc0  $9, $12
    nop
    nop
    li    $8, 0x1000
1:  addiu $8, $8, -16
    bnez  $8, 1b
    sw    $0, 0($8)
    mtc0  $0, $12
    nop
    nop
    lui   $9, 0x0001            /* instruction cache and scratchpad on */
    ori   $9, $9, 0xe988
    sw    $9, 0x130($10)

    lui   $8, 0xbfc0
    ori   $8, $8, 0x6990
    jr    $8
    nop

    .org 0x6990                 /* overwritten by the emulator; otherwise an endless loop */
2:  b     2b
    nop
    .org 0x7ffff
    .byte 0
