/* plane_fit.h: least squares of inverse distances over a picture, relative to one pixel. Layer 6. */
#ifndef LMB_MIXED_PLANE_FIT_H
#define LMB_MIXED_PLANE_FIT_H

#include "../base/vec.h"
#include <lambent/mixed.h>

/* Weighted sums. Rays are relative to (x0, y0) and inverses to q0, which you should choose near the points; otherwise
 * the squares of the common offset swamp the differences. */
typedef struct plane_fit {
    float x0, y0, q0;
    float w, x, y, xx, xy, yy, q, xq, yq;
} plane_fit;

static inline plane_fit plane_fit_at(float x0, float y0, float q0)
{
    const plane_fit f = {x0, y0, q0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    return f;
}

static inline void plane_fit_add(plane_fit *f, float ray_x, float ray_y, float inverse, float weight)
{
    const float x = ray_x - f->x0, y = ray_y - f->y0, q = inverse - f->q0, wx = weight * x, wy = weight * y;
    f->w += weight;
    f->x += wx;
    f->y += wy;
    f->xx += wx * x;
    f->xy += wx * y;
    f->yy += wy * y;
    f->q += weight * q;
    f->xq += wx * q;
    f->yq += wy * q;
}

/* lmb_plane_fit_join: adds the sums of two fits with the same origin. */
void lmb_plane_fit_join(plane_fit *into, const plane_fit *from);

/* lmb_plane_fit_solve: inverse = slope . (ray x, ray y, 1). Returns 0 if there are too few points, or all lie on a
 * line. */
int lmb_plane_fit_solve(float slope[3], const plane_fit *f);

/* The plane's inverse distance along a ray; 0 or negative if the ray misses the plane. */
static inline float plane_inverse(const float slope[3], float ray_x, float ray_y)
{
    return slope[0] * ray_x + slope[1] * ray_y + slope[2];
}

/* lmb_plane_normal: returns the unit normal, towards the camera; *distance: from the camera to the plane. */
lmb_vec3 lmb_plane_normal(float *distance, const float slope[3]);

#endif
