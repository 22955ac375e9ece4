/* gather.inl: groups of emitters -> irradiance of a tile's pixels, occluded by the viewer's depth. Layer 5.  [V25-V28]
 *
 * Lanes are pixels. Groups are added one after another: this order is part of the contract. */
#ifndef LMB_GATHER_FORMULA
#define LMB_GATHER_FORMULA

#include "../base/poly.h"

/* Squared cosines below 2^-40 count as 0, as for a point in the plane. Light at such a grazing angle adds nothing, but
 * c^2 s would be a denormal, which some targets flush. The limit is on cosines, not lengths: scenes may have any
 * scale. */
#define MIN_COSINE2 9.0949470e-13f

/* Lanes in which a = nP.to and b = -nG.to are above the horizons. r2 = to.to. */
static inline lane_mask disc_faces(lane a, lane b, lane r2)
{
    const lane min = lane_min(b, a);
    return lane_lt(lane_mul(lane_splat(MIN_COSINE2), r2), lane_mul(min, lane_max(min, lane_splat(0.0f))));
}

/* One emitter at one vector of pixels, in W/m2 per watt of flux M.
 *
 * A disc of area A seen from r away, to second order in s = A / (pi r^2) (integrate cosP cosG / r^2 over the disc):
 *   E = (c - t s) / (pi r^2),  c = cosP cosG,  t = c (3 cos^2 G - 1) + g cos^2 G,  g = nP.nG.
 * c^2 / (c + t s) has the same expansion, stays positive for t >= 0, and equals 1 / (pi r^2 + A) on the axis of a
 * facing disc (t = c = 1), which is exact. If t < 0, the sum itself is used. Both stay under cosG / s: no point
 * receives more than the disc's radiosity M / A times cosG.
 *
 * a = nP.to, b = -nG.to, i = 1 / r^2, against = -nP.nG, area_pi = A / pi. Valid only if disc_faces. */
static inline void disc_fraction(lane *top, lane *bottom, lane a, lane b, lane i, lane against, lane area_pi)
{
    const lane one = lane_splat(1.0f);
    lane c = lane_mul(lane_mul(a, b), i), g2 = lane_mul(lane_mul(b, b), i), s = lane_mul(area_pi, i);
    lane t = lane_sub(lane_mul(c, lane_sub(lane_mul(lane_splat(3.0f), g2), one)), lane_mul(against, g2));
    lane ts = lane_mul(t, s);
    lane_mask over = lane_le(lane_splat(0.0f), t);
    lane cos_g = lane_mul(b, lane_sqrt(i));
    lane base = lane_pick(over, lane_add(c, ts), one), sum = lane_pick(over, lane_mul(c, c), lane_sub(c, ts));
    *top = lane_min(lane_mul(sum, s), lane_mul(cos_g, base));
    *bottom = lane_mul(base, s);
}

/* 0 or NaN if i is 0. */
static inline lane disc_value(lane top, lane bottom, lane i)
{
    return lane_mul(lane_mul(lane_splat(LMB_INVERSE_PI), i), lane_div(top, bottom));
}

static inline lane disc_factor(lane3 to, lane r2, lane3 n, lane3 axis, lane area)
{
    const lane zero = lane_splat(0.0f);
    lane top, bottom, i = lane_div(lane_splat(1.0f), r2), against = lane_sub(zero, lane3_dot(n, axis));
    const lane a = lane3_dot(n, to), b = lane_sub(zero, lane3_dot(axis, to));
    const lane_mask faces = disc_faces(a, b, r2);
    disc_fraction(&top, &bottom, lane_keep(faces, a), lane_keep(faces, b), i, against,
                  lane_mul(area, lane_splat(LMB_INVERSE_PI)));
    return lane_keep(faces, disc_value(top, bottom, i));
}

#endif

#ifdef KERNEL
#include <string.h>

