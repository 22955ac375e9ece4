/* small.c: builds a BVH of 16-byte nodes in the order of a Z curve. It may be rebuilt each frame. Layer 4. [ours]
 *
 * Triangles are sorted by size, in three classes, and by the Z curve of their middles. Each four of them are a leaf. A
 * node is split at the highest bit in which the keys of its leaves differ. Boxes are whole steps of a grid over all
 * triangles, rounded outwards.
 *
 * The build needs no further memory: keys lie where the nodes will be. The sorted keys lie at the end of the nodes, and
 * each key is read before a node overwrites it. */
#include <lambent/occlusion.h>

#include <string.h>

#include "../base/memory_check.h"
#include "../base/vec.h"
#include "../raster/triangle.h"
#include "small.h"
#include "traversal.h"

#if LMB_LIVE

enum {
    SMALL_LEAF = 4,         /* triangles */
    SPARE_NODES = 128,      /* over the depth of the tree: nodes then never overwrite keys that are still read */
    MOST_SMALL = 65535,     /* triangles: ids have 16 bits */
    MOST_SMALL_RUNS = 64,   /* nodes: 32 bits of the keys, and halves of up to 2^14 equal ones */
    SMALL_KEY_CELLS = 1024, /* along each axis */
    SMALL_DIGIT = 256
};
#define SMALL_GRID_STEPS 65000.0f /* over all triangles; a node has 65,536 */

static uint32_t small_leaves(uint32_t n) { return (n + SMALL_LEAF - 1) / SMALL_LEAF; }

static uint32_t small_nodes(uint32_t n) { return 2 * small_leaves(n) + SPARE_NODES; }

size_t lmb_bvh_small_bytes(uint32_t n)
{
    return n == 0 || n > MOST_SMALL ? 0 : small_nodes(n) * sizeof(lmb_small_node) + (n + 1) / 2 * 2 * sizeof(uint16_t);
}

lmb_status lmb_bvh_small_init(lmb_bvh *out, uint32_t n, void *memory, size_t bytes)
{
    if (out == NULL || lmb_bvh_small_bytes(n) == 0) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, lmb_bvh_small_bytes(n));
    if (status != LMB_OK) {
        return status;
    }
    memset(out, 0, sizeof *out);
    out->small = (lmb_small_node *)memory;
    out->small_id = (uint16_t *)(void *)(out->small + small_nodes(n));
    out->triangle_cap = n;
    return LMB_OK;
}

int lmb_small_triangle(lmb_bvh_triangle *out, const lmb_scene *scene, uint32_t id)
{
    lmb_triangle from;
    lmb_vec3 normal;
    float longest;
    if (!lmb_triangle_fetch(&from, scene, id) || !triangle_cross(&normal, &longest, &from)) {
        return 0;
    }
    memcpy(out->corner, from.corner, sizeof out->corner);
    out->normal = normalize3(normal);
    out->id = id | (from.material->flags & LMB_ALPHA_MASK ? LMB_BVH_MASKED : 0);
    return 1;
}

/* --- keys --------------------------------------------------------------------------------------------------------- */

static uint32_t small_key_bits(float at)
{
    uint32_t v = (uint32_t)clampi((int32_t)clampf(at, 0.0f, SMALL_KEY_CELLS - 1), 0, SMALL_KEY_CELLS - 1);
    v = (v | v << 16) & 0x030000ffu;
    v = (v | v << 8) & 0x0300f00fu;
    v = (v | v << 4) & 0x030c30c3u;
    return (v | v << 2) & 0x09249249u;
}

/* 0 .. 2. Large triangles get nodes of their own, because most segments would test small ones in their nodes. */
static uint32_t size_class(float extent, float all) { return (uint32_t)(extent > all / 16.0f) + (extent > all / 4.0f); }

/* Stores the ids of all triangles that can block, and the keys of their middles by id. Extends low, high to their
 * box. */
