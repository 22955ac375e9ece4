/* live_grid.c: chooses the pixels to light, and interpolates the light between them. Layer 8.                    [ours]
 *
 * A cell is divided if the parent cell predicted the samples badly, by more than their noise. Only the visible shares
 * of shadows are noisy. The noise is removed from these, not from the light. */
#include "live_grid.h"

#include <string.h>

#include "../base/memory_check.h"
#include "../raster/tile.h"

#if LMB_LIVE

#define STRAY     1.6f  /* max standard deviations between two shares that count as equal */
#define EDGE      1.0f  /* error, as a share of the light's change over a cell with several surfaces */
#define STEEP     4.0f  /* a cell of 2 px is steep if its brightest corner has more than this times the darkest */
#define STEEPER   16.0f /* and if the change^2 of its light is more than this times split x mean^2 */
#define LEAST     0.02f /* min of p (1 - p): shares of 0 and 1 are uncertain too */
#define FLAT_TURN 1e-3f /* max difference between a flat tile's normals and the plane's, each axis */
#define ALL_SAMPLES ((1u << GRID_SAMPLES) - 1) /* of a tile */
#define SPLIT     800.0f /* over strata^2: sampling errors of shadows should not cause divisions */

/* --- layout ------------------------------------------------------------------------------------------------------- */

size_t lmb_lattice_bytes(int32_t width, int32_t height)
{
    if (width < 1 || width > LMB_MAX_SIDE || height < 1 || height > LMB_MAX_SIDE) {
        return 0;
    }
    const uint64_t columns = (uint64_t)((width + LMB_TILE - 1) / LMB_TILE),
                   rows = (uint64_t)((height + LMB_TILE - 1) / LMB_TILE);
    return size_or_none(columns * rows * (sizeof(live_grid_tile) + GRID_SAMPLES * sizeof(lmb_live_sample)));
}

lmb_status lmb_lattice_init(lmb_lattice *out, int32_t width, int32_t height, void *memory, size_t bytes)
{
    const lmb_status status = check_room(out, memory, bytes, lmb_lattice_bytes(width, height));
    if (status != LMB_OK) {
        return status;
    }
    out->tile = memory;
    out->width = width;
    out->height = height;
    out->mean = 0.0f;
    return LMB_OK;
}

live_grid lmb_live_grid_of(const lmb_lattice *l, int32_t strata)
{
    live_grid g;
    g.tile = (live_grid_tile *)l->tile;
    g.width = l->width;
    g.height = l->height;
    g.columns = (l->width + LMB_TILE - 1) / LMB_TILE;
    g.rows = (l->height + LMB_TILE - 1) / LMB_TILE;
    g.first = (lmb_live_sample *)(void *)(g.tile + (size_t)g.columns * (size_t)g.rows);
    g.other = g.first + (size_t)g.columns * (size_t)g.rows;
    g.mean = l->mean;
    g.split = SPLIT / (float)(strata * strata);
    g.noise = 1.0f / sqrtf((float)strata);
    return g;
}

static inline lmb_live_sample *sample_at(const live_grid *g, int32_t x, int32_t y)
{
    const size_t i = (size_t)(y / LMB_TILE) * (size_t)g->columns + (size_t)(x / LMB_TILE);
    const int32_t k = y % LMB_TILE / GRID_STEP * GRID_SIDE + x % LMB_TILE / GRID_STEP;
    return k == 0 ? &g->first[i] : &g->other[i * (GRID_SAMPLES - 1) + (size_t)(k - 1)];
}

static inline int is_known(const live_grid *g, int32_t x, int32_t y)
{
    return grid_tile(g, x / LMB_TILE, y / LMB_TILE)->known >>
               (y % LMB_TILE / GRID_STEP * GRID_SIDE + x % LMB_TILE / GRID_STEP) & 1;
}

/* Last column or row that may have a sample. */
static int32_t last_of(int32_t size) { return (size - 1) / GRID_STEP * GRID_STEP; }