#include "../occlusion/march.inl"
#include "polygon.h"
#include "../raster/tile.h"

/* A group closer than this many group radii is near: the discs are then added one by one. Trim on cornell, two_lights,
 * bunny_room at 1.2 / 1.5 / 2: 0.053 0.144 0.092 / 0.050 0.133 0.080 / 0.049 0.125 0.075; time 1 / 1.3 / 2. */
#define GROUP_NEAR 1.5f
/* Discs that share one segment if none of them is near. 1 takes three times the segments for 0.001 of trim. */
#define MAX_SHARED_DISCS 4u
#define SAME_SURFACE 0.90630779f /* cosine of 25 degrees */
#define FLAT_PART    0.15f         /* of a disc's half sides: pixels in inner edges are lit from this height */
#define PLACE_NOISE  4.7683716e-7f /* 2^-21: rounding of places, of their distance from the origin and from a disc */

/* Picks instead of adding zeros: -0 + 0 is 0, so the bytes of a lane would depend on its neighbours. */
static inline void gather_add(lmb_irradiance *inout, int k, lane_mask lit, lane weight, const float flux[3])
{
    for (int c = 0; c < 3; ++c) {
        lane old = lane_load(inout->rgb[c] + k);
        lane_store(inout->rgb[c] + k, lane_pick(lit, lane_add(old, lane_mul(weight, lane_splat(flux[c]))), old));
    }
}

/* Lanes with a surface. */
static inline lane_mask gather_hits(const lmb_tile *tile, int k)
{
    return mask_not(lanei_equal(lanei_load((const int32_t *)tile->id + k), lanei_splat(0)));
}

/* --- visibility shared by a tile -------------------------------------------------------------------------------------
 *
 * Neighbouring pixels of one surface nearly always see the same. The four corners of such a tile are tested first, and
 * each pixel only if the corners differ. Occluders that fit between the corners are lost. */

/* Aims from pixels with `plane` floats between the planes of position and of face. */
LANE_NOINLINE void gather_aim(seen_from *from, march_run *run, const lmb_march_job *m, const float *position,
                              const float *face, size_t plane, const lmb_vec3 *at, const lmb_vec3 *axis)
{
    lane3 p, n;
    p.x = lane_load(position);
    p.y = lane_load(position + plane);
    p.z = lane_load(position + 2 * plane);
    n.x = lane_load(face);
    n.y = lane_load(face + plane);
    n.z = lane_load(face + 2 * plane);
    const lane3 start = march_begin(from, m, p, n);
    march_towards(run, m, from, start, lane3_of(*at), lane3_of(*axis));
}

/* march() from these pixels. */
NOINLINE lane_mask gather_march(const lmb_march_job *m, const float *position, const float *face, size_t plane,
                                const lmb_vec3 *at, const lmb_vec3 *axis, lane_mask wanted)
{
    seen_from from;
    march_run run;
    gather_aim(&from, &run, m, position, face, plane, at, axis);
    return march(m, &from, &run, wanted);
}

static inline lane_mask tile_march(const lmb_march_job *m, const lmb_tile *tile, int k, const lmb_vec3 *at,
                                   const lmb_vec3 *axis, lane_mask wanted)
{
    return gather_march(m, tile->position[0] + k, tile->face[0] + k, LMB_TILE_PIXELS, at, axis, wanted);
}

enum { CORNER_LANES = LANES < 4 ? 4 : LANES };
enum { SEES_NOTHING, SEES_ALL, SEES_SOME, SEES_UNKNOWN };

typedef struct gather_corners {
    float position[3][CORNER_LANES], face[3][CORNER_LANES];
    int usable; /* 1: the tile is one surface, and occlusion is on */
} gather_corners;

