/* occluded.c: a tile's segments to one point, traced through the BVH together. Layer 4. [V25] */
#include <lambent/occlusion.h>

#include <stddef.h>

#include "../base/vec.h"
#include "../lane/kernels.h"
#include "../raster/resolve.h"
#include "../raster/tile.h"
#include "traversal.h"

#if LMB_TREES

/* Number of leaves tested against the pyramid of all segments. Further leaves are tested against each segment, because
 * in a fine mesh most segments pass between triangles. */
#define BY_PYRAMID  4
#define READ_MASKED 2u    /* tests that reading a triangle with holes costs, beside one for each pixel that meets it */

static void pyramid_axis(lmb_pyramid *out, int axis, float at, float low, float high)
{
    const float d1 = high - at, d0 = low - at;
    out->at[axis] = at;
    out->per_high[axis] = 1.0f / (absf(d1) < MIN_PYRAMID_M ? MIN_PYRAMID_M : d1);
    out->per_low[axis] = 1.0f / (absf(d0) < MIN_PYRAMID_M ? -MIN_PYRAMID_M : d0);
}

static lmb_pyramid pyramid_of(const lmb_tile *tile, uint64_t pixels, lmb_vec3 at)
{
    lmb_vec3 low, high;
    lmb_pyramid p;
    tile_box(&low, &high, tile, pixels);
    pyramid_axis(&p, 0, at.x, low.x, high.x);
    pyramid_axis(&p, 1, at.y, low.y, high.y);
    pyramid_axis(&p, 2, at.z, low.z, high.z);
    return p;
}

float lmb_place_noise(lmb_vec3 at, float distance)
{
    return LMB_NOISE_PLACE * largest3(at) + LMB_NOISE_DISTANCE * distance;
}

float lmb_tile_noise(const lmb_tile *tile, uint64_t pixels)
{
    float noise = 0.0f;
    for (uint64_t bits = tile != NULL ? pixels : 0; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        noise = maxf(noise, lmb_place_noise(tile_vec(tile->position, k), absf(tile->depth[k])));
    }
    return noise;
}

/* The plane through the point and two corners: 2 (b x c), computed without the product of two nearly equal vectors,
 * which would cancel for a small edge far away. Swapping the corners negates the result exactly. */
static inline lmb_vec3 edge_plane_towards(lmb_vec3 b, lmb_vec3 c, lmb_vec3 edge) { return cross3(add3(b, c), edge); }

/* A triangle as seen from the point. noise: of both ends; kept: has the eye, or NULL. Returns 0 if the point lies in
 * the triangle's plane. */
static int cross_job(lmb_cross_job *out, const lmb_bvh_triangle *t, lmb_vec3 at, float noise, float min,
                     const lmb_traversal *kept)
{
    const lmb_vec3 *p = t->corner;
    const lmb_vec3 a = sub3(p[0], at), b = sub3(p[1], at), c = sub3(p[2], at);
    const float ahead = dot3(t->normal, a);
    noise = maxf(noise + LMB_NOISE_TRIANGLE * sqrtf(dot3(a, a) + dot3(b, b) + dot3(c, c)), min);
    if (!(absf(ahead) > noise)) {
        return 0;
    }
    out->at = at;
    if (ahead < 0.0f) {
        out->edge[0] = edge_plane_towards(b, c, sub3(p[1], p[2]));
        out->edge[1] = edge_plane_towards(c, a, sub3(p[2], p[0]));
        out->edge[2] = edge_plane_towards(a, b, sub3(p[0], p[1]));
        out->normal = mul3(t->normal, -1.0f);
    } else {
        out->edge[0] = edge_plane_towards(b, c, sub3(p[2], p[1]));
        out->edge[1] = edge_plane_towards(c, a, sub3(p[0], p[2]));
        out->edge[2] = edge_plane_towards(a, b, sub3(p[1], p[0]));
        out->normal = t->normal;
    }
    out->beyond = absf(ahead) + noise;
    out->slack = 0.0f;
    if (kept != NULL && eye_is_across(kept, t->normal, p[0], -ahead)) {
        const lmb_vec3 *e = out->edge;
        const float wider = minf(noise, triangle_margin(t));
        out->beyond = absf(ahead) - wider;
        out->slack = wider * sqrtf(maxf(maxf(dot3(e[0], e[0]), dot3(e[1], e[1])), dot3(e[2], e[2])));
    }
    return 1;
}

