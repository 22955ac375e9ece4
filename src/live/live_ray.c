/* live_ray.c: which segments of a receiver are blocked: one packet from one origin. Layer 5.                    [ours]
 *
 * Whether a triangle blocks a segment depends only on these two, and so does whether the segment meets a box. So the
 * order of the traversal and the other segments do not change the result. */
#include "live_part.h"

#include <string.h>

#include "../lane/kernels.h"
#include "../occlusion/small.h"
#include "../occlusion/traversal.h"
#include "../raster/resolve.h"

#if LMB_LIVE

#define MUCH 2            /* a triangle that blocks this many segments is remembered */
#define END 1.00001000f   /* 1 / .99999: triangles beyond .99999 of a segment do not block it */

/* Leaves wait until the next node was tested, so that their triangles are in the cache by then. */
typedef struct traversal {
    const lmb_kernels *kernels;
    const lmb_bvh *bvh;
    lmb_live_scratch *scratch;
    const lmb_live_receiver *receiver;
    uint64_t left; /* segments not blocked so far */
    float noise;   /* m: no triangle has more: noise_of */
    int32_t waiting, own; /* own: the current node's half of scratch->met */
    const lmb_boxes *last; /* the node before, */
    uint32_t leaves;       /* and the leaves of it that wait */
} traversal;

/* As in occluded.c: swapping the corners negates the result exactly. */
static inline lmb_vec3 edge_plane(lmb_vec3 b, lmb_vec3 c, lmb_vec3 edge) { return cross3(add3(b, c), edge); }

/* A triangle as seen from the receiver. If the receiver lies in the triangle's plane, the triangle counts as in front
 * and is widened by the rounding error, within its boxes. */
typedef struct aspect {
    float wider; /* m; 0: the receiver lies off the plane */
    int against; /* segments cross against the normal */
} aspect;

/* Largest distance of a receiver in a triangle's plane from that plane, by rounding. */
static inline float noise_of(const lmb_live_receiver *receiver, lmb_vec3 a, lmb_vec3 b, lmb_vec3 c)
{
    const lmb_vec3 at = receiver->position;
    return receiver->noise +
           LMB_NOISE_TRIANGLE * (largest3(sub3(a, at)) + largest3(sub3(b, at)) + largest3(sub3(c, at)));
}

static lmb_vec3 small_corner(const lmb_bvh *b, const uint16_t side[3])
{
    return vec3(lmb_small_side(b, 0, side[0]), lmb_small_side(b, 1, side[1]), lmb_small_side(b, 2, side[2]));
}

/* Bounds noise_of all triangles: rounding keeps the order of distances, and the root's boxes contain all corners. */
static float max_noise(const lmb_bvh *bvh, const lmb_live_receiver *receiver)
{
    if (bvh->small != NULL) {
        const lmb_vec3 from = small_corner(bvh, bvh->small->low), to = small_corner(bvh, bvh->small->high);
        return maxf(noise_of(receiver, from, from, from), noise_of(receiver, to, to, to));
    }
    const lmb_boxes *root = &bvh->node[0];
    lmb_vec3 low = vec3(root->low[0][0], root->low[1][0], root->low[2][0]),
             high = vec3(root->high[0][0], root->high[1][0], root->high[2][0]);
    for (int i = 1; i < LMB_BOXES; ++i) {
        low = min3(low, vec3(root->low[0][i], root->low[1][i], root->low[2][i]));
        high = max3(high, vec3(root->high[0][i], root->high[1][i], root->high[2][i]));
    }
    return maxf(noise_of(receiver, low, low, low), noise_of(receiver, high, high, high));
}

/* Sets the plane of a triangle. Returns 0 if the triangle blocks nothing. */
static inline int plane_of(aspect *out, lmb_cross_job *job, const traversal *w, const lmb_bvh_triangle *t)
{
    const float ahead = dot3(t->normal, sub3(t->corner[0], w->receiver->position));
    out->wider = 0.0f;
    out->against = ahead < 0.0f;
    job->beyond = absf(ahead) * END;
    if (!(absf(ahead) > w->noise)) {
        const float noise = noise_of(w->receiver, t->corner[0], t->corner[1], t->corner[2]);
        if (!(absf(ahead) > noise)) {
            const float eye = dot3(t->normal, w->receiver->to_eye);
            if (!(absf(eye) > 0.0f)) {
                return 0;
            }
            out->wider = minf(noise, triangle_margin(t));
            out->against = eye > 0.0f;
            job->beyond = noise;
        }
    }
    job->normal = out->against ? mul3(t->normal, -1.0f) : t->normal;
    return 1;
}

