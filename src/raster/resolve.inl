/* resolve.inl: the attributes of a tile's pixels, from the triangles that they show. Layer 3.
 *
 * First the different triangles get slots. Then up to LMB_SLOTS of them are set up side by side. Then each vector of
 * pixels looks up the values of its triangles by slot. The position is the intersection of the pixel's ray with the
 * triangle's plane: depth is not read back, and snapping moves nothing off the plane. On a plane seen edge-on, the
 * quotient is clamped to the triangle's range of w. */
#include "plane.inl"
#include "plane.h"

/* --- slots -------------------------------------------------------------------------------------------------------- */

/* Pixels with an id other than 0, one bit each. */
static uint64_t KERNEL(resolve_shown)(const uint32_t id[LMB_TILE_PIXELS])
{
    uint64_t none = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        none |= (uint64_t)mask_bits(lanei_equal(lanei_load((const int32_t *)id + k), lanei_splat(0))) << k;
    }
    return ~none;
}

#if !defined(LANE_PLAIN) || LANES == 1
/* `left` without the pixels of other instances. */
LANE_INLINE uint64_t resolve_own(const lmb_resolve_batch *b, const uint32_t *id, uint64_t left)
{
    const lanei first = lanei_splat((int32_t)b->instance->first_id),
                count = lanei_splat((int32_t)b->mesh->triangle_count);
    uint64_t own = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lanei n = lanei_sub(lanei_load((const int32_t *)id + k), first);
        own |= (uint64_t)mask_bits(mask_and(lanei_not_negative(n), lanei_lt(n, count))) << k;
    }
    return left & own;
}
#endif

#if defined(LANE_PLAIN) && LANES > 1
#include "resolve_plain.inl"
#elif LANES < LMB_TILE
/* Assigns the slot to the pixels of k .. k + LANES - 1 that have the id. Returns them. */
LANE_INLINE uint32_t resolve_take(int32_t *slot, const uint32_t *id, int k, lanei wanted, lanei number)
{
    const lane_mask mine = lanei_equal(lanei_load((const int32_t *)id + k), wanted);
    lanei_store(slot + k, lanei_pick(mine, number, lanei_load(slot + k)));
    return mask_bits(mine);
}

/* `left` has all pixels of an id or none, so the search starts at the first of them. */
static uint64_t KERNEL(resolve_slots)(lmb_resolve_batch *out, const uint32_t id[LMB_TILE_PIXELS], uint64_t left)
{
    uint64_t taken = 0;
    left = resolve_own(out, id, left);
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        lanei_store(out->slot + k, lanei_splat(-1));
    }
    out->count = 0;
    while (left != 0 && out->count < LMB_SLOTS) {
        const int first = lowest_bit_64(left);
        const uint32_t next = id[first];
        const lanei wanted = lanei_splat((int32_t)next), number = lanei_splat(out->count);
        uint64_t mine = 0;
        for (int k = first & ~(LANES - 1); k < LMB_TILE_PIXELS; k += LANES) {
            mine |= (uint64_t)resolve_take(out->slot, id, k, wanted, number) << k;
        }
        out->id[out->count++] = next;
        taken |= mine;
        left &= ~mine;
    }
    return taken;
}
#else
/* Pixels k with the same id as pixel k - `back`, one bit each. */
LANE_INLINE uint64_t resolve_repeated(const uint32_t *id, int back)
{
    const int last = LMB_TILE_PIXELS - LANES - back; /* vectors may overlap, so none leaves the tile */
    uint64_t same = 0;
    for (int from = 0; from < LMB_TILE_PIXELS - back; from += LANES) {
        const int k = from < last ? from : last;
        same |= (uint64_t)mask_bits(lanei_equal(lanei_load((const int32_t *)id + k),
                                                lanei_load((const int32_t *)id + k + back)))
                << (k + back);
    }
    return same;
}

/* Slots of a tile's quarter, in registers. */
typedef struct resolve_quarter {
    lanei slot[LMB_TILE_PIXELS / 4 / LANES];
} resolve_quarter;

