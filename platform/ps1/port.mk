# ps1: PlayStation (R3000A, no FPU), without SDK and BIOS; in beetle-psx, by our own libretro host.
MIPSEL       ?= mipsel-linux-gnu-
CROSS_PREFIX := $(MIPSEL)
CFLAGS       ?= -O2
include platform/freestanding/tools.mk

PORT_SRC     := $(addprefix platform/freestanding/,memory.c int64.c floorf.c)
PORT_CFLAGS  := -march=r3000 -mabi=32 -msoft-float -mno-abicalls -fno-pic -G0 -mno-check-zero-division -ffreestanding \
                -fbuiltin -fno-stack-protector -ffunction-sections -fdata-sections -isystem platform/freestanding
PORT_LDFLAGS  = -nostdlib -static -Wl,--build-id=none -Wl,--gc-sections -Wl,-z,noexecstack \
                -Wl,--no-warn-rwx-segments -T platform/ps1/ps1.ld
PORT_LDLIBS  :=
# Calls that scratchpad_ps1.c runs on another stack.
ON_SCRATCHPAD := $(foreach f,band prepare transform,-Wl,--wrap=lmb_fixed_$(f))
RUN          := false

ROOM_SRC     := $(addprefix platform/ps1/,port_ps1.c scratchpad_ps1.c) $(addprefix platform/consoles/,ram_program.c screen_16.c) $(PORT_SRC)
ROOM_IMAGE    = $(B)/room.exe
ROOM_RUN      = PRESS='$(PRESS)' ROOM_PICTURE=$(B)/room.ppm sh platform/ps1/run.sh $(B) $(LRHOST) $(call core_of,mednafen_psx)

$(B)/room: LDFLAGS += $(ON_SCRATCHPAD)

include platform/libretro/lrhost.mk

# Buttons, in the form of lrhost's --press.
PRESS        ?=

$(B)/room.exe: $(B)/room $(B)/bios.bin $(LRHOST)
	@$(CROSS_PREFIX)objcopy -O binary -j .header -j .text $< $@

$(B)/bios.bin: platform/ps1/bios_ps1.S
	@mkdir -p $(@D)
	@$(CC) -march=r3000 -mabi=32 -mfp32 -mno-abicalls -fno-pic -nostdlib -static -Wl,--build-id=none \
	    -Wl,-Ttext=0xbfc00000 \
	    -Wl,-e,bios -o $(B)/bios $<
	@$(CROSS_PREFIX)objcopy -O binary -j .text $(B)/bios $@
	@truncate -s 512K $@

$(B)/room: platform/ps1/start_ps1.S platform/consoles/begin_mips.S
# Without these flags the compiler would turn a loop in memset into a call of memset, which would never end.
$(B)/obj/platform/freestanding/memory.o: COMPILE += -fno-builtin -fno-tree-loop-distribute-patterns

COUNTED       := PS1
COUNTED_ROWS  ?= 240
COUNTED_AT    := 0x410000
COUNTED_QEMU  := qemu-mipsel
COUNTED_MODEL := r3000
COUNTED_SRC   := platform/ps1/scratchpad_ps1.c
$(B)/counted: LDFLAGS += $(ON_SCRATCHPAD) -Wl,-u,counted_scratchpad,--section-start=.scratchpad=0x1f800000 \
    -Wl,-T,platform/ps1/counted_ps1.ld
