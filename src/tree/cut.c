/* cut.c: each tile of pixels takes its own cut through the light tree, and is lit by it. Layer 6.      [V25 V27 V28]
 *
 * node_bounds.inl computes the nodes' errors. The node with the largest error is split first. Buckets by exponent and
 * first bit of the error find it without sorting, in the same order on every target. */
#include <lambent/tree.h>

#include <string.h>

#include "../base/poly.h"
#include "../base/vec.h"
#include "../lane/kernels.h"
#include "../direct/glossy.h"
#include "../direct/footprint.h"
#include "../occlusion/traversal.h"
#include "../raster/tile.h"
#include "facets.h"
#include "pixel_cluster.h"
#include "tree.h"

#if LMB_TREES

#define MIN_SEEN_SHARE     0.03  /* pixels that see less than this share of their unblocked light count as dark */
#define MIN_FLAT_AGREEMENT 0.98f /* nodes with a lower agreement of normals are tested for children that face away */
#define MAX_ERROR_EXCESS   100.0 /* times the allowed error: if exceeded, nodes contain pixels, and splitting the pixel
                                    cluster helps */
#define STAND_OFF          4.0f  /* times the noise: offset of a texel's point towards the light */
#define LARGE_NOISE        1.5258789e-5f /* 2^-16 of the distance to the eye: the origin is then 64 times as far away */
#define SPENT_TILE_FACTOR     8.0  /* factor on the allowed light and error in a tile that has used up the tests */
#define SPENT_TILE_NODES      6144 /* maximum of nodes there; with fewer, a turned grille has 1.25 x the error. With a
                                      share of the tests, the same share of these */
#define SPENT_TILE_LATER      1024 /* the same for the later cuts of that tile. 2,000 needles have dozens: with 6144,
                                      1.7 x the time, and a trim of .064 instead of .076 */
#define TILE_TESTS            65536.0f /* mean of the tests of a row's tiles times `visibility`, whatever the calls add:
                                          4.4 million by default. Rooms of pipes need up to 5.2 million */
#define TILES_AHEAD           5.0f     /* tiles of such a mean: what a tile may use before earlier ones saved it */
#define COARSE_VISIBILITY     0.015f   /* a larger `visibility` gets as many tests as this one */
#define MAX_SPLIT_ERROR_SHARE 0.7  /* a split of the pixels must reduce the error to this share to be worth the cuts */
#define FACETS_NEAR        3.0f /* times LMB_NEAR and half the diagonal of a cell: nearer texels show facets */
enum { LEAF_PARTS_A_SIDE = 4 /* for a lobe, a near leaf is LEAF_PARTS_A_SIDE x LEAF_PARTS_A_SIDE parts */ };
enum { NO_SLOT = -1, NO_LEVEL = 0xffff /* level of a slot without a node */ };
enum { MAX_NODES_AHEAD = LMB_BOUNDS_NODES / 4 /* nodes with children bounded together */ };

/* --- the cut ------------------------------------------------------------------------------------------------------ */

typedef struct cutter {
    lmb_cut *cut;
    const lmb_tree *tree;
    const lmb_tile *tile;
    const lmb_kernels *kernels;
    const lmb_cut_params *cut_params;
    const lmb_pixel_cluster *p;
    float noise;         /* m: lmb_tile_noise of the pixel cluster */
    const lmb_view *view; /* decides sides of planes within the noise; NULL: unknown, or the noise is too large */
    uint64_t in_hull;    /* pixels of the cluster in a convex room: nothing can occlude between points in it */
    float per_pixel;     /* 1 / pixels of the cluster */
    int lobe;            /* a pixel with a lobe that represents the cluster; NO_SLOT: no lobes */
    double beside;       /* mean light of the pixels from other sources */
    int32_t ahead[MAX_NODES_AHEAD]; /* slots with bounded children that are not placed yet, four each; or NO_SLOT */
    uint32_t faces;      /* bounded nodes that do not face away */
    const float *key;    /* bucket keys: cut->error or cut->upper */
    int highest;         /* no higher bucket is in use */
    double error, value; /* sums; value: visible light only */
    double floor;        /* W/m2, R + G + B: smaller errors are ignored */
    int32_t share;       /* the tile has 1 / share of the tests and nodes of another tile */
    int32_t tests_most;  /* maximum of tests of the tile */
    int32_t spent_nodes; /* maximum of nodes of a cut in a tile that has used up the tests */
} cutter;

static double maxd(double a, double b) { return a > b ? a : b; }

static lmb_node_bounds *bounds_of(lmb_cut *c) { return (lmb_node_bounds *)(void *)c->with.nodes.bounds; }

static void set_vector(lmb_node_bounds *out, int plane, int k, lmb_vec3 v)
{
    out->node[plane][k] = v.x;
    out->node[plane + 1][k] = v.y;
    out->node[plane + 2][k] = v.z;
}

/* A node of any level; `texel` is storage for one of level 0. */
static const lmb_node *node_at(lmb_node *texel, const lmb_tree *tree, lmb_node_ref at)
{
    if (at.level > 0) {
        return tree_node(tree, at);
    }
    lmb_tree_texel_node(texel, tree, at.face, at.x, at.y);
    return texel;
}

/* Sets node k of those bounded together. */
static void set_bounded_node(lmb_node_bounds *out, int k, const lmb_tree *tree, lmb_node_ref at)
{
    lmb_node texel;
    const lmb_node *n = node_at(&texel, tree, at);
    set_vector(out, LMB_BOUNDS_CENTRE, k, n->centre);
    set_vector(out, LMB_BOUNDS_NORMAL, k, n->normal);
    set_vector(out, LMB_BOUNDS_MIDDLE, k, n->middle);
    set_vector(out, LMB_BOUNDS_ACROSS, k, n->across);
    set_vector(out, LMB_BOUNDS_HALF, k, vec3(n->half[0], n->half[1], n->half[2]));
    out->node[LMB_BOUNDS_RADIUS][k] = n->radius;
    out->node[LMB_BOUNDS_FLUX][k] = flux_sum(n->flux);
    out->node[LMB_BOUNDS_AREA][k] = n->area;
    out->node[LMB_BOUNDS_COSINE][k] = n->cosine;
    out->node[LMB_BOUNDS_AGREEMENT][k] = n->agreement;
}

static lmb_node_ref node_part(lmb_node_ref from, int k)
{
    lmb_node_ref at = from;
    at.x = (uint16_t)(2 * from.x + (k & 1));
    at.y = (uint16_t)(2 * from.y + (k >> 1));
    at.level = (uint16_t)(from.level - 1);
    return at;
}

static lmb_vec3 bounds_vector(const lmb_node_bounds *w, int plane, int k)
{
    return vec3(w->node[plane][k], w->node[plane + 1][k], w->node[plane + 2][k]);
}

/* A node's value includes the response of the glossy lobe, relative to a white Lambertian surface: pi D V F, averaged
 * over the extents of node and pixel cluster. The error of that part is the difference between the lobe's central value
 * and mean over the node. This is an estimate; only the bound of the irradiance is conservative. */
