# Builds the library for OpenGL 1.x programs: make gl, make gl-check, make gl-cross.

GL_OUT     := $(BUILD)/gl
GL_SRC     := $(sort $(wildcard platform/gl/gl_*.c))
# The modules that draw.h, its kernels and bounced light need.
GL_LIB     := $(filter-out $(addprefix src/base/,motion.c pack.c records.c),\
    $(foreach folder,base draw isa raster direct bounce occlusion live tree,$(wildcard src/$(folder)/*.c)))
GL_OBJ     := $(patsubst %.c,$(GL_OUT)/obj/%.o,$(GL_SRC) $(GL_LIB))
GL_NAMES   := $(addprefix $(GL_OUT)/,libOSMesa.so.8 libOSMesa.so libOpenGL.so.0 libGL.so.1)
GL_COMPILE  = $(CC) -std=c99 $(CFLAGS) $(GL_MORE) -fPIC $(WARNINGS) -ffp-contract=off -fno-math-errno -fno-builtin-bcmp -Iinclude \
    -Iplatform/gl/include -MMD -MP

gl: $(GL_NAMES) $(GL_OUT)/libGL.a ## OpenGL 1.x in memory: build/gl/libOSMesa.so.8, libOpenGL.so.0, libGL.so.1, libGL.a (platform/gl)

# Gears takes a sixth less time if more of a draw's calls are inlined, and the loops of kernels unrolled.
$(GL_OUT)/obj/src/draw/%.o $(GL_OUT)/obj/src/isa/%.o $(GL_OUT)/obj/platform/gl/gl_wide_%.o \
    $(addprefix $(GL_OUT)/obj/platform/gl/,gl_fragment.o gl_light.o): GL_MORE := $(if $(filter -O2,$(CFLAGS)),-O3)

$(GL_OUT)/obj/%.o: %.c platform/gl/gl.mk
	@mkdir -p $(@D)
	@$(GL_COMPILE) -c $< -o $@

$(GL_OUT)/liblambentgl.so: $(GL_OBJ) platform/gl/gl_aliases.ld
	@echo "LD $@"
	@$(CC) -shared $(LDFLAGS) -o $@ $^ -Wl,-soname,libOSMesa.so.8 -Wl,-Bsymbolic -lm -lpthread

# The four names are one file: a program that loads two of them has one current context.
$(GL_NAMES): $(GL_OUT)/liblambentgl.so
	@ln -sf liblambentgl.so $@

$(GL_OUT)/libGL.a: $(GL_OBJ)
	@echo "AR $@"
	@rm -f $@
	@$(AR) rcs $@ $^

.PHONY: gl gl-check gl-races gl-cross
gl-check: gl ## programs of others on that library: PyOpenGL, GLU, piglit; skips clients if packages are missing
	@GL_CLIENTS='$(GL_CLIENTS)' CC='$(CC)' CFLAGS='$(CFLAGS)' sh platform/gl/check/check.sh $(GL_OUT)

gl-races: ## two contexts of that library in two threads, under clang's race detector
	+@sh tests/scripts/tools.sh need clang clang-sanitizers && $(MAKE) gl-check GL_CLIENTS=threads \
	    BUILD=$(BUILD)/gl-races CC=clang CFLAGS="-O1 -g1 -fsanitize=thread -DGL_HEAP_BYTES=4194304 -DGL_BOUNCE_ELEMENTS=256 \
	    $(PLAIN_KERNELS)"

GL_MACHINES := aarch64 mips riscv64
gl-cross: ## the pictures of our own program on other machines, by emulators; skips machines if compilers are missing
	@MAKE='$(MAKE)' CFLAGS='$(CFLAGS)' sh platform/gl/check/cross.sh $(BUILD) $(GL_MACHINES)

-include $(GL_OBJ:.o=.d)
