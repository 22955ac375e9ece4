/* test_culled.c: layer 3: lmb_draw_culled leaves the same bytes as lmb_draw, whatever is hidden, and no bound is too
 * near.
 *
 * Scenes are random: on every backend, in every format, in windows that end within a tile. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <sys/mman.h>
#endif

#include <lambent/raster.h>

#include "../crowd.h"
#include "../laid_surface.h"

void test_culled(void);

#if LMB_CULLING
enum { TILES = 18 * 18 + 15, SCENES = 6 };

static uint32_t depth_memory[2][SIDE * SIDE], id_memory[2][SIDE * SIDE];
static float bound[TILES];

/* A cleared window in memory 0 or 1. */
static lmb_target window_of(int which, int32_t depth_format, int32_t id_format, int32_t layout, int32_t side, int32_t x0)
{
    lmb_target t;
    memset(&t, 0, sizeof t);
    memset(depth_memory[which], 0, sizeof depth_memory[which]);
    memset(id_memory[which], 0, sizeof id_memory[which]);
    t.depth = surface_of(depth_format, layout, side, side, depth_memory[which]);
    if (id_format != LMB_FORMAT_NONE) {
        t.id = surface_of(id_format, layout, side, side, id_memory[which]);
    }
    t.x0 = t.y0 = x0;
    return t;
}

static float depth_at(const lmb_surface *s, int32_t x, int32_t y)
{
    const size_t step = (size_t)(s->stride_bytes / lmb_pixel_bytes(s->format));
    const size_t at = s->layout == LMB_LINEAR ? (size_t)y * step + (size_t)x
                                              : (size_t)(y / 8) * step + (size_t)(x / 8 * 64 + y % 8 * 8 + x % 8);
    return s->format == LMB_DEPTH16 ? (float)((const uint16_t *)s->data)[at] : ((const float *)s->data)[at];
}

/* Number of pixels farther than the bound of their tile. */
static int32_t too_far(const lmb_surface *s)
{
    const int32_t across = (s->width + 7) / 8;
    int32_t n = 0;
    for (int32_t y = 0; y < s->height; ++y) {
        for (int32_t x = 0; x < s->width; ++x) {
            n += !(bound[y / 8 * across + x / 8] <= depth_at(s, x, y));
        }
    }
    return n;
}

static int32_t raised(const lmb_target *t)
{
    int32_t n = 0;
    for (uint32_t i = 0; i < lmb_culling_tiles(t); ++i) {
        n += bound[i] > 0.0f;
    }
    return n;
}

typedef struct totals {
    uint32_t drawn[2], all[2];
    int32_t raised;
} totals;

/* Draws one window both ways, in two calls; with bounds, clusters or both. */
static void draw_both(const lmb_kernels *kernels, const lmb_target t[2], uint32_t flags, int how, totals *sum)
{
    const uint32_t all = lmb_scene_triangles(&st.scene), half = all / 2;
    lmb_culling culling;
    lmb_stats stats[2];
    int32_t x, y;
    memset(stats, 0, sizeof stats);
    memset(bound, 0, sizeof bound);
    memset(&culling, 0, sizeof culling);
    if (how != 1) {
        culling.farthest = bound;
        culling.tiles = lmb_culling_tiles(&t[1]);
    }
    if (how != 2) {
        culling.clusters = st.cluster;
        culling.cluster_count = CLUSTERS;
    }
    CHECK(lmb_draw(&t[0], kernels, &st.view, &st.scene, 1, all, flags, &stats[0]) == LMB_OK);
    CHECK(lmb_draw_culled(&t[1], kernels, &st.view, &st.scene, 1, half, flags, 0, &culling, &stats[1]) == LMB_OK);
    CHECK(lmb_draw_culled(&t[1], kernels, &st.view, &st.scene, 1 + half, all, flags, 0, &culling, &stats[1]) == LMB_OK);
    CHECK(lmb_surface_diff(&x, &y, &t[0].depth, &t[1].depth) == 0);
    CHECK(t[0].id.data == NULL || lmb_surface_diff(&x, &y, &t[0].id, &t[1].id) == 0);
    CHECK(too_far(&t[1].depth) == 0);
    CHECK(stats[0].triangles == stats[1].triangles && stats[0].triangles_dropped == stats[1].triangles_dropped);
    for (int i = 0; i < 2; ++i) {
        sum->drawn[i] += (uint32_t)stats[i].triangles_drawn;
        sum->all[i] += (uint32_t)stats[i].triangles;
    }
    sum->raised += raised(&t[1]);
}