static void bound_lobe(cutter *c, int k)
{
    lmb_node_bounds *w = bounds_of(c->cut);
    const lmb_vec3 to = sub3(bounds_vector(w, LMB_BOUNDS_CENTRE, k), c->p->centre);
    const float *half = c->p->half;
    const float d2 = maxf(dot3(to, to), 1e-24f), node = w->node[LMB_BOUNDS_RADIUS][k],
                both = node + sqrtf(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
    const lmb_glossy *glossy = c->cut_params->glossy;
    const float far = lmb_glossy_factor(glossy, c->tile, c->lobe, to, minf(LMB_PI * both * both / d2, 2.0f * LMB_PI));
    const float mean = lmb_glossy_factor(glossy, c->tile, c->lobe, to, minf(LMB_PI * node * node / d2, 2.0f * LMB_PI));
    const float middle = lmb_glossy_factor(glossy, c->tile, c->lobe, to, 0.0f);
    const float gain = LMB_PI * far, off = absf(middle - mean) / maxf(middle + mean, 1e-12f);
    w->error[k] += w->upper[k] * gain * off;
    w->upper[k] *= 1.0f + gain;
    w->value[k] *= 1.0f + gain;
}

/* Bounds `count` nodes; the rest of the last vector is filled with zeros. */
static void node_bounds(cutter *c, int count)
{
    lmb_node_bounds *w = bounds_of(c->cut);
    for (int k = count; k % c->kernels->lanes != 0; ++k) {
        for (int i = 0; i < LMB_BOUNDS_PLANES; ++i) {
            w->node[i][k] = 0.0f;
        }
    }
    c->faces = c->kernels->node_bounds(w, count, c->p, c->cut_params->conservative);
    for (int k = 0; k < count && c->lobe != NO_SLOT; ++k) {
        if (c->faces >> k & 1u) {
            bound_lobe(c, k);
        }
    }
}

static int bucket_of(float key)
{
    uint32_t bits;
    memcpy(&bits, &key, sizeof bits);
    return (int)(bits >> 22) & (LMB_CUT_BUCKETS - 1);
}

/* Texels cannot be split, so they go into no bucket. */
static void wait(cutter *c, int32_t i)
{
    if (c->cut->ref[i].level > 0) {
        const int b = bucket_of(c->key[i]);
        c->cut->next[i] = c->cut->bucket[b];
        c->cut->bucket[b] = (lmb_cut_slot)i;
        c->highest = b > c->highest ? b : c->highest;
    }
}

static int32_t largest(cutter *c)
{
    while (c->highest >= 0 && c->cut->bucket[c->highest] == NO_SLOT) {
        --c->highest;
    }
    return c->highest < 0 ? NO_SLOT : c->cut->bucket[c->highest];
}

static void empty_buckets(cutter *c, const float *key)
{
    c->key = key;
    c->highest = -1;
    for (int b = 0; b < LMB_CUT_BUCKETS; ++b) {
        c->cut->bucket[b] = NO_SLOT;
    }
}

static double seen_value(const cutter *c, int32_t i)
{
    return (double)(c->cut->value[i] * ((float)count_bits_64(c->cut->visible[i]) * c->per_pixel));
}

/* The errors of many nodes have either sign, so their squares are added. The conservative bound adds absolute
 * values. */
static double counted_error(const cutter *c, int32_t i)
{
    const double e = (double)c->cut->of.error[i];
    return c->cut_params->conservative ? e : e * e;
}

/* 1 if the tile has used up the visibility tests. Tested nodes are then no longer split, nodes may carry more light and
 * error, a cut has at most `spent_nodes`, and pixels that share a cut stay together. Anything else needs more tests,
 * and light that triangles chop up would need many nodes even without tests. A conservative bound holds in every
 * tile. */
static int is_spent(const cutter *c) { return !c->cut_params->conservative && c->cut->use.traversal.left < 0; }

static double allowed_error(const cutter *c)
{
    const double share = (double)c->cut_params->error * (is_spent(c) ? SPENT_TILE_FACTOR : 1.0);
    const double upper = share * (c->beside + c->value);
    return c->cut_params->conservative ? upper : maxd(upper * upper, c->floor * c->floor);
}

/* Nodes that no pixel sees add neither light nor error. */
static void count_in_entry(cutter *c, int32_t i, double sign)
{
    if (c->cut->visible[i] != 0) {
        c->value += sign * seen_value(c, i);
        c->error += sign * counted_error(c, i);
    }
}

/* Puts bounded node k into slot i. */
static void put_entry(cutter *c, int32_t i, lmb_node_ref at, int k, uint64_t visible)
{
    const lmb_node_bounds *w = bounds_of(c->cut);
    c->cut->ref[i] = at;
    c->cut->of.error[i] = at.level > 0 ? w->error[k] : 0.0f;
    c->cut->value[i] = w->value[k];
    c->cut->upper[i] = w->upper[k];
    c->cut->visible[i] = visible;
    count_in_entry(c, i, 1.0);
}

/* 1 if the point is in front of all pixels of the cluster and they are all in front of it. Uses the cluster's box, so
 * it never returns 1 wrongly, and most nodes need no test pixel by pixel. A unit vector at an angle of sine s, under 90
 * degrees, differs by at most 1.5 s. */
static int all_before(const cutter *c, const lmb_texel *seen, float ends)
{
    const lmb_pixel_cluster *p = c->p;
    const lmb_vec3 d = sub3(seen->position, p->centre);
    const float far = length3(d) + p->half[0] + p->half[1] + p->half[2];
    const float noise = ends + 4.0f * p->noise + 2.0f * LMB_NOISE_TRIANGLE * far;
    return dot3(p->normal, d) - lmb_pixel_cluster_reach(p, p->normal) - (1.5f * p->face_sine + 1e-3f) * far > noise &&
           -dot3(seen->normal, d) - lmb_pixel_cluster_reach(p, seen->normal) - 1e-5f * far > noise;
}

static lmb_vec3 to_eye(const lmb_view *v, lmb_vec3 at)
{
    return v->kind == LMB_PERSPECTIVE ? sub3(v->eye, at) : v->back;
}

/* 1 if before_plane would move pixels that lie in the plane. */
static int eye_is_before(const cutter *c, lmb_vec3 at, lmb_vec3 normal)
{
    return c->view != NULL && dot3(normal, to_eye(c->view, at)) > 0.0f;
}

/* Returns those of `pixels` for which the point is not in front of the pixel, or the pixel not in front of the point,
 * by more than the offset within which a wall never occludes. A wall does not occlude points on it, so segments from
 * pixels behind it must not be tested. */
NOINLINE uint64_t turned_from(const cutter *c, uint64_t pixels, const lmb_texel *seen, float ends)
{
    uint64_t out = 0;
    const int faces_eye = eye_is_before(c, seen->position, seen->normal);
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 d = sub3(seen->position, tile_vec(c->tile->position, k));
        const float noise = ends + LMB_NOISE_TRIANGLE * length3(d);
        const float lowest = faces_eye ? -noise : noise;
        const int before = dot3(tile_vec(c->tile->face, k), d) > noise && -dot3(seen->normal, d) > lowest;
        out |= (uint64_t)!before << k;
    }
    return out;
}

