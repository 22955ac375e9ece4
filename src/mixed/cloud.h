/* cloud.h: reads one pixel of a cloud. Layer 6. */
#ifndef LMB_MIXED_CLOUD_H
#define LMB_MIXED_CLOUD_H

#include <lambent/mixed.h>

/* Is (x, y) in the picture, and something measured there? */
static inline int is_measured(const lmb_cloud *cloud, int32_t x, int32_t y)
{
    return cloud != NULL && cloud->inverse != NULL && x >= 0 && y >= 0 && x < cloud->camera.width &&
           y < cloud->camera.height && cloud->inverse[(size_t)y * (size_t)cloud->camera.width + (size_t)x] > 0.0f;
}

#endif