/* Returns 0 if there is no such triangle. */
NOINLINE int alpha_of_masked(lmb_resolve_alpha *out, const lmb_bvh *b, uint32_t id)
{
    lmb_triangle triangle;
    if (!lmb_triangle_fetch(&triangle, b->scene, id)) {
        return 0;
    }
    lmb_resolve_alpha_of(out, &triangle);
    return 1;
}

/* Returns those pixels with segments across a triangle with holes that hit an opaque part. */
static uint64_t opaque_pixels(const lmb_bvh *b, const lmb_bvh_triangle *t, const lmb_cross_job *job,
                              const lmb_tile *tile, uint64_t crossed)
{
    uint64_t out = 0;
    lmb_resolve_alpha alpha;
    if (!alpha_of_masked(&alpha, b, t->id & ~LMB_BVH_MASKED)) {
        return 0;
    }
    for (uint64_t bits = crossed; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 d = sub3(tile_vec(tile->position, k), job->at);
        const float e0 = dot3(job->edge[0], d), e1 = dot3(job->edge[1], d), e2 = dot3(job->edge[2], d);
        const float sum = e0 + e1 + e2;
        if (sum > 0.0f && lmb_resolve_opaque(&alpha, b->scene, e1 / sum, e2 / sum)) {
            out |= (uint64_t)1 << k;
        }
    }
    return out;
}

/* One traversal. */
typedef struct tile_traversal {
    const lmb_bvh *b;
    const lmb_kernels *kernels;
    const lmb_tile *tile;
    lmb_vec3 at;
    float noise; /* of both ends */
    lmb_traversal *kept;
    uint64_t left; /* pixels not blocked so far */
    uint32_t *own; /* by pixel: the triangle that blocked it last, as in kept->last; or NULL */
} tile_traversal;

/* Notes the triangle, as in kept->last, that blocks pixels. */
static void keep_own(const tile_traversal *w, uint64_t blocked, uint32_t triangle)
{
    for (uint64_t bits = w->own != NULL ? blocked : 0; bits != 0; bits &= bits - 1) {
        w->own[lowest_bit_64(bits)] = triangle;
    }
}

/* As standing(), and counts the cost: READ_MASKED tests for the triangle, and one for each pixel. */
static uint64_t test_holes(tile_traversal *w, const lmb_bvh_triangle *t, const lmb_cross_job *job, uint64_t crossed)
{
    w->kept->spent += READ_MASKED + (uint32_t)count_bits_64(crossed);
    return opaque_pixels(w->b, t, job, w->tile, crossed);
}

/* Clears the pixels of `asked` that one triangle blocks. */
static void test_blocking_triangle(tile_traversal *w, uint32_t triangle, uint64_t asked)
{
    const lmb_bvh_triangle *t = &w->b->triangle[triangle];
    lmb_cross_job job;
    if (cross_job(&job, t, w->at, w->noise, w->b->noise, w->kept)) {
        const uint64_t crossed = w->kernels->crossed(w->tile, w->left & asked, &job);
        const uint64_t blocked = crossed != 0 && (t->id & LMB_BVH_MASKED) ? test_holes(w, t, &job, crossed) : crossed;
        w->left &= ~blocked;
        keep_own(w, blocked, triangle + 1);
        w->kept->blocker = crossed != 0 ? triangle + 1 : w->kept->blocker;
    }
}

