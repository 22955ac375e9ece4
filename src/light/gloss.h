/* gloss.h: the lobe of one pixel. Floor 5. */
#ifndef LMB_LIGHT_GLOSS_H
#define LMB_LIGHT_GLOSS_H

#include <lambent/light.h>

/* Pixel k has a lobe: add what it makes of light (W/m2) that comes from direction `to`, of any length, and takes
 * `angle` sr. */
void lmb_gloss_add(lmb_gloss *inout, const lmb_tile *tile, int k, lmb_vec3 to, float angle, lmb_vec3 light);

/* And a W/m2: the most of its channels, 1/sr. */
float lmb_gloss_factor(const lmb_gloss *gloss, const lmb_tile *tile, int k, lmb_vec3 to, float angle);

#endif
