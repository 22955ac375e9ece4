# counted.mk: counts the room's cost on a console with a processor that qemu supports: make PORT=... count.
#
# The port sets COUNTED (its name in port_counted.c), COUNTED_ROWS (of a band), COUNTED_AT (address of code: equal to
# the console's modulo the cache size), COUNTED_SRC (the port's rows), COUNTED_QEMU and COUNTED_MODEL.
HOST_CC     ?= cc
COUNTED_OBJ := $(call object,$(ROOM_DEMO) platform/counted/port_counted.c $(COUNTED_SRC) $(PORT_SRC) $(ROOM_LIB))
$(B)/obj/platform/counted/port_counted.o: COMPILE += -fno-builtin -fno-tree-loop-distribute-patterns \
                -DCOUNTED_$(COUNTED) -DCOUNTED_ROWS=$(COUNTED_ROWS)
-include $(B)/obj/platform/counted/port_counted.d

$(B)/counted: $(COUNTED_OBJ)
	@echo "LD $@"
	@$(CC) $(FLAGS) -nostdlib -static -Wl,--build-id=none -Wl,--gc-sections -Wl,-z,noexecstack \
	    -Wl,--no-warn-rwx-segments -Wl,-Ttext=$(COUNTED_AT) -Wl,-e,_start $(LDFLAGS) -o $@ $^ $(PORT_LDLIBS)

$(B)/qemu_caches.so: platform/counted/qemu_caches.c platform/freestanding/qemu_interface.h
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(HOST_CC) -O2 -std=c99 -Wall -Wextra -pedantic -fPIC -shared -o $@ $<

.PHONY: count
count: $(B)/counted $(B)/qemu_caches.so
	@at=$$($(NM) $(B)/counted | awk '$$3 == "screen" { print $$1 }'); \
	$(COUNTED_QEMU) -plugin $(B)/qemu_caches.so,model=$(COUNTED_MODEL),screen=$$at,functions=$(or $(FUNCTIONS),off) \
	    -d plugin $(B)/counted
