# lambent: library, tool, checks and measurements. `make help` lists the targets; there is no configure step.
#
#   make [TARGET] [CONFIG=default|tiny] [PORT=host|cortex-m|riscv|cortex-a|aarch64|web] [CC=...] [CFLAGS=...] [BUILD=...] [V=1]
#
# Build outputs go to $(BUILD)/$(CONFIG). You may set CFLAGS and LDFLAGS; the flags for exact results come after them.

.DEFAULT_GOAL := all
.SUFFIXES:
.DELETE_ON_ERROR:
MAKEFLAGS += --no-print-directory

CONFIG ?= default
PORT   ?= host
BUILD  ?= build$(if $(filter-out host,$(PORT)),/$(PORT))
ifneq ($(words $(BUILD))$(findstring ',$(BUILD))$(findstring :,$(BUILD)),1)
$(error BUILD=$(BUILD): make takes one folder, without blanks, quotes and colons in its name)
endif
# The host's tool, if this is a build for another machine.
HOST_BUILD ?= $(if $(filter file,$(origin BUILD)),build,$(BUILD)/host)
# ROOM=pixel: the room with light by pixel, tiny and without the unused parts of the library, in a separate folder.
ifeq ($(ROOM),pixel)
override CONFIG := tiny
endif
B      := $(BUILD)/$(CONFIG)$(if $(filter pixel,$(ROOM)),-pixel)

# Programs for small machines; they print the instructions of a frame.
LIVE := live baked gouraud bounced torus torus_few

# A port sets the compiler, start-up sources, libraries and the command that runs programs (RUN).
include platform/$(PORT)/port.mk

CFLAGS ?= -O2
NM     ?= nm
SIZE   ?= size

config_default :=
config_tiny    := -DLMB_CONFIG_TINY
ifeq ($(origin config_$(CONFIG)),undefined)
$(error CONFIG=$(CONFIG): there are `default` and `tiny`)
endif

ifeq ($(ROOM),pixel)
config_$(CONFIG) += -DLMB_TREES=0 -DLMB_TRANSFER=1 -DLMB_PROBES=0 -DLMB_RELIEF=0 -DLMB_MIXED=0 -DLMB_VOXELS=0 \
    -DLMB_PLAN=0 -DLMB_MAX_CUT=6 -DLMB_MANY_LIGHTS_CUT=16
endif

WARNINGS := -Wall -Wextra -pedantic -Wshadow -Wvla -Wmissing-prototypes -Wdouble-promotion
STD      ?= c99
EXACT     = -std=$(STD) -ffp-contract=off -fno-math-errno -fno-builtin-bcmp
FLAGS     = $(CFLAGS) $(PORT_CFLAGS) $(WARNINGS) $(EXACT) $(config_$(CONFIG)) -Iinclude
# The call graph with stack sizes, if the compiler can write it (gcc 10 and later).
CALLS    := $(shell $(CC) -fcallgraph-info=su -E -x c /dev/null >/dev/null 2>&1 && echo -fcallgraph-info=su)
DEPS     ?= -fstack-usage $(CALLS) -MMD -MP
COMPILE   = $(CC) $(FLAGS) $(DEPS)
LINK      = $(CC) $(FLAGS) $(PORT_LDFLAGS) $(LDFLAGS)

# --- sources ---------------------------------------------------------------------------------------------------------

object    = $(patsubst %.c,$(B)/obj/%.o,$(1))
LIB_SRC  := $(sort $(wildcard src/*/*.c))
LIB_PARTS := $(wildcard src/*/*.h src/*/*.inl src/*/*.inc)
HEADERS  := $(sort $(wildcard include/lambent/*.h))
HOST_SRC := $(addprefix platform/host/,host.c pool.c process.c programs.c count.c limit.c)
# lambent-bench: the verbs' measurements and hard cases, which users of the tool do not need.
BENCH_SRC := $(sort $(wildcard tools/bench/*.c tools/hard/*.c))
TOOL_SRC := $(sort $(filter-out $(wildcard tools/*/gen_*.c tools/*/main_*.c) $(BENCH_SRC),$(wildcard tools/*/*.c))) $(HOST_SRC)
# Unit tests that take over a second each, and that of lambent-bench, which takes seconds to compile; `make check` leaves
# them out.
SLOW_TESTS := bench bounce cut frame_init frames glossy gltf live_frames mix mix_cones mix_front mix_sources mix_stays multisample \
              occlusion relief_light relief_ornate room_edges sky transfer tree zeros
TEST_SRC := $(sort $(wildcard $(foreach d,unit analytic truth lanes,tests/$(d)/test_*.c)))

SCENES_SRC := $(filter-out tests/scenes/main_%,$(sort $(wildcard tests/scenes/*.c)))

# ONE_UNIT=1 compiles the library in three quarters of the time: all but the kernels are one source.
UNIT_SRC   := $(filter-out src/isa/%,$(LIB_SRC))
LIB_OBJ    := $(if $(ONE_UNIT),$(B)/obj/src/one_unit.o,$(call object,$(UNIT_SRC))) $(call object,$(filter src/isa/%,$(LIB_SRC)))
TOOL_OBJ   := $(call object,$(TOOL_SRC))
# The objects of the tool and of both programs, without their main functions.
VERBS_OBJ  := $(filter-out %/lambent.o,$(TOOL_OBJ))
TOOLS_OBJ  := $(VERBS_OBJ) $(call object,$(BENCH_SRC))
BENCH_OBJ  := $(call object,tools/cli/main_bench.c) $(TOOLS_OBJ)
TEST_OBJ   := $(call object,tests/unit/main.c $(TEST_SRC) $(SCENES_SRC) tests/truth/path.c) $(TOOLS_OBJ)
# The same program without the slow tests and lambent-bench: half of the code that `make check` would compile.
QUICK_SRC  := $(filter-out $(SLOW_TESTS:%=tests/unit/test_%.c),$(TEST_SRC))
QUICK_OBJ  := $(B)/obj/tests/unit/main_quick.o $(call object,$(QUICK_SRC) $(SCENES_SRC) tests/truth/path.c) $(VERBS_OBJ)
GOLDEN_SRC := $(filter-out tests/golden/main_%,$(sort $(wildcard tests/golden/*.c)))
GOLDEN_OBJ := $(call object,$(GOLDEN_SRC) tests/golden/main_golden.c tools/demo/demo_scene.c $(PORT_SRC)) $(LIB_OBJ)
ORDERS_OBJ := $(call object,$(GOLDEN_SRC) tests/golden/main_orders.c tools/demo/demo_scene.c tools/common/workers.c \
              tools/common/slice_items.c platform/host/host.c platform/host/pool.c) $(LIB_OBJ)
FUZZ_SRC   := $(filter-out tests/fuzz/main_%,$(wildcard tests/fuzz/*.c))
REPLAY_OBJ := $(call object,tests/fuzz/main_replay.c $(FUZZ_SRC)) $(VERBS_OBJ)
HOSTILE_OBJ := $(call object,tests/fuzz/main_hostile.c $(FUZZ_SRC)) $(VERBS_OBJ)
AUDITED    := $(call object,tests/audit/isa_audit.c) $(filter-out %/isa_pick.o,$(LIB_OBJ))
DECODE_OBJ := $(call object,tests/decodes/main_decodes.c) $(VERBS_OBJ)
REFERENCE_OBJ := $(call object,$(sort $(wildcard tests/reference/*.c)) tools/bench/bench_scene.c) $(VERBS_OBJ)
GOLDEN_ONE_OBJ := $(call object,$(GOLDEN_SRC) tests/golden/main_one.c tools/demo/demo_scene.c) $(LIB_OBJ)
HARD_OBJ   := $(call object,$(sort $(wildcard tests/hard/*.c))) $(TOOLS_OBJ)
SCENES_OBJ := $(call object,tests/scenes/main_scenes.c $(SCENES_SRC))
PATH_OBJ   := $(call object,tests/truth/main_path.c tests/truth/path.c $(SCENES_SRC))
measure_fixed := platform/demo/room.c
measure_rooms := tests/truth/path.c $(SCENES_SRC)
measure_sun := tests/truth/path.c $(SCENES_SRC)
measure_contact := tests/truth/path.c $(SCENES_SRC)
# The program measure-NAME is built from tests/measure/main_NAME.c and the files NAME_*.c beside it.
MEASURES   := $(patsubst tests/measure/main_%.c,%,$(sort $(wildcard tests/measure/main_*.c)))
measure_of  = $(call object,$(wildcard tests/measure/main_$(1).c tests/measure/$(1)_*.c) $(measure_$(1))) \
    $(TOOLS_OBJ)
# What draws the built-in scene: main_demo.c replaces the readers of files and what only they need. On x86-64 SSE2 is the
# only backend, because the others take half of the time to compile the library.
PICTURE_TOOLS := $(filter-out $(addprefix tools/,common/io_json.c common/merge.c common/frame_name.c common/key_path.c \
              common/text_buffer.c render/bench_calibrate.c render/budget.c render/ladder.c render/render_world.c \
              render/scene_sample.c render/wireframe.c),$(filter tools/common/% tools/render/%,$(TOOL_SRC))) \
              $(addprefix tools/,demo/demo_scene.c model/scene_hash.c) \
              $(addprefix tools/picture/,grey.c image.c io_deflate.c io_hdr.c io_pfm.c io_png_write.c io_ppm.c picture.c)
PICTURE_LIB := $(filter-out src/draw/% src/mixed/% src/relief/% src/vertex/% src/frame/plan% src/frame/relight.c \
              src/frame/render_vertices.c $(filter-out src/probe/env.c,$(wildcard src/probe/*.c)),$(LIB_SRC))
PICTURE_OBJ := $(call object,tools/cli/main_demo.c $(PICTURE_TOOLS) $(addprefix platform/host/,host.c pool.c limit.c))
HAS_SSE2   := $(if $(filter host,$(PORT)),$(shell echo LMB_HAVE_SSE2 | \
              $(CC) $(FLAGS) -include src/lane/backends.h -E -P -x c - 2>/dev/null | tail -n 1))
PICTURE_OBJ += $(if $(filter 1,$(HAS_SSE2)),$(B)/obj/tools/demo/isa_pick.o $(call object,src/isa/isa_sse2.c \
              $(filter-out src/isa/%,$(PICTURE_LIB))),$(call object,$(PICTURE_LIB)))
DEMO_OBJ   := $(call object,platform/cortex-m/main_tiny.c tools/demo/demo_scene.c $(PORT_SRC)) $(LIB_OBJ)
live_of     = $(call object,platform/cortex-m/main_$(1).c tools/demo/demo_scene.c $(PORT_SRC)) $(LIB_OBJ)
# The room: the port's ROOM_SRC (default: the start-up sources) and the sources that all ports share. If the emulator
# needs another format, port.mk sets ROOM_IMAGE, with a rule that makes it from $(B)/room, and ROOM_RUN, which runs it.
ROOM_IMAGE ?= $(B)/room
ROOM_RUN   ?= $(RUN)
ROOM_DEMO  := $(addprefix platform/demo/,room.c $(if $(filter pixel,$(ROOM)),main_pixel.c room_pixel.c,main_room.c room_title.c)) \
              $(if $(filter pixel,$(ROOM)),tools/demo/demo_scene.c)
ROOM_LIB   := $(if $(filter pixel,$(ROOM)),$(LIB_SRC),$(filter src/vertex/fixed% src/vertex/number% %/blit.c %/draw_pixel.c %/surface.c,$(LIB_SRC)))
ROOM_OBJ   := $(call object,$(ROOM_DEMO) $(or $(ROOM_SRC),$(PORT_SRC)) $(ROOM_LIB))
ifdef COUNTED
include platform/counted/counted.mk
endif
PAGE_OBJ   := $(call object,tests/web/main_page.c platform/web/page/page_scene.c) \
              $(filter-out %/lambent.o %/verb_relief_bake.o,$(TOOL_OBJ))
STATUE_OBJ := $(call object,platform/cortex-m/main_statue.c $(PORT_SRC)) $(LIB_OBJ)

PROGRAMS := tests quick-tests golden golden-one golden-orders reference hard replay hostile audit-golden audit-replay

LIB  := $(B)/liblambent.a
TOOL := $(if $(filter default,$(CONFIG)),$(BUILD),$(B))/lambent
BENCH := $(TOOL)-bench
PACKAGE_FILES := $(addprefix $(B)/,lambent.pc lambent-config.cmake lambent-config-version.cmake)

# --- targets for users -----------------------------------------------------------------------------------------------

##@ While you work
.PHONY: try
try: ## builds the changed files and runs one test by name: make try T=cut (unit, golden, hard, cli, or a check)
	+@MAKE='$(MAKE)' B='$(B)' CHECK_NAMES='$(sort $(QUICK_CHECKS) $(SLOW_CHECKS))' sh tests/scripts/try.sh

##@ Build
AMALGAM := $(BUILD)/amalgam/lambent.h $(BUILD)/amalgam/lambent.c
.PHONY: all lib demo man amalgam dist install uninstall docs docs-check help clean
all: lib $(if $(filter host,$(PORT)),$(TOOL)) ## the library (liblambent.a) and, on a host, the tool (build/lambent)
lib: $(LIB)

.PHONY: bench install-bench
bench: $(BENCH) ## the second tool (build/lambent-bench): speed against error, rates of this computer, hard cases

demo: $(B)/demo-picture ## a picture of the built-in scene in build/demo.png, with only what it needs of library and tool
	@$< $(BUILD)/demo.png

pictures: $(TOOL) ## draws the README's pictures of relight, relief and mix into build/default/pictures
	@$(IN_SH) tests/scripts/pictures.sh

man: $(TOOL) ## the man page build/lambent.1, from the option tables
	@$(TOOL) help --man > $(BUILD)/lambent.1

install-bench: $(BENCH) ## lambent-bench and its man page (PREFIX=/usr/local DESTDIR=)
	@echo "INSTALL $(DESTDIR)$(PREFIX)/bin/lambent-bench"
	@install -d '$(DESTDIR)$(PREFIX)/bin' '$(AT_MAN)'
	@install -m 755 $(BENCH) '$(DESTDIR)$(PREFIX)/bin'
	@$(BENCH) help --man > $(BENCH).1
	@install -m 644 $(BENCH).1 '$(AT_MAN)'

amalgam: $(AMALGAM) ## the library as two files: build/amalgam/lambent.h and lambent.c
$(AMALGAM): $(BUILD)/amalgam/lambent.%: platform/amalgam/amalgam.awk LICENSE $(LIB_SRC) $(LIB_PARTS) $(HEADERS)
	@mkdir -p $(@D)
	@awk -v PART=$* -v VERSION=$(VERSION) -f platform/amalgam/amalgam.awk $(LIB_SRC) > $@

dist: ## the last commit as build/lambent-VERSION.tar.gz, with the same bytes each time
	@mkdir -p $(BUILD)
	@git archive --format=tar --prefix=lambent-$(VERSION)/ HEAD | gzip -n -9 > $(BUILD)/lambent-$(VERSION).tar.gz

install: lib $(if $(filter host,$(PORT)),$(TOOL) man) $(PACKAGE_FILES) ## library, headers, tool, man page, pkg-config and CMake files (PREFIX=/usr/local DESTDIR=)
	@echo "INSTALL $(DESTDIR)$(PREFIX)"
	@install -d '$(DESTDIR)$(PREFIX)/include/lambent' '$(AT_LIB)/pkgconfig' '$(AT_LIB)/cmake/lambent'
	@install -m 644 $(HEADERS) '$(DESTDIR)$(PREFIX)/include/lambent'
	@install -m 644 $(LIB) '$(AT_LIB)'
	@install -m 644 $(B)/lambent.pc '$(AT_LIB)/pkgconfig'
	@install -m 644 $(filter %.cmake,$(PACKAGE_FILES)) '$(AT_LIB)/cmake/lambent'
ifeq ($(PORT),host)
	@install -d '$(DESTDIR)$(PREFIX)/bin' '$(AT_MAN)'
	@install -m 755 $(TOOL) '$(DESTDIR)$(PREFIX)/bin'
	@install -m 644 $(BUILD)/lambent.1 '$(AT_MAN)'
endif

uninstall: ## removes the files that install and install-bench put there
	@rm -f '$(DESTDIR)$(PREFIX)/bin/lambent' '$(DESTDIR)$(PREFIX)/bin/lambent-bench' '$(AT_MAN)/lambent.1' \
	    '$(AT_MAN)/lambent-bench.1' '$(AT_LIB)/liblambent.a' '$(AT_LIB)/pkgconfig/lambent.pc'
	@rm -rf '$(DESTDIR)$(PREFIX)/include/lambent' '$(AT_LIB)/cmake/lambent'

docs: ## the reference, build/docs/html/index.html: headers, documents, the systems (needs doxygen)
	@mkdir -p $(BUILD)/docs
	@for header in $(HEADERS); do \
	    awk -f tests/scripts/prototypes.awk $$header | sed "s,^,$${header##*/}|,"; done > $(BUILD)/docs/calls.txt
	@awk -f tests/scripts/contracts.awk $(BUILD)/docs/calls.txt $(HEADERS) | awk -f tools/docs/calls.awk > $(BUILD)/docs/calls.md
	@doxygen -l $(BUILD)/docs/layout.xml && sed -i -f tools/docs/layout.sed $(BUILD)/docs/layout.xml
	@DOCS_TOP="$$PWD" DOCS_OUT='$(BUILD)/docs' doxygen tools/docs/Doxyfile
	@echo "$(BUILD)/docs/html/index.html"

help: ## prints this list
	@awk -F ':.*## ' '/^##@ / { printf "\n%s\n", substr($$0, 5) } \
	    /^[a-z-]+:.*## / { printf "  make %-17s %s\n", $$1, $$2 }' Makefile

clean: ## removes all build outputs
	@rm -rf $(BUILD)

# --- rules -----------------------------------------------------------------------------------------------------------

# Prints one line per module; V=1 prints every file. Uses make's info, because a shell per object takes 3 % of a build.
say_module = $(if $(said_$(1)),,$(eval said_$(1) := 1)$(info CC $(1)))

$(B)/obj/%.o: %.c $(B)/flags
	$(if $(V),$(info CC $<),$(call say_module,$(<D)))@$(COMPILE) -c $< -o $@

$(B)/obj/src/one_unit.o: $(UNIT_SRC) $(B)/flags
	$(info CC src)@printf '#include "%s"\n' $(UNIT_SRC) | $(COMPILE) -Wno-shadow -MT $@ -MF $(@:.o=.d) -x c -c - -o $@

$(LIB): $(LIB_OBJ)
	@echo "AR $@"
	@rm -f $@
	@$(AR) rcs $@ $^

$(TOOL): $(TOOL_OBJ) $(LIB)
$(BENCH): $(BENCH_OBJ) $(LIB)
$(B)/tests: $(TEST_OBJ) $(LIB)
$(B)/quick-tests: $(QUICK_OBJ) $(LIB)
$(B)/golden: $(GOLDEN_OBJ)
$(B)/demo-picture: $(PICTURE_OBJ)
$(B)/golden-one: $(GOLDEN_ONE_OBJ)
$(B)/golden-orders: $(ORDERS_OBJ)
$(B)/demo: $(DEMO_OBJ)
$(B)/statue: $(STATUE_OBJ)
$(B)/room: $(ROOM_OBJ)
# A packed scene as C code: PACKED=scene.c.
PACKED ?= $(B)/scene.c
$(B)/packed: $(call object,platform/cortex-m/main_packed.c $(PORT_SRC)) $(LIB_OBJ) $(PACKED)
$(B)/page-hash: $(PAGE_OBJ) $(LIB)
$(foreach f,$(LIVE),$(eval $(B)/$(f): $(call live_of,$(f))))
$(B)/replay: $(REPLAY_OBJ) $(LIB)
$(B)/hostile: $(HOSTILE_OBJ) $(LIB)
$(B)/decodes: $(DECODE_OBJ) $(LIB)
$(B)/reference: $(REFERENCE_OBJ) $(LIB)
$(B)/hard: $(HARD_OBJ) $(LIB)
$(B)/scenes: $(SCENES_OBJ)
$(B)/path: $(PATH_OBJ)
$(B)/audit-golden: $(filter-out $(LIB_OBJ),$(GOLDEN_OBJ)) $(AUDITED)
$(B)/audit-replay: $(REPLAY_OBJ) $(AUDITED)
$(foreach f,$(MEASURES),$(eval $(B)/measure-$(f): $(call measure_of,$(f)) $(LIB)))
$(TOOL) $(BENCH) $(PROGRAMS:%=$(B)/%) $(MEASURES:%=$(B)/measure-%) $(B)/demo $(B)/demo-picture $(B)/statue $(B)/packed $(B)/room $(LIVE:%=$(B)/%) $(B)/page-hash $(B)/decodes \
    $(B)/scenes $(B)/path $(B)/fuzzer $(B)/faults:
	@echo "LD $@"
	@$(LINK) -o $@ $^ $(PORT_LDLIBS) $(LDLIBS)

# Written only if the flags changed: another compiler or flag rebuilds everything, but an unchanged one nothing. One
# command makes all folders of objects.
OBJ_DIRS := $(addprefix $(B)/obj/,$(sort $(dir $(wildcard src/*/*.c tools/*/*.c tests/*/*.c platform/*/*.c platform/*/*/*.c))))
export FLAGS_LINE := $(COMPILE) $(LINK) $(PORT_LDLIBS) $(LDLIBS)
$(B)/flags: FORCE
	@mkdir -p $(OBJ_DIRS)
	@printf '%s\n' "$$FLAGS_LINE" | cmp -s - $@ || printf '%s\n' "$$FLAGS_LINE" > $@

# lmb_kernels_pick with a choice of one.
$(B)/obj/tools/demo/isa_pick.o: src/isa/isa_pick.c $(B)/flags
	@$(COMPILE) -DLMB_PICK_SSE2 $(foreach b,AVX512 AVX2,-ULMB_HAVE_$(b) -DLMB_HAVE_$(b)=0) -c $< -o $@

# -O1 takes half of the time of -O2, and changes no count and no denormal.
$(B)/obj/tests/audit/isa_audit.o: COMPILE += -O1
$(B)/obj/tools/bench/bench_operations.o: COMPILE += -O1 $(if $(findstring -fsanitize,$(CFLAGS)),-fno-sanitize=all)

# Most tests have few loops, so they are compiled at -O0, in a third of the time of -O2. CFLAGS apply to the code under
# test. Set TEST_CFLAGS= to compile the tests with CFLAGS too.
LOOPING := $(SLOW_TESTS) live map_picture
ifeq ($(PORT),host)
TEST_CFLAGS ?= -O0
$(call object,$(filter-out $(LOOPING:%=tests/unit/test_%.c),$(wildcard tests/unit/*.c)) $(wildcard tests/fuzz/*.c)): \
    COMPILE += $(TEST_CFLAGS)
$(call object,$(LOOPING:%=tests/unit/test_%.c) $(wildcard tests/analytic/*.c) tests/lanes/test_kernels.c \
    tests/lanes/test_draws.c): COMPILE += $(TEST_CFLAGS:-O0=-O1)
endif

# GOLDENS selects golden pictures. A change recompiles only their table.
$(B)/goldens: FORCE
	@mkdir -p $(@D)
	@printf '%s\n' '$(GOLDENS)' | cmp -s - $@ || printf '%s\n' '$(GOLDENS)' > $@
$(B)/obj/tests/golden/golden.o: $(B)/goldens
$(B)/obj/tests/golden/golden.o: COMPILE += $(GOLDENS)

# Flags for kernels only, because they take three times as long to compile under some sanitizers.
$(call object,$(wildcard src/isa/isa_*.c)): COMPILE += $(KERNEL_CFLAGS)

# The compiler and flags that `lambent doctor -v` prints.
export BUILD_FLAGS := $(CC) $(FLAGS)
$(B)/build_flags.inc: $(B)/flags
	@printf '%s\n' "$$BUILD_FLAGS" | sed 's/["\\]/\\&/g; s/.*/#define BUILD_FLAGS "&"/' > $@
$(B)/obj/tools/cli/verb_doctor.o: $(B)/build_flags.inc
$(B)/obj/tools/cli/verb_doctor.o: COMPILE += -I$(B)

# The table of tests. A test is a function `void test_NAME(void)` in tests/GROUP/test_NAME.c; there is no list to edit.
group_of    = $(if $(filter $(SLOW_TESTS),$(name_of)),slow,$(word 2,$(subst /, ,$(1))))
name_of     = $(patsubst test_%.c,%,$(notdir $(1)))
lines_of    = $(foreach f,$(1),'TEST($(call group_of,$(f)),$(call name_of,$(f)))')
$(B)/tests.inc: LINES := $(call lines_of,$(TEST_SRC))
$(B)/quick_tests.inc: LINES := $(call lines_of,$(QUICK_SRC))
$(B)/tests.inc $(B)/quick_tests.inc: FORCE
	@mkdir -p $(@D)
	@printf '%s\n' $(LINES) | cmp -s - $@ || printf '%s\n' $(LINES) > $@
$(B)/obj/tests/unit/main.o: $(B)/tests.inc
$(B)/obj/tests/unit/main.o: COMPILE += -I$(B)
$(B)/obj/tests/unit/main_quick.o: tests/unit/main.c $(B)/quick_tests.inc $(B)/flags
	@$(COMPILE) -I$(B) -DTEST_TABLE='"quick_tests.inc"' -c $< -o $@

# -O1 compiles the unit tests in 60 % of the time of -O2, and they spend their own time in the library.
$(B)/obj/tests/unit/%.o: COMPILE += -O1

# The table of public calls, from the headers.
$(B)/calls.inc: $(HEADERS) tests/scripts/prototypes.awk tests/scripts/zeros.awk
	@mkdir -p $(@D)
	@awk -f tests/scripts/prototypes.awk $(HEADERS) | awk -f tests/scripts/zeros.awk > $@
$(B)/obj/tests/unit/test_zeros.o $(B)/obj/tests/fuzz/fuzz_calls.o: $(B)/calls.inc
$(B)/obj/tests/unit/test_zeros.o $(B)/obj/tests/fuzz/fuzz_calls.o: COMPILE += -I$(B)

# Files that give pkg-config and CMake the library's folder and switches after `make install`.
PREFIX ?= /usr/local
LIBDIR ?= lib
AT_LIB  = $(DESTDIR)$(PREFIX)/$(LIBDIR)
AT_MAN  = $(DESTDIR)$(PREFIX)/share/man/man1
VERSION_OF = $(shell awk '$$2 == "LMB_VERSION_$(1)" { print $$3 }' include/lambent/types.h)
VERSION    = $(call VERSION_OF,MAJOR).$(call VERSION_OF,MINOR).$(call VERSION_OF,PATCH)
USE_FLAGS  = $(strip $(config_$(CONFIG)) $(filter -DLMB_%,$(CFLAGS)))
none  :=
comma := ,
space := $(none) $(none)
$(PACKAGE_FILES): $(B)/%: platform/cmake/%.in include/lambent/types.h $(B)/flags FORCE
	@sed -e 's,@PREFIX@,$(PREFIX),' -e 's,@LIBDIR@,$(LIBDIR),' -e 's,@VERSION@,$(VERSION),' \
	    -e 's,@UP@,$(subst $(space),/,$(patsubst %,..,$(subst /, ,$(LIBDIR)) cmake lambent)),' \
	    -e 's,@MAJOR@,$(call VERSION_OF,MAJOR),g' -e 's,@MINOR@,$(call VERSION_OF,MINOR),g' \
	    -e 's,@USE_FLAGS@,$(if $(filter %.cmake,$@),$(subst $(space),;,$(USE_FLAGS)),$(USE_FLAGS)),' \
	    -e 's,@USE_LIBS@,$(filter -lm,$(PORT_LDLIBS)),' -e 's/ *$$//' $< > $@

# The packed relief, written by tests/scripts/statue.sh.
$(B)/obj/platform/cortex-m/main_statue.o: $(wildcard $(B)/statue.inc)
$(B)/obj/platform/cortex-m/main_statue.o: COMPILE += -I$(B)

# Baked light, written by tests/scripts/live.sh.
$(B)/obj/platform/cortex-m/main_baked.o $(B)/obj/platform/cortex-m/main_gouraud.o: $(wildcard $(B)/baked.inc)
$(B)/obj/platform/cortex-m/main_baked.o $(B)/obj/platform/cortex-m/main_gouraud.o: COMPILE += -I$(B)

# Baked light for the room by pixel, made by the host's tool. A port.mk may set PIXEL_FRAMES (1 without an FPU) and
# ENDIAN (big or little).
HOST_CC ?= cc
$(B)/room_pixel.inc: $(sort $(wildcard tools/bake/*.c tools/demo/*.c src/transfer/*.c))
	@mkdir -p $(@D)
	+@$(MAKE) $(HOST_BUILD)/lambent PORT=host CONFIG=default BUILD=$(HOST_BUILD) CC='$(HOST_CC)' CFLAGS=-O2 LDFLAGS= ROOM= >$@.log
	@$(HOST_BUILD)/lambent bake demo -o $@.lmt --endian $(or $(ENDIAN),little) --elements 256 --receivers 300 \
	    --cluster 0.6 --error 0.00065 --once >>$@.log
	@od -An -v -tx4 --endian=$(or $(ENDIAN),little) $@.lmt | sed 's/ *\([0-9a-f][0-9a-f]*\)/0x\1,/g' >$@
$(B)/obj/platform/demo/room_pixel.o: $(B)/room_pixel.inc
$(B)/obj/platform/demo/room_pixel.o: COMPILE += -I$(B)
$(B)/obj/platform/demo/main_pixel.o: COMPILE += -DPIXEL_FRAMES=$(or $(PIXEL_FRAMES),3)

.PHONY: FORCE
FORCE:

-include $(patsubst %.o,%.d,$(sort $(LIB_OBJ) $(TOOL_OBJ) $(BENCH_OBJ) $(TEST_OBJ) $(QUICK_OBJ) $(PICTURE_OBJ) $(GOLDEN_OBJ) $(GOLDEN_ONE_OBJ) $(ORDERS_OBJ) $(DEMO_OBJ) $(STATUE_OBJ) $(ROOM_OBJ) $(foreach f,$(LIVE),$(call live_of,$(f))) \
    $(REPLAY_OBJ) $(HOSTILE_OBJ) $(PAGE_OBJ) \
    $(DECODE_OBJ) $(REFERENCE_OBJ) $(HARD_OBJ) $(SCENES_OBJ) $(PATH_OBJ) $(foreach f,$(MEASURES),$(call measure_of,$(f))) $(AUDITED)))

# --- checks: each is a target, ends with `N passed, N failed, N skipped`, and fails if one failed ---------------------

# The checks of `make check`, and those that `make check-all` adds. The longest come first, so that shorter ones fill
# the second core.
QUICK_CHECKS := unit lanes golden analytic truth-small hostile layers words headers contracts slivers tables symbols \
                replay stack
SLOW_CHECKS  := cli tiny truth statue live examples-tiny hard own one-command links page-links golden-orders slow guard \
                package audit hostile-cli layout direct-only examples no-float readme tool-setup
CHECKS ?= $(QUICK_CHECKS)
NEEDS  :=
RUN_PART = LOGS=$(B)/check NEEDS="$(NEEDS)" sh tests/scripts/part.sh
IN_SH   = B='$(B)' LIB='$(LIB)' TOOL='$(TOOL)' NM='$(NM)' SIZE='$(SIZE)' CC='$(CC)' FLAGS='$(FLAGS)' \
          LDLIBS='$(PORT_LDLIBS) $(LDLIBS)' sh

##@ Checks
.PHONY: check check-all nightly programs $(sort $(CHECKS) $(QUICK_CHECKS) $(SLOW_CHECKS)) $(CHECKS:%=check-%)
check: $(CHECKS:%=check-%) ## the quick checks, one line each, and the sum; V=1 prints their output; CHECKS="unit golden" selects some
	@sh tests/scripts/sum.sh $(CHECKS:%=$(B)/check/%.log)

MANY       := PREFIXES=20 MUTATIONS=200
LONG       ?= LMB_LONG=1
ALL_CHECKS := $(filter-out truth-small $(SKIP_CHECKS),$(SLOW_CHECKS) $(QUICK_CHECKS))
check-all: ## the quick and the slow checks; links every program and the page (SKIP_CHECKS="cli hard" leaves some out)
	+@$(MAKE) check CHECKS="$(ALL_CHECKS)" $(MANY) $(LONG) JOBS=2
nightly: ## all jobs of .ci/jobs with all their parts; installs missing packages; prints the total time
	@bash .ci/run nightly

# Programs that checks run. All are built before the first check, so that no two checks build the same one.
# The checks' program of unit tests: without the slow ones, if no check needs these.
UNIT_PROGRAM := $(if $(filter slow%,$(CHECKS)),tests,quick-tests)
programs_unit := $(UNIT_PROGRAM)
programs_unit-1 := $(UNIT_PROGRAM)
programs_unit-2 := $(UNIT_PROGRAM)
programs_analytic := $(UNIT_PROGRAM)
programs_truth := $(UNIT_PROGRAM)
programs_truth-small := $(UNIT_PROGRAM)
programs_slow := tests
$(foreach k,1 2 3 4 5 6,$(eval programs_slow-$(k) := tests))
programs_lanes := $(UNIT_PROGRAM)
programs_golden := golden
programs_golden-orders := golden-orders
programs_audit := audit-golden audit-replay
programs_slivers := reference
programs_hard := hard
programs_replay := replay
programs_hostile := hostile
bench_of_checks = $(if $(filter cli faults docs-check,$(CHECKS)),$(BENCH))

# All programs; those of tests/measure are in $(B)/links.
LINKED := $(BENCH) $(addprefix $(B)/,$(MEASURES:%=links/measure-%) $(PROGRAMS) decodes scenes path page-hash faults demo-picture demo torus torus_few live room)

# The checks that CHECKS="..." selects; by default all of this target.
programs: $(LIB) $(TOOL) $(bench_of_checks) $(if $(filter command line,$(origin CHECKS)),$(sort $(foreach c,$(CHECKS),$(programs_$(c):%=$(B)/%))),\
    $(filter-out $(B)/links/%,$(LINKED)) $(B)/fault.so) ## the programs that the checks run

$(CHECKS:%=check-%): check-%: $(LIB) $(TOOL) $(bench_of_checks) $(sort $(foreach c,$(CHECKS),$(programs_$(c):%=$(B)/%)))
	+@$(RUN_PART) $* $(MAKE) $*

# Both build the library in the same folder.
check-statue: $(filter check-tiny,$(CHECKS:%=check-%))
check-live: $(filter check-tiny check-statue,$(CHECKS:%=check-%))
check-examples-tiny: $(filter check-tiny check-statue,$(CHECKS:%=check-%))

unit: ## values and behaviour of functions
slow: ## the unit tests that take seconds each
analytic: ## light against closed forms
truth: ## light against path-traced pictures: small ones, and those of ../shared (LMB_SHARED)
lanes: ## each kernel of each backend against plain C; LANES_SEED=7 repeats a run

unit analytic truth lanes: $(B)/$(UNIT_PROGRAM)
	@$(RUN) $< $@
slow: $(B)/tests
	@$(RUN) $< $@

truth-small: $(B)/$(UNIT_PROGRAM) ## light against the small path-traced pictures of tests/truth/small
	@$(RUN) $< small_truth relight

# The quick unit tests in two halves, for two cores, and the slow ones in six parts, for CI's turns.
unit-1 unit-2: $(B)/$(UNIT_PROGRAM)
	@$(RUN) $< unit $(@:unit-%=%)/2

SLOW_PARTS := $(addprefix slow-,1 2 3 4 5 6)
.PHONY: $(SLOW_PARTS)
$(SLOW_PARTS): $(B)/tests
	@$(RUN) $< slow $(@:slow-%=%)/$(words $(SLOW_PARTS))

golden: $(B)/golden ## hashes of small scenes against the committed hashes
	@$(RUN) $(B)/golden$(EXE)

slivers: $(B)/reference ## random slivers, specks, huge and cut triangles against a slow rasterizer
	@$(RUN) $(B)/reference hard

hard: $(B)/hard ## the gallery of hard cases, and changes that must not change the picture (CASES="raster ...")
	@$(RUN) $(B)/hard $(CASES)

golden-orders: $(B)/golden-orders ## the golden pictures in pieces, in any order, on 1 to 8 threads (BACKENDS=all)
	@$(RUN) $(B)/golden-orders$(EXE) $(if $(filter all,$(BACKENDS)),all) $(if $(filter 1,$(LMB_LONG)),third)

replay: $(B)/replay ## the fuzz targets on their corpus
	@$(RUN) $(B)/replay tests/fuzz/corpus/*/*

# These inputs have coordinates and matrices of 1e-40, so their products are denormal.
AUDIT_CORPUS = $(filter-out $(addprefix tests/fuzz/corpus/,api/% calls/% stages/%),$(wildcard tests/fuzz/corpus/*/*))
audit: $(B)/audit-golden $(B)/audit-replay ## checks that kernels meet no denormals and no numbers outside int32
	@$(RUN) $(B)/audit-golden && $(RUN) $(B)/audit-replay $(AUDIT_CORPUS)

PREFIXES  ?= 5
MUTATIONS ?= 40
hostile: $(B)/hostile ## damaged samples through each parser (PREFIXES=5 MUTATIONS=40; check-all and asan use 20 and 200)
	@sh tests/scripts/hostile.sh $< $(PREFIXES) $(MUTATIONS)

hostile-cli: $(TOOL) ## absurd files through the whole tool
	@$(IN_SH) tests/scripts/hostile_cli.sh

# Calls between objects: `make check` has none of lambent-bench, so check-all reads these.
layers: $(LIB) $(TOOL) $(if $(filter slow%,$(CHECKS)),$(BENCH)) ## includes and calls go only to lower layers, without cycles (layers.txt)
	@$(IN_SH) tests/scripts/layers.sh

no-float: ## frames in integers use no float functions on a Cortex-M0+; prints their ROM
	@$(IN_SH) tests/scripts/no_float.sh

symbols: $(LIB) ## functions that the library calls (mem*, sqrtf, floorf) and exports (lmb_*)
	@$(IN_SH) tests/scripts/symbols.sh

stack: $(LIB) ## the largest stack frames and calls; the limit is 4096 bytes each
	@$(IN_SH) tests/scripts/stack.sh 4096

headers: ## each public header compiles on its own, as C99 and as C++; src compiles as one unit, as both
	@$(IN_SH) tests/scripts/headers.sh

contracts: ## each public call is documented with its statuses and stability, and is used
	@$(IN_SH) tests/scripts/contracts.sh

layout: $(LIB) ## a program with other capacities than the library must not link
	@$(IN_SH) tests/scripts/layout.sh

direct-only: $(LIB) ## a build with only direct light (LMB_BOUNCE 0) draws the direct light of the usual build
	@$(IN_SH) tests/scripts/direct_only.sh

guard: $(B)/golden $(LIB) ## builds with -ffast-math, contraction or x87 are refused
	@$(IN_SH) tests/scripts/guard.sh

one-command: ## a bare compiler command with all of src gives the same pictures
	@$(IN_SH) tests/scripts/one_command.sh

# Links the measure programs once more, with their own sources at -O0, in a separate folder, because measurements need
# optimised code.
linked_of = $(patsubst %.c,$(B)/links/%.o,$(wildcard tests/measure/main_$(1).c tests/measure/$(1)_*.c)) \
    $(call object,$(measure_$(1))) $(TOOLS_OBJ) $(LIB)
$(B)/links/%.o: %.c $(B)/flags
	@mkdir -p $(@D)
	@$(COMPILE) -O0 -c $< -o $@
define linked
$(B)/links/measure-$(1): $(call linked_of,$(1))
	@$(LINK) -o $$@ $$^ $(PORT_LDLIBS) $(LDLIBS)
endef
$(foreach f,$(MEASURES),$(eval $(call linked,$(f))))
-include $(patsubst tests/measure/%.c,$(B)/links/tests/measure/%.d,$(wildcard tests/measure/*.c))

links: $(LIB) $(TOOL) ## every program links, those of tests/measure at -O0; the sources of make prove compile
	+@MAKE='$(MAKE)' PROGRAMS='$(LINKED)' $(IN_SH) tests/scripts/links.sh

page-links: ## the page of platform/web links at -O0
	+@sh tests/scripts/tools.sh need clang wasm-ld wasi-libc || { echo "skipped: no compiler for the page"; \
	    echo "0 passed, 0 failed, 1 skipped"; exit; }; \
	    rm -f '$(BUILD)'/web/default/page-work-O0/*.wasm; \
	    $(MAKE) PORT=web PAGE_OPT=-O0 BUILD='$(BUILD)/web' page-modules && echo "1 passed, 0 failed, 0 skipped"

tables: $(LIB) ## generated tables equal the output of their generators
	@$(IN_SH) tests/scripts/tables.sh

words: ## no old name or private phrase, no dead link; sizes of the READMEs; rates of some words
	@$(IN_SH) tests/scripts/words.sh

FAULTS_OBJ := $(call object,tests/faults/main_faults.c)
$(B)/faults: $(FAULTS_OBJ)
# Without CFLAGS such as sanitizers, because it is loaded before the C library.
$(B)/fault.so: tests/faults/fault.c
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(CC) -O2 -std=c99 $(WARNINGS) -Wno-missing-prototypes -Wno-pedantic -fPIC -shared -o $@ $< -ldl

faults: $(TOOL) $(BENCH) $(B)/faults $(B)/fault.so ## each verb with its nth allocation, open, write, rename or thread failing
	@SHIM='$(B)/fault.so' $(IN_SH) tests/scripts/faults.sh

readme: $(LIB) $(TOOL) ## the README's examples compile and run
	@$(IN_SH) tests/scripts/readme.sh

package: $(TOOL) $(LIB) man $(PACKAGE_FILES) ## a program outside the tree, with pkg-config, CMake's find_package and add_subdirectory
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' $(IN_SH) tests/scripts/package.sh

amalgam-check: amalgam $(LIB) $(filter-out $(LIB_OBJ),$(GOLDEN_OBJ)) ## the two files compiled by gcc, clang, g++, clang for Windows and tcc: golden pictures
	+@AMALGAM=$(BUILD)/amalgam OBJ='$(filter-out $(LIB_OBJ),$(GOLDEN_OBJ))' GOLDEN_SRC='$(GOLDEN_SRC) tests/golden/main_golden.c tools/demo/demo_scene.c $(PORT_SRC)' \
	    $(IN_SH) tests/scripts/amalgam.sh

amalgam-cost: amalgam $(filter-out $(LIB_OBJ),$(GOLDEN_OBJ)) ## ROM, instructions and seconds of the two files, compared with the tree
	@AMALGAM=$(BUILD)/amalgam OBJ='$(filter-out $(LIB_OBJ),$(GOLDEN_OBJ))' $(IN_SH) tests/scripts/amalgam_cost.sh

examples: $(LIB) ## the programs of tests/examples compile, run and print the expected lines
	@$(IN_SH) tests/scripts/examples.sh

examples-tiny: ## the same in the tiny configuration
	+@$(MAKE) examples CONFIG=tiny BUILD='$(BUILD)/plain' ONE_UNIT=1 CFLAGS="-O1 $(PLAIN_KERNELS)"

own: $(LIB) $(TOOL) ## make run-NAME with your own programs, its error message, and main_scene.c on this machine
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' B='$(B)' TOOL='$(TOOL)' sh tests/scripts/own.sh

tool-setup: ## check-tools removes no package and reports each step
	@$(IN_SH) tests/scripts/tool_setup.sh

cli: $(TOOL) $(BENCH) ## files, exit statuses and messages of the tool (PART="render mix" selects parts; JOBS=2: two at once)
	@JOBS='$(JOBS)' $(IN_SH) tests/scripts/cli.sh $(if $(findstring command,$(origin PART)),$(PART))

# --- measurements, and other processors ------------------------------------------------------------------------------

# Modules that bounced light does not need.
WITHOUT = -DLMB_TREES=0 -DLMB_PROBES=0 -DLMB_RELIEF=0 -DLMB_MIXED=0 -DLMB_VOXELS=0 -DLMB_PLAN=0

.PHONY: asan-programs pointers pictures faults paths amalgam-check amalgam-cost size module-sizes rom rom-direct asan msan fuzz mutants cov static prove decodes reference measure-moving \
    measure-steady measure-pack measure-baked measure-edges measure-lights measure-crate measure-front scenes small-truth \
    measure-truth measure-own measure-defaults measure-turned measure-full measure-times measure-direct report measure-cuts \
    measure-simplify measure-capture measure-contact measure-export measure-relight measure-relief measure-plan plan-model measure-planes measure-mixed measure-rooms measure-sun measure-constants measure-sequence \
    measure-voxels measure-fixed large tiny run-demo run-statue run-packed $(LIVE:%=run-%) cross check-tools
##@ Size, sanitizers, fuzzing, proofs
ifeq ($(PORT),host)
size: module-sizes ## code and data by module, here and in the 48 KiB of a Cortex-M4F (40 KiB for direct light); with PORT=...: of the port's room
	+@sh tests/scripts/tools.sh need arm-none-eabi-gcc \
	    && $(MAKE) module-sizes rom PORT=cortex-m CONFIG=tiny BUILD=$(BUILD)/size LDFLAGS= CFLAGS='-Os $(WITHOUT)' \
	    && $(MAKE) rom-direct PORT=cortex-m CONFIG=tiny BUILD=$(BUILD)/size-direct LDFLAGS= CFLAGS='-Os -DLMB_BOUNCE=0 $(WITHOUT)'
else
size: $(ROOM_IMAGE)
	@$(SIZE) $(B)/room | awk 'NR == 2 { print "rom " $$1 + $$2 " bytes, ram " $$2 + $$3 " bytes" }'
endif

module-sizes: $(LIB)
	@$(IN_SH) tests/scripts/size.sh

rom: module-sizes
	@$(IN_SH) tests/scripts/rom.sh 49152

rom-direct: $(LIB)
	@$(IN_SH) tests/scripts/rom_direct.sh 40960

COV_PROGRAMS_src   := $(addprefix default/,tests replay golden golden-orders reference hard hostile)
COV_PROGRAMS_tools := default/tests default/replay lambent lambent-bench

# One build serves the sanitized checks and the fuzzer. Kernels have no fuzzer counters and no pointer-overflow checks,
# with which clang takes three times as long; `make pointers` has these checks.
ASAN_CC     ?= clang
PLAIN_KERNELS := -DLMB_HAVE_AVX512=0 -DLMB_HAVE_AVX2=0 -DLMB_HAVE_SSE2=0
FUZZER      := $(BUILD)/asan/default/fuzzer
ASAN_WANTED ?= cli hard unit-1 unit-2 golden replay hostile hostile-cli readme
SANITIZED    = BUILD=$(BUILD)/asan CC=$(ASAN_CC) CASES=-baked \
    KERNEL_CFLAGS="-fno-sanitize=pointer-overflow,object-size$(if $(findstring clang,$(ASAN_CC)),$(comma)fuzzer-no-link)" \
    CFLAGS="-O1 -g1 -Werror -fno-omit-frame-pointer -fsanitize=address,undefined$(if $(findstring clang,$(ASAN_CC)),$(comma)fuzzer-no-link) -fno-sanitize-recover=all"
asan: ## the checks under address and undefined-behaviour sanitizers
	+@SHORT=1 $(MAKE) check CHECKS="$(ASAN_WANTED)" $(SANITIZED) $(MANY)

pointers: ## pictures and parsers with pointer-overflow checks, in plain C
	+@$(MAKE) check CHECKS="golden replay hostile" BUILD=$(BUILD)/pointers CC=clang \
	    CFLAGS="-O1 -g1 -fsanitize=pointer-overflow,object-size -fno-sanitize-recover=all $(PLAIN_KERNELS)"

asan-programs: ## the programs of asan and fuzz
	+@$(MAKE) programs $(FUZZER) CHECKS="$(ASAN_WANTED)" $(SANITIZED)

# TEST_CFLAGS=: at -O0 clang marks struct padding as uninitialized, and tests compare structs with memcmp.
# Plain C: the sanitizer assumes that AVX2 and AVX-512 permutations read all lanes, and reports unused ones.
MSAN_CHECKS ?= golden hard replay hostile
msan: ## pictures, hard cases and the corpus under the memory sanitizer
	+@$(MAKE) check CHECKS="$(MSAN_CHECKS)" $(MANY) BUILD=$(BUILD)/msan CC=clang TEST_CFLAGS= \
	    CFLAGS="-O1 -g1 -fsanitize=memory $(PLAIN_KERNELS)"

# The target gl needs platform/gl, with a small heap, so that it is full at times.
FUZZ_GL  := $(call object,tests/fuzz/main_gl.c $(wildcard platform/gl/gl_*.c))
$(FUZZ_GL): COMPILE += -Iplatform/gl/include -DFUZZER -DGL_HEAP_BYTES='((size_t)1<<22)' -DGL_BOUNCE_ELEMENTS=256
FUZZ_OBJ := $(call object,tests/fuzz/main_fuzz.c $(FUZZ_SRC)) $(FUZZ_GL) $(VERBS_OBJ)
TARGETS   ?= png jpeg hdr pfm ppm pam picture inflate json gltf obj mtl ply lmr lmt lmf lmp cli api calls stages gl
MINUTES   ?= 1
fuzz: ## each parser, and the library's calls, under libFuzzer (MINUTES=1 of CPU each, TARGETS="png ...")
	+@sh tests/scripts/tools.sh need clang clang-sanitizers && $(MAKE) $(FUZZER) $(SANITIZED)
	@sh tests/scripts/fuzz.sh $(FUZZER) $(BUILD)/fuzz $(MINUTES) $(TARGETS)

$(B)/obj/tests/fuzz/main_fuzz.o: COMPILE += -Wno-missing-prototypes
$(B)/fuzzer: LDFLAGS += -fsanitize=fuzzer
$(B)/fuzzer: $(FUZZ_OBJ) $(LIB)

N    ?= 60
SEED ?= 1
mutants: ## changes src/ and tools/ in one place at a time and checks that a test fails (N=60 SEED=1 IN="raster tools/model")
	@sh tests/scripts/mutate.sh $(BUILD)/mutants $(N) $(SEED) $(IN)

COV    ?= src
cov: ## lines and branches of src/ that the checks run, and those that they miss, with gcov (COV=tools: of tools/)
	+@sh tests/scripts/tools.sh need gcov && $(MAKE) $(COV_PROGRAMS_$(COV):%=$(BUILD)/cov/%) BUILD=$(BUILD)/cov \
	    CFLAGS="-O1 -g --coverage -fprofile-update=atomic" LDFLAGS=--coverage \
	    && CC='$(CC)' FLAGS='$(FLAGS) --coverage' LDLIBS='$(LDLIBS)' sh tests/scripts/cov.sh $(BUILD)/cov $(COV)

static: ## cppcheck, clang-tidy, gcc -fanalyzer and -Wconversion over src/ (PART=2/3: a third of the files)
	@sh tests/scripts/static.sh $(BUILD)/static

prove: ## Frama-C and Gappa: no integer of the rasterizer overflows in any frame
	@sh tests/scripts/prove.sh $(BUILD)/prove

decodes: $(B)/decodes ## the picture decoders against netpbm, libjpeg-turbo and libvips
	@$(IN_SH) tests/scripts/decodes.sh $(B)/decodes

##@ Measure, against truth in ../shared if that folder exists (LMB_SHARED sets another)
reference: $(B)/reference ## coverage and depth of the raster workload against a slow rasterizer
	@$(RUN) $(B)/reference

measure-moving: $(B)/measure-moving ## a moving light and crate: change of the light from frame to frame that cuts add
	@$(RUN) $(B)/measure-moving

measure-pack: $(TOOL) $(B)/measure-pack ## packed scenes: bytes by part beside the gzipped source, load time (SCENES)
	@$(IN_SH) tests/measure/pack.sh

measure-baked: $(TOOL) ## baked light against truth; files and frames (SCENES, TURN=37, FILES=folder)
	@$(IN_SH) tests/measure/baked.sh

measure-edges: $(TOOL) $(B)/scenes ## baked light on stairs, shelves and in attics beside gathered light (TUNED, HELD_OUT)
	@$(IN_SH) tests/measure/baked_edges.sh

measure-crate: $(TOOL) ## error of an object that moves in baked light, which it neither blocks nor reflects (FRAME)
	@$(IN_SH) tests/measure/crate.sh

measure-front: $(TOOL) ## speed against error of gathered light, baked light and path tracing (SCENES, SETTINGS, LMT=folder)
	@$(IN_SH) tests/measure/front.sh

measure-lights: $(TOOL) $(B)/measure-lights ## baked light with twenty lights that were not there during baking (SCENES, LMT=folder)
	@$(IN_SH) tests/measure/lights.sh

measure-steady: $(TOOL) $(B)/measure-steady ## baked light that moves: steps, pops, shifts (SCENES, ONLY=halving); ONLY=bend: live light
	@$(IN_SH) tests/measure/steady.sh

scenes: $(B)/scenes ## a program that makes scenes from a name and a seed (scenes --list)

small-truth: $(B)/path ## makes tests/truth/small again with our own path tracer (NAMES): ten minutes
	@$(RUN) $(B)/path -o tests/truth/small $(NAMES)

measure-truth: $(TOOL) ## bounced light against truth: errors, work, time (SCENES, QUALITIES)
	@$(IN_SH) tests/measure/truth.sh

measure-own: $(TOOL) $(B)/scenes ## the same, and on our own scenes, tuned and held out (LMB_OWN_TRUTH=DIR)
	@$(IN_SH) tests/measure/own.sh

measure-defaults: $(TOOL) ## models without camera and light: whether they fill the frame, and their range of tones (MODELS)
	@python3 tests/measure/defaults.py $(TOOL) $(BUILD)/defaults $(MODELS)

measure-turned: $(TOOL) $(B)/scenes ## work and error of those scenes in random rotations (TURNS="1 2 ...")
	@$(IN_SH) tests/measure/turned.sh

measure-full: $(TOOL) ## six bounces against truth (SCENES, QUALITY=best, BOUNCES=20)
	@$(IN_SH) tests/measure/full.sh

measure-times: $(TOOL) ## seconds of a 640x480 frame by stage (SCENES, QUALITIES, THREADS, FRAME)
	@$(IN_SH) tests/measure/times.sh

measure-direct: $(TOOL) $(B)/scenes ## time of bounced light beside the time of direct light
	@$(IN_SH) tests/measure/direct.sh

report: $(BENCH) ## speed against error: pages in build/report, the README's table and picture
	@$(IN_SH) tests/measure/report.sh

STEP ?= 17
measure-cuts: $(B)/measure-cuts ## work saved by cuts, against all texels of a 1024 map (STEP=17th tile, SCENES)
	@$(RUN) $(B)/measure-cuts $(STEP) $(SCENES)

measure-relight: $(B)/measure-relight ## objects lit by their world: errors and time of filters and glossy lobes
	@$(IN_SH) tests/measure/relight.sh

measure-capture: $(TOOL) ## an object carried through Sponza, lit by captured cubes, against drawing it there (FRAME, FACES)
	@$(IN_SH) tests/measure/capture.sh

MAPS ?= $(addprefix ../shared/data/env/,forest_slope_512x256.hdr potsdamer_platz_512x256.hdr)
measure-contact: $(B)/measure-contact ## objects on a ground under maps, against path-traced pictures (MAPS)
	@mkdir -p $(B)/contact && for map in $(MAPS); do $(RUN) $(B)/measure-contact $(B)/contact $$map || exit 1; done

measure-export: $(B)/measure-export ## relight's files for other programs against plain sums over the map (MAPS, and four of our own)
	@mkdir -p $(B)/export && for map in $(MAPS) made:1 made:2 made:3 made:4; do $(RUN) $(B)/measure-export $(B)/export $$map || exit 1; done

measure-simplify: $(B)/measure-simplify ## errors of simplified meshes: distances, silhouettes, time
	@$(RUN) $(B)/measure-simplify

measure-planes: $(B)/measure-planes ## planes found in noisy depth against known ones, and from frame to frame
	@$(RUN) $(B)/measure-planes

measure-mixed: $(B)/measure-mixed ## a virtual object in a photo of a known scene, against truth
	@$(RUN) $(B)/measure-mixed

measure-rooms: $(B)/measure-rooms ## objects put into rooms of our own, against path-traced pictures (ROOMS="window ...")
	@mkdir -p $(B)/rooms && $(RUN) $(B)/measure-rooms $(B)/rooms $(ROOMS)

measure-sun: $(B)/measure-sun ## the light that mix estimates, against the light of path-traced photos (SUNS="1 16 100 16")
	@mkdir -p $(B)/suns && $(RUN) $(B)/measure-sun $(B)/suns $(SUNS)

CONSTANTS ?= 610 4 710 4
measure-constants: $(B)/measure-rooms $(B)/measure-sun ## constants of mix halved and doubled, in rooms that they were not tuned on (CONSTANTS)
	@ROOMS_OBJ='$(call measure_of,rooms) $(LIB)' SUN_OBJ='$(call measure_of,sun) $(LIB)' $(IN_SH) tests/measure/constants.sh $(CONSTANTS)

measure-sequence: $(TOOL) $(B)/measure-sequence $(B)/scenes ## sequences of noisy photos: flicker, frames a second (FRAME, COUNT, OBJECT)
	@$(IN_SH) tests/measure/sequence.sh

measure-voxels: $(B)/measure-voxels ## one bounce with cones through voxels: errors, time, memory (SCENES)
	@$(RUN) $(B)/measure-voxels $(SCENES)

measure-fixed: $(TOOL) $(B)/measure-fixed ## light by vertex in integers against lmb_render: errors (SCENES)
	@$(IN_SH) tests/measure/fixed.sh

ROWS ?= $(BUILD)/plan-rows.bin
measure-plan: $(TOOL) $(B)/scenes ## settings chosen for budgets of error (BUDGETS, LMB_OWN_TRUTH)
	@$(IN_SH) tests/measure/plan.sh

plan-model: $(B)/measure-plan ## makes src/frame/plan_model.inc again, from five scenes with many settings
	@rm -f $(ROWS); $(RUN) $(B)/measure-plan measure $(ROWS) demo cornell corridor point_room Duck; $(RUN) $(B)/measure-plan model $(ROWS) > $(ROWS).inc && mv $(ROWS).inc src/frame/plan_model.inc

RELIEFS ?= quality own rooms causes speed
measure-relief: $(B)/measure-relief ## reliefs against their complex models: errors, speed (RELIEFS="own ...")
	@$(RUN) $(B)/measure-relief $(RELIEFS)

paths: $(TOOL) $(LIB) ## the commands in the documents for new users, in a clean copy
	@CFLAGS='$(CFLAGS)' $(IN_SH) tests/scripts/paths.sh

.PHONY: places
places: ## make, make demo and make check without root, in a path with spaces, with umask 077, from a read-only clone (PLACES=umask)
	+@MAKE='$(MAKE)' $(IN_SH) tests/scripts/places.sh $(PLACES)

docs-check: $(TOOL) $(BENCH) $(LIB) ## code and commands of the documents; links and widths of the reference
	+@BUILD='$(BUILD)' MAKE='$(MAKE)' $(IN_SH) tests/scripts/docs_check.sh

large: $(TOOL) ## ten million triangles from a file to a picture; time and memory
	@$(IN_SH) tests/scripts/large.sh

##@ Other processors (PORT=cortex-m|riscv|cortex-a|aarch64|web builds for one)
tiny: $(TOOL) ## the demo in 256 KiB and a packed scene on a Cortex-M4F (qemu): the same pixels as here
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' TOOL='$(TOOL)' sh tests/scripts/tiny.sh

statue: $(TOOL) ## a relief in 512 KiB of ROM on a Cortex-M7 (qemu): the same pixels as here
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' TOOL='$(TOOL)' sh tests/scripts/statue.sh

live: $(TOOL) ## moving light in 160 KiB on a Cortex-M4F (qemu): the same pictures as here, instructions a frame
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' TOOL='$(TOOL)' sh tests/scripts/live.sh

.PHONY: ports screens console-abis
ports: ## the room on every port, in an emulator, against this machine: one table (PORTS="gba nds", ROOM=pixel)
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' PORTS='$(PORTS)' ROOM='$(ROOM)' sh tests/scripts/ports.sh

screens: ## consoles' screens after the path and with buttons, against this machine's pictures (PORTS="gba nds")
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' PORTS='$(PORTS)' sh tests/scripts/screens.sh

console-abis: ## the library for Microsoft's and System V's x86-64 with AVX2 and for AArch64, from C and from C++
	@$(IN_SH) tests/scripts/console_abis.sh

.PHONY: linux-fb null-port
null-port: ## a port that starts as a copy of platform/null, in a separate tree
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' sh tests/scripts/null_port.sh

linux-fb: ## the room on a file in place of Linux's framebuffer device
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' sh tests/scripts/linux_fb.sh
.PHONY: page-size web-check
page-size: ## the page of platform/web compiles and is small enough to load
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' sh tests/scripts/page_size.sh

# The page leaves out facets, so the program that computes its hashes does too.
web-check: $(TOOL) ## the page of platform/web in headless Chromium: clicks, drags, keys, files, hashes
	+@$(MAKE) BUILD='$(BUILD)/page-native' CFLAGS='$(CFLAGS) -DLMB_FACETS=0 -DLMB_LIVE=0' '$(BUILD)/page-native/default/page-hash'
	+@MAKE='$(MAKE)' BUILD='$(BUILD)' PAGE_HASH='$(BUILD)/page-native/default/page-hash' $(IN_SH) tests/scripts/web_check.sh

.PHONY: three-check
three-check: $(TOOL) ## baked light for other engines, drawn by three.js in headless Chromium beside our picture
	+@BUILD='$(BUILD)' $(IN_SH) tests/scripts/three_check.sh

.PHONY: godot-check
godot-check: $(TOOL) ## a baked lightmap, drawn by Godot 3 in software beside our picture
	+@BUILD='$(BUILD)' $(IN_SH) tests/scripts/godot_check.sh

# For compilers of programs that cannot run here.
.PHONY: compiles
compiles: $(LIB_OBJ)
	@echo "$(words $(LIB_OBJ)) passed, 0 failed, 0 skipped"

run-demo run-statue run-packed $(LIVE:%=run-%): run-%: $(B)/%
	@$(RUN) $<

# make run-NAME builds your own program from platform/FOLDER/main_NAME.c; the port's folder comes first. If the source
# uses scene_words, PACKED is linked too. PROGRAM, if set, lists all sources instead.
RUN_NAMES := demo statue packed $(LIVE)
OWN_NAMES := $(filter-out $(RUN_NAMES),$(patsubst run-%,%,$(filter run-%,$(MAKECMDGOALS))))
ROOM_MAIN := $(wildcard platform/demo/main_*.c)
own_mains  = $(filter-out $(ROOM_MAIN),$(wildcard platform/$(PORT)/main_$(1).c platform/*/main_$(1).c))
own_main   = $(firstword $(call own_mains,$(1)))
own_packed = $(if $(1),$(1) $(if $(shell grep -l scene_words $(1)),$(PACKED)))
own_source = $(or $(PROGRAM),$(call own_packed,$(call own_main,$(1))))
own_lists  = $(sort $(RUN_NAMES) $(patsubst main_%.c,%,$(notdir $(call own_mains,*))))
own_object = $(B)/own/$(1)/$(notdir $(basename $(2))).o
own_scene  = $(if $(shell grep -l demo_scene $(1)),tools/demo/demo_scene.c)
define own_compile
$(call own_object,$(1),$(2)): $(2) $(B)/flags $(B)/own/$(1)/sources
	@$$(COMPILE) -Iplatform -Iplatform/$(PORT) -c $$< -o $$@
endef
define own_program
$(B)/own/$(1)/sources: FORCE
	@mkdir -p $$(@D)
	@echo '$(2)' | cmp -s - $$@ || echo '$(2)' > $$@
$(foreach f,$(2),$(eval $(call own_compile,$(1),$(f))))
$(B)/own/$(1)/program: $(foreach f,$(2),$(call own_object,$(1),$(f))) $(call object,$(call own_scene,$(2)) $(PORT_SRC)) $(LIB_OBJ)
	@echo "LD $$@"
	@$$(LINK) -o $$@ $$^ $$(PORT_LDLIBS) $$(LDLIBS)
.PHONY: run-$(1)
run-$(1): COUNT := -icount shift=0
run-$(1): $(B)/own/$(1)/program
	@$$(RUN) $$<
endef
define own
$(if $(call own_source,$(1)),,$(error run-$(1): there is no program $(1); there are: $(own_lists). \
    Yours is platform/$(PORT)/main_$(1).c, or name it: make run-$(1) PROGRAM=FILE.c))
$(foreach f,$(call own_source,$(1)),$(if $(wildcard $(f)),,$(error run-$(1): \
    $(if $(PROGRAM),PROGRAM=$(PROGRAM),PACKED=$(PACKED)): there is no file $(f))))
$(call own_program,$(1),$(call own_source,$(1)))
endef
$(foreach n,$(OWN_NAMES),$(eval $(call own,$(n))))
-include $(wildcard $(OWN_NAMES:%=$(B)/own/%/*.d))
ifneq ($(PROGRAM),)
$(foreach n,$(filter $(RUN_NAMES:%=run-%),$(MAKECMDGOALS)),$(error $(n): lambent has this program; give that of PROGRAM another name))
endif

.PHONY: room run
room: $(ROOM_IMAGE) ## the program that all ports share (PORT=...)
run: $(ROOM_IMAGE) ## runs the room in the port's emulator: hashes, costs
	@$(ROOM_RUN) $<

# Sets CROSS_TARGETS and MORE_CROSS_TARGETS, and for each target needs_NAME and how_NAME.
include platform/gl/gl.mk
include tests/scripts/targets.mk

# build_NAME: the folder of another job that was built with the same flags.
cross_build = $(or $(build_$(1)),$(BUILD)/cross/$(1))
define cross_sum
	@LOGS=$(B)/check sh tests/scripts/part.sh same sh tests/scripts/same.sh $(1:%=$(B)/check/cross-%.log)
	@LOGS=$(B)/check sh tests/scripts/part.sh stacks sh tests/scripts/stacks.sh 4096 $(foreach t,$(1),$(call cross_build,$(t)))
	@sh tests/scripts/sum.sh $(1:%=$(B)/check/cross-%.log) $(B)/check/same.log $(B)/check/stacks.log
endef

.PHONY: cross-all more-tools $(CROSS_TARGETS:%=cross-%) $(MORE_CROSS_TARGETS:%=cross-%)
cross: $(CROSS_TARGETS:%=cross-%) ## golden pictures with other compilers and processors; installs missing packages (EACH=3: a third of them in emulators)
	$(call cross_sum,$(CROSS_TARGETS))

cross-all: $(CROSS_TARGETS:%=cross-%) $(MORE_CROSS_TARGETS:%=cross-%) ## the same for all targets of tests/scripts/targets.mk
	$(call cross_sum,$(CROSS_TARGETS) $(MORE_CROSS_TARGETS))

$(CROSS_TARGETS:%=cross-%): check-tools
$(MORE_CROSS_TARGETS:%=cross-%): more-tools
$(CROSS_TARGETS:%=cross-%) $(MORE_CROSS_TARGETS:%=cross-%): NEEDS = $(needs_$(@:cross-%=%))
$(sort $(CROSS_TARGETS:%=cross-%) $(MORE_CROSS_TARGETS:%=cross-%)): cross-%:
	+@$(RUN_PART) cross-$* $(MAKE) $(or $(goal_$*),golden) BUILD=$(call cross_build,$*) $(how_$*)

# One installer at a time, with all packages that cross-all needs.
more-tools: check-tools
	@sh tests/scripts/tools.sh get $(sort $(foreach m,$(MORE_CROSS_TARGETS),$(needs_$(m))))

check-tools: ## installs missing tools of the checks with apt-get, and lists those that stay missing
	@sh tests/scripts/tools.sh get