/* 1 if a first point and the centre of the pixel cluster are in front of each other. */
static int is_before(const lmb_pixel_cluster *p, lmb_vec3 at, lmb_vec3 normal)
{
    const lmb_vec3 d = sub3(at, p->centre);
    return dot3(p->normal, d) > 0.0f && dot3(normal, d) < 0.0f;
}

static const lmb_texel *own_point(const lmb_tree *tree, lmb_node_ref at)
{
    return at.level > 0 ? tree_texel(tree, at.face, 0, 0) + tree_node(tree, at)->texel
                        : tree_texel(tree, at.face, at.x, at.y);
}

/* Returns the child that, taken as a disc, sends most light to the pixel cluster. If no child sends any, returns the
 * node itself. */
static lmb_node_ref brightest_part(const cutter *c, lmb_node_ref from)
{
    lmb_node_ref best = from;
    float upper = 0.0f;
    for (int k = 0; k < 4; ++k) {
        const lmb_node_ref at = node_part(from, k);
        lmb_node texel;
        const lmb_node *n = node_at(&texel, c->tree, at);
        const float flux = flux_sum(n->flux);
        const float sent = flux > 0.0f && is_before(c->p, n->centre, n->normal)
                               ? flux * lmb_disc_factor(c->p->centre, c->p->normal, n->centre, n->normal, n->area)
                               : 0.0f;
        best = sent > upper ? at : best;
        upper = maxf(upper, sent);
    }
    return best;
}

/* The point at which a node's visibility is tested: its own first point, or another one if that faces away. */
static const lmb_texel *visibility_point(const cutter *c, lmb_node_ref at)
{
    const lmb_texel *own = own_point(c->tree, at), *seen = own;
    while (at.level > 0 && !is_before(c->p, seen->position, seen->normal)) {
        const lmb_node_ref part = brightest_part(c, at);
        if (part.level == at.level) {
            return own;
        }
        at = part;
        seen = own_point(c->tree, at);
    }
    return seen;
}

/* Rounding of a texel's position, which is either on a light ray or the mean of an element's corners. */
static float texel_noise(const cutter *c, uint32_t face, lmb_vec3 at)
{
    return lmb_place_noise(at, c->tree->element != NULL ? 0.0f : length3(sub3(at, c->tree->view[face].eye)));
}

/* A texel's point, moved towards the light out of planes that it lies in because of rounding: it belongs on the light's
 * side of them. An element's point lies inside its own triangle and is not moved. */
static lmb_vec3 before_walls(const cutter *c, uint32_t face, lmb_vec3 at, float noise)
{
    if (c->tree->element != NULL || c->view == NULL) {
        return at;
    }
    const lmb_vec3 to_light = to_eye(&c->tree->view[face], at);
    return add3(at, mul3(to_light, STAND_OFF * noise / maxf(length3(to_light), 1e-18f)));
}

/* The triangle that hides a node from all pixels, + 1; otherwise 0. */
static uint32_t blocker_of(const lmb_cut *cut, int32_t i) { return cut->visible[i] == 0 ? cut->of.blocker[i] : 0; }

/* Facets need triangles and tests of visibility; the conservative bound does not hold for them. */
static int uses_facets(const cutter *c)
{
    return c->tree->element == NULL && c->cut_params->bvh != NULL && c->cut_params->bvh->scene != NULL &&
           !c->cut_params->conservative;
}

/* 1 if the node is a texel in which several surfaces show, and the pixels are so near that each of these counts. */
static int shows_facets(const cutter *c, lmb_node_ref at)
{
    const lmb_texel *t = at.level == 0 && uses_facets(c) ? tree_texel(c->tree, at.face, at.x, at.y) : NULL;
    if (t == NULL || !facets_are_several(t)) {
        return 0;
    }
    const facets_extent e = facets_extent_of(t, &c->tree->view[at.face], c->tree->size);
    const float step = clampf(dot3(sub3(c->p->centre, t->position), e.ray), -e.down, e.up);
    const float reach = FACETS_NEAR * LMB_NEAR * e.wide;
    return lmb_pixel_cluster_distance2(c->p, add3(t->position, mul3(e.ray, step))) < reach * reach;
}

static uint64_t occluded(const cutter *c, uint64_t pixels, lmb_vec3 at, float noise)
{
    lmb_traversal *t = &c->cut->use.traversal;
    t->left = mini(t->left, c->tests_most - (int32_t)(c->cut->tests + t->spent));
    return lmb_occluded_tile(c->kernels, t, c->cut_params->bvh, c->tile, pixels, at, noise);
}

/* Elements lie on both sides of walls, so pixels behind an element are excluded; a light's texels are all on the lit
 * side. blocker: tested first, if not 0. */
static void test_visibility(cutter *c, int32_t i, uint32_t blocker)
{
    const lmb_node_ref at = c->cut->ref[i];
    const lmb_texel *seen = visibility_point(c, at);
    const float noise = c->noise + texel_noise(c, at.face, seen->position);
    if (shows_facets(c, at)) {
        return; /* add_facets tests each facet */
    }
    count_in_entry(c, i, -1.0);
    if (c->tree->element != NULL && !all_before(c, seen, noise)) {
        c->cut->visible[i] &= ~turned_from(c, c->cut->visible[i], seen, noise);
    }
    if (c->cut_params->stats != NULL) {
        c->cut_params->stats->segments += (uint64_t)count_bits_64(c->cut->visible[i]);
    }
    uint64_t asked = c->cut->visible[i];
    if ((asked & c->in_hull) != 0 && lmb_hull_holds(&c->cut_params->bvh->hull, seen->position)) {
        asked &= ~c->in_hull;
    }
    c->cut->use.traversal.first = blocker;
    c->cut->use.traversal.blocker = 0;
    c->cut->visible[i] &= ~occluded(c, asked, before_walls(c, at.face, seen->position, noise), noise);
    if (c->cut->visible[i] == 0) {
        c->cut->of.blocker[i] = c->cut->use.traversal.blocker;
    }
    count_in_entry(c, i, 1.0);
}

/* Bounds the children of the node in slot i and of the next nodes in the buckets: nine of ten of these are split
 * next. */
static void bound_parts(cutter *c, int32_t i)
{
    const int upper = maxi(c->kernels->lanes / 4, 1);
    int count = 0, b = c->highest;
    for (int k = 0; k < MAX_NODES_AHEAD; ++k) {
        c->ahead[k] = NO_SLOT;
    }
    for (int32_t next = i; next != NO_SLOT && count < upper; ++count) {
        for (int k = 0; k < 4; ++k) {
            set_bounded_node(bounds_of(c->cut), 4 * count + k, c->tree, node_part(c->cut->ref[next], k));
        }
        c->ahead[count] = next;
        next = next == i ? c->cut->bucket[b] : c->cut->next[next];
        while (next == NO_SLOT && --b >= 0) {
            next = c->cut->bucket[b];
        }
    }
    node_bounds(c, 4 * count);
}

