/* voxel_sum.h: a field's light over all leaves by direction, W: pi x radiance x area seen from there. Of a first point it
 * is flux x the part of the normal along each direction. */
#ifndef TEST_VOXEL_SUM_H
#define TEST_VOXEL_SUM_H

#include <lambent/voxel.h>

#include "../src/mixed/octree.h"

static inline void voxel_sum(double out[6][3], const lmb_voxels *v, int32_t field)
{
    const double scale = 3.14159265358979323846 * (double)v->leaf * (double)v->leaf;
    for (int i = 0; i < 18; ++i) {
        out[i / 3][i % 3] = 0.0;
    }
    for (uint32_t at = octree_base(OCTREE_FULL); at < v->count; ++at) { /* empty voxels hold nothing */
        const float *light = v->light[field] + (size_t)at * LMB_VOXEL_LIGHT;
        for (int i = 0; i < 18 && v->child[at] == 0.0f; ++i) {
            out[i / 3][i % 3] += scale * (double)light[4 * (i / 3) + i % 3];
        }
    }
}

#endif
