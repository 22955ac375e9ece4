/* codec.h: 8-bit sRGB codes. (Octahedral normals are public: lambent/scene.h.) Layer 1. */
#ifndef LMB_BASE_CODEC_H
#define LMB_BASE_CODEC_H

#include <lambent/numbers.h>

#include "exact.h"

/* [c]: linear value 0 .. 1 of code c, the float nearest to the curve of IEC 61966-2-1. */
extern const float lmb_srgb_linear[256];
extern const float lmb_srgb_threshold[256]; /* [c]: the smallest float that is coded c or more; 0 for c = 0 */

static inline float lmb_srgb_decode(uint8_t code) { return lmb_srgb_linear[code]; }

#endif
