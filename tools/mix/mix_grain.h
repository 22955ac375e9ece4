/* mix_grain.h: the noise of a photo, estimated from it, for an object in it. */
#ifndef MIX_GRAIN_H
#define MIX_GRAIN_H

#include <lambent/compose.h>

#include "../picture/image.h"

enum { MIX_GRAIN_STEPS = 8 };

/* Standard deviations of the square root of light, by brightness and channel. */
typedef struct mix_grain {
    float sigma[MIX_GRAIN_STEPS][3];
    uint32_t seed; /* from the photo's pixels, so the noise differs between photos of a sequence */
} mix_grain;

/* mix_grain_find: estimates the noise from differences of neighbours in squares of 2 x 2 pixels, by brightness. Robust:
 * the quieter half of the squares counts, so that edges and texture do not. */
int mix_grain_find(mix_grain *out, const image *photo);

/* mix_grain_add: adds noise to the covered share of pixels. A pixel of one photo always gets the same
 * noise. */
void mix_grain_add(lmb_radiance *inout, const mix_grain *g, const float covered[LMB_TILE_PIXELS], int32_t x, int32_t y);

#endif