/* Planes through the receiver and the edges. They face inwards whether segments cross along the normal or against
 * it. */
static void set_edges(lmb_cross_job *out, const aspect *a, const traversal *w, const lmb_bvh_triangle *t)
{
    const lmb_vec3 *p = t->corner, at = w->receiver->position;
    const lmb_vec3 to[3] = {sub3(p[0], at), sub3(p[1], at), sub3(p[2], at)};
    out->at = at;
    if (a->against) {
        out->edge[0] = edge_plane(to[1], to[2], sub3(p[1], p[2]));
        out->edge[1] = edge_plane(to[2], to[0], sub3(p[2], p[0]));
        out->edge[2] = edge_plane(to[0], to[1], sub3(p[0], p[1]));
    } else {
        out->edge[0] = edge_plane(to[1], to[2], sub3(p[2], p[1]));
        out->edge[1] = edge_plane(to[2], to[0], sub3(p[0], p[2]));
        out->edge[2] = edge_plane(to[0], to[1], sub3(p[1], p[0]));
    }
    const lmb_vec3 *e = out->edge;
    out->slack =
        a->wider > 0.0f ? a->wider * sqrtf(maxf(maxf(dot3(e[0], e[0]), dot3(e[1], e[1])), dot3(e[2], e[2]))) : 0.0f;
}

/* Of the segments that cross a triangle with holes, returns those that hit an opaque part. */
NOINLINE uint64_t standing(const traversal *w, uint32_t id, const lmb_cross_job *job, uint64_t crossed)
{
    const lmb_live_rays *r = &w->scratch->rays;
    lmb_triangle triangle;
    lmb_resolve_alpha alpha;
    uint64_t out = 0;
    if (!lmb_triangle_fetch(&triangle, w->bvh->scene, id)) {
        return 0;
    }
    lmb_resolve_alpha_of(&alpha, &triangle);
    for (uint64_t bits = crossed; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 d = vec3(r->to[0][k], r->to[1][k], r->to[2][k]);
        const float e0 = dot3(job->edge[0], d), e1 = dot3(job->edge[1], d), e2 = dot3(job->edge[2], d);
        const float sum = e0 + e1 + e2;
        if (sum > 0.0f && lmb_resolve_opaque(&alpha, w->bvh->scene, e1 / sum, e2 / sum)) {
            out |= (uint64_t)1 << k;
        }
    }
    return out;
}

/* A triangle of the BVH. Those of small nodes are made from the scene; walls are tested for most points. */
static const lmb_bvh_triangle *triangle_at(const traversal *w, uint32_t triangle)
{
    if (w->bvh->small == NULL) {
        return &w->bvh->triangle[triangle];
    }
    const uint32_t id = w->bvh->small_id[triangle];
    lmb_bvh_triangle *t = &w->scratch->known[id % LMB_LIVE_KNOWN];
    return (t->id & ~LMB_BVH_MASKED) == id || lmb_small_triangle(t, w->bvh->scene, id) ? t : NULL;
}

static void test_triangle(traversal *w, uint32_t triangle, uint64_t asked)
{
    const lmb_bvh_triangle *t = triangle_at(w, triangle);
    const uint32_t id = t != NULL ? t->id & ~LMB_BVH_MASKED : 0;
    lmb_cross_job job;
    aspect a;
    if (t == NULL || id == w->receiver->id || !plane_of(&a, &job, w, t)) {
        return;
    }
    /* Most triangles that segments come near are walls on which they end. */
    uint64_t crossed = w->kernels->live_beyond(w->scratch->rays.to, asked, &job);
    if (crossed == 0) {
        return;
    }
    set_edges(&job, &a, w, t);
    crossed = w->kernels->live_crossed(w->scratch->rays.to, crossed, &job);
    for (uint64_t bits = crossed; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        crossed &= ~((uint64_t)(w->scratch->rays.id[k] == id) << k);
    }
    w->left &= ~(crossed != 0 && (t->id & LMB_BVH_MASKED) ? standing(w, id, &job, crossed) : crossed);
}