static inline int tile_is_one_surface(const lmb_tile *tile)
{
    const lmb_vec3 p = tile_vec(tile->position, 0), n = tile_vec(tile->face, 0);
    lmb_vec3 across = sub3(tile_vec(tile->position, LMB_TILE_PIXELS - 1), p);
    float flat = 0.1f * length3(across);
    if (tile->hits < LMB_TILE_PIXELS) {
        return 0;
    }
    for (int k = 1; k < LMB_TILE_PIXELS; ++k) {
        float height = dot3(n, sub3(tile_vec(tile->position, k), p));
        if (dot3(n, tile_vec(tile->face, k)) < SAME_SURFACE || absf(height) > flat) {
            return 0;
        }
    }
    return 1;
}

static void gather_corners_set(gather_corners *out, const lmb_tile *tile, const lmb_march_job *m)
{
    static const uint8_t pixel[4] = {0, LMB_TILE - 1, LMB_TILE_PIXELS - LMB_TILE, LMB_TILE_PIXELS - 1};
    out->usable = m != NULL && tile_is_one_surface(tile);
    for (int i = 0; i < CORNER_LANES; ++i) {
        for (int c = 0; c < 3; ++c) {
            out->position[c][i] = tile->position[c][pixel[i & 3]];
            out->face[c][i] = tile->face[c][pixel[i & 3]];
        }
    }
}

static inline lane3 corner_load(const float (*p)[CORNER_LANES], int i)
{
    lane3 r;
    r.x = lane_load(p[0] + i);
    r.y = lane_load(p[1] + i);
    r.z = lane_load(p[2] + i);
    return r;
}

/* SEES_*: visibility of one emitter from the tile's corners. */
NOINLINE int corners_see(const gather_corners *c, const lmb_march_job *m, const lmb_vec3 *at, const lmb_vec3 *axis)
{
    const uint32_t full = ALL_LANES;
    int none = 1, all = 1;
    for (int i = 0; i < CORNER_LANES && c->usable; i += LANES) {
        lane3 to = lane3_sub(lane3_of(*at), corner_load(c->position, i));
        lane_mask faces = lane_lt(lane_splat(0.0f), lane3_dot(corner_load(c->face, i), to));
        if (mask_bits(faces) != full) {
            return SEES_SOME; /* the horizon passes through the tile */
        }
        uint32_t open = mask_bits(gather_march(m, c->position[0] + i, c->face[0] + i, CORNER_LANES, at, axis, faces));
        none &= open == 0;
        all &= open == full;
    }
    return !c->usable ? SEES_SOME : all ? SEES_ALL : none ? SEES_NOTHING : SEES_SOME;
}

/* --- far pairs ---------------------------------------------------------------------------------------------------- */

/* Groups processed together. A pair is a chain of some thirty operations, each waiting for the last. One pair after
 * another leaves any processor idle most of the time. So each step runs for all groups of a block before the next step:
 * chains are short and many run side by side. The pairs lie in the caller's scratch. Narrow backends take two vectors
 * of pixels at a time, so that a group is read once for both. */
#if defined(LANE_PLAIN)
enum { BATCH_VECTORS = 1, BATCH_PIXELS = LANES, BLOCK_GROUPS = LANES > 1 ? 8 : 4 };
#else
enum { BATCH_VECTORS = LANES > 8 ? 1 : 2, BATCH_PIXELS = BATCH_VECTORS * LANES };
enum { BLOCK_GROUPS = LMB_GATHER_PAIRS < 16 * BATCH_PIXELS || LANES > 8 ? 8 : 16 };
#endif

/* The groups of a block, packed. In lmb_groups the values of a group lie LMB_MAX_GROUPS apart, a power of two, and so
 * map to one cache set, which holds fewer. */
typedef struct gather_group {
    lmb_vec3 at, back; /* back: opposite to the group's normal */
    float near2, area_pi;
    float flux[3];
    int32_t number; /* in lmb_groups */
} gather_group;

