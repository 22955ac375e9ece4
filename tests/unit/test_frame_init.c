/* test_frame_init.c: layer 8: frames in one block: exactly lmb_frame_bytes between protected pages; one byte less is
 * refused; the same bytes as frames with separately allocated memory. */
#if !defined(_WIN32)
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include <sys/mman.h>
#include <unistd.h>
#endif
#include <lambent/lambent.h>

#include <stdlib.h>

#include "../../tools/demo/demo_scene.h"
#include "../world.h"

void test_frame_init(void);

enum { WIDE = 24, HIGH = 13, MAP = 64, ODD_CELLS = 16 };

static lmb_render render;
static uint32_t own_picture[WIDE * HIGH * 3];
static lmb_light lights[3];
static lmb_scene lit;     /* the demo with one light */
static lmb_scene emitting; /* a room without lights and with one emissive wall */
static lmb_scene empty;    /* no triangles, no lights */
static lmb_many_lights many_lights;

/* --- a block between protected pages ------------------------------------------------------------------------------ */

typedef struct fenced {
    uint8_t *whole, *block; /* block: starts or ends at a page border */
    size_t bytes, text_buffer;
} fenced;

#if defined(_WIN32)
static void fence(fenced *f, size_t bytes, int at_end)
{
    (void)at_end;
    f->block = f->whole = malloc(bytes);
}
static void unfence(fenced *f) { free(f->whole); }
#else
static void fence(fenced *f, size_t bytes, int at_end)
{
    f->text_buffer = (size_t)sysconf(_SC_PAGESIZE);
    const size_t inner = (bytes + f->text_buffer - 1) / f->text_buffer * f->text_buffer;
    f->bytes = inner + 2 * f->text_buffer;
    f->whole = mmap(NULL, f->bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    f->block = f->whole + f->text_buffer + (at_end ? inner - bytes : 0);
    if (f->whole == MAP_FAILED || mprotect(f->whole + f->text_buffer, inner, PROT_READ | PROT_WRITE) != 0) {
        abort();
    }
}
static void unfence(fenced *f) { munmap(f->whole, f->bytes); }
#endif

/* --- frames ------------------------------------------------------------------------------------------------------- */

typedef struct kind {
    const char *name;
    lmb_frame_settings settings;
} kind;

static lmb_frame_settings plain(const lmb_scene *scene)
{
    lmb_frame_settings s;
    memset(&s, 0, sizeof s);
    s.kernels = picked_kernels();
    s.scene = scene;
    s.view = demo_view(WIDE, HIGH);
    s.shadow_map = MAP;
    return s;
}

static void make_scenes(void)
{
    static uint64_t many_lights_memory[ODD_CELLS * 720 / 8];
    world_begin(0.7f, 0.6f, 0.5f);
    world_quad(vec3(0, 1, -2), vec3(2, 0, 0), vec3(0, 1, 0));
    world_part();
    world_quad(vec3(0, 0, 0), vec3(2, 0, 0), vec3(0, 0, -2));
    world.material[0].emission[1] = 2.0f;
    CHECK(world_end() == LMB_OK);
    emitting = world.scene;
    lit = *demo_scene();
    for (int i = 0; i < COUNT(lights); ++i) {
        lights[i] = point_light(vec3(0.4f * (float)i, 1.5f, 0.3f));
    }
    CHECK(lmb_many_lights_bytes(ODD_CELLS) <= sizeof many_lights_memory);
    CHECK(lmb_many_lights_init(&many_lights, ODD_CELLS, vec3(-9, -9, -9), vec3(9, 9, 9), 1e4f, many_lights_memory,
                               sizeof many_lights_memory) == LMB_OK);
    CHECK(lmb_many_lights_add(&many_lights, lights, COUNT(lights)) == LMB_OK &&
          lmb_many_lights_build(&many_lights) == LMB_OK);
}

/* Every optional part of a block, present or not. */
static int make_kinds(kind *out)
{
    int n = 0;
#define KIND(what, from) (out[n].name = what, out[n].settings = plain(from), &out[n++].settings)
    lmb_frame_settings *s = KIND("default", &lit);
    s = KIND("draft, three threads", &lit), s->quality = LMB_QUALITY_DRAFT, s->threads = 3;
    s = KIND("two bounces", &lit), s->bounces = 2, s->elements = 256, s->quality = LMB_QUALITY_DRAFT;
    s = KIND("tree given", &lit), s->tree = 16, s->error = 0.1f, s->visibility = 0.2f, s->id_format = LMB_ID32;
    s = KIND("direct", &lit), s->show = LMB_SHOW_DIRECT, s->format = LMB_RGB565;
    s = KIND("cuts by bands", &lit), s->by_bands = 1, s->format = LMB_RGB32F;
    s = KIND("fixed", &lit), s->quality = LMB_QUALITY_FIXED;
    s = KIND("fixed by bands", &lit), s->quality = LMB_QUALITY_FIXED, s->by_bands = 1, s->points = 700;
    s = KIND("live by bands", &lit), s->gather_step = LMB_GATHER_LIVE, s->by_bands = 1, s->format = LMB_RGB32F;
    s = KIND("live", &lit), s->gather_step = LMB_GATHER_LIVE, s->quality = LMB_QUALITY_DRAFT, s->threads = 2;
    s = KIND("live, many", &lit), s->gather_step = LMB_GATHER_LIVE, s->many_lights = &many_lights;
    s = KIND("own picture", &lit), s->shadow_map = 32;
    CHECK(lmb_surface_init(&s->out, LMB_RGBA8, WIDE, HIGH, own_picture, sizeof own_picture) == LMB_OK);
    s = KIND("emitting", &emitting), s->elements = 64;
    s = KIND("many", &emitting), s->many_lights = &many_lights, s->elements = 256;
    s = KIND("many, direct", &lit), s->many_lights = &many_lights, s->show = LMB_SHOW_DIRECT;
    s = KIND("many, fixed", &lit), s->many_lights = &many_lights, s->quality = LMB_QUALITY_FIXED;
    s = KIND("nothing", &empty);
#undef KIND
    return n;
}

static uint64_t picture_hash;

static int add_rows(void *user, const lmb_surface *rows, int32_t y)
{
    lmb_surface part = *rows;
    part.height = mini(HIGH - y, LMB_TILE);
    (void)user;
    picture_hash = picture_hash * 31 + lmb_surface_hash(&part);
    return 0;
}

/* Hashes bands of 8 rows, whether or not a callback receives them. */
static uint64_t drawn_hash(lmb_frame *f)
{
    picture_hash = 0;
    f->callback = f->out.height == LMB_TILE ? add_rows : NULL;
    CHECK(lmb_render_frame(&render, f) == LMB_OK);
    for (int32_t y = 0; y < HIGH && f->out.height != LMB_TILE; y += LMB_TILE) {
        lmb_surface rows = f->out;
        rows.data = (uint8_t *)f->out.data + (ptrdiff_t)y * f->out.stride_bytes;
        rows.height = LMB_TILE;
        add_rows(NULL, &rows, y);
    }
    return picture_hash;
}

/* A part's memory, followed by a protected page. */
static void *part(fenced *f, size_t bytes)
{
    fence(f, (bytes + 15) / 16 * 16, 1);
    return f->block;
}

/* The same frame with separate memory for each part. */
static uint64_t by_hand_hash(const lmb_frame *like)
{
    static uint32_t depth[WIDE * (HIGH + 8)], id[WIDE * (HIGH + 8)], picture[WIDE * HIGH * 3], whole[WIDE * (HIGH + 8)];
    static lmb_band_scratch scratch;
    static lmb_groups groups;
    static lmb_live live;
    static lmb_live_scratch live_scratch;
    lmb_frame f = *like;
    const size_t tree = lmb_tree_bytes(f.tree.face_cap, f.tree.size);
    const size_t bvh = lmb_bvh_bytes(f.bvh.triangle_cap);
    fenced memory[7];
    for (int i = 0; i < COUNT(memory); ++i) {
        memory[i].whole = NULL;
    }
    f.map_memory = part(&memory[0], f.map_bytes);
    f.scratch = &scratch;
    CHECK(lmb_surface_init(&f.eye.depth, LMB_DEPTH32F, WIDE, f.eye.depth.height, depth, sizeof depth) == LMB_OK);
    CHECK(lmb_surface_init(&f.eye.id, f.id_format, WIDE, f.eye.id.height, id, sizeof id) == LMB_OK);
    CHECK(lmb_surface_init(&f.out, f.out.format, WIDE, f.out.height, picture, sizeof picture) == LMB_OK);
    if (f.eye_depth.data != NULL) {
        CHECK(lmb_surface_init(&f.eye_depth, f.eye_depth.format, WIDE, HIGH, whole, sizeof whole) == LMB_OK);
    }
    if (f.tree.texel != NULL) {
        CHECK(lmb_tree_init(&f.tree, f.tree.face_cap, f.tree.size, part(&memory[1], tree), tree) == LMB_OK);
    }
    if (f.bvh.triangle != NULL) {
        CHECK(lmb_bvh_init(&f.bvh, f.bvh.triangle_cap, part(&memory[2], bvh), bvh) == LMB_OK);
    }
    if (f.elements.data != NULL) {
        const size_t bytes = lmb_elements_bytes(f.elements.cap);
        CHECK(lmb_elements_init(&f.elements, f.elements.cap, part(&memory[3], bytes), bytes) == LMB_OK);
    }
    if (f.points.data != NULL) {
        const size_t points = lmb_points_bytes(f.points.cap, MAP / LMB_TILE);
        f.groups = &groups;
        CHECK(lmb_points_init(&f.points, f.points.cap, MAP / LMB_TILE, part(&memory[4], points), points) == LMB_OK);
    }
    if (f.lattice.tile != NULL) {
        const size_t bytes = lmb_lattice_bytes(WIDE, HIGH);
        CHECK(lmb_lattice_init(&f.lattice, WIDE, HIGH, part(&memory[5], bytes), bytes) == LMB_OK);
    }
    if (f.live != NULL) {
        const size_t bytes = lmb_live_bytes(f.live->face_cap, f.live->side, f.live->element_cap);
        CHECK(lmb_live_init(&live, f.live->face_cap, f.live->side, f.live->element_cap, part(&memory[6], bytes),
                            bytes) == LMB_OK);
        live.strata = f.live->strata;
        live.split = f.live->split;
        f.live = &live;
        scratch.live = &live_scratch;
    }
    const uint64_t hash = drawn_hash(&f);
    for (int i = 0; i < COUNT(memory); ++i) {
        if (memory[i].whole != NULL) {
            unfence(&memory[i]);
        }
    }
    return hash;
}

static void test_block(const kind *k)
{
    static lmb_frame f, before;
    const size_t bytes = lmb_frame_bytes(&k->settings);
    uint64_t hash[2] = {0, 0};
    CHECK_MSG(bytes > 0, "%s", k->name);
    for (int at_end = 0; at_end < 2 && bytes > 0; ++at_end) {
        fenced block;
        fence(&block, bytes, at_end);
        memset(block.block, 0xa5, bytes);
        memset(&f, 0x5a, sizeof f);
        before = f;
        CHECK_MSG(lmb_frame_init(&f, &k->settings, block.block, bytes - 1) == LMB_ERR_CAPACITY, "%s", k->name);
        CHECK_MSG(lmb_frame_init(&f, &k->settings, block.block + 4, bytes) == LMB_ERR_ALIGN, "%s", k->name);
        CHECK_MSG(memcmp(&f, &before, sizeof f) == 0 && block.block[0] == 0xa5, "%s", k->name);
        CHECK_MSG(lmb_frame_init(&f, &k->settings, block.block, bytes) == LMB_OK, "%s", k->name);
        hash[at_end] = drawn_hash(&f);
        CHECK_MSG(at_end == 0 || hash[0] == by_hand_hash(&f), "%s", k->name);
        unfence(&block);
    }
    CHECK_MSG(hash[0] == hash[1] && hash[0] != 0, "%s", k->name);
}

/* The bytes of a plan, which counts one thread's scratch, are those of the block and of a picture outside it. */
static void test_planned_bytes(const kind *k)
{
#if LMB_PLAN
    static lmb_frame f;
    static lmb_plan plan;
    lmb_frame_settings s = k->settings;
    s.threads = 1;
    const size_t bytes = lmb_frame_bytes(&s);
    const double all = (double)bytes + (s.out.data != NULL ? 4.0 * WIDE * HIGH : 0.0);
    fenced block;
    fence(&block, bytes, 0);
    CHECK(lmb_frame_init(&f, &s, block.block, bytes) == LMB_OK);
    CHECK_MSG(lmb_render_begin(&render, &f) == LMB_OK && lmb_plan_frame(&plan, &render, 0.0, 0.0) == LMB_OK, "%s", k->name);
    CHECK_MSG((double)plan.bytes > 0.98 * all && (double)plan.bytes < 1.02 * all, "%s: %.0f of %.0f bytes", k->name,
              (double)plan.bytes, all);
    unfence(&block);
#else
    (void)k;
#endif
}

/* Each thread's scratch is adjacent, complete, and zero. */
static void test_threads(void)
{
    lmb_frame_settings s = plain(&lit), one = s;
    lmb_frame f;
    s.threads = 3;
    const size_t bytes = lmb_frame_bytes(&s);
    uint8_t *memory = malloc(bytes);
    memset(memory, 0xff, bytes);
    CHECK(bytes + 64 > lmb_frame_bytes(&one) + 2 * sizeof(lmb_band_scratch)); /* each part is rounded up to 64 */
    CHECK(lmb_frame_init(&f, &s, memory, bytes) == LMB_OK);
    for (size_t i = 0; i < 3 * sizeof(lmb_band_scratch); ++i) {
        if (((const uint8_t *)f.scratch)[i] != 0) {
            CHECK_MSG(0, "byte %lu of the scratches", (unsigned long)i);
            break;
        }
    }
    memset(f.scratch, 0xff, 3 * sizeof(lmb_band_scratch));
    const uint64_t hash = drawn_hash(&f);
    CHECK(hash == by_hand_hash(&f));
    free(memory);
}

/* Zeros select the tool's defaults. */
static void test_defaults(void)
{
    lmb_frame_settings s = plain(&lit);
    lmb_frame f;
    s.shadow_map = 0;
    const size_t bytes = lmb_frame_bytes(&s);
    void *memory = malloc(bytes);
    CHECK(lmb_frame_init(&f, &s, memory, bytes) == LMB_OK);
    CHECK(f.shadow_map == 1024 && f.tree.size == 256 && f.tree.face_cap == 1);
    CHECK(f.occlusion == LMB_OCCLUSION_EXACT && f.grouping.method == LMB_GROUP_CUT && f.elements.data == NULL);
    CHECK(f.id_format == LMB_ID16 && f.out.format == LMB_RGBA8 && f.out.width == WIDE && f.out.height == HIGH);
    CHECK(f.bvh.triangle_cap == lmb_scene_triangles(&lit) && f.kernels == picked_kernels());
    s.quality = LMB_QUALITY_BEST;
    s.shadow_map = 512;
    CHECK(lmb_frame_bytes(&s) == 0 || lmb_frame_init(&f, &s, memory, 0) == LMB_ERR_CAPACITY);
    free(memory);
    lit.lights = lights;
    lit.light_count = 3; /* eighteen faces: the share of 2^21 texels per map is under 512 x 512 */
    s = plain(&lit);
    s.shadow_map = 0;
    memory = malloc(lmb_frame_bytes(&s));
    CHECK(lmb_frame_init(&f, &s, memory, lmb_frame_bytes(&s)) == LMB_OK && f.shadow_map == 256 &&
          f.tree.face_cap == 18);
    free(memory);
    lit = *demo_scene();
}

static void test_refused(void)
{
    static uint64_t memory[8];
    static lmb_light crowd[LMB_MAX_LIGHTS + 1];
    lmb_frame_settings s = plain(&lit);
    lmb_frame f;
#define REFUSED(change, why) \
    do { \
        s = plain(&lit); \
        change; \
        CHECK_MSG(lmb_frame_bytes(&s) == 0, #change); \
        CHECK_MSG(lmb_frame_init(&f, &s, memory, sizeof memory) == (why), #change); \
    } while (0)
    REFUSED(s.scene = NULL, LMB_ERR_ARG);
    REFUSED(s.view.frame_width = 0, LMB_ERR_ARG);
    REFUSED(s.view.frame_height = LMB_MAX_SIDE + 1, LMB_ERR_ARG);
    REFUSED(s.show = 4, LMB_ERR_ARG);
    REFUSED(s.quality = 4, LMB_ERR_ARG);
    REFUSED(s.bounces = LMB_MAX_BOUNCES + 1, LMB_ERR_ARG);
    REFUSED((s.bounces = 2, s.quality = LMB_QUALITY_FIXED), LMB_ERR_ARG);
#if LMB_TRANSFER
    lmb_transfer baked; /* reflects as often as you like, also without trees; an empty one is enough for direct light */
    memset(&baked, 0, sizeof baked);
    s = plain(&lit), s.bounces = 2, s.quality = LMB_QUALITY_FIXED, s.transfer = &baked, s.show = LMB_SHOW_DIRECT;
    CHECK(lmb_frame_bytes(&s) > 0);
#endif
    REFUSED((s.grouping.method = LMB_GROUP_CUT, s.quality = LMB_QUALITY_FIXED), LMB_ERR_ARG);
    REFUSED((s.grouping.block = 3, s.quality = LMB_QUALITY_FIXED), LMB_ERR_ARG);
    REFUSED(s.threads = 1025, LMB_ERR_ARG);
    REFUSED((s.threads = 2, s.by_bands = 1), LMB_ERR_ARG);
    REFUSED(s.shadow_map = 60, LMB_ERR_ARG);
    REFUSED(s.shadow_map = 96, LMB_ERR_ARG); /* without a tree */
    REFUSED(s.tree = 24, LMB_ERR_ARG);
    REFUSED((s.bounces = 2, s.elements = 100), LMB_ERR_ARG);
    REFUSED(s.error = -1.0f, LMB_ERR_ARG);
    REFUSED(s.error = NAN, LMB_ERR_ARG);
    REFUSED(s.visibility = -1.0f, LMB_ERR_ARG);
    REFUSED(s.format = LMB_DEPTH16, LMB_ERR_FORMAT);
    REFUSED(s.format = 99, LMB_ERR_FORMAT);
    REFUSED(s.id_format = LMB_RGBA8, LMB_ERR_FORMAT);
    lmb_mesh mesh = lit.meshes[lit.instances[0].mesh];
    lmb_instance instance = lit.instances[0];
    lmb_scene large = lit;
    mesh.triangle_count = 65536;
    large.meshes = &mesh, large.mesh_count = 1, instance.mesh = 0;
    large.instances = &instance, large.instance_count = 1;
    REFUSED((s.scene = &large, s.id_format = LMB_ID16), LMB_ERR_SCENE);
    for (int i = 0; i < COUNT(crowd); ++i) {
        crowd[i] = lights[0];
    }
    lmb_scene crowded = lit;
    crowded.lights = crowd;
    crowded.light_count = LMB_MAX_LIGHTS + 1;
    REFUSED(s.scene = &crowded, LMB_ERR_CAPACITY);
    crowded.light_count = LMB_MAX_LIGHTS; /* more points than 32 bits can count */
    REFUSED((s.scene = &crowded, s.quality = LMB_QUALITY_FIXED, s.shadow_map = LMB_MAX_SIDE, s.grouping.block = 1),
            LMB_ERR_ARG);
#undef REFUSED
    CHECK(lmb_frame_bytes(NULL) == 0);
}

#if LMB_TREES && !defined(LMB_CONFIG_TINY)

void test_frame_init(void)
{
    static kind kinds[18];
    make_scenes();
    for (int i = 0, n = make_kinds(kinds); i < n; ++i) {
        test_block(&kinds[i]);
        test_planned_bytes(&kinds[i]);
    }
    kinds[0].name = "live, samples"; /* by_hand_hash has no memory for samples */
    kinds[0].settings.gather_step = LMB_GATHER_LIVE;
    kinds[0].settings.samples = 4;
    test_planned_bytes(&kinds[0]);
    test_threads();
    test_defaults();
    test_refused();
}

#else

void test_frame_init(void)
{
    (void)test_block, (void)test_planned_bytes, (void)test_threads, (void)test_defaults, (void)test_refused, (void)make_kinds, (void)make_scenes;
}

#endif
