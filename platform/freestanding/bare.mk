# bare.mk: what ports without operating system under qemu share. Before it a port.mk sets QEMU, the emulator with its
# machine; ROM_ORIGIN, RAM_ORIGIN; ROM_BYTES and RAM_BYTES where they are not these.
BARE_SRC     := $(addprefix platform/freestanding/,bare.c floorf.c memory.c)
BARE_CFLAGS  := -ffunction-sections -fdata-sections -isystem platform/freestanding
ROM_BYTES    ?= 524288
RAM_BYTES    ?= 4194304
PORT_LDFLAGS  = -nostdlib -static -Wl,--gc-sections -Wl,--build-id=none -T platform/freestanding/bare.ld \
                -Wl,--defsym,rom_origin=$(ROM_ORIGIN) -Wl,--defsym,rom_bytes=$(ROM_BYTES) \
                -Wl,--defsym,ram_origin=$(RAM_ORIGIN) -Wl,--defsym,ram_bytes=$(RAM_BYTES)
PORT_LDLIBS  := -lgcc

# Output and the way out by semihosting. MORE: further words for qemu.
SEMIHOSTING   = enable=on,target=native,chardev=console
RUN           = $(QEMU) -display none -monitor none -serial none -chardev stdio,id=console $(MORE) \
                -semihosting-config $(SEMIHOSTING) -kernel

# A loop in memset that the compiler turns into a call of memset would never end.
$(B)/obj/platform/freestanding/memory.o: COMPILE += -fno-builtin -fno-tree-loop-distribute-patterns

# The room, counted exactly by a plugin of this machine's qemu: COUNTED=instructions, loads or stores. Its screen is
# read back to room.ppm; FRAMES=all puts all frames there, one behind the other. ROOM_RAM: what there is of RAM.
ROOM_SRC      = $(PORT_SRC) platform/freestanding/bare_room.c
ROOM_RAM     ?= 163840
ROOM_ROM     ?= 1048576
COUNTED      ?= instructions
COUNTER      := $(BUILD)/qemu_count.so
ROOM_RUN      = $(filter-out -kernel,$(RUN)) -plugin $(COUNTER),counts=$(B)/room.counts,what=$(COUNTED) -kernel
ROOM_WORDS    = arg=room,arg=$(B)/room.counts,arg=$(B)/room.ppm$(FRAMES:%=,arg=%)
run: SEMIHOSTING = enable=on,target=native,chardev=console,$(ROOM_WORDS)
$(B)/room: RAM_BYTES = $(ROOM_RAM)
$(B)/room: ROM_BYTES = $(ROOM_ROM)
$(B)/obj/platform/freestanding/bare_room.o: COMPILE += $(BARE_ROOM)

HOST_CC ?= cc
run: $(COUNTER)
$(COUNTER): platform/freestanding/qemu_count.c platform/freestanding/qemu_interface.h
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(HOST_CC) -std=c99 -O2 -Wall -Wextra -pedantic -fPIC -shared -o $@ $<
