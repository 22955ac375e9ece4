/* test_threads.c: work of a frame divided among threads: the pool's pieces, a stage's parts, a map's rows, counts. */
#include <string.h>

#include <lambent/lambent.h>

#include "../../tools/common/workers.h"
#include "../../tools/demo/demo_scene.h"
#include "../test.h"

void test_threads(void);

enum { W = 40, H = 36, MAP = 64, SIDE = MAP / 8, POINTS = 4 * SIDE * SIDE, FACES = 7, THREADS = 8, PIECES = 20000 };

/* --- the pool ----------------------------------------------------------------------------------------------------- */

typedef struct counted_heap {
    unsigned char times[THREADS][PIECES]; /* per worker: no two threads write the same */
    int out_of_range[THREADS];
    int count, threads;
} counted_heap;

static counted_heap pieces;

static void note_piece(void *user, int index, int worker)
{
    counted_heap *t = user;
    if (worker >= 0 && worker < THREADS && index >= 0 && index < PIECES) {
        ++t->times[worker][index];
    }
    if (index >= t->count || worker >= t->threads) {
        ++t->out_of_range[worker];
    }
}

/* Every piece runs once, on an existing worker. */
static void check_pool(int threads, int count)
{
    int wrong = 0;
    memset(&pieces, 0, sizeof pieces);
    pieces.count = count;
    pieces.threads = threads;
    pool_run(threads, count, note_piece, &pieces);
    for (int i = 0; i < PIECES; ++i) {
        int times = 0;
        for (int w = 0; w < THREADS; ++w) {
            times += pieces.times[w][i];
        }
        wrong += times != (i < count);
    }
    for (int w = 0; w < THREADS; ++w) {
        wrong += pieces.out_of_range[w];
    }
    CHECK_MSG(wrong == 0, "%d threads, %d pieces: %d wrong", threads, count, wrong);
}

/* Stages: pieces of the second start after all of the first, however long those take. */
typedef struct staged {
    int first, done[64], early[THREADS]; /* done: per piece; early: per worker, pieces started too soon */
    int times[64];
} staged;

static void note_stage(void *user, int index, int worker)
{
    staged *s = user;
    if (index < s->first) {
        volatile int spun = 0;
        while (spun < 20000 * (index % 3)) {
            ++spun;
        }
        s->done[index] = 1;
    }
    for (int i = 0; i < s->first && index >= s->first; ++i) {
        s->early[worker] += !s->done[i];
    }
    ++s->times[index];
}

static void check_stages(int threads, int first, int count)
{
    staged s;
    int wrong = 0;
    memset(&s, 0, sizeof s);
    s.first = first;
    pool_run_stages(threads, first, count, note_stage, &s);
    for (int i = 0; i < 64; ++i) {
        wrong += s.times[i] != (i < count);
    }
    for (int w = 0; w < THREADS; ++w) {
        wrong += s.early[w];
    }
    CHECK_MSG(wrong == 0, "%d threads, %d of %d pieces first: %d wrong", threads, first, count, wrong);
}

static void test_stages(void)
{
    for (int threads = 1; threads <= THREADS; ++threads) {
        check_stages(threads, threads, 64);
        check_stages(threads, 1, 2);
        check_stages(threads, 5, 40);
        check_stages(threads, 64, 64);
        check_stages(threads, 0, 9);
    }
}

static void test_pool(void)
{
    static const int counts[] = {0, 1, 2, 7, 8, 9, 60, PIECES};
    for (int threads = 1; threads <= THREADS; ++threads) {
        for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) {
            check_pool(threads, counts[i]);
        }
    }
    CHECK(pool_processors() >= 1 && pool_processors() <= POOL_MAX);
}

/* --- a frame with lights of one and of six faces ------------------------------------------------------------------ */

static struct memory {
    uint32_t depth[W * 40], id[W * 40], map[FACES * MAP * MAP * 2];
    float out[2][W * H * 3];
    lmb_point points[2][FACES * POINTS];
    uint32_t cells[2][SIDE * SIDE + 1], owner[2][FACES * MAP * MAP];
    lmb_groups groups;
    lmb_band_scratch scratch[THREADS];
    lmb_render render;
} m;
static lmb_light lights[2];
static lmb_scene lit;

/* which: one of two sets of memory for pictures and points. The small configuration has one light: the point light,
 * with six faces. */