/* Index of the first child of the node in slot i among the bounded nodes. */
static int parts_of_entry(cutter *c, int32_t i)
{
    int k = 0;
    while (k < MAX_NODES_AHEAD && c->ahead[k] != i) {
        ++k;
    }
    if (k == MAX_NODES_AHEAD) {
        bound_parts(c, i);
        k = 0;
    }
    c->ahead[k] = NO_SLOT;
    return 4 * k;
}

/* Replaces the node in slot i by the four children: the first in this slot, the others at the end. */
static void divide_entry(cutter *c, int32_t i, uint64_t visible, int asks)
{
    const lmb_node_ref from = c->cut->ref[i];
    const int first = parts_of_entry(c, i);
    const uint32_t blocker = blocker_of(c->cut, i);
    int32_t slot = i;
    count_in_entry(c, i, -1.0);
    c->cut->ref[i].level = NO_LEVEL;
    for (int k = 0; k < 4; ++k) {
        if (c->faces >> (first + k) & 1u) {
            const int32_t to = slot >= 0 ? slot : c->cut->count++;
            put_entry(c, to, node_part(from, k), first + k, visible);
            if (asks) {
                test_visibility(c, to, blocker);
            }
            wait(c, to);
            slot = NO_SLOT;
        }
    }
}

static int has_room(const cutter *c)
{
    return c->cut->count + 3 <= LMB_MAX_CUT && !(is_spent(c) && c->cut->count > c->spent_nodes);
}

/* Largest light of a node with a single visibility test. */
static double allowed_upper(const cutter *c, double lower)
{
    const double share = (double)c->cut_params->visibility * (is_spent(c) ? SPENT_TILE_FACTOR : 1.0);
    return maxd(share * (c->beside + maxd(c->value, lower)), c->floor);
}

#if LMB_FACETS

/* Heights of a box's corners over the plane of a triangle, and over the inner sides of the triangle's edges. */
typedef struct hidden_corners {
    float height[8], inside[3][8];
} hidden_corners;

/* Planes of a triangle: its own, and those through its edges, perpendicular to it; unit, towards the inside. */
typedef struct hiding_planes {
    lmb_vec3 on[3], normal, inner[3];
} hiding_planes;

static void set_corners(hidden_corners *out, const hiding_planes *t, lmb_vec3 middle, const lmb_vec3 side[3])
{
    for (int i = 0; i < 8; ++i) {
        const lmb_vec3 at = add3(middle, add3(mul3(side[0], i & 1 ? 1.0f : -1.0f),
                                              add3(mul3(side[1], i & 2 ? 1.0f : -1.0f),
                                                   mul3(side[2], i & 4 ? 1.0f : -1.0f))));
        out->height[i] = dot3(t->normal, sub3(at, t->on[0]));
        for (int k = 0; k < 3; ++k) {
            out->inside[k][i] = dot3(t->inner[k], sub3(at, t->on[k]));
        }
    }
}

/* 1 if all corners lie on one side of the plane, at least `margin` off. */
static int are_on_side(const hidden_corners *c, float sign, float margin)
{
    int all = 1;
    for (int i = 0; i < 8; ++i) {
        all &= sign * c->height[i] > margin;
    }
    return all;
}

/* 1 if a triangle crosses all segments between a node's box and the box of the pixel cluster. The places at which these
 * meet the plane lie between those of the segments between corners. Then no part of the node is visible. */
NOINLINE int hides_node(const cutter *c, const lmb_node *n, const lmb_bvh_triangle *by, float margin)
{
    const lmb_pixel_cluster *p = c->p;
    const float before = dot3(by->normal, sub3(p->centre, by->corner[0])),
                behind = dot3(by->normal, sub3(n->middle, by->corner[0]));
    hiding_planes t;
    hidden_corners from, to;
    if (!(before * behind < 0.0f) || absf(behind) < n->half[0] * absf(dot3(by->normal, n->normal))) {
        return 0;
    }
    const lmb_vec3 far[3] = {mul3(n->normal, n->half[0]), mul3(n->across, n->half[1]),
                             mul3(cross3(n->normal, n->across), n->half[2])};
    const lmb_vec3 near[3] = {mul3(p->axis[0], p->half[0]), mul3(p->axis[1], p->half[1]),
                              mul3(p->axis[2], p->half[2])};
    t.normal = by->normal;
    for (int k = 0; k < 3; ++k) {
        t.on[k] = by->corner[k];
        t.inner[k] = normalize3(cross3(t.normal, sub3(by->corner[(k + 1) % 3], by->corner[k])));
    }
    const float turn = dot3(t.inner[0], sub3(by->corner[2], by->corner[0])) < 0.0f ? -1.0f : 1.0f;
    for (int k = 0; k < 3; ++k) {
        t.inner[k] = mul3(t.inner[k], turn);
    }
    set_corners(&from, &t, p->centre, near);
    set_corners(&to, &t, n->middle, far);
    const float sign = from.height[0] < 0.0f ? -1.0f : 1.0f;
    if (!are_on_side(&from, sign, margin) || !are_on_side(&to, -sign, margin)) {
        return 0;
    }
    int all = 1;
    for (int i = 0; i < 64 && all; ++i) {
        const float here = sign * from.height[i / 8], there = -sign * to.height[i % 8];
        for (int k = 0; k < 3; ++k) {
            all &= from.inside[k][i / 8] * there + to.inside[k][i % 8] * here > margin * (here + there);
        }
    }
    return all;
}

/* 1 if the triangle that hid a node's own point from all pixels hides the whole node. */
NOINLINE int is_hidden(const cutter *c, int32_t i)
{
    const uint32_t blocker = blocker_of(c->cut, i);
    if (blocker == 0 || c->tree->element != NULL || c->cut->ref[i].level < 2) {
        return 0;
    }
    const lmb_bvh_triangle *by = &c->cut_params->bvh->triangle[blocker - 1];
    const lmb_node *n = tree_node(c->tree, c->cut->ref[i]);
    const float size = length3(sub3(n->middle, c->p->centre)) + n->radius,
                noise = c->noise + texel_noise(c, c->cut->ref[i].face, n->middle);
    return (by->id & LMB_BVH_MASKED) == 0 &&
           hides_node(c, n, by, 2.0f * STAND_OFF * (noise + LMB_NOISE_TRIANGLE * size));
}

#else
#define is_hidden(c, i) 0
#endif

/* Splits the node with the largest upper bound until no node exceeds the allowed bound. Returns 0, or, if the cut is
 * full, the factor by which the largest exceeds it. */
static double divide_by_upper(cutter *c, double lower, int asks)
{
    int32_t i = largest(c);
    while (i != NO_SLOT && has_room(c) && (double)c->cut->upper[i] > allowed_upper(c, lower)) {
        if (asks && is_spent(c)) {
            ++c->cut->use.traversal.coarse;
            return 0.0;
        }
        c->cut->bucket[c->highest] = c->cut->next[i];
        if (!asks || !is_hidden(c, i)) {
            divide_entry(c, i, c->p->pixels, asks);
        }
        i = largest(c);
    }
    return i != NO_SLOT && !has_room(c) ? (double)c->cut->upper[i] / maxd(allowed_upper(c, lower), 1e-30) : 0.0;
}

