/* plane.h: the plane of one triangle, and the intersection with a tile's rays. Layer 3. */
#ifndef LMB_RASTER_PLANE_H
#define LMB_RASTER_PLANE_H

#include "../base/vec.h"
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
static inline void plane_point(float *b1, float *b2, const lmb_plane *p, const lmb_rays *rays, float x, float y)
{
    const lmb_vec3 origin = add3(rays->origin, add3(mul3(rays->ox, x), mul3(rays->oy, y)));
    const lmb_vec3 ray = add3(rays->direction, add3(mul3(rays->rx, x), mul3(rays->ry, y)));
    const float slope = dot3(p->plane, ray);
    const float w = dot3(p->plane, sub3(p->corner, origin)) / (slope * slope < 1e-36f ? 1e-18f : slope);
    const lmb_vec3 q = sub3(add3(origin, mul3(ray, clampf(w, p->w_min, p->w_max))), p->corner);
    *b1 = dot3(q, p->g1);
    *b2 = dot3(q, p->g2);
}

/* The same, not inlined. */
void lmb_resolve_point(float *b1, float *b2, const lmb_plane *plane, const lmb_rays *rays, float x, float y);

#endif