static void gather_fetch(gather_group *out, const lmb_groups *groups, int32_t j)
{
    const float near_m = groups->radius[j] * GROUP_NEAR;
    out->at = vec3(groups->position[0][j], groups->position[1][j], groups->position[2][j]);
    out->back = vec3(-groups->normal[0][j], -groups->normal[1][j], -groups->normal[2][j]);
    out->near2 = near_m * near_m;
    out->area_pi = groups->area[j] * LMB_INVERSE_PI;
    for (int c = 0; c < 3; ++c) {
        out->flux[c] = groups->flux[c][j];
    }
    out->number = j;
}

/* Bounding sphere of a tile's surfaces. */
typedef struct gather_ball {
    lmb_vec3 centre;
    float radius;
} gather_ball;

static gather_ball gather_ball_of(const lmb_tile *tile)
{
    lmb_vec3 low = vec3(3e38f, 3e38f, 3e38f), high = vec3(-3e38f, -3e38f, -3e38f);
    gather_ball ball;
    float r2 = 0.0f;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0) {
            low = min3(low, tile_vec(tile->position, k));
            high = max3(high, tile_vec(tile->position, k));
        }
    }
    ball.centre = mul3(add3(low, high), 0.5f);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 d = sub3(tile_vec(tile->position, k), ball.centre);
        r2 = tile->id[k] != 0 && !(dot3(d, d) < r2) ? dot3(d, d) : r2; /* keeps a NaN: then no group is dark */
    }
    ball.radius = sqrtf(r2);
    return ball;
}

/* Returns those of the groups j .. j + LANES - 1 that may light a pixel of the tile, or be near one, one bit each. The
 * others face away from the whole sphere: their pairs are exactly 0. A hundred-thousandth is far more than all
 * rounding. */
static uint32_t gather_awake(const gather_ball *ball, const lmb_groups *groups, int32_t j, int32_t count)
{
    const uint32_t here = count < LANES ? (1u << count) - 1 : ALL_LANES;
    if (j + LANES > LMB_MAX_GROUPS) {
        return here;
    }
    const lane radius = lane_splat(ball->radius), reach = lane_splat(1e-5f);
    lane3 d, n;
    d.x = lane_sub(lane_load(groups->position[0] + j), lane_splat(ball->centre.x));
    d.y = lane_sub(lane_load(groups->position[1] + j), lane_splat(ball->centre.y));
    d.z = lane_sub(lane_load(groups->position[2] + j), lane_splat(ball->centre.z));
    n.x = lane_load(groups->normal[0] + j);
    n.y = lane_load(groups->normal[1] + j);
    n.z = lane_load(groups->normal[2] + j);
    const lane distance = lane_sqrt(lane3_dot(d, d)), slack = lane_mul(lane_add(distance, radius), reach);
    const lane ball_out = lane_add(radius, slack);
    const lane near_m = lane_mul(lane_load(groups->radius + j), lane_splat(GROUP_NEAR));
    const lane_mask behind = lane_lt(ball_out, lane3_dot(n, d)), far = lane_lt(lane_add(near_m, ball_out), distance);
    return here & ~mask_bits(mask_and(behind, far));
}

enum { PAIR_A, PAIR_B, PAIR_I }; /* as in disc_fraction */
typedef struct gather_pairs {
    float (*of)[LMB_GATHER_PAIRS]; /* [PAIR_..]: BATCH_PIXELS values per group; i is 0 if the pixel gets nothing */
    int32_t lit[BLOCK_GROUPS], count;
} gather_pairs;

/* A vector of pixels, for a block of groups. */
typedef struct gather_pixels {
    lane3 p, n, face;
    uint32_t hit_bits;
} gather_pixels;

