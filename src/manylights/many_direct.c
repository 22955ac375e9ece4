/* many_direct.c: a tile's surfaces, lit by their cuts of many lights: shadow tests, then light. Floor 6.    [V3 V29] */
#include <string.h>

#include "../raster/tile.h"
#include "many_cut.h"

#if LMB_TREES

#define SURFACES 4 /* of a tile that take a cut of their own; the last takes what is left */

/* --- the tile's surfaces ------------------------------------------------------------------------------------------ */

static lmb_many_job job_of(const lmb_tile *tile, uint64_t pixels)
{
    lmb_many_job job;
    lmb_vec3 low, high;
    float bend2 = 0.0f;
    tile_box(&low, &high, tile, pixels);
    job.normal = tile_vec(tile->normal, lowest_bit_64(pixels));
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const lmb_vec3 turn = sub3(tile_vec(tile->normal, lowest_bit_64(bits)), job.normal);
        bend2 = maxf(bend2, dot3(turn, turn));
    }
    job.middle = mul3(add3(low, high), 0.5f);
    job.half = mul3(sub3(high, low), 0.5f);
    job.bend = sqrtf(bend2);
    return job;
}

/* --- shadows and light -------------------------------------------------------------------------------------------- */

/* One surface of a tile, while it is lit. */
typedef struct lit_surface {
    const lmb_kernels *kernels;
    const lmb_tile *tile;
    const lmb_many_look *look;
    lmb_many_job job;
    uint64_t pixels, corners;
    float noise; /* m: lmb_tile_noise of the pixels */
    lmb_walk *walk;
} lit_surface;

/* The outermost pixels along both diagonals. */
static uint64_t corners_of(uint64_t pixels)
{
    int at[4] = {0, 0, 0, 0}, best[4] = {-99, -99, -99, -99};
    uint64_t r = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int x = k % LMB_TILE, y = k / LMB_TILE, way[4] = {-x - y, x - y, y - x, x + y};
        for (int i = 0; i < 4 && (pixels >> k & 1u) != 0; ++i) {
            if (way[i] > best[i]) {
                best[i] = way[i];
                at[i] = k;
            }
        }
    }
    for (int i = 0; i < 4; ++i) {
        r |= UINT64_C(1) << at[i];
    }
    return r;
}

static uint64_t blocked_from(const lit_surface *s, uint64_t pixels, uint32_t kind, lmb_vec3 at)
{
    return kind == LMB_LIGHT_DIRECTIONAL
               ? lmb_blocked_sun(s->look->blockers, s->kernels, s->tile, pixels, at, s->walk)
               : lmb_blocked_tile(s->look->blockers, s->kernels, s->tile, pixels, at, s->noise, s->walk);
}

/* Pixels that see a place: where the corners agree, all do as they do; unless it gives much: then each is asked. */
static uint64_t seen_from(const lit_surface *s, uint32_t *tests, uint32_t kind, lmb_vec3 at, int is_strong)
{
    if (s->look->blockers == NULL) {
        return s->pixels;
    }
    ++*tests;
    if (is_strong) {
        return s->pixels & ~blocked_from(s, s->pixels, kind, at);
    }
    const uint64_t blocked = blocked_from(s, s->corners, kind, at);
    if (blocked == 0) {
        return s->pixels;
    }
    if (blocked == s->corners) {
        return 0;
    }
    const uint64_t others = s->pixels & ~s->corners;
    return s->pixels & ~(blocked | blocked_from(s, others, kind, at));
}

