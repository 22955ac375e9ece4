/* sun.c: a tile's rays to one point at infinity, traced through the BVH together. Layer 4. [V25] */
#include <lambent/occlusion.h>

#include "../base/vec.h"
#include "../lane/kernels.h"
#include "../raster/resolve.h"
#include "../raster/tile.h"
#include "traversal.h"

#if LMB_TREES

/* 2^-20: below this cosine rays are parallel to a triangle, which then blocks none */
#define MIN_RAY_SLOPE 9.5367432e-7f
#define TRIANGLE_NOISE 0x1p-21f /* of the distance to the corners */

typedef struct sun_traversal {
    const lmb_bvh *b;
    const lmb_kernels *kernels;
    const lmb_tile *tile;
    lmb_vec3 at, to; /* at: a pixel of the tile, to keep differences small; to: unit, towards the light */
    lmb_traversal *kept;
    float noise;   /* m: possible distance of pixels from their surfaces by rounding */
    uint64_t left;    /* pixels not blocked so far */
    uint32_t blocker; /* the last triangle that blocked a pixel, + 1 */
    lmb_vec3 low, high; /* box of the pixels of the current sweep, from `at`; set by sweep_of */
} sun_traversal;

/* 2^-22 of the coordinates and 2^-20 of the length of the ray that found them. */
static float noise_of_pixels(const lmb_tile *tile, uint64_t pixels)
{
    float noise = 0.0f;
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 p = tile_vec(tile->position, k);
        const float largest = maxf(absf(p.x), maxf(absf(p.y), absf(p.z)));
        noise = maxf(noise, 0x1p-22f * largest + 0x1p-20f * absf(tile->depth[k]));
    }
    return noise;
}

/* The planes of two triangles through a shared edge are exact negatives of each other, so no ray passes between them.
 * Returns 0 if rays are parallel to the triangle. */
static int sun_job(lmb_sun_job *out, const sun_traversal *w, const lmb_bvh_triangle *t)
{
    const lmb_vec3 a = sub3(t->corner[0], w->at), b = sub3(t->corner[1], w->at), c = sub3(t->corner[2], w->at);
    const float far2 = dot3(a, a) + dot3(b, b) + dot3(c, c);
    const float along = dot3(t->normal, w->to), side = along < 0.0f ? -1.0f : 1.0f;
    if (!(absf(along) > MIN_RAY_SLOPE)) {
        return 0;
    }
    out->at = w->at;
    out->edge[0] = mul3(cross3(w->to, sub3(c, b)), side);
    out->edge[1] = mul3(cross3(w->to, sub3(a, c)), side);
    out->edge[2] = mul3(cross3(w->to, sub3(b, a)), side);
    out->offset[0] = side * dot3(cross3(b, c), w->to);
    out->offset[1] = side * dot3(cross3(c, a), w->to);
    out->offset[2] = side * dot3(cross3(a, b), w->to);
    out->normal = mul3(t->normal, -side);
    const float noise = maxf(w->noise + TRIANGLE_NOISE * sqrtf(far2), w->b->noise);
    out->beyond = dot3(out->normal, a) + noise;
    if (eye_is_across(w->kept, t->normal, t->corner[0], along)) {
        const float wider = minf(noise, triangle_margin(t));
        out->beyond = dot3(out->normal, a) - wider;
        for (int i = 0; i < 3; ++i) {
            out->offset[i] += wider * length3(out->edge[i]);
        }
    }
    return 1;
}

/* Returns those pixels with rays across a triangle with holes that hit an opaque part. */
static uint64_t sun_standing(const sun_traversal *w, const lmb_bvh_triangle *t, const lmb_sun_job *job,
                             uint64_t crossed)
{
    uint64_t out = 0;
    lmb_triangle triangle;
    lmb_resolve_alpha alpha;
    if (!lmb_triangle_fetch(&triangle, w->b->scene, t->id & ~LMB_BVH_MASKED)) {
        return 0;
    }
    lmb_resolve_alpha_of(&alpha, &triangle);
    w->kept->spent += (uint32_t)count_bits_64(crossed);
    for (uint64_t bits = crossed; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 d = sub3(tile_vec(w->tile->position, k), job->at);
        const float e0 = dot3(job->edge[0], d) + job->offset[0], e1 = dot3(job->edge[1], d) + job->offset[1];
        const float e2 = dot3(job->edge[2], d) + job->offset[2], sum = e0 + e1 + e2;
        if (sum > 0.0f && lmb_resolve_opaque(&alpha, w->b->scene, e1 / sum, e2 / sum)) {
            out |= (uint64_t)1 << k;
        }
    }
    return out;
}