/* Assigns the slot to the pixels of k .. k + 15 that have the id `wanted`. Returns them. */
LANE_INLINE uint64_t resolve_take(resolve_quarter *q, const uint32_t *id, int k, lanei wanted, lanei number)
{
    uint64_t mine = 0;
    for (int i = 0; i < LMB_TILE_PIXELS / 4 / LANES; ++i) {
        const lane_mask m = lanei_equal(lanei_load((const int32_t *)id + k + i * LANES), wanted);
        q->slot[i] = lanei_pick(m, number, q->slot[i]);
        mine |= (uint64_t)mask_bits(m) << (k + i * LANES);
    }
    return mine;
}

LANE_INLINE void resolve_quarter_store(int32_t *to, const resolve_quarter *q)
{
    for (int i = 0; i < LMB_TILE_PIXELS / 4 / LANES; ++i) {
        lanei_store(to + i * LANES, q->slot[i]);
    }
}

LANE_INLINE resolve_quarter resolve_no_slots(void)
{
    resolve_quarter q;
    for (int i = 0; i < LMB_TILE_PIXELS / 4 / LANES; ++i) {
        q.slot[i] = lanei_splat(-1);
    }
    return q;
}

/* The same slots in the same order. The first pixel of an id is one of those with a different id than all earlier
 * neighbours. These are known at once, so the search for the next id overlaps the comparisons of the last one. */
static uint64_t KERNEL(resolve_slots)(lmb_resolve_batch *out, const uint32_t id[LMB_TILE_PIXELS], uint64_t left)
{
    uint64_t taken = 0;
    left = resolve_own(out, id, left);
    resolve_quarter a = resolve_no_slots(), b = a, c = a, d = a;
    int32_t count = 0;
    uint64_t leads = left & ~(resolve_repeated(id, 1) | resolve_repeated(id, LMB_TILE - 1) |
                              resolve_repeated(id, LMB_TILE) | resolve_repeated(id, LMB_TILE + 1));
    for (; leads != 0 && count < LMB_SLOTS; leads &= leads - 1) {
        const int first = lowest_bit_64(leads);
        if ((taken >> first & 1u) != 0) {
            continue;
        }
        const lanei wanted = lanei_splat((int32_t)id[first]), number = lanei_splat(count);
        const uint64_t upper = resolve_take(&a, id, 0, wanted, number) | resolve_take(&b, id, 16, wanted, number);
        const uint64_t lower = resolve_take(&c, id, 32, wanted, number) | resolve_take(&d, id, 48, wanted, number);
        taken |= upper | lower;
        out->id[count++] = id[first];
    }
    resolve_quarter_store(out->slot, &a);
    resolve_quarter_store(out->slot + 16, &b);
    resolve_quarter_store(out->slot + 32, &c);
    resolve_quarter_store(out->slot + 48, &d);
    out->count = count;
    return taken;
}
#endif

/* --- triangles ---------------------------------------------------------------------------------------------------- */

/* Loads slots from k on. Wide backends set unused slots to 0; for others they are 0 in memory. */
LANE_INLINE lane resolve_load1(const lmb_resolve_batch *b, const float *p, int k)
{
#if LANES < LMB_TILE
    (void)b;
    return lane_load(p + k);
#else
    return lane_keep(mask_of_bits((1u << (b->count - k < LANES ? b->count - k : LANES)) - 1), lane_load(p + k));
#endif
}

LANE_INLINE lane3 resolve_load(const lmb_resolve_batch *b, float (*p)[LMB_SLOTS], int k)
{
    lane3 r;
    r.x = resolve_load1(b, p[0], k);
    r.y = resolve_load1(b, p[1], k);
    r.z = resolve_load1(b, p[2], k);
    return r;
}

LANE_INLINE void resolve_store(float (*p)[LMB_SLOTS], int k, lane3 v)
{
    lane_store(p[0] + k, v.x);
    lane_store(p[1] + k, v.y);
    lane_store(p[2] + k, v.z);
}

/* Three columns times three coordinates, summed in this order. */
LANE_INLINE lane3 resolve_columns(const lmb_vec3 column[3], lane3 p)
{
    return lane3_add(lane3_add(lane3_scale(lane3_of(column[0]), p.x), lane3_scale(lane3_of(column[1]), p.y)),
                     lane3_scale(lane3_of(column[2]), p.z));
}

/* 1 if only colour is needed, for rays from one point. Then the slot holds the values shared by all pixels of a
 * triangle. The origin of rays from the eye is 0; adding 0 changes only the sign of zeros, which no colour shows. */