static void same_bytes(test_rng *r, const lmb_kernels *kernels, totals *sum)
{
    static const int32_t depths[] = {LMB_DEPTH32F, LMB_DEPTH16}, ids[] = {LMB_FORMAT_NONE, LMB_ID32, LMB_ID16};
    for (int i = 0; i < 12; ++i) {
        const int is_whole = test_random(r) % 3 == 0;
        const int32_t side = is_whole ? SIDE : 100 - 3 * i, x0 = is_whole ? 0 : 8 * (int32_t)(test_random(r) % 5);
        const int32_t layout = i & 1 ? LMB_LINEAR : LMB_TILED;
        lmb_target t[2];
        for (int k = 0; k < 2; ++k) {
            t[k] = window_of(k, depths[i / 6], ids[i / 2 % 3], layout, side, x0);
        }
        draw_both(kernels, t, test_random(r) % 2 ? LMB_CULL_BACK : 0, i % 4, sum);
    }
}

static void test_same_bytes(void)
{
    test_rng r = {24};
    for (int32_t m = 0; lmb_kernels_at(m) != NULL; ++m) {
        totals sum;
        memset(&sum, 0, sizeof sum);
        for (int i = 0; i < SCENES; ++i) {
            make_stage(&r, i % 3 == 2 ? LMB_ORTHOGRAPHIC : LMB_PERSPECTIVE);
            CHECK(lmb_clusters_build(st.cluster, CLUSTERS, &st.scene) == LMB_OK);
            same_bytes(&r, lmb_kernels_at(m), &sum);
        }
        CHECK(sum.drawn[1] * 10 < sum.drawn[0] * 9); /* clusters were left out */
        CHECK(sum.raised > 1000 || strncmp(lmb_kernels_name(lmb_kernels_at(m)), "avx", 3) != 0);
    }
}

/* If all depths are nearer, clusters in the window are left out. */
static void test_hidden(void)
{
    test_rng r = {24};
    make_stage(&r, LMB_ORTHOGRAPHIC);
    CHECK(lmb_clusters_build(st.cluster, CLUSTERS, &st.scene) == LMB_OK);
    for (int32_t m = 0; lmb_kernels_at(m) != NULL; ++m) {
        const lmb_target t = window_of(1, LMB_DEPTH32F, LMB_FORMAT_NONE, LMB_TILED, SIDE, 0);
        const lmb_culling culling = {bound, st.cluster, TILES, CLUSTERS};
        const uint32_t all = lmb_scene_triangles(&st.scene);
        lmb_stats stats[2];
        memset(stats, 0, sizeof stats);
        for (int i = 0; i < 2; ++i) {
            for (int k = 0; k < TILES; ++k) {
                bound[k] = (float)(2 * i);
            }
            for (int k = 0; k < SIDE * SIDE; ++k) {
                ((float *)t.depth.data)[k] = (float)(2 * i);
            }
            CHECK(lmb_draw_culled(&t, lmb_kernels_at(m), &st.view, &st.scene, 1, all, 0, 0, &culling, &stats[i]) ==
                  LMB_OK);
        }
        CHECK_MSG(stats[1].triangles_drawn * 2 < stats[0].triangles_drawn, "%s: %d, then %d",
                  lmb_kernels_name(lmb_kernels_at(m)), (int)stats[0].triangles_drawn, (int)stats[1].triangles_drawn);
    }
}

/* Invalid triangles are counted even if hidden. */
static void test_dropped(void)
{
    test_rng r = {24};
    lmb_stats stats;
    make_stage(&r, LMB_PERSPECTIVE);
    st.crowd[9 * 70] = 3e38f;
    CHECK(lmb_clusters_build(st.cluster, CLUSTERS, &st.scene) == LMB_OK);
    CHECK(st.cluster[1].low.x < -1e38f && st.cluster[1].high.z > 1e38f && st.cluster[0].high.x < 100.0f);
    memset(&stats, 0, sizeof stats);
    const lmb_target t = window_of(1, LMB_DEPTH32F, LMB_ID32, LMB_TILED, SIDE, 0);
    const lmb_culling culling = {bound, st.cluster, TILES, CLUSTERS};
    memset(bound, 0, sizeof bound);
    CHECK(lmb_draw_culled(&t, picked_kernels(), &st.view, &st.scene, 1, 5000, 0, 0, &culling, &stats) == LMB_OK);
    CHECK(stats.triangles_dropped == 2); /* once per instance */
    st.crowd[9 * 70] = 0.0f;
    CHECK(lmb_clusters_build(st.cluster, CLUSTERS, &st.scene) == LMB_OK && st.cluster[1].high.z < 100.0f);
    --st.mesh[0].vertex_count; /* of the last triangle, a vertex that is not there */
    CHECK(lmb_clusters_build(st.cluster, CLUSTERS, &st.scene) == LMB_OK);
    CHECK(st.cluster[10].low.x < -1e38f && st.cluster[10].high.z > 1e38f && st.cluster[9].high.x < 100.0f);
}

