/* fill.h: a set-up triangle with holes into the tiles of a window. Layer 3. */
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
    lmb_fill_window window;
} lmb_fill_context;

/* A triangle whose material has holes: every pixel that passes the depth test also tests its alpha. blends: by the
 * sample's threshold instead of the material's. */
void lmb_fill_masked(const lmb_fill_context *context, const lmb_setup *setup, uint32_t id, int blends);

#endif
