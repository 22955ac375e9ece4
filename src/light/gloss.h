/* gloss.h: the lobe of one pixel. Floor 5. */
#ifndef LMB_LIGHT_GLOSS_H
#define LMB_LIGHT_GLOSS_H

#include <lambent/light.h>

#include "../base/vec.h"

/* Of light from everywhere pixel k reflects this much by its lobe, of channel c, and so its diffuse light lacks it:
 * F0 + (1 - F0) (1 - alpha)^3 (1 - n.v)^5, Schlick's F flattened by roughness, fitted to the lobe of F0 = 0.04: that is
 * 0.01 too little at most, between smooth and rough, and 0.13 too much, where it grazes. */
static inline float gloss_share(const lmb_gloss *gloss, int c, int k)
{
    const float low = maxf(1.0f - gloss->facing[k], 0.0f), low2 = low * low;
    const float smooth = maxf(1.0f - sqrtf(gloss->alpha2[k]), 0.0f), f0 = gloss->specular[c][k];
    return minf(f0 + (1.0f - f0) * (low2 * low2 * low * (smooth * smooth * smooth)), 1.0f);
}

/* Pixel k has a lobe: add what it makes of light (W/m2) that comes from direction `to`, of any length, and takes
 * `angle` sr. */
void lmb_gloss_add(lmb_gloss *inout, const lmb_tile *tile, int k, lmb_vec3 to, float angle, lmb_vec3 light);

/* And a W/m2: the most of its channels, 1/sr. */
float lmb_gloss_factor(const lmb_gloss *gloss, const lmb_tile *tile, int k, lmb_vec3 to, float angle);

#endif
