# gamecube: GameCube (PowerPC 750), without SDK; in dolphin-emu without a window.
POWERPC      ?= powerpc-linux-gnu-
CROSS_PREFIX := $(POWERPC)
# -O3 saves 0.2 million cycles a frame, most of them in showing the frame.
CFLAGS       ?= -O3
include platform/freestanding/tools.mk

PORT_SRC     := $(addprefix platform/freestanding/,memory.c floorf.c sqrtf.c)
PORT_CFLAGS  := -mcpu=750 -fno-pic -msdata=none -mno-altivec -ffreestanding -fbuiltin -fno-stack-protector \
                -ffunction-sections -fdata-sections -isystem platform/freestanding
PORT_LDFLAGS  = -nostdlib -static -Wl,--build-id=none -Wl,--gc-sections -Wl,-z,noexecstack \
                -Wl,--no-warn-rwx-segments -T platform/gamecube/gamecube.ld
PORT_LDLIBS  := -lgcc
RUN          := false
ENDIAN       := big

ROOM_SRC     := $(addprefix platform/gamecube/,port_gamecube.c row_gamecube.c) platform/consoles/ram_program.c $(PORT_SRC)
ROOM_IMAGE    = $(B)/room.dol
ROOM_RUN      = PRESS='$(PRESS)' NM=$(CROSS_PREFIX)nm sh platform/gamecube/run.sh $(B)

# Buttons, in the form of run.sh.
PRESS        ?=

$(B)/room.dol: $(B)/room
	@$(CROSS_PREFIX)objcopy -O binary -j .header -j .text $< $@

$(B)/room: platform/gamecube/start_gamecube.S
# Without these flags the compiler would turn a loop in memset into a call of memset, which would never end.
$(B)/obj/platform/freestanding/memory.o: COMPILE += -fno-builtin -fno-tree-loop-distribute-patterns

COUNTED       := GAMECUBE
COUNTED_ROWS  ?= 6
COUNTED_AT    := 0x10003100
COUNTED_SRC   := platform/gamecube/row_gamecube.c
COUNTED_QEMU  := qemu-ppc
COUNTED_MODEL := ppc750
