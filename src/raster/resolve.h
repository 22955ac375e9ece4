/* resolve.h: what fill's masked path, paint and the tiles of maps share of a triangle's attributes. Floor 3. */
#ifndef LMB_RASTER_RESOLVE_H
#define LMB_RASTER_RESOLVE_H

#include "../lane/kernels.h"
#include "triangle.h"

/* Where rays meet a triangle: lmb_resolve_batch's numbers of one slot. */
typedef struct lmb_plane {
    lmb_vec3 corner, plane, face, g1, g2;
    float w_min, w_max;
} lmb_plane;

/* A triangle's opacity and texture coordinates at the corners. */
typedef struct lmb_resolve_alpha {
    float corner[3], u[3], v[3];
    float cutoff; /* 0: opaque everywhere */
    int32_t texture;
} lmb_resolve_alpha;

/* The rays of the tile whose first pixel is (x, y). */
void lmb_resolve_rays(lmb_rays *out, const lmb_view *view, int32_t x, int32_t y);

/* The plane of one triangle, corners in the world; only the rays' eye, back, near_m and perspective are read. */
void lmb_resolve_plane(lmb_plane *out, const lmb_vec3 corner[3], const lmb_rays *rays);

/* Barycentrics of the triangle's plane under tile pixel (x, y), not clamped: for derivatives and holes. */
void lmb_resolve_point(float *b1, float *b2, const lmb_plane *plane, const lmb_rays *rays, float x, float y);

/* A value given at the corners. */
static inline float resolve_mix3(const float corner[3], float b1, float b2)
{
    return corner[0] + ((corner[1] - corner[0]) * b1 + (corner[2] - corner[0]) * b2);
}

void lmb_resolve_alpha_of(lmb_resolve_alpha *out, const lmb_triangle *triangle);

/* Does the surface stand at barycentrics (b1, b2), or is there a hole? They are clamped into the triangle. */
int lmb_resolve_opaque(const lmb_resolve_alpha *alpha, const lmb_scene *scene, float b1, float b2);

/* The same at barycentrics (b1, b2) of a triangle. */
int lmb_triangle_opaque(const lmb_triangle *triangle, const lmb_scene *scene, float b1, float b2);

#endif
