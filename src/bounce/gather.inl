/* gather.inl: groups of emitters -> irradiance of a tile's pixels, with the viewer's depth map as occluder.  [V25-V28]
 *
 * Lanes are pixels; groups are added one after another: the order is the contract. */
#ifndef LMB_GATHER_FORMULA
#define LMB_GATHER_FORMULA

/* One emitter, one vector of pixels. M = 1: W/m2 a watt.
 *
 * A disc of area A seen from r away, to second order in s = A / (pi r^2) (integrate cosP cosG / r^2 over the disc):
 *   E = (c - t s) / (pi r^2),  c = cosP cosG,  t = c (3 cos^2 G - 1) + g cos^2 G,  g = nP.nG.
 * c^2 / (c + t s) has the same expansion, stays positive for t >= 0 and equals 1 / (pi r^2 + A) on the axis of a
 * facing disc (t = c = 1), which is exact. For t < 0 the sum itself is kept. Both stay under cosG / s: nothing receives
 * more than the disc's own radiosity M / A times cosG. */
static inline lane disc_factor(lane3 to, lane r2, lane3 n, lane3 axis, lane area)
{
    const lane zero = lane_splat(0.0f), inverse_pi = lane_splat(0.31830989f);
    lane i = lane_div(lane_splat(1.0f), r2);
    lane a = lane3_dot(n, to), b = lane_sub(zero, lane3_dot(axis, to));
    lane c = lane_mul(lane_mul(a, b), i), g2 = lane_mul(lane_mul(b, b), i);
    lane s = lane_mul(lane_mul(area, inverse_pi), i);
    lane t = lane_add(lane_mul(c, lane_sub(lane_mul(lane_splat(3.0f), g2), lane_splat(1.0f))),
                      lane_mul(lane3_dot(n, axis), g2));
    lane ts = lane_mul(t, s);
    lane_mask over = lane_le(zero, t);
    lane cos_g = lane_mul(b, lane_sqrt(i));
    lane base = lane_pick(over, lane_add(c, ts), lane_splat(1.0f)), sum = lane_pick(over, lane_mul(c, c), lane_sub(c, ts));
    lane_mask faces = mask_and(lane_lt(zero, a), lane_lt(zero, b));
    lane top = lane_min(lane_mul(sum, s), lane_mul(cos_g, base)), bottom = lane_pick(faces, lane_mul(base, s), lane_splat(1.0f));
    lane e = lane_mul(lane_mul(inverse_pi, i), lane_div(top, bottom));
    return lane_keep(faces, e);
}

#endif

#ifdef KERNEL
#include "march.inl"

/* A group is near within this many of its radii: then its discs are read one by one. Trim on cornell, two_lights,
 * bunny_room at 1.2 / 1.5 / 2: 0.053 0.144 0.092 / 0.050 0.133 0.080 / 0.049 0.125 0.075; time 1 / 1.3 / 2. */
#define GROUP_NEAR 1.5f
/* Discs that share one segment while none of them is near: 1 costs three times the segments for 0.001 of trim. */
#define SHARED 4u
#define SAME_SURFACE 0.90630779f /* cosine of 25 degrees */

/* Picked, not added as zeros: -0 + 0 is 0, so a lane's bytes would tell what its neighbours met. */
static inline void gather_add(lmb_irradiance *inout, int k, lane_mask lit, lane weight, const float flux[3])
{
    for (int c = 0; c < 3; ++c) {
        lane old = lane_load(inout->rgb[c] + k);
        lane_store(inout->rgb[c] + k, lane_pick(lit, lane_add(old, lane_mul(weight, lane_splat(flux[c]))), old));
    }
}

static inline lane3 lane3_point(lmb_vec3 v) { return lane3_splat(v.x, v.y, v.z); }
static inline lmb_vec3 tile_vec(const float (*p)[LMB_TILE_PIXELS], int k) { return vec3(p[0][k], p[1][k], p[2][k]); }

/* Lanes that carry a surface. */
static inline lane_mask gather_hits(const lmb_tile *tile, int k)
{
    return mask_not(lanei_equal(lanei_load((const int32_t *)tile->id + k), lanei_splat(0)));
}

/* --- visibility shared by a tile -------------------------------------------------------------------------------------
 *
 * Neighbouring pixels of one surface nearly always agree on what they see: the four corners of such a tile are asked
 * first, and only where they differ is each pixel asked. Lost is what fits between the corners. */

