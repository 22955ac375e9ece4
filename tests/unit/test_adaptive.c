/* test_adaptive.c: LMB_GATHER_ADAPTIVE: few samples if the light is smooth, otherwise more, and the same bytes in any
 * order, with any bands, threads and backends. */
#include <lambent/lambent.h>

#include <stdlib.h>

#include "../../src/frame/lattice.h"
#include "../../tools/demo/demo_scene.h"
#include "../reused_frame.h"
#include "../laid_out.h"
#include "../world.h"

void test_adaptive(void);

/* --- a lattice by itself ------------------------------------------------------------------------------------------ */

enum { WIDE = 100, HIGH = 75, TILES = 13 * 10 };

static uint64_t lattice_memory[TILES * (sizeof(lmb_lattice_tile) / 8) + 1024];
static lmb_tile tile;

typedef float (*light_at)(float x, float y);

static float even(float x, float y) { return 0.3f + 0.0f * (x + y); }
static float curved(float x, float y) { return 2.0f + 0.01f * x - 0.02f * y + 1e-4f * (x * x - x * y); }
static float stepped(float x, float y) { return x + 0.3f * y > 61.0f ? 1.0f : 3.0f; }

/* A wall with 1 cm per pixel. Columns from `bent` on belong to a second wall across it; with `deep`, four columns from
 * there on are instead a groove of this depth in m. */
static lmb_lattice wall_with(int32_t bent, float deep)
{
    lmb_lattice l;
    CHECK(lmb_lattice_bytes(WIDE, HIGH) <= sizeof lattice_memory);
    CHECK(lmb_lattice_init(&l, WIDE, HIGH, lattice_memory, sizeof lattice_memory) == LMB_OK);
    memset(lattice_memory, 0x5a, sizeof lattice_memory);
    for (int32_t i = 0; i < TILES; ++i) {
        memset(&tile, 0, sizeof tile);
        tile.x = i % 13 * 8;
        tile.y = i / 13 * 8;
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const int32_t x = tile.x + k % 8, y = tile.y + k / 8, past = x >= bent && !(deep > 0.0f) ? x - bent : 0;
            const lmb_vec3 n = x >= bent && !(deep > 0.0f) ? vec3(-1, 0, 0) : Z;
            const float low = x >= bent && x < bent + 4 ? deep : 0.0f;
            if (x < WIDE && y < HIGH) {
                set_plane(tile.position, k,
                          vec3(0.01f * (float)(x - past), 0.01f * (float)y, 0.01f * (float)past - low));
                set_plane(tile.face, k, n);
                set_plane(tile.normal, k, n);
                tile.id[k] = 1;
            }
        }
        lmb_lattice_put(&l, &tile, 0);
    }
    return l;
}

static lmb_lattice wall(int32_t bent) { return wall_with(bent, 0.0f); }

/* Evaluates all wanted pixels. Returns their number. */
static int gather(const lmb_lattice *l, light_at light)
{
    int count = 0;
    for (int32_t i = 0; i < TILES; ++i) {
        lmb_lattice_tile *t = &l->tile[i];
        CHECK((t->wanted & (t->known | ~t->shown)) == 0);
        for (uint64_t bits = t->wanted; bits != 0; bits &= bits - 1, ++count) {
            const int k = lowest_bit_64(bits);
            for (int c = 0; c < 3; ++c) {
                t->light.rgb[c][k] = (float)(c + 1) * light((float)(i % 13 * 8 + k % 8), (float)(i / 13 * 8 + k / 8));
            }
        }
        t->known |= t->wanted;
        t->wanted = 0;
    }
    return count;
}

/* All stages of a frame. Returns the number of samples. */
static int solve(lmb_lattice *l, light_at light)
{
    int count = gather(l, light);
    l->mean = lmb_lattice_mean(l);
    l->split = 0.1f;
    for (int32_t level = 0; level < LATTICE_LEVELS - 1; ++level) {
        lmb_lattice_divide(l, level);
        count += gather(l, light);
    }
    for (int32_t w = 0; w < lmb_lattice_windows(l); ++w) {
        lmb_lattice_fill(l, w);
    }
    for (int32_t w = 0; w < lmb_lattice_windows(l); ++w) {
        lmb_lattice_rest(l, w);
        count += gather(l, light);
        lmb_lattice_closer(l, w);
        count += gather(l, light);
        lmb_lattice_late(l, w);
    }
    return count;
}

/* The largest error of a pixel; `off`: pixels with an error of over a tenth. */
static float worst(const lmb_lattice *l, light_at light, int *off)
{
    float out = 0.0f;
    *off = 0;
    for (int32_t y = 0; y < HIGH; ++y) {
        for (int32_t x = 0; x < WIDE; ++x) {
            const lmb_lattice_tile *t = lattice_tile(l, x / 8, y / 8);
            for (int c = 0; c < 3; ++c) {
                const float is = t->light.rgb[c][y % 8 * 8 + x % 8] / (float)(c + 1),
                            e = absf(is - light((float)x, (float)y));
                out = maxf(out, e);
                *off += c == 0 && e > 0.1f;
            }
        }
    }
    return out;
}

