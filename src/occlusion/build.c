/* build.c: a scene's triangles -> a tree of boxes, in the caller's arrays. Floor 4.
 *
 * Top down, in place: a node's triangles are cut where the surface-area heuristic over 16 bins of their middles says
 * (Wald 2007); below a depth that only hostile scenes reach, by halves, so that the depth is bounded. */
#include <lambent/occlusion.h>

#include <string.h>

#include "../base/vec.h"
#include "../raster/triangle.h"
#include "walk.h"

enum { BINS = 16, LEAF = 4, HALVES_FROM = LMB_WALK_DEPTH - 32 };
#define NOISE 3.8146973e-6f /* 2^-18 of the largest coordinate: some rounding steps of positions and planes */

size_t lmb_blockers_bytes(uint32_t n)
{
    const size_t each = sizeof(lmb_blocker) + 2 * sizeof(lmb_box);
    return n == 0 || n > ((size_t)-1) / each ? 0 : n * each;
}

lmb_status lmb_blockers_init(lmb_blockers *out, uint32_t n, void *memory, size_t bytes)
{
    if (out == NULL || memory == NULL || n == 0 || n > LMB_MAX_TRIANGLES / 2) {
        return LMB_ERR_ARG;
    }
    if ((uintptr_t)memory % 4 != 0) {
        return LMB_ERR_ALIGN;
    }
    if (lmb_blockers_bytes(n) == 0 || bytes < lmb_blockers_bytes(n)) {
        return LMB_ERR_CAPACITY;
    }
    memset(out, 0, sizeof *out);
    out->node = (lmb_box *)memory;
    out->triangle = (lmb_blocker *)(void *)(out->node + 2 * (size_t)n);
    out->triangle_cap = n;
    return LMB_OK;
}

/* --- triangles ------------------------------------------------------------------------------------------------------ */

static float largest3(lmb_vec3 v) { return maxf(maxf(absf(v.x), absf(v.y)), absf(v.z)); }

/* 1 where the triangle can block. */
static int take_triangle(lmb_blocker *out, const lmb_triangle *t)
{
    lmb_vec3 n = cross3(sub3(t->corner[1], t->corner[0]), sub3(t->corner[2], t->corner[0]));
    for (int i = 0; i < 3; ++i) {
        if (!is_sane(t->corner[i].x) || !is_sane(t->corner[i].y) || !is_sane(t->corner[i].z)) {
            return 0;
        }
        out->corner[i] = t->corner[i];
    }
    const float longest = largest3(n);
    if (!(longest > 1e-18f)) {
        return 0; /* its square would be no normal number: a speck that no pixel's segment meets */
    }
    out->normal = normalize3(mul3(n, 1.0f / longest));
    out->id = t->id | (t->material->flags & LMB_ALPHA_MASK ? LMB_BLOCKER_MASKED : 0);
    return 1;
}

static void take_triangles(lmb_blockers *inout, const lmb_scene *scene)
{
    const uint32_t all = lmb_scene_triangles(scene);
    float largest = 0.0f;
    lmb_triangle t;
    inout->triangle_count = 0;
    for (uint32_t id = 1; id <= all; ++id) {
        lmb_blocker *b = &inout->triangle[inout->triangle_count];
        if (lmb_triangle_fetch(&t, scene, id) && take_triangle(b, &t)) {
            for (int i = 0; i < 3; ++i) {
                largest = maxf(largest, largest3(b->corner[i]));
            }
            ++inout->triangle_count;
        }
    }
    inout->noise = largest * NOISE;
}

/* --- boxes ---------------------------------------------------------------------------------------------------------- */

