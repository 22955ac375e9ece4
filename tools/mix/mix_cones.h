/* mix_cones.h: light from around, by cones from some pixels of tiles side by side. */
#ifndef MIX_CONES_H
#define MIX_CONES_H

#include "mix_job.h"

enum { MIX_BATCH = 16 };

/* What told lights and a guessed sun give a tile without the object, of those pixels that know it, a bit each. */
typedef struct mix_direct {
    lmb_irradiance light;
    uint64_t known;
} mix_direct;

/* Tiles of real surfaces in a row, and the light that reaches their pixels without [0] and with [1] the object. */
typedef struct mix_batch {
    lmb_tile real[MIX_BATCH];
    lmb_irradiance light[2][MIX_BATCH];
    mix_direct direct[MIX_BATCH]; /* that the frame before knows */
    int32_t count;
    lmb_tile together;             /* pixels of several tiles */
    int32_t from[LMB_TILE_PIXELS]; /* tile x 64 + pixel */
    int32_t gathered;
} mix_batch;

/* mix_cones_batch: set the light of count tiles. Every fourth pixel each way is traced, and what those do not explain:
 * where nothing differs without and with the object, both are the same numbers. */
void mix_cones_batch(mix_batch *b, const mix_job *j);

/* mix_put_place: pixel k of a tile as pixel n of another, for cones ask for no more. */
void mix_put_place(lmb_tile *to, int n, const lmb_tile *from, int k);

/* mix_cones_tile: add the light with the object to all pixels of one tile. */
void mix_cones_tile(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile);

#endif
