/* mix_again.h: the result of a frame, kept per pixel and reused for another photo of the same scene. */
#ifndef MIX_AGAIN_H
#define MIX_AGAIN_H

#include "mix_job.h"

/* The object over the photo. Pixels that nothing covers keep the photo's value bit for bit. */
static inline float mix_over(float photo, float object, float covered)
{
    return covered > 0.0f ? object + (1.0f - covered) * photo : photo;
}

/* mix_again_take: takes memory for the results of a sequence's frame. Takes none if the results cannot be reused: a
 * varnish mirrors the light of each frame, and --show pictures are for measuring. Returns 1, or 0 with `r` set. */
int mix_again_take(mix_job *j, report *r);

/* mix_again_keep: stores the results of one tile if there is memory for them: light without and with the object, and
 * the object with coverage. */
void mix_again_keep(mix_job *j, const lmb_tile *real, const lmb_irradiance *without, const lmb_irradiance *with,
                    const lmb_radiance *object, const float *covered);

/* mix_again_light, mix_again_object: if the camera is static, pixels of a tile with unchanged depth keep the light and
 * the object of the last frame. mix_again_light returns whether all pixels of the tile do. */
int mix_again_light(lmb_irradiance *without, lmb_irradiance *with, const mix_job *j, const lmb_tile *real);
void mix_again_object(lmb_radiance *object, float *covered, const mix_job *j, const lmb_tile *real);

/* mix_again_draw: draws the picture of another photo from the stored results. */
void mix_again_draw(mix_job *j);

#endif
