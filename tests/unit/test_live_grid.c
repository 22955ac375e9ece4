/* test_live_grid.c: samples of the light at single points of a wall: their number, the pixels in between, the noise
 * filter; on every backend. */
#include <lambent/lambent.h>

#include <stdlib.h>

#include "../../src/frame/live_grid.h"
#include "../../src/raster/tile.h"
#include "../world.h"

void test_live_grid(void);

enum { WIDE = 101, HIGH = 75, COLUMNS = 13, ROWS = 10, TILES = COLUMNS * ROWS };

typedef float (*light_at)(float x, float y);

static float even(float x, float y) { return 0.3f + 0.0f * (x + y); }
static float curved(float x, float y) { return 2.0f + 0.01f * x - 0.02f * y + 1e-4f * (x * x - x * y); }
static float stepped(float x, float y) { return x + 0.3f * y > 61.0f ? 1.0f : 3.0f; }

static uint64_t memory[TILES * 192];
static lmb_tile tile[TILES];
static lmb_irradiance light[TILES];
static live_grid grid;

/* A wall with 1 cm per pixel that turns towards the viewer from column `bent` on. */
static void put_wall(int32_t bent)
{
    lmb_lattice l;
    CHECK(lmb_lattice_init(&l, WIDE, HIGH, memory, sizeof memory) == LMB_OK);
    memset(memory, 0x5a, sizeof memory);
    grid = lmb_live_grid_of(&l, 32);
    memset(tile, 0, sizeof tile);
    memset(light, 0, sizeof light);
    for (int32_t i = 0; i < TILES; ++i) {
        tile[i].x = i % COLUMNS * LMB_TILE;
        tile[i].y = i / COLUMNS * LMB_TILE;
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const int32_t x = tile[i].x + k % 8, y = tile[i].y + k / 8, past = x >= bent ? x - bent : 0;
            const lmb_vec3 n = x >= bent ? vec3(-1, 0, 0) : Z;
            if (x < WIDE && y < HIGH) {
                set_plane(tile[i].position, k,
                          vec3(0.01f * (float)(x - past), 0.01f * (float)y, 0.01f * (float)past));
                set_plane(tile[i].face, k, n);
                set_plane(tile[i].normal, k, n);
                tile[i].id[k] = x >= bent ? 2 : 1;
                ++tile[i].hits;
            }
        }
        lmb_live_grid_put(&grid, &tile[i], 0);
    }
}

/* A tile that one flat triangle fills is stored by the first pixel as by all of them. */
static void test_even(void)
{
    for (int turned = 0; turned < 2; ++turned) {
        put_wall(1000);
        const lmb_live_sample before = *grid_sample(&grid, &grid.tile[COLUMNS + 1], 0);
        lmb_tile *t = &tile[COLUMNS + 1];
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            t->normal[0][k] += 0.01f * (float)turned;
        }
        lmb_live_grid_put(&grid, t, 0);
        const live_grid_tile by_all = grid.tile[COLUMNS + 1];
        const lmb_live_sample first = *grid_sample(&grid, &grid.tile[COLUMNS + 1], 0);
        memset(&grid.tile[COLUMNS + 1], 0x5a, sizeof by_all);
        *grid_sample(&grid, &grid.tile[COLUMNS + 1], 0) = before;
        lmb_live_grid_put_even(&grid, &first, 1, 1);
        CHECK(memcmp(&by_all, &grid.tile[COLUMNS + 1], sizeof by_all) == 0);
        CHECK(memcmp(&first, grid_sample(&grid, &grid.tile[COLUMNS + 1], 0), sizeof first) == 0);
        CHECK(by_all.plain == (turned ? 0 : GRID_FLAT));
    }
}

