# tools.mk: the programs of a cross toolchain, CROSS_PREFIX and their names, and code for size.
override CC := $(CROSS_PREFIX)gcc
override AR := $(CROSS_PREFIX)ar
override NM := $(CROSS_PREFIX)nm
override SIZE := $(CROSS_PREFIX)size
CFLAGS ?= -Os
