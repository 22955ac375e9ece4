/* small.c: Frama-C's Eva proves for a batch's small triangles that no sum of setup.inl, fill_small.inl or
 * fill_parts.inl leaves 32 bits, and no row or column leaves its tile. `set_up` is the first half. `main` is the
 * second; it assumes the results of the first.
 *
 * Covers all corners of all boxes under 64 px. The sums use only differences from a corner and whole tiles, so the tile
 * with the box's low corner may be at the frame's origin: corners are 0 .. 2047 + 64 px from there, in 24.8, and a
 * window begins in one of the nine tiles that the box may touch (later windows show nothing). A triangle that is not
 * small or not shown has all corners at one point, so every sum is 0. */
#include "any.h"

enum {
    CORNER_MAX = 2047 + LMB_SMALL_24_8 - 1,
    TILES = CORNER_MAX / 2048 + 1,
    PX_MAX = CORNER_MAX / 256,
    E_MAX = 1 << 22,
    STEP_MAX = 22528, /* really 16383; Eva's ranges are independent of each other */
    WAY_MIN = -LMB_TILE * (TILES + 2), WAY_MAX = 3 * LMB_TILE - 1
};

/* snap.c covers the inputs of setup_snap's conversions; here are the results. Corner a's are split by tile, because b's
 * is later computed as a + (b - a). */
static int asked, first_low[2];

static lanei any_corner(lane at)
{
    lanei r;
    (void)at;
    r.v[0] = asked < 2 ? any_between(first_low[asked] + 1, first_low[asked] + 2047) : any_between(1, CORNER_MAX);
    ++asked;
    return r;
}

#define lane_to_int any_corner
#include "../../src/raster/setup.inl"
#undef lane_to_int
#include "../../src/raster/fill.inl"

/* Checks only the arguments of a column; `column` covers the column itself. */
static void column_asked(const int32_t e[3], const fill_box *box, int32_t i)
{
    /*@ assert 0 <= box->first_row < LMB_TILE && box->last_row < LMB_TILE; */
    /*@ assert 0 <= i < LMB_TILE; */
    /*@ assert \forall integer j; 0 <= j < 3 ==> -1073741824 <= e[j] <= 1073741824; */
}

#define fill_column(tile, job, t, e, d, box, i) column_asked(e, box, i)
#include "../../src/raster/fill_small.inl"
#undef fill_column
#include "../../src/raster/fill_rows.inl"

/* Checks only the edges at the start of a tile's rows. */
static void rows_asked(const fill_rows *r)
{
    /*@ assert -1073741824 <= r->e0.v[0] <= 1073741824; */
    /*@ assert -1073741824 <= r->e1.v[0] <= 1073741824; */
    /*@ assert -1073741824 <= r->e2.v[0] <= 1073741824; */
}

/* Both halves fit 16 bits. Eva does not see through halves, so a gain is that of any slope and way. */
static lanei slope_asked(lanei ex, lanei ey)
{
    /*@ assert -STEP_MAX <= ex.v[0] <= STEP_MAX && -STEP_MAX <= ey.v[0] <= STEP_MAX; */
    (void)ey;
    return ex;
}

static lanei way_asked(lanei x, lanei y)
{
    /*@ assert WAY_MIN <= x.v[0] <= WAY_MAX && WAY_MIN <= y.v[0] <= WAY_MAX; */
    (void)y;
    return x;
}

static lanei any_gain(lanei slope, lanei way)
{
    lanei r;
    r.v[0] = any_between(-STEP_MAX, STEP_MAX) * any_between(WAY_MIN, WAY_MAX);
    r.v[0] += any_between(-STEP_MAX, STEP_MAX) * any_between(WAY_MIN, WAY_MAX);
    (void)slope, (void)way;
    return r;
}

#define rows_slope              slope_asked
#define rows_way                way_asked
#define rows_gain               any_gain
#define rows_draw(r, d, dy, rows, kind) rows_asked(r)
#include "../../src/raster/fill_parts.inl"
#undef rows_draw

static void ask_ways(void)
{
    /*@ loop unroll 300; */
    for (int i = 0; i < PARTS_TILES * 2 * 16; ++i) {
        const int32_t way = parts_at[i / 32][i / 16 % 2][i % 16];
        /*@ assert 0 <= way && (way & 0xffff) <= WAY_MAX && way >> 16 <= WAY_MAX; */
        (void)way;
    }
}

static float depths[LMB_TILE_PIXELS];
static uint32_t ids[LMB_TILE_PIXELS];

/* All tiles share memory: the proof is about the position of a pixel within a tile. */
static lmb_fill_window any_window(int32_t x0, int32_t y0)
{
    lmb_fill_window w;
    w.first.depth = depths;
    w.first.id = ids;
    w.first.depth_step = w.first.id_step = LMB_TILE;
    w.first.depth_format = LMB_DEPTH32F;
    w.first.id_format = LMB_ID32;
    w.depth_tile = w.depth_row = w.id_tile = w.id_row = 0;
    w.x0 = x0;
    w.y0 = y0;
    w.tiles_x = w.tiles_y = TILES;
    w.origin_x = w.origin_y = 0;
    w.d_scale = w.d_bias = 0.0f;
    return w;
}