static int is_same_place(lmb_vec3 a, lmb_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/* Does one test speak for all? Where they lie within a 64th of their distance (R^2 is 3 x spread). */
static int is_one_place(const lmb_many_node *node, const lmb_many_job *job)
{
    const lmb_vec3 to = sub3(node->position, job->middle);
    const float d2 = node->kind == LMB_LIGHT_DIRECTIONAL ? 1.0f : dot3(to, to);
    return is_same_place(node->strongest.position, node->median.position) || 12288.0f * node->spread < d2;
}

/* Two tests; one, by lot, where the node's `share` of what may be wrong is under a quarter: that saves a third of the
 * tests and adds 3 % to the error. */
static void test_lamp(lmb_many_lamp *lamp, const lit_surface *s, const lmb_many_node *node, float share,
                      uint32_t *tests)
{
    const int by_lot = share < 0.25f && node->share < 0.5f, is_strong = s->look->each || share > 1.0f;
    const lmb_vec3 at = by_lot ? node->median.position : node->strongest.position;
    lamp->share[0] = maxf(node->share, 0.5f);
    lamp->share[1] = 1.0f - lamp->share[0];
    lamp->seen[0] = lamp->seen[1] = seen_from(s, tests, node->kind, at, is_strong);
    if (!by_lot && !is_one_place(node, &s->job)) {
        lamp->seen[1] = seen_from(s, tests, node->kind, node->median.position, is_strong);
    }
}

/* A hard edge is a step over a millionth. */
static void set_cones(lmb_many_lamp *lamp, const lmb_many_node *node)
{
    lamp->source[0] = node->strongest;
    lamp->source[1] = node->median;
    for (int i = 0; i < 2; ++i) {
        lamp->per[i] = 1.0f / maxf(lamp->source[i].cos_inner - lamp->source[i].cos_outer, 1e-6f);
    }
}

static const lmb_many_entry *entry_at(const lmb_many_scratch *scratch, int32_t i)
{
    return &scratch->entry[i < scratch->open ? i : LMB_MANY_CUT - scratch->closed + (i - scratch->open)];
}

static void shine(lmb_irradiance *inout, lmb_many_scratch *scratch, const lit_surface *s)
{
    const int32_t all = scratch->open + scratch->closed;
    const float allowed = maxf(scratch->allowed * scratch->light, 1e-30f);
    scratch->nodes += (uint32_t)all;
    for (int32_t i = 0, lamps = 0; i < all; ++i) {
        const lmb_many_entry *e = entry_at(scratch, i);
        const lmb_many_node *node = &s->look->many->node[e->node];
        lmb_many_lamp *lamp = &scratch->lamp[lamps++];
        lamp->position = node->position;
        lamp->spread = node->spread;
        memcpy(lamp->intensity, node->intensity, sizeof lamp->intensity);
        lamp->kind = node->kind;
        set_cones(lamp, node);
        test_lamp(lamp, s, node, e->inside / allowed, &scratch->tests);
        if (lamps == LMB_MANY_LAMPS || i + 1 == all) {
            s->kernels->many_shine(inout, s->tile, s->pixels, scratch->lamp, lamps);
            lamps = 0;
        }
    }
}

lmb_status lmb_many_direct_tile(lmb_irradiance *inout, const lmb_kernels *kernels, lmb_many_scratch *scratch,
                                const lmb_tile *tile, const lmb_many_look *look)
{
    if (inout == NULL || kernels == NULL || scratch == NULL || tile == NULL || look == NULL || look->many == NULL) {
        return LMB_ERR_ARG;
    }
    memset(scratch->walk.last, 0, sizeof scratch->walk.last);
    scratch->walk.asked = 0;
    uint64_t left = look->many->node_count > 0 ? tile_pixels(tile) : 0;
    for (int n = 1; left != 0; ++n) {
        lit_surface s;
        s.kernels = kernels;
        s.tile = tile;
        s.look = look;
        s.walk = &scratch->walk;
        s.pixels = n < SURFACES ? tile_surface(tile, left) : left;
        s.corners = corners_of(s.pixels);
        s.noise = lmb_tile_noise(tile, s.pixels);
        s.job = job_of(tile, s.pixels);
        lmb_many_cut(scratch, kernels, look, &s.job);
        shine(inout, scratch, &s);
        left &= ~s.pixels;
    }
    return LMB_OK;
}

#endif
