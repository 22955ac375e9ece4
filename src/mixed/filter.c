/* filter.c: averages light from the leaves upward; the difference of two worlds' light. Layer 6.       [M11 M12 M13] */
#include "../base/poly.h"
#include "octree.h"

#if LMB_VOXELS

/* Smaller light becomes 0: a cone's weights may scale it by 2^-50, and kernels must not meet denormals. */
static const float min = 5.421011e-20f; /* 2^-64 */

lmb_status lmb_voxels_filter(lmb_voxels *v, int32_t field)
{
    if (v == NULL || field < 0 || field >= LMB_VOXELS_THREE || v->light[field] == NULL || v->count == 0) {
        return LMB_ERR_ARG;
    }
    float *light = v->light[field];
    lmb_octree_mean(v, light, LMB_VOXEL_LIGHT);
    for (size_t i = 0; i < (size_t)v->count * LMB_VOXEL_LIGHT; ++i) {
        light[i] = absf(light[i]) < min ? 0.0f : light[i];
    }
    return LMB_OK;
}

lmb_status lmb_voxels_delta(lmb_voxels *v)
{
    if (v == NULL || v->worlds != 2 || v->count == 0) {
        return LMB_ERR_ARG;
    }
    for (size_t i = 0; i < (size_t)v->count * LMB_VOXEL_LIGHT; ++i) {
        const float d = v->light[LMB_VOXEL_WITH][i] - v->light[LMB_VOXEL_WITHOUT][i];
        v->light[LMB_VOXEL_DELTA][i] = absf(d) < min ? 0.0f : d;
    }
    return LMB_OK;
}

#endif
