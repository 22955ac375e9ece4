# nds: a Nintendo DS (ARM946E-S, no FPU, 4 MiB, caches, 32 + 16 KiB beside the processor), without
# SDK, in DeSmuME by lrhost.
ARM         ?= arm-none-eabi-
CROSS_PREFIX := $(ARM)
include platform/freestanding/tools.mk
include platform/libretro/lrhost.mk

PORT_SRC     := platform/nds/start_nds.c platform/nds/port_nds.c platform/consoles/handheld.c platform/consoles/screen_16.c \
                platform/freestanding/memory.c platform/freestanding/floorf.c
PORT_CFLAGS  := -mcpu=arm946e-s -marm -ffreestanding -fbuiltin -ffunction-sections -fdata-sections \
                -isystem platform/freestanding
PORT_LDFLAGS := -nostdlib -nostartfiles -Wl,--gc-sections -Wl,--no-warn-rwx-segments -T platform/nds/nds.ld
PORT_LDLIBS  := -lgcc

# Optimises hot code for speed.
HOT_OBJ := $(B)/obj/platform/demo/room.o $(foreach f,fixed fixed_fill fixed_light number,$(B)/obj/src/vertex/$(f).o)
$(HOT_OBJ): COMPILE += -O2

# Without these flags the compiler would turn a loop in memset into a call of memset, which would never end; and at the
# start, memset is not in RAM yet.
$(B)/obj/platform/freestanding/memory.o $(B)/obj/platform/nds/start_nds.o: COMPILE += \
    -fno-builtin -fno-tree-loop-distribute-patterns

# The program depends on the linker script.
$(B)/obj/platform/nds/start_nds.o: platform/nds/nds.ld

ROOM_IMAGE   := $(B)/room.nds
$(ROOM_IMAGE): $(B)/room $(BUILD)/nds_image $(LRHOST) $(STAGES)
	@$(CROSS_PREFIX)objcopy -O binary $< $(B)/room.bin
	@$(BUILD)/nds_image $(B)/room.bin $@
$(BUILD)/nds_image: platform/nds/nds_image.c
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(HOST_CC) -O2 -std=c99 -Wall -Wextra -pedantic -o $@ $<
SCREEN       := --bits 5 --crop 256x192+0+0 --option desmume_cpu_mode=interpreter --frames 120
ROOM_RUN      = B=$(B) LRHOST=$(LRHOST) CORE=$(call core_of,desmume) SCREEN='$(SCREEN)' PRESS='$(PRESS)' \
                PLUGIN=$(STAGES) MODEL=arm9 BEGIN=without_protection CROSS=$(CROSS_PREFIX) WITHOUT='^cost' \
                sh platform/libretro/run_room.sh

# Buttons, in the form of lrhost's --press.
PRESS        ?=
