/* binned.h: depth and ids of a window by several threads: bins of the scene's triangles, then rows of the window.
 *
 * The bytes are lmb_draw's. */
#ifndef BINNED_H
#define BINNED_H

#include <lambent/bins.h>

#include "../../platform/host/pool.h"

typedef struct binned_draw {
    const lmb_target *target; /* is cleared first */
    const lmb_kernels *kernels;
    const lmb_view *view;
    const lmb_scene *scene;
    uint32_t first_id, count, flags;
    int threads;
} binned_draw;

/* What stays from draw to draw. All 0 at first. */
typedef struct binned {
#if LMB_CULLING
    lmb_bins bins[POOL_MAX];
#endif
    void *memory; /* of all of them */
    size_t bytes;
} binned;

/* Returns what lmb_draw does. Where there is no memory for bins, each row sets up all triangles. */
lmb_status binned_run(binned *b, const binned_draw *draw);

void binned_free(binned *b);

#endif
