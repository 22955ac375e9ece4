/* reference.h: a slow rasterizer to measure the fast one with: one triangle, one pixel at a time, nothing clever.
 *
 * Two of them. The *snapped* one decides coverage with exact integers on the fast one's own snapped corners, and keeps
 * depth in binary64. So that the corners are the same, it takes these binary32 operations in the fast one's order, and
 * no others: metres from the eye along the view's axes, their scaling to half width 1, which planes cut a corner off
 * and where they cut, 1 / w, and the rounding to 24.8. Depth shares only the metres along the axis: near / w, its value
 * at a cut and its plane are binary64 of their own. The *exact* one shares nothing: binary64 from the mesh's
 * coordinates on, no 24.8, no guard band.
 *
 * Instances stand where their mesh does (no transform). */
#ifndef REFERENCE_H
#define REFERENCE_H

#include <lambent/lambent.h>

/* A pixel's centre inside a triangle. */
typedef struct ref_pixel {
    int32_t x, y;
    double d;
    float low, high; /* the drawn piece's three corner depths, by the fast one's arithmetic: range of its clamp */
    double slope;    /* of the plane through these: |dx| + |dy|, per px */
} ref_pixel;

typedef void ref_put(void *user, const ref_pixel *pixel);

/* Every pixel of the frame that the triangle covers and whose depth is above 0, once, by rows. `cull`: not those of
 * back faces. */
void ref_draw_snapped(const lmb_view *view, const float corner[3][3], int cull, ref_put *put, void *user);
void ref_draw_exact(const lmb_view *view, const float corner[3][3], int cull, ref_put *put, void *user);

#endif