LANE_INLINE int resolve_from_eye(const lmb_resolve_batch *b)
{
    return LANES >= LMB_TILE && b->albedo_only && b->rays.perspective;
}

#if defined(LANE_PLAIN)
static void resolve_put_vec(float (*p)[LMB_SLOTS], int k, lmb_vec3 v)
{
    p[0][k] = v.x;
    p[1][k] = v.y;
    p[2][k] = v.z;
}

/* Without vectors one after the other, with the code for masked triangles. */
LANE_INLINE void resolve_planes(lmb_resolve_batch *b, const lmb_vec3 column[4], int k)
{
    (void)column;
    for (int slot = k; slot < k + LANES; ++slot) {
        lmb_vec3 corner[3];
        lmb_plane p;
        for (int i = 0; i < 3; ++i) {
            float (*c)[LMB_SLOTS] = b->corner[i];
            corner[i] = transform_point(&b->instance->to_world, vec3(c[0][slot], c[1][slot], c[2][slot]));
        }
        lmb_resolve_plane(&p, corner, &b->rays);
        resolve_put_vec(b->corner[0], slot, p.corner);
        resolve_put_vec(b->corner[1], slot, p.g1);
        resolve_put_vec(b->corner[2], slot, p.g2);
        resolve_put_vec(b->plane, slot, p.plane);
        resolve_put_vec(b->face, slot, p.face);
        b->w_min[slot] = p.w_min;
        b->w_max[slot] = p.w_max;
    }
}
#else
LANE_INLINE void resolve_planes(lmb_resolve_batch *b, const lmb_vec3 column[4], int k)
{
    lane3 corner[3];
    for (int i = 0; i < 3; ++i) {
        corner[i] = lane3_add(resolve_columns(column, resolve_load(b, b->corner[i], k)), lane3_of(column[3]));
    }
    const plane_lanes p = plane_setup(corner, &b->rays);
    resolve_store(b->corner[0], k, p.corner);
    resolve_store(b->corner[1], k, p.g1);
    resolve_store(b->corner[2], k, p.g2);
    resolve_store(b->plane, k, p.plane);
    if (resolve_from_eye(b)) {
        lane_store(b->face[0] + k, lane3_dot(p.plane, p.corner));
    } else {
        resolve_store(b->face, k, p.face);
    }
    lane_store(b->w_min + k, p.w_min);
    lane_store(b->w_max + k, p.w_max);
}
#endif

LANE_INLINE lane3 resolve_unit(lane3 n)
{
    const lane d2 = lane3_dot(n, n), one = lane_splat(1.0f);
    const lane_mask fine = lane_lt(lane_splat(1e-37f), d2);
    return lane3_pick(fine, lane3_scale(n, lane_div(one, lane_sqrt(lane_pick(fine, d2, one)))), n);
}

/* As lmb_octahedral_decode. */
LANE_INLINE lane3 resolve_octahedral(lane code_x, lane code_y)
{
    const lanei zero = lanei_splat(0), min = lanei_splat(-32767);
    lanei x = lanei_max(lane_to_int(code_x), min), y = lanei_max(lane_to_int(code_y), min);
    lanei z = lanei_sub(lanei_splat(32767), lanei_max(x, lanei_sub(zero, x)));
    z = lanei_sub(z, lanei_max(y, lanei_sub(zero, y)));
    const lanei fold = lanei_min(z, zero), back = lanei_sub(zero, fold);
    x = lanei_add(x, lanei_pick(lanei_lt(x, zero), back, fold));
    y = lanei_add(y, lanei_pick(lanei_lt(y, zero), back, fold));
    lane3 n;
    n.x = lane_from_int(x);
    n.y = lane_from_int(y);
    n.z = lane_from_int(z);
    return resolve_unit(n);
}

/* Normals are transformed by the cofactors of the matrix: correct for uneven scales, and mirrors only flip them. */
LANE_INLINE void resolve_normals(lmb_resolve_batch *b, const lmb_vec3 column[3], int k)
{
    const lmb_vec3 cofactor[3] = {cross3(column[1], column[2]), cross3(column[2], column[0]),
                                  cross3(column[0], column[1])};
    lane3 n[3];
    for (int i = 0; i < 3; ++i) {
        const lane3 own =
            resolve_octahedral(resolve_load1(b, b->normal[i][0], k), resolve_load1(b, b->normal[i][1], k));
        n[i] = resolve_unit(resolve_columns(cofactor, own));
        resolve_store(b->normal[i], k, i == 0 ? n[0] : lane3_sub(n[i], n[0]));
    }
}

