/* pixel_cluster.h: the pixels of one surface in a tile, which take a cut of the light tree together. Layer 6. */
#ifndef LMB_TREE_PIXEL_CLUSTER_H
#define LMB_TREE_PIXEL_CLUSTER_H

#include "../lane/kernels.h"

void lmb_pixel_cluster_of(lmb_pixel_cluster *out, const lmb_tile *tile, uint64_t pixels);

/* Extent of the pixel cluster's box along a direction from the centre, m. */
float lmb_pixel_cluster_reach(const lmb_pixel_cluster *p, lmb_vec3 along);

/* Squared distance of a point from the pixel cluster's box, m2. */
float lmb_pixel_cluster_distance2(const lmb_pixel_cluster *p, lmb_vec3 at);

#endif
