/* binned.h: depth and ids of a window, drawn by several threads: first bins of the scene's triangles, then rows of the
 * window. The result has the same bytes as lmb_draw. */
#ifndef BINNED_H
#define BINNED_H

#include <lambent/bins.h>

#include "../../platform/host/pool.h"

typedef struct binned_draw {
    const lmb_target *target; /* cleared before the draw */
    const lmb_kernels *kernels;
    const lmb_view *view;
    const lmb_scene *scene;
    uint32_t first_id, count, flags;
    int threads;
} binned_draw;

/* State kept between draws. Zero it first. */
typedef struct binned {
#if LMB_CULLING
    lmb_bins bins[POOL_MAX];
#endif
    void *memory; /* for all bins */
    size_t bytes;
} binned;

/* binned_run: returns the status of lmb_draw. If memory for bins is short, each row sets up all triangles. */
lmb_status binned_run(binned *b, const binned_draw *draw);

void binned_free(binned *b);

#endif