/* Triangles that block at least MUCH segments are tested first from then on, which changes no result. */
static void test_leaf(traversal *w, uint32_t first, uint32_t count, uint64_t met)
{
    for (uint32_t k = 0; k < count && (w->left & met) != 0; ++k) {
        const uint64_t before = w->left;
        test_triangle(w, first + k, w->left & met);
        if (count_bits_64(before & ~w->left) >= MUCH) {
            traversal_remember(w->scratch->last, LMB_LIVE_LAST, first + k);
        }
    }
}

static inline uint64_t both(uint32_t met[2][LMB_BOXES], int i) { return (uint64_t)met[1][i] << 32 | met[0][i]; }

/* Tests the leaves that wait. */
static void test_leaves(traversal *w)
{
    for (uint32_t boxes = w->leaves; boxes != 0 && w->left != 0; boxes &= boxes - 1) {
        const int i = lowest_bit(boxes);
        test_leaf(w, w->last->first[i], w->last->count[i], both(w->scratch->met[w->own], i));
    }
    w->leaves = 0;
}

/* Requests the cache lines of a box's triangles. */
static inline void ask_triangles(const lmb_bvh *bvh, const lmb_boxes *node, int i)
{
    const uint8_t *from = (const uint8_t *)&bvh->triangle[node->first[i]];
    const size_t bytes = node->count[i] * sizeof bvh->triangle[0];
    for (size_t line = 0; line < bytes; line += 64) {
        LIVE_SOON(from + line);
    }
    LIVE_SOON(from + bytes - 1);
}

static inline void ask_node(const lmb_boxes *node)
{
    for (int h = 0; h < 3; ++h) {
        LIVE_SOON(node->low[h]);
        LIVE_SOON(node->high[h]);
    }
    LIVE_SOON(node->first);
    LIVE_SOON(node->count);
}

static void test_node(traversal *w, uint32_t at, uint64_t asked)
{
    const lmb_boxes *node = &w->bvh->node[at];
    uint32_t (*met)[LMB_BOXES] = w->scratch->met[w->own ^ 1], leaves = 0;
    for (uint32_t boxes = w->kernels->live_boxes(met, &w->scratch->rays.segments, asked, node); boxes != 0;
         boxes &= boxes - 1) {
        const int i = lowest_bit(boxes);
        if (node->count[i] > 0) {
            ask_triangles(w->bvh, node, i);
            leaves |= 1u << i;
        } else if (w->waiting < LMB_LIVE_STACK) {
            ask_node(&w->bvh->node[node->first[i]]);
            w->scratch->waiting[w->waiting].node = node->first[i];
            w->scratch->waiting[w->waiting++].rays = both(met, i);
        }
    }
    test_leaves(w);
    w->own ^= 1;
    w->last = node;
    w->leaves = leaves;
}

/* --- small nodes -------------------------------------------------------------------------------------------------- */

/* The steps of the grid that all segments span. Segments outside a box on one axis do not meet it. */
typedef struct ray_span {
    int32_t low[3], high[3];
} ray_span;

enum { SPAN_SPARE = 2 /* steps: a step is larger than rounding */ };

static ray_span span_of_rays(const traversal *w)
{
    const lmb_bvh *b = w->bvh;
    const lmb_live_rays *r = &w->scratch->rays;
    const float at[3] = {r->segments.at.x, r->segments.at.y, r->segments.at.z};
    ray_span out;
    for (int h = 0; h < 3; ++h) {
        float low = 0.0f, high = 0.0f;
        for (uint64_t bits = w->left; bits != 0; bits &= bits - 1) {
            const float to = r->to[h][lowest_bit_64(bits)];
            low = minf(low, to);
            high = maxf(high, to);
        }
        const float per = 1.0f / b->small_step[h], from = at[h] - b->small_low[h];
        out.low[h] = (int32_t)clampf((from + low) * per, 0.0f, 65535.0f) - SPAN_SPARE;
        out.high[h] = (int32_t)clampf((from + high) * per, 0.0f, 65535.0f) + SPAN_SPARE;
    }
    return out;
}