/* Tests the last occluders. Returns 1 if they block all pixels. */
static int test_last(tile_traversal *w)
{
    for (int i = 0; i < LMB_LAST_OCCLUDERS && w->kept->last[i] != 0; ++i) {
        const uint32_t triangle = w->kept->last[i] - 1;
        test_blocking_triangle(w, triangle, w->left);
        if (w->left == 0) {
            traversal_remember(w->kept->last, LMB_LAST_OCCLUDERS, triangle);
            return 1;
        }
    }
    return 0;
}

static void test_boxes_leaf(tile_traversal *w, const lmb_boxes *node, int i, uint64_t asked)
{
    for (uint32_t k = 0; k < node->count[i] && (w->left & asked) != 0 && !traversal_is_over(w->kept); ++k) {
        const uint64_t before = w->left;
        ++w->kept->spent;
        test_blocking_triangle(w, node->first[i] + k, asked);
        if (count_bits_64(before & ~w->left) >= MIN_BLOCKED_PIXELS) {
            traversal_remember(w->kept->last, LMB_LAST_OCCLUDERS, node->first[i] + k);
        }
    }
}

/* All segments of the tile to one point. */
typedef struct rays {
    lmb_pyramid pyramid;
    int leaves; /* leaves tested so far; above BY_PYRAMID each segment is tested */
} rays;

/* A node with tested leaves, and the children still to visit: box i is bit LMB_BOXES - 1 - i. */
typedef struct tile_branch {
    uint32_t node, children;
} tile_branch;

static uint32_t test_boxes(tile_traversal *w, rays *r, const lmb_boxes *node)
{
    uint32_t children = 0;
    ++w->kept->asked;
    ++w->kept->spent;
    for (uint32_t bits = w->kernels->meets(&r->pyramid, node); bits != 0 && w->left != 0; bits &= bits - 1) {
        const int i = lowest_bit(bits);
        uint64_t here = w->left;
        if (node->count[i] == 0) {
            children |= 1u << (LMB_BOXES - 1 - i);
            continue;
        }
        ++w->kept->asked;
        ++w->kept->spent;
        if (++r->leaves > BY_PYRAMID) {
            if (r->leaves == BY_PYRAMID + 1) {
                w->kernels->segments(&w->kept->segments, w->tile, w->at);
            }
            here = w->kernels->through(&w->kept->segments, here, node, i);
        }
        test_boxes_leaf(w, node, i, here);
    }
    return children;
}

/* Traces the remaining pixels with one pyramid. Returns 0 if that takes over `limit` boxes: some may still be
 * blocked. */
static int trace_together(tile_traversal *w, uint32_t limit)
{
    const lmb_bvh *bvh = w->b;
    const uint32_t before = w->kept->asked;
    tile_branch waiting[LMB_TRAVERSAL_LEVELS];
    rays r;
    int count = 0;
    uint32_t here = 0;
    r.pyramid = pyramid_of(w->tile, w->left, w->at);
    r.leaves = 0;
    for (;;) {
        waiting[count].node = here;
        waiting[count].children = test_boxes(w, &r, &bvh->node[here]);
        count += waiting[count].children != 0;
        if (count == 0 || w->left == 0) {
            return 1;
        }
        if (w->kept->asked - before > limit || traversal_is_over(w->kept)) {
            return 0;
        }
        tile_branch *up = &waiting[count - 1];
        here = bvh->node[up->node].first[LMB_BOXES - 1 - lowest_bit(up->children)];
        up->children &= up->children - 1;
        count -= up->children == 0;
    }
}

/* One pixel's segment. */
typedef struct ray {
    lmb_segment segment;
    lmb_vec3 d; /* from the point to the pixel */
} ray;

static void ray_axis(lmb_segment *out, float *per, int axis, float d)
{
    enum { HIGH_OFFSET = (int)(offsetof(lmb_boxes, high) / sizeof(float)) };
    const int back = d < 0.0f;
    *per = 1.0f / (absf(d) < MIN_PYRAMID_M ? back ? -MIN_PYRAMID_M : MIN_PYRAMID_M : d);
    out->enter[axis] = axis * LMB_BOXES + (back ? HIGH_OFFSET : 0);
    out->leave[axis] = axis * LMB_BOXES + (back ? 0 : HIGH_OFFSET);
}

