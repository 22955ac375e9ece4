/* mix_cones.h: indirect light by cone tracing, at some pixels of a row of tiles. */
#ifndef MIX_CONES_H
#define MIX_CONES_H

#include "mix_job.h"

enum { MIX_BATCH = 16 };

/* Light of given lights and of a guessed sun on a tile without the object, and a mask of the pixels that have it. */
typedef struct mix_direct {
    lmb_irradiance light;
    uint64_t known;
} mix_direct;

/* A row of tiles of real surfaces, and the indirect light on their pixels without [0] and with [1] the object. */
typedef struct mix_batch {
    lmb_tile real[MIX_BATCH];
    lmb_irradiance light[2][MIX_BATCH];
    mix_direct direct[MIX_BATCH]; /* known from the previous frame */
    int32_t count;
    lmb_tile together;             /* pixels of several tiles */
    int32_t from[LMB_TILE_PIXELS]; /* tile x 64 + pixel */
    int32_t gathered;
} mix_batch;

/* mix_cones_batch: computes the light of count tiles. It traces every fourth pixel each way and those that cannot be
 * interpolated. If the object changes nothing at a pixel, both results are bit-identical. */
void mix_cones_batch(mix_batch *b, const mix_job *j);

/* mix_put_place: copies pixel k of a tile to pixel n of another, with the attributes that cones need. */
void mix_put_place(lmb_tile *to, int n, const lmb_tile *from, int k);

/* mix_cones_tile: adds the light with the object to all pixels of one tile. */
void mix_cones_tile(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile);

#endif
