/* mixed_shade.c: the object over the photo, behind surfaces in front of it. Layer 6.                          [M24] */
#include "../base/vec.h"
#include <lambent/mixed.h>

#if LMB_MIXED

/* The photo hides the object if the measured depth is nearer by two standard deviations; with less, noise would hide
 * parts of the object near the ground. */
static int is_object_hidden(const lmb_tile *object, const lmb_tile *real, const lmb_cloud *cloud, int32_t k)
{
    if (real->id[k] == 0) {
        return 0;
    }
    const float q = 1.0f / real->depth[k];
    return q - 1.0f / object->depth[k] > 2.0f * lmb_cloud_sigma(cloud, q);
}

uint64_t lmb_object_tile(lmb_radiance *inout, const lmb_radiance *light, const lmb_tile *object, const lmb_tile *real,
                         const lmb_cloud *cloud)
{
    uint64_t shown = 0;
    if (inout == NULL || light == NULL || object == NULL || real == NULL || cloud == NULL) {
        return 0;
    }
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (object->id[k] != 0 && !is_object_hidden(object, real, cloud, k)) {
            for (int32_t c = 0; c < 3; ++c) {
                inout->rgb[c][k] = light->rgb[c][k];
            }
            shown |= UINT64_C(1) << k;
        }
    }
    return shown;
}

#endif
