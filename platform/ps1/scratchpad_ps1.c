/* scratchpad_ps1.c: the calls that draw have their stack in the 1 KiB of memory beside the processor, which
 * takes one cycle while RAM takes five. The linker replaces the calls (--wrap). They need at most 888 bytes;
 * none of them calls another. */
#if defined(__mips__)
#define ON_SCRATCHPAD(name)                      \
    ".globl __wrap_" name "\n"                   \
    ".ent __wrap_" name "\n"                     \
    "__wrap_" name ":\n"                         \
    "\tlui $8, 0x1f80\n"                         \
    "\tori $8, $8, 0x3e8\n"                      \
    "\tsw $29, 16($8)\n"                         \
    "\tsw $31, 20($8)\n"                         \
    "\tjal __real_" name "\n"                    \
    "\tmove $29, $8\n"                           \
    "\tlw $31, 20($29)\n"                        \
    "\tlw $29, 16($29)\n"                        \
    "\tjr $31\n"                                 \
    "\tnop\n"                                    \
    ".end __wrap_" name "\n"

__asm__(".text\n.set push\n.set noreorder\n" ON_SCRATCHPAD("lmb_fixed_band") ON_SCRATCHPAD("lmb_fixed_prepare")
            ON_SCRATCHPAD("lmb_fixed_transform") ".set pop\n");
#endif