static double divide_by_error(cutter *c)
{
    int32_t i = largest(c);
    while (i != NO_SLOT && has_room(c) && c->error > allowed_error(c)) {
        c->cut->bucket[c->highest] = c->cut->next[i];
        divide_entry(c, i, c->cut->visible[i], 0);
        i = largest(c);
    }
    return i != NO_SLOT && !has_room(c) ? c->error / maxd(allowed_error(c), 1e-30) : 0.0;
}

/* Large errors that were added and removed leave their rounding in the sum, so this adds it up again. */
static int is_right(cutter *c)
{
    c->error = 0.0;
    for (int32_t i = 0; i < c->cut->count; ++i) {
        if (c->cut->ref[i].level != NO_LEVEL && c->cut->visible[i] != 0) {
            c->error += counted_error(c, i);
        }
    }
    return c->error <= allowed_error(c);
}

/* Starts the cut with the roots of the faces. */
NOINLINE void begin_cut(cutter *c)
{
    c->cut->count = 0;
    c->error = c->value = 0.0;
    empty_buckets(c, c->cut->upper);
    for (uint32_t first = 0; first < c->tree->faces; first += LMB_BOUNDS_NODES) {
        lmb_node_ref root[LMB_BOUNDS_NODES];
        const int count = mini((int32_t)(c->tree->faces - first), LMB_BOUNDS_NODES);
        for (int k = 0; k < count; ++k) {
            root[k].face = (uint16_t)(first + (uint32_t)k);
            root[k].x = root[k].y = 0;
            root[k].level = (uint16_t)tree_root_level(c->tree);
            set_bounded_node(bounds_of(c->cut), k, c->tree, root[k]);
        }
        node_bounds(c, count);
        for (int k = 0; k < count && c->cut->count < LMB_MAX_CUT; ++k) {
            if (c->faces >> k & 1u) {
                put_entry(c, c->cut->count, root[k], k, c->p->pixels);
                wait(c, c->cut->count++);
            }
        }
    }
    for (int k = 0; k < MAX_NODES_AHEAD; ++k) {
        c->ahead[k] = NO_SLOT;
    }
}

/* Puts the visible nodes into buckets, to be split by error. */
static void wait_by_error(cutter *c)
{
    empty_buckets(c, c->cut->of.error);
    c->error = 0.0;
    for (int32_t i = 0; i < c->cut->count; ++i) {
        if (c->cut->ref[i].level != NO_LEVEL && c->cut->visible[i] != 0) {
            c->error += counted_error(c, i);
            wait(c, i);
        }
    }
}

/* First splits until each node is small enough for one visibility test. That cut also gives usable errors: splitting by
 * error from the roots divided 13 times as many nodes. Then splits the visible nodes. Returns 0, or, if the cut is
 * full, the factor by which the worst node exceeds the allowed error. */
static double take_cut(cutter *c)
{
    double over = 0.0;
    begin_cut(c);
    divide_by_upper(c, 0.0, 0);
    if (c->cut_params->bvh != NULL) {
        const double lower = c->value * MIN_SEEN_SHARE;
        for (int32_t i = 0; i < c->cut->count; ++i) {
            if (c->cut->ref[i].level != NO_LEVEL) {
                test_visibility(c, i, 0);
            }
        }
        over = divide_by_upper(c, lower, 1);
    }
    wait_by_error(c);
    do {
        over = maxd(over, divide_by_error(c));
    } while (!is_right(c) && has_room(c) && largest(c) != NO_SLOT);
    return over;
}

/* --- light -------------------------------------------------------------------------------------------------------- */

/* The shape of a texel or an element. */
typedef struct leaf {
    lmb_node node;
    lmb_vec3 u, v;              /* half sides of a texel's quad */
    const lmb_element *element; /* NULL: a texel */
    float half2;                /* distance from centre to farthest corner, squared */
    int is_crease;              /* 1: planes meet in the texel, so it is not a quad */
} leaf;

static void leaf_at(leaf *out, const lmb_tree *tree, lmb_node_ref at)
{
    out->is_crease = lmb_tree_texel_quad(&out->node, &out->u, &out->v, tree, at.face, at.x, at.y);
    out->element = tree_element(tree, at.x, at.y);
    if (out->is_crease) {
        out->half2 = out->node.radius * out->node.radius;
    } else {
        out->half2 = out->element != NULL
                         ? out->element->reach2
                         : dot3(out->u, out->u) + dot3(out->v, out->v) + 2.0f * absf(dot3(out->u, out->v));
    }
}

static lmb_vec3 place_before(const cutter *c, int k, lmb_vec3 on_plane, lmb_vec3 axis)
{
    const lmb_vec3 at = tile_vec(c->tile->position, k);
    const float noise = 2.0f * c->noise + LMB_NOISE_TRIANGLE * length3(sub3(at, on_plane));
    return c->view == NULL ? at : before_plane(at, noise, on_plane, axis, to_eye(c->view, at));
}

static float leaf_factor(const leaf *l, lmb_vec3 at, lmb_vec3 face, lmb_vec3 normal)
{
    return l->element != NULL ? lmb_triangle_factor(at, face, normal, l->element->corner, l->node.normal)
                              : lmb_quad_factor(at, face, normal, l->node.centre, l->node.normal, l->u, l->v);
}

static uint64_t pixels_near_leaf(const lmb_tile *tile, const leaf *l, uint64_t visible)
{
    uint64_t out = 0;
    for (uint64_t bits = visible; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 d = sub3(l->node.centre, tile_vec(tile->position, k));
        out |= (uint64_t)(dot3(d, d) < LMB_NEAR * LMB_NEAR * l->half2) << k;
    }
    return out;
}

static void add_flux(lmb_irradiance *inout, int k, float factor, const float flux[3])
{
    for (int c = 0; c < 3; ++c) {
        inout->rgb[c][k] += factor * flux[c];
    }
}

/* Adds a texel in which planes meet, clipped to the part that shows the texel's plane. */
static void add_crease(lmb_irradiance *inout, const cutter *c, lmb_node_ref at, uint64_t pixels)
{
    const lmb_texel *t = tree_texel(c->tree, at.face, at.x, at.y);
    lmb_vec3 corner[CREASE_CORNERS], u, v;
    footprint_sides(&u, &v, &c->tree->view[at.face], c->tree->size, t->position, t->normal);
    const float per_area = 1.0f / length3(cross3(u, v));
    for (int part = 0; part < CREASE_PARTS; ++part) {
        const int corners = lmb_crease_part(corner, c->tree, at, part);
        for (uint64_t bits = corners > 0 ? pixels : 0; bits != 0; bits &= bits - 1) {
            const int k = lowest_bit_64(bits);
            const float f = lmb_polygon_factor(place_before(c, k, t->position, t->normal), tile_vec(c->tile->face, k),
                                               tile_vec(c->tile->normal, k), corner, corners, t->normal);
            add_flux(inout, k, f * per_area, t->flux);
        }
    }
}