/* Do all pixels lie in one plane and have its normal? */
static int is_flat(const lmb_tile *tile)
{
    const lmb_vec3 face = tile_vec(tile->face, 0);
    uint32_t other = 0;
    float turn[4] = {0, 0, 0, 0}, lift[4] = {0, 0, 0, 0}; /* four maxima, so that none waits for the one before */
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            turn[k % 4] = maxf(turn[k % 4], absf(tile->normal[c][k] - tile->face[c][0]));
        }
    }
    if (!(maxf(maxf(turn[0], turn[1]), maxf(turn[2], turn[3])) <= FLAT_TURN)) {
        return 0;
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        other |= tile->id[k] ^ tile->id[0];
    }
    for (int k = 0; k < LMB_TILE_PIXELS && other != 0; ++k) {
        const lmb_vec3 d = sub3(tile_vec(tile->position, k), tile_vec(tile->position, 0));
        const float height = dot3(face, d);
        lift[k % 4] = maxf(lift[k % 4], height * height - LIVE_SAME_LIFT * dot3(d, d));
    }
    return maxf(maxf(lift[0], lift[1]), maxf(lift[2], lift[3])) <= 0.0f;
}

lmb_live_sample lmb_live_grid_surface(const lmb_tile *tile, int k)
{
    lmb_live_sample s;
    memset(&s, 0, sizeof s);
    s.position = tile_vec(tile->position, k);
    s.face = tile_vec(tile->face, k);
    s.normal = tile_vec(tile->normal, k);
    s.id = tile->id[k];
    return s;
}

/* Samples of a tile on the grid of `step` px, 8 or 16: the first one, and the last one at the right and lower edge of
 * the frame. */
static uint32_t first_of(const live_grid *g, int32_t column, int32_t row, int32_t step)
{
    const int32_t each = step / LMB_TILE, right = (last_of(g->width) - column * LMB_TILE) / GRID_STEP,
                  low = (last_of(g->height) - row * LMB_TILE) / GRID_STEP;
    const uint32_t across =
        (uint32_t)(column % each == 0) | (column == g->columns - 1 ? 1u << right : 0);
    uint32_t out = row % each == 0 ? across : 0;
    return out | (row == g->rows - 1 ? across << low * GRID_SIDE : 0);
}

void lmb_live_grid_put(const live_grid *g, const lmb_tile *tile, int lobes)
{
    const int32_t column = tile->x / LMB_TILE, row = tile->y / LMB_TILE;
    live_grid_tile *out = grid_tile(g, column, row);
    out->shown = out->known = 0;
    out->divided = out->parts = 0;
    out->lobes = (uint8_t)(lobes != 0);
    out->plain = (uint8_t)(tile->id[0] != 0 && !lobes && is_flat(tile) ? GRID_FLAT : 0);
    for (int i = 0; i < GRID_SAMPLES && !lobes; ++i) {
        out->shown |= (uint16_t)((unsigned)(tile->id[grid_pixel(i)] != 0) << i);
    }
    for (uint32_t bits = out->shown & first_of(g, column, row, LMB_TILE); bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        *grid_sample(g, out, k) = lmb_live_grid_surface(tile, grid_pixel(k));
    }
}

void lmb_live_grid_put_even(const live_grid *g, const lmb_live_sample *first, int32_t column, int32_t row)
{
    live_grid_tile *out = grid_tile(g, column, row);
    const lmb_vec3 turn = sub3(first->normal, first->face);
    const float largest = maxf(maxf(absf(turn.x), absf(turn.y)), absf(turn.z));
    memset(out, 0, sizeof *out);
    out->shown = ALL_SAMPLES;
    out->plain = largest <= FLAT_TURN ? GRID_FLAT : 0;
    *grid_sample(g, out, 0) = *first;
}

/* --- requested samples -------------------------------------------------------------------------------------------- */

/* Samples that a tile's own cell requests: a mask of GRID_SQUARE x GRID_SQUARE samples, including the right and lower
 * edges. */
static uint32_t asks_of(const live_grid_tile *t, int32_t level)
{
    enum { HALF = GRID_SIDE > 1 ? GRID_SIDE / 2 : 1 };
    uint32_t out = 0;
    if (level == 2 && t->divided) {
        for (int i = 0; i < GRID_SQUARE * GRID_SQUARE; ++i) {
            out |= (uint32_t)(i / GRID_SQUARE % HALF == 0 && i % GRID_SQUARE % HALF == 0) << i;
        }
    }
    for (int part = 0; part < 4 && level == 3; ++part) {
        if (t->parts >> part & 1) {
            out |= (7u | 7u << 5 | 7u << 10) << (part % 2 * 2 + part / 2 * 10);
        }
    }
    return out;
}

