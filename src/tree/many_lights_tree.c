/* many_lights_tree.c: the tree over the stream's cells, eight children a node where the octree has them. Layer 6. [V3]
 *
 * Keys interleave x, y and z, so cells sorted by key are in octree order: a node is a range of cells. Levels with a
 * single child are skipped. Each node is summed directly from the cells, in integers. Lights of several kinds have a
 * tree for each kind, below one root. */
#include <string.h>

#include "../base/light_kind.h"
#include "../base/vec.h"
#include "many_lights_cell.h"

enum { CELL_BYTES = 17 };

/* Byte i, from the lowest, of the sort key of cells. */
static uint32_t byte_of(const lmb_many_lights_cell *c, int i)
{
    return i < 8 ? (uint32_t)(c->turn >> 8 * i) & 255u : i < 16 ? (uint32_t)(c->key >> 8 * (i - 8)) & 255u : c->kind;
}

/* Sorts the cells' indices by kind, key and turn into `slot`, one byte per pass. The table holds two such lists. */
static void sort_cells(lmb_many_lights *m)
{
    const uint32_t n = m->cell_count;
    uint32_t *from = m->slot, *to = m->slot + m->slot_count / 2;
    for (uint32_t i = 0; i < n; ++i) {
        from[i] = i;
    }
    for (int byte = 0; byte < CELL_BYTES; ++byte) {
        uint32_t at[256], sum = 0;
        memset(at, 0, sizeof at);
        for (uint32_t i = 0; i < n; ++i) {
            ++at[byte_of(&m->cell[i], byte)];
        }
        if (at[byte_of(&m->cell[0], byte)] == n) { /* all are equal */
            continue;
        }
        for (int b = 0; b < 256; ++b) {
            const uint32_t count = at[b];
            at[b] = sum;
            sum += count;
        }
        for (uint32_t i = 0; i < n; ++i) {
            to[at[byte_of(&m->cell[from[i]], byte)]++] = from[i];
        }
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    memmove(m->slot, from, n * sizeof *from);
}

static const lmb_many_lights_cell *light_cell_at(const lmb_many_lights *m, uint32_t i) { return &m->cell[m->slot[i]]; }

static float watts(const lmb_many_lights *m, int64_t quanta)
{
    const float w = (float)quanta * m->quantum;
    return w < 0x1p-60f ? 0.0f : w; /* kernels must not meet denormals */
}

/* Weighted mean, at the middle of a quantization step, clamped to the lights' box: a single light keeps its
 * position. */
static float mean_place_of(const lmb_many_lights_cell *c, int axis, float low, float step)
{
    const float at = low + ((float)(c->moment[axis] / c->weight) + 0.5f) * step;
    return clampf(at, c->low[axis], c->high[axis]);
}

/* Sets a cone that contains the cones of all directions in the box, each as wide as the widest. A unit vector within r
 * of the box's middle, which lies at distance m from 0, deviates from the middle's direction by at most an angle of
 * cosine (1 + m^2 - r^2) / 2 m. The cones' half angle, under 90 degrees, is added. */
static void set_cone(lmb_many_lights *m, uint32_t i, const lmb_many_lights_cell *c)
{
    const lmb_vec3 low = vec3(c->axis_low[0], c->axis_low[1], c->axis_low[2]);
    const lmb_vec3 high = vec3(c->axis_high[0], c->axis_high[1], c->axis_high[2]);
    const lmb_vec3 middle = mul3(add3(low, high), 0.5f), half = mul3(sub3(high, low), 0.5f);
    const float m2 = dot3(middle, middle), length = sqrtf(maxf(m2, 1e-12f)), own = c->cos_outer;
    const float bend = clampf((1.0f + m2 - dot3(half, half)) / (2.0f * length) - 1e-6f, -1.0f, 1.0f);
    const float sine = sqrtf(1.0f - bend * bend), own_sine = sqrtf(maxf(1.0f - own * own, 0.0f));
    const float turned = sine * own + bend * own_sine; /* sine of the sum; negative if it exceeds half a turn */
    const float values[6] = {middle.x / length, middle.y / length,
                             middle.z / length, turned > 0.0f ? bend * own - sine * own_sine : -1.0f,
                             maxf(turned, 0.0f), own};
    for (uint32_t k = 0; k < 6; ++k) {
        m->plane[(LMB_MANY_LIGHTS_AXIS + k) * m->plane_step + i] = values[k];
    }
}

static void set_cell_planes(lmb_many_lights *m, uint32_t i, const lmb_many_lights_cell *c)
{
    const lmb_many_lights_node *node = &m->node[i];
    const float at[3] = {node->position.x, node->position.y, node->position.z};
    float *plane = m->plane + i;
    for (uint32_t a = 0; a < 3; ++a) {
        plane[(LMB_MANY_LIGHTS_MIDDLE + a) * m->plane_step] = 0.5f * (c->low[a] + c->high[a]);
        plane[(LMB_MANY_LIGHTS_HALF + a) * m->plane_step] = 0.5f * (c->high[a] - c->low[a]);
        plane[(LMB_MANY_LIGHTS_POSITION + a) * m->plane_step] = at[a];
    }
    plane[LMB_MANY_LIGHTS_POWER * m->plane_step] = node->intensity[0] + node->intensity[1] + node->intensity[2];
    plane[LMB_MANY_LIGHTS_RANGE * m->plane_step] = c->range2_low;
    plane[(LMB_MANY_LIGHTS_RANGE + 1) * m->plane_step] = c->range2_high;
    if (light_kind_is((int32_t)node->kind, LIGHT_CONED)) {
        set_cone(m, i, c);
    }
}

static uint32_t light_kind(uint32_t kind)
{
    return kind == 0 ? LMB_LIGHT_POINT : kind == LMB_MANY_LIGHTS_SUNS ? LMB_LIGHT_DIRECTIONAL : LMB_LIGHT_SPOT;
}

static void set_position(lmb_many_lights *m, lmb_many_lights_node *node, const lmb_many_lights_cell *c)
{
    const lmb_many_lights_scale scale = lmb_many_lights_scale_of(m, c->kind);
    node->position = vec3(mean_place_of(c, 0, scale.low[0], scale.step), mean_place_of(c, 1, scale.low[1], scale.step),
                          mean_place_of(c, 2, scale.low[2], scale.step));
    if (c->lights > 1 && light_kind_is((int32_t)node->kind, LIGHT_FAR)) {
        const float length = length3(node->position);
        node->position = length > 1e-6f ? mul3(node->position, 1.0f / length) : c->strongest.source.position;
    }
}

/* Sets node i to the cells from .. past - 1. */
static void set_node(lmb_many_lights *m, uint32_t i, uint32_t from, uint32_t past)
{
    lmb_many_lights_cell sum = m->cell[m->slot[from]];
    lmb_many_lights_node *node = &m->node[i];
    float size2 = 0.0f;
    for (uint32_t k = from + 1; k < past; ++k) {
        lmb_many_lights_merge(&sum, &m->cell[m->slot[k]]);
    }
    memset(node, 0, sizeof *node);
    for (int c = 0; c < 3; ++c) {
        node->intensity[c] = watts(m, sum.intensity[c]);
        size2 += (sum.high[c] - sum.low[c]) * (sum.high[c] - sum.low[c]);
    }
    node->kind = sum.kind == light_cell_at(m, past - 1)->kind ? light_kind(sum.kind) : LMB_MANY_LIGHTS_MIXED;
    set_position(m, node, &sum);
    node->spread = size2 * (1.0f / 12.0f); /* a uniformly filled side s: s^2 / 12 */
    node->strongest = sum.strongest.source;
    node->median = sum.median.source;
    node->share = sum.strongest.score / maxf(node->intensity[0] + node->intensity[1] + node->intensity[2], 1e-30f);
    node->lights = sum.lights;
    node->from = from;
    node->past = past;
    set_cell_planes(m, i, &sum);
}

enum { BY_KEY = 64, BY_KIND = 128 }; /* a split: shift of the turn; of the key, from BY_KEY on; or the kind */

/* The child of a node that holds cell i: three bits of the key or turn, or the kind. */
static uint32_t octant(const lmb_many_lights *m, uint32_t i, int parting)
{
    const lmb_many_lights_cell *c = light_cell_at(m, i);
    return parting == BY_KIND ? c->kind
                              : (uint32_t)((parting >= BY_KEY ? c->key : c->turn) >> (parting & 63)) & 7u;
}

/* The highest three bits in which the first and last cells of a range differ: the tree splits there. */
static int parting_of(const lmb_many_lights *m, uint32_t from, uint32_t past)
{
    const lmb_many_lights_cell *a = light_cell_at(m, from), *b = light_cell_at(m, past - 1);
    const uint64_t differ = a->key != b->key ? a->key ^ b->key : a->turn ^ b->turn;
    int shift = 60;
    if (a->kind != b->kind) {
        return BY_KIND;
    }
    while ((differ >> shift & 7u) == 0) {
        shift -= 3;
    }
    return shift + (a->key != b->key ? BY_KEY : 0);
}

static void add_children(lmb_many_lights *m, uint32_t i)
{
    const uint32_t past = m->node[i].past;
    const int parting = parting_of(m, m->node[i].from, past);
    m->node[i].first = m->node_count;
    for (uint32_t from = m->node[i].from, to = from; from < past; from = to) {
        while (to < past && octant(m, to, parting) == octant(m, from, parting)) {
            ++to;
        }
        set_node(m, m->node_count++, from, to);
        ++m->node[i].children;
    }
}

lmb_status lmb_many_lights_build(lmb_many_lights *inout)
{
    if (inout == NULL || inout->cell == NULL || inout->node_count > 0) {
        return LMB_ERR_ARG;
    }
    if (inout->cell_count == 0) {
        return LMB_OK;
    }
    memset(inout->plane, 0, (size_t)inout->plane_step * LMB_MANY_LIGHTS_PLANES * sizeof *inout->plane);
    sort_cells(inout);
    set_node(inout, inout->node_count++, 0, inout->cell_count);
    for (uint32_t i = 0; i < inout->node_count; ++i) { /* the node list doubles as the queue */
        if (inout->node[i].past - inout->node[i].from > 1) {
            add_children(inout, i);
        }
    }
    return LMB_OK;
}