/* code / 255, for codes 0 .. 255: the sum rounds like the division for each of them, and the division takes longer. */
LANE_INLINE lane resolve_share(lanei code)
{
    const lane c = lane_from_int(code);
    return lane_add(lane_mul(c, lane_splat(1.0f / 256.0f)), lane_mul(c, lane_splat((float)(1.0 / 65280.0))));
}

LANE_INLINE void resolve_albedo(lmb_resolve_batch *b, int k)
{
    for (int c = 0; c < 3; ++c) {
        lane v[3];
        for (int i = 0; i < 3; ++i) {
            const lanei code = lanei_load((const int32_t *)b->colour[i] + k);
            const lane colour = LMB_TEXTURE_FORMATS && b->mesh->colour_format == LMB_COLOUR_RGBA16
                                    ? lane_load(b->albedo[i][c] + k)
                                    : resolve_share(lanei_and(lanei_shift(code, 8 * c), lanei_splat(255)));
            v[i] = lane_mul(lane_splat(b->material->albedo[c]), colour);
            lane_store(b->albedo[i][c] + k, i == 0 ? v[0] : lane_sub(v[i], v[0]));
        }
    }
}

/* Values that are not finite, out of range or under 2^-60 count as 0, so that targets that flush denormals give the
 * same result. */
LANE_INLINE lane resolve_coordinate(const lmb_resolve_batch *b, const float *p, int k)
{
    const lane v = resolve_load1(b, p, k), tiny = lane_splat(8.6736174e-19f), limit = lane_splat(1048576.0f);
    const lane_mask large = mask_or(lane_le(tiny, v), lane_le(v, lane_splat(-8.6736174e-19f)));
    const lane_mask sane = mask_and(lane_lt(lane_splat(-1048576.0f), v), lane_lt(v, limit));
    return lane_keep(mask_and(large, sane), v);
}

LANE_INLINE void resolve_uv(lmb_resolve_batch *b, int k)
{
    for (int c = 0; c < 2; ++c) {
        const lane first = resolve_coordinate(b, b->uv[0][c], k);
        lane_store(b->uv[0][c] + k, first);
        lane_store(b->uv[1][c] + k, lane_sub(resolve_coordinate(b, b->uv[1][c], k), first));
        lane_store(b->uv[2][c] + k, lane_sub(resolve_coordinate(b, b->uv[2][c], k), first));
    }
}

#if defined(LANE_PLAIN) && LANES > 1
/* 1 if only colour is needed, for rays from one point. */
LANE_INLINE int resolve_by_loops(const lmb_resolve_batch *b) { return b->albedo_only && b->rays.perspective; }

LANE_INLINE void resolve_setup_loops(lmb_resolve_batch *inout)
{
    for (int k = 0; k < inout->count; k += PLAIN_SET) {
        plain_set_planes(inout, k);
        if (inout->mesh->colours != NULL) {
            (mesh_colours_are_wide(inout->mesh) ? plain_set_wide_albedo : plain_set_albedo)(inout, k);
        }
        for (int i = 0; inout->mesh->uvs != NULL && i < PLAIN_SET; i += LANES) {
            resolve_uv(inout, k + i);
        }
    }
}
#endif

