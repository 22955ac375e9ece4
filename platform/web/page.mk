# page.mk: `make PORT=web page`: builds the page in $(B)/page with Debian's wasi-libc; the host's tool bakes the light.
#
# One module has everything except the kernels. Two others have the kernels, scalar and simd128, linked for fixed
# addresses in the memory that all import; lambent.js joins one of them to the first. The memory is shared, but only
# page_pool.c uses atomics: only the worker that draws calls the C library.

PAGE      := $(B)/page
# PAGE_OPT=-O0: only checks that it links, in a separate folder.
PAGE_WORK := $(B)/page-work$(PAGE_OPT)
WASI      ?= /usr
PAGE_LIBC := $(WASI)/lib/wasm32-wasi
PAGE_RT    = $(firstword $(wildcard $(WASI)/lib/llvm-*/lib/clang/*/lib/wasi/libclang_rt.builtins-wasm32.a))
PAGE_SRC  := $(filter-out src/isa/% tools/common/io_file.c tools/relief/verb_relief_bake.c tools/relief/relief_compare.c tools/relief/relief_path.c tools/common/key_path.c tools/relief/relief_model.c \
             tools/relief/relief_crowd.c tools/relief/relief_crowd_read.c tools/relief/relief_photos.c tools/relief/relief_sky.c tools/relief/relief_withheld.c \
             tools/relight/relight_hidden.c tools/relight/relight_lobes.c tools/render/wireframe.c tools/render/blended.c tools/render/budget.c tools/render/scene_sample.c tools/render/bench_calibrate.c \
             %/gen_demo.c %/gen_srgb.c %/demo_scene.c tools/picture/io_png_write.c tools/picture/io_deflate.c tools/picture/io_pam.c tools/picture/io_jpeg_exif.c tools/model/io_gltf_crowd.c \
             tools/common/slice.c tools/common/merge.c tools/common/slice_items.c tools/common/byte_buffer.c tools/render/render_slice.c tools/common/area_light.c \
             tools/mix/mix_sun.c tools/mix/mix_cast.c tools/mix/mix_labels.c tools/mix/mix_grain.c tools/mix/mix_block.c tools/mix/mix_swift.c tools/mix/mix_placements.c tools/mix/mix_resample.c tools/mix/mix_islands.c tools/mix/mix_front.c tools/mix/mix_list.c tools/mix/mix_frames.c tools/mix/mix_again.c tools/mix/mix_lobes.c tools/mix/mix_sources.c tools/mix/mix_mirror.c tools/mix/mix_contact.c tools/mix/mix_inside.c tools/mix/mix_around.c tools/mix/mix_carry.c tools/mix/mix_near.c tools/mix/mix_lights.c tools/mix/mix_next.c tools/mix/mix_aside.c tools/mix/mix_stays.c tools/mix/mix_world.c tools/mix/mix_sequence.c tools/model/glb_write.c tools/relight/relight_worlds.c tools/relight/relight_path.c tools/relight/relight_contact.c tools/relight/relight_region.c tools/relight/relight_ground.c tools/relight/relight_samples.c tools/relight/relight_shade.c tools/relight/relight_export.c tools/relight/relight_way.c tools/relight/relight_many.c, \
             $(sort $(wildcard src/*/*.c $(foreach d,common picture mesh model demo render relight relief mix,tools/$(d)/*.c) \
             platform/web/page/*.c)))
PAGE_KERNELS := src/base/codec.c src/base/poly.c src/bounce/polygon.c src/raster/plane.c src/raster/texture.c
PAGE_FLAGS := --target=wasm32-wasi -isystem $(WASI)/include/wasm32-wasi -std=c99 -ffp-contract=off -fno-math-errno \
              -fno-builtin-bcmp -flto -mbulk-memory -Wall -Wextra -Iinclude -D_WASI_EMULATED_SIGNAL -DOPTIONS_WITHOUT_HELP -DGLTF_WITHOUT_CROWDS -DWORLD_WITHOUT_LAMPS -DLMB_CULLING=0 -DLMB_LIVE=0 -DLMB_DRAW=0 -DLMB_FACETS=0 \
              -mnontrapping-fptoint -msign-ext -MMD -MP
# Below the module's data and 1 MiB of stack: 128 KiB each for the data of the kernels and of the
# demo, and unused stacks.
PAGE_LINK := wasm-ld -O2 --compress-relocations --no-entry --import-memory --shared-memory --no-check-features \
             --max-memory=2147483648 --gc-sections --strip-all --export=__stack_pointer --export-table --growable-table
PAGE_MAIN := -mllvm -inline-threshold=-30 -mllvm -enable-merge-functions -z stack-size=1048576 --global-base=262144 --initial-memory=33554432 --export=__wasm_call_ctors
PAGE_SIDE := -z stack-size=16 --global-base
# Optimises hot code of frames for speed; the rest, and code that runs once a scene or for few pixels, for size.
PAGE_FAST := src/raster/% src/transfer/% src/occlusion/% src/direct/shadow.c
PAGE_ONCE := src/occlusion/build.c src/occlusion/occlude.c src/raster/texture.c src/raster/bins.c src/raster/cluster.c src/occlusion/occluded.c src/occlusion/hull.c src/occlusion/sun.c \
             $(patsubst %,src/raster/%.c,clip draw draw_one fill lookup paint plane resolve setup target triangle) \
             src/transfer/transfer.c $(patsubst %,src/transfer/transfer_%.c,air collect light many_lights materials send)
page_opt   = $(or $(PAGE_OPT),$(if $(filter $(PAGE_FAST),$(filter-out $(PAGE_ONCE),$(1))),-O2 -fno-unroll-loops,-Oz))

# $(1): a folder of objects, $(2): flags, $(3): how they are optimised.
define page_objects
$(PAGE_WORK)/$(1)/%.o: %.c $(PAGE_WORK)/flags
	@mkdir -p $$(@D)
	@clang $(PAGE_FLAGS) $(2) $(3) $$(if $$(findstring page_pool,$$<),-matomics -mbulk-memory) -c $$< -o $$@
endef
$(eval $(call page_objects,main,,$$(call page_opt,$$<)))
$(eval $(call page_objects,scalar,,$(or $(PAGE_OPT),-Oz)))
# The lanes of plain C determine the layout of structs shared by modules: one lane, as without simd128.
$(eval $(call page_objects,simd,-msimd128 -DLMB_PLAIN_LANES=1,$(or $(PAGE_OPT),-O2 -fno-unroll-loops)))
-include $(patsubst %.c,$(PAGE_WORK)/main/%.d,src.c $(PAGE_SRC)) \
         $(wildcard $(PAGE_WORK)/scalar/*/*/*.d $(PAGE_WORK)/simd/*/*/*.d)

export PAGE_LINE := $(PAGE_FLAGS) $(PAGE_FAST) $(PAGE_ONCE)
$(PAGE_WORK)/flags: FORCE
	@mkdir -p $(@D)
	@printf '%s\n' "$$PAGE_LINE" | cmp -s - $@ || printf '%s\n' "$$PAGE_LINE" > $@

# At -O0 the library is compiled as one unit, because starting clang 130 times takes longer than compiling.
PAGE_UNIT := $(if $(filter -O0,$(PAGE_OPT)),$(filter src/%,$(PAGE_SRC)))
$(PAGE_WORK)/main/src.o: $(PAGE_UNIT) $(PAGE_WORK)/flags platform/web/page.mk
	@mkdir -p $(@D)
	@printf '#include "%s"\n' $(PAGE_UNIT) | clang $(PAGE_FLAGS) $(PAGE_OPT) -MT $@ -MF $(@:.o=.d) -x c -c - -o $@

PAGE_OBJ := $(patsubst %.c,$(PAGE_WORK)/main/%.o,$(if $(PAGE_UNIT),src.c) $(filter-out $(PAGE_UNIT),$(PAGE_SRC)))
$(PAGE_WORK)/lambent.wasm: $(PAGE_OBJ)
	@echo "LD $@"
	@$(PAGE_LINK) $(PAGE_MAIN) -o $@ $^ $(PAGE_LIBC)/libm.a $(PAGE_LIBC)/libc.a $(PAGE_RT)
$(PAGE_WORK)/kernels_scalar.wasm: $(patsubst %.c,$(PAGE_WORK)/scalar/%.o,src/isa/isa_scalar.c $(PAGE_KERNELS))
	@$(PAGE_LINK) $(PAGE_SIDE)=1024 --export=lmb_kernels_scalar -o $@ $^ $(PAGE_LIBC)/libc.a
$(PAGE_WORK)/kernels_simd.wasm: $(patsubst %.c,$(PAGE_WORK)/simd/%.o,src/isa/isa_simd128.c $(PAGE_KERNELS))
	@$(PAGE_LINK) $(PAGE_SIDE)=1024 --export=lmb_kernels_simd128 -o $@ $^ $(PAGE_LIBC)/libc.a

$(PAGE_WORK)/demo.wasm: $(patsubst %.c,$(PAGE_WORK)/scalar/%.o,tools/demo/demo_scene.c src/base/view.c src/base/poly.c)
	@$(PAGE_LINK) $(PAGE_SIDE)=131072 --export=demo_scene --export=demo_view -o $@ $^ $(PAGE_LIBC)/libm.a \
	    $(PAGE_LIBC)/libc.a

# Four bits of context suit the large module; three, and one of position, suit the others; two suit text.
$(PAGE)/%.wasm.lzma: $(PAGE_WORK)/%.wasm
	@mkdir -p $(@D)
	@xz --format=lzma --lzma1=preset=9e,$(if $(filter lambent,$*),pb=0$(comma)lc=4,pb=1$(comma)lc=3$(comma)nice=128) -c $< > $@

# Removes comments and indentation; in files that are not compressed also the blanks of ` = `, which no text there has.
PAGE_BARE := sed -e 's/^ *//' -e '/^\/\/ /d' -e 's|\([;{},)]\)  *// .*|\1|' -e '/^$$/d'
$(PAGE)/%: platform/web/page/%
	@mkdir -p $(@D)
	@$(PAGE_BARE) -e 's/ = /=/g' $< > $@
$(PAGE)/page.js.lzma $(PAGE)/body.html.lzma: $(PAGE)/%.lzma: platform/web/page/%
	@mkdir -p $(@D)
	@$(PAGE_BARE) $< | xz --format=lzma --lzma1=preset=9e,pb=0,lc=2 > $@

.PHONY: page page-loads page-modules
page-modules: $(patsubst %,$(PAGE_WORK)/%.wasm,lambent kernels_scalar kernels_simd demo)

page: page-loads
	+@$(MAKE) PORT=host BUILD=$(HOST_BUILD) all $(HOST_BUILD)/default/scenes
	@sh platform/web/page_scenes.sh $(HOST_BUILD)/lambent $(HOST_BUILD)/default/scenes $(PAGE)

# Everything except the scenes, which need the host's tool.
page-loads: $(patsubst %,$(PAGE)/%.wasm.lzma,lambent kernels_scalar kernels_simd demo) $(PAGE)/index.html \
            $(PAGE)/lambent.js $(PAGE)/page.js.lzma $(PAGE)/body.html.lzma
	@cd $(PAGE) && cat index.html lambent.js page.js.lzma body.html.lzma lambent.wasm.lzma kernels_simd.wasm.lzma | wc -c \
	    | sed 's/$$/ bytes that a browser loads, without scenes/'
