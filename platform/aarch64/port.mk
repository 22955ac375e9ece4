# aarch64: a Cortex-A53 without operating system or libc, under qemu's `virt`; output by semihosting. Memory is as after
# reset, without MMU: unaligned access would be a fault. Debian's compiler for Linux will do: nothing of it is linked.
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
