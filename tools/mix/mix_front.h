/* mix_front.h: what real things are in front of the object: measured depth whose edges follow the photo's colours. */
#ifndef MIX_FRONT_H
#define MIX_FRONT_H

#include <lambent/mixed.h>

/* mix_front_refine: depth for occlusion, as 1 / distance by pixel, 0 where nothing is known.
 *
 *   out    width x height of the cloud, moved onto its planes
 *   doubt  as many: scratch; 1 where an edge is near
 *   rgb    the photo, linear
 *   box    x0, y0, x1, y1, px, the last ones behind it: what is asked for; the rest is as it was measured
 * Sensors leave the edge of a near thing ragged, or unmeasured. Where a pixel's neighbourhood has a near and a far
 * surface, it takes that whose pixels are more like it in colour and nearer to it. Elsewhere depth stays as it was
 * measured. Cost: 225 pixels for each near an edge. */
void mix_front_refine(float *out, uint8_t *doubt, const lmb_cloud *cloud, const lmb_planes *planes, const float *rgb,
                      const int32_t box[4]);

/* mix_front_tile: `real` as it stands before one sample of the object: at each of its pixels the surface that most of
 * the place between four pixels' centres says, hiding the object or not, so that edges are as fine as the samples.
 *
 *   x, y   of the sample, from the pixel's middle to the right and down, px */
void mix_front_tile(lmb_tile *out, const lmb_tile *real, const lmb_tile *object, const float *front,
                    const lmb_cloud *cloud, float x, float y);

#endif
