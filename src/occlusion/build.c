/* build.c: builds the BVH of a scene's triangles, sixteen boxes a node, in the caller's arrays. Layer 4.
 *
 * Top down, in place. A node's triangles are split by the surface-area heuristic (Wald 2007), then the part with the
 * largest surface again, until there are sixteen parts. Many triangles are split between bins of their centres along
 * the three axes, which one pass fills. For up to five triangles every split is tried. A node is split into halves if
 * all centres coincide, or if it has more triangles than the levels below can hold: this bounds the depth.
 *
 * While the tree grows, only boxes and ids exist, as items in the place of triangles: 32 bytes instead of 52. Boxes are
 * minima and maxima, which do not depend on the order of joining, so every target builds the same tree. */
#include <lambent/occlusion.h>

#include <string.h>

#include "../base/memory_check.h"
#include "../base/vec.h"
#include "../raster/resolve.h"
#include "../raster/triangle.h"
#include "build.h"
#include "small.h"
#include "traversal.h"

#if LMB_TREES

enum {
    AXIS_BINS = 16,        /* along each axis */
    MAX_COARSE_ITEMS = 16, /* up to this many items use half the bins: most splits are small */
    MAX_SORTED_ITEMS = 5,  /* up to this many items try all splits */
    MAX_LEAF_TRIANGLES = 4 /* maximum triangles of a leaf while nodes are available */
};

size_t lmb_bvh_bytes(uint32_t n)
{
    const size_t each = sizeof(lmb_bvh_triangle) + sizeof(lmb_boxes) / 8, more = 8 * sizeof(lmb_boxes);
    return n == 0 || n > ((size_t)-1 - more) / each ? 0
                                                    : n * sizeof(lmb_bvh_triangle) + (n / 8 + 8) * sizeof(lmb_boxes);
}

lmb_status lmb_bvh_init(lmb_bvh *out, uint32_t n, void *memory, size_t bytes)
{
    if (out == NULL || n == 0 || n > LMB_MAX_TRIANGLES / 2) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, lmb_bvh_bytes(n));
    if (status != LMB_OK) {
        return status;
    }
    memset(out, 0, sizeof *out);
    out->node = (lmb_boxes *)memory;
    out->node_cap = n / 8 + 8;
    out->triangle = (lmb_bvh_triangle *)(void *)(out->node + out->node_cap);
    out->triangle_cap = n;
    return LMB_OK;
}

/* --- boxes -------------------------------------------------------------------------------------------------------- */

/* A box; an item is the box of a triangle. Four values each, because compilers vectorize these. The fourth values of an
 * item are the two halves of the id; they are unused elsewhere. */
typedef struct item_span {
    float low[4], high[4];
} item_span;

static item_span span_none(void)
{
    const item_span s = {{3e38f, 3e38f, 3e38f, 0.0f}, {-3e38f, -3e38f, -3e38f, 0.0f}};
    return s;
}

/* Two loops: gcc does not vectorize one. */
static inline void span_join(item_span *inout, item_span with)
{
    for (int c = 0; c < 4; ++c) {
        inout->low[c] = with.low[c] < inout->low[c] ? with.low[c] : inout->low[c];
    }
    for (int c = 0; c < 4; ++c) {
        inout->high[c] = with.high[c] > inout->high[c] ? with.high[c] : inout->high[c];
    }
}

static inline float half_area(const item_span *s)
{
    const float x = s->high[0] - s->low[0], y = s->high[1] - s->low[1], z = s->high[2] - s->low[2];
    return x * y + y * z + z * x;
}

static item_span span_of_items(const item_span *item, uint32_t count)
{
    item_span s = span_none();
    for (uint32_t i = 0; i < count; ++i) {
        span_join(&s, item[i]);
    }
    return s;
}

/* --- triangles ---------------------------------------------------------------------------------------------------- */

static void set_item(item_span *out, const lmb_triangle *t)
{
    const lmb_vec3 low = min3(min3(t->corner[0], t->corner[1]), t->corner[2]);
    const lmb_vec3 high = max3(max3(t->corner[0], t->corner[1]), t->corner[2]);
    out->low[0] = low.x;
    out->low[1] = low.y;
    out->low[2] = low.z;
    out->low[3] = (float)(t->id & 0xffffu);
    out->high[0] = high.x;
    out->high[1] = high.y;
    out->high[2] = high.z;
    out->high[3] = (float)(t->id >> 16);
}