/* Centre of part i of a leaf's LEAF_PARTS_A_SIDE^2 equal parts. Those of a triangle lie in LEAF_PARTS_A_SIDE rows of
 * 1, 3, 5, ... */
static lmb_vec3 leaf_part(const leaf *l, int i)
{
    if (l->element == NULL) {
        const float x = (float)(2 * (i % LEAF_PARTS_A_SIDE) + 1 - LEAF_PARTS_A_SIDE) / (float)LEAF_PARTS_A_SIDE,
                    y = (float)(2 * (i / LEAF_PARTS_A_SIDE) + 1 - LEAF_PARTS_A_SIDE) / (float)LEAF_PARTS_A_SIDE;
        return add3(l->node.centre, add3(mul3(l->u, x), mul3(l->v, y)));
    }
    const lmb_vec3 *corner = l->element->corner;
    int row = 0;
    while ((row + 1) * (row + 1) <= i) {
        ++row;
    }
    const int at = i - row * row; /* even: a corner of the part points to corner 0, odd: away from it */
    const float down = ((float)row + (at & 1 ? 1.0f / 3.0f : 2.0f / 3.0f)) / (float)LEAF_PARTS_A_SIDE;
    const float across = ((float)(at / 2) + (at & 1 ? 2.0f / 3.0f : 1.0f / 3.0f)) / (float)LEAF_PARTS_A_SIDE;
    return add3(corner[0], add3(mul3(sub3(corner[1], corner[0]), down), mul3(sub3(corner[2], corner[1]), across)));
}

/* Adds the lobe's response to a near leaf, as the sum over discs for the parts: a single disc would show as a bright
 * spot at the leaf's centre. Closer to the leaf's plane than the width of a part, the reflection is too dark. */
static void add_glossy(const cutter *c, int k, const leaf *l)
{
    const lmb_vec3 at = tile_vec(c->tile->position, k), face = tile_vec(c->tile->face, k),
                   normal = tile_vec(c->tile->normal, k);
    const lmb_node *n = &l->node;
    const float share = 1.0f / (float)(LEAF_PARTS_A_SIDE * LEAF_PARTS_A_SIDE), area = n->area * share;
    if (dot3(n->normal, sub3(n->centre, at)) >= 0.0f) {
        return; /* on the plane of the leaf or behind it: most near leaves of a surface are its own */
    }
    for (int i = 0; i < LEAF_PARTS_A_SIDE * LEAF_PARTS_A_SIDE; ++i) {
        const lmb_vec3 part = leaf_part(l, i), to = sub3(part, at);
        const float factor = share * lmb_disc_factor(at, normal, part, n->normal, area);
        if (dot3(face, to) > 0.0f && factor > 0.0f) {
            const float r2 = maxf(dot3(to, to), 1e-24f), size = area / (r2 + area * LMB_INVERSE_PI);
            lmb_glossy_add(c->cut_params->glossy, c->tile, k, to, size * maxf(-dot3(n->normal, to), 0.0f) / sqrtf(r2),
                           vec3(factor * n->flux[0], factor * n->flux[1], factor * n->flux[2]));
        }
    }
}

/* Adds the leaf to those of the pixels that have a lobe. */
static void add_near_glossy(const cutter *c, const leaf *l, uint64_t pixels)
{
    const uint64_t own = c->cut_params->glossy != NULL ? c->cut_params->glossy->pixels & pixels : 0;
    for (uint64_t bits = own; bits != 0; bits &= bits - 1) {
        add_glossy(c, lowest_bit_64(bits), l);
    }
}

/* Returns those of `pixels` in front of the plane of a texel's own point. If light grazes a texel, the texel's shape
 * leaves that plane and may be in front of pixels that are behind the surface. */
static uint64_t before_point(const cutter *c, uint64_t pixels, const lmb_texel *t)
{
    uint64_t out = 0;
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 at = place_before(c, k, t->position, t->normal);
        out |= (uint64_t)(dot3(t->normal, sub3(at, t->position)) >= 0.0f) << k;
    }
    return out;
}

/* Adds, pixel by pixel, a leaf so near that the shape matters. */
NOINLINE void add_near_leaf(lmb_irradiance *inout, const cutter *c, lmb_node_ref at, const leaf *l, uint64_t visible)
{
    const lmb_tile *tile = c->tile;
    const lmb_node *n = &l->node;
    if (l->element == NULL) {
        visible = before_point(c, visible, tree_texel(c->tree, at.face, at.x, at.y));
    }
    const uint64_t near = pixels_near_leaf(tile, l, visible);
    add_near_glossy(c, l, visible);
    if (l->is_crease && near != 0) {
        add_crease(inout, c, at, near);
        visible &= ~near;
    }
    for (uint64_t bits = visible; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 to = tile_vec(tile->position, k), normal = tile_vec(tile->normal, k),
                       face = tile_vec(tile->face, k);
        float f = 0.0f;
        if (near >> k & 1u) {
            f = leaf_factor(l, place_before(c, k, n->centre, n->normal), face, normal);
        } else if (dot3(face, sub3(n->centre, to)) > 0.0f) {
            f = lmb_disc_factor(to, normal, n->centre, n->normal, n->area);
        }
        add_flux(inout, k, f, n->flux);
    }
}

/* Clears the state of the tests, which shares memory with the pairs of a gather. */
static void begin_traversal(const cutter *c)
{
    lmb_traversal *t = &c->cut->use.traversal;
    memset(t->last, 0, sizeof t->last);
    t->first = t->asked = t->alone = 0;
    t->eye_kind = LMB_EYE_NONE;
    if (c->view != NULL) {
        const lmb_view *v = c->view;
        t->eye_kind = v->kind == LMB_PERSPECTIVE ? LMB_EYE_PLACE : LMB_EYE_FAR;
        t->eye = v->kind == LMB_PERSPECTIVE ? v->eye : v->back;
    }
    t->bounded = 1;
    t->spent = t->end = 0;
    t->left = c->cut->tests_left;
    t->coarse = 0;
}

static void end_traversal(const cutter *c)
{
    const lmb_traversal *t = &c->cut->use.traversal;
    c->cut->tests_left = t->left;
    c->cut->tests += t->spent;
    c->cut->coarse += t->coarse;
}

#if LMB_FACETS

/* Returns those of `pixels` that see a facet: in front of it, with a corner above their horizon, and nothing
 * between. */
static uint64_t see_facet(const cutter *c, uint32_t face, const lmb_facet *f, uint64_t pixels)
{
    uint64_t out = 0;
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 at = place_before(c, k, f->middle, f->normal), up = tile_vec(c->tile->face, k);
        int over = 0;
        for (int i = 0; i < f->corners; ++i) {
            over |= dot3(up, sub3(f->corner[i], at)) > 0.0f;
        }
        out |= (uint64_t)(over && dot3(f->normal, sub3(at, f->middle)) >= 0.0f) << k;
    }
    const float noise = c->noise + texel_noise(c, face, f->middle);
    uint64_t asked = out;
    if ((asked & c->in_hull) != 0 && lmb_hull_holds(&c->cut_params->bvh->hull, f->middle)) {
        asked &= ~c->in_hull;
    }
    if (c->cut_params->stats != NULL) {
        c->cut_params->stats->segments += (uint64_t)count_bits_64(out);
    }
    c->cut->use.traversal.first = 0;
    return out & ~occluded(c, asked, before_walls(c, face, f->middle, noise), noise);
}

