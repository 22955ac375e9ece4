/* fill.h: a set-up triangle into the tiles of a window. Floor 3. */
#ifndef LMB_RASTER_FILL_H
#define LMB_RASTER_FILL_H

#include "../lane/kernels.h"
#include "setup.h"

/* What stays the same over the triangles of a draw. */
typedef struct lmb_fill_context {
    const lmb_target *target;
    const lmb_kernels *kernels;
    const lmb_view *view;
    const lmb_scene *scene;
    float d16_scale, d16_bias;
} lmb_fill_context;

/* masked: the triangle's material has holes: every pixel that passes is asked for its alpha. */
void lmb_fill_triangle(const lmb_fill_context *context, const lmb_setup *setup, uint32_t id, int masked);

#endif