/* Pixels without a surface get a zero normal, so they face nothing. */
LANE_INLINE gather_pixels gather_load_pixels(const lmb_tile *tile, int k)
{
    const lane_mask hits = gather_hits(tile, k);
    gather_pixels out;
    out.p = lane3_load(tile->position, k);
    out.n = lane3_load(tile->normal, k);
    out.n.x = lane_keep(hits, out.n.x);
    out.n.y = lane_keep(hits, out.n.y);
    out.n.z = lane_keep(hits, out.n.z);
    out.face = lane3_load(tile->face, k);
    out.hit_bits = mask_bits(hits);
    return out;
}

/* Pairs of one group: stores those that face each other, above the horizon and not near, at pair `at`. Returns their
 * bits, and the bits of near pairs in near_bits. min(b, a) is a if a is NaN; a pair with a NaN in b adds nothing. */
LANE_INLINE uint32_t gather_face(gather_pairs *out, uint32_t *near_bits, const gather_pixels *px,
                                 const gather_group *g, int at)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    const lane3 to = lane3_sub(lane3_of(g->at), px->p);
    const lane r2 = lane3_dot(to, to), a = lane3_dot(px->n, to), b = lane3_dot(lane3_of(g->back), to);
    const lane_mask far = lane_le(lane_splat(g->near2), r2);
    const lane_mask faces = mask_and(disc_faces(a, b, r2), lane_lt(zero, lane3_dot(px->face, to)));
    const lane_mask lit = mask_and(far, faces);
    lane_store(out->of[PAIR_A] + at, a);
    lane_store(out->of[PAIR_B] + at, b);
    lane_store(out->of[PAIR_I] + at, lane_keep(lit, lane_div(one, r2)));
    *near_bits = px->hit_bits & ~mask_bits(far);
    return mask_bits(lit);
}

/* Flags near pixels. (NOINLINE: at -O3 the frame would lie under that of the march.) */
LANE_NOINLINE void gather_find(gather_pairs *out, uint64_t *near_pixels, const lmb_tile *tile, int k,
                               const gather_group *groups, int32_t group_count)
{
    const gather_pixels first = gather_load_pixels(tile, k),
                        second = gather_load_pixels(tile, k + BATCH_PIXELS - LANES);
    int32_t count = 0;
    for (int32_t j = 0; j < group_count; ++j) {
        const gather_group *g = &groups[j];
        uint32_t near_bits, lit = gather_face(out, &near_bits, &first, g, j * BATCH_PIXELS);
        if (BATCH_VECTORS > 1) {
            uint32_t more;
            lit |= gather_face(out, &more, &second, g, j * BATCH_PIXELS + LANES);
            near_bits |= more << (LANES & 31);
        }
        out->lit[count] = j;
        count += lit != 0;
        if (near_bits != 0) {
            near_pixels[g->number] |= (uint64_t)near_bits << k;
        }
    }
    out->count = count;
}

LANE_INLINE void gather_estimate_one(gather_pairs *inout, int at, lane3 n, const gather_group *g)
{
    lane top, bottom;
    disc_fraction(&top, &bottom, lane_load(inout->of[PAIR_A] + at), lane_load(inout->of[PAIR_B] + at),
                  lane_load(inout->of[PAIR_I] + at), lane3_dot(n, lane3_of(g->back)), lane_splat(g->area_pi));
    lane_store(inout->of[PAIR_A] + at, top);
    lane_store(inout->of[PAIR_B] + at, bottom);
}

/* Computes the fractions: top replaces a, bottom replaces b. */
static inline void gather_estimate(gather_pairs *inout, const lmb_tile *tile, int k, const gather_group *groups)
{
    const lane3 first = lane3_load(tile->normal, k), second = lane3_load(tile->normal, k + BATCH_PIXELS - LANES);
    for (int32_t i = 0; i < inout->count; ++i) {
        const int32_t j = inout->lit[i];
        gather_estimate_one(inout, j * BATCH_PIXELS, first, &groups[j]);
        if (BATCH_VECTORS > 1) {
            gather_estimate_one(inout, j * BATCH_PIXELS + LANES, second, &groups[j]);
        }
    }
}

