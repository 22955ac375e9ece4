# gba: a Game Boy Advance (ARM7TDMI, no FPU, 32 KiB of fast and 256 KiB of slow RAM), without SDK, in mGBA by lrhost.
ARM         ?= arm-none-eabi-
CROSS_PREFIX := $(ARM)
include platform/freestanding/tools.mk
include platform/libretro/lrhost.mk

PORT_SRC     := platform/gba/start_gba.c platform/gba/port_gba.c platform/consoles/handheld.c platform/consoles/screen_16.c \
                platform/freestanding/memory.c platform/freestanding/floorf.c
PORT_CFLAGS  := -mcpu=arm7tdmi -mthumb -mthumb-interwork -ffreestanding -fbuiltin -ffunction-sections \
                -fdata-sections -isystem platform/freestanding
PORT_LDFLAGS := -nostdlib -nostartfiles -Wl,--gc-sections -Wl,--no-warn-rwx-segments -T platform/gba/gba.ld
PORT_LDLIBS  := -lgcc

# Code that gba.ld puts into fast RAM uses wide instructions; ROM, which has 16 bits, uses narrow ones.
HOT_OBJ := $(B)/obj/platform/demo/room.o $(foreach f,fixed fixed_fill fixed_light number,$(B)/obj/src/vertex/$(f).o)
$(HOT_OBJ): COMPILE += -marm -O2

# Without these flags the compiler would turn a loop in memset into a call of memset, which would never end; and at the
# start, memset is not in RAM yet.
$(B)/obj/platform/freestanding/memory.o: COMPILE += -marm
$(B)/obj/platform/freestanding/memory.o $(B)/obj/platform/gba/start_gba.o: COMPILE += \
    -fno-builtin -fno-tree-loop-distribute-patterns

ROOM_IMAGE   := $(B)/room.gba
# The program depends on the linker script.
$(B)/obj/platform/gba/start_gba.o: platform/gba/gba.ld
$(ROOM_IMAGE): $(B)/room $(LRHOST) $(STAGES)
	@$(CROSS_PREFIX)objcopy -O binary $< $@
ROOM_RUN      = B=$(B) LRHOST=$(LRHOST) CORE=$(call core_of,mgba) SCREEN='--bits 5 --frames 300' PRESS='$(PRESS)' \
                PLUGIN=$(STAGES) MODEL=arm7 BEGIN=reset CROSS=$(CROSS_PREFIX) WITHOUT='^nothing' \
                sh platform/libretro/run_room.sh

# Buttons, in the form of lrhost's --press.
PRESS        ?=
