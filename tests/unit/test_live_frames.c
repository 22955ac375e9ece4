/* test_live_frames.c: LMB_GATHER_LIVE: few samples if the light is smooth, otherwise more, and the same bytes in any
 * order, with any bands, threads and backends. */
#include <lambent/lambent.h>

#include <stdlib.h>

#include "../../src/frame/live_grid.h"
#include "lambent/plan.h"
#include "../../tools/demo/demo_scene.h"
#include "../reused_frame.h"
#include "../laid_out.h"
#include "../world.h"

void test_live_frames(void);

/* --- memory ------------------------------------------------------------------------------------------------------- */

static void test_memory(void)
{
    static uint64_t lattice_memory[1024];
    lmb_lattice l;
    const size_t bytes = lmb_lattice_bytes(16, 9);
    CHECK(bytes > 4 * GRID_SAMPLES * sizeof(lmb_live_sample) && bytes <= sizeof lattice_memory - 4);
    CHECK(lmb_lattice_bytes(0, 9) == 0 && lmb_lattice_bytes(9, -1) == 0 && lmb_lattice_bytes(LMB_MAX_SIDE + 1, 9) == 0);
    CHECK(lmb_lattice_init(NULL, 16, 9, lattice_memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_lattice_init(&l, 16, 9, NULL, bytes) == LMB_ERR_ARG);
    CHECK(lmb_lattice_init(&l, 16, 0, lattice_memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_lattice_init(&l, 16, 9, (char *)lattice_memory + 4, bytes) == LMB_ERR_ALIGN);
    CHECK(lmb_lattice_init(&l, 16, 9, lattice_memory, bytes - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_lattice_init(&l, 16, 9, lattice_memory, bytes) == LMB_OK && l.width == 16 && l.height == 9);
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

static lmb_render render;
static lmb_band_scratch other_scratch;
static lmb_live_scratch other_live;

static lmb_frame_settings settings_of(const lmb_scene *scene, lmb_view view, int32_t step)
{
    lmb_frame_settings s = draft_settings(scene, view);
    s.show = LMB_SHOW_IRRADIANCE;
    s.gather_step = step;
    return s;
}

static uint64_t rows_hash;

static int add_rows(void *user, const lmb_surface *rows, int32_t y)
{
    const uint8_t *data = rows->data;
    for (int32_t i = 0; i < rows->height * rows->width * 12; ++i) {
        rows_hash =
            (rows_hash ^ data[(ptrdiff_t)(i / (rows->width * 12)) * rows->stride_bytes + i % (rows->width * 12)]) *
            UINT64_C(0x100000001b3);
    }
    (void)user;
    (void)y;
    return 0;
}

static uint64_t hash_of(void)
{
    rows_hash = 1;
    for (int32_t y = 0; y < frame.view.frame_height; y += 8) {
        lmb_surface rows = frame.out;
        rows.data = (uint8_t *)rows.data + (ptrdiff_t)y * rows.stride_bytes;
        rows.height = mini(8, frame.view.frame_height - y);
        add_rows(NULL, &rows, y);
    }
    return rows_hash;
}

static uint64_t drawn(const lmb_frame_settings *s)
{
    lay_out(s);
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
    return hash_of();
}

/* In parts from last to first, with noise in the scratch. */
static uint64_t drawn_in_parts(const lmb_frame_settings *s, int32_t parts)
{
    lmb_status status;
    lay_out(s);
    status = lmb_render_begin(&render, &frame);
    while (status >= 0 && render.stage < LMB_STAGE_BANDS) {
        if (render.stage == LMB_STAGE_SAMPLES) {
            CHECK(lmb_render_has_parts(&render));
        }
        if (lmb_render_has_parts(&render)) {
            for (int32_t i = parts - 1; i >= 0; --i) {
                memset(&other_scratch, 0x3c, sizeof other_scratch);
                memset(&other_live, 0x3c, sizeof other_live);
                other_scratch.live = &other_live;
                CHECK(lmb_render_part(&render, &other_scratch, i, parts, NULL) == LMB_OK);
            }
            status = lmb_render_parts_done(&render, parts);
        } else {
            status = lmb_render_step(&render, 1);
        }
    }
    CHECK(status == LMB_MORE);
    for (int32_t band = (frame.view.frame_height - 1) / 8; band >= 0; --band) {
        memset(&other_scratch, 0x3c, sizeof other_scratch);
        other_scratch.live = &other_live;
        CHECK(lmb_render_band(&render, &other_scratch, &frame.eye, &frame.out, band) == LMB_OK);
    }
    return hash_of();
}

static uint64_t drawn_by_bands(lmb_frame_settings s)
{
    s.by_bands = 1;
    lay_out(&s);
    frame.callback = add_rows;
    rows_hash = 1;
    lmb_status status = lmb_render_begin(&render, &frame);
    while (status == LMB_OK || status == LMB_MORE) {
        status = lmb_render_step(&render, 1);
        if (status == LMB_OK) {
            break;
        }
    }
    CHECK(status == LMB_OK);
    return rows_hash;
}

/* The centre of a view at three times the size: small frames of the whole scene consist only of edges. */
static lmb_view near_view(int32_t width, int32_t height)
{
    lmb_view v = demo_view(width, height);
    v.half_width *= 1.0f / 3.0f;
    v.half_height *= 1.0f / 3.0f;
    return v;
}

/* The whole gallery, with all kinds of light edges. */
static void test_whole_gallery(void)
{
    const lmb_frame_settings s = settings_of(demo_scene(), demo_view(83, 61), LMB_GATHER_LIVE);
    const uint64_t whole = drawn(&s);
    CHECK(drawn_by_bands(s) == whole);
}

static void test_same_bytes(int32_t width, int32_t height)
{
    const lmb_frame_settings s = settings_of(demo_scene(), near_view(width, height), LMB_GATHER_LIVE);
    const uint64_t whole = drawn(&s);
    CHECK(lmb_render_reuse(&render, &frame) == LMB_OK && render.stage == LMB_STAGE_SHADOW_MAP);
    while (lmb_render_step(&render, 7) == LMB_MORE) {
    }
    CHECK(render.failed == LMB_OK && hash_of() == whole);
    CHECK(drawn_in_parts(&s, 1) == whole && drawn_in_parts(&s, 5) == whole);
    CHECK(drawn_by_bands(s) == whole);
    for (int32_t i = 1; lmb_kernels_at(i) != NULL; ++i) {
        lmb_frame_settings by = s;
        by.kernels = lmb_kernels_at(i);
        CHECK_MSG(drawn(&by) == whole, "%s", lmb_kernels_name(by.kernels));
    }
}

enum { MOMENTS = 4, WIDTH = 32, HEIGHT = 40 };

static lmb_light moving_lamp;
static lmb_band_scratch scratches[MOST_THREADS];
static lmb_live_scratch live_scratches[MOST_THREADS];

/* Fills the scratch of all threads with noise. */
static void put_noise(void)
{
    memset(scratches, 0x3c, sizeof scratches);
    memset(live_scratches, 0x3c, sizeof live_scratches);
    for (int i = 0; i < MOST_THREADS; ++i) {
        scratches[i].live = &live_scratches[i];
    }
}

/* A floor, a wall and a block. */
static void make_corner(void)
{
    world_begin(0.7f, 0.6f, 0.5f);
    world_quad(vec3(0, 0, 0), vec3(3, 0, 0), vec3(0, 0, -3));
    world_quad(vec3(0, 2, -3), vec3(3, 0, 0), vec3(0, 2, 0));
    world_part();
    world_box(vec3(0, 0.5f, -1), 0.4f);
    moving_lamp = spot(vec3(0, 1.5f, 0.0f), vec3(0, 0, -1), 20, 35);
    world.scene.lights = &moving_lamp;
    world.scene.light_count = 1;
    CHECK(world_end() == LMB_OK);
}

/* Each bit of `k` changes something: the light, the viewer; both bits the block. Unchanged parts keep their
 * revision. */
static void set_moment(int k)
{
    const lmb_vec3 at = k & 1 ? vec3(0.7f, 1.2f, 0.1f) : vec3(0, 1.5f, 0);
    const float aside = k == 3 ? 0.6f : 0.0f;
    if (moving_lamp.position.x != at.x) {
        moving_lamp.position = at;
        ++moving_lamp.revision;
    }
    if (world.instance[1].to_world.m[12] != aside) {
        world.instance[1].to_world.m[12] = aside;
        ++world.scene.revision;
    }
    CHECK(lmb_view_look_at(&frame.view, k & 2 ? vec3(1, 1.4f, 1.8f) : vec3(0, 1.8f, 2.0f), vec3(0, 0.2f, -1.0f), Y,
                           0.8f, WIDTH, HEIGHT) == LMB_OK);
}

static void is_as_cold(const uint64_t cold[MOMENTS], int k, const reuse_way *by, int before)
{
    memset(frame.out.data, 0x3c, (size_t)frame.out.stride_bytes * HEIGHT);
    set_moment(k);
    CHECK(reused_frame(&render, &frame, by) == LMB_OK);
    CHECK_MSG(hash_of() == cold[k], "moment %d after %d by %d rows, %d threads", k, before, (int)by->rows, by->threads);
}

/* A frame has the same bytes whatever frame came before it in the same memory: each after each, also in strips of
 * several heights and with threads, in reverse, with noise in the scratch. */
static void test_history(void)
{
    static const reuse_way ways[] = {REUSED_WAYS(HEIGHT)}, whole = {HEIGHT, 0};
    uint64_t cold[MOMENTS];
    make_corner();
    const lmb_frame_settings s = settings_of(&world.scene, demo_view(WIDTH, HEIGHT), LMB_GATHER_LIVE);
    for (int k = 0; k < MOMENTS; ++k) {
        lay_out(&s);
        set_moment(k);
        CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
        cold[k] = hash_of();
        for (int i = 0; i < k; ++i) {
            CHECK_MSG(cold[k] != cold[i], "moments %d and %d", i, k);
        }
    }
    frame.scratch = scratches;
    put_noise();
    memset(&render, 0, sizeof render);
    for (int i = 0; i < MOMENTS * MOMENTS; ++i) {
        is_as_cold(cold, i / MOMENTS, &whole, i % MOMENTS);
        is_as_cold(cold, i % MOMENTS, &whole, i / MOMENTS);
    }
    /* A setting of the tree that changes, or a tree that was laid out again, is no reason to keep the old one. */
    for (int i = 0; i < 2; ++i) {
        lay_out(&s);
        frame.bounces = 1;
        is_as_cold(cold, MOMENTS - 1, &whole, MOMENTS - 1);
    }
    frame.live->steady = 1;
    CHECK(reused_frame(&render, &frame, &whole) == LMB_OK);
    const uint64_t changed = hash_of();
    memset(&render, 0, sizeof render);
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK && hash_of() == changed && changed != cold[MOMENTS - 1]);
    frame.live->steady = 0;
    is_as_cold(cold, MOMENTS - 1, &whole, MOMENTS - 1);
    frame.scratch = scratches;
    for (int i = 0; i < COUNT(ways); ++i) {
        frame.eye.depth.height = frame.eye.id.height = ways[i].rows;
        for (int k = MOMENTS - 1; k >= 0; --k) {
            put_noise();
            is_as_cold(cold, k, &ways[i], k + 1);
        }
    }
}

enum { PICTURE = 160 * 120 * 3 };
static float full[PICTURE], live[PICTURE];

/* RMSE of the live picture against the full one, over the mean; *share: share of pixels that are samples. */
static float error_of(const lmb_scene *scene, lmb_view view, float *share)
{
    lmb_frame_settings s = settings_of(scene, view, 1);
    double sum = 0.0, mean = 0.0;
    int64_t known = 0;
    drawn(&s);
    memcpy(full, frame.out.data, sizeof *full * (size_t)(3 * view.frame_width * view.frame_height));
    s.gather_step = LMB_GATHER_LIVE;
    drawn(&s);
    memcpy(live, frame.out.data, sizeof *live * (size_t)(3 * view.frame_width * view.frame_height));
    const int numbers = 3 * view.frame_width * view.frame_height;
    const int tiles = (view.frame_width + 7) / 8 * ((view.frame_height + 7) / 8);
    for (int i = 0; i < numbers; ++i) {
        sum += (double)(full[i] - live[i]) * (double)(full[i] - live[i]);
        mean += (double)full[i];
    }
    for (int i = 0; i < tiles; ++i) {
        known += count_bits_64(((const live_grid_tile *)render.frame.lattice.tile)[i].known);
    }
    *share = (float)known / (float)(view.frame_width * view.frame_height);
    return sqrtf((float)(sum / numbers)) / (float)(mean / numbers);
}

/* A floor lit by a wall that a spot lights. */
static void test_flat_wall(void)
{
    float share = 0.0f;
    world_begin(0.7f, 0.6f, 0.5f);
    world_quad(vec3(0, 0, 0), vec3(3, 0, 0), vec3(0, 0, -3));
    world_quad(vec3(0, 2, -3), vec3(3, 0, 0), vec3(0, 2, 0));
    CHECK(world_end() == LMB_OK);
    lmb_light lamp = spot(vec3(0, 1.5f, 0.0f), vec3(0, 0, -1), 20, 35);
    world.scene.lights = &lamp;
    world.scene.light_count = 1;
    lmb_view view;
    CHECK(lmb_view_look_at(&view, vec3(0, 1.8f, 2.0f), vec3(0, 0, -1.0f), vec3(0, 1, 0), 0.8f, 160, 120) == LMB_OK);
    const float error = error_of(&world.scene, view, &share);
    printf("  floor before a lit wall: %.2f %% of the pixels, error %.4f\n", (double)(100.0f * share), (double)error);
    CHECK(share < 0.06f && error < 0.12f);
}

/* A plan counts the memory of the live tree. */
static void test_planned(void)
{
    static lmb_plan plan;
    uint64_t bytes[2];
    make_corner();
    const lmb_frame_settings s = settings_of(&world.scene, demo_view(WIDTH, HEIGHT), LMB_GATHER_LIVE);
    lay_out(&s);
    for (int is_live = 0; is_live < 2; ++is_live) {
        frame.gather_step = is_live ? LMB_GATHER_LIVE : 1;
        memset(&render, 0, sizeof render);
        CHECK(lmb_render_begin(&render, &frame) == LMB_OK && lmb_plan_frame(&plan, &render, 0.0, 0.0) == LMB_OK);
        bytes[is_live] = plan.row[LMB_PLAN_POINTS].bytes;
    }
    const uint32_t faces = frame.live->face_cap;
    CHECK(faces > 0 && bytes[1] - bytes[0] - sizeof *frame.live ==
                           lmb_live_bytes(faces, lmb_live_side(faces, frame.shadow_map), frame.elements.cap));
}

/* Tiles with a polished surface are fully gathered: each pixel equals a separate gather bit for bit. */
static void test_lobes(void)
{
    world_begin(0.7f, 0.6f, 0.5f);
    world_quad(vec3(0, 2, -3), vec3(3, 0, 0), vec3(0, 2, 0));
    world_part();
    world_quad(vec3(0, 0, 0), vec3(3, 0, 0), vec3(0, 0, -3));
    world.material[1].specular[1] = 0.5f;
    world.material[1].roughness = 0.5f;
    CHECK(world_end() == LMB_OK);
    lmb_light lamp = spot(vec3(0, 1.5f, 0.0f), vec3(0, 0, -1), 20, 35);
    world.scene.lights = &lamp;
    world.scene.light_count = 1;
    lmb_view view;
    CHECK(lmb_view_look_at(&view, vec3(0, 1.8f, 2.0f), vec3(0, 0.5f, -1), vec3(0, 1, 0), 0.8f, 40, 32) == LMB_OK);
    lmb_frame_settings s = settings_of(&world.scene, view, 1);
    s.show = LMB_SHOW_INDIRECT;
    drawn(&s);
    memcpy(full, frame.out.data, sizeof *full * 3 * 40 * 32);
    s.gather_step = LMB_GATHER_LIVE;
    drawn(&s);
    memcpy(live, frame.out.data, sizeof *live * 3 * 40 * 32);
    int polished = 0, other = 0, off = 0;
    for (int32_t y = 0; y < 32; ++y) {
        for (int32_t x = 0; x < 40; ++x) {
            const int at = 3 * (40 * y + x), whole = ((const live_grid_tile *)render.frame.lattice.tile)[y / 8 * 5 + x / 8].lobes;
            polished += whole;
            other += !whole;
            off += whole && memcmp(full + at, live + at, 3 * sizeof *full) != 0;
        }
    }
    CHECK_MSG(polished > 300 && other > 300 && off == 0, "%d, %d, %d are off", polished, other, off);
    /* Elements lit by one kernel differ from those lit by the other. */
    for (int is_live = 0; is_live < 2; ++is_live) {
        s.gather_step = LMB_GATHER_LIVE;
        s.bounces = 2;
        s.elements = 64;
        lay_out(&s);
        frame.gather_step = is_live ? LMB_GATHER_LIVE : 1;
        CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
        frame.gather_step = is_live ? 1 : LMB_GATHER_LIVE;
        CHECK(lmb_render_again(&render, &frame) == LMB_ERR_ARG);
        frame.gather_step = is_live ? LMB_GATHER_LIVE : 1;
        CHECK(lmb_render_again(&render, &frame) == LMB_OK);
    }
}

/* The camera moves by fractions of a step: the lattice shifts, the error stays the same. */
static void test_shift(void)
{
    float least = 1.0f, most = 0.0f;
    for (int i = 0; i < 2; ++i) {
        static const float pixels[] = {0.25f, 3.0f};
        lmb_view view = demo_view(120, 90);
        float share = 0.0f;
        view.eye = add3(view.eye, mul3(view.right, 0.027f * pixels[i]));
        const float error = error_of(demo_scene(), view, &share);
        least = minf(least, error);
        most = maxf(most, error);
        CHECK_MSG(share < 0.25f, "%g", (double)share);
    }
    printf("  gallery, shifted by up to 3 px: errors %.4f .. %.4f\n", (double)least, (double)most);
    CHECK(most < 0.25f && most < 1.5f * least);
}

static void test_refused(void)
{
    lmb_frame_settings s = settings_of(demo_scene(), demo_view(40, 30), 5);
    CHECK(lmb_frame_bytes(&s) == 0);
    s.gather_step = 1;
    lay_out(&s);
    frame.gather_step = LMB_GATHER_LIVE;
    CHECK(lmb_render_begin(&render, &frame) == LMB_ERR_ARG); /* no lattice */
    s.gather_step = LMB_GATHER_LIVE;
    lay_out(&s);
    CHECK(lmb_render_begin(&render, &frame) == LMB_OK);
    frame.view.frame_width = 32;
    CHECK(lmb_render_begin(&render, &frame) == LMB_ERR_ARG); /* of another size */
    frame.view.frame_width = 40;
    frame.live = NULL;
    CHECK(lmb_render_begin(&render, &frame) == LMB_ERR_ARG); /* no tree of single points */
    s.quality = LMB_QUALITY_FIXED;
    CHECK(lmb_frame_bytes(&s) == 0);
    s.quality = LMB_QUALITY_DRAFT;
    lay_out(&s);
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
    static lmb_band_scratch bare; /* without memory for single points */
    CHECK(lmb_render_band(&render, frame.scratch, &frame.eye, &frame.out, 0) == LMB_OK);
    CHECK(lmb_render_band(&render, &bare, &frame.eye, &frame.out, 0) == LMB_ERR_ARG);
    frame.gather_step = 1; /* the tree of texels was not needed */
    CHECK(lmb_render_again(&render, &frame) == LMB_ERR_ARG);
    frame.gather_step = LMB_GATHER_LIVE;
    CHECK(lmb_render_again(&render, &frame) == LMB_OK);
    s.show = LMB_SHOW_DIRECT;
    lay_out(&s);
    CHECK(frame.lattice.tile == NULL && lmb_render_frame(&render, &frame) == LMB_OK);
}

/* A BVH of small nodes gives the same picture, and frames that would take nothing from it refuse it. */
static void small_nodes(void)
{
    static uint64_t small_memory[6400], other_memory[6400];
    const uint32_t triangles = lmb_scene_triangles(demo_scene());
    const lmb_frame_settings s = settings_of(demo_scene(), demo_view(96, 72), LMB_GATHER_LIVE);
    const uint64_t wide = drawn(&s);
    CHECK(lmb_bvh_small_init(&frame.bvh, triangles, small_memory, sizeof small_memory) == LMB_OK);
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK && render.frame.bvh.small_count > 0 && hash_of() == wide);
    /* The next frame's BVH in other memory: the first memory may be gone. */
    CHECK(lmb_bvh_small_init(&frame.bvh, triangles, other_memory, sizeof other_memory) == LMB_OK);
    CHECK(lmb_render_reuse(&render, &frame) == LMB_OK);
    memset(small_memory, 0, sizeof small_memory);
    while (lmb_render_step(&render, 7) == LMB_MORE) {
    }
    CHECK(render.failed == LMB_OK && render.frame.bvh.small == frame.bvh.small && hash_of() == wide);
    frame.gather_step = 1;
    CHECK(lmb_render_begin(&render, &frame) == LMB_ERR_ARG);
    frame.show = LMB_SHOW_DIRECT;
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
}

void test_live_frames(void)
{
    test_memory();
    test_whole_gallery();
    test_same_bytes(27, 19);
    test_same_bytes(1, 9);
    test_same_bytes(129, 9);
    test_history();
    test_flat_wall();
    test_planned();
    test_lobes();
    test_shift();
    test_refused();
    small_nodes();
    free_laid_out();
}
