# n64: Nintendo 64 (VR4300), without SDK; in mupen64plus, with our own plugins for screen and controller.
MIPS         ?= mips-linux-gnu-
CROSS_PREFIX := $(MIPS)
CFLAGS       ?= -O2
include platform/freestanding/tools.mk

PORT_SRC     := $(addprefix platform/freestanding/,memory.c int64.c floorf.c)
# Light by pixel uses registers of 32 bits: with 64, mupen64plus' recompiler (but not qemu) reads past an array in the
# kernels. The interpreters (ROOM_MODE=0, 1) flush denormals to 0, which lmb_build_check refuses.
N64_ABI      := $(if $(filter pixel,$(ROOM)),-mabi=32 -mfp32,-mabi=n32)
PORT_CFLAGS  := -march=vr4300 $(N64_ABI) -mno-abicalls -fno-pic -G0 -mno-check-zero-division -ffreestanding \
                -fbuiltin -fno-stack-protector -ffunction-sections -fdata-sections -isystem platform/freestanding
PORT_LDFLAGS  = -nostdlib -static -Wl,--build-id=none -Wl,--gc-sections -Wl,-z,noexecstack \
                -Wl,--no-warn-rwx-segments -T platform/n64/n64.ld
PORT_LDLIBS  :=
RUN          := false
ENDIAN       := big

ROOM_SRC     := platform/n64/port_n64.c $(addprefix platform/consoles/,ram_program.c screen_16.c) $(PORT_SRC)
ROOM_IMAGE    = $(B)/room.z64
ROOM_RUN      = ROOM_PADS='$(PRESS)' ROOM_PICTURE=$(B)/room.ppm sh platform/n64/run.sh $(B)

# Buttons, in the form of pad_n64.c.
PRESS        ?=

# Pads the cartridge to whole MiB, because mupen64plus needs at least one.
$(B)/room.z64: $(B)/room $(B)/screen_n64.so $(B)/pad_n64.so
	@$(CROSS_PREFIX)objcopy -O binary -j .header -j .text $< $@
	@truncate -s %1M $@

HOST_CC      ?= cc
$(B)/%_n64.so: platform/n64/%_n64.c
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(HOST_CC) -std=c99 -O2 $(WARNINGS) -D_GNU_SOURCE -fPIC -shared -o $@ $< -ldl

$(B)/room: platform/n64/start_n64.S platform/consoles/begin_mips.S
# Without these flags the compiler would turn a loop in memset into a call of memset, which would never end.
$(B)/obj/platform/freestanding/memory.o: COMPILE += -fno-builtin -fno-tree-loop-distribute-patterns

COUNTED       := N64
COUNTED_ROWS  ?= 12
COUNTED_AT    := 0x400400
COUNTED_QEMU  := $(if $(filter pixel,$(ROOM)),qemu-mips,qemu-mipsn32)
COUNTED_MODEL := vr4300
