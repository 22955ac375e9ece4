/* many_lights_direct.c: a tile's surfaces, lit by cuts of many lights: shadow tests, then light. Layer 6. [V3 V29] */
#include <string.h>

#include "../base/light_kind.h"
#include "../occlusion/traversal.h"
#include "../raster/tile.h"
#include "many_lights_cut.h"

#if LMB_TREES

#define MAX_TILE_SURFACES 4 /* max surfaces of a tile with a cut of their own; the last takes the rest */

/* --- the tile's surfaces ------------------------------------------------------------------------------------------ */

static lmb_many_lights_job job_of(const lmb_tile *tile, uint64_t pixels)
{
    lmb_many_lights_job job;
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
    const lmb_many_lights_query *query;
    lmb_many_lights_job job;
    uint64_t pixels, corners;
    float noise; /* m: lmb_tile_noise of the pixels */
    lmb_traversal *traversal;
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

static uint64_t occluded_from(const lit_surface *s, uint64_t pixels, uint32_t kind, lmb_vec3 at)
{
    return light_kind_is((int32_t)kind, LIGHT_FAR)
               ? lmb_occluded_sun(s->kernels, s->traversal, s->query->bvh, s->tile, pixels, at)
               : lmb_occluded_tile(s->kernels, s->traversal, s->query->bvh, s->tile, pixels, at, s->noise);
}

/* The pixels from which a point is visible. If the four corners of the tile agree, all pixels share their result.
 * Points that contribute much are tested from each pixel. */
static uint64_t lights_seen_from(const lit_surface *s, uint32_t *tests, uint32_t kind, lmb_vec3 at, int is_strong)
{
    if (s->query->bvh == NULL) {
        return s->pixels;
    }
    ++*tests;
    if (is_strong) {
        return s->pixels & ~occluded_from(s, s->pixels, kind, at);
    }
    const uint64_t occluded = occluded_from(s, s->corners, kind, at);
    if (occluded == 0) {
        return s->pixels;
    }
    if (occluded == s->corners) {
        return 0;
    }
    const uint64_t others = s->pixels & ~s->corners;
    return s->pixels & ~(occluded | occluded_from(s, others, kind, at));
}

static int is_same_place(lmb_vec3 a, lmb_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/* Does one test decide for all lights? Yes, if they lie within 1/64 of their distance (R^2 is 3 x spread). */
static int is_one_place(const lmb_many_lights_node *node, const lmb_many_lights_job *job)
{
    const lmb_vec3 to = sub3(node->position, job->middle);
    const float d2 = light_kind_is((int32_t)node->kind, LIGHT_FAR) ? 1.0f : dot3(to, to);
    return is_same_place(node->strongest.position, node->median.position) || 12288.0f * node->spread < d2;
}

/* Runs two shadow tests, or only one of them, chosen at random, if the node contributes less than a quarter of the
 * possible error: that saves a third of the tests and adds 3 % to the error. */
static void test_active(lmb_active_light *active, const lit_surface *s, const lmb_many_lights_node *node, float share,
                        uint32_t *tests)
{
    const int by_lot = share < 0.25f && node->share < 0.5f, is_strong = s->query->each || share > 1.0f;
    const lmb_vec3 at = by_lot ? node->median.position : node->strongest.position;
    active->share[0] = maxf(node->share, 0.5f);
    active->share[1] = 1.0f - active->share[0];
    active->seen[0] = active->seen[1] = lights_seen_from(s, tests, node->kind, at, is_strong);
    if (!by_lot && !is_one_place(node, &s->job)) {
        active->seen[1] = lights_seen_from(s, tests, node->kind, node->median.position, is_strong);
    }
}

/* A hard edge becomes a ramp of one millionth. */
static void set_cones(lmb_active_light *active, const lmb_many_lights_node *node)
{
    active->source[0] = node->strongest;
    active->source[1] = node->median;
    for (int i = 0; i < 2; ++i) {
        active->per[i] = 1.0f / maxf(active->source[i].cos_inner - active->source[i].cos_outer, 1e-6f);
    }
}

static const lmb_many_lights_entry *entry_at(const lmb_many_lights_scratch *scratch, int32_t i)
{
    return &scratch->entry[i < scratch->open ? i : LMB_MANY_LIGHTS_CUT - scratch->closed + (i - scratch->open)];
}

static void add_irradiance(lmb_irradiance *inout, lmb_many_lights_scratch *scratch, const lit_surface *s)
{
    const int32_t all = scratch->open + scratch->closed;
    const float allowed = maxf(scratch->allowed * scratch->light, 1e-30f);
    scratch->nodes += (uint32_t)all;
    for (int32_t i = 0, active_lights = 0; i < all; ++i) {
        const lmb_many_lights_entry *e = entry_at(scratch, i);
        const lmb_many_lights_node *node = &s->query->many_lights->node[e->node];
        lmb_active_light *active = &scratch->active[active_lights++];
        active->position = node->position;
        active->spread = node->spread;
        memcpy(active->intensity, node->intensity, sizeof active->intensity);
        active->kind = node->kind;
        set_cones(active, node);
        test_active(active, s, node, e->inside / allowed, &scratch->tests);
        if (active_lights == LMB_ACTIVE_LIGHTS || i + 1 == all) {
            s->kernels->many_lights_irradiance(inout, s->tile, s->pixels, scratch->active, active_lights);
            active_lights = 0;
        }
    }
}

#define MAX_LITTLE_SHARE 0.2f    /* if less of the light arrives, a second cut is made: windows lie between nodes */
#define MIN_ERROR_SHARE  0.0625f /* min error of a second cut, as a share of the requested error */

/* Share of the cut's light that arrived, averaged over the surface's pixels. */
static float seen_share(const lmb_irradiance *arrived, float light, const lit_surface *s)
{
    float sum = 0.0f;
    int count = 0;
    for (uint64_t bits = s->pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        sum += arrived->rgb[0][k] + arrived->rgb[1][k] + arrived->rgb[2][k];
        ++count;
    }
    return sum / maxf((float)count * light, 1e-30f);
}

static void light_part(lmb_irradiance *out, lmb_many_lights_scratch *scratch, const lit_surface *s,
                       const lmb_many_lights_query *query)
{
    memset(out, 0, sizeof *out);
    lmb_many_lights_cut(scratch, s->kernels, query, &s->job);
    add_irradiance(out, scratch, s);
}

/* Lights the surface with one cut. If most of that light is blocked, only a few nodes contribute, and a second, finer
 * cut replaces it. */
NOINLINE void light_by_seen(lmb_irradiance *inout, lmb_many_lights_scratch *scratch, const lit_surface *s)
{
    lmb_many_lights_query finer = *s->query;
    lmb_irradiance arrived;
    light_part(&arrived, scratch, s, s->query);
    const float share = seen_share(&arrived, scratch->light, s);
    if (share < MAX_LITTLE_SHARE && finer.bvh != NULL) {
        finer.error = scratch->allowed * maxf(share, MIN_ERROR_SHARE);
        light_part(&arrived, scratch, s, &finer);
    }
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            inout->rgb[c][k] += arrived.rgb[c][k];
        }
    }
}

