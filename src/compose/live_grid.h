/* live_grid.h: samples of a frame whose bounced light is that of single points: what src/frame does with them. Layer 9.
 *
 * Samples lie on a grid of 8 px, at the first pixel of each tile. Where light changes, the cell between four of them is
 * divided into cells of 4 px, and these into cells of 2 px. Only a sample that is lit keeps its surface. The grid lies
 * in the memory of lmb_lattice. */
#ifndef LMB_COMPOSE_LIVE_GRID_H
#define LMB_COMPOSE_LIVE_GRID_H

#include <lambent/compose.h>
#include <lambent/live.h>

#include "../base/vec.h"
#include "../lane/kernels.h"

enum {
    GRID_STEP = 2,  /* px between samples that are closest */
    GRID_SIDE = LMB_TILE / GRID_STEP, /* of a tile, samples */
    GRID_SAMPLES = GRID_SIDE * GRID_SIDE,
    GRID_LEVELS = 3 /* steps of 8, 4 and 2 px */
};

/* Sample k of a tile is at column k % 4 * 2 and row k / 4 * 2. */
typedef struct live_grid_tile {
    uint16_t shown, known; /* samples with a surface; those that are lit */
    uint8_t divided;       /* is the cell of 8 px? */
    uint8_t parts;         /* which of its cells of 4 px are, a bit each */
    uint8_t flat;          /* all its pixels show one triangle, by one normal */
    uint8_t lobes;         /* gathered whole: it has no samples */
} live_grid_tile;

typedef struct live_grid {
    live_grid_tile *tile;
    lmb_live_sample *first, *other; /* of each tile sample 0, and samples 1 .. 15: most tiles have only the first */
    int32_t width, height, columns, rows; /* px; tiles */
    float mean;  /* light of the first samples, R + G + B, W/m2 */
    float split; /* a cell is divided where (surplus / 3)^2 x its area is over split x mean^2 */
    float noise; /* of a share, where it is 1/2: one by the root of the segments */
} live_grid;

/* The grid of a lattice. `strata`: segments of a sample. */
live_grid lmb_live_grid_of(const lmb_lattice *l, int32_t strata);

/* Keep which samples of a tile have a surface. `lobes`: it is gathered whole. */
void lmb_live_grid_put(const live_grid *g, const lmb_tile *tile, int lobes);

/* The pixel of a tile at which sample k lies. */
static inline int grid_pixel(int k) { return k / GRID_SIDE * GRID_STEP * LMB_TILE + k % GRID_SIDE * GRID_STEP; }

/* The samples of a tile that level 0 .. GRID_LEVELS - 1 asks for and that are not known, a bit each. */
uint32_t lmb_live_grid_asks(const live_grid *g, int32_t column, int32_t row, int32_t level);

/* The mean light of the samples of level 0. */
float lmb_live_grid_mean(const live_grid *g);

/* Divide the cells of level 0 or 1, in two rows of tiles from an even one on, that predict their samples badly. */
void lmb_live_grid_divide(const live_grid *g, int32_t row, int32_t level);

/* Take noise out of the shares of a tile's samples: their light follows. Then set their slopes. */
void lmb_live_grid_smooth(const live_grid *g, int32_t column, int32_t row);
void lmb_live_grid_slopes(const live_grid *g, int32_t column, int32_t row);

/* Light a tile's pixels between the samples. Returns those that no sample explains, a bit each. */
uint64_t lmb_live_grid_fill(lmb_irradiance *out, const lmb_kernels *kernels, const live_grid *g, const lmb_tile *tile);

/* 0 .. 1: how far two places are on one surface. Over a smooth one, the height over the other's plane grows with the
 * angle between the normals. */
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