static uint32_t take_small(lmb_bvh *b, uint32_t *key, lmb_vec3 *low, lmb_vec3 *high)
{
    const lmb_scene *scene = b->scene;
    const uint32_t all = lmb_scene_triangles(scene);
    const lmb_vec3 origin = scene->bounds_min, size = sub3(scene->bounds_max, origin);
    const float per = (float)SMALL_KEY_CELLS / maxf(3.0f * largest3(size), 1e-30f); /* of the sum of three corners */
    uint32_t count = 0;
    for (uint32_t id = 1; id <= all; ++id) {
        lmb_triangle t;
        lmb_vec3 normal;
        float longest;
        if (lmb_triangle_fetch(&t, scene, id) && triangle_cross(&normal, &longest, &t)) {
            const lmb_vec3 a = sub3(t.corner[0], origin), c = sub3(t.corner[1], origin), d = sub3(t.corner[2], origin),
                           at = mul3(add3(add3(a, c), d), per);
            *low = min3(*low, min3(min3(t.corner[0], t.corner[1]), t.corner[2]));
            *high = max3(*high, max3(max3(t.corner[0], t.corner[1]), t.corner[2]));
            const lmb_vec3 extent = sub3(max3(max3(t.corner[0], t.corner[1]), t.corner[2]),
                                         min3(min3(t.corner[0], t.corner[1]), t.corner[2]));
            key[id - 1] = small_key_bits(at.x) | small_key_bits(at.y) << 1 | small_key_bits(at.z) << 2 |
                          size_class(largest3(extent), largest3(size)) << 30;
            b->small_id[count++] = (uint16_t)id;
        }
    }
    return count;
}

/* One stable pass of a radix sort of ids. */
static void sort_ids(uint16_t *to, const uint16_t *from, uint32_t count, const uint32_t *key, int shift)
{
    uint32_t at[SMALL_DIGIT], sum = 0;
    memset(at, 0, sizeof at);
    for (uint32_t i = 0; i < count; ++i) {
        ++at[key[from[i] - 1] >> shift & (SMALL_DIGIT - 1)];
    }
    for (int d = 0; d < SMALL_DIGIT; ++d) {
        const uint32_t own = at[d];
        at[d] = sum;
        sum += own;
    }
    for (uint32_t i = 0; i < count; ++i) {
        to[at[key[from[i] - 1] >> shift & (SMALL_DIGIT - 1)]++] = from[i];
    }
}

/* --- nodes -------------------------------------------------------------------------------------------------------- */

/* The leaves first .. past - 1, whose node is not yet made. */
typedef struct small_run {
    uint32_t first, past, parent; /* parent: the node whose second part this is; NONE: a first part, or the root */
} small_run;
#define NO_PARENT 0xffffffffu

/* The first leaf of a run's second part: where the highest bit in which keys differ is 1. key: of each triangle. */
static uint32_t split_of_run(const small_run *r, const uint32_t *key)
{
    const uint32_t low = key[SMALL_LEAF * r->first], high = key[SMALL_LEAF * (r->past - 1)];
    uint32_t differ = low ^ high;
    uint32_t from = r->first, to = r->past - 1; /* `from` is in the first part, `to` in the second */
    if (differ == 0) {
        return (r->first + r->past) / 2;
    }
    while ((differ & (differ - 1)) != 0) {
        differ &= differ - 1;
    }
    while (to - from > 1) {
        const uint32_t middle = (from + to) / 2;
        if ((key[SMALL_LEAF * middle] & differ) != 0) {
            to = middle;
        } else {
            from = middle;
        }
    }
    return to;
}

/* Makes nodes in depth-first order, without boxes: a first part follows its node. key: of each triangle. */
static void put_small_nodes(lmb_bvh *b, const uint32_t *key)
{
    small_run waiting[MOST_SMALL_RUNS];
    int count = 1;
    waiting[0].first = 0;
    waiting[0].past = small_leaves(b->triangle_count);
    waiting[0].parent = NO_PARENT;
    b->small_count = 0;
    while (count > 0) {
        const small_run r = waiting[--count];
        const uint32_t own = b->small_count++, left = b->triangle_count - SMALL_LEAF * r.first;
        const uint32_t split = r.past - r.first > 1 ? split_of_run(&r, key) : 0;
        lmb_small_node *node = &b->small[own];
        if (r.parent != NO_PARENT) {
            b->small[r.parent].first = (uint16_t)own;
        }
        node->first = (uint16_t)(SMALL_LEAF * r.first);
        node->count = (uint16_t)(split == 0 ? left < SMALL_LEAF ? left : SMALL_LEAF : 0);
        if (split != 0) {
            waiting[count].first = split;
            waiting[count].past = r.past;
            waiting[count++].parent = own;
            waiting[count].first = r.first;
            waiting[count].past = split;
            waiting[count++].parent = NO_PARENT;
        }
    }
}

/* --- boxes -------------------------------------------------------------------------------------------------------- */

