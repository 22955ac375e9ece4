/* blocked.c: a tile's segments to one point, walked through the tree of boxes together. Floor 4.            [V25] */
#include <lambent/occlusion.h>

#include "../base/vec.h"
#include "../lane/kernels.h"
#include "../raster/resolve.h"
#include "walk.h"

/* The segments from a point to a box of pixels, as a box sees them. Along an axis a segment's place at its share t is
 * t d with d in [d0, d1]: it may meet [low, high] where t d1 >= low and t d0 <= high. Each is a bound on t: from below
 * where it says that t is at least something, else from above. */
typedef struct pyramid {
    float at[3];
    float per_high[3], per_low[3]; /* 1 / d1, 1 / d0: neither is 0 */
    int up[3], down[3];            /* d1 > 0, d0 < 0 */
} pyramid;

#define THIN 1e-20f /* m: a pyramid is never thinner */

static void pyramid_axis(pyramid *out, int axis, float at, float low, float high)
{
    const float d1 = high - at, d0 = low - at;
    out->at[axis] = at;
    out->per_high[axis] = 1.0f / (absf(d1) < THIN ? THIN : d1);
    out->per_low[axis] = 1.0f / (absf(d0) < THIN ? -THIN : d0);
    out->up[axis] = out->per_high[axis] > 0.0f;
    out->down[axis] = out->per_low[axis] < 0.0f;
}

static pyramid pyramid_of(const lmb_tile *tile, uint64_t pixels, lmb_vec3 at)
{
    float low[3] = {3e38f, 3e38f, 3e38f}, high[3] = {-3e38f, -3e38f, -3e38f};
    pyramid p;
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        for (int c = 0; c < 3; ++c) {
            low[c] = minf(low[c], tile->position[c][k]);
            high[c] = maxf(high[c], tile->position[c][k]);
        }
    }
    pyramid_axis(&p, 0, at.x, low[0], high[0]);
    pyramid_axis(&p, 1, at.y, low[1], high[1]);
    pyramid_axis(&p, 2, at.z, low[2], high[2]);
    return p;
}

static inline void narrow(float *from, float *to, const pyramid *p, int axis, float low, float high)
{
    const float a = (low - p->at[axis]) * p->per_high[axis], b = (high - p->at[axis]) * p->per_low[axis];
    *from = maxf(*from, maxf(p->up[axis] ? a : 0.0f, p->down[axis] ? b : 0.0f));
    *to = minf(*to, minf(p->up[axis] ? 1.0f : a, p->down[axis] ? 1.0f : b));
}

static inline int meets(const pyramid *p, const lmb_box *box)
{
    float from = 0.0f, to = 1.0f;
    narrow(&from, &to, p, 0, box->low.x, box->high.x);
    narrow(&from, &to, p, 1, box->low.y, box->high.y);
    narrow(&from, &to, p, 2, box->low.z, box->high.z);
    return from <= to;
}

/* A triangle as the point sees it. 0 where the point lies in its plane. */
static int cross_job(lmb_cross_job *out, const lmb_blocker *t, lmb_vec3 at, float noise)
{
    const lmb_vec3 a = sub3(t->corner[0], at), b = sub3(t->corner[1], at), c = sub3(t->corner[2], at);
    const float ahead = dot3(t->normal, a), side = ahead < 0.0f ? -1.0f : 1.0f;
    if (!(absf(ahead) > noise)) {
        return 0;
    }
    out->at = at;
    out->edge[0] = mul3(cross3(b, c), side);
    out->edge[1] = mul3(cross3(c, a), side);
    out->edge[2] = mul3(cross3(a, b), side);
    out->normal = mul3(t->normal, side);
    out->beyond = absf(ahead) + noise;
    return 1;
}

/* Of the pixels whose segments cross a triangle with holes, those that do so where it stands. */
static uint64_t standing(const lmb_blockers *b, const lmb_blocker *t, const lmb_cross_job *job, const lmb_tile *tile,
                         uint64_t crossed)
{
    uint64_t out = 0;
    lmb_triangle triangle;
    if (!lmb_triangle_fetch(&triangle, b->scene, t->id & ~LMB_BLOCKER_MASKED)) {
        return 0;
    }
    for (uint64_t bits = crossed; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 d = sub3(vec3(tile->position[0][k], tile->position[1][k], tile->position[2][k]), job->at);
        const float e0 = dot3(job->edge[0], d), e1 = dot3(job->edge[1], d), e2 = dot3(job->edge[2], d);
        const float sum = e0 + e1 + e2;
        if (sum > 0.0f && lmb_triangle_opaque(&triangle, b->scene, e1 / sum, e2 / sum)) {
            out |= (uint64_t)1 << k;
        }
    }
    return out;
}

/* Boxes asked by the pyramid alone; after them, each is asked by the segments themselves, which in a fine mesh mostly
 * pass between its triangles. */
#define BY_PYRAMID 24

static uint64_t blocked_by_leaf(const lmb_blockers *b, const lmb_kernels *kernels, const lmb_tile *tile,
                                uint64_t pixels, lmb_vec3 at, const lmb_box *leaf)
{
    uint64_t blocked = 0;
    lmb_cross_job job;
    for (uint32_t i = 0; i < leaf->count && blocked != pixels; ++i) {
        const lmb_blocker *t = &b->triangle[leaf->first + i];
        if (cross_job(&job, t, at, b->noise)) {
            const uint64_t crossed = kernels->crossed(tile, pixels & ~blocked, &job);
            blocked |= crossed != 0 && (t->id & LMB_BLOCKER_MASKED) ? standing(b, t, &job, tile, crossed) : crossed;
        }
    }
    return blocked;
}

/* A node and the pixels whose segments may meet it. */
typedef struct visit {
    uint64_t pixels;
    uint32_t node;
} visit;

uint64_t lmb_blocked_tile(const lmb_blockers *blockers, const lmb_kernels *kernels, const lmb_tile *tile,
                          uint64_t pixels, lmb_vec3 at)
{
    visit waiting[LMB_WALK_DEPTH];
    lmb_segments segments;
    uint64_t blocked = 0;
    int count = 0, asked = 0;
    if (pixels == 0 || blockers->node_count == 0) {
        return 0;
    }
    const pyramid p = pyramid_of(tile, pixels, at);
    waiting[count].node = 0;
    waiting[count++].pixels = pixels;
    while (count > 0) {
        const visit v = waiting[--count];
        const lmb_box *node = &blockers->node[v.node];
        uint64_t here = v.pixels & ~blocked;
        if (here == 0 || (asked < BY_PYRAMID && !meets(&p, node))) {
            continue;
        }
        if (++asked > BY_PYRAMID) {
            if (asked == BY_PYRAMID + 1) {
                kernels->segments(&segments, tile, at);
            }
            here = kernels->through(&segments, here, node);
        }
        if (here == 0) {
            continue;
        }
        if (node->count > 0) {
            blocked |= blocked_by_leaf(blockers, kernels, tile, here, at, node);
            if (blocked == pixels) {
                break;
            }
            continue;
        }
        for (uint32_t i = 0; i < 2; ++i) {
            waiting[count].node = node->first + i;
            waiting[count++].pixels = here;
        }
    }
    return blocked;
}
