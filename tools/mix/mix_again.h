/* mix_again.h: what a frame has found of its pixels, kept for another photo of the same places. */
#ifndef MIX_AGAIN_H
#define MIX_AGAIN_H

#include "mix_job.h"

/* The object over the photo. What nothing covers stays the photo's, bit for bit. */
static inline float mix_over(float photo, float object, float covered)
{
    return covered > 0.0f ? object + (1.0f - covered) * photo : photo;
}

/* mix_again_take: memory for the answers of a sequence's frame; none where another photo has others: a varnish mirrors
 * light that each frame has of its own, and differences are for measuring. 1, or 0 with `r` set. */
int mix_again_take(mix_job *j, report *r);

/* mix_again_keep: a tile's, where there is memory: light without and with the object; the object and what it covers. */
void mix_again_keep(mix_job *j, const lmb_tile *real, const lmb_irradiance *without, const lmb_irradiance *with,
                    const lmb_radiance *object, const float *covered);

/* mix_again_light, mix_again_object: of a camera that stands still, the pixels of a tile that measure
 * what they did keep the last frame's light, and its object. Returns whether those are all of the tile's. */
int mix_again_light(lmb_irradiance *without, lmb_irradiance *with, const mix_job *j, const lmb_tile *real);
void mix_again_object(lmb_radiance *object, float *covered, const mix_job *j, const lmb_tile *real);

/* mix_again_draw: the picture of another photo by these. */
void mix_again_draw(mix_job *j);

#endif
