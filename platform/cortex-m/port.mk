# cortex-m: a Cortex-M with an FPU, without operating system or libc, under qemu; output by semihosting.
# CORE: m4f (mps2-an386), m7 (mps2-an500), m55 with Helium (mps3-an547).
CORE        ?= m4f
ARM         ?= arm-none-eabi-
CROSS_PREFIX := $(ARM)
include platform/freestanding/tools.mk

core_m4f := -mcpu=cortex-m4 -mfpu=fpv4-sp-d16
core_m7  := -mcpu=cortex-m7 -mfpu=fpv5-d16
core_m55 := -mcpu=cortex-m55
ram_m4f := 0x20000000
ram_m7  := 0x20000000
ram_m55 := 0x21000000
board_m4f := mps2-an386
board_m7  := mps2-an500
board_m55 := mps3-an547
ifeq ($(origin core_$(CORE)),undefined)
$(error CORE=$(CORE): there are `m4f`, `m7` and `m55`)
endif

PORT_SRC     := platform/cortex-m/start.c $(addprefix platform/freestanding/,bare.c floorf.c memory.c)
PORT_CFLAGS  := $(core_$(CORE)) -mthumb -mfloat-abi=hard -ffunction-sections -fdata-sections \
                -isystem platform/freestanding
PORT_LDFLAGS  = -nostdlib -Wl,--gc-sections -T platform/freestanding/bare.ld -Wl,--defsym,rom_origin=0 \
                -Wl,--defsym,ram_origin=$(ram_$(CORE)) -Wl,--defsym,ram_bytes=$(RAM_BYTES) \
                 -Wl,--defsym,rom_bytes=$(ROM_BYTES)
PORT_LDLIBS  := -lgcc
BOARD        ?= $(board_$(CORE))
RUN           = qemu-system-arm -M $(BOARD) -display none -monitor none -serial none -chardev stdio,id=console $(COUNT) \
                -semihosting-config enable=on,target=native,chardev=console -kernel

# The demo must do with 256 KiB, what is live with 160; the golden suite, built like the host's, takes what it takes.
RAM_BYTES     = 4194304
ROM_BYTES     = 524288
$(B)/demo: RAM_BYTES = 262144
$(addprefix $(B)/,live baked gouraud): RAM_BYTES = 163840
$(B)/baked $(B)/gouraud: ROM_BYTES = 1048576

# Every instruction takes 1 ns (count.h).
$(LIVE:%=run-%): COUNT := -icount shift=0

# A loop in memset that the compiler turns into a call of memset would never end.
$(B)/obj/platform/freestanding/memory.o: COMPILE += -fno-builtin -fno-tree-loop-distribute-patterns
