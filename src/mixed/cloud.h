/* cloud.h: a pixel of a cloud, and the nearest ones. Layer 6. */
#ifndef LMB_MIXED_CLOUD_H
#define LMB_MIXED_CLOUD_H

#include <lambent/mixed.h>

/* Is (x, y) in the picture, with a measured depth? */
static inline int is_measured(const lmb_cloud *cloud, int32_t x, int32_t y)
{
    return cloud != NULL && cloud->inverse != NULL && x >= 0 && y >= 0 && x < cloud->camera.width &&
           y < cloud->camera.height && cloud->inverse[(size_t)y * (size_t)cloud->camera.width + (size_t)x] > 0.0f;
}

enum { NEAREST_CAP = 8 };

/* Finds pixels (y x width + x) of the k points nearest in space to that of (x, y), nearest first, out of the 5 x 5
 * around. k is at most NEAREST_CAP. Returns the number found.                                                 [M3] */
int32_t lmb_cloud_nearest(int32_t *out, int32_t k, const lmb_cloud *cloud, int32_t x, int32_t y);

#endif
