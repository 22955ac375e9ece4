# bare.mk: shared by ports without operating system under qemu. Before you include it, set QEMU, the emulator with its
# machine; ROM_ORIGIN, RAM_ORIGIN; and ROM_BYTES and RAM_BYTES if they differ from these defaults.
BARE_SRC     := $(addprefix platform/freestanding/,bare.c floorf.c memory.c)
BARE_CFLAGS  := -ffunction-sections -fdata-sections -isystem platform/freestanding
ROM_BYTES    ?= 524288
RAM_BYTES    ?= 4194304
PORT_LDFLAGS  = -nostdlib -static -Wl,--gc-sections -Wl,--build-id=none -T platform/freestanding/bare.ld \
                -Wl,--defsym,rom_origin=$(ROM_ORIGIN) -Wl,--defsym,rom_bytes=$(ROM_BYTES) \
                -Wl,--defsym,ram_origin=$(RAM_ORIGIN) -Wl,--defsym,ram_bytes=$(RAM_BYTES)
PORT_LDLIBS  := -lgcc

# Output and exit by semihosting. MORE: further options for qemu.
SEMIHOSTING   = enable=on,target=native,chardev=console
RUN           = $(QEMU) -display none -monitor none -serial none -chardev stdio,id=console $(MORE) \
                -semihosting-config $(SEMIHOSTING) -kernel

# Without these flags the compiler would turn a loop in memset into a call of memset, which would never end.
$(B)/obj/platform/freestanding/memory.o: COMPILE += -fno-builtin -fno-tree-loop-distribute-patterns

# The room, counted exactly by a plugin of the host's qemu: COUNTED=instructions, loads or stores. The screen is read
# back to room.ppm; FRAMES=all writes all frames there, one behind the other. ROOM_RAM: size of RAM.
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
