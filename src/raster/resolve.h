/* resolve.h: what fill's masked path and the tiles of maps share of a triangle's attributes. Floor 3. */
#ifndef LMB_RASTER_RESOLVE_H
#define LMB_RASTER_RESOLVE_H

#include "../lane/kernels.h"
#include "triangle.h"

/* Opacity at the corners and where to look it up. */
typedef struct lmb_resolve_alpha {
    float corner[3];
    float cutoff; /* 0: opaque everywhere */
    int32_t texture;
} lmb_resolve_alpha;

/* The rays of the tile whose first pixel is (x, y); then, as often as needed, a triangle under them. */
void lmb_resolve_rays(lmb_resolve_job *job, const lmb_view *view, int32_t x, int32_t y);
void lmb_resolve_setup(lmb_resolve_job *job, lmb_resolve_alpha *alpha, const lmb_view *view, const lmb_triangle *t);

/* Barycentrics of the triangle's plane under tile pixel (x, y), not clamped: for derivatives and holes. */
void lmb_resolve_point(float *b1, float *b2, const lmb_resolve_job *job, float x, float y);

/* A value given at the corners. */
static inline float resolve_mix3(const float corner[3], float b1, float b2)
{
    return corner[0] + ((corner[1] - corner[0]) * b1 + (corner[2] - corner[0]) * b2);
}

/* Does the surface stand at pixel (x, y) of the tile, or is there a hole? */
int lmb_resolve_opaque(const lmb_resolve_job *job, const lmb_resolve_alpha *alpha, const lmb_scene *scene, float x,
                       float y);

/* The same at barycentrics (b1, b2) of a triangle. */
int lmb_triangle_opaque(const lmb_triangle *triangle, const lmb_scene *scene, float b1, float b2);

#endif