/* 1 if a pixel lies within the edge from b to c, widened by `wider` m or more. */
static inline int is_within_edge(const sun_traversal *w, lmb_vec3 b, lmb_vec3 c, float side, float wider, lmb_vec3 d)
{
    const lmb_vec3 edge = mul3(cross3(w->to, sub3(c, b)), side);
    const float offset = side * dot3(cross3(b, c), w->to);
    return dot3(edge, d) + (offset + wider * (absf(edge.x) + absf(edge.y) + absf(edge.z))) >= 0.0f;
}

static int is_within_job(const lmb_sun_job *job, lmb_vec3 d)
{
    return dot3(job->edge[0], d) + job->offset[0] >= 0.0f && dot3(job->edge[1], d) + job->offset[1] >= 0.0f &&
           dot3(job->edge[2], d) + job->offset[2] >= 0.0f;
}

/* 1 if a triangle blocks this one pixel: as `sun_crossed` for unit directions, with the cheapest test first. */
static int sun_blocks_one(const sun_traversal *w, const lmb_bvh_triangle *t, uint64_t pixel)
{
    const lmb_vec3 d = sub3(tile_vec(w->tile->position, lowest_bit_64(pixel)), w->at);
    const lmb_vec3 a = sub3(t->corner[0], w->at);
    const float along = dot3(t->normal, w->to), side = along < 0.0f ? -1.0f : 1.0f;
    const lmb_vec3 normal = mul3(t->normal, -side);
    if (!(absf(along) > MIN_RAY_SLOPE) || !(dot3(normal, a) - w->b->margin < dot3(normal, d))) {
        return 0;
    }
    const lmb_vec3 b = sub3(t->corner[1], w->at), c = sub3(t->corner[2], w->at);
    /* more than sun_job widens it */
    const float wider = eye_is_across(w->kept, t->normal, t->corner[0], along) ? 2.0f * w->b->margin : 0.0f;
    lmb_sun_job job;
    return is_within_edge(w, b, c, side, wider, d) && is_within_edge(w, c, a, side, wider, d) &&
           is_within_edge(w, a, b, side, wider, d) && sun_job(&job, w, t) && job.beyond < dot3(job.normal, d) &&
           (wider == 0.0f || is_within_job(&job, d)) &&
           (!(t->id & LMB_BVH_MASKED) || sun_standing(w, t, &job, pixel) != 0);
}

static void test_sun_triangle(sun_traversal *w, uint32_t triangle)
{
    const lmb_bvh_triangle *t = &w->b->triangle[triangle];
    lmb_sun_job job;
    if ((w->left & (w->left - 1)) == 0) {
        w->left = sun_blocks_one(w, t, w->left) ? 0 : w->left;
    } else if (sun_job(&job, w, t)) {
        const uint64_t crossed = w->kernels->sun_crossed(w->tile, w->left, &job);
        w->left &= ~(crossed != 0 && (t->id & LMB_BVH_MASKED) ? sun_standing(w, t, &job, crossed) : crossed);
    }
}

/* Tests the triangles that recently blocked many pixels. */
static void test_kept(sun_traversal *w)
{
    for (int i = 0; i < LMB_LAST_OCCLUDERS && w->kept->last[i] != 0 && w->left != 0; ++i) {
        test_sun_triangle(w, w->kept->last[i] - 1);
    }
}

/* The most that dot3(axis, pixel - at) is in the sweep: the same sums of larger terms, so rounding makes none less. */
static inline float most_in_sweep(const sun_traversal *w, lmb_vec3 axis)
{
    return maxf(axis.x * w->low.x, axis.x * w->high.x) + maxf(axis.y * w->low.y, axis.y * w->high.y) +
           maxf(axis.z * w->low.z, axis.z * w->high.z);
}

