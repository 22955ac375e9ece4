# targets.mk: the targets that draw the golden pictures: CROSS_TARGETS in `make cross`, and MORE_CROSS_TARGETS too in
# `make cross-all`.
#
#   needs_NAME  required commands; tools.sh has their packages
#   how_NAME    variables for make: the compiler, its flags, and RUN, the command that runs the target's programs
#   goal_NAME   the make target, if it is not `golden`
#
# EACH=N: the emulated targets of CROSS_TARGETS draw every Nth golden picture, and start with different ones.

CROSS_TARGETS      := gcc clang aarch64 mips cortex-m4f riscv32 web web-simd
LEVELS        := O0 O1 O2 O3 Os
some = GOLDENS="$(EACH:%=-DGOLDEN_EACH=% -DGOLDEN_FROM=$(1))"
MORE_CROSS_TARGETS := $(filter-out gcc-O2,$(LEVELS:%=gcc-%)) gcc-native $(LEVELS:%=clang-%) tcc \
                 i386 clang-i386 windows clang-windows clang-msvc clang-aarch64 armhf clang-armhf armel mipsel clang-mips \
                 powerpc ppc64 ppc64le clang-ppc64le riscv64 clang-riscv64 s390x clang-s390x sparc64 m68k hppa cortex-m7 \
                 cortex-m55 neon bytes-i386

# --- this machine: compilers, and levels of optimisation --------------------------------------------------------------

# `make cross` compiles with gcc -O2, and with clang for the processor of this machine.
needs_gcc        := gcc
how_gcc          := CC=gcc
needs_clang      := clang
how_clang        := CC=clang CFLAGS="-O3 -march=native"
needs_gcc-native := gcc
how_gcc-native   := CC=gcc CFLAGS="-O3 -march=native"
define level
needs_$(1)-$(2) := $(1)
how_$(1)-$(2)   := CC=$(1) CFLAGS=-$(2)
endef
$(foreach c,gcc clang,$(foreach l,$(LEVELS),$(eval $(call level,$(c),$(l)))))

# tcc 0.9.27 miscompiles, which lmb_build_check detects (src/base/exact.c): a refused build counts as skipped.
needs_tcc   := tcc
how_tcc     := CC=tcc DEPS= RUN="sh tests/scripts/may_refuse.sh"

i386            := -m32 -msse2 -mfpmath=sse -I/usr/include/x86_64-linux-gnu
# In qemu, because a 64-bit kernel may not support 32-bit programs.
needs_i386       := gcc gcc-m32 qemu-i386
how_i386         := CC="gcc $(i386)" RUN=qemu-i386
# Size computations with a 32-bit size_t.
needs_bytes-i386 := $(needs_i386)
how_bytes-i386   := $(how_i386) TEST_SRC=tests/unit/test_bytes.c
goal_bytes-i386  := unit
needs_clang-i386 := clang gcc-m32 qemu-i386
how_clang-i386   := CC="clang $(i386)" RUN=qemu-i386

# --- Windows ----------------------------------------------------------------------------------------------------------

wine                := EXE=.exe RUN="env WINEDEBUG=-all sh tests/scripts/wine.sh"
needs_windows       := x86_64-w64-mingw32-gcc wine64
how_windows         := CC=x86_64-w64-mingw32-gcc $(wine) LDFLAGS=-static
# clang does not search the folder of Debian's libgcc.
needs_clang-windows := clang x86_64-w64-mingw32-gcc wine64
how_clang-windows    = CC="clang --target=x86_64-w64-windows-gnu" $(wine) \
    LDFLAGS="-static -L$(dir $(shell x86_64-w64-mingw32-gcc -print-libgcc-file-name))"
# Microsoft's ABI and language, without its headers: the library compiles.
needs_clang-msvc    := clang
how_clang-msvc      := CC="clang --target=x86_64-pc-windows-msvc -ffreestanding -isystem platform/freestanding -Werror"
goal_clang-msvc     := compiles

# --- Linux programs in qemu's user mode -------------------------------------------------------------------------------