enum { FIRST = 14 * 11 /* columns 0, 8 .. 96 and 99, rows 0 .. 72 and 74 */ };

static void test_lattice(void)
{
    int off = 0;
    lmb_lattice l = wall(WIDE);
    CHECK(solve(&l, even) == FIRST && worst(&l, even, &off) == 0.0f); /* exactly */
    l = wall(WIDE);
    CHECK(solve(&l, curved) == FIRST);
    CHECK_MSG(worst(&l, curved, &off) < 2e-3f, "%g", (double)worst(&l, curved, &off)); /* 5e-3 without slopes */
    l = wall(WIDE);
    int count = solve(&l, stepped);
    worst(&l, stepped, &off);
    printf("  an edge of light: %d of %d pixels are gathered, %d are off\n", count, WIDE * HIGH, off);
    CHECK(count > FIRST + 100 && count < WIDE * HIGH / 5 && off < WIDE * HIGH / 100);
}

/* Two walls with different light meet within cells: neither may take light from the other. */
static float either(float x, float y) { return x >= 45.0f ? 10.0f + 0.0f * y : 1.0f; }

static void test_two_walls(void)
{
    int off = 0;
    lmb_lattice l = wall(45);
    const int count = solve(&l, either);
    CHECK_MSG(worst(&l, either, &off) < 1e-5f, "%g", (double)worst(&l, either, &off)); /* of 1 and 10 */
    CHECK_MSG(count < WIDE * HIGH / 8, "%d", count);
}

/* A groove between samples with a bottom parallel to the wall: it must not take the wall's light. */
static float grooved(float x, float y) { return x >= 42.0f && x < 46.0f ? 10.0f + 0.0f * y : 1.0f; }

static void test_groove(void)
{
    int off = 0;
    lmb_lattice l = wall_with(42, 0.5f);
    const int count = solve(&l, grooved);
    CHECK_MSG(worst(&l, grooved, &off) < 1e-5f, "%g", (double)worst(&l, grooved, &off));
    CHECK_MSG(count < WIDE * HIGH / 8, "%d", count);
}

/* Without known samples the mean is 0, and pixels that wait for a nearby sample are dark. */
static void test_no_samples(void)
{
    lmb_lattice l = wall(WIDE);
    CHECK(lmb_lattice_mean(&l) == 0.0f);
    for (int32_t i = 0; i < TILES; ++i) {
        l.tile[i].early = 0;
        l.tile[i].late = l.tile[i].shown;
        memset(&l.tile[i].light, 0x5a, sizeof l.tile[i].light);
    }
    for (int32_t w = 0; w < lmb_lattice_windows(&l); ++w) {
        lmb_lattice_late(&l, w);
    }
    int off = 0;
    for (int32_t i = 0; i < TILES; ++i) {
        for (uint64_t bits = l.tile[i].shown; bits != 0; bits &= bits - 1) {
            off += !(l.tile[i].light.rgb[i % 3][lowest_bit_64(bits)] == 0.0f);
        }
    }
    CHECK_MSG(off == 0, "%d pixels", off);
}

/* A corner in the dark, six pixels before the next window: the light also grows beyond it, without a jump at the
 * border. */
static float rising(float x, float y) { return x >= 58.0f ? minf(0.3f + 0.04f * (x - 58.0f), 1.0f) : 2.0f + 0.0f * y; }

static void test_window_side(void)
{
    int off = 0;
    lmb_lattice l = wall(58);
    const int count = solve(&l, rising);
    CHECK_MSG(worst(&l, rising, &off) < 0.1f, "%g, %d are off", (double)worst(&l, rising, &off), off);
    CHECK_MSG(count < WIDE * HIGH / 8, "%d", count);
}

static void test_memory(void)
{
    lmb_lattice l;
    const size_t bytes = lmb_lattice_bytes(16, 9);
    CHECK(bytes > 4 * sizeof(lmb_lattice_tile) && bytes < 5 * sizeof(lmb_lattice_tile));
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
    const lmb_frame_settings s = settings_of(demo_scene(), demo_view(83, 61), LMB_GATHER_ADAPTIVE);
    const uint64_t whole = drawn(&s);
    CHECK(drawn_by_bands(s) == whole);
}

static void test_same_bytes(int32_t width, int32_t height, int32_t step)
{
    const lmb_frame_settings s = settings_of(demo_scene(), near_view(width, height), step);
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
    const lmb_frame_settings s = settings_of(&world.scene, demo_view(WIDTH, HEIGHT), LMB_GATHER_ADAPTIVE);
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
    memset(&render, 0, sizeof render);
    for (int i = 0; i < MOMENTS * MOMENTS; ++i) {
        is_as_cold(cold, i / MOMENTS, &whole, i % MOMENTS);
        is_as_cold(cold, i % MOMENTS, &whole, i / MOMENTS);
    }
    for (int i = 0; i < COUNT(ways); ++i) {
        frame.eye.depth.height = frame.eye.id.height = ways[i].rows;
        for (int k = MOMENTS - 1; k >= 0; --k) {
            memset(scratches, 0x3c, sizeof scratches);
            is_as_cold(cold, k, &ways[i], k + 1);
        }
    }
}