/* Mask of a square's samples that lie in the neighbour tile `right` columns and `down` rows on. */
static uint32_t in_tile(uint32_t square, int32_t right, int32_t down)
{
    uint32_t out = 0;
    for (int i = 0; i < GRID_SQUARE * GRID_SQUARE; ++i) {
        const int32_t x = i % GRID_SQUARE - right * GRID_SIDE, y = i / GRID_SQUARE - down * GRID_SIDE;
        if ((square >> i & 1u) && x >= 0 && x < GRID_SIDE && y >= 0 && y < GRID_SIDE) {
            out |= 1u << (y * GRID_SIDE + x);
        }
    }
    return out;
}

/* Cells at the right and lower edge of the frame end at the last samples. */
static uint32_t at_edge(const live_grid *g, uint32_t square, int32_t column, int32_t row)
{
    const int32_t right = (last_of(g->width) - column * LMB_TILE) / GRID_STEP,
                  low = (last_of(g->height) - row * LMB_TILE) / GRID_STEP;
    uint32_t out = 0;
    if (right >= GRID_SIDE && low >= GRID_SIDE) {
        return square;
    }
    for (int i = 0; i < GRID_SQUARE * GRID_SQUARE; ++i) {
        out |= (square >> i & 1u) << (mini(i / GRID_SQUARE, low) * GRID_SQUARE + mini(i % GRID_SQUARE, right));
    }
    return out;
}

/* Is a cell of 16 px around a sample divided? */
static int is_in_divided(const live_grid *g, int32_t x, int32_t y)
{
    for (int i = 0; i < 4; ++i) {
        const int32_t at = (i & 1) != 0 && x > 0 ? x - 1 : x, down = i >> 1 != 0 && y > 0 ? y - 1 : y;
        if (grid_tile(g, at / GRID_COARSE * 2, down / GRID_COARSE * 2)->plain != GRID_WHOLE) {
            return 1;
        }
    }
    return 0;
}

/* Samples of 8 px of a tile, in divided cells of 16 px. */
static uint32_t second_of(const live_grid *g, int32_t column, int32_t row)
{
    uint32_t out = 0;
    for (uint32_t bits = first_of(g, column, row, LMB_TILE); bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        out |= (uint32_t)is_in_divided(g, column * LMB_TILE + k % GRID_SIDE * GRID_STEP,
                                       row * LMB_TILE + k / GRID_SIDE * GRID_STEP)
               << k;
    }
    return out;
}

uint32_t lmb_live_grid_asks(const live_grid *g, int32_t column, int32_t row, int32_t level)
{
    const live_grid_tile *t = grid_tile(g, column, row);
    uint32_t out = level == 0 ? first_of(g, column, row, GRID_COARSE) : level == 1 ? second_of(g, column, row) : 0;
    for (int i = 0; i < 4 && level > 1; ++i) {
        const int32_t left = i & 1, up = i >> 1;
        if (column >= left && row >= up) {
            const uint32_t square = asks_of(grid_tile(g, column - left, row - up), level);
            out |= square != 0 ? in_tile(at_edge(g, square, column - left, row - up), left, up) : 0;
        }
    }
    return out & t->shown & ~(uint32_t)t->known;
}

/* --- between samples ---------------------------------------------------------------------------------------------- */

/* Position of the grid sample before or after one in a row or column; -1 if there is none. Steps are powers of two. */
static inline int32_t before(int32_t x, int32_t step) { return x > 0 ? (x - 1) & -step : -1; }
static inline int32_t after(int32_t x, int32_t step, int32_t size)
{
    return x < last_of(size) ? mini((x & -step) + step, last_of(size)) : -1;
}