static inline lane gather_weight(const gather_pairs *pairs, int at)
{
    return disc_value(lane_load(pairs->of[PAIR_A] + at), lane_load(pairs->of[PAIR_B] + at),
                      lane_load(pairs->of[PAIR_I] + at));
}

/* sum + weight * flux for lit pixels; picks as gather_add does, but with sums in registers. */
LANE_INLINE lane3 gather_sum_one(lane3 sum, lane weight, const float flux[3])
{
    const lane_mask lit = lane_lt(lane_splat(0.0f), weight);
    lane3 more;
    more.x = lane_add(sum.x, lane_mul(weight, lane_splat(flux[0])));
    more.y = lane_add(sum.y, lane_mul(weight, lane_splat(flux[1])));
    more.z = lane_add(sum.z, lane_mul(weight, lane_splat(flux[2])));
    return lane3_pick(lit, more, sum);
}

LANE_INLINE lane3 gather_get(const lmb_irradiance *sums, int k)
{
    lane3 r;
    r.x = lane_load(sums->rgb[0] + k);
    r.y = lane_load(sums->rgb[1] + k);
    r.z = lane_load(sums->rgb[2] + k);
    return r;
}

LANE_INLINE void gather_put(lmb_irradiance *out, int k, lane3 sum)
{
    lane_store(out->rgb[0] + k, sum.x);
    lane_store(out->rgb[1] + k, sum.y);
    lane_store(out->rgb[2] + k, sum.z);
}

static inline void gather_sum(lmb_irradiance *inout, int k, const gather_pairs *pairs, const gather_group *groups)
{
    lane3 first = gather_get(inout, k), second = gather_get(inout, k + BATCH_PIXELS - LANES);
    for (int32_t i = 0; i < pairs->count; ++i) {
        const int32_t j = pairs->lit[i];
        first = gather_sum_one(first, gather_weight(pairs, j * BATCH_PIXELS), groups[j].flux);
        if (BATCH_VECTORS > 1) {
            second = gather_sum_one(second, gather_weight(pairs, j * BATCH_PIXELS + LANES), groups[j].flux);
        }
    }
    gather_put(inout, k, first);
    if (BATCH_VECTORS > 1) {
        gather_put(inout, k + LANES, second);
    }
}

/* Possible occluders, for one tile and one block. */
typedef struct gather_occluders {
    const lmb_march_job *m;
    const gather_corners *corners;
    uint8_t sees[BLOCK_GROUPS]; /* SEES_* per group; SEES_UNKNOWN until tested */
} gather_occluders;

/* Zeroes the weights of hidden pairs. */
NOINLINE void gather_hide(gather_pairs *inout, gather_occluders *occluders, const lmb_tile *tile, int k,
                          const gather_group *groups)
{
    for (int32_t i = 0; i < inout->count * BATCH_VECTORS; ++i) {
        const int32_t j = inout->lit[i / BATCH_VECTORS], v = i % BATCH_VECTORS * LANES, at = j * BATCH_PIXELS + v;
        const gather_group *g = &groups[j];
        const lmb_vec3 axis = vec3(-g->back.x, -g->back.y, -g->back.z);
        lane_mask lit = lane_lt(lane_splat(0.0f), gather_weight(inout, at));
        uint8_t *sees = &occluders->sees[j];
        if (mask_bits(lit) && *sees == SEES_UNKNOWN) {
            *sees = (uint8_t)corners_see(occluders->corners, occluders->m, &g->at, &axis);
        }
        if (mask_bits(lit) && *sees == SEES_SOME) {
            const lane_mask open = tile_march(occluders->m, tile, k + v, &g->at, &axis, lit);
            lane_store(inout->of[PAIR_I] + at, lane_keep(open, lane_load(inout->of[PAIR_I] + at)));
        } else if (*sees == SEES_NOTHING) {
            lane_store(inout->of[PAIR_I] + at, lane_splat(0.0f));
        }
    }
}

