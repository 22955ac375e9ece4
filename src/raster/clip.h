/* clip.h: a triangle in clip space against the near plane and the guard band. Layer 3. */
#ifndef LMB_RASTER_CLIP_H
#define LMB_RASTER_CLIP_H

#include "../base/vec.h"

/* x, y, w as metres at half width 1; depth is z / w. */
typedef struct lmb_clip_vertex {
    float x, y, z, w;
    uint32_t code;
} lmb_clip_vertex;

/* Guard band in units of w: how far past the frame's edge coordinates still fit 24.8 (depends on the frame's size). */
typedef struct lmb_clip_guard {
    float x, y;
} lmb_clip_guard;

enum { CLIP_NEAR = 1, CLIP_LEFT = 2, CLIP_RIGHT = 4, CLIP_TOP = 8, CLIP_BOTTOM = 16, CLIP_ALL = 31, CLIP_DROP = 128 };
#define LMB_CLIP_MAX 8 /* corners of a triangle cut by five planes */

uint32_t lmb_clip_code(const lmb_clip_vertex *v, const lmb_clip_guard *guard);

/* Clips the triangle in polygon[0..2] by the planes in `planes`. Returns the number of corners, 0 or 3 ..
 * LMB_CLIP_MAX. */
int lmb_clip_polygon(lmb_clip_vertex polygon[LMB_CLIP_MAX], uint32_t planes, const lmb_clip_guard *guard);

#endif