/* Finds the neighbour of a sample along columns (way 0) or rows. Returns the distance in px; 0 if there is none. */
static float neighbour(const lmb_live_sample **out, const live_grid *g, int32_t x, int32_t y, int way, int ahead,
                       int32_t step)
{
    const lmb_live_sample *own = sample_at(g, x, y);
    for (int32_t s = step; s <= 2 * step; s *= 2) {
        const int32_t from = way == 0 ? x : y, size = way == 0 ? g->width : g->height;
        const int32_t to = ahead ? after(from, s, size) : before(from, s);
        const int32_t at = way == 0 ? to : x, down = way == 0 ? y : to;
        if (to >= 0 && is_known(g, at, down)) {
            *out = sample_at(g, at, down);
            if (live_agree(own, *out) > 0.0f) {
                return (float)(to > from ? to - from : from - to);
            }
        }
    }
    return 0.0f;
}

static void set_slope(float slope[3], const live_grid *g, int32_t x, int32_t y, int way, int32_t step)
{
    const lmb_live_sample *own = sample_at(g, x, y), *less = own, *more = own;
    const float down = neighbour(&less, g, x, y, way, 0, step), up = neighbour(&more, g, x, y, way, 1, step);
    for (int i = 0; i < 3; ++i) {
        const float from = own->light[i];
        const float s0 = down > 0.0f ? (from - less->light[i]) / down : 0.0f;
        const float s1 = up > 0.0f ? (more->light[i] - from) / up : 0.0f;
        slope[i] = down > 0.0f && up > 0.0f ? (s0 * up + s1 * down) / (up + down) : s0 + s1;
    }
}

/* A cell's position and corners; NULL if a corner is not known. */
typedef struct cell {
    int32_t x[2], y[2];
    const lmb_live_sample *corner[4];
} cell;

static void set_cell(cell *out, const live_grid *g, int32_t x, int32_t y, int32_t step)
{
    out->x[0] = x;
    out->y[0] = y;
    out->x[1] = mini(x + step, last_of(g->width));
    out->y[1] = mini(y + step, last_of(g->height));
    for (int i = 0; i < 4; ++i) {
        const int32_t at = out->x[i & 1], down = out->y[i >> 1];
        out->corner[i] = is_known(g, at, down) ? sample_at(g, at, down) : NULL;
    }
}

/* --- dividing ----------------------------------------------------------------------------------------------------- */

static float all_of(const float light[3]) { return light[0] + light[1] + light[2]; }

/* Share of bounced light (kind 0) or of a sky (1) that is seen. */
static float share_of(const lmb_live_sample *s, int kind)
{
    const float full = kind == 0 ? LIVE_STEPS : LIVE_SKY_STEPS;
    return (float)(s->seen[kind][0] + s->seen[kind][1] + s->seen[kind][2]) / (3.0f * full);
}

/* Half the standard deviation of a sample's light, R + G + B, for shares from a single segment. */
static float spread_of(const lmb_live_sample *s)
{
    const float share = share_of(s, 0), sky = share_of(s, 1);
    if (s->is_lit[1]) {
        const float a = s->is_lit[0] ? share * (1.0f - share) * all_of(s->slope[0]) * all_of(s->slope[0]) : 0.0f;
        const float b = sky * (1.0f - sky) * all_of(s->slope[1]) * all_of(s->slope[1]);
        return 0.5f * sqrtf(a + b);
    }
    const int some = s->is_lit[0] && share > 0.0f && share < 1.0f;
    return some ? 0.5f * all_of(s->light) * sqrtf((1.0f - share) / share) : 0.0f;
}