/* If all corners agree with all pixels, testing that changes no byte. */
static void test_agreement(const lmb_kernels *kernels)
{
    test_rng r = {7};
    put_wall(1000);
    for (int n = 0; n < 50; ++n) {
        static const int32_t step[3] = {2, 8, 16};
        lmb_live_sample corner[4];
        lmb_irradiance out[2];
        lmb_live_cell cell;
        memset(&cell, 0, sizeof cell);
        memset(out, 0x11, sizeof out);
        for (int i = 0; i < 4; ++i) {
            corner[i] = lmb_live_grid_surface(&tile[0], i);
            for (int c = 0; c < 3; ++c) {
                corner[i].light[c] = test_uniform(&r, 0, 2);
                corner[i].slope[0][c] = test_uniform(&r, -0.3f, 0.3f);
                corner[i].slope[1][c] = test_uniform(&r, -0.3f, 0.3f);
            }
            cell.corner[i] = &corner[i];
        }
        cell.x[1] = cell.y[1] = (float)step[n % 3];
        cell.per_x = cell.per_y = 1.0f / cell.x[1];
        cell.pixels = n % 3 == 0 ? 0x0303u : ~(uint64_t)0;
        for (cell.even = 0; cell.even < 2; ++cell.even) {
            CHECK(kernels->live_fill(&out[cell.even], &tile[0], &cell) == 0);
        }
        CHECK(memcmp(&out[0], &out[1], sizeof out[0]) == 0);
    }
}

/* Beside a line that is over four times as bright, pixels between the closest samples are lit on their own. */
static void test_steep(void)
{
    static const struct {
        float bright;
        uint8_t parts;
        uint64_t steep;
    } cases[] = {{30.0f, 15, 0x0000ffaaffaa0000}, {30.0f, 5, 0x00000f0a0f0a0000}, {3.0f, 15, 0}, {30.0f, 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        put_wall(1000);
        grid.mean = 1.0f;
        grid.tile[0].divided = 1;
        grid.tile[0].parts = cases[i].parts;
        grid.tile[0].known = 0xffff;
        for (int k = 0; k < GRID_SAMPLES; ++k) {
            lmb_live_sample *s = grid_sample(&grid, &grid.tile[0], k);
            *s = lmb_live_grid_surface(&tile[0], grid_pixel(k));
            for (int c = 0; c < 3; ++c) {
                s->light[c] = k / GRID_SIDE == 2 ? cases[i].bright : 1.0f;
            }
        }
        const uint64_t steep = lmb_live_grid_steep(&grid, &tile[0]);
        CHECK_MSG(steep == cases[i].steep, "case %d: %08x%08x", (int)i, (unsigned)(steep >> 32), (unsigned)steep);
    }
}

/* Evaluates the samples of a level. Returns their number. */
static int light_level(int32_t level, light_at at)
{
    int count = 0;
    for (int32_t i = 0; i < TILES; ++i) {
        live_grid_tile *t = &grid.tile[i];
        const uint32_t asked = lmb_live_grid_asks(&grid, i % COLUMNS, i / COLUMNS, level);
        CHECK((asked & (t->known | ~(uint32_t)t->shown)) == 0);
        for (uint32_t bits = asked; bits != 0; bits &= bits - 1, ++count) {
            const int k = lowest_bit(bits);
            const lmb_tile *from = &tile[i];
            lmb_live_sample *s = grid_sample(&grid, t, k);
            s->position = tile_vec(from->position, grid_pixel(k));
            s->face = tile_vec(from->face, grid_pixel(k));
            s->normal = tile_vec(from->normal, grid_pixel(k));
            s->id = from->id[grid_pixel(k)];
            s->is_lit[0] = 1;
            s->is_lit[1] = 0;
            for (int c = 0; c < 3; ++c) {
                s->light[c] = (float)(c + 1) * at((float)(tile[i].x + k % 4 * 2), (float)(tile[i].y + k / 4 * 2));
                s->slope[0][c] = s->light[c];
                s->seen[0][c] = (uint16_t)LIVE_STEPS;
            }
        }
        t->known |= (uint16_t)asked;
    }
    return count;
}

/* All stages of a frame. Returns the number of samples; *left: pixels that no sample explains. */
static int solve(const lmb_kernels *kernels, light_at at, int *left)
{
    int count = light_level(0, at);
    grid.mean = lmb_live_grid_mean(&grid);
    for (int32_t level = 0; level < GRID_LEVELS - 1; ++level) {
        for (int32_t row = 0; row < ROWS; row += 2) {
            lmb_live_grid_divide(&grid, row, level);
        }
        count += light_level(level + 1, at);
    }
    for (int32_t i = 0; i < TILES; ++i) {
        lmb_live_grid_smooth(&grid, i % COLUMNS, i / COLUMNS);
    }
    for (int32_t i = 0; i < TILES; ++i) {
        lmb_live_grid_slopes(&grid, i % COLUMNS, i / COLUMNS);
    }
    *left = 0;
    for (int32_t i = 0; i < TILES; ++i) {
        *left += count_bits_64(lmb_live_grid_fill(&light[i], kernels, &grid, &tile[i]));
    }
    return count;
}

/* The largest error of a pixel; `off`: pixels with an error of over a tenth. */
static float worst(light_at at, int *off)
{
    float out = 0.0f;
    *off = 0;
    for (int32_t y = 0; y < HIGH; ++y) {
        for (int32_t x = 0; x < WIDE; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float is = light[y / 8 * COLUMNS + x / 8].rgb[c][y % 8 * 8 + x % 8] / (float)(c + 1),
                            e = absf(is - at((float)x, (float)y));
                out = maxf(out, e);
                *off += c == 0 && e > 0.1f;
            }
        }
    }
    return out;
}

