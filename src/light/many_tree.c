/* many_tree.c: the tree over the stream's cells, eight children a node where the octree has them. Floor 5.        [V3]
 *
 * Keys hold x, y and z in turn, so cells in the order of their keys lie in the order of an octree: a node is a range of
 * them. Levels that would have one child are left out. Every node is summed from its own cells, in integers. */
#include <string.h>

#include "../base/vec.h"
#include "many_cell.h"

/* The cells' numbers in the order of their keys, into `slot`: a byte of the keys at a time, the lowest first. The table
 * has room for two such lists. */
static void sort_cells(lmb_many *m)
{
    const uint32_t n = m->cell_count;
    uint32_t *from = m->slot, *to = m->slot + m->slot_count / 2;
    for (uint32_t i = 0; i < n; ++i) {
        from[i] = i;
    }
    for (int shift = 0; shift < 64; shift += 8) { /* eight times: the list ends where it began */
        uint32_t at[256], sum = 0;
        memset(at, 0, sizeof at);
        for (uint32_t i = 0; i < n; ++i) {
            ++at[m->cell[i].key >> shift & 255u];
        }
        for (int b = 0; b < 256; ++b) {
            const uint32_t count = at[b];
            at[b] = sum;
            sum += count;
        }
        for (uint32_t i = 0; i < n; ++i) {
            to[at[m->cell[from[i]].key >> shift & 255u]++] = from[i];
        }
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
}

static uint64_t key_at(const lmb_many *m, uint32_t i) { return m->cell[m->slot[i]].key; }

static float watts(const lmb_many *m, int64_t quanta)
{
    const float w = (float)quanta * m->quantum;
    return w < 0x1p-60f ? 0.0f : w; /* a kernel meets no denormal */
}

/* The mean by weight, in the middle of its step, never outside the lights' own box: of one light it is its place. */
static float mean_of(const lmb_many_cell *c, int axis, float low, float step)
{
    const float at = low + ((float)(c->moment[axis] / c->weight) + 0.5f) * step;
    return clampf(at, c->low[axis], c->high[axis]);
}

static void set_planes(lmb_many *m, uint32_t i, const lmb_many_cell *c)
{
    const lmb_many_node *node = &m->node[i];
    const float at[3] = {node->position.x, node->position.y, node->position.z};
    float *plane = m->plane + i;
    for (uint32_t a = 0; a < 3; ++a) {
        plane[(LMB_MANY_MIDDLE + a) * m->plane_step] = 0.5f * (c->low[a] + c->high[a]);
        plane[(LMB_MANY_HALF + a) * m->plane_step] = 0.5f * (c->high[a] - c->low[a]);
        plane[(LMB_MANY_POSITION + a) * m->plane_step] = at[a];
    }
    plane[LMB_MANY_POWER * m->plane_step] = node->intensity[0] + node->intensity[1] + node->intensity[2];
}

/* Node i stands for the cells from .. past - 1. */
static void set_node(lmb_many *m, uint32_t i, uint32_t from, uint32_t past)
{
    lmb_many_cell sum = m->cell[m->slot[from]];
    lmb_many_node *node = &m->node[i];
    float size2 = 0.0f;
    for (uint32_t k = from + 1; k < past; ++k) {
        lmb_many_merge(&sum, &m->cell[m->slot[k]]);
    }
    memset(node, 0, sizeof *node);
    for (int c = 0; c < 3; ++c) {
        node->intensity[c] = watts(m, sum.intensity[c]);
        size2 += (sum.high[c] - sum.low[c]) * (sum.high[c] - sum.low[c]);
    }
    node->position.x = mean_of(&sum, 0, m->low.x, m->step);
    node->position.y = mean_of(&sum, 1, m->low.y, m->step);
    node->position.z = mean_of(&sum, 2, m->low.z, m->step);
    node->spread = size2 * (1.0f / 12.0f); /* a side s, filled evenly: s^2 / 12 */
    node->strongest = sum.strongest.position;
    node->median = sum.median.position;
    node->share = sum.strongest.score / maxf(node->intensity[0] + node->intensity[1] + node->intensity[2], 1e-30f);
    node->lights = sum.lights;
    node->from = from;
    node->past = past;
    set_planes(m, i, &sum);
}

/* Which child of a node holds cell i: three bits of its key, `shift` from the lowest. */
static uint32_t octant(const lmb_many *m, uint32_t i, int shift) { return (uint32_t)(key_at(m, i) >> shift) & 7u; }

/* The highest three bits in which the range's first and last keys differ: there the tree parts. */
static int parting(const lmb_many *m, uint32_t from, uint32_t past)
{
    const uint64_t differ = key_at(m, from) ^ key_at(m, past - 1);
    int shift = 60;
    while ((differ >> shift & 7u) == 0) {
        shift -= 3;
    }
    return shift;
}

static void add_children(lmb_many *m, uint32_t i)
{
    const uint32_t past = m->node[i].past;
    const int shift = parting(m, m->node[i].from, past);
    m->node[i].first = m->node_count;
    for (uint32_t from = m->node[i].from, to = from; from < past; from = to) {
        while (to < past && octant(m, to, shift) == octant(m, from, shift)) {
            ++to;
        }
        set_node(m, m->node_count++, from, to);
        ++m->node[i].children;
    }
}

lmb_status lmb_many_build(lmb_many *inout)
{
    if (inout == NULL || inout->cell == NULL || inout->node_count > 0) {
        return LMB_ERR_ARG;
    }
    if (inout->cell_count == 0) {
        return LMB_OK;
    }
    memset(inout->plane, 0, (size_t)inout->plane_step * LMB_MANY_PLANES * sizeof *inout->plane);
    sort_cells(inout);
    set_node(inout, inout->node_count++, 0, inout->cell_count);
    for (uint32_t i = 0; i < inout->node_count; ++i) { /* the list of nodes is the queue of those to part */
        if (inout->node[i].past - inout->node[i].from > 1) {
            add_children(inout, i);
        }
    }
    return LMB_OK;
}