static uint32_t item_id(const item_span *s) { return (uint32_t)s->low[3] | (uint32_t)s->high[3] << 16; }

/* As lmb_triangle_fetch. *instance caches the instance of the last triangle, which usually has this one too. */
static int fetch_drawable(lmb_triangle *out, const lmb_instance **instance, const lmb_scene *scene, uint32_t id)
{
    if (*instance == NULL || id - (*instance)->first_id >= scene->meshes[(*instance)->mesh].triangle_count) {
        *instance = lmb_instance_of(scene, id);
    }
    return *instance != NULL && triangle_of(out, scene, *instance, id);
}

/* Limits on texels read to find triangles that are entirely transparent: for one triangle, and in total. */
#define MAX_HOLE_TEXELS 65536u
#define ALL_TEXELS (1u << 26)

/* 1 if the triangle is entirely transparent and blocks nothing. */
NOINLINE int is_triangle_hole(const lmb_triangle *t, const lmb_scene *scene, uint32_t *texels)
{
    lmb_resolve_alpha alpha;
    uint32_t own = *texels < MAX_HOLE_TEXELS ? *texels : MAX_HOLE_TEXELS;
    const uint32_t before = own;
    lmb_resolve_alpha_of(&alpha, t);
    const int hole = lmb_resolve_is_hole(&alpha, scene, &own);
    *texels -= before - own;
    return hole;
}

/* Stores the items of all triangles that can block. Returns their number. */
static uint32_t take_items(item_span *out, const lmb_scene *scene)
{
    uint32_t texels = ALL_TEXELS;
    const uint32_t all = lmb_scene_triangles(scene);
    const lmb_instance *instance = NULL;
    uint32_t count = 0;
    for (uint32_t id = 1; id <= all; ++id) {
        lmb_triangle t;
        lmb_vec3 normal;
        float longest;
        if (fetch_drawable(&t, &instance, scene, id) && triangle_cross(&normal, &longest, &t) &&
            !((t.material->flags & LMB_ALPHA_MASK) && is_triangle_hole(&t, scene, &texels))) {
            set_item(&out[count++], &t);
        }
    }
    return count;
}

/* Replaces items by triangles in the same order, in the same memory. First all ids move to the end, where each is read
 * before a triangle overwrites it. */
static void place_triangles(lmb_bvh_triangle *t, uint32_t count, const lmb_scene *scene)
{
    const item_span *item = (const item_span *)(const void *)t;
    uint32_t *id = (uint32_t *)(void *)((char *)t + (size_t)count * (sizeof *t - sizeof *id));
    const lmb_instance *instance = NULL;
    for (uint32_t i = 0; i < count; ++i) {
        id[i] = item_id(&item[i]);
    }
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t own = id[i];
        lmb_triangle from;
        lmb_vec3 normal;
        float longest;
        if (fetch_drawable(&from, &instance, scene, own) && triangle_cross(&normal, &longest, &from)) {
            memcpy(t[i].corner, from.corner, sizeof from.corner);
            t[i].normal = normalize3(normal);
            t[i].id = own | (from.material->flags & LMB_ALPHA_MASK ? LMB_BVH_MASKED : 0);
        }
    }
}

/* Both lie in the memory of triangles. */
typedef char items_fit[sizeof(item_span) + sizeof(uint32_t) <= sizeof(lmb_bvh_triangle) ? 1 : -1];

/* --- splits ------------------------------------------------------------------------------------------------------- */

/* The best split of some items in two. Cost: areas x triangles; 3e38: none found. */
typedef struct node_cut {
    float cost;
    item_span left, right;
    uint32_t below;           /* items on the left */
    uint8_t order[MAX_SORTED_ITEMS]; /* few items: the left ones, then the others */
    int axis, bin;            /* many: the left ones are in bins below this */
    float low[4], per_bin[4]; /* bin = (twice the centre - low) x per_bin, 1/m; per_bin 0: all in one place */
} node_cut;

/* Maps twice the centres to bins along each axis. */
static void set_bins(node_cut *out, int bins, const item_span *item, uint32_t count)
{
    item_span middles = span_none();
    for (uint32_t i = 0; i < count; ++i) {
        item_span m;
        for (int c = 0; c < 4; ++c) {
            m.low[c] = item[i].low[c] + item[i].high[c];
        }
        for (int c = 0; c < 4; ++c) {
            middles.low[c] = m.low[c] < middles.low[c] ? m.low[c] : middles.low[c];
        }
        for (int c = 0; c < 4; ++c) {
            middles.high[c] = m.low[c] > middles.high[c] ? m.low[c] : middles.high[c];
        }
    }
    out->low[3] = out->per_bin[3] = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const float wide = middles.high[c] - middles.low[c];
        out->low[c] = middles.low[c];
        out->per_bin[c] = wide > 1e-30f ? (float)bins * 0.9999f / wide : 0.0f;
    }
}

