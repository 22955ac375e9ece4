/* glossy.h: one pixel's glossy lobe. Layer 4. */
#ifndef LMB_DIRECT_GLOSSY_H
#define LMB_DIRECT_GLOSSY_H

#include <lambent/light.h>

#include "../base/vec.h"

/* Share of uniform light that the lobe of pixel k reflects in channel c, and that diffuse light therefore loses: F0 +
 * (1 - F0) (1 - alpha)^3 (1 - n.v)^5. This is Schlick's F flattened by roughness, fitted to the lobe with F0 = 0.04. It
 * is at most 0.01 too low, between smooth and rough, and 0.13 too high, at grazing angles. */
static inline float glossy_share(const lmb_glossy *glossy, int c, int k)
{
    const float low = maxf(1.0f - glossy->facing[k], 0.0f), low2 = low * low;
    const float smooth = maxf(1.0f - sqrtf(glossy->alpha2[k]), 0.0f), f0 = glossy->specular[c][k];
    return minf(f0 + (1.0f - f0) * (low2 * low2 * low * (smooth * smooth * smooth)), 1.0f);
}

/* For a pixel k with a lobe: adds the reflection of light (W/m2) from direction `to`, of any length, that covers
 * `angle` sr. */
void lmb_glossy_add(lmb_glossy *inout, const lmb_tile *tile, int k, lmb_vec3 to, float angle, lmb_vec3 light);

/* The same per W/m2: the maximum of the channels, 1/sr. */
float lmb_glossy_factor(const lmb_glossy *glossy, const lmb_tile *tile, int k, lmb_vec3 to, float angle);

#endif
