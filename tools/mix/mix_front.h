/* mix_front.h: real surfaces in front of the object: measured depth with edges aligned to the photo's colours. */
#ifndef MIX_FRONT_H
#define MIX_FRONT_H

#include <lambent/mixed.h>

/* How a pixel is reached from a surface. */
typedef struct mix_way {
    float cost, beyond;        /* beyond: 1/m, for a hole: the farthest surface next to it; else 0 */
    int32_t from, is_doubtful; /* from: a pixel of the surface, or -1; is_doubtful: an edge or a hole is near */
} mix_way;

/* mix_front_refine: depth for occlusion, as 1 / distance by pixel, 0 if unknown.
 *
 *   out    width x height of the cloud, moved onto its planes
 *   way    same size; scratch
 *   rgb    the photo, linear
 *   box    x0, y0, x1, y1, px, end exclusive: the part to refine; the rest stays as measured
 * Near edges of close objects, sensor depth is ragged or missing. A pixel near an edge takes the surface that is
 * reached over the smallest change of the photo's colour. Elsewhere depth stays as measured. Cost: 105 pixels for each
 * one near an edge. */
void mix_front_refine(float *out, mix_way *way, const lmb_cloud *cloud, const lmb_planes *planes, const float *rgb,
                      const int32_t box[4]);

/* mix_front_tile: the real surfaces at one sample of the object. For each pixel, the sample's four neighbours decide by
 * their bilinear weights whether a surface hides the object, so edges are as fine as the samples.
 *
 *   x, y   of the sample, from the pixel's middle to the right and down, px */
void mix_front_tile(lmb_tile *out, const lmb_tile *real, const lmb_tile *object, const float *front,
                    const lmb_cloud *cloud, float x, float y);

#endif
