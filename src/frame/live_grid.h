/* live_grid.h: samples of a frame with bounced light at single points. Layer 8.
 *
 * Samples lie on a grid of 16 px, at the first pixel of every other tile. A cell of 16 px is divided into cells of 8 px
 * if the light varies in it or if its pixels do not all lie in one plane; these are divided into cells of 4 and 2 px.
 * The samples of 8 px and the lit ones store their surface. The grid uses the memory of lmb_lattice. */
#ifndef LMB_FRAME_LIVE_GRID_H
#define LMB_FRAME_LIVE_GRID_H

#include <lambent/compose.h>
#include <lambent/live.h>

#include "../base/vec.h"
#include "../lane/kernels.h"

enum {
    GRID_STEP = LMB_LIVE_SMALL ? LMB_TILE : 2, /* px between the closest samples */
    GRID_SIDE = LMB_TILE / GRID_STEP, /* samples along a tile's side */
    GRID_SQUARE = GRID_SIDE + 1, /* the same with the next tile's first one */
    GRID_SAMPLES = GRID_SIDE * GRID_SIDE,
    GRID_COARSE = 2 * LMB_TILE, /* px between the first samples */
    GRID_LEVELS = 4, /* steps of 16, 8, 4 and 2 px */
    GRID_FLAT = 1,   /* all pixels of a tile lie in one plane and have its normal, */
    GRID_WHOLE = 2   /* and the tile lies in a cell of 16 px that is not divided */
};

/* Sample k of a tile lies at column k % 4 * 2 and row k / 4 * 2. */
typedef struct live_grid_tile {
    uint16_t shown, known; /* samples with a surface; lit samples */
    uint8_t divided;       /* the cell of 8 px is divided */
    uint8_t parts;         /* mask of the tile's cells of 4 px that are divided */
    uint8_t lobes;         /* gathered whole: no samples */
    uint8_t plain;         /* GRID_FLAT .. */
} live_grid_tile;

typedef struct live_grid {
    live_grid_tile *tile;
    lmb_live_sample *first, *other; /* sample 0 of each tile; samples 1 .. 15, which most tiles lack */
    int32_t width, height, columns, rows; /* px; tiles */
    float mean;  /* mean light of the first samples, R + G + B, W/m2 */
    float split; /* divide a cell if (surplus / 3)^2 x area > split x mean^2 */
    float noise; /* 1 / sqrt(segments): scales the deviation of a share from a single segment */
} live_grid;

/* Returns the grid in a lattice's memory. `strata`: segments of a sample. */
live_grid lmb_live_grid_of(const lmb_lattice *l, int32_t strata);

/* The surface at a pixel of a tile, as a sample that is not lit. */
lmb_live_sample lmb_live_grid_surface(const lmb_tile *tile, int k);

/* Stores which samples of a tile have a surface, and the surface of those of 8 px. If you pass `lobes`, the tile is
 * gathered whole. lmb_live_grid_put_even: for a tile that is not at the right or lower edge of the frame, if one
 * triangle with one normal fills the tile. */
void lmb_live_grid_put(const live_grid *g, const lmb_tile *tile, int lobes);
void lmb_live_grid_put_even(const live_grid *g, const lmb_live_sample *first, int32_t column, int32_t row);

/* Pixel of a tile at sample k. */
static inline int grid_pixel(int k) { return k / GRID_SIDE * GRID_STEP * LMB_TILE + k % GRID_SIDE * GRID_STEP; }

/* 1 if the tile lies at the right or lower edge of the frame. */
static inline int grid_is_last(const live_grid *g, int32_t column, int32_t row)
{
    return column == g->columns - 1 || row == g->rows - 1;
}

/* Mask of a tile's samples that level 0 .. GRID_LEVELS - 1 requests and that are not known. */
uint32_t lmb_live_grid_asks(const live_grid *g, int32_t column, int32_t row, int32_t level);

/* Mean light of the samples of level 0. */
float lmb_live_grid_mean(const live_grid *g);

/* Divides the cells of level 0, 1 or 2 that predict their samples badly, in two rows of tiles; `row` is even. On
 * level 0 a call with a row of 4 n divides four rows. */
void lmb_live_grid_divide(const live_grid *g, int32_t row, int32_t level);

/* Removes noise from the shares of a tile's samples and updates their light. Call lmb_live_grid_slopes next: it sets
 * the slopes. */
void lmb_live_grid_smooth(const live_grid *g, int32_t column, int32_t row);
void lmb_live_grid_slopes(const live_grid *g, int32_t column, int32_t row);

/* Lights a tile's pixels between the samples. Returns the mask of pixels that no sample explains. */
uint64_t lmb_live_grid_fill(lmb_irradiance *out, const lmb_kernels *kernels, const live_grid *g, const lmb_tile *tile);

/* Pixels that need light of their own: those between samples 2 px apart in a steep cell. A bright surface
 * behind a slit is a line of a pixel, and a sample on the line would light the dark pixels beside it. */
uint64_t lmb_live_grid_steep(const live_grid *g, const lmb_tile *tile);

/* The shift of the segments towards a sky, 0 .. 1: samples beside each other differ. On grids of 1, 2 and 4 steps any
 * 3 x 3 samples have all nine shifts. */
static inline float live_turn(int32_t column, int32_t row)
{
    return ((float)(column % 3 * 3 + row % 3) + 0.5f) * (1.0f / 9.0f);
}

/* 0 .. 1: how well two samples agree in their surface. On a smooth surface the height over the other sample's plane
 * grows with the angle between the normals. */
static inline float live_agree(const lmb_live_sample *a, const lmb_live_sample *b)
{
    const float bend = 1.0f - dot3(a->normal, b->normal);
    if (!(bend <= 1.0f - LIVE_SAME_COS)) {
        return 0.0f;
    }
    const lmb_vec3 d = sub3(b->position, a->position);
    const float lift = maxf(absf(dot3(a->face, d)), absf(dot3(b->face, d)));
    if (!(lift * lift <= (2.0f * bend + LIVE_SAME_LIFT) * dot3(d, d))) {
        return 0.0f;
    }
    return bend > 1e-4f ? 1.0f - bend * (1.0f / (1.0f - LIVE_SAME_COS)) * 0.999f : 1.0f;
}

static inline live_grid_tile *grid_tile(const live_grid *g, int32_t column, int32_t row)
{
    return g->tile + (size_t)row * (size_t)g->columns + (size_t)column;
}

/* Sample k of a tile. */
static inline lmb_live_sample *grid_sample(const live_grid *g, const live_grid_tile *t, int k)
{
    const size_t i = (size_t)(t - g->tile);
    return k == 0 ? &g->first[i] : &g->other[i * (GRID_SAMPLES - 1) + (size_t)(k - 1)];
}

#endif