/* The bins of an item along the three axes. */
static inline void bins_of(int32_t out[4], const node_cut *c, const item_span *item)
{
    for (int k = 0; k < 4; ++k) {
        out[k] = (int32_t)((item->low[k] + item->high[k] - c->low[k]) * c->per_bin[k]);
    }
}

/* Contents of the bins of an axis. */
typedef struct split_bins {
    item_span box[AXIS_BINS];
    uint32_t count[AXIS_BINS];
} split_bins;

static void fill_bins(split_bins out[3], int many, const node_cut *c, const item_span *item, uint32_t count)
{
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < many; ++i) {
            out[axis].box[i] = span_none();
            out[axis].count[i] = 0;
        }
    }
    for (uint32_t i = 0; i < count; ++i) {
        const item_span from = item[i];
        int32_t bin[4];
        bins_of(bin, c, &from);
        span_join(&out[0].box[bin[0]], from);
        span_join(&out[1].box[bin[1]], from);
        span_join(&out[2].box[bin[2]], from);
        ++out[0].count[bin[0]];
        ++out[1].count[bin[1]];
        ++out[2].count[bin[2]];
    }
}

/* The cheapest split between the bins of an axis. Returns 1 if it is cheaper than *best was. */
static int sweep(node_cut *best, const split_bins *b, int many, uint32_t count)
{
    float right[AXIS_BINS];
    item_span s = span_none();
    int found = 0;
    uint32_t below = 0;
    for (int i = many - 1; i > 0; --i) {
        span_join(&s, b->box[i]);
        right[i] = half_area(&s);
    }
    s = span_none();
    for (int i = 1; i < many; ++i) {
        span_join(&s, b->box[i - 1]);
        below += b->count[i - 1];
        if (below > 0 && below < count) {
            const float cost = half_area(&s) * (float)(int32_t)below + right[i] * (float)(int32_t)(count - below);
            if (cost < best->cost) {
                best->cost = cost;
                best->below = below;
                best->bin = i;
                found = 1;
            }
        }
    }
    return found;
}

/* Many items: the best split between bins. */
static void cut_bins(node_cut *best, const item_span *item, uint32_t count)
{
    split_bins b[3];
    const int many = count > MAX_COARSE_ITEMS ? AXIS_BINS : AXIS_BINS / 2;
    set_bins(best, many, item, count);
    fill_bins(b, many, best, item, count);
    for (int axis = 0; axis < 3; ++axis) {
        if (best->per_bin[axis] > 0.0f && sweep(best, &b[axis], many, count)) {
            best->axis = axis;
        }
    }
    best->left = best->right = span_none();
    for (int i = 0; i < many && best->cost < 3e38f; ++i) {
        span_join(i < best->bin ? &best->left : &best->right, b[best->axis].box[i]);
    }
}

/* Over all axes. */
static float middle_sum(const item_span *s)
{
    return (s->low[0] + s->high[0]) + (s->low[1] + s->high[1]) + (s->low[2] + s->high[2]);
}

/* Few items: the best of all splits, with the lower part on the left as with bins. A set of items is a bit mask. */
static void cut_few(node_cut *best, const item_span *item, uint32_t count)
{
    item_span box[1 << MAX_SORTED_ITEMS];
    float area[1 << MAX_SORTED_ITEMS], many[1 << MAX_SORTED_ITEMS];
    const uint32_t all = (1u << count) - 1;
    uint32_t left = 0;
    box[0] = span_none();
    many[0] = 0.0f;
    for (uint32_t set = 1; set < all; ++set) {
        box[set] = box[set & (set - 1)];
        many[set] = many[set & (set - 1)] + 1.0f;
        span_join(&box[set], item[lowest_bit(set)]);
        area[set] = half_area(&box[set]) * many[set];
    }
    for (uint32_t set = 1; 2 * set <= all; ++set) {
        const float cost = area[set] + area[all ^ set];
        if (cost < best->cost) {
            best->cost = cost;
            left = set;
        }
    }
    if (middle_sum(&box[left]) > middle_sum(&box[all ^ left])) {
        left ^= all;
    }
    best->below = 0;
    for (uint32_t bits = left; bits != 0; bits &= bits - 1) {
        best->order[best->below++] = (uint8_t)lowest_bit(bits);
    }
    for (uint32_t bits = all ^ left, at = best->below; bits != 0; bits &= bits - 1) {
        best->order[at++] = (uint8_t)lowest_bit(bits);
    }
}