#define ALL_LANES (~0u >> (32 - LANES))
enum { CORNERS = LANES < 4 ? 4 : LANES };
enum { SEES_NOTHING, SEES_ALL, SEES_SOME };

typedef struct gather_corners {
    float position[3][CORNERS], face[3][CORNERS];
    int usable; /* the tile is one surface, and something may occlude */
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
    for (int i = 0; i < CORNERS; ++i) {
        for (int c = 0; c < 3; ++c) {
            out->position[c][i] = tile->position[c][pixel[i & 3]];
            out->face[c][i] = tile->face[c][pixel[i & 3]];
        }
    }
}

static inline lane3 corner_load(const float (*p)[CORNERS], int i)
{
    lane3 r;
    r.x = lane_load(p[0] + i);
    r.y = lane_load(p[1] + i);
    r.z = lane_load(p[2] + i);
    return r;
}

/* What the tile's corners see of one emitter. */
static int corners_see(const gather_corners *c, const lmb_march_job *m, lane3 at, lane3 axis)
{
    const uint32_t full = ALL_LANES;
    int none = 1, all = 1;
    for (int i = 0; i < CORNERS && c->usable; i += LANES) {
        lane3 p = corner_load(c->position, i), face = corner_load(c->face, i);
        lane_mask faces = lane_lt(lane_splat(0.0f), lane3_dot(face, lane3_sub(at, p)));
        if (mask_bits(faces) != full) {
            return SEES_SOME; /* the horizon passes through the tile */
        }
        seen_from from = march_begin(m, p, face);
        uint32_t open = mask_bits(march(m, &from, at, axis, faces));
        none &= open == 0;
        all &= open == full;
    }
    return !c->usable ? SEES_SOME : all ? SEES_ALL : none ? SEES_NOTHING : SEES_SOME;
}

/* --- far pairs -------------------------------------------------------------------------------------------------------- */

static inline void gather_group(lmb_irradiance *inout, uint64_t *near_pixels, const lmb_tile *tile, const lmb_groups *groups,
                                int32_t j, const lmb_march_job *m, const gather_corners *corners)
{
    const lane3 at = lane3_splat(groups->position[0][j], groups->position[1][j], groups->position[2][j]);
    const lane3 axis = lane3_splat(groups->normal[0][j], groups->normal[1][j], groups->normal[2][j]);
    const lane near2 = lane_splat(groups->radius[j] * GROUP_NEAR * (groups->radius[j] * GROUP_NEAR)), zero = lane_splat(0.0f);
    const float flux[3] = {groups->flux[0][j], groups->flux[1][j], groups->flux[2][j]};
    int sees = SEES_ALL, asked = m == NULL;
    *near_pixels = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lane3 p = lane3_load(tile->position, k), face = lane3_load(tile->face, k);
        const lane_mask hits = gather_hits(tile, k);
        lane3 to = lane3_sub(at, p);
        lane r2 = lane3_dot(to, to);
        lane_mask close = mask_and(hits, lane_lt(r2, near2));
        *near_pixels |= (uint64_t)mask_bits(close) << k;
        lane weight = disc_factor(to, lane_max(r2, near2), lane3_load(tile->normal, k), axis, lane_splat(groups->area[j]));
        lane_mask lit = mask_and(mask_and(hits, mask_not(close)), lane_lt(zero, weight));
        lit = mask_and(lit, lane_lt(zero, lane3_dot(face, to)));
        if (mask_bits(lit) && !asked) {
            sees = corners_see(corners, m, at, axis);
            asked = 1;
        }
        if (mask_bits(lit) && sees == SEES_SOME) {
            seen_from from = march_begin(m, p, face);
            lit = march(m, &from, at, axis, lit);
        }
        if (mask_bits(lit) && sees != SEES_NOTHING) {
            gather_add(inout, k, lit, weight, flux);
        }
    }
}

static void KERNEL(gather)(lmb_irradiance *inout, uint64_t *near_pixels, const lmb_tile *tile, const lmb_groups *groups,
                           const lmb_march_job *m)
{
    gather_corners corners;
    gather_corners_set(&corners, tile, m);
    for (int32_t j = 0; j < groups->count; ++j) {
        gather_group(inout, &near_pixels[j], tile, groups, j, m, &corners);
    }
}

