/* start_n64.S: cartridge header, boot code, and entry of a Nintendo 64 program.
 *
 * The boot code replaces a cartridge's IPL3 and runs in the signal processor's data memory. It copies the program to
 * RDRAM. A real console needs an IPL3 that its lock-out chip accepts and that sets RDRAM up; emulators need neither. */
    .set noreorder
    .set noat

    .section .header, "ax"
    .word 0x80371240            /* timing of the cartridge bus */
    .word 0x0000000f            /* clock rate: the standard one */
    .word 0x80000400            /* entry of the program */
    .word 0x00001444            /* release */
    .word 0, 0, 0, 0            /* checksums: only commercial boot code checks them */
    .ascii "LAMBENT ROOM        "
    .word 0, 0
    .ascii "NLRE"               /* cartridge, two letters, North America */

/* --- boot code, at 0xa4000040: position-independent --------------------------------------------------------------- */
    lui   $8, 0xa460            /* peripheral interface: one transfer from the cartridge to RDRAM */
    li    $9, 0x400
    sw    $9, 0($8)
    lui   $9, 0x1000
    ori   $9, $9, 0x1000
    sw    $9, 4($8)
    lui   $9, %hi(image_last)
    addiu $9, $9, %lo(image_last)
    sw    $9, 12($8)
1:  lw    $9, 16($8)
    andi  $9, $9, 3
    bnez  $9, 1b
    nop

/* Caches have random contents after power-on: invalidates all lines. 16 KiB by 32 bytes, 8 KiB by 16 bytes. */
    mtc0  $0, $28
    mtc0  $0, $29
    lui   $8, 0x8000
    ori   $9, $8, 0x4000
2:  cache 0x08, 0($8)
    addiu $8, $8, 32
    bne   $8, $9, 2b
    nop
    lui   $8, 0x8000
    ori   $9, $8, 0x2000
3:  cache 0x09, 0($8)
    addiu $8, $8, 16
    bne   $8, $9, 3b
    nop
    mfc0  $8, $16               /* Config.K0 = 3: kseg0 is cached, written back */
    li    $9, ~7
    and   $8, $8, $9
    ori   $8, $8, 3
    mtc0  $8, $16
    nop
    nop
    lui   $8, %hi(start)
    addiu $8, $8, %lo(start)
    jr    $8
    nop

/* --- in RDRAM, cached --------------------------------------------------------------------------------------------- */
    .section .start, "ax"
    .global start
start:
#include "../consoles/begin_mips.S"
#if _MIPS_SIM == _ABIO32
    lui   $8, 0x2000            /* Status: the FPU is on, with registers in pairs; interrupts are off */
#else
    lui   $8, 0x2400            /* likewise, with 32 registers of 64 bits */
#endif
    mtc0  $8, $12
    nop
    nop
    ctc1  $0, $31               /* to nearest, no traps, no flush of denormals */
    lui   $8, 0xa000            /* installs the exception handler: a jump at the vector, written uncached */
    lui   $9, %hi(fault_jump)
    addiu $9, $9, %lo(fault_jump)
    lw    $10, 0($9)
    sw    $10, 0x180($8)
    lw    $10, 4($9)
    sw    $10, 0x184($8)
    lw    $10, 8($9)
    sw    $10, 0x188($8)
    sw    $0, 0x18c($8)
    jal   main
    nop
    jal   port_leave
    move  $4, $2
3:  b     3b
    nop

fault_jump:
    lui   $26, %hi(fault)
    addiu $26, $26, %lo(fault)
    jr    $26
fault:
    mfc0  $4, $13               /* Cause, address of the instruction, bad address */
    mfc0  $5, $14
    mfc0  $6, $8
    jal   n64_fault
    nop
4:  b     4b
    nop
