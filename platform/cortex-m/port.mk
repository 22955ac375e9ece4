# cortex-m: a Cortex-M4F without operating system or libc, under qemu's mps2-an386; output by semihosting.
ARM         ?= arm-none-eabi-
override CC := $(ARM)gcc
override AR := $(ARM)ar
override NM := $(ARM)nm
override SIZE := $(ARM)size
CFLAGS      ?= -Os

PORT_SRC     := platform/cortex-m/start.c platform/freestanding/memory.c
PORT_CFLAGS  := -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -ffunction-sections -fdata-sections \
                -isystem platform/freestanding
PORT_LDFLAGS  = -nostdlib -Wl,--gc-sections -Wl,--defsym,ram_bytes=$(RAM_BYTES) -T platform/cortex-m/m4f.ld
PORT_LDLIBS  := -lgcc
RUN          := qemu-system-arm -M mps2-an386 -display none -monitor none -serial none -chardev stdio,id=console \
                -semihosting-config enable=on,target=native,chardev=console -kernel

# The demo must do with 256 KiB; the golden suite, built like the host's, takes what it takes.
RAM_BYTES     = 4194304
$(B)/demo: RAM_BYTES = 262144

# A loop in memset that the compiler turns into a call of memset would never end.
$(B)/obj/platform/freestanding/memory.o: COMPILE += -fno-builtin -fno-tree-loop-distribute-patterns
