/* octree.h: where a voxel lies in the pool. Layer 5.
 *
 * Voxels 0 .. 7 are empty space and their own children, so a way down may go on where nothing is stored. */
#ifndef LMB_VOXEL_OCTREE_H
#define LMB_VOXEL_OCTREE_H

#include <lambent/voxel.h>

#include "../base/vec.h"

enum { OCTREE_FULL = 4, OCTREE_SPARSE = 4689 /* the first voxel that is stored only where something is */ };

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

/* In leaves, from the cube's corner. */
static inline lmb_vec3 octree_place(const lmb_voxels *v, lmb_vec3 at)
{
    return mul3(sub3(at, v->low), 1.0f / v->leaf);
}

/* The voxel of a cell of 2^levels a side; a number under 8 where there is none. */
uint32_t lmb_octree_find(const lmb_voxels *v, octree_cell c, int32_t levels);

/* The voxel of `level` (0: leaves) at a place; 0: empty space. */
uint32_t lmb_voxels_at(const lmb_voxels *v, lmb_vec3 at, int32_t level);

/* The leaf of a cell, made where there is none; 0: the pool is full. */
uint32_t lmb_octree_leaf(lmb_voxels *v, octree_cell c);

/* Each voxel that has children becomes their mean, `floats` numbers a voxel. */
void lmb_octree_mean(const lmb_voxels *v, float *data, int floats);

#endif