/* Prediction error of a cell's corners and slopes at a sample: R + G + B, beyond the sample's noise. */
static float surplus_at(const live_grid *g, const cell *c, float slope[4][2][3], int32_t x, int32_t y)
{
    const lmb_live_sample *s = sample_at(g, x, y);
    const float u = (float)(x - c->x[0]) / (float)maxi(c->x[1] - c->x[0], 1),
                v = (float)(y - c->y[0]) / (float)maxi(c->y[1] - c->y[0], 1);
    float weight[4], sum = 0.0f, by[3] = {0, 0, 0}, off = 0.0f;
    int agree = 0;
    if (!is_known(g, x, y)) {
        return 0.0f;
    }
    for (int i = 0; i < 4; ++i) {
        weight[i] = c->corner[i] != NULL ? live_agree(s, c->corner[i]) : 0.0f;
        agree += weight[i] > 0.0f;
        weight[i] *= (i & 1 ? u : 1.0f - u) * (i >> 1 ? v : 1.0f - v) + 0.001f;
        sum += weight[i];
    }
    if (agree == 0) {
        return c->x[1] - c->x[0] > GRID_COARSE ? 3e38f : 0.0f; /* the first sample of a surface has no prediction */
    }
    for (int i = 0; i < 4; ++i) {
        const float w = weight[i] / sum, part = agree == 4 ? 0.5f : 1.0f;
        const float dx = part * (float)(x - c->x[i & 1]), dy = part * (float)(y - c->y[i >> 1]);
        for (int k = 0; k < 3 && w > 0.0f; ++k) {
            by[k] += w * (c->corner[i]->light[k] + (slope[i][0][k] * dx + slope[i][1][k] * dy));
        }
    }
    for (int k = 0; k < 3; ++k) {
        off += absf(s->light[k] - maxf(by[k], 0.0f));
    }
    return maxf(off - g->noise * spread_of(s), 0.0f);
}

/* Change of light over a cell with corners on several surfaces: R + G + B; 0 for other cells. No sample shows how the
 * light continues to the edge between them. */
static float change_at_edge(const live_grid *g, int32_t x, int32_t y, int32_t step)
{
    float change = 0.0f;
    int edge = 0;
    cell c;
    set_cell(&c, g, x, y, step);
    for (int i = 0; i < 4; ++i) {
        const lmb_live_sample *a = c.corner[i], *b = c.corner[i ^ 1], *d = c.corner[i ^ 2];
        edge |= a == NULL || (b != NULL && !(live_agree(a, b) > 0.0f)) || (d != NULL && !(live_agree(a, d) > 0.0f));
    }
    for (int i = 0; i < 4 && edge; ++i) {
        float slope[2][3];
        if (c.corner[i] != NULL) {
            set_slope(slope[0], g, c.x[i & 1], c.y[i >> 1], 0, step);
            set_slope(slope[1], g, c.x[i & 1], c.y[i >> 1], 1, step);
            for (int way = 0; way < 2; ++way) {
                const float along = absf(slope[way][0]) + absf(slope[way][1]) + absf(slope[way][2]);
                change = maxf(change, along * (float)step - g->noise * spread_of(c.corner[i]));
            }
        }
    }
    return change;
}

/* Mask of the four parts of a cell of 2 x step px that are to be divided. */
static uint32_t divide_parts(const live_grid *g, int32_t x, int32_t y, int32_t step)
{
    float surplus[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0}, slope[4][2][3];
    uint32_t out = 0;
    cell c;
    set_cell(&c, g, x, y, 2 * step);
    for (int i = 0; i < 4; ++i) {
        for (int way = 0; way < 2 && c.corner[i] != NULL; ++way) {
            set_slope(slope[i][way], g, c.x[i & 1], c.y[i >> 1], way, 2 * step);
        }
    }
    for (int32_t i = 0; i < 9; ++i) {
        if (i % 2 == 1 || i == 4) {
            surplus[i] = surplus_at(g, &c, slope, mini(x + i % 3 * step, last_of(g->width)),
                                    mini(y + i / 3 * step, last_of(g->height)));
        }
    }
    for (int32_t i = 0; i < 4; ++i) {
        const int32_t at = (i >> 1) * 3 + (i & 1);
        const int32_t left = x + (i & 1) * step, top = y + (i >> 1) * step;
        float worst = maxf(maxf(surplus[at], surplus[at + 1]), maxf(surplus[at + 3], surplus[at + 4])) / 3.0f;
        if (left < g->width && top < g->height) {
            worst = maxf(worst, EDGE * change_at_edge(g, left, top, step));
        }
        out |= (uint32_t)(worst * worst * (float)(step * step) > g->split * g->mean * g->mean) << i;
    }
    return out;
}

