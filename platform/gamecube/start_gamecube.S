/* start_gamecube.S: entry of a GameCube program. The loader has set memory and address translation up. */
    .section .start, "ax"
    .globl start
start:
    mfmsr   3                   /* no interrupts; the FPU is on */
    rlwinm  3, 3, 0, 17, 15
    ori     3, 3, 0x2000
    mtmsr   3
    isync
    mfspr   3, 1008             /* HID0: both caches on */
    ori     3, 3, 0xc000
    mtspr   1008, 3
    isync
    lis     3, bss_begin@ha
    addi    3, 3, bss_begin@l
    lis     4, bss_end@ha
    addi    4, 4, bss_end@l
    li      0, 0
1:  stw     0, 0(3)
    addi    3, 3, 4
    cmplw   3, 4
    blt     1b
    lis     1, stack_top@ha
    addi    1, 1, stack_top@l
    lis     3, stack_end@ha     /* paints the stack, to measure its depth */
    addi    3, 3, stack_end@l
    lis     4, 0x5a5a
    ori     4, 4, 0xa5a5
2:  stw     4, 0(3)
    addi    3, 3, 4
    cmplw   3, 1
    blt     2b
    li      0, 0
    stwu    0, -32(1)
    bl      main
    bl      port_leave
3:  b       3b
