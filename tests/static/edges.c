/* edges.c: Frama-C's Eva proves for one triangle that edge set-up and its sums over a frame and a tile
 * stay within their integers.
 *
 * Covers all corners that snapping gives (snap.c: +-2^22), and all pixels of a frame of LMB_MAX_FRAME plus a tile.
 * Every pixel is evaluated directly; stepping from tile to tile gives the same numbers (setup.c), so the proof covers
 * stepping. Eva takes every value in these ranges at once; a signed overflow, a bad shift or index, or an assertion
 * that it cannot prove is an alarm. */
#include "any.h"

#include "../../src/raster/setup.c"

#include "../../src/raster/fill.inl"
#include "../../src/raster/fill_large.inl"

#include "../../src/raster/fill.c"

enum {
    SNAP_MAX = 1 << 22,
    FRAME_24_8 = (LMB_MAX_FRAME / 2 + LMB_TILE) * 256,
    CHANGE_MAX = 2 * (LMB_TILE - 1) * 2 * SNAP_MAX /* of an edge within a tile: 117,440,512 */
};

static lmb_screen_vertex any_corner(void)
{
    lmb_screen_vertex v;
    v.x_24_8 = any_between(-SNAP_MAX, SNAP_MAX);
    v.y_24_8 = any_between(-SNAP_MAX, SNAP_MAX);
    v.d = any_share();
    return v;
}

static float depths[LMB_TILE_PIXELS];
static uint32_t ids[LMB_TILE_PIXELS];

static lmb_fill_tile any_tile(void)
{
    lmb_fill_tile tile;
    tile.depth = depths;
    tile.id = ids;
    tile.depth_step = tile.id_step = LMB_TILE;
    tile.depth_format = LMB_DEPTH32F;
    tile.id_format = any_between(0, 1) ? LMB_ID32 : LMB_FORMAT_NONE;
    return tile;
}

static lmb_fill_job any_job(void)
{
    lmb_fill_job job = {0};
    job.d = any_float(), job.dx = any_float(), job.dy = any_float();
    job.d_min = any_float(), job.d_max = any_float();
    job.id = 1;
    return job;
}

/* A tile that is outside no edge; large_row tests all three edges together. */
static int32_t any_inside(int64_t at, int64_t high)
{
    return at + high < 0 ? 0 : large_near(at);
}

static void cross_large(const lmb_setup *s, const large_edges *edges)
{
    const int32_t e[3] = {any_inside(edges->at.a, edges->high.a), any_inside(edges->at.b, edges->high.b),
                          any_inside(edges->at.c, edges->high.c)};
    const fill_box whole = {0, LMB_TILE - 1, 0, FILL_ACROSS - 1};
    const lmb_fill_tile tile = any_tile();
    const lmb_fill_job job = any_job();
    fill_triangle t;
    /*@ assert -CHANGE_MAX <= e[0] <= FAR_INSIDE; */
    fill_set(&t, s->ex, s->ey, &job, FILL_ANY);
    for (int i = 0; i < FILL_ACROSS; ++i) {
        fill_column(&tile, &job, &t, e, job.d, &whole, i);
    }
    /* An edge clamped to far inside stays inside. */
    /*@ assert FAR_INSIDE - CHANGE_MAX > 0; */
}

/* Points on the triangle and alpha tests do not use the integers of edges. */
void lmb_resolve_point(float *b1, float *b2, const lmb_plane *plane, const lmb_rays *rays, float x, float y)
{
    *b1 = any_float();
    *b2 = any_float();
}

int lmb_resolve_opaque(const lmb_resolve_alpha *alpha, const lmb_scene *scene, float b1, float b2)
{
    return any_between(0, 1);
}