/* Do all pixels of a cell of 16 px and its corners lie in one plane? */
static int is_plain(const live_grid *g, int32_t column, int32_t row)
{
    const lmb_live_sample *first = grid_sample(g, grid_tile(g, column, row), 0);
    cell c;
    set_cell(&c, g, column * LMB_TILE, row * LMB_TILE, GRID_COARSE);
    for (int i = 0; i < 4; ++i) {
        const int32_t at = mini(column + (i & 1), g->columns - 1), down = mini(row + (i >> 1), g->rows - 1);
        const live_grid_tile *t = grid_tile(g, at, down);
        if (t->plain == 0 || live_agree(first, grid_sample(g, t, 0)) < 1.0f || c.corner[i] == NULL ||
            live_agree(first, c.corner[i]) < 1.0f) {
            return 0;
        }
    }
    return 1;
}

/* Divides the cells of 16 px in a square of four, all of them if the frame ends before there is a sample to predict. */
static void divide_coarse(const live_grid *g, int32_t column, int32_t row)
{
    if (last_of(g->width) - column * LMB_TILE <= GRID_COARSE || last_of(g->height) - row * LMB_TILE <= GRID_COARSE) {
        return;
    }
    const uint32_t divided = divide_parts(g, column * LMB_TILE, row * LMB_TILE, GRID_COARSE);
    for (int i = 0; i < 4; ++i) {
        const int32_t at = column + (i & 1) * 2, down = row + (i >> 1) * 2;
        if (at < g->columns && down < g->rows && !(divided >> i & 1u) && is_plain(g, at, down)) {
            for (int k = 0; k < 4; ++k) {
                if (at + (k & 1) < g->columns && down + (k >> 1) < g->rows) {
                    grid_tile(g, at + (k & 1), down + (k >> 1))->plain = GRID_WHOLE;
                }
            }
        }
    }
}

void lmb_live_grid_divide(const live_grid *g, int32_t row, int32_t level)
{
    for (int32_t column = 0; column < g->columns && level == 0 && row % 4 == 0; column += 4) {
        divide_coarse(g, column, row);
    }
    for (int32_t column = 0; column < g->columns && level == 1 && GRID_STEP < LMB_TILE; column += 2) {
        if (grid_tile(g, column, row)->plain == GRID_WHOLE) {
            continue;
        }
        const uint32_t divided = divide_parts(g, column * LMB_TILE, row * LMB_TILE, LMB_TILE);
        for (int i = 0; i < 4; ++i) {
            if (column + (i & 1) < g->columns && row + (i >> 1) < g->rows) {
                grid_tile(g, column + (i & 1), row + (i >> 1))->divided = (uint8_t)(divided >> i & 1u);
            }
        }
    }
    for (int32_t i = 0; i < 2 * g->columns && level == 2 && GRID_STEP < LMB_TILE / 2; ++i) {
        const int32_t column = i % g->columns, down = row + i / g->columns;
        if (down < g->rows && grid_tile(g, column, down)->divided) {
            grid_tile(g, column, down)->parts =
                (uint8_t)divide_parts(g, column * LMB_TILE, down * LMB_TILE, LMB_TILE / 2);
        }
    }
}

float lmb_live_grid_mean(const live_grid *g)
{
    const size_t tiles = (size_t)g->columns * (size_t)g->rows;
    double sum = 0.0, count = 0.0;
    for (size_t i = 0; i < tiles; ++i) {
        if (g->tile[i].known & 1u) {
            sum += (double)all_of(g->first[i].light);
            count += 1.0;
        }
    }
    return count > 0.0 ? (float)(sum / count) : 0.0f;
}

/* --- noise -------------------------------------------------------------------------------------------------------- */

static int is_on(int32_t x, int32_t step, int32_t size) { return (x & (step - 1)) == 0 || x == last_of(size); }

/* Step of the coarsest grid that contains a sample. */
static int32_t own_step(const live_grid *g, int32_t x, int32_t y)
{
    int32_t step = LMB_TILE;
    while (step > GRID_STEP && !(is_on(x, step, g->width) && is_on(y, step, g->height))) {
        step /= 2;
    }
    return step;
}

static void add_share(float sum[4], const lmb_live_sample *from, int kind, float weight)
{
    for (int c = 0; c < 3; ++c) {
        sum[c] += weight * (float)from->seen[kind][c];
    }
    sum[3] += weight;
}

/* Mean share of surrounding samples of the same step, on the same surface and within the noise: three sums and their
 * weight. Fields that other threads may read meanwhile stay unchanged. */
