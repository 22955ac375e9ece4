/* lattice.h: the lattice of gathered pixels that grows finer where light does: what src/frame does with it. Layer 9. */
#ifndef LMB_COMPOSE_LATTICE_H
#define LMB_COMPOSE_LATTICE_H

#include <lambent/compose.h>

enum {
    LATTICE_STEP = 8,   /* px between the first samples: so a window's are a pack. By 16, packs took as long */
    LATTICE_LEVELS = 4, /* steps of 8, 4, 2 and 1 px */
    LATTICE_WINDOW = 8  /* tiles a side of what is packed, searched and filled at once: by 16 a scene of many parts
                           takes twice as long, by 4 the Cornell box */
};

static inline int32_t lattice_columns(const lmb_lattice *l) { return (l->width + LMB_TILE - 1) / LMB_TILE; }
static inline int32_t lattice_rows(const lmb_lattice *l) { return (l->height + LMB_TILE - 1) / LMB_TILE; }
/* By column and row of the frame's tiles. */
static inline lmb_lattice_tile *lattice_tile(const lmb_lattice *l, int32_t column, int32_t row)
{
    return l->tile + (size_t)row * (size_t)lattice_columns(l) + (size_t)column;
}

/* Take a tile's surfaces over, and ask for the first samples on them. One with `lobes` is left out: it is gathered
 * whole. */
void lmb_lattice_put(const lmb_lattice *l, const lmb_tile *tile, int lobes);

/* Divide the cells of a level, 0 .. LATTICE_LEVELS - 2, whose corners the level above predicted badly, and ask for the
 * samples in between. l->mean and l->split are set. */
void lmb_lattice_divide(const lmb_lattice *l, int32_t level);

/* The mean light of all samples, R + G + B. */
float lmb_lattice_mean(const lmb_lattice *l);

/* Ask for some of the pixels in a window that no sample explains, so that each has one near by. */
void lmb_lattice_rest(const lmb_lattice *l, int32_t window);

/* When those were gathered: ask for more where light changes. */
void lmb_lattice_closer(const lmb_lattice *l, int32_t window);

/* Light the pixels of a window that no corner explains, when those were gathered. */
void lmb_lattice_late(const lmb_lattice *l, int32_t window);

/* Light the pixels of a window between the samples; ask for those that no corner explains. */
void lmb_lattice_fill(const lmb_lattice *l, int32_t window);

/* Windows of the frame; tiles of one: columns and rows first .. past - 1. */
int32_t lmb_lattice_windows(const lmb_lattice *l);
void lmb_lattice_window(int32_t column[2], int32_t row[2], const lmb_lattice *l, int32_t window);

/* 1 where two pixels may share light: on one surface. */
int lmb_lattice_alike(const lmb_lattice_tile *a, int i, const lmb_lattice_tile *b, int k);

#endif