static void part_few(node_cut *c, item_span *item, uint32_t count)
{
    item_span in[MAX_SORTED_ITEMS];
    memcpy(in, item, count * sizeof *item);
    c->left = c->right = span_none();
    for (uint32_t i = 0; i < count; ++i) {
        item[i] = in[c->order[i]];
        span_join(i < c->below ? &c->left : &c->right, item[i]);
    }
}

/* Moves items below the split to the front. */
static void part_bins(const node_cut *c, item_span *item, uint32_t count)
{
    const int axis = c->axis, bin = c->bin;
    const float low = c->low[axis], per_bin = c->per_bin[axis];
    uint32_t below = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const item_span from = item[i];
        item[i] = item[below];
        item[below] = from;
        below += (int32_t)((from.low[axis] + from.high[axis] - low) * per_bin) < bin;
    }
}

/* --- nodes -------------------------------------------------------------------------------------------------------- */

/* A contiguous run of triangles. */
typedef struct run {
    item_span box;
    float area;
    uint32_t first, count;
    int whole; /* 1: no split pays off */
} run;

static void set_run(run *out, const item_span *box, uint32_t first, uint32_t count)
{
    out->box = *box;
    out->area = half_area(box);
    out->first = first;
    out->count = count;
    out->whole = count == 1;
}

/* Splits a run in two, the second into *more. Returns 0 if that does not pay off. *halves: split into halves; set if
 * only that is possible. */
static int cut_run(item_span *items, run *r, run *more, int *halves)
{
    item_span *item = items + r->first;
    const uint32_t first = r->first, count = r->count;
    node_cut best = {0};
    best.cost = 3e38f;
    if (count <= MAX_SORTED_ITEMS) {
        cut_few(&best, item, count);
    } else if (!*halves) {
        cut_bins(&best, item, count);
    }
    /* Testing a box costs about as much as testing a triangle. */
    if (count <= MAX_LEAF_TRIANGLES && !(best.cost + r->area < r->area * (float)count)) {
        r->whole = 1;
        return 0;
    }
    if (count <= MAX_SORTED_ITEMS) {
        part_few(&best, item, count);
    } else if (best.cost < 3e38f) {
        part_bins(&best, item, count);
    } else {
        *halves = 1;
        best.below = count / 2;
        best.left = span_of_items(item, best.below);
        best.right = span_of_items(item + best.below, count - best.below);
    }
    set_run(r, &best.left, first, best.below);
    set_run(more, &best.right, first + best.below, count - best.below);
    return 1;
}

/* The run to split next: the largest box, or for halves the one with most triangles; or -1. */
static int next_run(const run *r, int count, int halves)
{
    int best = -1;
    for (int i = 0; i < count; ++i) {
        if (!r[i].whole && (best < 0 || (halves ? r[best].count < r[i].count : r[best].area < r[i].area))) {
            best = i;
        }
    }
    return best;
}

static void set_run_box(lmb_boxes *node, int i, const run *r)
{
    const float *low = r->box.low, *high = r->box.high;
    const float size = maxf(high[0] - low[0], maxf(high[1] - low[1], high[2] - low[2])),
                place = maxf(maxf(high[0], maxf(high[1], high[2])), -minf(low[0], minf(low[1], low[2]))),
                wide = LMB_BOX_SIZE * size + LMB_BOX_PLACE * place;
    for (int c = 0; c < 3; ++c) {
        node->low[c][i] = low[c] - wide;
        node->high[c][i] = high[c] + wide;
    }
    node->first[i] = r->first;
    node->count[i] = r->count;
}

/* A box that contains nothing. */
static void set_no_box(lmb_boxes *node, int i)
{
    for (int c = 0; c < 3; ++c) {
        node->low[c][i] = 3e38f;
        node->high[c][i] = -3e38f;
    }
    node->first[i] = node->count[i] = 0;
}

