# riscv: a RISC-V without operating system or libc, under qemu's `virt`; output by semihosting. XLEN: 32 with a
# single-precision FPU (RV32IMAFC), 64 with both precisions (RV64GC).
XLEN        ?= 32
ROOMS       := XLEN=32 XLEN=64
RISCV       ?= riscv64-unknown-elf-
CROSS_PREFIX := $(RISCV)
include platform/freestanding/tools.mk

isa_32 := -march=rv32imafc -mabi=ilp32f
isa_64 := -march=rv64gc -mabi=lp64d
ifeq ($(origin isa_$(XLEN)),undefined)
$(error XLEN=$(XLEN): there are `32` and `64`)
endif

ROM_ORIGIN := 0x80000000
RAM_ORIGIN := 0x80400000
QEMU       := qemu-system-riscv$(XLEN) -M virt -bios none
include platform/freestanding/bare.mk
PORT_SRC     := platform/riscv/start_riscv.c $(BARE_SRC)
PORT_CFLAGS  := $(isa_$(XLEN)) -mcmodel=medany -ffreestanding -fbuiltin $(BARE_CFLAGS)

# Limits: 256 KiB for the demo; the golden suite, built with the host's settings, may use more.
$(B)/demo: RAM_BYTES = 262144
$(B)/golden: ROM_BYTES = 1048576
$(B)/golden: RAM_BYTES = 8388608
