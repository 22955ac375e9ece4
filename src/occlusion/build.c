/* build.c: builds the BVH of a scene's triangles, sixteen boxes a node, in the caller's arrays. Layer 4.
 *
 * Top down, in place: a node's triangles are cut in two where the surface-area heuristic over 16 bins of their middles
 * says (Wald 2007), then the part with the largest surface again, until there are sixteen. Below a depth that only
 * hostile scenes reach cuts go by halves, so that the depth is bounded. */
#include <lambent/occlusion.h>

#include <string.h>

#include "../base/memory_check.h"
#include "../base/vec.h"
#include "../raster/triangle.h"
#include "traversal.h"

#if LMB_TREES

enum { BINS = 16, LEAF = 4, HALVES_FROM = LMB_TRAVERSAL_LEVELS - 8 };

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

/* --- triangles ---------------------------------------------------------------------------------------------------- */

/* 1 where the triangle can block. */
static int take_triangle(lmb_bvh_triangle *out, const lmb_triangle *t)
{
    float area;
    memcpy(out->corner, t->corner, sizeof out->corner);
    out->id = t->id | (t->material->flags & LMB_ALPHA_MASK ? LMB_BVH_MASKED : 0);
    return lmb_triangle_shape(&out->normal, &area, t);
}

static void take_triangles(lmb_bvh *inout, const lmb_scene *scene)
{
    const uint32_t all = lmb_scene_triangles(scene);
    lmb_triangle t;
    inout->triangle_count = 0;
    for (uint32_t id = 1; id <= all; ++id) {
        lmb_bvh_triangle *b = &inout->triangle[inout->triangle_count];
        if (lmb_triangle_fetch(&t, scene, id) && take_triangle(b, &t)) {
            ++inout->triangle_count;
        }
    }
}

/* --- boxes -------------------------------------------------------------------------------------------------------- */

