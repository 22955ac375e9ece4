/* cluster.h: does a window show any of a cluster? Layer 3. */
#ifndef LMB_RASTER_CLUSTER_H
#define LMB_RASTER_CLUSTER_H

#include "../lane/kernels.h"

#if LMB_CULLING
/* The place of a mesh's clusters. */
typedef struct lmb_cluster_place {
    const lmb_cluster *clusters; /* NULL: not searched yet */
    uint32_t mesh;
    uint32_t asked, asks; /* clusters with small triangles that read bounds: so far; still to come */
} lmb_cluster_place;

/* The clusters of a mesh; the search starts at the place found last. */
const lmb_cluster *lmb_cluster_find(lmb_cluster_place *place, const lmb_culling *culling, const lmb_scene *scene,
                                    uint32_t mesh);

/* A depth in the window's format. */
float lmb_depth_as_held(const lmb_fill_window *window, float d);

/* Shown or unknown; outside the window; hidden by drawn surfaces. */
enum { LMB_CLUSTER_SHOWN, LMB_CLUSTER_OUTSIDE, LMB_CLUSTER_HIDDEN };

/* Returns LMB_CLUSTER_OUTSIDE or LMB_CLUSTER_HIDDEN only if no triangle of the cluster can change a pixel of the
 * window. job: of the instance. */
int lmb_cluster_is_hidden(const lmb_cluster *cluster, const lmb_setup_job *job, const lmb_fill_window *window,
                          const lmb_kernels *kernels);
#endif

#endif
