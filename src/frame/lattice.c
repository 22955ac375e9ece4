/* lattice.c: chooses the pixels of a frame to gather, and interpolates the light between them. Layer 8.       [ours]
 *
 * Samples lie at the corners of square cells. A cell is divided if the parent cell predicted the corners badly (the
 * surplus). Light is extrapolated from the corners by their slopes; corners on other surfaces do not count. */
#include "lattice.h"

#include <string.h>

#include "../base/memory_check.h"
#include "../raster/tile.h"

#if LMB_TREES

#define MIN_NORMAL_COSINE  0.95f /* min cosine between the normals of pixels that share light */
#define MAX_OFF_PLANE2     1e-3f /* max squared height over the other's plane / squared distance, at equal normals */
#define MIN_AGREEING_SHARE 0.9f  /* min share of the bilinear weights of the corners that agree, ... */
#define MAX_NEAR_PX        1     /* ... unless one of them is within this many px */
#define MAX_REACH_PX       6     /* px each way within which a pixel that no corner explains needs a sample, */
#define MIN_REACH_PX       1     /* or this many, if the samples within */
#define MIN_DIFFERING_PX   14    /* this many px differ */
#define MIN_UNEVEN_SHARE   0.3f  /* by more than this share of the mean light */

/* --- layout ------------------------------------------------------------------------------------------------------- */

static int32_t step_of_level(int32_t level) { return LATTICE_STEP >> level; }

static int32_t cells_along(int32_t pixels, int32_t level)
{
    return (pixels + step_of_level(level) - 1) / step_of_level(level);
}

static size_t cells_before(int32_t width, int32_t height, int32_t level)
{
    size_t out = 0;
    for (int32_t i = 0; i < level; ++i) {
        out += (size_t)cells_along(width, i) * (size_t)cells_along(height, i);
    }
    return out;
}

static uint8_t *cell_mark(const lmb_lattice *l, int32_t level, int32_t x, int32_t y)
{
    return l->divided + cells_before(l->width, l->height, level) +
           (size_t)(y / step_of_level(level)) * (size_t)cells_along(l->width, level) +
           (size_t)(x / step_of_level(level));
}

static size_t tiles_of(int32_t width, int32_t height)
{
    return (size_t)((width + LMB_TILE - 1) / LMB_TILE) * (size_t)((height + LMB_TILE - 1) / LMB_TILE);
}

size_t lmb_lattice_bytes(int32_t width, int32_t height)
{
    if (width < 1 || width > LMB_MAX_SIDE || height < 1 || height > LMB_MAX_SIDE) {
        return 0;
    }
    const uint64_t bytes =
        (uint64_t)sizeof(lmb_lattice_tile) * tiles_of(width, height) + cells_before(width, height, LATTICE_LEVELS - 1);
    return bytes <= SIZE_MAX ? (size_t)bytes : 0;
}

lmb_status lmb_lattice_init(lmb_lattice *out, int32_t width, int32_t height, void *memory, size_t bytes)
{
    const lmb_status status = check_room(out, memory, bytes, lmb_lattice_bytes(width, height));
    if (status != LMB_OK) {
        return status;
    }
    out->tile = (lmb_lattice_tile *)memory;
    out->divided = (uint8_t *)(out->tile + tiles_of(width, height));
    out->width = width;
    out->height = height;
    out->mean = out->split = 0.0f;
    return LMB_OK;
}

int32_t lmb_lattice_windows(const lmb_lattice *l)
{
    return ((lattice_columns(l) + LATTICE_WINDOW - 1) / LATTICE_WINDOW) *
           ((lattice_rows(l) + LATTICE_WINDOW - 1) / LATTICE_WINDOW);
}

