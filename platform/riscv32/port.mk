# riscv32: a 32-bit RISC-V with a single-precision FPU (RV32IMAFC), without operating system or libc, under qemu's
# `virt`; output by semihosting.
RISCV       ?= riscv64-unknown-elf-
CROSS_PREFIX := $(RISCV)
include platform/freestanding/tools.mk

PORT_SRC     := platform/riscv32/start_riscv32.c $(addprefix platform/freestanding/,bare.c floorf.c memory.c)
PORT_CFLAGS  := -march=rv32imafc -mabi=ilp32f -mcmodel=medany -ffreestanding -fbuiltin -ffunction-sections \
                -fdata-sections -isystem platform/freestanding
PORT_LDFLAGS  = -nostdlib -Wl,--gc-sections -T platform/freestanding/bare.ld -Wl,--defsym,rom_origin=0x80000000 \
                -Wl,--defsym,ram_origin=0x80100000 -Wl,--defsym,ram_bytes=$(RAM_BYTES)
PORT_LDLIBS  := -lgcc
RUN          := qemu-system-riscv32 -M virt -bios none -display none -monitor none -serial none \
                -chardev stdio,id=console -semihosting-config enable=on,target=native,chardev=console -kernel

# The demo must do with 256 KiB; the golden suite, built like the host's, takes what it takes.
RAM_BYTES     = 4194304
$(B)/demo: RAM_BYTES = 262144

# A loop in memset that the compiler turns into a call of memset would never end.
$(B)/obj/platform/freestanding/memory.o: COMPILE += -fno-builtin -fno-tree-loop-distribute-patterns
