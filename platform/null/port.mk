# null: an empty port to copy. This list has all names that your port.mk may set; leave out those that you do not need.
#
# CC, AR, NM, SIZE: `override CC := PREFIX-gcc`; platform/freestanding/tools.mk sets them all from CROSS_PREFIX.
# PORT_SRC      start-up, output and the room's functions
# PORT_CFLAGS   the processor; -ffreestanding and -isystem platform/freestanding if there is no libc
# PORT_LDFLAGS  a linker script, -nostdlib
# PORT_LDLIBS   -lgcc without a libc, -lm with one
# RUN           the command in front of a program, such as an emulator. Empty: programs run here
# ROOM_IMAGE    the emulator's input if it is not $(B)/room, with a rule that makes it
PORT_SRC    := platform/$(PORT)/port_$(PORT).c
PORT_CFLAGS :=
PORT_LDFLAGS :=
PORT_LDLIBS :=
RUN         :=
