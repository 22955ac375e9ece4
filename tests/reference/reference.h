/* reference.h: slow, simple rasterizers for checking the fast one: one triangle and one pixel at a time.
 *
 * There are two. The *snapped* one decides coverage with exact integers on the fast rasterizer's own snapped corners,
 * and keeps depth in binary64. To get the same corners, it repeats these binary32 operations in the same order:
 * metres from the eye along the view's axes, scaling to half width 1, choosing the planes that clip a corner and
 * intersecting with them, 1 / w, and rounding to 24.8. Depth uses only the metres along the axis from these; near /
 * w, clipped values and the plane are in binary64. The *exact* one shares nothing: binary64 from the mesh's
 * coordinates on, no 24.8, no guard band.
 *
 * Instance transforms are ignored. */
#ifndef REFERENCE_H
#define REFERENCE_H

#include <lambent/lambent.h>

/* A pixel with its centre inside a triangle. */
typedef struct ref_pixel {
    int32_t x, y;
    double d;
    float low, high; /* range of the three corner depths of the drawn piece, in the fast rasterizer's
                      * arithmetic: range of the clamp */
    double slope;    /* of the plane through these depths: |dx| + |dy|, per px */
} ref_pixel;

typedef void ref_put(void *user, const ref_pixel *pixel);

/* Calls put once, in row order, for every pixel of the frame that the triangle covers with depth above 0.
 * `cull`: skip back faces. */
void ref_draw_snapped(const lmb_view *view, const float corner[3][3], int cull, ref_put *put, void *user);
void ref_draw_exact(const lmb_view *view, const float corner[3][3], int cull, ref_put *put, void *user);

#endif
