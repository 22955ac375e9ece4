/* test_bins.c: layer 3: bins draw the same bytes as lmb_draw into any window, however little memory they have, however
 * ranges and windows are divided, and in any order.
 *
 * Scenes are random, with holes and blending, on every backend and in every format. */
#include <stdlib.h>
#include <string.h>

#include <lambent/bins.h>

#include "../crowd.h"
#include "../laid_surface.h"

void test_bins(void);

#if LMB_CULLING
enum { WIDE = 136, HIGH = 420, TILES = (WIDE / 8 + 1) * (HIGH / 8 + 1) + 15, RANGES = 3, SCENES = 4 };
enum { WHOLE = 1 << 20 }; /* enough bytes for the whole stage */
enum { PAST = 7 };        /* pixels of a window beyond the frame, in the last tile */

static uint32_t depth_memory[2][WIDE * (HIGH + 8)], id_memory[2][WIDE * (HIGH + 8)];
static float bound[TILES];
static uint8_t colours[4 * 3 * CROWD];
static uint8_t memory[RANGES][WHOLE];

/* The stage, tall enough for several bins, with a third material with holes or blending. */
static void make_tall_stage(test_rng *r, int32_t kind)
{
    make_stage(r, kind);
    for (size_t i = 0; i < sizeof colours; ++i) {
        colours[i] = (uint8_t)test_random(r);
    }
    st.mesh[0].colours = colours;
    st.material[0].alpha = 1.0f;
    st.material[0].alpha_cutoff = 0.5f;
    st.material[0].flags = test_random(r) % 2 ? 0 : test_random(r) % 2 ? LMB_ALPHA_MASK : LMB_ALPHA_MASK | LMB_ALPHA_BLEND;
    st.view.frame_width = WIDE - PAST;
    st.view.frame_height = HIGH - PAST;
    st.view.half_height *= (float)HIGH / (float)WIDE;
    st.view.sample_x = LMB_MULTISAMPLE ? (int32_t)(test_random(r) % 200) - 100 : 0;
    CHECK(lmb_clusters_build(st.cluster, CLUSTERS, &st.scene) == LMB_OK);
}

/* A window of the frame in memory 0 or 1, with dirty or cleared pixels. */
static lmb_target window_of(int which, int32_t depth_format, int32_t id_format, int32_t layout, const int32_t box[4],
                            int is_dirty)
{
    lmb_target t;
    memset(&t, 0, sizeof t);
    memset(depth_memory[which], is_dirty ? 0x3e : 0, sizeof depth_memory[which]);
    memset(id_memory[which], is_dirty ? 0x3e : 0, sizeof id_memory[which]);
    t.depth = surface_of(depth_format, layout, box[2], box[3], depth_memory[which]);
    if (id_format != LMB_FORMAT_NONE) {
        t.id = surface_of(id_format, layout, box[2], box[3], id_memory[which]);
    }
    t.x0 = box[0];
    t.y0 = box[1];
    return t;
}

static void random_box(test_rng *r, int32_t box[4])
{
    const int is_whole = test_random(r) % 3 == 0;
    const int32_t wide = st.view.frame_width + PAST, high = st.view.frame_height + PAST;
    box[0] = is_whole ? 0 : 8 * (int32_t)(test_random(r) % 9);
    box[1] = is_whole ? 0 : 8 * (int32_t)(test_random(r) % 40);
    box[2] = is_whole ? wide : 1 + (int32_t)(test_random(r) % (uint32_t)(wide - box[0]));
    box[3] = is_whole ? high : 1 + (int32_t)(test_random(r) % (uint32_t)(high - box[1]));
}

/* Kinds of culling: none, by bounds, by clusters, by both. */
static lmb_culling culling_of(const lmb_target *t, int how)
{
    lmb_culling c;
    memset(&c, 0, sizeof c);
    if (how & 1) {
        c.farthest = bound;
        c.tiles = lmb_culling_tiles(t);
    }
    if (how & 2) {
        c.clusters = st.cluster;
        c.cluster_count = CLUSTERS;
    }
    return c;
}

