# lrhost.mk: the program that runs libretro cores without a window, for ports that use such an emulator.
#   LRHOST         built for the host
#   $(call core_of,NAME)  Debian's path of the core NAME
LRHOST  := $(BUILD)/lrhost
HOST_CC ?= cc
core_of  = $(firstword $(wildcard /usr/lib/*/libretro/$(1)_libretro.so) $(1)_libretro.so)

$(LRHOST): platform/libretro/lrhost.c platform/libretro/text_block.h
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(HOST_CC) -O2 -std=c99 -Wall -Wextra -pedantic -o $@ $< -ldl

# qemu_stages.c, for ports of ARM processors.
STAGES  := $(BUILD)/qemu_stages.so
$(STAGES): platform/freestanding/qemu_stages.c platform/freestanding/qemu_interface.h
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(HOST_CC) -O2 -std=c99 -D_POSIX_C_SOURCE=200809L -Wall -Wextra -pedantic -shared -fPIC -o $@ $<