/* 1 if a triangle blocks no pixel of the sweep, because it lies behind all of them or along the rays. */
static inline int is_behind_sweep(const sun_traversal *w, const lmb_bvh_triangle *t)
{
    const lmb_vec3 a = sub3(t->corner[0], w->at);
    const float along = dot3(t->normal, w->to), side = along < 0.0f ? -1.0f : 1.0f;
    const lmb_vec3 normal = mul3(t->normal, -side);
    return !(absf(along) > MIN_RAY_SLOPE) || dot3(normal, a) - w->b->margin >= most_in_sweep(w, normal);
}

static void test_box(sun_traversal *w, const lmb_boxes *node, int i)
{
    for (uint32_t k = 0; k < node->count[i] && w->left != 0 && !traversal_is_over(w->kept); ++k) {
        const uint64_t before = w->left;
        ++w->kept->spent;
        if (is_behind_sweep(w, &w->b->triangle[node->first[i] + k])) {
            continue;
        }
        test_sun_triangle(w, node->first[i] + k);
        w->blocker = before != w->left ? node->first[i] + k + 1 : w->blocker;
        if (count_bits_64(before & ~w->left) >= MIN_BLOCKED_PIXELS) {
            for (int last = LMB_LAST_OCCLUDERS - 1; last > 0; --last) {
                w->kept->last[last] = w->kept->last[last - 1];
            }
            w->kept->last[0] = node->first[i] + k + 1;
        }
    }
}

static lmb_sun_sweep sweep_of(sun_traversal *w)
{
    const float d[3] = {w->to.x, w->to.y, w->to.z};
    lmb_vec3 low, high;
    lmb_sun_sweep s;
    tile_box(&low, &high, w->tile, w->left);
    for (int c = 0; c < 3; ++c) {
        s.per[c] = 1.0f / (absf(d[c]) < MIN_PYRAMID_M ? MIN_PYRAMID_M : d[c]);
    }
    w->low = sub3(low, w->at);
    w->high = sub3(high, w->at);
    s.low[0] = low.x;
    s.low[1] = low.y;
    s.low[2] = low.z;
    s.high[0] = high.x;
    s.high[1] = high.y;
    s.high[2] = high.z;
    return s;
}

/* A node, and the boxes still to visit, one bit each. */
typedef struct sun_branch {
    uint32_t node, boxes;
} sun_branch;

/* Tests the leaves that the sweep meets and returns the children that it meets. Leaves come first: those near the root
 * have large triangles, such as walls, which often block all pixels. */
static uint32_t sun_node(sun_traversal *w, const lmb_sun_sweep *sweep, const lmb_boxes *node)
{
    uint32_t children = 0;
    for (uint32_t bits = w->kernels->sun_meets(sweep, node); bits != 0 && w->left != 0; bits &= bits - 1) {
        const int i = lowest_bit(bits);
        if (node->count[i] > 0) {
            ++w->kept->asked;
            ++w->kept->spent;
            test_box(w, node, i);
        } else if (node->first[i] != 0) { /* the root is no child: an empty box, met by a sweep of NaN */
            children |= 1u << i;
        }
    }
    return children;
}

/* Traces the remaining pixels with one sweep. Returns 0 if that takes over `limit` boxes: some may still be blocked. */
static int sun_descend(sun_traversal *w, uint32_t limit)
{
    const lmb_sun_sweep sweep = sweep_of(w);
    const uint32_t before = w->kept->asked;
    sun_branch waiting[LMB_TRAVERSAL_LEVELS];
    int count = 0;
    uint32_t here = 0;
    for (;;) {
        ++w->kept->asked;
        ++w->kept->spent;
        waiting[count].node = here;
        waiting[count].boxes = sun_node(w, &sweep, &w->b->node[here]);
        count += waiting[count].boxes != 0;
        if (count == 0 || w->left == 0) {
            return 1;
        }
        if (w->kept->asked - before > limit || traversal_is_over(w->kept)) {
            return 0;
        }
        sun_branch *top = &waiting[count - 1];
        here = w->b->node[top->node].first[lowest_bit(top->boxes)];
        top->boxes &= top->boxes - 1;
        count -= top->boxes == 0;
    }
}