static void set_shares(float sum[4], const live_grid *g, int32_t x, int32_t y, int kind)
{
    const lmb_live_sample *own = sample_at(g, x, y);
    const int32_t step = own_step(g, x, y);
    const int32_t column[3] = {before(x, step), x, after(x, step, g->width)};
    const int32_t row[3] = {before(y, step), y, after(y, step, g->height)};
    const float share = share_of(own, kind), max = STRAY * g->noise * sqrtf(maxf(share * (1.0f - share), LEAST));
    sum[0] = sum[1] = sum[2] = sum[3] = 0.0f;
    add_share(sum, own, kind, 1.0f);
    for (int i = 0; i < 9; ++i) {
        int32_t at = column[i % 3], down = row[i / 3];
        if (step == LMB_TILE && i != 4 && at >= 0 && down >= 0 && !is_known(g, at, down)) {
            at = i % 3 == 0 ? before(x, GRID_COARSE) : i % 3 == 1 ? x : after(x, GRID_COARSE, g->width);
            down = i / 3 == 0 ? before(y, GRID_COARSE) : i / 3 == 1 ? y : after(y, GRID_COARSE, g->height);
        }
        if (i == 4 || at < 0 || down < 0 || !is_known(g, at, down)) {
            continue;
        }
        const lmb_live_sample *s = sample_at(g, at, down);
        const float off = absf(share_of(s, kind) - share);
        if (s->is_lit[kind] && off <= max && live_agree(own, s) > 0.0f) {
            add_share(sum, s, kind, (i % 2 == 0 ? 0.5f : 0.75f) * (1.0f - 0.5f * off / max));
        }
    }
}

/* Replaces the sample's shares by means. */
static void smooth(const live_grid *g, int32_t x, int32_t y)
{
    lmb_live_sample *own = sample_at(g, x, y);
    float sum[4];
    if (own->is_lit[0]) {
        set_shares(sum, g, x, y, 0);
        for (int c = 0; c < 3; ++c) {
            own->light[c] = own->slope[0][c] * (sum[c] / (sum[3] * LIVE_STEPS));
        }
    }
    if (own->is_lit[1]) {
        set_shares(sum, g, x, y, 1);
        for (int c = 0; c < 3; ++c) {
            const float light = own->slope[1][c] * (sum[c] / (sum[3] * LIVE_SKY_STEPS));
            own->light[c] = own->is_lit[0] ? own->light[c] + light : light;
        }
    }
}

void lmb_live_grid_smooth(const live_grid *g, int32_t column, int32_t row)
{
    for (uint32_t bits = grid_tile(g, column, row)->known; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        smooth(g, column * LMB_TILE + k % GRID_SIDE * GRID_STEP, row * LMB_TILE + k / GRID_SIDE * GRID_STEP);
    }
}