enum {
    ALL_8 = 14 * 11, /* columns 0, 8 .. 96 and 100, rows 0 .. 72 and 74 */
    FIRST = 8 * 6 + 34 /* columns 0, 16 .. 96 and 100, rows 0 .. 64 and 74; those of 8 px in cells at the edge */
};

static void test_walls(const lmb_kernels *kernels)
{
    int left, off;
    put_wall(1000);
    int count = solve(kernels, even, &left);
    float most = worst(even, &off);
    CHECK_MSG(count == FIRST && left == 0 && most < 1e-5f, "%d, %d, %g", count, left, (double)most);
    put_wall(1000);
    count = solve(kernels, curved, &left);
    most = worst(curved, &off);
    CHECK_MSG(count == FIRST && left == 0 && most < 0.01f, "%d, %d, %g", count, left, (double)most);
    put_wall(1000);
    count = solve(kernels, stepped, &left);
    worst(stepped, &off);
    CHECK_MSG(count > FIRST + 50 && count < 1200 && left == 0 && off < 300, "%d, %d, %d", count, left, off);
    put_wall(50);
    count = solve(kernels, even, &left);
    most = worst(even, &off);
    CHECK_MSG(count < FIRST + 40 && left > 0 && left < 4 * HIGH, "%d, %d", count, left);
    /* Several triangles in one plane count as one. If pixels between the samples lie above it, cells are divided. */
    for (int raised = 0; raised < 2; ++raised) {
        put_wall(1000);
        for (int32_t i = 0; i < TILES; ++i) {
            for (int k = 1; k < LMB_TILE_PIXELS; k += 2) {
                tile[i].id[k] = tile[i].id[k] != 0 ? 2 : 0;
                tile[i].position[2][k] += 0.02f * (float)raised;
            }
            lmb_live_grid_put(&grid, &tile[i], 0);
        }
        count = solve(kernels, even, &left);
        CHECK_MSG(count == (raised ? ALL_8 : FIRST), "%d, raised %d", count, raised);
    }
}

/* A wall that bends: the light of one side does not continue past the edge. */
static float by_side(float x, float y) { return x >= 50.0f ? 5.0f : 1.0f + 0.0f * y; }

static void test_edge(const lmb_kernels *kernels)
{
    int left, wrong = 0;
    put_wall(50);
    solve(kernels, by_side, &left);
    for (int32_t i = 0; i < TILES; ++i) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const float is = light[i].rgb[0][k];
            wrong += tile[i].id[k] != 0 && is != 0.0f && absf(is - (tile[i].id[k] == 2 ? 5.0f : 1.0f)) > 1e-4f;
        }
    }
    CHECK_MSG(wrong == 0, "%d pixels", wrong);
}

/* Shares that differ by noise become equal; a shadow's edge stays. `kind`: 0: of bounced light; 1: of a sky, beside
 * bounced light that is fully visible. */
