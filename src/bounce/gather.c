/* gather.c: groups -> irradiance of a tile: far pairs at once, near groups through their discs. Layer 5. [V27 V28] */
#include <lambent/bounce.h>

#include "../lane/lane_scalar.h"
#include "../lane/lane.h"
#include "gather.inl"
#include "../occlusion/occlude.h"

#if LMB_BOUNCE

float lmb_disc_factor(lmb_vec3 at, lmb_vec3 normal, lmb_vec3 centre, lmb_vec3 axis, float area)
{
    lane3 to = lane3_sub(lane3_splat(centre.x, centre.y, centre.z), lane3_splat(at.x, at.y, at.z));
    float factor[LANES];
    lane_store(factor, disc_factor(to, lane_max(lane3_dot(to, to), lane_splat(1e-24f)),
                                   lane3_splat(normal.x, normal.y, normal.z), lane3_splat(axis.x, axis.y, axis.z),
                                   lane_splat(area)));
    return factor[0];
}

lmb_status lmb_gather_tile(lmb_irradiance *inout, const lmb_kernels *kernels, lmb_gather_scratch *scratch,
                           const lmb_tile *tile, const lmb_groups *groups, const lmb_points *points,
                           const lmb_occluder *occluder)
{
    lmb_march_job job;
    if (inout == NULL || kernels == NULL || scratch == NULL || tile == NULL || groups == NULL) {
        return LMB_ERR_ARG;
    }
    int32_t occluded = lmb_march_setup(&job, occluder);
    if (occluded < 0) {
        return (lmb_status)occluded;
    }
    const lmb_march_job *march = occluded ? &job : NULL;
    kernels->gather(inout, scratch, tile, groups, march);
    for (int32_t k = 0; points != NULL && points->data != NULL && k < groups->count; ++k) {
        if (scratch->near_pixels[k] != 0) {
            kernels->gather_near(inout, scratch->near_pixels[k], tile, points->data + groups->first[k],
                                 groups->members[k], march);
        }
    }
    return LMB_OK;
}

#endif