void lmb_live_grid_slopes(const live_grid *g, int32_t column, int32_t row)
{
    const live_grid_tile *t = grid_tile(g, column, row);
    for (uint32_t bits = t->known; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        const int32_t x = column * LMB_TILE + k % GRID_SIDE * GRID_STEP,
                      y = row * LMB_TILE + k / GRID_SIDE * GRID_STEP, step = own_step(g, x, y);
        set_slope(grid_sample(g, t, k)->slope[0], g, x, y, 0, step);
        set_slope(grid_sample(g, t, k)->slope[1], g, x, y, 1, step);
    }
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* Do all corners have full weight at a flat tile's first pixel? */
static int is_even(const cell *c, const live_grid *g, const live_grid_tile *t)
{
    for (int i = 0; i < 4; ++i) {
        if (t->plain == 0 || c->corner[i] == NULL || live_agree(grid_sample(g, t, 0), c->corner[i]) < 1.0f) {
            return 0;
        }
    }
    return 1;
}

/* Mask of pixels x .. x + step - 1 in rows y .. y + step - 1. */
static uint64_t square(int32_t x, int32_t y, int32_t step)
{
    const uint64_t rows = step == LMB_TILE ? ~(uint64_t)0 : (((uint64_t)1 << LMB_TILE * step) - 1) << LMB_TILE * y;
    return rows & ((((uint64_t)1 << step) - 1) << x) * 0x0101010101010101u;
}

/* Lights `pixels` of a tile that lie in the cell at (x, y) of the tile. */
static uint64_t fill_cell(lmb_irradiance *out, const lmb_kernels *kernels, const live_grid *g, const lmb_tile *tile,
                          uint64_t pixels, int32_t x, int32_t y, int32_t step)
{
    const live_grid_tile *t = grid_tile(g, tile->x / LMB_TILE, tile->y / LMB_TILE);
    lmb_live_cell p;
    cell c;
    set_cell(&c, g, tile->x + x, tile->y + y, step);
    memcpy(p.corner, c.corner, sizeof p.corner);
    p.x[0] = (float)(c.x[0] - tile->x);
    p.x[1] = (float)(c.x[1] - tile->x);
    p.y[0] = (float)(c.y[0] - tile->y);
    p.y[1] = (float)(c.y[1] - tile->y);
    p.per_x = 1.0f / maxf(p.x[1] - p.x[0], 1.0f);
    p.per_y = 1.0f / maxf(p.y[1] - p.y[0], 1.0f);
    p.even = is_even(&c, g, t);
    p.pixels = pixels;
    return kernels->live_fill(out, tile, &p);
}

uint64_t lmb_live_grid_fill(lmb_irradiance *out, const lmb_kernels *kernels, const live_grid *g, const lmb_tile *tile)
{
    const live_grid_tile *t = grid_tile(g, tile->x / LMB_TILE, tile->y / LMB_TILE);
    const uint64_t shown = tile->hits == LMB_TILE_PIXELS ? ~(uint64_t)0 : tile_pixels(tile);
    uint64_t left = 0;
    if (t->plain == GRID_WHOLE) {
        return fill_cell(out, kernels, g, tile, shown, -(tile->x % GRID_COARSE), -(tile->y % GRID_COARSE), GRID_COARSE);
    }
    if (!t->divided) {
        return fill_cell(out, kernels, g, tile, shown, 0, 0, LMB_TILE);
    }
    for (int part = 0; part < 4; ++part) {
        const int32_t x = part % 2 * (LMB_TILE / 2), y = part / 2 * (LMB_TILE / 2);
        if (!(t->parts >> part & 1)) {
            left |= fill_cell(out, kernels, g, tile, shown & square(x, y, LMB_TILE / 2), x, y, LMB_TILE / 2);
        }
        for (int i = 0; i < 4 && (t->parts >> part & 1); ++i) {
            const int32_t at = x + i % 2 * GRID_STEP, down = y + i / 2 * GRID_STEP;
            left |= fill_cell(out, kernels, g, tile, shown & square(at, down, GRID_STEP), at, down, GRID_STEP);
        }
    }
    return left;
}

/* Does the light change so much over a cell of 2 px that its pixels need light of their own? */
static int has_steep_light(const live_grid *g, int32_t x, int32_t y)
{
    float low = 3e38f, high = 0.0f;
    cell c;
    set_cell(&c, g, x, y, GRID_STEP);
    for (int i = 0; i < 4; ++i) {
        if (c.corner[i] != NULL) {
            low = minf(low, all_of(c.corner[i]->light));
            high = maxf(high, all_of(c.corner[i]->light));
        }
    }
    const float change = (high - low) * (1.0f / 3.0f);
    return high > STEEP * low && change * change > STEEPER * g->split * g->mean * g->mean;
}

uint64_t lmb_live_grid_steep(const live_grid *g, const lmb_tile *tile)
{
    const live_grid_tile *t = grid_tile(g, tile->x / LMB_TILE, tile->y / LMB_TILE);
    uint64_t out = 0;
    for (int i = 0; i < GRID_SAMPLES && t->parts != 0; ++i) {
        const int32_t x = i % GRID_SIDE * GRID_STEP, y = i / GRID_SIDE * GRID_STEP;
        const int part = y / (LMB_TILE / 2) * 2 + x / (LMB_TILE / 2);
        if ((t->parts >> part & 1) != 0 && has_steep_light(g, tile->x + x, tile->y + y)) {
            out |= square(x, y, GRID_STEP) & ~((uint64_t)1 << grid_pixel(i));
        }
    }
    return out & tile_pixels(tile);
}

#endif