static void KERNEL(resolve_setup)(lmb_resolve_batch *inout)
{
#if defined(LANE_PLAIN) && LANES > 1
    if (resolve_by_loops(inout)) {
        resolve_setup_loops(inout);
        return;
    }
#endif
    const float *m = inout->instance->to_world.m;
    const lmb_vec3 column[4] = {vec3(m[0], m[1], m[2]), vec3(m[4], m[5], m[6]), vec3(m[8], m[9], m[10]),
                                vec3(m[12], m[13], m[14])};
    for (int k = 0; k < inout->count; k += LANES) {
        resolve_planes(inout, column, k);
        if (inout->mesh->normals != NULL && !inout->albedo_only) {
            resolve_normals(inout, column, k);
        }
        if (inout->mesh->colours != NULL) {
            resolve_albedo(inout, k);
        }
        if (inout->mesh->uvs != NULL) {
            resolve_uv(inout, k);
        }
    }
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

LANE_INLINE lane3 resolve_affine(lmb_vec3 at, lmb_vec3 per_x, lmb_vec3 per_y, lane x, lane y)
{
    lane3 r;
    r.x = lane_add(lane_splat(at.x), lane_add(lane_mul(lane_splat(per_x.x), x), lane_mul(lane_splat(per_y.x), y)));
    r.y = lane_add(lane_splat(at.y), lane_add(lane_mul(lane_splat(per_x.y), x), lane_mul(lane_splat(per_y.y), y)));
    r.z = lane_add(lane_splat(at.z), lane_add(lane_mul(lane_splat(per_x.z), x), lane_mul(lane_splat(per_y.z), y)));
    return r;
}

#if LANES < LMB_TILE
/* Pixels of a vector that a batch sets. */
typedef struct resolve_pixels {
    lane_mask mine;
} resolve_pixels;

LANE_INLINE resolve_pixels resolve_pixels_of(lanei slot, int is_first)
{
    const resolve_pixels r = {lanei_not_negative(slot)};
    (void)is_first;
    return r;
}

LANE_INLINE void resolve_put(float *p, const resolve_pixels *which, lane value)
{
    lane_store(p, lane_pick(which->mine, value, lane_load(p)));
}
#else
/* Pixels of a vector: those that a batch sets, and those that keep old values. The others become 0, so tiles need not
 * be cleared. */
typedef struct resolve_pixels {
    lane_mask mine, stay;
} resolve_pixels;

LANE_INLINE resolve_pixels resolve_pixels_of(lanei slot, int is_first)
{
    const resolve_pixels r = {lanei_not_negative(slot), mask_of_bits(is_first ? 0u : ~0u)};
    return r;
}

LANE_INLINE void resolve_put(float *p, const resolve_pixels *which, lane value)
{
    lane_store(p, lane_pick(which->mine, value, lane_keep(which->stay, lane_load(p))));
}
#endif

LANE_INLINE void resolve_put3(float (*p)[LMB_TILE_PIXELS], int k, const resolve_pixels *which, lane3 v)
{
    resolve_put(p[0] + k, which, v.x);
    resolve_put(p[1] + k, which, v.y);
    resolve_put(p[2] + k, which, v.z);
}

LANE_INLINE lane3 resolve_lookup(const float (*p)[LMB_SLOTS], lanei slot)
{
    lane3 r;
    r.x = lane_table(p[0], slot);
    r.y = lane_table(p[1], slot);
    r.z = lane_table(p[2], slot);
    return r;
}

/* Position of each pixel in its triangle. */
typedef struct resolve_place {
    lanei slot;
    lane b1, b2;
} resolve_place;

LANE_INLINE lane resolve_mix(const float *first, const float *second, const float *third, const resolve_place *at)
{
    return lane_add(lane_table(first, at->slot), lane_add(lane_mul(at->b1, lane_table(second, at->slot)),
                                                          lane_mul(at->b2, lane_table(third, at->slot))));
}

/* The interpolated normal, unit length, on the face normal's side; the face normal if the interpolation vanishes. */
LANE_PART lane3 resolve_normal(const lmb_resolve_batch *b, const resolve_place *at, lane3 face)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), tiny = lane_splat(1e-12f);
    lane3 n;
    n.x = resolve_mix(b->normal[0][0], b->normal[1][0], b->normal[2][0], at);
    n.y = resolve_mix(b->normal[0][1], b->normal[1][1], b->normal[2][1], at);
    n.z = resolve_mix(b->normal[0][2], b->normal[1][2], b->normal[2][2], at);
    lane d2 = lane3_dot(n, n);
    lane_mask fine = lane_lt(tiny, d2);
    lane scale = lane_div(one, lane_sqrt(lane_pick(fine, d2, one)));
    scale = lane_pick(lane_lt(lane3_dot(n, face), zero), lane_sub(zero, scale), scale);
    return lane3_pick(fine, lane3_scale(n, scale), face);
}