static void cross_masked(const lmb_setup *s, int32_t x, int32_t y)
{
    static const lmb_scene scene = {0};
    lmb_fill_context context;
    lmb_fill_job job = any_job();
    lmb_view view;
    masked_surface surface;
    view.sample_x = any_between(-128, 127), view.sample_y = any_between(-128, 127);
    surface.blends = any_between(0, 1);
    surface.id = (uint32_t)any_between(1, 1 << 30);
    surface.batches = 0, surface.texture = NULL; /* kernels for whole tiles sum the same edges */
    surface.job.behind = any_share();
    surface.part = any_between(0, 1) ? LMB_COVERS_ALL : COVERS_SOME;
    surface.x = any_between(0, LMB_MAX_FRAME), surface.y = any_between(0, LMB_MAX_FRAME);
    context.view = &view;
    const lmb_fill_tile tile = any_tile();
    context.scene = &scene;
    if (enter_tile(&job, s, x, y)) {
        fill_tile_masked(&context, &tile, &job, &surface);
    }
}

static void ask_edges(const lmb_setup *s, const large_edges *edges)
{
    for (int i = 0; i < 3; ++i) {
        /*@ assert -2 * SNAP_MAX <= s->ex[i] <= 2 * SNAP_MAX && -2 * SNAP_MAX <= s->ey[i] <= 2 * SNAP_MAX; */
    }
    /*@ assert -1099511627776 <= edges->at.a <= 1099511627776; */
    /*@ assert -1099511627776 <= edges->at.b <= 1099511627776; */
    /*@ assert -1099511627776 <= edges->at.c <= 1099511627776; */
    /*@ assert -CHANGE_MAX <= edges->low.a <= 0 && 0 <= edges->high.a <= CHANGE_MAX; */
    /*@ assert -CHANGE_MAX <= edges->low.b <= 0 && 0 <= edges->high.b <= CHANGE_MAX; */
    /*@ assert -CHANGE_MAX <= edges->low.c <= 0 && 0 <= edges->high.c <= CHANGE_MAX; */
}

/* Counts equal tiles of a row, starting at any tile. */
static void count_large(const large_edges *edges)
{
    const int32_t count = any_between(1, LMB_MAX_FRAME / LMB_TILE);
    const int32_t inside = large_inside(edges, edges->at, count, LARGE_LEAP),
                  outside = large_outside(edges, edges->at, count);
    const int32_t most = LARGE_LEAP > 0 ? 2 * LARGE_LEAP : 1;
    /*@ assert 0 <= inside <= most && 0 <= outside <= most; */
    large_add(edges->at, large_times(edges->step_x, inside));
    large_add(edges->at, large_times(edges->step_x, outside));
}

/* One side of a box against any window of any frame. */
static void ask_spans(void)
{
    const int32_t frame = any_between(1, LMB_MAX_FRAME), window = any_between(0, LMB_MAX_FRAME);
    const int32_t tiles = any_between(1, LMB_MAX_FRAME / LMB_TILE);
    const int32_t low = any_between(-SNAP_MAX, SNAP_MAX), high = any_between(-SNAP_MAX, SNAP_MAX);
    int32_t first, last;
    const int32_t count = large_span(&first, low, high, 128 - frame * 128, window, tiles);
    /*@ assert first >= 0 && count <= LMB_MAX_FRAME / LMB_TILE; */
    tile_span(&first, &last, low, high, frame, window, tiles * LMB_TILE);
    /*@ assert first >= 0 && last < LMB_MAX_FRAME / LMB_TILE; */
}

int main(void)
{
    const lmb_screen_vertex a = any_corner(), b = any_corner(), c = any_corner();
    lmb_setup s = {0};
    ask_spans();
    if (lmb_setup_triangle(&s, &a, &b, &c)) {
        const int32_t x = any_between(-FRAME_24_8, FRAME_24_8), y = any_between(-FRAME_24_8, FRAME_24_8);
        large_edges edges = {0};
        large_set(&edges, &s, x, y);
        ask_edges(&s, &edges);
        cross_large(&s, &edges);
        count_large(&edges);
        cross_masked(&s, x, y);
    }
    return 0;
}
