# cortex-a: a Cortex-A9 without operating system or libc, under qemu's `vexpress-a9`; output by semihosting. The MMU is
# off, as after reset, so unaligned access faults.
ARM         ?= arm-none-eabi-
CROSS_PREFIX := $(ARM)
include platform/freestanding/tools.mk

ROM_ORIGIN := 0x60010000
RAM_ORIGIN := 0x60400000
QEMU       := qemu-system-arm -M vexpress-a9 -nic none
include platform/freestanding/bare.mk
PORT_SRC     := platform/cortex-a/start_cortex_a.c $(BARE_SRC)
PORT_CFLAGS  := -mcpu=cortex-a9 -mfpu=neon -mfloat-abi=hard -marm -mno-unaligned-access -ffreestanding -fbuiltin \
                $(BARE_CFLAGS)
