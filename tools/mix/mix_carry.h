/* mix_carry.h: indirect light at a frame's pixels, kept for the next frame, which shows most of these places again. */
#ifndef MIX_CARRY_H
#define MIX_CARRY_H

#include "mix_cones.h"

/* mix_carry_take: takes memory for a frame of a sequence. Call it before you use the others. Returns 1, or 0 with `r`
 * set. */
int mix_carry_take(mix_job *j, report *r);

/* mix_carry_get: reads the light of a real tile's pixels without and with the object from the previous frame,
 * interpolated between pixels, and the direct light if known. Returns a mask of the pixels found. Every 24th frame a
 * tile is due and traced again (mix_carry_knows), so that carried light follows the voxels and does not blur.
 * mix_carry_put stores a tile for the next frame; call mix_carry_put_direct after it for the direct light. */
uint64_t mix_carry_get(lmb_irradiance *without, lmb_irradiance *with, mix_direct *direct, const mix_job *j,
                       const lmb_tile *real);
void mix_carry_put(const mix_job *j, const lmb_tile *real, const lmb_irradiance *without, const lmb_irradiance *with);
void mix_carry_put_direct(const mix_job *j, const lmb_tile *real, const mix_direct *direct);

/* mix_carry_spread: `wanted` pixels next to a `carried` one on the same surface take its light, because sensor noise
 * can hide a place from one frame to the next. Returns a mask of the pixels set. */
uint64_t mix_carry_spread(lmb_irradiance *without, lmb_irradiance *with, const lmb_tile *real, uint64_t carried,
                          uint64_t wanted);

/* mix_carry_knows: can the tile at photo pixel x, y reuse the previous frame, that is, is it not due to be traced
 * again? mix_carry_see: the pixel where `last` shows a place of its scene; returns 0 if there is none. */
int mix_carry_knows(const mix_job *j, int32_t x, int32_t y);
int mix_carry_see(float *x, float *y, const mix_job *last, lmb_vec3 at);

/* mix_carry_turn: a counter that grows by one each time a tile is due. The job must be one of a sequence. */
int mix_carry_turn(const mix_job *j, int32_t x, int32_t y);

#endif