enum { PICTURE = 160 * 120 * 3 };
static float full[PICTURE], adaptive[PICTURE];

/* RMSE of the adaptive picture against the full one, over the mean; *share: share of pixels gathered. */
static float error_of(const lmb_scene *scene, lmb_view view, float *share)
{
    lmb_frame_settings s = settings_of(scene, view, 1);
    double sum = 0.0, mean = 0.0;
    int64_t known = 0, shown = 0;
    drawn(&s);
    memcpy(full, frame.out.data, sizeof *full * (size_t)(3 * view.frame_width * view.frame_height));
    s.gather_step = LMB_GATHER_ADAPTIVE;
    drawn(&s);
    memcpy(adaptive, frame.out.data, sizeof *adaptive * (size_t)(3 * view.frame_width * view.frame_height));
    const int numbers = 3 * view.frame_width * view.frame_height;
    const int tiles = (view.frame_width + 7) / 8 * ((view.frame_height + 7) / 8);
    for (int i = 0; i < numbers; ++i) {
        sum += (double)(full[i] - adaptive[i]) * (double)(full[i] - adaptive[i]);
        mean += (double)full[i];
    }
    for (int i = 0; i < tiles; ++i) {
        known += count_bits_64(render.frame.lattice.tile[i].known);
        shown += count_bits_64(render.frame.lattice.tile[i].shown);
    }
    *share = (float)known / (float)shown;
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
    CHECK(share < 0.06f && error < 0.02f);
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
    s.gather_step = LMB_GATHER_ADAPTIVE;
    drawn(&s);
    memcpy(adaptive, frame.out.data, sizeof *adaptive * 3 * 40 * 32);
    int polished = 0, other = 0, off = 0;
    for (int32_t y = 0; y < 32; ++y) {
        for (int32_t x = 0; x < 40; ++x) {
            const int at = 3 * (40 * y + x), whole = lattice_tile(&render.frame.lattice, x / 8, y / 8)->shown == 0;
            polished += whole;
            other += !whole;
            off += whole && memcmp(full + at, adaptive + at, 3 * sizeof *full) != 0;
        }
    }
    CHECK_MSG(polished > 300 && other > 300 && off == 0, "%d, %d, %d are off", polished, other, off);
    /* Elements lit by one kernel differ from those lit by the other. */
    for (int live = 0; live < 2; ++live) {
        s.gather_step = LMB_GATHER_LIVE;
        s.bounces = 2;
        s.elements = 64;
        lay_out(&s);
        frame.gather_step = live ? LMB_GATHER_LIVE : 1;
        CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
        frame.gather_step = live ? 1 : LMB_GATHER_LIVE;
        CHECK(lmb_render_again(&render, &frame) == LMB_ERR_ARG);
        frame.gather_step = live ? LMB_GATHER_LIVE : 1;
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
    CHECK(most < 0.09f && most < 1.5f * least);
}

static void test_refused(void)
{
    lmb_frame_settings s = settings_of(demo_scene(), demo_view(40, 30), 5);
    CHECK(lmb_frame_bytes(&s) == 0);
    s.gather_step = 1;
    lay_out(&s);
    frame.gather_step = LMB_GATHER_ADAPTIVE;
    CHECK(lmb_render_begin(&render, &frame) == LMB_ERR_ARG); /* no lattice */
    s.gather_step = LMB_GATHER_ADAPTIVE;
    lay_out(&s);
    CHECK(lmb_render_begin(&render, &frame) == LMB_OK);
    frame.view.frame_width = 32;
    CHECK(lmb_render_begin(&render, &frame) == LMB_ERR_ARG); /* of another size */
    frame.view.frame_width = 40;
    frame.gather_step = LMB_GATHER_LIVE;
    CHECK(lmb_render_begin(&render, &frame) == LMB_ERR_ARG); /* no tree of single points */
    s.gather_step = LMB_GATHER_LIVE;
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

void test_adaptive(void)
{
    test_lattice();
    test_two_walls();
    test_groove();
    test_no_samples();
    test_window_side();
    test_memory();
    test_whole_gallery();
    for (int i = 0; i < 2; ++i) {
        const int32_t step = i == 0 ? LMB_GATHER_ADAPTIVE : LMB_GATHER_LIVE;
        test_same_bytes(27, 19, step);
        test_same_bytes(1, 9, step);
        test_same_bytes(129, 9, step);
    }
    test_history();
    test_flat_wall();
    test_lobes();
    test_shift();
    test_refused();
    free_laid_out();
}