/* Builds ranges, last first, each with the given bytes; returns the number that did not fit. */
static int build(lmb_bins *bins, int ranges, size_t bytes, const lmb_kernels *kernels, uint32_t flags,
                 const lmb_culling *culling, lmb_stats *stats)
{
    const uint32_t all = lmb_scene_triangles(&st.scene), each = all / (uint32_t)ranges;
    int full = 0;
    for (int i = ranges - 1; i >= 0; --i) {
        const uint32_t first = 1 + each * (uint32_t)i;
        memset(&bins[i], 0, sizeof bins[i]);
        bins[i].memory = memory[i] + i; /* any alignment */
        bins[i].bytes = bytes;
        CHECK(lmb_bins_build(&bins[i], kernels, &st.view, &st.scene, first, i == ranges - 1 ? UINT32_MAX : each, flags,
                             culling, stats) == LMB_OK);
        CHECK(bins[i].first_id == first && bins[i].past_id >= first && bins[i].past_id <= bins[i].end_id);
        full += bins[i].past_id < bins[i].end_id;
    }
    return full;
}

typedef struct formats {
    int32_t depth, id, layout;
} formats;

/* Draws one window both ways, with bins of the given ranges and bytes. */
static int draw_both(test_rng *r, const lmb_kernels *kernels, const formats *f, int ranges, size_t bytes, int how)
{
    const uint32_t flags = (test_random(r) % 2 ? LMB_CULL_BACK : 0) | (test_random(r) % 2 ? LMB_BLEND : 0);
    const int clears = (int)(test_random(r) % 2);
    int32_t box[4], x, y;
    lmb_bins bins[RANGES];
    lmb_stats stats[2];
    random_box(r, box);
    const lmb_target t[2] = {window_of(0, f->depth, f->id, f->layout, box, 0),
                             window_of(1, f->depth, f->id, f->layout, box, clears)};
    const lmb_culling culling = culling_of(&t[1], how);
    memset(stats, 0, sizeof stats);
    for (int i = 0; i < TILES; ++i) {
        bound[i] = clears ? 1e9f : 0.0f;
    }
    CHECK(lmb_draw(&t[0], kernels, &st.view, &st.scene, 1, UINT32_MAX, flags, &stats[0]) == LMB_OK);
    const int full = build(bins, ranges, bytes, kernels, flags, how == 0 ? NULL : &culling, &stats[1]);
    CHECK(lmb_bins_draw(&t[1], kernels, bins, ranges, clears, how == 0 ? NULL : &culling) == LMB_OK);
    CHECK(lmb_surface_diff(&x, &y, &t[0].depth, &t[1].depth) == 0);
    CHECK(t[0].id.data == NULL || lmb_surface_diff(&x, &y, &t[0].id, &t[1].id) == 0);
    CHECK(stats[0].triangles == stats[1].triangles && stats[0].triangles_dropped == stats[1].triangles_dropped);
    CHECK(how & 2 ? stats[1].triangles_drawn <= stats[0].triangles_drawn
                  : stats[1].triangles_drawn == stats[0].triangles_drawn);
    return full;
}

/* With all the bytes that the stage needs, with fewer, with none. */
static void same_bytes(test_rng *r, const lmb_kernels *kernels)
{
    static const int32_t depths[] = {LMB_DEPTH32F, LMB_DEPTH16}, ids[] = {LMB_FORMAT_NONE, LMB_ID32, LMB_ID16};
    for (int i = 0; i < 24; ++i) {
        const formats f = {depths[i / 12], ids[i / 2 % 3], i & 1 ? LMB_LINEAR : LMB_TILED};
        const int ranges = 1 + (int)(test_random(r) % RANGES);
        const size_t some = test_random(r) % 60000;
        CHECK(draw_both(r, kernels, &f, ranges, WHOLE, i % 4) == 0);
        draw_both(r, kernels, &f, ranges, some, (i + 1) % 4);
        draw_both(r, kernels, &f, ranges, 0, (i + 2) % 4);
    }
}

