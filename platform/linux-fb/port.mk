# linux-fb: the room on /dev/fb0 of a Linux without a window system. The test draws into a file instead of the device.
PORT_SRC    := platform/host/port_host.c
PORT_LDLIBS := -lm
RUN         :=

ROOM_SRC    := platform/host/port_host.c platform/linux-fb/port_linux_fb.c
ROOM_RUN    := env $(if $(FB_DEVICE),FB_DEVICE=$(FB_DEVICE),FB_FILE=$(B)/room.fb)
