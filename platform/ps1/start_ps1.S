/* start_ps1.S: the way into main of a PlayStation program; no BIOS call is made. */
    .set noreorder
    .set noat

    .section .start, "ax"
    .global start
start:
    mtc0  $0, $12               /* Status: no interrupts, no coprocessors */
    nop
    lui   $8, %hi(bss_begin)
    addiu $8, $8, %lo(bss_begin)
    lui   $9, %hi(bss_end)
    addiu $9, $9, %lo(bss_end)
1:  sw    $0, 0($8)
    addiu $8, $8, 4
    sltu  $10, $8, $9
    bnez  $10, 1b
    nop
    lui   $29, %hi(stack_top)
    addiu $29, $29, %lo(stack_top)
    lui   $8, %hi(stack_end)    /* the stack is painted, so that its depth can be told */
    addiu $8, $8, %lo(stack_end)
    lui   $9, 0x5a5a
    ori   $9, $9, 0xa5a5
2:  sw    $9, 0($8)
    addiu $8, $8, 4
    bne   $8, $29, 2b
    nop
    addiu $29, $29, -32
    jal   main
    nop
    jal   port_leave
    move  $4, $2
3:  b     3b
    nop