/* Fills a node with the triangles first .. first + count - 1 as up to sixteen leaves. */
static void fill_node(lmb_boxes *node, item_span *items, uint32_t first, uint32_t count, int depth)
{
    const int too_many = count > (uint64_t)MAX_LEAF_TRIANGLES << 4 * (LMB_TRAVERSAL_LEVELS - 1 - depth);
    run r[LMB_BOXES];
    int runs = 1, next, halves = too_many;
    const item_span box = span_of_items(items + first, count);
    set_run(&r[0], &box, first, count);
    while (runs < LMB_BOXES && (next = next_run(r, runs, halves)) >= 0) {
        int by_halves = halves;
        const int whole = runs == 1;
        runs += cut_run(items, &r[next], &r[runs], &by_halves);
        halves = whole ? by_halves : halves;
    }
    for (int i = 0; i < LMB_BOXES; ++i) {
        if (i < runs) {
            set_run_box(node, i, &r[i]);
        } else {
            set_no_box(node, i);
        }
    }
}

/* A node on the traversal stack, with the set of inner children still to be visited: box i is bit LMB_BOXES - 1 - i. */
typedef struct node_branch {
    uint32_t node, children;
} node_branch;

/* Turns leaves of a node that are too large into nodes, on level `deep`. */
static node_branch branch_at(lmb_bvh *b, item_span *items, uint32_t at, int deep)
{
    lmb_boxes *node = &b->node[at];
    node_branch out = {at, 0};
    for (int i = 0; i < LMB_BOXES; ++i) {
        if (node->count[i] > MAX_LEAF_TRIANGLES && b->node_count < b->node_cap && deep < LMB_TRAVERSAL_LEVELS) {
            const uint32_t child = b->node_count++;
            fill_node(&b->node[child], items, node->first[i], node->count[i], deep);
            node->first[i] = child;
            node->count[i] = 0;
            out.children |= 1u << (LMB_BOXES - 1 - i);
        }
    }
    return out;
}

/* Depth first, the last child before the others. */
static void grow_nodes(lmb_bvh *b, item_span *items)
{
    node_branch way[LMB_TRAVERSAL_LEVELS];
    int depth = 0;
    way[0] = branch_at(b, items, 0, 1);
    while (depth >= 0) {
        node_branch *up = &way[depth];
        if (up->children == 0) {
            --depth;
        } else {
            const int i = LMB_BOXES - 1 - lowest_bit(up->children);
            up->children &= up->children - 1;
            ++depth;
            way[depth] = branch_at(b, items, b->node[up->node].first[i], depth + 1);
        }
    }
}

lmb_status lmb_bvh_build(lmb_bvh *inout, const lmb_scene *scene)
{
    if (LMB_LIVE && inout != NULL && inout->small != NULL && scene != NULL) {
        return lmb_small_build(inout, scene);
    }
    if (inout == NULL || inout->triangle == NULL || inout->node == NULL || scene == NULL) {
        return LMB_ERR_ARG;
    }
    inout->node_count = inout->triangle_count = 0;
    inout->margin = 0.0f;
    inout->hull.count = 0;
    inout->scene = scene;
    if (lmb_scene_triangles(scene) > inout->triangle_cap) {
        return LMB_ERR_CAPACITY;
    }
    item_span *items = (item_span *)(void *)inout->triangle;
    inout->triangle_count = take_items(items, scene);
    if (inout->triangle_count > 0) {
        const item_span all = span_of_items(items, inout->triangle_count);
        const lmb_vec3 low = vec3(all.low[0], all.low[1], all.low[2]);
        inout->margin = half_box_margin(low, vec3(all.high[0], all.high[1], all.high[2]));
        fill_node(inout->node, items, 0, inout->triangle_count, 0);
        inout->node_count = 1;
        grow_nodes(inout, items);
        place_triangles(inout->triangle, inout->triangle_count, scene);
    }
    lmb_hull_find(&inout->hull, scene);
    inout->noise = inout->hull.count > 0 ? 4.0f * inout->hull.slack : 0.0f;
    inout->hull.count = LMB_PLAN ? inout->hull.count : 0;
    return LMB_OK;
}

#if LMB_FACETS

/* --- in the scene's order ----------------------------------------------------------------------------------------- */

#define MAX_ORDERED_AREA 64.0f /* of all leaves, times the scene's: rays meet about so many */