static void test_refused(void)
{
    test_rng r = {24};
    make_stage(&r, LMB_PERSPECTIVE);
    const lmb_target t = window_of(1, LMB_DEPTH32F, LMB_ID32, LMB_TILED, SIDE, 0);
    const lmb_kernels *k = picked_kernels();
    const lmb_culling few = {bound, NULL, 17 * 17 - 1, 0}, short_of_clusters = {NULL, st.cluster, 0, 12},
                      none = {NULL, NULL, 0, 0};
    CHECK(lmb_culling_tiles(&t) >= 17 * 17 && lmb_culling_tiles(&t) <= TILES);
    CHECK(lmb_culling_tiles(NULL) == 0 && lmb_culling_clusters(NULL) == 0);
    CHECK(lmb_culling_clusters(&st.scene) == 11 + 2);
    CHECK(lmb_clusters_build(NULL, CLUSTERS, &st.scene) == LMB_ERR_ARG);
    CHECK(lmb_clusters_build(st.cluster, CLUSTERS, NULL) == LMB_ERR_ARG);
    CHECK(lmb_clusters_build(st.cluster, 12, &st.scene) == LMB_ERR_CAPACITY);
    CHECK(lmb_draw_culled(&t, NULL, &st.view, &st.scene, 1, 9, 0, 0, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_draw_culled(&t, k, &st.view, &st.scene, 0, 9, 0, 0, &none, NULL) == LMB_ERR_ARG);
    CHECK(lmb_draw_culled(&t, k, &st.view, &st.scene, 1, 9, 0, 0, &few, NULL) == LMB_ERR_CAPACITY);
    CHECK(lmb_draw_culled(&t, k, &st.view, &st.scene, 1, 9, 0, 0, &short_of_clusters, NULL) == LMB_ERR_CAPACITY);
    CHECK(lmb_draw_culled(&t, k, &st.view, &st.scene, 1, 9, 0, 0, &none, NULL) == LMB_OK);
}

enum { FRESH_FRAME = 1024, FRESH_TILES = 128 * 128 + 15 };

/* A window of 1,000 x 904 pixels over used memory. */
static lmb_target fresh_window(void *depth, void *id, int32_t layout, int32_t depth_format)
{
    lmb_target t;
    memset(&t, 0, sizeof t);
    memset(depth, 0x3c, 4 * FRESH_FRAME * FRESH_FRAME);
    memset(id, 0x3c, 4 * FRESH_FRAME * FRESH_FRAME);
    t.depth = surface_of(depth_format, layout, 1000, 904, depth);
    t.id = surface_of(LMB_ID32, layout, 1000, 904, id);
    t.x0 = 8, t.y0 = 16;
    return t;
}

/* With `clear`, lmb_draw_culled resets what was there. */
static void test_fresh(void)
{
    const size_t bytes = 4 * FRESH_FRAME * FRESH_FRAME;
    uint8_t *memory = malloc(4 * bytes);
    float *farthest = malloc(FRESH_TILES * sizeof *farthest);
    test_rng r = {29};
    CHECK(memory != NULL && farthest != NULL);
    for (int i = 0; memory != NULL && farthest != NULL && i < 8; ++i) {
        lmb_target t[2];
        lmb_stats stats[2];
        int32_t x, y;
        make_stage(&r, i % 4 == 3 ? LMB_ORTHOGRAPHIC : LMB_PERSPECTIVE);
        st.view.frame_width = st.view.frame_height = FRESH_FRAME;
        CHECK(lmb_clusters_build(st.cluster, CLUSTERS, &st.scene) == LMB_OK);
        for (int k = 0; k < 2; ++k) {
            t[k] = fresh_window(memory + (size_t)k * 2 * bytes, memory + ((size_t)k * 2 + 1) * bytes,
                                i & 1 ? LMB_LINEAR : LMB_TILED, i & 4 ? LMB_DEPTH16 : LMB_DEPTH32F);
        }
        for (int32_t k = 0; k < FRESH_TILES; ++k) {
            farthest[k] = 0.9f;
        }
        const lmb_culling culling = {i % 3 == 0 ? NULL : farthest, i % 3 == 1 ? NULL : st.cluster, FRESH_TILES, CLUSTERS};
        const uint32_t count = i & 2 ? 40 : lmb_scene_triangles(&st.scene);
        const lmb_kernels *kernels = lmb_kernels_at(i % 3) != NULL ? lmb_kernels_at(i % 3) : lmb_kernels_pick();
        memset(stats, 0, sizeof stats);
        lmb_surface_clear(&t[0].depth);
        lmb_surface_clear(&t[0].id);
        CHECK(lmb_draw(&t[0], kernels, &st.view, &st.scene, 1, count, 0, &stats[0]) == LMB_OK);
        CHECK(lmb_draw_culled(&t[1], kernels, &st.view, &st.scene, 1, count, 0, 1, i == 6 ? NULL : &culling,
                             i % 5 == 0 ? &stats[1] : NULL) == LMB_OK);
        CHECK_MSG(lmb_surface_diff(&x, &y, &t[0].depth, &t[1].depth) == 0, "draw %d: %d, %d", i, (int)x, (int)y);
        CHECK_MSG(lmb_surface_diff(&x, &y, &t[0].id, &t[1].id) == 0, "draw %d: %d, %d", i, (int)x, (int)y);
        CHECK(stats[0].triangles_drawn > 0 && (i % 5 != 0 || stats[1].triangles == count));
    }
    const lmb_target t = fresh_window(memory, memory + bytes, LMB_TILED, LMB_DEPTH32F);
    const lmb_culling few = {farthest, NULL, 17, 0};
    CHECK(lmb_draw_culled(&t, picked_kernels(), &st.view, &st.scene, 1, 9, 0, 1, &few, NULL) == LMB_ERR_CAPACITY);
    CHECK(lmb_draw_culled(&t, picked_kernels(), &st.view, &st.scene, 0, 9, 0, 1, NULL, NULL) == LMB_ERR_ARG);
    CHECK(*(uint8_t *)t.depth.data == 0x3c); /* nothing was reset */
    free(memory);
    free(farthest);
}

/* Half of a batch lies outside the frame. Setup stores nothing for it, so leftovers of an earlier draw name tiles of
 * another window, and the bounds of those must not be read. They would lie in protected pages, because sanitizers do
 * not check gathers. */
#ifdef __linux__
enum { FAR_FRAME = 1024, FAR_WINDOW = 64, GUARD = 1 << 18 };

/* 16 triangles at a pixel of the frame's diagonal; if is_half, the first 8 lie outside the frame. */
static void draw_at(const lmb_kernels *k, float pixel, int32_t x0, int is_half, float *farthest)
{
    test_rng r = {24};
    const lmb_target t = window_of(1, LMB_DEPTH32F, LMB_FORMAT_NONE, LMB_TILED, FAR_WINDOW, x0);
    const lmb_culling culling = {farthest, NULL, lmb_culling_tiles(&t), 0};
    const float place = (pixel / (float)FAR_FRAME * 2.0f - 1.0f) * st.view.half_width;
    int32_t seen = 0;
    for (int i = 0; i < 16; ++i) {
        const float at[3] = {is_half && i < 8 ? 100.0f : place, -place, -5.0f};
        put_triangle(&r, st.crowd + 9 * i, at, 0.05f);
    }
    memset(farthest, 0, culling.tiles * sizeof *farthest);
    CHECK(lmb_draw_culled(&t, k, &st.view, &st.scene, 1, 16, 0, 0, &culling, NULL) == LMB_OK);
    for (int32_t i = 0; i < FAR_WINDOW * FAR_WINDOW; ++i) {
        seen += ((float *)t.depth.data)[i] > 0.0f;
    }
    CHECK_MSG(seen > 10, "%s: %d pixels", lmb_kernels_name(k), (int)seen);
}

static void test_half_a_batch(void)
{
    test_rng r = {24};
    uint8_t *pages = mmap(NULL, 2 * GUARD, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    CHECK(pages != MAP_FAILED && mprotect(pages + GUARD, GUARD, PROT_READ | PROT_WRITE) == 0);
    make_stage(&r, LMB_ORTHOGRAPHIC);
    st.mesh[0].triangle_count = 16;
    st.mesh[0].vertex_count = 48;
    st.material[0].flags = LMB_DOUBLE_SIDED;
    st.instance[1].first_id = 1;
    st.scene.instances = st.instance + 1;
    st.scene.instance_count = 1;
    st.view.frame_width = st.view.frame_height = FAR_FRAME;
    for (int32_t m = 0; lmb_kernels_at(m) != NULL; ++m) {
        draw_at(lmb_kernels_at(m), 32.0f, 0, 0, (float *)(void *)(pages + GUARD));
        draw_at(lmb_kernels_at(m), FAR_FRAME - 32.0f, FAR_FRAME - FAR_WINDOW, 1, (float *)(void *)(pages + GUARD));
    }
    munmap(pages, 2 * GUARD);
}
#else
static void test_half_a_batch(void) {}
#endif

void test_culled(void)
{
    test_half_a_batch();
    test_same_bytes();
    test_fresh();
    test_hidden();
    test_dropped();
    test_refused();
}
#else
void test_culled(void) {}
#endif
