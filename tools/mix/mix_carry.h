/* mix_carry.h: light from around at a frame's pixels, kept for the next frame, which sees most of these places again. */
#ifndef MIX_CARRY_H
#define MIX_CARRY_H

#include "mix_cones.h"

/* mix_carry_take: memory for a frame of a sequence. 1, or 0 with `r` set. */
int mix_carry_take(mix_job *j, report *r);

/* mix_carry_get: light[0] and [1] of the pixels of a real tile that the frame before has seen, between its pixels, and of
 * those where it knows it the lights' own. Returns which those are. Every 24th frame a tile does not `know` (below): what
 * is carried is to follow the voxels, and not to blur. mix_carry_put: a tile's, for the next frame;
 * mix_carry_put_direct: after it, the lights' own. */
uint64_t mix_carry_get(lmb_irradiance *without, lmb_irradiance *with, mix_direct *direct, const mix_job *j,
                       const lmb_tile *real);
void mix_carry_put(const mix_job *j, const lmb_tile *real, const lmb_irradiance *without, const lmb_irradiance *with);
void mix_carry_put_direct(const mix_job *j, const lmb_tile *real, const mix_direct *direct);

/* mix_carry_spread: of pixels `wanted`, those that lie beside one of `carried` on its surface take that one's light, as a
 * sensor's noise hides a place from one frame to the next. Returns which do. */
uint64_t mix_carry_spread(lmb_irradiance *without, lmb_irradiance *with, const lmb_tile *real, uint64_t carried,
                          uint64_t wanted);

/* mix_carry_knows: is a tile, x and y as the photo has them, not due to be traced again? mix_carry_see: where `last`
 * saw a place of its scene, px; 0 where it did not. */
int mix_carry_knows(const mix_job *j, int32_t x, int32_t y);
int mix_carry_see(float *x, float *y, const mix_job *last, lmb_vec3 at);

/* mix_carry_turn: a number that grows by one each time a tile is due. The job is a sequence's. */
int mix_carry_turn(const mix_job *j, int32_t x, int32_t y);

#endif
