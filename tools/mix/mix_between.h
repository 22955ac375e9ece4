/* mix_between.h: light of a tile's pixels between those that were traced. */
#ifndef MIX_BETWEEN_H
#define MIX_BETWEEN_H

#include <lambent/light.h>

/* mix_between_pixels: the pixels of a tile to trace, a bit each: its four corners, and pixels with too few of the
 * corners on their surface. A tile uses only its own pixels, and the corners reach to its edges, so there are no seams.
 *
 * mix_between_fill: sets the other pixels to the mean of the corners, weighted by distance and by how well a corner
 * fits the pixel's surface. Equal corners give exactly their value. `known`: the pixels that were traced. Returns the
 * pixels, a bit each, with corners that differ by more than 40 %: these are not set; trace them. */
uint64_t mix_between_pixels(const lmb_tile *tile);
uint64_t mix_between_fill(lmb_irradiance *inout, const lmb_tile *tile, uint64_t known);

#endif
