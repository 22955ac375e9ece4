/* texture.h: samples an image at a point. Layer 3. */
#ifndef LMB_RASTER_TEXTURE_H
#define LMB_RASTER_TEXTURE_H

#include <lambent/lookup.h>

#include "../base/vec.h"

/* Alpha of level 0: the bytes of lmb_texture_sample, without the colours. */
float lmb_texture_alpha(const lmb_texture *t, float u, float v);

/* Results of lmb_texture_coverage. */
enum { LMB_COVERS_NONE = 1, LMB_COVERS_ALL = 2 };

/* LMB_COVERS_NONE if every sample of level 0 from low to high, (u, v) each, has less alpha than `hole`, LMB_COVERS_ALL
 * if every sample has more than `solid`, otherwise 0. 0 also if the answer needs more than *texels texels. *texels is
 * reduced by the texels that were read. */
int lmb_texture_coverage(const lmb_texture *t, const float low[2], const float high[2], float hole, float solid,
                         uint32_t *texels);

/* Metalness and roughness from a metal_map's texel, which lmb_normal_map_sample reads as -1 .. 1. */
static inline float metallic_of(const lmb_material *m, const float code[4])
{
    return minf(m->metallic * maxf(0.5f + 0.5f * code[2], 0.0f), 1.0f);
}
static inline float roughness_of(const lmb_material *m, const float code[4])
{
    return minf(m->roughness * maxf(0.5f + 0.5f * code[1], 0.0f), 1.0f);
}

#endif
