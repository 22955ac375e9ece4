/* inject.c: first points of the shadow maps -> light of leaves, by outgoing direction. Layer 6.             [M7 M10] */
#include <string.h>

#include "../base/poly.h"
#include "octree.h"

#if LMB_VOXELS

static int has_field(const lmb_voxels *v, int32_t field)
{
    return v != NULL && field >= 0 && field < LMB_VOXELS_THREE && v->light[field] != NULL;
}

lmb_status lmb_voxels_dark(lmb_voxels *v, int32_t field)
{
    if (!has_field(v, field)) {
        return LMB_ERR_ARG;
    }
    memset(v->light[field], 0, (size_t)v->count * LMB_VOXEL_LIGHT * sizeof(float));
    if (field < 2) {
        v->flux[field] = v->lost[field] = 0.0;
    }
    return LMB_OK;
}

static int is_covered(const lmb_voxels *v, int32_t world, uint32_t at)
{
    const float *c = v->cover[world] + (size_t)at * LMB_VOXEL_COVER;
    return at >= 8 && c[0] + c[1] + c[2] + c[3] + c[4] + c[5] > 0.0f;
}

/* A covered leaf: the first point's own, or one beside it along its normal. A texel's position and a triangle's part
 * may be rounded to two sides of a leaf face, and a texel at an edge may overhang. Returns 0 if there is none. */
static uint32_t leaf_of(const lmb_voxels *v, int32_t world, const lmb_texel *t)
{
    static const float beside[] = {0.0f, -1.0f / 64.0f, 1.0f / 64.0f, -0.25f, 0.25f, -0.5f, 0.5f};
    for (int i = 0; i < (int)(sizeof beside / sizeof *beside); ++i) {
        const uint32_t at = lmb_voxels_at(v, add3(t->position, mul3(t->normal, beside[i] * v->leaf)), 0);
        if (is_covered(v, world, at)) {
            return at;
        }
    }
    return 0;
}

lmb_status lmb_voxels_inject(lmb_voxels *v, int32_t field, const lmb_texel *texels, size_t count)
{
    if (!has_field(v, field) || field == LMB_VOXEL_DELTA || (texels == NULL && count > 0) || v->count == 0) {
        return LMB_ERR_ARG;
    }
    const float per_area = 1.0f / (LMB_PI * v->leaf * v->leaf);
    for (size_t i = 0; i < count; ++i) {
        const lmb_texel *t = &texels[i];
        const double flux = (double)t->flux[0] + (double)t->flux[1] + (double)t->flux[2];
        if (!(flux > 0.0) || !(flux < 1e30)) {
            continue;
        }
        const uint32_t at = leaf_of(v, field, t);
        if (at == 0) {
            v->lost[field] += flux;
            continue;
        }
        const float normal[3] = {t->normal.x, t->normal.y, t->normal.z};
        float *light = v->light[field] + (size_t)at * LMB_VOXEL_LIGHT;
        v->flux[field] += flux;
        for (int k = 0; k < 3; ++k) {
            float *to = light + 4 * (2 * k + (normal[k] < 0.0f));
            for (int c = 0; c < 3; ++c) {
                to[c] += t->flux[c] * absf(normal[k]) * per_area;
            }
        }
    }
    return LMB_OK;
}

#endif