static void test_noise(int32_t step, int kind)
{
    const int every = step / LMB_TILE, last = 6 - every;
    const float full = kind ? LIVE_SKY_STEPS : LIVE_STEPS, beside = kind ? 0.25f : 0.0f;
    float before = 0.0f, after = 0.0f, lit = 0.0f, dark = 0.0f;
    int count = 0;
    put_wall(1000);
    light_level(0, even);
    if (step == LMB_TILE) {
        light_level(1, even);
    }
    for (int32_t i = 0; i < TILES; ++i) {
        lmb_live_sample *s = &grid.first[i];
        s->is_lit[1] = (uint8_t)kind;
        for (int c = 0; c < 3; ++c) {
            const float share = i % COLUMNS < 6 ? (float)(127 + (i * 7 % 5 - 2) * 9) / 254.0f : 0.0f;
            s->slope[0][c] = beside;
            s->slope[kind][c] = 1.0f;
            s->seen[kind][c] = (uint16_t)(share * full + 0.5f);
            s->light[c] = share + beside;
        }
        const float off = s->light[0] - beside - 0.5f;
        before += i % COLUMNS < 6 && (grid.tile[i].known & 1u) ? off * off : 0.0f;
    }
    for (int32_t i = 0; i < TILES; ++i) {
        if (!(grid.tile[i].known & 1u)) {
            continue;
        }
        lmb_live_grid_smooth(&grid, i % COLUMNS, i / COLUMNS);
        const float now = grid.first[i].light[0] - beside;
        after += i % COLUMNS < 6 ? (now - 0.5f) * (now - 0.5f) : 0.0f;
        count += i % COLUMNS < 6;
        lit += i % COLUMNS == last ? now : 0.0f;
        dark += i % COLUMNS == 6 ? now : 0.0f;
    }
    CHECK_MSG(after < 0.3f * before, "%g of %g", (double)after, (double)before);
    CHECK_MSG(dark == 0.0f && lit * (float)every > 4.0f, "%g, %g", (double)lit, (double)dark);
    CHECK(count == 6 * ROWS / (every * every));
}

/* A sky that is seen through a small hole keeps its light. */
static void test_small_share(void)
{
    put_wall(1000);
    light_level(0, even);
    for (int32_t i = 0; i < TILES; ++i) {
        lmb_live_sample *s = &grid.first[i];
        s->is_lit[0] = 0;
        s->is_lit[1] = 1;
        for (int c = 0; c < 3; ++c) {
            s->slope[1][c] = 1.0f;
            s->seen[1][c] = (uint16_t)(0.001f * LIVE_SKY_STEPS + 0.5f);
        }
    }
    for (int32_t i = 0; i < TILES; ++i) {
        if (grid.tile[i].known & 1u) {
            lmb_live_grid_smooth(&grid, i % COLUMNS, i / COLUMNS);
            CHECK(absf(grid.first[i].light[1] - 0.001f) < 1e-5f);
        }
    }
}

/* Any 3 x 3 samples of a grid have nine shifts. */
static void test_turns(void)
{
    for (int32_t i = 0; i < 300; ++i) {
        const int32_t x = i % 10, y = i / 10 % 10, step = 1 << i / 100;
        uint32_t found = 0;
        for (int k = 0; k < 9; ++k) {
            const float turn = live_turn(x + k % 3 * step, y + k / 3 * step);
            CHECK(turn > 0.0f && turn < 1.0f);
            found |= 1u << (int)(turn * 9.0f);
        }
        CHECK_MSG(found == 0x1ffu, "step %d at %d, %d: %x", (int)step, (int)x, (int)y, (unsigned)found);
    }
}

/* The same light on all backends. */
static void test_backends(void)
{
    static lmb_irradiance first[TILES];
    for (int i = 0; lmb_kernels_at(i) != NULL; ++i) {
        int left;
        put_wall(50);
        solve(lmb_kernels_at(i), stepped, &left);
        if (i > 0) {
            CHECK_MSG(memcmp(first, light, sizeof first) == 0, "%s", lmb_kernels_name(lmb_kernels_at(i)));
        }
        memcpy(first, light, sizeof first);
    }
}

void test_live_grid(void)
{
    test_even();
    test_steep();
    for (int i = 0; lmb_kernels_at(i) != NULL; ++i) {
        test_agreement(lmb_kernels_at(i));
    }
    test_walls(lmb_kernels_pick());
    test_edge(lmb_kernels_pick());
    test_noise(LMB_TILE, 0);
    test_noise(GRID_COARSE, 0);
    test_noise(LMB_TILE, 1);
    test_noise(GRID_COARSE, 1);
    test_small_share();
    test_turns();
    test_backends();
}