static inline void gather_block(lmb_irradiance *inout, uint64_t *near_pixels, gather_pairs *pairs, const lmb_tile *tile,
                                const gather_group *groups, int32_t count, gather_occluders *occluders)
{
    for (int32_t j = 0; j < count; ++j) {
        occluders->sees[j] = SEES_UNKNOWN;
    }
    for (int k = 0; k < LMB_TILE_PIXELS; k += BATCH_PIXELS) {
        gather_find(pairs, near_pixels, tile, k, groups, count);
        gather_estimate(pairs, tile, k, groups);
        if (occluders->m != NULL) {
            gather_hide(pairs, occluders, tile, k, groups);
        }
        gather_sum(inout, k, pairs, groups);
    }
}

static void KERNEL(gather)(lmb_irradiance *inout, lmb_gather_scratch *scratch, const lmb_tile *tile,
                           const lmb_groups *groups, const lmb_march_job *m)
{
    const gather_ball ball = gather_ball_of(tile);
    gather_pairs pairs;
    gather_corners corners;
    gather_group block[BLOCK_GROUPS];
    gather_occluders occluders;
    int32_t filled = 0;
    pairs.of = scratch->pairs;
    occluders.m = m;
    occluders.corners = &corners;
    gather_corners_set(&corners, tile, m);
    memset(scratch->near_pixels, 0, (size_t)groups->count * sizeof *scratch->near_pixels);
    for (int32_t j = 0; j < groups->count; j += LANES) {
        const int32_t count = groups->count - j < LANES ? groups->count - j : LANES;
        for (uint32_t bits = gather_awake(&ball, groups, j, count); bits != 0; bits &= bits - 1) {
            gather_fetch(&block[filled++], groups, j + lowest_bit(bits));
            if (filled == BLOCK_GROUPS) {
                gather_block(inout, scratch->near_pixels, &pairs, tile, block, filled, &occluders);
                filled = 0;
            }
        }
    }
    gather_block(inout, scratch->near_pixels, &pairs, tile, block, filled, &occluders);
}

/* --- near groups, disc by disc ------------------------------------------------------------------------------------ */

#if LMB_TREES
/* The place of pixel k. If the pixel is in an inner edge, closer than FLAT_PART to the other wall's plane, the place
 * moves to that height, because discs end before the edge or behind it. A pixel in the plane, within rounding, counts
 * as on the eye's side of the plane. Without occlusion it counts as in front. */
static inline lmb_vec3 gather_place(const lmb_tile *tile, int k, const lmb_point *disc, const lmb_march_job *m)
{
    const lmb_vec3 at = tile_vec(tile->position, k), face = tile_vec(tile->face, k), to = sub3(disc->position, at);
    const float reach = FLAT_PART * (length3(disc->axis_u) + length3(disc->axis_v));
    const float noise = PLACE_NOISE * (length3(at) + length3(to)), height = -dot3(disc->normal, to);
    const lmb_vec3 to_eye = m == NULL ? disc->normal : m->perspective ? sub3(m->eye, at) : m->back;
    if (height > (dot3(disc->normal, to_eye) > 0.0f ? -noise : noise) && height < reach &&
        absf(dot3(face, disc->normal)) < POLYGON_BENT && dot3(face, to) > 0.0f) {
        return add3(at, mul3(disc->normal, reach - height));
    }
    return at;
}
#endif

/* The exact form factor, for the few lanes so close to a disc that the shape matters. */
static inline lane gather_quads(lane weight, lane_mask close, const lmb_tile *tile, int k, const lmb_point *disc,
                                const lmb_march_job *m)
{
    float w[LANES];
    uint32_t bits = mask_bits(close);
    lane_store(w, weight);
    for (int i = 0; i < LANES; ++i) {
        if ((bits >> i) & 1u) {
#if LMB_TREES
            const lmb_vec3 at = gather_place(tile, k + i, disc, m);
#else
            const lmb_vec3 at = tile_vec(tile->position, k + i);
            (void)m;
#endif
            w[i] = lmb_quad_factor(at, tile_vec(tile->face, k + i),
                                   tile_vec(tile->normal, k + i), disc->position, disc->normal, disc->axis_u,
                                   disc->axis_v);
        }
    }
    return lane_load(w);
}