/* Adds a texel in which several surfaces show, facet by facet. A lobe gets the texel's own leaf. */
NOINLINE void add_facets(lmb_irradiance *inout, const cutter *c, lmb_node_ref at, const leaf *l, uint64_t pixels)
{
    uint64_t lit = 0;
    lmb_facets *all = (lmb_facets *)(void *)c->cut->with.facets;
    lmb_facet f;
    lmb_facets_open(all, c->tree, c->cut_params->bvh->scene, at);
    begin_traversal(c);
    while (lmb_facets_next(&f, all)) {
        const uint64_t seen = see_facet(c, at.face, &f, pixels);
        lit |= seen;
        for (uint64_t bits = seen; bits != 0; bits &= bits - 1) {
            const int k = lowest_bit_64(bits);
            const float factor = lmb_polygon_factor(place_before(c, k, f.middle, f.normal), tile_vec(c->tile->face, k),
                                                    tile_vec(c->tile->normal, k), f.corner, f.corners, f.normal);
            add_flux(inout, k, factor, f.flux);
        }
    }
    add_near_glossy(c, l, lit);
    end_traversal(c);
}

#endif

/* 1 if a pixel of the cluster may be near the leaf. */
static int is_leaf_near(const lmb_pixel_cluster *p, const leaf *l)
{
    return lmb_pixel_cluster_distance2(p, l->node.centre) < LMB_NEAR * LMB_NEAR * l->half2;
}

static void set_emitter(lmb_emitter *out, const lmb_node *n, uint64_t visible)
{
    out->position = n->centre;
    out->back = mul3(n->normal, -1.0f);
    out->area_pi = n->area * LMB_INVERSE_PI;
    for (int c = 0; c < 3; ++c) {
        out->flux[c] = n->flux[c] * n->agreement;
    }
    out->visible = visible;
}

/* Emitters queued for the gather, a block at a time. */
typedef struct stream {
    lmb_irradiance *inout;
    const cutter *c;
    uint64_t pairs;
    int32_t filled;
} stream;

static void flush(stream *s)
{
    const cutter *c = s->c;
    c->kernels->gather_cut(s->inout, c->cut->use.pairs, c->tile, c->cut->with.nodes.emitter, s->filled);
    if (c->cut_params->glossy != NULL) {
        c->kernels->glossy_cut(c->cut_params->glossy, c->tile, c->cut->with.nodes.emitter, s->filled);
    }
    s->filled = 0;
}

/* If some children of a node may face away from the whole cluster, replaces the node by the sum of the others: in the
 * node's mean they would count as negative light. */
static void face_on(lmb_node *out, const cutter *c, lmb_node_ref from, const lmb_node *whole)
{
    lmb_vec3 normal = vec3(0, 0, 0), centre = vec3(0, 0, 0);
    float weight = 0.0f;
    *out = *whole;
    out->flux[0] = out->flux[1] = out->flux[2] = out->area = 0.0f;
    for (int k = 0; k < 4; ++k) {
        lmb_node texel;
        const lmb_node *n = node_at(&texel, c->tree, node_part(from, k));
        const float w = flux_sum(n->flux);
        if (w > 0.0f && dot3(n->normal, sub3(n->centre, c->p->centre)) < lmb_pixel_cluster_reach(c->p, n->normal)) {
            centre = add3(centre, mul3(sub3(n->centre, whole->centre), w));
            normal = add3(normal, mul3(n->normal, w * n->agreement));
            weight += w;
            out->area += n->area;
            for (int i = 0; i < 3; ++i) {
                out->flux[i] += n->flux[i];
            }
        }
    }
    if (weight > 0.0f) {
        out->centre = add3(whole->centre, mul3(centre, 1.0f / weight));
        out->agreement = minf(length3(normal) / weight, 1.0f);
        out->normal = normalize3(normal);
    }
}

static void light_by(stream *s, lmb_node_ref at, uint64_t visible)
{
    lmb_node part;
    const cutter *c = s->c;
    const lmb_node *n;
    leaf l;
    s->pairs += (uint64_t)count_bits_64(visible);
    if (at.level > 0) {
        n = tree_node(c->tree, at);
        if (n->agreement < MIN_FLAT_AGREEMENT && !c->cut_params->conservative) {
            face_on(&part, c, at, n);
            n = &part;
        }
    } else {
        leaf_at(&l, c->tree, at);
#if LMB_FACETS
        if (shows_facets(c, at)) {
            flush(s); /* facets take the emitters' memory */
            add_facets(s->inout, c, at, &l, visible);
            return;
        }
#endif
        if (is_leaf_near(c->p, &l)) {
            add_near_leaf(s->inout, c, at, &l, visible);
            return;
        }
        n = &l.node;
    }
    set_emitter(&c->cut->with.nodes.emitter[s->filled++], n, visible);
    if (s->filled == LMB_CUT_BLOCK) {
        flush(s);
    }
}

/* Lights the pixels by every texel. For scenes without occluders, if a full cut does not meet a conservative bound. */
static void light_by_all(stream *s)
{
    const int32_t size = s->c->tree->size;
    for (int64_t i = 0; i < (int64_t)s->c->tree->faces * size * size; ++i) {
        const int32_t within = (int32_t)(i % ((int64_t)size * size));
        lmb_node_ref at;
        at.face = (uint16_t)(i / ((int64_t)size * size));
        at.x = (uint16_t)(within % size);
        at.y = (uint16_t)(within / size);
        at.level = 0;
        if (flux_sum(tree_texel(s->c->tree, at.face, at.x, at.y)->flux) > 0.0f) {
            light_by(s, at, s->c->p->pixels);
        }
    }
}

NOINLINE void light_cluster(lmb_irradiance *inout, cutter *c)
{
    stream s;
    s.inout = inout;
    s.c = c;
    s.pairs = 0;
    s.filled = 0;
    if (c->cut_params->conservative && c->cut_params->bvh == NULL && !is_right(c)) {
        light_by_all(&s);
    } else {
        for (int32_t i = 0; i < c->cut->count; ++i) {
            if (c->cut->ref[i].level != NO_LEVEL && c->cut->visible[i] != 0) {
                light_by(&s, c->cut->ref[i], c->cut->visible[i]);
            }
        }
    }
    flush(&s);
    if (c->cut_params->stats != NULL) {
        c->cut_params->stats->pairs += s.pairs;
    }
}

/* The middle one of the cluster's pixels with a lobe. */
static int lobe_of(const lmb_cut_params *cut_params, const lmb_pixel_cluster *p)
{
    uint64_t own = cut_params->glossy != NULL && !cut_params->conservative ? cut_params->glossy->pixels & p->pixels : 0;
    for (int i = count_bits_64(own) / 2; i > 0; --i) {
        own &= own - 1;
    }
    return own != 0 ? lowest_bit_64(own) : NO_SLOT;
}

