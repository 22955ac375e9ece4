/* begin_mips.S: included by start-ups of MIPS consoles: clears .bss, sets the stack up, and paints the stack to measure
 * its depth. Needs .set noreorder. */
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
    lui   $8, %hi(stack_end)
    addiu $8, $8, %lo(stack_end)
    lui   $9, 0x5a5a
    ori   $9, $9, 0xa5a5
2:  sw    $9, 0($8)
    addiu $8, $8, 4
    bne   $8, $29, 2b
    nop
    addiu $29, $29, -32
