/* octree.h: addresses of voxels in the pool. Layer 6.
 *
 * Voxels 0 .. 7 are empty space and their own children, so a descent may continue below a missing voxel. */
#ifndef LMB_MIXED_OCTREE_H
#define LMB_MIXED_OCTREE_H

#include <lambent/voxel.h>

#include "../base/vec.h"

enum { OCTREE_FULL = 4, OCTREE_SPARSE = 4689 /* first voxel that is stored only if occupied */ };

/* The first voxel of 8^level, up to OCTREE_FULL. */
static inline uint32_t octree_base(int32_t level)
{
    static const uint32_t base[OCTREE_FULL + 1] = {8, 9, 17, 81, 593};
    return base[level];
}

typedef struct octree_cell {
    int32_t x, y, z;
} octree_cell;

static inline uint32_t octree_full(octree_cell c, int32_t level)
{
    return octree_base(level) + (uint32_t)((c.z << level | c.y) << level | c.x);
}

static inline uint32_t octree_octant(octree_cell c, int32_t bit)
{
    return (uint32_t)((c.x >> bit & 1) | (c.y >> bit & 1) << 1 | (c.z >> bit & 1) << 2);
}

/* Position in leaves, from the cube's corner. */
static inline lmb_vec3 octree_place(const lmb_voxels *v, lmb_vec3 at)
{
    return mul3(sub3(at, v->low), 1.0f / v->leaf);
}

/* Voxel of `level` (0: leaves) at a position; 0: empty space. */
uint32_t lmb_voxels_at(const lmb_voxels *v, lmb_vec3 at, int32_t level);

/* Leaf of a cell, created if there is none; 0 if the pool is full. */
uint32_t lmb_octree_leaf(lmb_voxels *v, octree_cell c);

/* Sets each voxel that has children to their mean, `floats` numbers for each voxel. */
void lmb_octree_mean(const lmb_voxels *v, float *data, int floats);

#endif