/* A vector of pixels and one disc. `shared`: the pixels that see the disc, if it is not near. */
static inline void gather_disc(lmb_irradiance *inout, const lmb_tile *tile, int k, lane_mask hits, const lmb_point *d,
                               const lmb_march_job *m, lane_mask shared)
{
    const lane3 p = lane3_load(tile->position, k), n = lane3_load(tile->normal, k), face = lane3_load(tile->face, k);
    const lane zero = lane_splat(0.0f);
    float uu = dot3(d->axis_u, d->axis_u), vv = dot3(d->axis_v, d->axis_v), uv = dot3(d->axis_u, d->axis_v);
    float area = 4.0f * sqrtf(maxf(uu * vv - uv * uv, 0.0f)), half2 = uu + vv + 2.0f * absf(uv);
    lane near2 = lane_splat(half2 * (LMB_NEAR * LMB_NEAR));
    lane3 to = lane3_sub(lane3_of(d->position), p);
    lane r2 = lane3_dot(to, to);
    lane_mask close = mask_and(hits, lane_lt(r2, near2));
    lane weight = disc_factor(to, lane_max(r2, near2), n, lane3_of(d->normal), lane_splat(area));
    if (mask_bits(close)) {
        weight = gather_quads(weight, close, tile, k, d, m);
    }
    lane_mask lit = mask_and(hits, lane_lt(zero, weight)), own = mask_and(lit, close);
    lit = mask_and(mask_and(mask_and(lit, mask_not(close)), shared), lane_lt(zero, lane3_dot(face, to)));
    if (mask_bits(own)) {
        lit = mask_or(lit, m != NULL ? tile_march(m, tile, k, &d->position, &d->normal, own) : own);
    }
    if (mask_bits(lit)) {
        gather_add(inout, k, lit, weight, d->flux);
    }
}

/* Up to MAX_SHARED_DISCS discs. They are consecutive in the shadow map, so they share the segment to one of them. */
static inline void gather_chunk(lmb_irradiance *inout, uint64_t pixels, const lmb_tile *tile, const lmb_point *discs,
                                uint32_t count, const lmb_march_job *m, const gather_corners *corners)
{
    const lmb_point *middle = &discs[count / 2];
    int sees = m == NULL ? SEES_ALL : corners_see(corners, m, &middle->position, &middle->normal);
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t mine = (uint32_t)(pixels >> k) & ALL_LANES;
        if (mine != 0) {
            const lane_mask hits = mask_of_bits(mine);
            lane_mask shared = sees == SEES_NOTHING ? mask_of_bits(0) : hits;
            if (sees == SEES_SOME) {
                shared = tile_march(m, tile, k, &middle->position, &middle->normal, hits);
            }
            for (uint32_t j = 0; j < count; ++j) {
                gather_disc(inout, tile, k, hits, &discs[j], m, shared);
            }
        }
    }
}

static void KERNEL(gather_near)(lmb_irradiance *inout, uint64_t pixels, const lmb_tile *tile, const lmb_point *discs,
                                uint32_t count, const lmb_march_job *m)
{
    gather_corners corners;
    gather_corners_set(&corners, tile, m);
    for (uint32_t j = 0; j < count; j += MAX_SHARED_DISCS) {
        gather_chunk(inout, pixels, tile, discs + j, count - j < MAX_SHARED_DISCS ? count - j : MAX_SHARED_DISCS, m,
                     &corners);
    }
}

#endif
