/* texture.h: an image at a point. Floor 3. */
#ifndef LMB_RASTER_TEXTURE_H
#define LMB_RASTER_TEXTURE_H

#include <lambent/scene.h>

/* Linear R G B and alpha at (u, v), lod in levels (0: base; trilinear only). A non-finite coordinate reads (0, 0). */
void lmb_texture_sample(float out[4], const lmb_texture *t, float u, float v, float lod);

/* The same of a normal map: x y z, each -1 .. 1, not of unit length; out[3] means nothing. */
void lmb_normal_map_sample(float out[4], const lmb_texture *t, float u, float v, float lod);

#endif
