# host: the machine that compiles; libc and libm, programs run as they are.
PORT_SRC    := platform/host/port_host.c
PORT_LDLIBS := -lm -lpthread
RUN         :=

# The room at any size: ROOM_SIZE="240 160 16", width, height and rows of a band.
ROOM_SIZE ?= $(if $(filter pixel,$(ROOM)),160 120 8,320 240 16)
ROOM_SRC    := platform/host/port_host.c platform/host/port_room.c
ROOM_FLAGS  := -DROOM_WIDTH=$(word 1,$(ROOM_SIZE)) -DROOM_HEIGHT=$(word 2,$(ROOM_SIZE)) -DROOM_ROWS=$(word 3,$(ROOM_SIZE))
$(B)/obj/platform/host/port_room.o: COMPILE += $(ROOM_FLAGS)
