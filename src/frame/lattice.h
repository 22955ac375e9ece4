/* lattice.h: an adaptive lattice of gathered pixels. Layer 8. */
#ifndef LMB_FRAME_LATTICE_H
#define LMB_FRAME_LATTICE_H

#include <lambent/compose.h>

enum {
    LATTICE_STEP = 8,   /* px between the first samples, which fill one pack per window. 16 made packs no faster */
    LATTICE_LEVELS = 4, /* steps of 8, 4, 2 and 1 px */
    LATTICE_WINDOW = 8  /* side in tiles of the unit that is packed, searched and filled at once. 16 doubles the time of
                         * a scene of many parts, 4 that of the Cornell box */
};

static inline int32_t lattice_columns(const lmb_lattice *l) { return (l->width + LMB_TILE - 1) / LMB_TILE; }
static inline int32_t lattice_rows(const lmb_lattice *l) { return (l->height + LMB_TILE - 1) / LMB_TILE; }
/* The tile at a column and row of the frame's tiles. */
static inline lmb_lattice_tile *lattice_tile(const lmb_lattice *l, int32_t column, int32_t row)
{
    return l->tile + (size_t)row * (size_t)lattice_columns(l) + (size_t)column;
}

/* lmb_lattice_put: stores a tile's surfaces and requests the first samples on them. If you pass `lobes`, the tile gets
 * no samples: it is gathered whole. */
void lmb_lattice_put(const lmb_lattice *l, const lmb_tile *tile, int lobes);

/* Divides the cells of a level, 0 .. LATTICE_LEVELS - 2, with corners that the level above predicted badly, and
 * requests the samples in between. Set l->mean and l->split before you call it. */
void lmb_lattice_divide(const lmb_lattice *l, int32_t level);

/* Mean light of all samples, R + G + B. */
float lmb_lattice_mean(const lmb_lattice *l);

/* Requests pixels in a window that no sample explains, so that each of them has one nearby. */
void lmb_lattice_rest(const lmb_lattice *l, int32_t window);

/* Requests more of these pixels if the light varies. Call this after you gathered the first ones. */
void lmb_lattice_closer(const lmb_lattice *l, int32_t window);

/* Lights the pixels of a window that no corner explains. Call this after you gathered all of these. */
void lmb_lattice_late(const lmb_lattice *l, int32_t window);

/* Lights the pixels of a window between the samples, and requests those that no corner explains. */
void lmb_lattice_fill(const lmb_lattice *l, int32_t window);

/* Number of windows of the frame; the tiles of a window: columns and rows first .. past - 1. */
int32_t lmb_lattice_windows(const lmb_lattice *l);
void lmb_lattice_window(int32_t column[2], int32_t row[2], const lmb_lattice *l, int32_t window);

/* Returns 1 if two pixels lie on one surface and may share light. */
int lmb_lattice_alike(const lmb_lattice_tile *a, int i, const lmb_lattice_tile *b, int k);

#endif