/* Triangles that cannot block are left out, but for holes. */
static void take_in_order(lmb_bvh *b, const lmb_scene *scene)
{
    const uint32_t all = lmb_scene_triangles(scene);
    const lmb_instance *instance = NULL;
    for (uint32_t id = 1; id <= all; ++id) {
        lmb_bvh_triangle *to = &b->triangle[b->triangle_count];
        lmb_triangle from;
        lmb_vec3 normal;
        float longest;
        if (fetch_drawable(&from, &instance, scene, id) && triangle_cross(&normal, &longest, &from)) {
            memcpy(to->corner, from.corner, sizeof to->corner);
            to->normal = normalize3(normal);
            to->id = id | (from.material->flags & LMB_ALPHA_MASK ? LMB_BVH_MASKED : 0);
            ++b->triangle_count;
        }
    }
}

static item_span span_of_triangles(const lmb_bvh_triangle *t, uint32_t count)
{
    item_span s = span_none();
    for (uint32_t i = 0; i < 3 * count; ++i) {
        const lmb_vec3 p = t[i / 3].corner[i % 3];
        const item_span one = {{p.x, p.y, p.z, 0.0f}, {p.x, p.y, p.z, 0.0f}};
        span_join(&s, one);
    }
    return s;
}

static item_span span_of_node(const lmb_boxes *node)
{
    item_span s = span_none();
    for (int i = 0; i < LMB_BOXES; ++i) {
        const item_span one = {{node->low[0][i], node->low[1][i], node->low[2][i], 0.0f},
                               {node->high[0][i], node->high[1][i], node->high[2][i], 0.0f}};
        span_join(&s, one);
    }
    return s;
}

/* Fills node `at` with up to sixteen leaves, or with nodes of the level below; `part`: its number on its level. Leaves
 * have four triangles. Returns half the area of the leaves. */
static float fill_in_order(lmb_bvh *b, uint32_t at, uint32_t part, int is_last, uint32_t below, uint32_t below_count)
{
    float area = 0.0f;
    for (uint32_t i = 0; i < LMB_BOXES; ++i) {
        const uint32_t k = part * LMB_BOXES + i, first = is_last ? k * MAX_LEAF_TRIANGLES : below + k;
        run r = {{{0}, {0}}, 0.0f, first, 0, 0};
        if (k >= below_count) {
            set_no_box(&b->node[at], (int)i);
            continue;
        }
        if (is_last) {
            r.count = b->triangle_count - first < MAX_LEAF_TRIANGLES ? b->triangle_count - first : MAX_LEAF_TRIANGLES;
            r.box = span_of_triangles(b->triangle + first, r.count);
            area += half_area(&r.box);
        } else {
            r.box = span_of_node(&b->node[first]);
        }
        set_run_box(&b->node[at], (int)i, &r);
    }
    return area;
}

static uint32_t sixteenths(uint32_t n) { return (n + LMB_BOXES - 1) / LMB_BOXES; }

int lmb_bvh_build_in_order(lmb_bvh *inout, const lmb_scene *scene)
{
    uint32_t many[LMB_TRAVERSAL_LEVELS + 1], levels = 1; /* nodes of a level, from the last one up to the root */
    float area = 0.0f;
    inout->node_count = inout->triangle_count = 0;
    inout->margin = inout->noise = 0.0f;
    inout->hull.count = 0;
    inout->scene = scene;
    if (lmb_scene_triangles(scene) > inout->triangle_cap) {
        return 1;
    }
    take_in_order(inout, scene);
    if (inout->triangle_count == 0) {
        return 1;
    }
    const uint32_t leaves = (inout->triangle_count + MAX_LEAF_TRIANGLES - 1) / MAX_LEAF_TRIANGLES;
    for (many[0] = sixteenths(leaves); many[levels - 1] > 1; ++levels) {
        many[levels] = sixteenths(many[levels - 1]);
    }
    for (uint32_t i = 0; i < levels; ++i) {
        inout->node_count += many[i];
    }
    uint32_t from = inout->node_count, below = 0;
    for (uint32_t i = 0; i < levels; ++i) {
        from -= many[i];
        for (uint32_t k = 0; k < many[i]; ++k) {
            area += fill_in_order(inout, from + k, k, i == 0, below, i == 0 ? leaves : many[i - 1]);
        }
        below = from;
    }
    const item_span all = span_of_node(inout->node);
    inout->margin = half_box_margin(vec3(all.low[0], all.low[1], all.low[2]),
                                    vec3(all.high[0], all.high[1], all.high[2]));
    return area <= MAX_ORDERED_AREA * half_area(&all);
}

#endif

#endif