static void test_same_bytes(void)
{
    test_rng r = {24};
    for (int32_t m = 0; lmb_kernels_at(m) != NULL; ++m) {
        for (int i = 0; i < SCENES; ++i) {
            make_tall_stage(&r, i % 3 == 2 ? LMB_ORTHOGRAPHIC : LMB_PERSPECTIVE);
            st.view.frame_height = i % 2 ? 384 - (int32_t)(test_random(&r) % 5) : st.view.frame_height; /* three bins end */
            same_bytes(&r, lmb_kernels_at(m));
        }
    }
}

/* Windows of a frame, last first, as threads may reach them: the bytes of the whole. */
static void test_windows(void)
{
    test_rng r = {24};
    const int32_t frame[4] = {0, 0, WIDE, HIGH}, step = 88;
    lmb_bins bins[RANGES];
    int32_t x, y;
    make_tall_stage(&r, LMB_PERSPECTIVE);
    const lmb_target whole = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, frame, 0);
    CHECK(build(bins, RANGES, WHOLE, picked_kernels(), 0, NULL, NULL) == 0);
    CHECK(lmb_draw(&whole, picked_kernels(), &st.view, &st.scene, 1, UINT32_MAX, 0, NULL) == LMB_OK);
    const lmb_target other = window_of(1, LMB_DEPTH32F, LMB_ID32, LMB_TILED, frame, 1);
    for (int32_t y0 = HIGH / step * step; y0 >= 0; y0 -= step) {
        lmb_target t = other;
        t.y0 = y0;
        t.depth.height = t.id.height = HIGH - y0 < step ? HIGH - y0 : step;
        t.depth.data = (uint8_t *)other.depth.data + y0 / LMB_TILE * other.depth.stride_bytes;
        t.id.data = (uint8_t *)other.id.data + y0 / LMB_TILE * other.id.stride_bytes;
        CHECK(lmb_bins_draw(&t, picked_kernels(), bins, RANGES, 1, NULL) == LMB_OK);
    }
    CHECK(lmb_surface_diff(&x, &y, &whole.depth, &other.depth) == 0);
    CHECK(lmb_surface_diff(&x, &y, &whole.id, &other.id) == 0);
}

static int32_t pixels_shown(const lmb_target *t)
{
    int32_t n = 0;
    for (int32_t i = 0; i < WIDE * HIGH; ++i) {
        n += ((const uint32_t *)t->depth.data)[i] != 0;
    }
    return n;
}

/* With nearer bounds everywhere, most small triangles are left out, because their bounds show that they are hidden. */
static void test_hidden(void)
{
    test_rng r = {24};
    const int32_t frame[4] = {0, 0, WIDE, HIGH};
    lmb_bins bins;
    make_tall_stage(&r, LMB_ORTHOGRAPHIC);
    st.material[0].flags = LMB_DOUBLE_SIDED;
    st.instance[1].first_id = 1; /* no walls: backends of four lanes draw them whatever the bounds */
    st.scene.instances = st.instance + 1;
    st.scene.instance_count = 1;
    for (int32_t m = 0; lmb_kernels_at(m) != NULL; ++m) {
        int32_t shown[2];
        for (int i = 0; i < 2; ++i) {
            const lmb_target t = window_of(1, i ? LMB_DEPTH16 : LMB_DEPTH32F, LMB_FORMAT_NONE, LMB_LINEAR, frame, 0);
            const lmb_culling culling = culling_of(&t, 1);
            CHECK(build(&bins, 1, WHOLE, lmb_kernels_at(m), 0, NULL, NULL) == 0);
            for (int k = 0; k < 2; ++k) {
                for (int n = 0; n < TILES; ++n) {
                    bound[n] = k ? 1e9f : 0.0f;
                }
                lmb_surface_clear(&t.depth);
                CHECK(lmb_bins_draw(&t, lmb_kernels_at(m), &bins, 1, 0, &culling) == LMB_OK);
                shown[k] = pixels_shown(&t);
            }
            CHECK_MSG(shown[1] * 2 < shown[0], "%s: %d, then %d", lmb_kernels_name(lmb_kernels_at(m)), (int)shown[0],
                      (int)shown[1]);
        }
    }
}

