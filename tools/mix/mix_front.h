/* mix_front.h: what real things are in front of the object: measured depth whose edges follow the photo's colours. */
#ifndef MIX_FRONT_H
#define MIX_FRONT_H

#include <lambent/mixed.h>

/* How a pixel is reached from a surface. */
typedef struct mix_way {
    float cost, beyond;        /* beyond: 1/m, of a hole: what is farthest beside it; else 0 */
    int32_t from, is_doubtful; /* from: a pixel of the surface, or -1; is_doubtful: an edge is near, or a hole */
} mix_way;

/* mix_front_refine: depth for occlusion, as 1 / distance by pixel, 0 where nothing is known.
 *
 *   out    width x height of the cloud, moved onto its planes
 *   way    as many: scratch
 *   rgb    the photo, linear
 *   box    x0, y0, x1, y1, px, the last ones behind it: what is asked for; the rest is as it was measured
 * Sensors leave the edge of a near thing ragged, or unmeasured. A pixel near an edge takes the surface that is reached from
 * it over the smallest change of the photo's colour. Elsewhere depth stays as it was measured. Cost: 105 pixels for each near an
 * edge. */
void mix_front_refine(float *out, mix_way *way, const lmb_cloud *cloud, const lmb_planes *planes, const float *rgb,
                      const int32_t box[4]);

/* mix_front_tile: `real` as it stands before one sample of the object: at each of its pixels the surface that most of
 * the place between four pixels' centres says, hiding the object or not, so that edges are as fine as the samples.
 *
 *   x, y   of the sample, from the pixel's middle to the right and down, px */
void mix_front_tile(lmb_tile *out, const lmb_tile *real, const lmb_tile *object, const float *front,
                    const lmb_cloud *cloud, float x, float y);

#endif
