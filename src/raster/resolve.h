/* resolve.h: tests a triangle for holes, for masked filling, shadows and occlusion. Layer 3. */
#ifndef LMB_RASTER_RESOLVE_H
#define LMB_RASTER_RESOLVE_H

#include "plane.h"
#include "triangle.h"

/* A triangle's opacity and texture coordinates at the corners. */
typedef struct lmb_resolve_alpha {
    float corner[3], u[3], v[3];
    float cutoff; /* 0: opaque everywhere */
    int32_t texture;
} lmb_resolve_alpha;

/* Interpolates a value given at the corners. */
static inline float resolve_mix3(const float corner[3], float b1, float b2)
{
    return corner[0] + ((corner[1] - corner[0]) * b1 + (corner[2] - corner[0]) * b2);
}

void lmb_resolve_alpha_of(lmb_resolve_alpha *out, const lmb_triangle *triangle);

/* Alpha at barycentrics (b1, b2), which are clamped to the triangle. */
float lmb_resolve_alpha_at(const lmb_resolve_alpha *alpha, const lmb_scene *scene, float b1, float b2);

#if LMB_MULTISAMPLE
/* Alpha at pixel (x, y) of the tile with these rays, of the texture's level that colours use. */
float lmb_resolve_blend_alpha(const lmb_resolve_alpha *alpha, const lmb_scene *scene, const lmb_plane *plane,
                              const lmb_rays *rays, int32_t x, int32_t y);
#endif

/* 1 if the surface is opaque at barycentrics (b1, b2), which are clamped to the triangle; 0 in a hole. */
int lmb_resolve_opaque(const lmb_resolve_alpha *alpha, const lmb_scene *scene, float b1, float b2);

/* 1 if the whole triangle is a hole. 0 also if the answer needs more than *texels texels of the texture. *texels is
 * reduced by the texels that were read. */
int lmb_resolve_is_hole(const lmb_resolve_alpha *alpha, const lmb_scene *scene, uint32_t *texels);

/* Opacity between two barycentrics of an unclamped plane, for cutoffs from `cutoff_min` to `cutoff_max`:
 * LMB_COVERS_NONE if all of that part is a hole, LMB_COVERS_ALL if all is opaque, otherwise 0. *texels as above. */
int lmb_resolve_coverage(const lmb_resolve_alpha *alpha, const lmb_scene *scene, const float low[2],
                         const float high[2], float cutoff_min, float cutoff_max, uint32_t *texels);

/* As lmb_resolve_opaque, for a triangle. */
int lmb_triangle_opaque(const lmb_triangle *triangle, const lmb_scene *scene, float b1, float b2);

#endif
