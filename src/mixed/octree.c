/* octree.c: a pool of voxels: its memory, the path to a voxel, and means from the leaves upward. Layer 6. [M8 M13] */
#include "octree.h"

#include <string.h>

#include "../base/memory_check.h"

#if LMB_VOXELS

/* --- memory ------------------------------------------------------------------------------------------------------- */

static size_t floats_each(int32_t fields)
{
    return fields == LMB_VOXELS_ONE     ? 1 + LMB_VOXEL_COVER + LMB_VOXEL_LIGHT
           : fields == LMB_VOXELS_THREE ? 1 + 2 * LMB_VOXEL_COVER + 3 * LMB_VOXEL_LIGHT
                                        : 0;
}

size_t lmb_voxels_bytes(uint32_t cap, int32_t fields)
{
    const size_t each = floats_each(fields) * sizeof(float);
    return each == 0 || cap < OCTREE_SPARSE || cap > 1u << 24 || cap > (size_t)-1 / each ? 0 : cap * each;
}

lmb_status lmb_voxels_init(lmb_voxels *out, uint32_t cap, int32_t fields, void *memory, size_t bytes)
{
    const size_t needed = lmb_voxels_bytes(cap, fields);
    const lmb_status status = check_array(out, memory, bytes, needed);
    if (status != LMB_OK) {
        return status;
    }
    float *at = (float *)memory;
    memset(out, 0, sizeof *out);
    out->cap = cap;
    out->worlds = fields == LMB_VOXELS_ONE ? 1 : 2;
    for (int32_t f = 0; f < fields; ++f, at += (size_t)cap * LMB_VOXEL_LIGHT) {
        out->light[f] = at;
    }
    for (int32_t w = 0; w < out->worlds; ++w, at += (size_t)cap * LMB_VOXEL_COVER) {
        out->cover[w] = at;
    }
    out->child = at;
    return LMB_OK;
}

/* --- places ------------------------------------------------------------------------------------------------------- */

/* Voxel of a cell with a side of 2^levels; a number under 8 if there is none. */
static uint32_t voxel_of_cell(const lmb_voxels *v, octree_cell c, int32_t levels)
{
    if (levels <= OCTREE_FULL) {
        return octree_full(c, levels);
    }
    int32_t below = levels - OCTREE_FULL;
    const octree_cell top = {c.x >> below, c.y >> below, c.z >> below};
    uint32_t at = octree_full(top, OCTREE_FULL);
    while (below-- > 0) {
        at = (uint32_t)v->child[at] + octree_octant(c, below);
    }
    return at;
}

/* Takes eight empty voxels; returns 0 if none are left. */
static uint32_t take_eight(lmb_voxels *v)
{
    const uint32_t first = v->count;
    if (v->cap - first < 8) {
        return 0;
    }
    v->count += 8;
    memset(v->child + first, 0, 8 * sizeof *v->child);
    for (int32_t w = 0; w < v->worlds; ++w) {
        memset(v->cover[w] + (size_t)first * LMB_VOXEL_COVER, 0, 8 * LMB_VOXEL_COVER * sizeof(float));
    }
    return first;
}

uint32_t lmb_octree_leaf(lmb_voxels *v, octree_cell c)
{
    int32_t below = v->depth - OCTREE_FULL;
    const octree_cell top = {c.x >> below, c.y >> below, c.z >> below};
    uint32_t at = octree_full(top, OCTREE_FULL);
    while (below-- > 0) {
        uint32_t next = (uint32_t)v->child[at];
        if (next == 0) {
            next = take_eight(v);
            if (next == 0) {
                return 0;
            }
            v->child[at] = (float)next;
        }
        at = next + octree_octant(c, below);
    }
    return at;
}

uint32_t lmb_voxels_at(const lmb_voxels *v, lmb_vec3 at, int32_t level)
{
    if (v == NULL || level < 0 || level > v->depth || v->count == 0) {
        return 0;
    }
    const lmb_vec3 p = octree_place(v, at);
    const float side = (float)(1 << v->depth);
    if (!(p.x >= 0.0f && p.y >= 0.0f && p.z >= 0.0f && p.x < side && p.y < side && p.z < side)) {
        return 0;
    }
    const octree_cell c = {(int32_t)p.x >> level, (int32_t)p.y >> level, (int32_t)p.z >> level};
    const uint32_t found = voxel_of_cell(v, c, v->depth - level);
    return found < 8 ? 0 : found;
}

/* --- means -------------------------------------------------------------------------------------------------------- */

/* Averages the children in the order of their octants. */
static void set_child_mean(float *data, int floats, uint32_t to, const uint32_t from[8])
{
    for (int i = 0; i < floats; ++i) {
        float sum = 0.0f;
        for (int k = 0; k < 8; ++k) {
            sum += data[(size_t)from[k] * (size_t)floats + (size_t)i];
        }
        data[(size_t)to * (size_t)floats + (size_t)i] = 0.125f * sum;
    }
}

static void mean_of_full(float *data, int floats, octree_cell c, int32_t level)
{
    uint32_t from[8];
    for (int32_t k = 0; k < 8; ++k) {
        const octree_cell below = {2 * c.x + (k & 1), 2 * c.y + (k >> 1 & 1), 2 * c.z + (k >> 2)};
        from[k] = octree_full(below, level + 1);
    }
    set_child_mean(data, floats, octree_full(c, level), from);
}

/* A child is always created after its parent, so a pass from the last voxel to the first finishes all children before
 * each parent: the n - 1 steps of n levels in one pass. */
void lmb_octree_mean(const lmb_voxels *v, float *data, int floats)
{
    for (uint32_t at = v->count; at-- > octree_base(OCTREE_FULL);) {
        const uint32_t first = (uint32_t)v->child[at];
        if (first > 0) {
            uint32_t from[8];
            for (uint32_t k = 0; k < 8; ++k) {
                from[k] = first + k;
            }
            set_child_mean(data, floats, at, from);
        }
    }
    for (int32_t level = OCTREE_FULL - 1; level >= 0; --level) {
        const int32_t side = 1 << level;
        for (int32_t i = 0; i < side * side * side; ++i) {
            const octree_cell c = {i % side, i / side % side, i / (side * side)};
            mean_of_full(data, floats, c, level);
        }
    }
}

#endif