# linux NAME TRIPLET QEMU [MORE]: gcc;  clang_linux: clang with the libraries of that gcc.
define linux
needs_$(1) := $(2)-gcc $(3)
how_$(1)   := CC=$(2)-gcc LDFLAGS=-static RUN=$(3) $(4)
endef
define clang_linux
needs_clang-$(1) := clang $(2)-gcc $(3)
how_clang-$(1)   := CC="clang --target=$(2)" LDFLAGS=-static RUN=$(3) $(4)
endef
$(eval $(call linux,aarch64,aarch64-linux-gnu,qemu-aarch64,$(call some,0)))
$(eval $(call linux,armhf,arm-linux-gnueabihf,qemu-arm))
$(eval $(call linux,armel,arm-linux-gnueabi,qemu-arm))
$(eval $(call linux,mips,mips-linux-gnu,qemu-mips,$(call some,1)))
$(eval $(call linux,mipsel,mipsel-linux-gnu,qemu-mipsel))
$(eval $(call linux,powerpc,powerpc-linux-gnu,qemu-ppc))
$(eval $(call linux,ppc64,powerpc64-linux-gnu,qemu-ppc64))
$(eval $(call linux,ppc64le,powerpc64le-linux-gnu,qemu-ppc64le))
$(eval $(call linux,hppa,hppa-linux-gnu,qemu-hppa))
# gcc 12 has an internal error when it splits a struct of eight floats that is passed to a function.
$(eval $(call linux,sparc64,sparc64-linux-gnu,qemu-sparc64,CFLAGS="-O2 -fno-ipa-sra"))
# The 68881 of a 68020 computes float with excess precision, which exact.h refuses; the 68040 rounds each result.
needs_m68k := m68k-linux-gnu-gcc qemu-m68k
how_m68k   := CC="m68k-linux-gnu-gcc -m68040" LDFLAGS=-static RUN=qemu-m68k
$(eval $(call linux,riscv64,riscv64-linux-gnu,qemu-riscv64))
# Every AArch64 kernel against plain C. (gcc 12 for AArch64 fails on another module's tests.)
needs_neon := $(needs_aarch64)
how_neon   := $(how_aarch64) TEST_SRC="$(wildcard tests/lanes/test_*.c)"
goal_neon  := lanes
# For s390x, gcc -std=c99 computes float as double.
$(eval $(call linux,s390x,s390x-linux-gnu,qemu-s390x,STD=gnu99))
$(eval $(call clang_linux,aarch64,aarch64-linux-gnu,qemu-aarch64))
$(eval $(call clang_linux,armhf,arm-linux-gnueabihf,qemu-arm))
$(eval $(call clang_linux,ppc64le,powerpc64le-linux-gnu,qemu-ppc64le))
$(eval $(call clang_linux,s390x,s390x-linux-gnu,qemu-s390x,STD=gnu99))
# clang 14 reverses the signs of edge functions, which lmb_build_check detects.
needs_clang-mips := clang $(needs_mips)
how_clang-mips   := CC="clang --target=mips-linux-gnu" LDFLAGS=-static RUN="sh tests/scripts/may_refuse.sh qemu-mips"
# clang does not search Debian's folders of headers and start-up files.
rv64_lib            = $(dir $(shell riscv64-linux-gnu-gcc -print-libgcc-file-name)) /usr/riscv64-linux-gnu/lib
needs_clang-riscv64 := clang $(needs_riscv64)
how_clang-riscv64    = CC="clang --target=riscv64-linux-gnu -isystem /usr/riscv64-linux-gnu/include" RUN=qemu-riscv64 \
    LDFLAGS="-static $(foreach d,$(rv64_lib),-B$(d) -L$(d))"

# --- no operating system ----------------------------------------------------------------------------------------------

needs_cortex-m4f := arm-none-eabi-gcc qemu-system-arm
# The same build as `make tiny`. cortex-m7 and m55 have the default configuration.
how_cortex-m4f   := PORT=cortex-m CONFIG=tiny CFLAGS=-Os LDFLAGS= $(call some,2)
needs_cortex-m7  := $(needs_cortex-m4f)
how_cortex-m7    := PORT=cortex-m CORE=m7
needs_cortex-m55 := $(needs_cortex-m4f)
# gcc uses Helium at -O3; the flags keep the suite within 512 KiB of ROM. At -O2 the assembler refuses an instruction
# that gcc emits.
how_cortex-m55   := PORT=cortex-m CORE=m55 CFLAGS="-O3 -fno-ipa-cp-clone -fno-unswitch-loops -fno-peel-loops --param max-inline-insns-auto=15"
needs_riscv32    := riscv64-unknown-elf-gcc qemu-system-riscv32
how_riscv32      := PORT=riscv CFLAGS=-O2 $(call some,0)

needs_web        := clang wasm-ld node
how_web          := PORT=web
needs_web-simd   := $(needs_web)
how_web-simd     := PORT=web CFLAGS="-O2 -msimd128"
