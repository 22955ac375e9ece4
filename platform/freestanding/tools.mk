# tools.mk: programs of a cross toolchain, named by CROSS_PREFIX, and optimisation for size.
override CC := $(CROSS_PREFIX)gcc
override AR := $(CROSS_PREFIX)ar
override NM := $(CROSS_PREFIX)nm
override SIZE := $(CROSS_PREFIX)size
CFLAGS ?= -Os
