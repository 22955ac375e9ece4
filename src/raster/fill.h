/* fill.h: a set-up triangle with holes into the tiles of a window. Layer 3. */
#ifndef LMB_RASTER_FILL_H
#define LMB_RASTER_FILL_H

#include "../lane/kernels.h"
#include "cluster.h"
#include "setup.h"

/* The same for all triangles of a draw. */
typedef struct lmb_fill_context {
    const lmb_target *target;
    const lmb_kernels *kernels;
    const lmb_view *view;
    const lmb_scene *scene;
    lmb_fill_window window;
#if LMB_TREES
    int32_t is_ahead; /* 1: draw_ahead draws; only large triangles, slightly farther away, without ids */
#endif
#if LMB_CULLING
    const lmb_culling *culling; /* or NULL */
    lmb_cluster_place place;
#endif
} lmb_fill_context;

static inline void fill_batch(const lmb_fill_context *c, const lmb_batch *batch, uint32_t bits)
{
#if LMB_CULLING
    if (c->window.bounds != LMB_BOUNDS_IDLE) {
        c->kernels->culled_small(&c->window, batch, bits);
        return;
    }
#endif
    c->kernels->fill_small(&c->window, batch, bits);
}

static inline void fill_one(const lmb_fill_context *c, const lmb_setup *setup, uint32_t id)
{
#if LMB_CULLING
    if (c->window.farthest != NULL) {
        c->kernels->culled_large(&c->window, setup, id);
        return;
    }
#endif
    c->kernels->fill_large(&c->window, setup, id);
}

/* Fills a triangle with holes in its material: every pixel that passes the depth test also tests alpha. blends: with
 * the sample's threshold instead of the material's. */
void lmb_fill_masked(const lmb_fill_context *context, const lmb_setup *setup, uint32_t id, int blends);

#endif