/* The minimum over the pixels: 0 at the edge of a shadow. */
static double lower_direct(const lmb_cut_params *cut_params, const lmb_pixel_cluster *p)
{
    float lower = cut_params->direct != NULL ? 3e38f : 0.0f;
    for (uint64_t bits = cut_params->direct != NULL ? p->pixels : 0; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        lower =
            minf(lower, cut_params->direct->rgb[0][k] + cut_params->direct->rgb[1][k] + cut_params->direct->rgb[2][k]);
    }
    return (double)lower;
}

/* The mean over the pixel cluster; not a bound for single pixels. */
static double beside(const lmb_cut_params *cut_params, const lmb_pixel_cluster *p, float per_pixel)
{
    double sum = 0.0;
    for (uint64_t bits = cut_params->beside != NULL && !cut_params->conservative ? p->pixels : 0; bits != 0;
         bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        for (int c = 0; c < 3; ++c) {
            sum += (double)cut_params->beside->rgb[c][k];
        }
    }
    return sum * (double)per_pixel +
           (cut_params->conservative ? 0.0 : (double)cut_params->lower + lower_direct(cut_params, p));
}

/* Half of the pixels: the first ones along the longer side of the cluster's box. */
NOINLINE uint64_t half_of_cluster(const lmb_pixel_cluster *p, const lmb_tile *tile)
{
    const lmb_vec3 along = p->half[2] > p->half[1] ? p->axis[2] : p->axis[1];
    float at[LMB_TILE_PIXELS] = {0};
    uint64_t out = 0;
    for (uint64_t bits = p->pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        at[k] = dot3(along, sub3(tile_vec(tile->position, k), p->centre));
    }
    for (uint64_t bits = p->pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        int before = 0;
        for (uint64_t others = p->pixels; others != 0; others &= others - 1) {
            const int i = lowest_bit_64(others);
            before += at[i] < at[k] || (at[i] == at[k] && i < k);
        }
        out |= (uint64_t)(2 * before < count_bits_64(p->pixels)) << k;
    }
    return out;
}

/* Lights some pixels of one surface with one cut. If the cut is full, and cuts of half the pixels come closer to the
 * allowed error, leaves the pixels unlit and returns 0. over: the factor by which the cut of twice as many pixels
 * exceeded the error; updated. */
static int light_together(lmb_irradiance *inout, cutter *c, lmb_pixel_cluster *p, double *over)
{
    const lmb_cut_params *cut_params = c->cut_params;
    c->p = p;
    c->noise = lmb_tile_noise(c->tile, p->pixels);
    c->view = cut_params->view;
    if (c->view != NULL && c->noise > LARGE_NOISE * length3(sub3(c->view->eye, p->centre))) {
        c->view = NULL;
    }
    c->in_hull = cut_params->bvh != NULL ? lmb_hull_pixels(&cut_params->bvh->hull, c->tile, p->pixels) : 0;
    c->per_pixel = 1.0f / (float)count_bits_64(p->pixels);
    c->beside = beside(cut_params, p, c->per_pixel);
    c->lobe = lobe_of(cut_params, p);
    begin_traversal(c);
    const double now = take_cut(c);
    end_traversal(c);
    if (now > 0.0 && (now < MAX_SPLIT_ERROR_SHARE * *over || now > MAX_ERROR_EXCESS) && count_bits_64(p->pixels) > 1 &&
        !is_spent(c)) {
        *over = now;
        return 0;
    }
    if (now > 0.0 && cut_params->stats != NULL && !(LMB_MAX_CUT > SPENT_TILE_NODES && is_spent(c))) {
        ++cut_params->stats->full_cuts;
    }
    if (is_spent(c)) {
        c->spent_nodes = SPENT_TILE_LATER / c->share;
    }
    light_cluster(inout, c);
    return 1;
}

/* Pixels without a cut so far, and the factor by which the cut of twice as many exceeded the allowed error. */
typedef struct waiting {
    uint64_t pixels;
    double over;
} waiting;
enum { MAX_CLUSTER_HALVES = 7 /* 64 pixels, 32, ... 1 */ };

/* Cost: each split into halves wastes one full cut. */
static void light_surface(lmb_irradiance *inout, cutter *c, uint64_t pixels)
{
    waiting wait[MAX_CLUSTER_HALVES + 1];
    int count = 1;
    wait[0].pixels = pixels;
    wait[0].over = 1e300;
    while (count > 0) {
        const waiting now = wait[--count];
        lmb_pixel_cluster p;
        double over = now.over;
        lmb_pixel_cluster_of(&p, c->tile, now.pixels);
        if (!light_together(inout, c, &p, &over)) {
            wait[count].pixels = half_of_cluster(&p, c->tile);
            wait[count + 1].pixels = p.pixels & ~wait[count].pixels;
            wait[count].over = wait[count + 1].over = over;
            count += 2;
        }
    }
}

/* Mean of the tests of a row's tiles, at most 2^27: a few tiles stay below 2^31. */
static float mean_tests(const cutter *c)
{
    return minf(TILE_TESTS / (minf(c->cut_params->visibility, COARSE_VISIBILITY) * (float)c->share), 134217728.0f);
}

lmb_status lmb_gather_cut(lmb_irradiance *inout, const lmb_kernels *kernels, lmb_cut *scratch, const lmb_tile *tile,
                          const lmb_tree *tree, const lmb_cut_params *cut_params)
{
    cutter c;
    int64_t none = 0, *saved = cut_params != NULL && cut_params->saved != NULL ? cut_params->saved : &none;
    if (inout == NULL || kernels == NULL || scratch == NULL || tile == NULL || tree == NULL || tree->texel == NULL ||
        cut_params == NULL || !(cut_params->error > 0.0f) || !(cut_params->visibility > 0.0f)) {
        return LMB_ERR_ARG;
    }
    c.cut = scratch;
    c.tree = tree;
    c.tile = tile;
    c.kernels = kernels;
    c.cut_params = cut_params;
    c.floor = (double)cut_params->floor;
    scratch->tests_left = cut_params->tests > 0 ? mini(cut_params->tests, LMB_TRAVERSAL_FIRST) : LMB_TRAVERSAL_FIRST;
    c.share = LMB_TRAVERSAL_FIRST / scratch->tests_left;
    c.spent_nodes = SPENT_TILE_NODES / c.share;
    *saved += (int64_t)mean_tests(&c);
    c.tests_most = (int32_t)minf(TILES_AHEAD * mean_tests(&c) + (float)*saved, 1e9f);
    scratch->tests = 0;
    scratch->coarse = 0;
    for (uint64_t left = tile_pixels(tile); left != 0;) {
        const uint64_t pixels = tile_surface(tile, left);
        light_surface(inout, &c, pixels);
        left &= ~pixels;
    }
    *saved -= (int64_t)scratch->tests;
    if (cut_params->stats != NULL && cut_params->bvh != NULL) {
        ++cut_params->stats->tiles;
        cut_params->stats->coarse_tiles += scratch->coarse != 0;
    }
    return LMB_OK;
}

#endif
