# null: nothing, to copy. It says what a port.mk may name; what is not needed stays away.
#
# CC, AR, NM, SIZE: `override CC := PREFIX-gcc`; platform/freestanding/tools.mk sets them all from CROSS_PREFIX.
# PORT_SRC      start-up, output and the room's functions
# PORT_CFLAGS   the processor; -ffreestanding and -isystem platform/freestanding where there is no libc
# PORT_LDFLAGS  a linker script, -nostdlib
# PORT_LDLIBS   -lgcc without a libc, -lm with one
# RUN           what runs a program that stands behind it: an emulator. Empty: it runs here
# ROOM_IMAGE    what the emulator takes, where that is not $(B)/room, with a rule that makes it
PORT_SRC    := platform/$(PORT)/port_$(PORT).c
PORT_CFLAGS :=
PORT_LDFLAGS :=
PORT_LDLIBS :=
RUN         :=