static lmb_frame make_frame(int which, lmb_stats *stats)
{
    lmb_frame f;
    memset(&f, 0, sizeof f);
    lit = *demo_scene();
    lights[0] = lights[1] = lit.lights[0];
    lights[0].kind = LMB_LIGHT_POINT;
    lights[0].position.y -= 0.5f;
    lit.lights = lights;
    lit.light_count = LMB_MAX_LIGHTS < 2 ? 1 : 2;
    f.kernels = picked_kernels();
    f.scene = &lit;
    f.view = demo_view(W, H);
    f.shadow_map = MAP;
    f.grouping.groups = 60;
    f.occlusion = LMB_OCCLUSION_VIEW;
    f.steps = 4;
    f.map_memory = m.map;
    f.map_bytes = sizeof m.map;
    f.points.data = m.points[which];
    f.points.cap = FACES * POINTS;
    f.points.cells = m.cells[which];
    f.points.cell_cap = SIDE * SIDE + 1;
    f.points.owner = m.owner[which];
    f.points.owner_cap = FACES * MAP * MAP;
    f.groups = &m.groups;
    f.scratch = m.scratch;
    f.stats = stats;
    lmb_surface_init(&f.eye.depth, LMB_DEPTH32F, W, H, m.depth, sizeof m.depth);
    lmb_surface_init(&f.eye.id, LMB_ID32, W, H, m.id, sizeof m.id);
    lmb_surface_init(&f.out, LMB_RGB32F, W, H, m.out[which], sizeof m.out[which]);
    memset(m.out[which], 0x3c, sizeof m.out[which]);
    memset(m.points[which], 0, sizeof m.points[which]);
    memset(m.cells[which], 0x3c, sizeof m.cells[which]);
    memset(m.owner[which], 0, sizeof m.owner[which]);
    memset(m.map, 0x3c, sizeof m.map);
    memset(m.depth, 0x3c, sizeof m.depth); /* leftovers of an earlier frame must not matter */
    memset(m.id, 0x3c, sizeof m.id);
    return f;
}

/* Two frames have the same picture, discs, owners of texels, cells of the last face, and counts. */
static int is_same(const lmb_stats *a, const lmb_stats *b)
{
    return memcmp(m.out[0], m.out[1], sizeof m.out[0]) == 0 && memcmp(m.cells[0], m.cells[1], sizeof m.cells[0]) == 0 &&
           memcmp(m.points[0], m.points[1], a->discs * sizeof(lmb_point)) == 0 &&
           memcmp(m.owner[0], m.owner[1], sizeof m.owner[0]) == 0 && a->triangles == b->triangles &&
           a->triangles_drawn == b->triangles_drawn && a->triangles_dropped == b->triangles_dropped &&
           a->first_points == b->first_points && a->discs == b->discs && a->groups == b->groups &&
           a->regroups == b->regroups && a->bands == b->bands && a->flux_lit == b->flux_lit &&
           a->flux_grouped == b->flux_grouped;
}

static void test_workers(void)
{
    lmb_stats one, many;
    memset(&one, 0, sizeof one);
    lmb_frame f = make_frame(0, &one);
    CHECK(lmb_render_frame(&m.render, &f) == LMB_OK && one.discs > 100 &&
          one.triangles >= 7 * lmb_scene_triangles(&lit));
    for (int threads = 1; threads <= THREADS; ++threads) {
        workers c;
        int32_t stage;
        memset(&c, 0, sizeof c);
        memset(&many, 0, sizeof many);
        f = make_frame(1, &many);
        c.threads = threads;
        c.scratches = m.scratch;
        CHECK(workers_render(&c, &stage, &m.render, &f) == LMB_OK && stage == LMB_STAGE_BANDS);
        CHECK_MSG(is_same(&one, &many), "%d threads", threads);
    }
}

/* --- parts -------------------------------------------------------------------------------------------------------- */

static void check_refusals(lmb_render *r)
{
    CHECK(lmb_render_part(NULL, m.scratch, 0, 1, NULL) == LMB_ERR_ARG);
    CHECK(lmb_render_part(r, NULL, 0, 1, NULL) == LMB_ERR_ARG);
    CHECK(lmb_render_part(r, m.scratch, -1, 2, NULL) == LMB_ERR_ARG);
    CHECK(lmb_render_part(r, m.scratch, 2, 2, NULL) == LMB_ERR_ARG);
    CHECK(lmb_render_part(r, m.scratch, 0, 0, NULL) == LMB_ERR_ARG);
    CHECK(lmb_render_parts_done(r, 0) == LMB_ERR_ARG);
}

