# aarch64: a Cortex-A53 without operating system or libc, under qemu's `virt`; output by semihosting. The MMU is off, as
# after reset, so unaligned access faults. Debian's compiler for Linux works, because none of its libraries are linked.
AARCH64     ?= aarch64-linux-gnu-
CROSS_PREFIX := $(AARCH64)
include platform/freestanding/tools.mk

ROM_ORIGIN := 0x40100000
RAM_ORIGIN := 0x40800000
QEMU       := qemu-system-aarch64 -M virt -cpu cortex-a53 -nic none
include platform/freestanding/bare.mk
PORT_SRC     := platform/aarch64/start_aarch64.c $(BARE_SRC)
PORT_CFLAGS  := -mstrict-align -ffreestanding -fbuiltin -fno-pic -fno-pie -fno-stack-protector -mno-outline-atomics \
                -fno-asynchronous-unwind-tables $(BARE_CFLAGS)