lmb_status lmb_many_lights_direct_tile(lmb_irradiance *inout, const lmb_kernels *kernels,
                                       lmb_many_lights_scratch *scratch, const lmb_tile *tile,
                                       const lmb_many_lights_query *query)
{
    if (inout == NULL || kernels == NULL || scratch == NULL || tile == NULL || query == NULL ||
        query->many_lights == NULL) {
        return LMB_ERR_ARG;
    }
    traversal_bound(&scratch->traversal);
    scratch->traversal.eye_kind = LMB_EYE_NONE;
    uint64_t left = query->many_lights->node_count > 0 ? tile_pixels(tile) : 0;
    for (int n = 1; left != 0; ++n) {
        lit_surface s;
        s.kernels = kernels;
        s.tile = tile;
        s.query = query;
        s.traversal = &scratch->traversal;
        s.pixels = n < MAX_TILE_SURFACES ? tile_surface(tile, left) : left;
        s.corners = corners_of(s.pixels);
        s.noise = lmb_tile_noise(tile, s.pixels);
        s.job = job_of(tile, s.pixels);
        if (query->by_seen) {
            light_by_seen(inout, scratch, &s);
        } else {
            lmb_many_lights_cut(scratch, kernels, query, &s.job);
            add_irradiance(inout, scratch, &s);
        }
        left &= ~s.pixels;
    }
    if (query->stats != NULL && query->bvh != NULL) {
        ++query->stats->tiles;
        query->stats->coarse_tiles += scratch->traversal.coarse != 0;
    }
    return LMB_OK;
}

#endif