/* Inputs of the triangle's colour. */
LANE_INLINE void resolve_colour(lmb_tile *out, const lmb_resolve_batch *b, int k, const resolve_place *at,
                                const resolve_pixels *which)
{
    for (int c = 0; c < 3; ++c) {
        lane albedo = lane_splat(b->material->albedo[c]);
        if (b->mesh->colours != NULL) {
            /* Rounding may make a mix of zero and a positive value negative. */
            albedo = lane_max(lane_splat(0.0f), resolve_mix(b->albedo[0][c], b->albedo[1][c], b->albedo[2][c], at));
        }
        resolve_put(out->albedo[c] + k, which, albedo);
    }
    if (b->mesh->uvs != NULL) {
        resolve_put(out->uv[0] + k, which, resolve_mix(b->uv[0][0], b->uv[1][0], b->uv[2][0], at));
        resolve_put(out->uv[1] + k, which, resolve_mix(b->uv[0][1], b->uv[1][1], b->uv[2][1], at));
#if LANES >= LMB_TILE
    } else if (b->is_first) {
        lane_store(out->uv[0] + k, lane_splat(0.0f));
        lane_store(out->uv[1] + k, lane_splat(0.0f));
#endif
    }
}

/* `from_eye`: all rays start at the eye, so each plane has one height above it. */
LANE_INLINE void resolve_vector(lmb_tile *out, const lmb_resolve_batch *b, int k, lanei slot,
                                const resolve_pixels *which, int from_eye)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    const lane x = lane_column(k), y = lane_row(k);
    const lane3 ray = resolve_affine(b->rays.direction, b->rays.rx, b->rays.ry, x, y);
    const lane3 plane = resolve_lookup(b->plane, slot), corner = resolve_lookup(b->corner[0], slot);

    lane slope = lane3_dot(plane, ray);
    slope = lane_pick(lane_lt(lane_mul(slope, slope), lane_splat(1e-36f)), lane_splat(1e-18f), slope);
    lane3 origin = lane3_splat(0.0f, 0.0f, 0.0f);
    lane height;
    if (from_eye) {
        height = lane_table(b->face[0], slot);
    } else {
        origin = resolve_affine(b->rays.origin, b->rays.ox, b->rays.oy, x, y);
        height = lane3_dot(plane, lane3_sub(corner, origin));
    }
    lane w = lane_div(height, slope);
    w = lane_min(lane_max(w, lane_table(b->w_min, slot)), lane_table(b->w_max, slot));
    const lane3 along = lane3_scale(ray, w), p = from_eye ? along : lane3_add(origin, along), q = lane3_sub(p, corner);

    resolve_place at;
    at.slot = slot;
    at.b1 = lane_min(lane_max(lane3_dot(q, resolve_lookup(b->corner[1], slot)), zero), one);
    at.b2 = lane_min(lane_max(lane3_dot(q, resolve_lookup(b->corner[2], slot)), zero), lane_sub(one, at.b1));
    resolve_colour(out, b, k, &at, which);
    if (!from_eye && !b->albedo_only) {
        const lane3 face = resolve_lookup(b->face, slot);
        resolve_put(out->depth + k, which, w);
        resolve_put3(out->position, k, which, lane3_add(p, lane3_of(b->rays.eye)));
        resolve_put3(out->face, k, which, face);
        resolve_put3(out->normal, k, which, b->mesh->normals != NULL ? resolve_normal(b, &at, face) : face);
    }
}

LANE_INLINE void resolve_all(lmb_tile *out, const lmb_resolve_batch *batch, int from_eye)
{
    const int all = LANES >= LMB_TILE && batch->is_first;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lanei slot = lanei_load(batch->slot + k);
        const resolve_pixels which = resolve_pixels_of(slot, all);
        if (all || mask_bits(which.mine) != 0) {
            resolve_vector(out, batch, k, lanei_max(slot, lanei_splat(0)), &which, from_eye);
        }
    }
}

static void KERNEL(resolve)(lmb_tile *out, const lmb_resolve_batch *batch)
{
#if defined(LANE_PLAIN) && LANES > 1
    if (resolve_by_loops(batch)) {
        plain_resolve(out, batch);
        return;
    }
#endif
    if (resolve_from_eye(batch)) {
        resolve_all(out, batch, 1);
    } else {
        resolve_all(out, batch, 0);
    }
}