static lmb_setup_job any_job(void)
{
    lmb_setup_job job;
    for (int i = 0; i < 12; ++i) {
        job.row[i / 4][i % 4] = any_float();
    }
    job.scale_x = any_float(), job.scale_y = any_float();
    job.guard_x = any_float(), job.guard_y = any_float();
    job.snap_x = any_float(), job.snap_y = any_float();
    job.near_m = any_float(), job.far_m = any_float(), job.depth_scale = any_float();
    job.orthographic = any_between(0, 1);
    job.cull = any_between(-1, 1);
    job.origin_x = job.origin_y = 0;
    job.x0 = LMB_TILE * any_between(0, TILES - 1), job.y0 = LMB_TILE * any_between(0, TILES - 1);
    job.x1 = any_between(0, LMB_MAX_FRAME), job.y1 = any_between(0, LMB_MAX_FRAME);
    return job;
}

static void ask_batch(const lmb_batch *b)
{
    /*@ assert 0 <= b->x0[0] <= PX_MAX + 1 && 0 <= b->x1[0] <= PX_MAX; */
    /*@ assert 0 <= b->y0[0] <= PX_MAX + 1 && 0 <= b->y1[0] <= PX_MAX; */
    for (int i = 0; i < 3; ++i) {
        /*@ assert -E_MAX <= b->e[i][0] <= E_MAX; */
        /*@ assert -STEP_MAX <= b->ex[i][0] <= STEP_MAX && -STEP_MAX <= b->ey[i][0] <= STEP_MAX; */
    }
}

static setup_corner any_snapped(const lmb_setup_job *job)
{
    const setup_point at = {{{any_float()}}, {{any_float()}}, {{any_float()}}, {{any_float()}}};
    return setup_snap(job, &at, mask_of_bits(1));
}

int set_up(void)
{
    const lmb_setup_job job = any_job();
    const lane_mask in = mask_of_bits(1), none = mask_of_bits(0);
    const setup_sides sides = {in, none, {none, none, none, none, none}};
    /*@ loop unroll 100; */
    for (int cell = 0; cell < TILES * TILES; ++cell) {
        lmb_batch b = {0};
        asked = 0;
        first_low[0] = cell % TILES * 2048, first_low[1] = cell / TILES * 2048;
        setup_corner c[3];
        c[0] = any_snapped(&job);
        c[1] = any_snapped(&job);
        c[2] = any_snapped(&job);
        setup_triangles(&b, &job, &sides, in, &c[0], &c[1], &c[2], 0);
        if (b.sets.small) {
            ask_batch(&b);
        }
    }
    return 0;
}

/* A triangle with a box that begins at pixel (x, y). */
static void one_begins_at(lmb_batch *b, int32_t x, int32_t y, const lmb_fill_window *w)
{
    fill_slopes slopes;
    fill_places places;
    lane_mask halves[2];
    b->x0[0] = x;
    b->y0[0] = y;
    fill_small_any(w, b, 1u);
    parts_slopes(&slopes, b, 1u);
    for (int p = 0; p < PARTS_TILES; ++p) {
        const int px = p % PARTS_SIDE, py = p / PARTS_SIDE;
        if (mask_bits(parts_set(places.d[0], halves, &slopes, w, b, 0, lanei_splat(px), lanei_splat(py), 0))) {
            parts_draw_from(w, b, 0, px, py, places.d[0][0], slopes.dx[0], slopes.dy[0], 1u, FILL_PLAIN, 0);
            places.at[0][0] = 0;
            parts_put(&places, &slopes, w, b, 0, 0, p, ROWS_LOWER, FILL_PLAIN, 0);
        }
    }
    parts_wide(w, b, 0, 1u, FILL_PLAIN, 0);
}

/* Position by position, because Eva does not relate a row to its tile: any pixel of the first tile, and the first pixel
 * of the others, at which the window begins. Rows do not depend on columns, so x and y change together. (All 256 pairs
 * give the same, in 80 seconds instead of 5.) */
int main(void)
{
    lmb_batch b;
    for (int i = 0; i < 3; ++i) {
        b.e[i][0] = any_between(-E_MAX, E_MAX);
        b.ex[i][0] = any_between(-STEP_MAX, STEP_MAX);
        b.ey[i][0] = any_between(-STEP_MAX, STEP_MAX);
    }
    b.id[0] = 1;
    b.d[0] = any_float(), b.dx[0] = any_float(), b.dy[0] = any_float();
    b.d_min[0] = any_float(), b.d_max[0] = any_float();
    b.x1[0] = any_between(0, PX_MAX), b.y1[0] = any_between(0, PX_MAX);
    /*@ loop unroll 16; */
    for (int32_t i = 0; i < LMB_TILE + TILES - 1; ++i) {
        const int32_t at = i < LMB_TILE ? i : (i - LMB_TILE + 1) * LMB_TILE, window = i < LMB_TILE ? 0 : at;
        const lmb_fill_window w = any_window(window, window);
        one_begins_at(&b, at, at, &w);
    }
    ask_ways();
    return 0;
}