/* lmb_bins_rows and lmb_bins_bytes at their limits; with fewer bytes fewer triangles fit. */
static void test_memory(void)
{
    test_rng r = {24};
    lmb_view v;
    lmb_bins bins;
    make_tall_stage(&r, LMB_PERSPECTIVE);
    v = st.view;
    CHECK(lmb_bins_rows(&v) == 128);
    v.frame_width = 2048;
    CHECK(lmb_bins_rows(&v) == 128);
    v.frame_width = 2049;
    CHECK(lmb_bins_rows(&v) == 64);
    v.frame_width = LMB_MAX_FRAME;
    CHECK(lmb_bins_rows(&v) == 16);
    CHECK(lmb_bins_bytes(&v, 0) > 0 && lmb_bins_bytes(&v, 1600) >= 2 * 32 * 1600 + lmb_bins_bytes(&v, 0));
    v.frame_width = 0;
    CHECK(lmb_bins_rows(&v) == 0 && lmb_bins_bytes(&v, 9) == 0 && lmb_bins_rows(NULL) == 0);
    CHECK(lmb_bins_bytes(NULL, 9) == 0);
    const size_t few = lmb_bins_bytes(&st.view, 64), some = lmb_bins_bytes(&st.view, 320);
    CHECK(build(&bins, 1, few, picked_kernels(), 0, NULL, NULL) == 1);
    const uint32_t past = bins.past_id;
    CHECK(build(&bins, 1, some, picked_kernels(), 0, NULL, NULL) == 1);
    CHECK(past > 1 && bins.past_id > past);
    CHECK(build(&bins, 1, WHOLE, picked_kernels(), 0, NULL, NULL) == 0 && bins.past_id == UINT32_MAX);
}

/* The largest size in bytes in which the first `count` triangles do not fit. */
static size_t just_short(lmb_bins *bins, uint32_t count)
{
    size_t low = 0, high = WHOLE;
    while (high - low > 1) {
        bins->bytes = low + (high - low) / 2;
        CHECK(lmb_bins_build(bins, picked_kernels(), &st.view, &st.scene, 1, count, 0, NULL, NULL) == LMB_OK);
        if (bins->past_id == bins->end_id) {
            high = bins->bytes;
        } else {
            low = bins->bytes;
        }
    }
    return low;
}

/* If all but the last few triangles fit, and sometimes all but one, the rest is drawn too. */
static void test_last_one(void)
{
    test_rng r = {24};
    const int32_t frame[4] = {0, 0, WIDE, HIGH};
    int alone = 0;
    make_tall_stage(&r, LMB_PERSPECTIVE);
    for (uint32_t count = 1; count <= 80; ++count) {
        lmb_bins bins;
        int32_t x, y;
        const lmb_target t[2] = {window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, frame, 0),
                                 window_of(1, LMB_DEPTH32F, LMB_ID32, LMB_TILED, frame, 1)};
        memset(&bins, 0, sizeof bins);
        bins.memory = memory[0];
        bins.bytes = just_short(&bins, count);
        CHECK(lmb_bins_build(&bins, picked_kernels(), &st.view, &st.scene, 1, count, 0, NULL, NULL) == LMB_OK);
        alone += bins.end_id - bins.past_id == 1;
        CHECK(lmb_draw(&t[0], picked_kernels(), &st.view, &st.scene, 1, count, 0, NULL) == LMB_OK);
        CHECK(lmb_bins_draw(&t[1], picked_kernels(), &bins, 1, 1, NULL) == LMB_OK);
        CHECK(lmb_surface_diff(&x, &y, &t[0].depth, &t[1].depth) == 0);
        CHECK(lmb_surface_diff(&x, &y, &t[0].id, &t[1].id) == 0);
    }
    CHECK_MSG(alone > 0, "%d", alone);
}