/* --- near groups, disc by disc ---------------------------------------------------------------------------------------- */

/* The exact form factor for the few lanes so close to a disc that its shape matters. */
static inline lane gather_quads(lane weight, lane_mask close, const lmb_tile *tile, int k, const lmb_point *disc)
{
    float w[LANES];
    uint32_t bits = mask_bits(close);
    lane_store(w, weight);
    for (int i = 0; i < LANES; ++i) {
        if ((bits >> i) & 1u) {
            w[i] = lmb_quad_factor(tile_vec(tile->position, k + i), tile_vec(tile->face, k + i),
                                   tile_vec(tile->normal, k + i), disc->position, disc->normal, disc->axis_u,
                                   disc->axis_v);
        }
    }
    return lane_load(w);
}

/* A vector of pixels against one disc; `shared` is what they see of it while it is not near. */
static inline void gather_disc(lmb_irradiance *inout, const lmb_tile *tile, int k, lane_mask hits, const lmb_point *d,
                               const lmb_march_job *m, const seen_from *from, lane_mask shared)
{
    const lane3 p = lane3_load(tile->position, k), n = lane3_load(tile->normal, k), face = lane3_load(tile->face, k);
    const lane zero = lane_splat(0.0f);
    float uu = dot3(d->axis_u, d->axis_u), vv = dot3(d->axis_v, d->axis_v), uv = dot3(d->axis_u, d->axis_v);
    float area = 4.0f * sqrtf(maxf(uu * vv - uv * uv, 0.0f)), half2 = uu + vv + 2.0f * absf(uv);
    lane near2 = lane_splat(half2 * (LMB_NEAR * LMB_NEAR));
    lane3 to = lane3_sub(lane3_point(d->position), p);
    lane r2 = lane3_dot(to, to);
    lane_mask close = mask_and(hits, lane_lt(r2, near2));
    lane weight = disc_factor(to, lane_max(r2, near2), n, lane3_point(d->normal), lane_splat(area));
    if (mask_bits(close)) {
        weight = gather_quads(weight, close, tile, k, d);
    }
    lane_mask lit = mask_and(hits, lane_lt(zero, weight)), own = mask_and(lit, close);
    lit = mask_and(mask_and(mask_and(lit, mask_not(close)), shared), lane_lt(zero, lane3_dot(face, to)));
    if (mask_bits(own)) {
        lit = mask_or(lit, m != NULL ? march(m, from, lane3_point(d->position), lane3_point(d->normal), own) : own);
    }
    if (mask_bits(lit)) {
        gather_add(inout, k, lit, weight, d->flux);
    }
}

/* Up to SHARED discs that follow one another along the light's map, and so share the segment to one of them. */
static inline void gather_chunk(lmb_irradiance *inout, uint64_t pixels, const lmb_tile *tile, const lmb_point *discs,
                                uint32_t count, const lmb_march_job *m, const gather_corners *corners)
{
    const lmb_point *middle = &discs[count / 2];
    const lane3 at = lane3_point(middle->position), axis = lane3_point(middle->normal);
    int sees = m == NULL ? SEES_ALL : corners_see(corners, m, at, axis);
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t mine = (uint32_t)(pixels >> k) & ALL_LANES;
        if (mine != 0) {
            const lane_mask hits = mask_of_bits(mine);
            lane_mask shared = sees == SEES_NOTHING ? mask_of_bits(0) : hits;
            seen_from from;
            if (m != NULL) {
                from = march_begin(m, lane3_load(tile->position, k), lane3_load(tile->face, k));
            }
            if (sees == SEES_SOME) {
                shared = march(m, &from, at, axis, hits);
            }
            for (uint32_t j = 0; j < count; ++j) {
                gather_disc(inout, tile, k, hits, &discs[j], m, &from, shared);
            }
        }
    }
}

static void KERNEL(gather_near)(lmb_irradiance *inout, uint64_t pixels, const lmb_tile *tile, const lmb_point *discs,
                                uint32_t count, const lmb_march_job *m)
{
    gather_corners corners;
    gather_corners_set(&corners, tile, m);
    for (uint32_t j = 0; j < count; j += SHARED) {
        gather_chunk(inout, pixels, tile, discs + j, count - j < SHARED ? count - j : SHARED, m, &corners);
    }
}

#endif