static float axis3(lmb_vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

typedef struct span {
    lmb_vec3 low, high;
} span;

static span span_none(void)
{
    span s;
    s.low = vec3(3e38f, 3e38f, 3e38f);
    s.high = vec3(-3e38f, -3e38f, -3e38f);
    return s;
}

static span span_join(span a, span b)
{
    a.low = min3(a.low, b.low);
    a.high = max3(a.high, b.high);
    return a;
}

static span span_of(const lmb_bvh_triangle *t)
{
    span s;
    s.low = min3(min3(t->corner[0], t->corner[1]), t->corner[2]);
    s.high = max3(max3(t->corner[0], t->corner[1]), t->corner[2]);
    return s;
}

static float half_area(const span *s)
{
    lmb_vec3 d = sub3(s->high, s->low);
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

/* Twice a triangle's middle. */
static lmb_vec3 middle(const lmb_bvh_triangle *t)
{
    span s = span_of(t);
    return add3(s.low, s.high);
}

/* Where middles fall into bins along an axis. */
typedef struct binning {
    float low, per_bin; /* bins a metre; 0: all in one place */
    int axis;
} binning;

static int bin_of(const binning *b, const lmb_bvh_triangle *t)
{
    return mini((int)((axis3(middle(t), b->axis) - b->low) * b->per_bin), BINS - 1);
}

static binning binning_of(const span *middles, int axis)
{
    binning b;
    const float wide = axis3(middles->high, axis) - axis3(middles->low, axis);
    b.axis = axis;
    b.low = axis3(middles->low, axis);
    b.per_bin = wide > 1e-30f ? (float)BINS * 0.9999f / wide : 0.0f;
    return b;
}

/* The best cut along one axis: triangles of bins below `bin` to the left. Cost: areas x triangles; 3e38: none. */
typedef struct cut {
    binning bins;
    int bin;
    float cost;
} cut;

static cut best_cut(const binning *bins, const lmb_bvh_triangle *t, uint32_t count)
{
    span box[BINS], right[BINS], left = span_none();
    uint32_t in[BINS] = {0}, below = 0;
    cut best;
    best.bins = *bins;
    best.bin = 0;
    best.cost = 3e38f;
    for (int i = 0; i < BINS; ++i) {
        box[i] = span_none();
    }
    for (uint32_t i = 0; i < count; ++i) {
        const int bin = bin_of(bins, &t[i]);
        box[bin] = span_join(box[bin], span_of(&t[i]));
        ++in[bin];
    }
    right[BINS - 1] = box[BINS - 1];
    for (int i = BINS - 2; i >= 0; --i) {
        right[i] = span_join(right[i + 1], box[i]);
    }
    for (int i = 1; i < BINS; ++i) {
        left = span_join(left, box[i - 1]);
        below += in[i - 1];
        if (below > 0 && below < count) {
            const float cost = half_area(&left) * (float)below + half_area(&right[i]) * (float)(count - below);
            if (cost < best.cost) {
                best.cost = cost;
                best.bin = i;
            }
        }
    }
    return best;
}

/* Triangles below the cut first; how many. */
static uint32_t part(lmb_bvh_triangle *t, uint32_t count, const cut *c)
{
    uint32_t below = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (bin_of(&c->bins, &t[i]) < c->bin) {
            const lmb_bvh_triangle swap = t[i];
            t[i] = t[below];
            t[below++] = swap;
        }
    }
    return below;
}

/* The best cut of a node's triangles; cost 3e38: all lie in one place. */
static cut find_cut(const lmb_bvh_triangle *t, uint32_t count)
{
    span middles = span_none();
    cut best;
    memset(&best, 0, sizeof best);
    best.cost = 3e38f;
    for (uint32_t i = 0; i < count; ++i) {
        const lmb_vec3 m = middle(&t[i]);
        middles.low = min3(middles.low, m);
        middles.high = max3(middles.high, m);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const binning bins = binning_of(&middles, axis);
        if (bins.per_bin > 0.0f) {
            const cut c = best_cut(&bins, t, count);
            best = c.cost < best.cost ? c : best;
        }
    }
    return best;
}

/* --- nodes -------------------------------------------------------------------------------------------------------- */

/* Triangles that lie together. */
typedef struct run {
    span box;
    uint32_t first, count;
    int whole; /* no cut of it pays */
} run;

static run run_of(const lmb_bvh_triangle *t, uint32_t first, uint32_t count)
{
    run r;
    r.box = span_none();
    r.first = first;
    r.count = count;
    r.whole = count == 1;
    for (uint32_t i = 0; i < count; ++i) {
        r.box = span_join(r.box, span_of(&t[first + i]));
    }
    return r;
}

/* Cut a run in two, the second into *more; 0 where that does not pay. */
static int cut_run(lmb_bvh *b, run *r, run *more, int depth)
{
    lmb_bvh_triangle *t = b->triangle + r->first;
    const run old = *r;
    cut best;
    best.cost = 3e38f;
    if (depth < HALVES_FROM) {
        best = find_cut(t, r->count);
    }
    /* Asking a box costs about what asking a triangle does. */
    if (r->count <= LEAF && !(best.cost + half_area(&r->box) < half_area(&r->box) * (float)r->count)) {
        r->whole = 1;
        return 0;
    }
    const uint32_t below = best.cost < 3e38f ? part(t, r->count, &best) : r->count / 2;
    *r = run_of(b->triangle, old.first, below);
    *more = run_of(b->triangle, old.first + below, old.count - below);
    return 1;
}

/* The run to cut next: the largest box; or -1. */
static int largest_run(const run *r, int count)
{
    int best = -1;
    for (int i = 0; i < count; ++i) {
        if (!r[i].whole && (best < 0 || half_area(&r[best].box) < half_area(&r[i].box))) {
            best = i;
        }
    }
    return best;
}

static void set_box(lmb_boxes *node, int i, const run *r)
{
    const float size = largest3(sub3(r->box.high, r->box.low)),
                place = maxf(largest3(r->box.low), largest3(r->box.high)),
                wide = r->count > 0 ? LMB_BOX_SIZE * size + LMB_BOX_PLACE * place : 0.0f;
    const lmb_vec3 low = sub3(r->box.low, vec3(wide, wide, wide)), high = add3(r->box.high, vec3(wide, wide, wide));
    node->low[0][i] = low.x;
    node->low[1][i] = low.y;
    node->low[2][i] = low.z;
    node->high[0][i] = high.x;
    node->high[1][i] = high.y;
    node->high[2][i] = high.z;
    node->first[i] = r->first;
    node->count[i] = r->count;
}

/* Fill a node with the triangles first .. first + count - 1 as up to sixteen leaves. */
static void fill_node(lmb_bvh *b, uint32_t at, uint32_t first, uint32_t count, int depth)
{
    run r[LMB_BOXES];
    int runs = 1, next;
    r[0] = run_of(b->triangle, first, count);
    while (runs < LMB_BOXES && (next = largest_run(r, runs)) >= 0) {
        runs += cut_run(b, &r[next], &r[runs], depth);
    }
    for (int i = 0; i < LMB_BOXES; ++i) {
        if (i < runs) {
            set_box(&b->node[at], i, &r[i]);
        } else {
            const run none = {span_none(), 0, 0, 1};
            set_box(&b->node[at], i, &none);
        }
    }
}

/* A node on the traversal stack, with the set of its inner children that are still to be visited: box i is bit
 * LMB_BOXES - 1 - i. */
typedef struct branch {
    uint32_t node, children;
} branch;

/* Leaves of a node that are too large become nodes, on level `deep`. */
static branch branch_at(lmb_bvh *b, uint32_t at, int deep)
{
    lmb_boxes *node = &b->node[at];
    branch out = {at, 0};
    for (int i = 0; i < LMB_BOXES; ++i) {
        if (node->count[i] > LEAF && b->node_count < b->node_cap && deep < LMB_TRAVERSAL_LEVELS) {
            const uint32_t child = b->node_count++;
            fill_node(b, child, node->first[i], node->count[i], deep);
            node->first[i] = child;
            node->count[i] = 0;
            out.children |= 1u << (LMB_BOXES - 1 - i);
        }
    }
    return out;
}

/* Depth first, the last child before the others. */
static void grow(lmb_bvh *b)
{
    branch way[LMB_TRAVERSAL_LEVELS];
    int depth = 0;
    way[0] = branch_at(b, 0, 1);
    while (depth >= 0) {
        branch *up = &way[depth];
        if (up->children == 0) {
            --depth;
        } else {
            const int i = LMB_BOXES - 1 - lowest_bit(up->children);
            up->children &= up->children - 1;
            ++depth;
            way[depth] = branch_at(b, b->node[up->node].first[i], depth + 1);
        }
    }
}

lmb_status lmb_bvh_build(lmb_bvh *inout, const lmb_scene *scene)
{
    if (inout == NULL || inout->triangle == NULL || inout->node == NULL || scene == NULL) {
        return LMB_ERR_ARG;
    }
    inout->node_count = inout->triangle_count = 0;
    inout->hull.count = 0;
    inout->scene = scene;
    if (lmb_scene_triangles(scene) > inout->triangle_cap) {
        return LMB_ERR_CAPACITY;
    }
    take_triangles(inout, scene);
    if (inout->triangle_count > 0) {
        fill_node(inout, 0, 0, inout->triangle_count, 0);
        inout->node_count = 1;
        grow(inout);
    }
    lmb_hull_find(&inout->hull, scene);
    inout->noise = inout->hull.count > 0 ? 4.0f * inout->hull.slack : 0.0f;
    inout->hull.count = LMB_PLAN ? inout->hull.count : 0;
    return LMB_OK;
}

#endif
