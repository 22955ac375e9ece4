/* plane.h: the plane of one triangle, and the intersection with a tile's rays. Layer 3. */
#ifndef LMB_RASTER_PLANE_H
#define LMB_RASTER_PLANE_H

#include "../lane/kernels.h"

/* The values of one slot of lmb_resolve_batch that define where rays meet a triangle. */
typedef struct lmb_plane {
    lmb_vec3 corner, plane, face, g1, g2;
    float w_min, w_max;
} lmb_plane;

/* The rays of the tile with the first pixel (x, y). */
void lmb_resolve_rays(lmb_rays *out, const lmb_view *view, int32_t x, int32_t y);

/* The plane of one triangle, corners in the world. Reads only eye, back, near_m and perspective of the rays. */
void lmb_resolve_plane(lmb_plane *out, const lmb_vec3 corner[3], const lmb_rays *rays);

/* Barycentrics of the triangle's plane at tile pixel (x, y), not clamped: for derivatives and holes. */
void lmb_resolve_point(float *b1, float *b2, const lmb_plane *plane, const lmb_rays *rays, float x, float y);

#endif
