# web: WebAssembly without libc; programs run in node.
override CC := clang
CFLAGS      ?= -O2

PORT_SRC     := platform/web/start_web.c platform/freestanding/memory.c
PORT_CFLAGS  := --target=wasm32 -isystem platform/freestanding
PORT_LDFLAGS := -nostdlib -Wl,--no-entry -Wl,-z,stack-size=262144
PORT_LDLIBS  :=
RUN          := node platform/web/run.mjs

# Without this flag the compiler would turn a loop in memset into a call of memset, which would never end.
$(B)/obj/platform/freestanding/memory.o: COMPILE += -fno-builtin
include platform/web/page.mk