static ray ray_of(const lmb_tile *tile, int k, lmb_vec3 at)
{
    ray r;
    r.d = sub3(tile_vec(tile->position, k), at);
    r.segment.at = at;
    ray_axis(&r.segment, &r.segment.per.x, 0, r.d.x);
    ray_axis(&r.segment, &r.segment.per.y, 1, r.d.y);
    ray_axis(&r.segment, &r.segment.per.z, 2, r.d.z);
    return r;
}

/* The same result as the kernel `crossed`, bit for bit. */
static int crosses(const lmb_cross_job *job, lmb_vec3 d)
{
    const float min = minf(minf(dot3(job->edge[0], d), dot3(job->edge[1], d)), dot3(job->edge[2], d));
    return 0.0f - job->slack <= min && job->beyond < dot3(job->normal, d);
}

/* 1 if a triangle blocks this one pixel, at d from the point. Bit by bit the result of `crossed`, with the cheapest
 * test first: the plane of a reversed edge is exactly negated. */
static int blocks_one(tile_traversal *w, uint32_t triangle, lmb_vec3 d)
{
    const lmb_bvh_triangle *t = &w->b->triangle[triangle];
    const lmb_vec3 *p = t->corner;
    const lmb_vec3 a = sub3(p[0], w->at), b = sub3(p[1], w->at), c = sub3(p[2], w->at);
    const float ahead = dot3(t->normal, a), side = ahead < 0.0f ? -1.0f : 1.0f, past = side * dot3(t->normal, d);
    lmb_cross_job job;
    if (eye_is_across(w->kept, t->normal, p[0], -ahead)) {
        return 0.0f < past && cross_job(&job, t, w->at, w->noise, w->b->noise, w->kept) &&
               crosses(&job, d) &&
               (!(t->id & LMB_BVH_MASKED) || test_holes(w, t, &job, w->left) != 0);
    }
    return absf(ahead) < past && 0.0f <= side * dot3(edge_plane_towards(b, c, sub3(p[2], p[1])), d) &&
           0.0f <= side * dot3(edge_plane_towards(c, a, sub3(p[0], p[2])), d) &&
           0.0f <= side * dot3(edge_plane_towards(a, b, sub3(p[1], p[0])), d) &&
           cross_job(&job, t, w->at, w->noise, w->b->noise, w->kept) && job.beyond < past &&
           (!(t->id & LMB_BVH_MASKED) || test_holes(w, t, &job, w->left) != 0);
}

/* Tests the leaves of a node that the segment meets. Returns 1 if one blocks. *children: boxes that are nodes. */
static int node_blocks_one(uint32_t *children, tile_traversal *w, const lmb_boxes *node, const ray *r)
{
    *children = 0;
    ++w->kept->asked;
    ++w->kept->spent;
    for (uint32_t bits = w->kernels->meets_one(&r->segment, node); bits != 0; bits &= bits - 1) {
        const int i = lowest_bit(bits);
        if (node->count[i] == 0) {
            *children |= 1u << (LMB_BOXES - 1 - i);
            continue;
        }
        ++w->kept->asked;
        ++w->kept->spent;
        for (uint32_t j = 0; j < node->count[i] && !traversal_is_over(w->kept); ++j) {
            ++w->kept->spent;
            if (blocks_one(w, node->first[i] + j, r->d)) {
                w->kept->blocker = node->first[i] + j + 1;
                return 1;
            }
        }
    }
    return 0;
}

