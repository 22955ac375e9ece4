/* glossy.h: one pixel's glossy lobe. Layer 5. */
#ifndef LMB_LIGHT_GLOSSY_H
#define LMB_LIGHT_GLOSSY_H

#include <lambent/light.h>

#include "../base/vec.h"

/* Of light from everywhere pixel k reflects this much by its lobe, of channel c, and so its diffuse light lacks it:
 * F0 + (1 - F0) (1 - alpha)^3 (1 - n.v)^5, Schlick's F flattened by roughness, fitted to the lobe of F0 = 0.04: that is
 * 0.01 too little at most, between smooth and rough, and 0.13 too much, where it grazes. */
static inline float glossy_share(const lmb_glossy *glossy, int c, int k)
{
    const float low = maxf(1.0f - glossy->facing[k], 0.0f), low2 = low * low;
    const float smooth = maxf(1.0f - sqrtf(glossy->alpha2[k]), 0.0f), f0 = glossy->specular[c][k];
    return minf(f0 + (1.0f - f0) * (low2 * low2 * low * (smooth * smooth * smooth)), 1.0f);
}

/* Pixel k has a lobe: add what it makes of light (W/m2) that comes from direction `to`, of any length, and takes
 * `angle` sr. */
void lmb_glossy_add(lmb_glossy *inout, const lmb_tile *tile, int k, lmb_vec3 to, float angle, lmb_vec3 light);

/* And a W/m2: the most of its channels, 1/sr. */
float lmb_glossy_factor(const lmb_glossy *glossy, const lmb_tile *tile, int k, lmb_vec3 to, float angle);

#endif