void lmb_lattice_window(int32_t column[2], int32_t row[2], const lmb_lattice *l, int32_t window)
{
    const int32_t across = (lattice_columns(l) + LATTICE_WINDOW - 1) / LATTICE_WINDOW;
    column[0] = window % across * LATTICE_WINDOW;
    row[0] = window / across * LATTICE_WINDOW;
    column[1] = mini(column[0] + LATTICE_WINDOW, lattice_columns(l));
    row[1] = mini(row[0] + LATTICE_WINDOW, lattice_rows(l));
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

typedef struct pixel {
    lmb_lattice_tile *tile;
    int32_t k;
} pixel;

static pixel lattice_pixel(const lmb_lattice *l, int32_t x, int32_t y)
{
    pixel p;
    p.tile = lattice_tile(l, x / LMB_TILE, y / LMB_TILE);
    p.k = y % LMB_TILE * LMB_TILE + x % LMB_TILE;
    return p;
}

static int is_pixel_known(pixel p) { return (int)(p.tile->known >> p.k & 1u); }

/* Does column or row x, of `size`, hold samples of a lattice? Multiples of the step do, and the last one. */
static int is_on_step(int32_t x, int32_t step, int32_t size) { return x % step == 0 || x == size - 1; }

/* 0 .. 1: how well two pixels agree in their surface. On a smooth surface the height over the other pixel's plane grows
 * with the angle between the normals. */
static float pixel_agreement(const lmb_lattice_tile *a, int i, const lmb_lattice_tile *b, int k)
{
    const float bend = 1.0f - dot3(tile_vec(a->normal, i), tile_vec(b->normal, k));
    if (!(bend <= 1.0f - MIN_NORMAL_COSINE)) {
        return 0.0f;
    }
    const lmb_vec3 d = sub3(tile_vec(b->position, k), tile_vec(a->position, i));
    const float lift = maxf(absf(dot3(tile_vec(a->face, i), d)), absf(dot3(tile_vec(b->face, k), d)));
    if (!(lift * lift <= (2.0f * bend + MAX_OFF_PLANE2) * dot3(d, d))) {
        return 0.0f;
    }
    return bend > 1e-4f ? 1.0f - bend * (1.0f / (1.0f - MIN_NORMAL_COSINE)) * 0.999f : 1.0f;
}

int lmb_lattice_alike(const lmb_lattice_tile *a, int i, const lmb_lattice_tile *b, int k)
{
    return pixel_agreement(a, i, b, k) > 0.0f;
}

static int is_tile_flat(const lmb_tile *tile, uint64_t shown)
{
    const int first = shown != 0 ? lowest_bit_64(shown) : 0;
    const lmb_vec3 n = tile_vec(tile->face, first), at = tile_vec(tile->position, first);
    float turn = 0.0f, lift = 0.0f, far = 0.0f;
    for (uint64_t bits = shown; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 d = sub3(tile_vec(tile->position, k), at);
        turn = maxf(turn, largest3(sub3(tile_vec(tile->face, k), n)));
        turn = maxf(turn, largest3(sub3(tile_vec(tile->normal, k), n)));
        lift = maxf(lift, absf(dot3(n, d)));
        far = maxf(far, dot3(d, d));
    }
    return turn <= 1e-3f && lift * lift <= 1e-6f * far;
}

void lmb_lattice_put(const lmb_lattice *l, const lmb_tile *tile, int lobes)
{
    lmb_lattice_tile *out = lattice_tile(l, tile->x / LMB_TILE, tile->y / LMB_TILE);
    memcpy(out->position, tile->position, sizeof out->position);
    memcpy(out->face, tile->face, sizeof out->face);
    memcpy(out->normal, tile->normal, sizeof out->normal);
    memcpy(out->id, tile->id, sizeof out->id);
    out->shown = lobes ? 0 : tile_pixels(tile);
    out->known = out->wanted = 0;
    out->flat = is_tile_flat(tile, out->shown);
    memset(&out->light, 0, sizeof out->light);
    for (uint64_t bits = out->shown; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        if (is_on_step(tile->x + k % LMB_TILE, LATTICE_STEP, l->width) &&
            is_on_step(tile->y + k / LMB_TILE, LATTICE_STEP, l->height)) {
            out->wanted |= (uint64_t)1 << k;
        }
    }
}

float lmb_lattice_mean(const lmb_lattice *l)
{
    const size_t tiles = tiles_of(l->width, l->height);
    double sum = 0.0, count = 0.0;
    for (size_t i = 0; i < tiles; ++i) {
        for (uint64_t bits = l->tile[i].known; bits != 0; bits &= bits - 1) {
            for (int c = 0; c < 3; ++c) {
                sum += (double)l->tile[i].light.rgb[c][lowest_bit_64(bits)];
            }
            count += 1.0;
        }
    }
    return count > 0.0 ? (float)(sum / count) : 0.0f;
}

/* --- between four corners ----------------------------------------------------------------------------------------- */

typedef struct patch_corner {
    pixel at;
    float light[3], slope[2][3]; /* W/m2; and W/m2 per pixel, along columns and rows */
} patch_corner;

typedef struct lattice_cell {
    int32_t x[2], y[2];
    patch_corner corner[4];
    float width, height; /* as divisors: at least 1 */
} lattice_cell;

/* Position of the sample before or after a pixel in a row or column; -1 if there is none. */
static int32_t step_before(int32_t x, int32_t step) { return x > 0 ? (x - 1) / step * step : -1; }
static int32_t step_after(int32_t x, int32_t step, int32_t size)
{
    return x < size - 1 ? mini((x / step + 1) * step, size - 1) : -1;
}

/* Finds the neighbour along columns or rows. Returns the distance in px; 0 if there is none. */
static float neighbour_pixel(pixel *out, const lmb_lattice *l, const patch_corner *c, int32_t x, int32_t y, int way,
                             int ahead, int32_t step)
{
    for (int32_t s = step; s <= 2 * step; s *= 2) {
        const int32_t from = way == 0 ? x : y, size = way == 0 ? l->width : l->height;
        const int32_t to = ahead ? step_after(from, s, size) : step_before(from, s);
        if (to >= 0) {
            *out = way == 0 ? lattice_pixel(l, to, y) : lattice_pixel(l, x, to);
            if (is_pixel_known(*out) && pixel_agreement(c->at.tile, c->at.k, out->tile, out->k) > 0.0f) {
                return (float)(to > from ? to - from : from - to);
            }
        }
    }
    return 0.0f;
}

static void set_corner_slope(patch_corner *c, const lmb_lattice *l, int32_t x, int32_t y, int way, int32_t step)
{
    pixel less, more;
    const float down = neighbour_pixel(&less, l, c, x, y, way, 0, step),
                up = neighbour_pixel(&more, l, c, x, y, way, 1, step);
    for (int i = 0; i < 3; ++i) {
        const float from = c->light[i];
        const float s0 = down > 0.0f ? (from - less.tile->light.rgb[i][less.k]) / down : 0.0f;
        const float s1 = up > 0.0f ? (more.tile->light.rgb[i][more.k] - from) / up : 0.0f;
        c->slope[way][i] = down > 0.0f && up > 0.0f ? (s0 * up + s1 * down) / (up + down) : s0 + s1;
    }
}

/* Sets the positions of the cell's corners, which may be gathered later. */
static void place_cell(lattice_cell *out, const lmb_lattice *l, int32_t x, int32_t y, int32_t step)
{
    out->x[0] = x;
    out->y[0] = y;
    out->x[1] = mini(x + step, l->width - 1);
    out->y[1] = mini(y + step, l->height - 1);
    out->width = maxf((float)(out->x[1] - x), 1.0f);
    out->height = maxf((float)(out->y[1] - y), 1.0f);
    for (int i = 0; i < 4; ++i) {
        out->corner[i].at = lattice_pixel(l, out->x[i & 1], out->y[i >> 1]);
    }
}

static void set_lattice_cell(lattice_cell *out, const lmb_lattice *l, int32_t x, int32_t y, int32_t step)
{
    place_cell(out, l, x, y, step);
    for (int i = 0; i < 4; ++i) {
        patch_corner *c = &out->corner[i];
        memset(c->light, 0, sizeof c->light);
        memset(c->slope, 0, sizeof c->slope);
        if (is_pixel_known(c->at)) {
            for (int k = 0; k < 3; ++k) {
                c->light[k] = c->at.tile->light.rgb[k][c->at.k];
            }
            set_corner_slope(c, l, out->x[i & 1], out->y[i >> 1], 0, step);
            set_corner_slope(c, l, out->x[i & 1], out->y[i >> 1], 1, step);
        }
    }
}

static void set_agreements(float out[4], const lattice_cell *c, const lmb_lattice_tile *tile, int k)
{
    for (int i = 0; i < 4; ++i) {
        const pixel at = c->corner[i].at;
        out[i] = at.tile->shown >> at.k & 1u ? pixel_agreement(tile, k, at.tile, at.k) : 0.0f;
    }
}

/* Light at (x, y) from the corners that agree: a bilinear mean, with each corner extrapolated by half of the slopes,
 * which is exact for quadratics. If a corner is missing, full slopes are used, which is exact for linear light. */
static void mix_corners(float out[3], const lattice_cell *c, const float agree[4], int32_t x, int32_t y)
{
    const float u = (float)(x - c->x[0]) / c->width, v = (float)(y - c->y[0]) / c->height;
    const int all = agree[0] > 0.0f && agree[1] > 0.0f && agree[2] > 0.0f && agree[3] > 0.0f;
    const float part = all ? 0.5f : 1.0f;
    float sum = 0.0f, add[3] = {0, 0, 0}, low[3] = {3e38f, 3e38f, 3e38f}, high[3] = {0, 0, 0};
    for (int i = 0; i < 4; ++i) {
        const patch_corner *at = &c->corner[i];
        if (agree[i] > 0.0f) {
            const float w = ((i & 1 ? u : 1.0f - u) * (i >> 1 ? v : 1.0f - v) + 0.001f) * agree[i];
            const float dx = part * (float)(x - c->x[i & 1]), dy = part * (float)(y - c->y[i >> 1]);
            sum += w;
            for (int k = 0; k < 3; ++k) {
                add[k] += w * (at->light[k] + (at->slope[0][k] * dx + at->slope[1][k] * dy));
                low[k] = minf(low[k], at->light[k]);
                high[k] = maxf(high[k], at->light[k]);
            }
        }
    }
    for (int k = 0; k < 3; ++k) {
        const float span = 0.5f * (high[k] - low[k]);
        out[k] = clampf(add[k] / sum, maxf(low[k] - span, 0.0f), high[k] + span);
    }
}

/* --- dividing ----------------------------------------------------------------------------------------------------- */

static float cell_surplus(const lmb_lattice *l, const lattice_cell *c, int32_t x, int32_t y)
{
    const pixel p = lattice_pixel(l, x, y);
    float agree[4], by[3] = {0, 0, 0}, sum = 0.0f;
    if (!is_pixel_known(p)) {
        return 0.0f;
    }
    set_agreements(agree, c, p.tile, p.k);
    if (!(agree[0] + agree[1] + agree[2] + agree[3] > 0.0f)) {
        return 0.0f; /* the first sample of a surface has no prediction */
    }
    mix_corners(by, c, agree, x, y);
    for (int k = 0; k < 3; ++k) {
        sum += absf(p.tile->light.rgb[k][p.k] - by[k]);
    }
    return sum;
}

static void ask(const lmb_lattice *l, int32_t x, int32_t y)
{
    const pixel p = lattice_pixel(l, x, y);
    p.tile->wanted |= p.tile->shown & ~p.tile->known & (uint64_t)1 << p.k;
}

/* Requests the middles of a cell's sides and of the cell. */
static void ask_between(const lmb_lattice *l, int32_t x, int32_t y, int32_t step)
{
    const int32_t half = step / 2;
    for (int32_t i = 0; i < 9; ++i) {
        const int32_t at = mini(x + i % 3 * half, l->width - 1), down = mini(y + i / 3 * half, l->height - 1);
        ask(l, at, down);
    }
}

/* Decides which of a cell's four parts to divide. */
static void divide_cell_parts(const lmb_lattice *l, int32_t level, int32_t x, int32_t y)
{
    const int32_t step = step_of_level(level);
    float surplus[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    lattice_cell c;
    set_lattice_cell(&c, l, x, y, 2 * step);
    for (int32_t i = 0; i < 9; ++i) {
        const int32_t at = mini(x + i % 3 * step, l->width - 1), down = mini(y + i / 3 * step, l->height - 1);
        if (i % 2 == 1 || i == 4) {
            surplus[i] = cell_surplus(l, &c, at, down);
        }
    }
    for (int32_t i = 0; i < 4; ++i) {
        const int32_t left = x + (i & 1) * step, top = y + (i >> 1) * step, at = (i >> 1) * 3 + (i & 1);
        if (left < l->width && top < l->height) {
            const float worst = maxf(maxf(surplus[at], surplus[at + 1]), maxf(surplus[at + 3], surplus[at + 4])) / 3.0f;
            const int over = worst * worst * (float)(step * step) > l->split * l->mean * l->mean;
            *cell_mark(l, level, left, top) = (uint8_t)over;
            if (over) {
                ask_between(l, left, top, step);
            }
        }
    }
}

void lmb_lattice_divide(const lmb_lattice *l, int32_t level)
{
    const int32_t step = 2 * step_of_level(level);
    if (level == 0) {
        memset(l->divided, 0, cells_before(l->width, l->height, LATTICE_LEVELS - 1));
    }
    for (int32_t y = 0; y < l->height; y += step) {
        for (int32_t x = 0; x < l->width; x += step) {
            if (level == 0 || *cell_mark(l, level - 1, x, y)) {
                divide_cell_parts(l, level, x, y);
            }
        }
    }
}

/* --- filling ------------------------------------------------------------------------------------------------------ */

static void set_light(lmb_lattice_tile *tile, int k, const float light[3])
{
    for (int c = 0; c < 3; ++c) {
        tile->light.rgb[c][k] = light[c];
    }
}

/* Does a pixel lie on the plane of the previous one? */
static int surface_goes_on(const lmb_lattice_tile *tile, int was, int k)
{
    const lmb_vec3 n = tile_vec(tile->face, was);
    const lmb_vec3 turn = sub3(tile_vec(tile->face, k), n), bend = sub3(tile_vec(tile->normal, k), n);
    const lmb_vec3 own = sub3(tile_vec(tile->normal, was), n),
                   d = sub3(tile_vec(tile->position, k), tile_vec(tile->position, was));
    const float lift = dot3(n, d);
    return largest3(turn) <= 1e-3f && largest3(bend) <= 1e-3f && largest3(own) <= 1e-3f &&
           lift * lift <= 1e-5f * dot3(d, d);
}

/* Do the corners that agree explain a pixel? Not if it lies far beyond the last of them. */
static int is_explained(const lattice_cell *c, const float agree[4], int32_t x, int32_t y)
{
    const float u = (float)(x - c->x[0]) / c->width, v = (float)(y - c->y[0]) / c->height;
    float sum = 0.0f;
    int near = 0;
    for (int i = 0; i < 4; ++i) {
        if (agree[i] > 0.0f) {
            const int32_t dx = x - c->x[i & 1], dy = y - c->y[i >> 1];
            sum += (i & 1 ? u : 1.0f - u) * (i >> 1 ? v : 1.0f - v);
            near |= dx * dx + dy * dy <= MAX_NEAR_PX * MAX_NEAR_PX;
        }
    }
    return sum >= MIN_AGREEING_SHARE || near;
}

/* Do all four corners have full weight? */
static int is_cell_whole(const float agree[4])
{
    return agree[0] == 1.0f && agree[1] == 1.0f && agree[2] == 1.0f && agree[3] == 1.0f;
}

/* Writes only the pixels of `own`: another window may be reading the samples. */
static void put_light_row(float *to, const float light[LMB_TILE], uint64_t own)
{
    if (own == 0xff) {
        memcpy(to, light, LMB_TILE * sizeof *to);
        return;
    }
    for (int32_t i = 0; i < LMB_TILE; ++i) {
        if (own >> i & 1u) {
            to[i] = light[i];
        }
    }
}

/* Same result as `mix` if all corners have full weight, for pixels of a tile: row by row, from the left side of the
 * cell to the right. Equal corners give exactly their light. */
static void mix_whole(lmb_lattice_tile *tile, const lattice_cell *c, int32_t x, int32_t y, uint64_t pixels)
{
    const patch_corner *at = c->corner;
    const float half_width = 0.5f * (float)(c->x[1] - c->x[0]);
    for (int32_t row = 0; row < LMB_TILE; ++row) {
        const uint64_t own = pixels >> (LMB_TILE * row) & 0xff;
        const float dy = 0.5f * (float)(y + row - c->y[0]), up = 0.5f * (float)(y + row - c->y[1]);
        const float v = (float)(y + row - c->y[0]) / c->height;
        for (int k = 0; k < 3 && own != 0; ++k) {
            const float a0 = at[0].light[k] + at[0].slope[1][k] * dy, a1 = at[1].light[k] + at[1].slope[1][k] * dy,
                        left = a0 + v * (at[2].light[k] + at[2].slope[1][k] * up - a0),
                        right = a1 + v * (at[3].light[k] + at[3].slope[1][k] * up - a1),
                        s0 = at[0].slope[0][k] + v * (at[2].slope[0][k] - at[0].slope[0][k]),
                        s1 = at[1].slope[0][k] + v * (at[3].slope[0][k] - at[1].slope[0][k]),
                        low = minf(minf(at[0].light[k], at[1].light[k]), minf(at[2].light[k], at[3].light[k])),
                        high = maxf(maxf(at[0].light[k], at[1].light[k]), maxf(at[2].light[k], at[3].light[k])),
                        lower = maxf(low - 0.5f * (high - low), 0.0f), upper = high + 0.5f * (high - low);
            float light[LMB_TILE];
            for (int32_t i = 0; i < LMB_TILE; ++i) {
                const float dx = 0.5f * (float)(x + i - c->x[0]), u = (float)(x + i - c->x[0]) / c->width;
                const float from = left + s0 * dx;
                light[i] = clampf(from + u * (right + s1 * (dx - half_width) - from), lower, upper);
            }
            put_light_row(tile->light.rgb[k] + LMB_TILE * row, light, own);
        }
    }
}

/* Lights some pixels of a tile that lie in the cell; pixels that no corner explains are added to `wanted`. */
static void fill_pixels(lmb_lattice_tile *tile, const lattice_cell *c, int32_t x, int32_t y, uint64_t pixels)
{
    float agree[4] = {0, 0, 0, 0};
    int was = -1;
    if (tile->flat && pixels != 0) {
        set_agreements(agree, c, tile, lowest_bit_64(pixels));
        if (is_cell_whole(agree)) {
            mix_whole(tile, c, x, y, pixels);
            return;
        }
    }
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        float light[3];
        if (was < 0 || !(tile->flat || surface_goes_on(tile, was, k))) {
            set_agreements(agree, c, tile, k);
        }
        was = k;
        if (is_explained(c, agree, x + k % LMB_TILE, y + k / LMB_TILE)) {
            mix_corners(light, c, agree, x + k % LMB_TILE, y + k / LMB_TILE);
            set_light(tile, k, light);
        } else {
            tile->wanted |= (uint64_t)1 << k;
        }
    }
}

/* Mask of a tile's pixels in columns x[0] .. x[1] - 1 and rows y[0] .. y[1] - 1. */
static uint64_t pixels_within(const int32_t x[2], const int32_t y[2])
{
    const uint64_t row = (((uint64_t)1 << (x[1] - x[0])) - 1) << x[0];
    uint64_t out = 0;
    for (int32_t i = y[0]; i < y[1]; ++i) {
        out |= row << (LMB_TILE * i);
    }
    return out;
}

static void fill_lattice_cell(const lmb_lattice *l, int32_t left, int32_t top, int32_t step)
{
    lattice_cell c;
    int made = 0;
    for (int32_t y = top - top % LMB_TILE; y < mini(top + step, l->height); y += LMB_TILE) {
        for (int32_t x = left - left % LMB_TILE; x < mini(left + step, l->width); x += LMB_TILE) {
            lmb_lattice_tile *tile = lattice_tile(l, x / LMB_TILE, y / LMB_TILE);
            const int32_t columns[2] = {maxi(left - x, 0), mini(left + step - x, LMB_TILE)};
            const int32_t rows[2] = {maxi(top - y, 0), mini(top + step - y, LMB_TILE)};
            const uint64_t pixels = pixels_within(columns, rows) & tile->shown & ~tile->known;
            if (pixels != 0 && !made) {
                set_lattice_cell(&c, l, left, top, step);
                made = 1;
            }
            if (pixels != 0) {
                fill_pixels(tile, &c, x, y, pixels);
            }
        }
    }
}

/* Fills the cells into which the cell at (x, y) is divided, in Morton order, in which cells of each size are
 * contiguous. */
static void fill_divided(const lmb_lattice *l, int32_t x, int32_t y)
{
    for (int32_t i = 0; i < LATTICE_STEP * LATTICE_STEP;) {
        int32_t left = x, top = y, level = 0;
        for (int32_t bit = 0; bit < LATTICE_LEVELS - 1; ++bit) {
            left += (i >> (2 * bit) & 1) << bit;
            top += (i >> (2 * bit + 1) & 1) << bit;
        }
        if (left >= l->width || top >= l->height) {
            ++i;
            continue;
        }
        while (level < LATTICE_LEVELS - 1 && *cell_mark(l, level, left, top)) {
            ++level;
        }
        fill_lattice_cell(l, left, top, step_of_level(level));
        i += step_of_level(level) * step_of_level(level);
    }
}

void lmb_lattice_fill(const lmb_lattice *l, int32_t window)
{
    int32_t column[2], row[2];
    lmb_lattice_window(column, row, l, window);
    for (int32_t ty = row[0]; ty < row[1]; ++ty) {
        for (int32_t tx = column[0]; tx < column[1]; ++tx) {
            lattice_tile(l, tx, ty)->early = lattice_tile(l, tx, ty)->known;
        }
    }
    for (int32_t y = row[0] * LMB_TILE; y < row[1] * LMB_TILE; y += LATTICE_STEP) {
        for (int32_t x = column[0] * LMB_TILE; x < column[1] * LMB_TILE; x += LATTICE_STEP) {
            fill_divided(l, x, y);
        }
    }
}

/* --- pixels that no corner explains ------------------------------------------------------------------------------- */

/* Tile columns and rows of a window. */
typedef struct window {
    int32_t column[2], row[2];
} window;

static window window_of(const lmb_lattice *l, int32_t i)
{
    window w = {{0, 0}, {0, 0}};
    lmb_lattice_window(w.column, w.row, l, i);
    return w;
}

/* Samples near a pixel and on the same surface. */
typedef struct lattice_around {
    float sum, light[3]; /* sums of weights and of weighted light */
    float low, high;     /* R + G + B */
} lattice_around;

static void add_lattice_around(lattice_around *out, const lmb_lattice_tile *tile, int k, float weight)
{
    float all = 0.0f;
    for (int c = 0; c < 3; ++c) {
        out->light[c] += weight * tile->light.rgb[c][k];
        all += tile->light.rgb[c][k];
    }
    out->low = out->sum > 0.0f ? minf(out->low, all) : all;
    out->high = out->sum > 0.0f ? maxf(out->high, all) : all;
    out->sum += weight;
}

/* Pixels of a tile that may be read from this window. Outside the window: pixels that no other window changes at the
 * same time. `wanted`: includes pixels to be gathered, and none outside the window. */
static uint64_t samples_of(const lmb_lattice *l, const window *w, int32_t tx, int32_t ty, int wanted)
{
    const lmb_lattice_tile *tile = lattice_tile(l, tx, ty);
    if (tx < w->column[0] || tx >= w->column[1] || ty < w->row[0] || ty >= w->row[1]) {
        return wanted ? 0 : tile->early;
    }
    return wanted ? tile->known | tile->wanted : tile->known;
}

/* Collects all samples within `reach` px of pixel (x, y) each way; with `wanted` also those to be gathered. */
static lattice_around around_of_pixel(const lmb_lattice *l, const window *w, int32_t x, int32_t y, int32_t reach,
                                      int wanted)
{
    const pixel own = lattice_pixel(l, x, y);
    const int32_t left = maxi(x - reach, 0), right = mini(x + reach, l->width - 1), top = maxi(y - reach, 0),
                  bottom = mini(y + reach, l->height - 1);
    lattice_around out;
    memset(&out, 0, sizeof out);
    for (int32_t ty = top / LMB_TILE; ty <= bottom / LMB_TILE; ++ty) {
        for (int32_t tx = left / LMB_TILE; tx <= right / LMB_TILE; ++tx) {
            const lmb_lattice_tile *tile = lattice_tile(l, tx, ty);
            const int32_t columns[2] = {maxi(left - tx * LMB_TILE, 0), mini(right + 1 - tx * LMB_TILE, LMB_TILE)};
            const int32_t rows[2] = {maxi(top - ty * LMB_TILE, 0), mini(bottom + 1 - ty * LMB_TILE, LMB_TILE)};
            uint64_t bits = samples_of(l, w, tx, ty, wanted) & pixels_within(columns, rows);
            for (; bits != 0; bits &= bits - 1) {
                const int k = lowest_bit_64(bits);
                const float dx = (float)(tx * LMB_TILE + k % LMB_TILE - x),
                            dy = (float)(ty * LMB_TILE + k / LMB_TILE - y), d2 = 0.5f + dx * dx + dy * dy,
                            weight = pixel_agreement(own.tile, own.k, tile, k) / (d2 * d2);
                if (weight > 0.0f) {
                    add_lattice_around(&out, tile, k, weight);
                }
                if (weight > 0.0f && wanted) {
                    return out; /* one is enough */
                }
            }
        }
    }
    return out;
}

/* Does the light vary strongly around a pixel? */
static int is_uneven(const lmb_lattice *l, const window *w, int32_t x, int32_t y)
{
    const lattice_around a = around_of_pixel(l, w, x, y, MIN_DIFFERING_PX, 0);
    return a.high - a.low > MIN_UNEVEN_SHARE * l->mean;
}

/* Requests the late pixels without a sample within `reach`; with `uneven` only if the light varies there. */
static void ask_around(const lmb_lattice *l, const window *w, int32_t reach, int uneven)
{
    for (int32_t ty = w->row[0]; ty < w->row[1]; ++ty) {
        for (int32_t tx = w->column[0]; tx < w->column[1]; ++tx) {
            lmb_lattice_tile *tile = lattice_tile(l, tx, ty);
            for (uint64_t bits = tile->late; bits != 0; bits &= bits - 1) {
                const int k = lowest_bit_64(bits);
                const int32_t x = tx * LMB_TILE + k % LMB_TILE, y = ty * LMB_TILE + k / LMB_TILE;
                if (!(around_of_pixel(l, w, x, y, reach, 1).sum > 0.0f) && (!uneven || is_uneven(l, w, x, y))) {
                    tile->wanted |= (uint64_t)1 << k;
                }
            }
            tile->late &= ~tile->wanted;
        }
    }
}

void lmb_lattice_rest(const lmb_lattice *l, int32_t i)
{
    const window w = window_of(l, i);
    for (int32_t ty = w.row[0]; ty < w.row[1]; ++ty) {
        for (int32_t tx = w.column[0]; tx < w.column[1]; ++tx) {
            lmb_lattice_tile *tile = lattice_tile(l, tx, ty);
            tile->late = tile->wanted;
            tile->wanted = 0;
        }
    }
    ask_around(l, &w, MAX_REACH_PX, 0);
}

void lmb_lattice_closer(const lmb_lattice *l, int32_t i)
{
    const window w = window_of(l, i);
    ask_around(l, &w, MIN_REACH_PX, 1);
}

void lmb_lattice_late(const lmb_lattice *l, int32_t i)
{
    const window w = window_of(l, i);
    for (int32_t ty = w.row[0]; ty < w.row[1]; ++ty) {
        for (int32_t tx = w.column[0]; tx < w.column[1]; ++tx) {
            lmb_lattice_tile *tile = lattice_tile(l, tx, ty);
            for (uint64_t bits = tile->late; bits != 0; bits &= bits - 1) {
                const int k = lowest_bit_64(bits);
                const lattice_around a =
                    around_of_pixel(l, &w, tx * LMB_TILE + k % LMB_TILE, ty * LMB_TILE + k / LMB_TILE, MAX_REACH_PX, 0);
                const float share = a.sum > 0.0f ? 1.0f / a.sum : 0.0f;
                const float light[3] = {a.light[0] * share, a.light[1] * share, a.light[2] * share};
                set_light(tile, k, light);
            }
        }
    }
}

#endif