/* A stage already begun with steps, or too short, has no parts; first points need memory for four per block. */
static void test_stages_with_parts(void)
{
    lmb_frame f = make_frame(0, NULL);
    int32_t stage;
    CHECK(!lmb_render_has_parts(NULL) && lmb_render_parts_done(NULL, 1) == LMB_ERR_ARG);
    CHECK(lmb_render_begin(&m.render, &f) == LMB_OK);
    for (stage = LMB_STAGE_SHADOW_MAP; stage < LMB_STAGE_SAMPLES; ++stage) {
        const int whole =
            stage == LMB_STAGE_GROUPS || stage == LMB_STAGE_BVH || stage == LMB_STAGE_BOUNCES;
        CHECK_MSG(lmb_render_has_parts(&m.render) == !whole, "stage %d", (int)stage);
        check_refusals(&m.render);
        CHECK(lmb_render_step(&m.render, 1) == LMB_MORE);
        CHECK_MSG(m.render.stage != stage || !lmb_render_has_parts(&m.render), "stage %d begun", (int)stage);
        while (m.render.stage == stage && lmb_render_step(&m.render, 1000) == LMB_MORE) {
        }
    }
    CHECK(!lmb_render_has_parts(&m.render) && lmb_render_parts_done(&m.render, 1) == LMB_ERR_ARG);
    f = make_frame(0, NULL);
    f.points.cap = POINTS - 1;
    CHECK(lmb_render_begin(&m.render, &f) == LMB_OK && lmb_render_parts_done(&m.render, 1) == LMB_MORE &&
          lmb_render_step(&m.render, 1) == LMB_MORE);
    CHECK(m.render.stage == LMB_STAGE_POINTS && !lmb_render_has_parts(&m.render));
    ++m.render.frame.points.cap;
    CHECK(lmb_render_has_parts(&m.render));
    --m.render.frame.points.owner_cap;
    CHECK(lmb_render_has_parts(&m.render));
    m.render.frame.points.owner_cap = MAP * MAP - 1;
    CHECK(!lmb_render_has_parts(&m.render) && lmb_render_step(&m.render, 1) == LMB_ERR_CAPACITY);
    m.render.failed = LMB_OK;
    m.render.stage = LMB_STAGE_POINTS;
    m.render.frame.points.owner = NULL;
    CHECK(lmb_render_has_parts(&m.render));
    m.render.frame.grouping.block = 3;
    CHECK(!lmb_render_has_parts(&m.render));
}

static void test_map_rows(void)
{
    const int32_t rows = MAP / LMB_TILE;
    lmb_shadow_map map;
    lmb_stats stats;
    make_frame(0, NULL);
    CHECK(lmb_shadow_map_init(&map, &lights[0], &lit, MAP, LMB_ID32, m.map, sizeof m.map) == LMB_OK && map.faces == 6);
    CHECK(lmb_shadow_map_rows(NULL, picked_kernels(), &lit, 0, 1, NULL) == LMB_ERR_ARG);
    CHECK(lmb_shadow_map_rows(&map, NULL, &lit, 0, 1, NULL) == LMB_ERR_ARG);
    CHECK(lmb_shadow_map_rows(&map, picked_kernels(), NULL, 0, 1, NULL) == LMB_ERR_ARG);
    CHECK(lmb_shadow_map_rows(&map, picked_kernels(), &lit, -1, 1, NULL) == LMB_ERR_ARG);
    CHECK(lmb_shadow_map_rows(&map, picked_kernels(), &lit, 2, 1, NULL) == LMB_ERR_ARG);
    CHECK(lmb_shadow_map_rows(&map, picked_kernels(), &lit, 0, 6 * rows + 1, NULL) == LMB_ERR_ARG);
    memset(&stats, 0, sizeof stats);
    CHECK(lmb_shadow_map_rows(&map, picked_kernels(), &lit, 1, rows, &stats) == LMB_OK && stats.triangles == 0);
    CHECK(lmb_shadow_map_rows(&map, picked_kernels(), &lit, rows, 2 * rows + 1, &stats) == LMB_OK);
    CHECK(stats.triangles == 2 * lmb_scene_triangles(&lit));
}

void test_threads(void)
{
    test_pool();
    test_stages();
    test_workers();
    test_stages_with_parts();
    test_map_rows();
}