static float axis3(lmb_vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
static lmb_vec3 min3(lmb_vec3 a, lmb_vec3 b) { return vec3(minf(a.x, b.x), minf(a.y, b.y), minf(a.z, b.z)); }
static lmb_vec3 max3(lmb_vec3 a, lmb_vec3 b) { return vec3(maxf(a.x, b.x), maxf(a.y, b.y), maxf(a.z, b.z)); }

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

static span span_of(const lmb_blocker *t)
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
static lmb_vec3 middle(const lmb_blocker *t)
{
    span s = span_of(t);
    return add3(s.low, s.high);
}

/* Where middles fall into bins along an axis. */
typedef struct binning {
    float low, per_bin; /* bins a metre; 0: all in one place */
    int axis;
} binning;

static int bin_of(const binning *b, const lmb_blocker *t)
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

static cut best_cut(const binning *bins, const lmb_blocker *t, uint32_t count)
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
static uint32_t part(lmb_blocker *t, uint32_t count, const cut *c)
{
    uint32_t below = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (bin_of(&c->bins, &t[i]) < c->bin) {
            const lmb_blocker swap = t[i];
            t[i] = t[below];
            t[below++] = swap;
        }
    }
    return below;
}

static void make_leaf(lmb_blockers *b, uint32_t at, uint32_t first, uint32_t count)
{
    span s = span_none();
    for (uint32_t i = 0; i < count; ++i) {
        s = span_join(s, span_of(&b->triangle[first + i]));
    }
    b->node[at].low = sub3(s.low, vec3(b->noise, b->noise, b->noise));
    b->node[at].high = add3(s.high, vec3(b->noise, b->noise, b->noise));
    b->node[at].first = first;
    b->node[at].count = count;
}

/* The best cut of a node's triangles; cost 3e38: all lie in one place. */
static cut find_cut(const lmb_blocker *t, uint32_t count)
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

/* Cut a leaf in two, where that pays; 1 where it was. */
static int divide(lmb_blockers *b, uint32_t at, int depth)
{
    lmb_box *node = &b->node[at];
    lmb_blocker *t = b->triangle + node->first;
    const uint32_t first = node->first, count = node->count, two = b->node_count;
    span whole;
    cut best;
    if (count == 1) {
        return 0;
    }
    whole.low = node->low;
    whole.high = node->high;
    best.cost = 3e38f;
    if (depth < HALVES_FROM) {
        best = find_cut(t, count);
    }
    /* Asking a box costs about what asking a triangle does. */
    if (count <= LEAF && !(best.cost + half_area(&whole) < half_area(&whole) * (float)count)) {
        return 0;
    }
    const uint32_t below = best.cost < 3e38f ? part(t, count, &best) : count / 2;
    b->node_count += 2;
    make_leaf(b, two, first, below);
    make_leaf(b, two + 1, first + below, count - below);
    node->first = two;
    node->count = 0;
    return 1;
}

static void divide_all(lmb_blockers *b)
{
    uint32_t waiting[LMB_WALK_DEPTH];
    uint8_t depth[LMB_WALK_DEPTH];
    int count = 1;
    waiting[0] = 0;
    depth[0] = 0;
    while (count > 0) {
        const uint32_t at = waiting[--count];
        const uint8_t deep = depth[count];
        if (divide(b, at, deep)) {
            for (uint32_t i = 0; i < 2; ++i) {
                waiting[count] = b->node[at].first + 1 - i;
                depth[count++] = (uint8_t)(deep + 1);
            }
        }
    }
}

lmb_status lmb_blockers_build(lmb_blockers *inout, const lmb_scene *scene)
{
    if (inout == NULL || inout->triangle == NULL || inout->node == NULL || scene == NULL) {
        return LMB_ERR_ARG;
    }
    inout->node_count = inout->triangle_count = 0;
    inout->scene = scene;
    if (lmb_scene_triangles(scene) > inout->triangle_cap) {
        return LMB_ERR_CAPACITY;
    }
    take_triangles(inout, scene);
    if (inout->triangle_count > 0) {
        make_leaf(inout, 0, 0, inout->triangle_count);
        inout->node_count = 1;
        divide_all(inout);
    }
    return LMB_OK;
}