static void test_refused(void)
{
    test_rng r = {24};
    const int32_t frame[4] = {0, 0, WIDE, HIGH};
    const lmb_kernels *k = picked_kernels();
    lmb_bins bins[RANGES], none;
    lmb_view bad;
    make_tall_stage(&r, LMB_PERSPECTIVE);
    const lmb_target t = window_of(1, LMB_DEPTH32F, LMB_ID32, LMB_TILED, frame, 0);
    const lmb_culling few = {bound, NULL, lmb_culling_tiles(&t) - 1, 0}, short_of_clusters = {NULL, st.cluster, 0, 12};
    memset(&none, 0, sizeof none);
    memset(&bad, 0, sizeof bad);
    CHECK(build(bins, RANGES, WHOLE, k, 0, NULL, NULL) == 0);
    CHECK(lmb_bins_build(NULL, k, &st.view, &st.scene, 1, 9, 0, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_bins_build(&none, NULL, &st.view, &st.scene, 1, 9, 0, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_bins_build(&none, k, NULL, &st.scene, 1, 9, 0, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_bins_build(&none, k, &bad, &st.scene, 1, 9, 0, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_bins_build(&none, k, &st.view, NULL, 1, 9, 0, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_bins_build(&none, k, &st.view, &st.scene, 0, 9, 0, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_bins_build(&none, k, &st.view, &st.scene, 1, 9, 0, &short_of_clusters, NULL) == LMB_ERR_CAPACITY);
    CHECK(lmb_bins_draw(&t, k, &none, 1, 0, NULL) == LMB_ERR_ARG); /* not built */
    CHECK(lmb_bins_draw(NULL, k, bins, 1, 0, NULL) == LMB_ERR_ARG);
    CHECK(lmb_bins_draw(&t, NULL, bins, 1, 0, NULL) == LMB_ERR_ARG);
    CHECK(lmb_bins_draw(&t, k, NULL, 1, 0, NULL) == LMB_ERR_ARG);
    CHECK(lmb_bins_draw(&t, k, bins, 0, 0, NULL) == LMB_ERR_ARG);
    CHECK(lmb_bins_draw(&t, k, bins, 1, 0, &few) == LMB_ERR_CAPACITY);
    CHECK(lmb_bins_draw(&t, k, bins, 1, 0, &short_of_clusters) == LMB_ERR_CAPACITY);
    lmb_scene empty = st.scene;
    empty.instances = NULL;
    empty.instance_count = 0;
    CHECK(lmb_bins_build(&none, k, &st.view, &empty, 1, 9, 0, NULL, NULL) == LMB_OK);
    CHECK(lmb_bins_draw(&t, k, bins, RANGES, 0, NULL) == LMB_OK);
    bins[1].past_id = bins[1].first_id;
    CHECK(lmb_bins_draw(&t, k, bins, RANGES, 0, &short_of_clusters) == LMB_ERR_CAPACITY);
    bins[1].view.frame_height -= 8;
    CHECK(lmb_bins_draw(&t, k, bins, RANGES, 0, NULL) == LMB_ERR_ARG); /* from two frames */
}

void test_bins(void)
{
    test_same_bytes();
    test_windows();
    test_hidden();
    test_memory();
    test_last_one();
    test_refused();
}
#else
void test_bins(void) {}
#endif
