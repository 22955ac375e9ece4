# host: the machine that compiles; libc and libm, programs run as they are.
PORT_SRC    := platform/host/port_host.c
PORT_LDLIBS := -lm -lpthread
RUN         :=