/* Returns the pixels of `bits` that the last blocker does not block. A triangle that blocks one pixel, such as a wall,
 * often blocks more. */
static uint64_t without_blocked(sun_traversal *w, uint64_t bits)
{
    w->left = bits;
    if (bits != 0) {
        test_sun_triangle(w, w->blocker - 1);
    }
    return w->left;
}

/* Rays that fill a wide sweep, such as those of scattered pixels, meet most of the sweep's boxes one by one. */
static void sun_trace(sun_traversal *w)
{
    const uint64_t pixels = w->left;
    uint64_t open = 0;
    if (count_bits_64(pixels) > MAX_SINGLE_PIXELS) {
        if (w->kept->alone > 0) {
            --w->kept->alone;
        } else if (sun_descend(w, MAX_BOXES_A_PIXEL * (uint32_t)count_bits_64(pixels))) {
            return;
        } else {
            w->kept->alone = SINGLE_POINTS;
        }
    }
    uint32_t boxes = 0;
    int misses = 0;
    uint64_t bits = w->left;
    while (bits != 0 && !traversal_is_over(w->kept)) {
        const uint32_t before = w->kept->asked;
        w->left = boxes > LMB_MANY_BOXES ? bits : bits & (~bits + 1);
        bits &= ~w->left;
        (void)sun_descend(w, ~0u);
        open |= w->left;
        boxes = w->kept->asked - before;
        if (w->left == 0 && misses < MAX_MISSES) {
            const uint64_t others = bits;
            bits = without_blocked(w, bits);
            misses += bits == others;
        }
    }
    w->left = open | bits;
}

/* Begins a call. Returns 1 if too few tests are left to trace a ray. */
static int sun_is_spent(lmb_traversal *t, uint64_t pixels)
{
    t->end = t->spent + 0x7fffffffu;
    if (!t->bounded) {
        return 0;
    }
    t->sun_spent = maxi(t->sun_spent, -LMB_TRAVERSAL_MOST) - LMB_TRAVERSAL_SUN_EACH * (1 + count_bits_64(pixels));
    t->end = t->spent + (uint32_t)(2 * LMB_TRAVERSAL_SUN_FIRST - t->sun_spent);
    return t->sun_spent > LMB_TRAVERSAL_SUN_FIRST;
}

/* The last traced answer; a pixel that was not asked then gets the answer of the next one that was. */
static uint64_t sun_again(lmb_traversal *t, uint64_t pixels)
{
    uint64_t dark = t->sun_dark & pixels;
    ++t->coarse;
    for (uint64_t bits = t->sun_asked != 0 ? pixels & ~t->sun_asked : 0; bits != 0; bits &= bits - 1) {
        const uint64_t after = t->sun_asked & ~((bits & (~bits + 1)) - 1), next = after != 0 ? after : t->sun_asked;
        dark |= (next & (~next + 1) & t->sun_dark) != 0 ? bits & (~bits + 1) : 0;
    }
    return dark;
}

static uint64_t sun_end(lmb_traversal *t, uint32_t before, uint64_t pixels, uint64_t dark)
{
    if (t->bounded) {
        t->sun_spent += (int32_t)(t->spent - before);
        t->coarse += (uint32_t)traversal_is_over(t);
        t->sun_asked = pixels;
        t->sun_dark = dark;
    }
    return dark;
}

uint64_t lmb_occluded_sun(const lmb_kernels *kernels, lmb_traversal *kept, const lmb_bvh *bvh, const lmb_tile *tile,
                          uint64_t pixels, lmb_vec3 to)
{
    if (bvh == NULL || kernels == NULL || tile == NULL || kept == NULL || pixels == 0 || bvh->node_count == 0) {
        return 0;
    }
    if (sun_is_spent(kept, pixels)) {
        return sun_again(kept, pixels);
    }
    const uint32_t before = kept->spent;
    sun_traversal w = {
        bvh,    kernels, tile, tile_vec(tile->position, lowest_bit_64(pixels)), to, kept, noise_of_pixels(tile, pixels),
        pixels, 0, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
    test_kept(&w);
    if (w.left != 0) {
        sun_trace(&w);
    }
    return sun_end(kept, before, pixels, pixels & ~w.left);
}

#endif
