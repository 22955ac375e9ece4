/* traversal.h: limits of a traversal: the depth of the BVH, and the allowance for rounding. Layer 4.
 *
 * Nothing here depends on the size of the scene: a distant triangle must not make walls leak. */
#ifndef LMB_OCCLUSION_TRAVERSAL_H
#define LMB_OCCLUSION_TRAVERSAL_H

#include <lambent/occlusion.h>

#include "../base/vec.h"

/* Levels: eight for 2^31 triangles split evenly into sixteen, and as many again for uneven splits. */
#define LMB_TRAVERSAL_LEVELS 16

/* A position on a surface is the ray's length along it, added to the eye. Relative to the distance: 8 roundings, of the
 * plane's values and of rays up to twice as long as their extent along the axis. Relative to the coordinates: 4
 * roundings of the sum. */
#define LMB_NOISE_DISTANCE 9.5367432e-7f /* 2^-20 */
#define LMB_NOISE_PLACE    2.3841858e-7f /* 2^-22 */

/* Relative to the distance of a segment's end from a triangle's corners: 4 roundings of the height above the plane, and
 * 4 of the normal, which is computed differently from the one that positioned the end. */
#define LMB_NOISE_TRIANGLE 4.7683716e-7f /* 2^-21 */

/* Relative to the size of a convex room, in which nothing can block: hull.c. */
#define LMB_NOISE_HULL 3.8146973e-6f /* 2^-18 */

/* A single pixel meets this many boxes only if most of them overlap, as for long slivers or for a mesh far from the
 * origin. The pixels after it are then traced together, so that each triangle is tested once for all of them. */
#define LMB_MANY_BOXES 256u

#define LMB_TRAVERSAL_MOST 0x10000000 /* maximum of `left`, so that no sum overflows */

/* How pixels are traced: together through a pyramid of all segments (occluded.c) or a sweep of all rays (sun.c), or one
 * by one. */
enum {
    MAX_SINGLE_PIXELS = 7,   /* up to this many are traced one by one: in foliage they lie far apart */
    MIN_BLOCKED_PIXELS = 16, /* a triangle that blocks this many is tested first for the next segments or rays */
    MAX_MISSES = 2           /* after this many triangles that block only one pixel, none is retried for the others */
};
#define MAX_BOXES_A_PIXEL 8u     /* at which a pyramid or sweep is abandoned: single pixels meet fewer */
#define SINGLE_POINTS     15u    /* number of following points or directions traced pixel by pixel after that */
#define MIN_PYRAMID_M     1e-20f /* width of a pyramid or sweep */

/* Begins a call. Returns the pixels to test. */
static inline uint64_t traversal_begin(lmb_traversal *t, uint64_t pixels)
{
    uint64_t asked = pixels;
    t->end = t->spent + 0x7fffffffu;
    if (t->bounded) {
        const int is_coarse = t->left < 0;
        t->end = t->spent + (uint32_t)(is_coarse ? LMB_TRAVERSAL_COARSE : t->left + LMB_TRAVERSAL_FIRST);
        t->left = is_coarse ? t->left
                            : mini(t->left, LMB_TRAVERSAL_MOST) + LMB_TRAVERSAL_EACH * (1 + count_bits_64(pixels));
        for (int i = is_coarse ? count_bits_64(asked) / 2 : 0; i > 0; --i) {
            asked &= asked - 1;
        }
        asked = is_coarse ? asked & (~asked + 1) : asked;
    }
    return asked;
}

/* 1 if this call has used up the tests. */
static inline int traversal_is_over(const lmb_traversal *t) { return (int32_t)(t->spent - t->end) >= 0; }

/* Ends a call; before: `spent` at the start. Returns the occluded ones of all pixels. */
static inline uint64_t traversal_end(lmb_traversal *t, uint32_t before, uint64_t pixels, uint64_t asked,
                                     uint64_t occluded)
{
    if (t->bounded) {
        t->left -= t->left < 0 ? 0 : (int32_t)(t->spent - before);
        t->coarse += asked != pixels || traversal_is_over(t);
    }
    return asked == pixels ? occluded : occluded != 0 ? pixels : 0;
}

/* Starts a tile: with a new budget of tests, and without occluders of another tile, which would change the number of
 * tests. */
static inline void traversal_bound(lmb_traversal *t)
{
    for (int i = 0; i < LMB_LAST_OCCLUDERS; ++i) {
        t->last[i] = 0;
    }
    t->asked = t->first = t->blocker = t->alone = 0;
    t->bounded = 1;
    t->left = LMB_TRAVERSAL_FIRST;
    t->spent = t->end = t->coarse = 0;
    t->sun_spent = 0;
    t->sun_asked = t->sun_dark = 0;
}

/* Moves a triangle to the front of `count` numbers + 1. If it is not among them, the last one is dropped. */
static inline void traversal_remember(uint32_t *last, int count, uint32_t triangle)
{
    uint32_t moved = triangle + 1;
    for (int i = 0; i < count; ++i) {
        const uint32_t here = last[i];
        last[i] = moved;
        moved = here;
        if (here == triangle + 1) {
            return;
        }
    }
}

/* How far boxes extend beyond their contents, relative to size and coordinates. */
#define LMB_BOX_SIZE  3.8146973e-6f /* 2^-18 */
#define LMB_BOX_PLACE 9.5367432e-7f /* 2^-20 */

/* 1 if the eye and a point are on different sides of a plane. `ahead`: height of the point over the plane along the
 * normal, m. */
static inline int eye_is_across(const lmb_traversal *t, lmb_vec3 normal, lmb_vec3 on_plane, float ahead)
{
    const float eye = t->eye_kind == LMB_EYE_PLACE ? dot3(normal, sub3(t->eye, on_plane))
                      : t->eye_kind == LMB_EYE_FAR ? dot3(normal, t->eye)
                                                   : 0.0f;
    return ahead > 0.0f ? eye < 0.0f : eye > 0.0f;
}

/* Half of the margin of boxes (m). */
static inline float half_box_margin(lmb_vec3 low, lmb_vec3 high)
{
    return 0.5f * (LMB_BOX_SIZE * largest3(sub3(high, low)) + LMB_BOX_PLACE * maxf(largest3(low), largest3(high)));
}

/* Distance (m) by which a triangle may be widened: half of the margin of boxes, so that none is missed. */
static inline float triangle_margin(const lmb_bvh_triangle *t)
{
    return half_box_margin(min3(min3(t->corner[0], t->corner[1]), t->corner[2]),
                      max3(max3(t->corner[0], t->corner[1]), t->corner[2]));
}

#endif