/* A grid whose first and last steps lie outside all widened boxes. A step is larger than rounding. */
static void set_small_grid(lmb_bvh *b, lmb_vec3 low, lmb_vec3 high)
{
    const float from[3] = {low.x, low.y, low.z}, to[3] = {high.x, high.y, high.z};
    const float place = maxf(largest3(low), largest3(high)),
                wide = LMB_BOX_SIZE * largest3(sub3(high, low)) + LMB_BOX_PLACE * place;
    for (int h = 0; h < 3; ++h) {
        const float step = (to[h] - from[h] + 4.0f * wide) / SMALL_GRID_STEPS;
        b->small_step[h] = maxf(maxf(step, 2.3841858e-7f * place), 1e-30f); /* 2^-22 */
        b->small_low[h] = from[h] - 2.0f * wide - 4.0f * b->small_step[h];
    }
}

/* The last step at or below a place. */
static uint16_t step_below(const lmb_bvh *b, int h, float at)
{
    int32_t step = (int32_t)clampf((at - b->small_low[h]) / b->small_step[h], 0.0f, 65535.0f);
    while (step > 0 && !(lmb_small_side(b, h, (uint16_t)step) <= at)) {
        --step;
    }
    return (uint16_t)step;
}

/* The first step at or above a place. */
static uint16_t step_above(const lmb_bvh *b, int h, float at)
{
    int32_t step = (int32_t)clampf((at - b->small_low[h]) / b->small_step[h], 0.0f, 65535.0f);
    while (step < 65535 && !(lmb_small_side(b, h, (uint16_t)step) >= at)) {
        ++step;
    }
    return (uint16_t)step;
}

/* A leaf's box, as wide as that of lmb_boxes. */
static void set_leaf_box(const lmb_bvh *b, lmb_small_node *node)
{
    lmb_vec3 low = vec3(3e38f, 3e38f, 3e38f), high = vec3(-3e38f, -3e38f, -3e38f);
    for (uint32_t i = 0; i < node->count; ++i) {
        lmb_triangle t;
        if (lmb_triangle_fetch(&t, b->scene, b->small_id[node->first + i])) {
            low = min3(low, min3(min3(t.corner[0], t.corner[1]), t.corner[2]));
            high = max3(high, max3(max3(t.corner[0], t.corner[1]), t.corner[2]));
        }
    }
    const float from[3] = {low.x, low.y, low.z}, to[3] = {high.x, high.y, high.z};
    const float wide = LMB_BOX_SIZE * largest3(sub3(high, low)) + LMB_BOX_PLACE * maxf(largest3(low), largest3(high));
    for (int h = 0; h < 3; ++h) {
        node->low[h] = step_below(b, h, from[h] - wide);
        node->high[h] = step_above(b, h, to[h] + wide);
    }
}

/* Parts follow their node, so the last node comes first. */
static void set_small_boxes(lmb_bvh *b)
{
    for (uint32_t k = b->small_count; k-- > 0;) {
        lmb_small_node *node = &b->small[k];
        if (node->count > 0) {
            set_leaf_box(b, node);
            continue;
        }
        const lmb_small_node *one = node + 1, *other = &b->small[node->first];
        for (int h = 0; h < 3; ++h) {
            node->low[h] = one->low[h] < other->low[h] ? one->low[h] : other->low[h];
            node->high[h] = one->high[h] > other->high[h] ? one->high[h] : other->high[h];
        }
    }
}

lmb_status lmb_small_build(lmb_bvh *b, const lmb_scene *scene)
{
    uint32_t *key = (uint32_t *)(void *)b->small; /* by id; the second half of the nodes is free */
    lmb_vec3 low = vec3(3e38f, 3e38f, 3e38f), high = vec3(-3e38f, -3e38f, -3e38f);
    b->small_count = b->triangle_count = b->node_count = 0;
    b->scene = scene;
    if (lmb_scene_triangles(scene) > b->triangle_cap) {
        return LMB_ERR_CAPACITY;
    }
    const uint32_t count = take_small(b, key, &low, &high);
    uint16_t *other = (uint16_t *)(void *)(key + b->triangle_cap);
    uint32_t *sorted = (uint32_t *)(void *)(b->small + small_nodes(b->triangle_cap)) - count;
    for (int shift = 0; shift < 32; shift += 16) {
        sort_ids(other, b->small_id, count, key, shift);
        sort_ids(b->small_id, other, count, key, shift + 8);
    }
    for (uint32_t i = 0; i < count; ++i) {
        sorted[i] = key[b->small_id[i] - 1];
    }
    b->triangle_count = count;
    if (count > 0) {
        put_small_nodes(b, sorted);
        set_small_grid(b, low, high);
        set_small_boxes(b);
    }
    return LMB_OK;
}

#endif