static inline int is_outside_span(const ray_span *s, const lmb_small_node *n)
{
    return n->low[0] > s->high[0] || n->high[0] < s->low[0] || n->low[1] > s->high[1] || n->high[1] < s->low[1] ||
           n->low[2] > s->high[2] || n->high[2] < s->low[2];
}

/* Narrows a segment's range to that between two sides. Returns 0 if nothing is left. */
static inline int ray_slab(float *from, float *to, float low, float high, float per)
{
    const float a = low * per, b = high * per, enter = a > b ? b : a, leave = a > b ? a : b;
    *from = enter > *from ? enter : *from;
    *to = leave < *to ? leave : *to;
    return *from <= *to * 1.0000010f;
}

/* Of 32 segments from `first` on, the asked ones that meet a box: as live_boxes. low, high: from the receiver. */
static uint32_t rays_that_meet(const lmb_segments *s, int first, uint32_t asked, lmb_vec3 low, lmb_vec3 high)
{
    uint32_t out = 0;
    for (uint32_t bits = asked; bits != 0; bits &= bits - 1) {
        const int k = first + lowest_bit(bits);
        float from = 0.0f, to = 1.0f;
        if (ray_slab(&from, &to, low.x, high.x, s->per[0][k]) && ray_slab(&from, &to, low.y, high.y, s->per[1][k]) &&
            ray_slab(&from, &to, low.z, high.z, s->per[2][k])) {
            out |= bits & (~bits + 1);
        }
    }
    return out;
}

static uint64_t rays_in_node(const traversal *w, const lmb_small_node *n, uint64_t asked)
{
    const lmb_segments *s = &w->scratch->rays.segments;
    const lmb_vec3 low = sub3(small_corner(w->bvh, n->low), s->at), high = sub3(small_corner(w->bvh, n->high), s->at);
    const uint32_t one = (uint32_t)asked != 0 ? rays_that_meet(s, 0, (uint32_t)asked, low, high) : 0,
                   other = asked >> 32 != 0 ? rays_that_meet(s, 32, (uint32_t)(asked >> 32), low, high) : 0;
    return (uint64_t)other << 32 | one;
}

static void test_small_nodes(traversal *w)
{
    lmb_live_branch *waiting = w->scratch->waiting;
    const ray_span all = span_of_rays(w);
    waiting[0].rays = w->left;
    waiting[0].node = 0;
    w->waiting = 1;
    while (w->waiting > 0 && w->left != 0) {
        const lmb_live_branch next = waiting[--w->waiting];
        const lmb_small_node *node = &w->bvh->small[next.node];
        const uint64_t asked = next.rays & w->left;
        const uint64_t met = asked == 0 || is_outside_span(&all, node) ? 0 : rays_in_node(w, node, asked);
        if (met != 0 && node->count > 0) {
            test_leaf(w, node->first, node->count, met);
        } else if (met != 0) {
            waiting[w->waiting].rays = met;
            waiting[w->waiting++].node = node->first;
            waiting[w->waiting].rays = met;
            waiting[w->waiting++].node = next.node + 1;
        }
    }
}

uint64_t lmb_live_blocked(const lmb_kernels *kernels, lmb_live_scratch *scratch, const lmb_bvh *bvh,
                          const lmb_live_receiver *receiver, uint64_t asked)
{
    traversal w = {kernels, bvh, scratch, receiver, asked, 0.0f, 0, 0, NULL, 0};
    if (bvh == NULL || (bvh->node_count == 0 && bvh->small_count == 0) || asked == 0) {
        return 0;
    }
    w.noise = max_noise(bvh, receiver);
    for (int i = 0; i < LMB_LIVE_LAST && w.left != 0; ++i) {
        const uint32_t triangle = scratch->last[i];
        if (triangle != 0 && triangle <= bvh->triangle_count) {
            test_triangle(&w, triangle - 1, w.left);
        }
    }
    if (bvh->small != NULL) {
        test_small_nodes(&w);
        return asked & ~w.left;
    }
    if (w.left != 0) {
        test_node(&w, 0, w.left);
    }
    while (w.waiting > 0 && w.left != 0) {
        const lmb_live_branch next = scratch->waiting[--w.waiting];
        if ((next.rays & w.left) != 0) {
            test_node(&w, next.node, next.rays & w.left);
        }
    }
    test_leaves(&w);
    return asked & ~w.left;
}

#endif
