# cortex-m: a Cortex-M without operating system or libc, under qemu; output by semihosting. CORE: m0plus without an FPU
# (on the Cortex-M3 of mps2-an385, which runs its instructions), m4f (mps2-an386), m7 (mps2-an500), m33 (mps2-an505),
# m55 with Helium (mps3-an547).
CORE        ?= m4f
# Cores for `make ports`.
ROOMS       := CORE=m0plus CORE=m4f CORE=m7 CORE=m33 CORE=m55
ARM         ?= arm-none-eabi-
CROSS_PREFIX := $(ARM)
include platform/freestanding/tools.mk

core_m0plus := -mcpu=cortex-m0plus -mfloat-abi=soft
core_m4f := -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard
core_m7  := -mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard
core_m33 := -mcpu=cortex-m33 -mfpu=fpv5-sp-d16 -mfloat-abi=hard
core_m55 := -mcpu=cortex-m55 -mfloat-abi=hard
board_m0plus := mps2-an385
board_m4f := mps2-an386
board_m7  := mps2-an500
board_m33 := mps2-an505
board_m55 := mps3-an547
ROM_ORIGIN := 0
RAM_ORIGIN := 0x20000000
ifeq ($(origin core_$(CORE)),undefined)
$(error CORE=$(CORE): there are `m0plus`, `m4f`, `m7`, `m33` and `m55`)
endif
ifeq ($(CORE),m33)
ROM_ORIGIN := 0x10000000
RAM_ORIGIN := 0x38000000
else ifeq ($(CORE),m55)
RAM_ORIGIN := 0x21000000
endif

# The room on an M0+: the picture, and 32 KiB for the rest. Light by pixel needs more, and draws one frame.
ifeq ($(CORE),m0plus)
ROOM_RAM     ?= $(if $(filter pixel,$(ROOM)),163840,71168)
PIXEL_FRAMES := 1
endif
# mps3-an547 has half a MiB of ROM, so light by pixel runs from DRAM.
ifeq ($(CORE)-$(ROOM),m55-pixel)
ROM_ORIGIN := 0x60000000
endif

BOARD        ?= $(board_$(CORE))
QEMU          = qemu-system-arm -M $(BOARD)
MORE          = $(COUNT)
include platform/freestanding/bare.mk
PORT_SRC     := platform/cortex-m/start.c $(BARE_SRC) $(if $(filter m0plus,$(CORE)),platform/freestanding/sqrtf.c)
PORT_CFLAGS  := $(core_$(CORE)) -mthumb $(BARE_CFLAGS)

# Limits: 256 KiB for the demo, 160 for live programs; the golden suite, built with the host's settings, may use more.
$(B)/demo: RAM_BYTES = 262144
$(addprefix $(B)/,live baked gouraud): RAM_BYTES = 163840
$(B)/bounced: RAM_BYTES = 327680
$(B)/baked $(B)/gouraud: ROM_BYTES = 1048576

# Every instruction takes 1 ns (count.h).
$(LIVE:%=run-%): COUNT := -icount shift=0