static int one_blocked(tile_traversal *w, int k)
{
    tile_branch waiting[LMB_TRAVERSAL_LEVELS];
    int count = 0;
    uint32_t here = 0;
    const ray r = ray_of(w->tile, k, w->at);
    for (;;) {
        waiting[count].node = here;
        if (node_blocks_one(&waiting[count].children, w, &w->b->node[here], &r)) {
            return 1;
        }
        count += waiting[count].children != 0;
        if (count == 0 || traversal_is_over(w->kept)) {
            return 0;
        }
        tile_branch *up = &waiting[count - 1];
        here = w->b->node[up->node].first[LMB_BOXES - 1 - lowest_bit(up->children)];
        up->children &= up->children - 1;
        count -= up->children == 0;
    }
}

/* Tests the triangle that blocked each pixel last. */
static void test_own(tile_traversal *w)
{
    uint64_t seen = w->left;
    for (uint64_t bits = w->own != NULL ? seen : 0; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 d = sub3(tile_vec(w->tile->position, k), w->at);
        w->left = bits & (~bits + 1);
        seen &= ~(w->own[k] != 0 && w->own[k] <= w->b->triangle_count && blocks_one(w, w->own[k] - 1, d) ? w->left : 0);
    }
    w->left = seen;
}

static uint64_t trace(tile_traversal *w)
{
    lmb_traversal *kept = w->kept;
    const uint64_t pixels = w->left;
    uint64_t occluded = 0;
    test_own(w);
    if (kept->first != 0) {
        test_blocking_triangle(w, kept->first - 1, pixels);
    }
    if (w->left == 0) {
        return pixels;
    }
    if (count_bits_64(w->left) > MAX_SINGLE_PIXELS) {
        if (test_last(w)) {
            return pixels;
        }
        if (kept->alone > 0) {
            --kept->alone;
        } else if (trace_together(w, MAX_BOXES_A_PIXEL * (uint32_t)count_bits_64(pixels))) {
            return pixels & ~w->left;
        } else {
            kept->alone = SINGLE_POINTS;
        }
    }
    occluded = pixels & ~w->left;
    uint32_t boxes = 0;
    int misses = 0;
    for (uint64_t bits = w->left; bits != 0 && !traversal_is_over(kept);) {
        const uint64_t now = boxes > LMB_MANY_BOXES ? bits : bits & (~bits + 1);
        const uint32_t before = kept->asked;
        w->left = now;
        if ((now & (now - 1)) != 0) {
            (void)trace_together(w, ~0u);
        } else if (one_blocked(w, lowest_bit_64(now))) {
            w->left = 0;
            keep_own(w, now, kept->blocker);
        }
        occluded |= now & ~w->left;
        bits &= ~now;
        boxes = kept->asked - before;
        if (w->left == 0 && bits != 0 && misses < MAX_MISSES) { /* a triangle that blocks one pixel often blocks more */
            w->left = bits;
            test_blocking_triangle(w, kept->blocker - 1, bits);
            misses += w->left == bits;
            occluded |= bits & ~w->left;
            bits = w->left;
        }
    }
    return occluded;
}

uint64_t lmb_occluded_tile(const lmb_kernels *kernels, lmb_traversal *kept, const lmb_bvh *bvh, const lmb_tile *tile,
                           uint64_t pixels, lmb_vec3 at, float noise)
{
    return lmb_occluded_again(kernels, kept, NULL, bvh, tile, pixels, at, noise);
}

uint64_t lmb_occluded_again(const lmb_kernels *kernels, lmb_traversal *kept, uint32_t own[LMB_TILE_PIXELS],
                            const lmb_bvh *bvh, const lmb_tile *tile, uint64_t pixels, lmb_vec3 at, float noise)
{
    tile_traversal w = {bvh, kernels, tile, at, noise, kept, pixels, own};
    if (bvh == NULL || kernels == NULL || tile == NULL || kept == NULL || pixels == 0 || bvh->node_count == 0) {
        return 0;
    }
    const uint32_t before = kept->spent;
    const uint64_t asked = w.left = traversal_begin(kept, pixels);
    return traversal_end(kept, before, pixels, asked, trace(&w));
}

#endif
