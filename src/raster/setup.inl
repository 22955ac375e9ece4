/* setup.inl: a batch of triangles from positions to edges, box and depth plane, LANES triangles at a time. Layer 3.
 *
 * The arithmetic is that of draw_one.c and setup.c, value by value, but only for small triangles with edges that fit 32
 * bits: a box under 64 px a side (2^14 in 24.8) keeps products of differences under 2^29 up to the far corner of the
 * tiles. */

#include <string.h>

#include "../base/vertex.h"

#if LANES > 1
/* Corners of a batch, m in model space. All are fetched before the first are used, because a vector load stalls after
 * scalar stores to the same bytes. */
typedef struct setup_corners {
    float position[3][3][LMB_BATCH]; /* [corner][axis] */
} setup_corners;

/* Without vectors a call is cheaper than the lanes of three corners at once. */
#if defined(LANE_PLAIN)
#define SETUP_CORNER static
#else
#define SETUP_CORNER LANE_INLINE
#endif

/* Fetches corner i of triangle k. Returns 1 if the mesh has this vertex. */
SETUP_CORNER uint32_t setup_fetch_corner(setup_corners *out, int i, uint32_t k, const lmb_mesh *mesh, uint32_t vertex)
{
    if (vertex >= mesh->vertex_count) {
        out->position[i][0][k] = out->position[i][1][k] = out->position[i][2][k] = 0.0f;
        return 0;
    }
    const lmb_vec3 p = mesh_position(mesh, vertex);
    out->position[i][0][k] = p.x;
    out->position[i][1][k] = p.y;
    out->position[i][2][k] = p.z;
    return 1;
}

/* Fetches `count` triangles from `first` on. Returns those with all indices inside the mesh, one bit each. */
LANE_INLINE uint32_t setup_fetch_all(setup_corners *out, const lmb_mesh *mesh, uint32_t first, uint32_t count)
{
    uint32_t in = 0;
    for (uint32_t k = 0; k < count; ++k) {
        uint32_t vertex[3];
        mesh_triangle(mesh, first + k, vertex);
        const uint32_t a = setup_fetch_corner(out, 0, k, mesh, vertex[0]),
                       b = setup_fetch_corner(out, 1, k, mesh, vertex[1]),
                       c = setup_fetch_corner(out, 2, k, mesh, vertex[2]);
        in |= (a & b & c) << k;
    }
    return in;
}

#if defined(LANE_GATHERS_CORNERS)
/* Fetches a whole batch of a common mesh, if it reads neither past the mesh nor the last vertex; a corner is read with
 * the following number. Otherwise returns 0. Prefetches the first corners of the next batch, and indices of the batch
 * three further on. */
LANE_INLINE int setup_fetch_usual(setup_corners *out, const lmb_mesh *mesh, uint32_t first, uint32_t count)
{
    if (count != LMB_BATCH || mesh->vertex_count == 0 || mesh->index_format != LMB_INDEX_U32 ||
        mesh->position_format != LMB_POSITION_F32) {
        return 0;
    }
    const uint32_t *vertex = (const uint32_t *)mesh->indices + (size_t)first * 3;
    const lanei low = lanei_splat(INT32_MIN), past = lanei_splat((int32_t)(mesh->vertex_count - 1) ^ INT32_MIN);
    lane_mask in = mask_of_bits(0xffffu);
    for (int i = 0; i < 3 * LMB_BATCH; i += LANES) {
        in = mask_and(in, lanei_lt(lanei_add(lanei_load((const int32_t *)vertex + i), low), past));
    }
    if (mask_bits(mask_not(in)) != 0) {
        return 0;
    }
    if (mesh->triangle_count - first >= 5 * LMB_BATCH) { /* otherwise the indices end before the prefetched ones */
        for (int k = 0; k < LMB_BATCH; ++k) {
            MESH_SOON((const void *)((uintptr_t)mesh->positions +
                                     (size_t)vertex[3 * (LMB_BATCH + k)] * 12)); /* not checked yet */
        }
        MESH_SOON(vertex + 12 * LMB_BATCH), MESH_SOON(vertex + 13 * LMB_BATCH), MESH_SOON(vertex + 14 * LMB_BATCH);
    }
    for (int k = 0; k < LMB_BATCH; k += LANES) {
        for (int i = 0; i < 3; ++i) {
            lane p[3];
            lane_gather_corners(p, (const float *)mesh->positions, vertex + 3 * k + i);
            lane_store(out->position[i][0] + k, p[0]);
            lane_store(out->position[i][1] + k, p[1]);
            lane_store(out->position[i][2] + k, p[2]);
        }
    }
    return 1;
}
#endif

/* The same, with specialised code for common meshes. */
static inline uint32_t setup_fetch(setup_corners *out, const lmb_mesh *mesh, uint32_t first, uint32_t count)
{
#if defined(LANE_GATHERS_CORNERS)
    if (setup_fetch_usual(out, mesh, first, count)) {
        return (1u << LMB_BATCH) - 1;
    }
#endif
    if (count < LMB_BATCH) {
        memset(out, 0, sizeof *out); /* unused places hold valid numbers */
    }
    return setup_fetch_all(out, mesh, first, count);
}
#endif

typedef struct setup_corner {
    lanei x, y; /* 24.8 */
    lane d;
} setup_corner;

/* State of the corners so far: all are sane; one is outside a plane; all are outside the near plane, left, right, top,
 * bottom. */
typedef struct setup_sides {
    lane_mask sane, any, all[5];
} setup_sides;

static inline lane setup_row(const float row[4], lane3 p)
{
    lane sum = lane_add(lane_mul(lane_splat(row[0]), p.x), lane_mul(lane_splat(row[1]), p.y));
    return lane_add(lane_add(sum, lane_mul(lane_splat(row[2]), p.z)), lane_splat(row[3]));
}

static inline lane_mask setup_sane(lane v)
{
    return mask_and(lane_lt(lane_splat(-1048576.0f), v), lane_lt(v, lane_splat(1048576.0f)));
}

static inline lanei setup_floor(lane v)
{
    lanei i = lane_to_int(v);
    return lanei_pick(lane_lt(v, lane_from_int(i)), lanei_sub(i, lanei_splat(1)), i);
}

/* A corner before the division. */
typedef struct setup_point {
    lane x, y, z, w;
} setup_point;

/* `out`: outside the near plane, left, right, top, bottom. Returns whether the corner is sane. */
LANE_INLINE lane_mask setup_project(setup_point *to, lane_mask out[5], const lmb_setup_job *job, lane3 p)
{
    const lane zero = lane_splat(0.0f);
    lane along_x = setup_row(job->row[0], p), along_y = setup_row(job->row[1], p), along = setup_row(job->row[2], p);
    setup_point r;
    r.x = lane_mul(along_x, lane_splat(job->scale_x));
    r.y = lane_mul(along_y, lane_splat(job->scale_y));
    r.w = along;
    r.z = lane_splat(job->near_m);
    if (job->orthographic) {
        r.z = lane_mul(lane_sub(lane_splat(job->far_m), along), lane_splat(job->depth_scale));
        r.w = lane_splat(1.0f);
    }
    const lane wide = lane_mul(lane_splat(job->guard_x), r.w), high = lane_mul(lane_splat(job->guard_y), r.w);
    out[0] = lane_lt(lane_sub(r.w, r.z), zero);
    out[1] = lane_lt(lane_add(wide, r.x), zero);
    out[2] = lane_lt(lane_sub(wide, r.x), zero);
    out[3] = lane_lt(lane_sub(high, r.y), zero);
    out[4] = lane_lt(lane_add(high, r.y), zero);
    *to = r;
    return mask_and(mask_and(setup_sane(along_x), setup_sane(along_y)), setup_sane(along));
}

/* Corners that are clipped or insane (not `good`) are not used, and must not reach the conversion to int. */
LANE_INLINE setup_corner setup_snap(const lmb_setup_job *job, const setup_point *p, lane_mask good)
{
    const lane one = lane_splat(1.0f), inverse = lane_div(one, lane_pick(good, p->w, one));
    const lane x = lane_mul(lane_mul(lane_keep(good, p->x), inverse), lane_splat(job->snap_x)),
               y = lane_mul(lane_mul(lane_keep(good, p->y), inverse), lane_splat(job->snap_y));
    setup_corner c;
    c.x = setup_floor(lane_add(x, lane_splat(0.5f)));
    c.y = setup_floor(lane_sub(lane_splat(0.5f), y));
    c.d = lane_mul(lane_keep(good, p->z), inverse);
    return c;
}

#if LANES > 1
/* Adds a corner's sides. Returns the lanes that are inside all planes and sane. */
LANE_INLINE lane_mask setup_side(setup_sides *inout, lane_mask sane, const lane_mask out[5])
{
    const lane_mask any = mask_or(out[0], mask_or(mask_or(out[1], out[2]), mask_or(out[3], out[4])));
    inout->sane = mask_and(inout->sane, sane);
    inout->any = mask_or(inout->any, any);
    for (int i = 0; i < 5; ++i) {
        inout->all[i] = mask_and(inout->all[i], out[i]);
    }
    return mask_and(sane, mask_not(any));
}

NOINLINE setup_corner setup_transform(setup_sides *sides, const lmb_setup_job *job,
                                         const float (*position)[LMB_BATCH], int k)
{
    lane3 p;
    p.x = lane_load(position[0] + k);
    p.y = lane_load(position[1] + k);
    p.z = lane_load(position[2] + k);
    setup_point at;
    lane_mask out[5];
    const lane_mask sane = setup_project(&at, out, job, p);
    return setup_snap(job, &at, setup_side(sides, sane, out));
}
#endif

static inline lanei setup_min3(lanei a, lanei b, lanei c) { return lanei_min(a, lanei_min(b, c)); }
static inline lanei setup_max3(lanei a, lanei b, lanei c) { return lanei_max(a, lanei_max(b, c)); }

/* First and last pixels with centres in a box's side, within the window. */
static inline lanei setup_first(lanei low, int32_t origin, int32_t min)
{
    return lanei_max(lanei_shift(lanei_add(low, lanei_splat(255 - origin)), 8), lanei_splat(min));
}

static inline lanei setup_last(lanei high, int32_t origin, int32_t max)
{
    return lanei_min(lanei_shift(lanei_sub(high, lanei_splat(origin)), 8), lanei_splat(max));
}

/* Edge i from one corner to the next: floor(E / 256) at (x, y), with the fill rule in E. */
LANE_PART void setup_edge_lanes(lmb_batch *b, int i, int k, const setup_corner *from, const setup_corner *to,
                                    lanei x, lanei y)
{
    const lanei zero = lanei_splat(0);
    lanei ex = lanei_sub(from->y, to->y), ey = lanei_sub(to->x, from->x);
    lane_mask on = mask_or(lanei_lt(zero, ex), mask_and(lanei_equal(ex, zero), lanei_lt(zero, ey)));
    lanei e = lanei_add(lanei_mul(ex, lanei_sub(x, from->x)), lanei_mul(ey, lanei_sub(y, from->y)));
    lanei_store(b->ex[i] + k, ex);
    lanei_store(b->ey[i] + k, ey);
    lanei_store(b->e[i] + k, lanei_shift(lanei_add(e, lanei_pick(on, zero, lanei_splat(-1))), 8));
}

LANE_PART void setup_depth(lmb_batch *out, int k, const setup_corner *a, const setup_corner *b,
                               const setup_corner *c, lanei area)
{
    const laned to_px = laned_splat(1.0 / 256.0);
    laned ad = laned_from(a->d), bd = laned_sub(laned_from(b->d), ad), cd = laned_sub(laned_from(c->d), ad);
    laned bx = laned_from_int(lanei_sub(b->x, a->x)), by = laned_from_int(lanei_sub(b->y, a->y));
    laned cx = laned_from_int(lanei_sub(c->x, a->x)), cy = laned_from_int(lanei_sub(c->y, a->y));
    laned per_px = laned_div(laned_splat(256.0), laned_from_int(area));
    laned dx = laned_mul(laned_sub(laned_mul(bd, cy), laned_mul(cd, by)), per_px);
    laned dy = laned_mul(laned_sub(laned_mul(cd, bx), laned_mul(bd, cx)), per_px);
    laned d = laned_sub(ad, laned_mul(dx, laned_mul(laned_from_int(a->x), to_px)));
    laned_store(out->d + k, laned_sub(d, laned_mul(dy, laned_mul(laned_from_int(a->y), to_px))));
    laned_store(out->dx + k, dx);
    laned_store(out->dy + k, dy);
    lane_store(out->d_min + k, lane_min(a->d, lane_min(b->d, c->d)));
    lane_store(out->d_max + k, lane_max(a->d, lane_max(b->d, c->d)));
}

LANE_INLINE setup_corner setup_either(lane_mask m, const setup_corner *a, const setup_corner *b)
{
    setup_corner c;
    c.x = lanei_pick(m, a->x, b->x);
    c.y = lanei_pick(m, a->y, b->y);
    c.d = lane_pick(m, a->d, b->d);
    return c;
}

/* Triangles side by side: corners b and c from a, twice the area, the pixels of their boxes; `turned`: opposite
 * winding; `shown`: visible in the window. */
typedef struct setup_box {
    lanei bx, by, cx, cy, area, x0, y0, x1, y1;
    lane_mask turned, shown;
} setup_box;

LANE_INLINE void setup_begin(lmb_batch_sets *out, uint32_t in)
{
    out->in = in;
    out->small = out->other = out->drawn = out->dropped = 0;
}

/* Triangles k .. k + LANES - 1, from their corners; `in`: those that exist. Adds to all sets but `small`. Returns the
 * visible ones, one bit each. */
LANE_INLINE uint32_t setup_find_box(setup_box *box, lmb_batch_sets *out, const lmb_setup_job *job,
                                    const setup_sides *sides, lane_mask in, const setup_corner *a,
                                    const setup_corner *b, const setup_corner *c, int k)
{
    const lanei zero = lanei_splat(0);
    const lane_mask hidden = mask_or(sides->all[0], mask_or(mask_or(sides->all[1], sides->all[2]),
                                                            mask_or(sides->all[3], sides->all[4])));
    const lane_mask sane = sides->sane, whole = mask_and(sane, mask_not(sides->any));
    const lanei x0 = setup_min3(a->x, b->x, c->x), x1 = setup_max3(a->x, b->x, c->x);
    const lanei y0 = setup_min3(a->y, b->y, c->y), y1 = setup_max3(a->y, b->y, c->y);
    const lanei limit = lanei_splat(LMB_SMALL_24_8);
    lane_mask small = mask_and(whole, mask_and(lanei_lt(lanei_sub(x1, x0), limit), lanei_lt(lanei_sub(y1, y0), limit)));
    lanei bx = lanei_sub(b->x, a->x), by = lanei_sub(b->y, a->y), cx = lanei_sub(c->x, a->x),
          cy = lanei_sub(c->y, a->y);
    /* Products of other triangles may overflow, so their inputs are set to 0. */
    bx = lanei_pick(small, bx, zero), by = lanei_pick(small, by, zero);
    cx = lanei_pick(small, cx, zero), cy = lanei_pick(small, cy, zero);
    const lanei area = lanei_sub(lanei_mul(bx, cy), lanei_mul(cx, by));
    lane_mask turned = lanei_lt(area, zero), shown = mask_and(small, mask_not(lanei_equal(area, zero)));
    if (job->cull < 0) {
        shown = mask_and(shown, mask_not(turned));
    } else if (job->cull > 0) {
        shown = mask_and(shown, turned);
    }
    out->dropped |= mask_bits(mask_and(in, mask_not(sane))) << k;
    out->other |= mask_bits(mask_and(mask_and(sane, mask_not(hidden)), mask_not(small))) << k;
    out->drawn |= mask_bits(shown) << k;
    box->bx = bx, box->by = by, box->cx = cx, box->cy = cy;
    box->area = area;
    box->turned = turned;
    box->x0 = setup_first(x0, job->origin_x, job->x0), box->x1 = setup_last(x1, job->origin_x, job->x1);
    box->y0 = setup_first(y0, job->origin_y, job->y0), box->y1 = setup_last(y1, job->origin_y, job->y1);
    box->shown = mask_and(shown, mask_not(mask_or(lanei_lt(box->x1, box->x0), lanei_lt(box->y1, box->y0))));
    return mask_bits(box->shown);
}

/* Edges and planes of triangles k .. k + LANES - 1, some of which are visible. Changes the corners. */
LANE_INLINE void setup_edges(lmb_batch *out, const lmb_setup_job *job, const setup_box *box, setup_corner *a,
                             setup_corner *b, setup_corner *c, int k)
{
    const lane_mask shown = box->shown;
    lanei_store(out->x1 + k, box->x1);
    lanei_store(out->y1 + k, box->y1);
    /* Triangles that are not shown use corner a, so that no sum below exceeds 32 bits. */
    b->x = lanei_add(a->x, box->bx), b->y = lanei_add(a->y, box->by);
    c->x = lanei_add(a->x, box->cx), c->y = lanei_add(a->y, box->cy);
    const lanei px0 = lanei_pick(shown, box->x0, lanei_splat(job->x0)),
                py0 = lanei_pick(shown, box->y0, lanei_splat(job->y0));
    lanei_store(out->x0 + k, px0);
    lanei_store(out->y0 + k, py0);
    const setup_corner second = setup_either(box->turned, c, b), third = setup_either(box->turned, b, c);
    const lanei area =
        lanei_pick(box->turned, lanei_sub(lanei_splat(0), box->area), lanei_pick(shown, box->area, lanei_splat(1)));
    lanei x = lanei_add(lanei_mul(lanei_shift(px0, 3), lanei_splat(LMB_TILE * 256)), lanei_splat(job->origin_x));
    lanei y = lanei_add(lanei_mul(lanei_shift(py0, 3), lanei_splat(LMB_TILE * 256)), lanei_splat(job->origin_y));
    x = lanei_pick(shown, x, a->x), y = lanei_pick(shown, y, a->y);
    setup_edge_lanes(out, 0, k, a, &second, x, y);
    setup_edge_lanes(out, 1, k, &second, &third, x, y);
    setup_edge_lanes(out, 2, k, &third, a, x, y);
    setup_depth(out, k, a, &second, &third, area);
}

/* Triangles k .. k + LANES - 1, from their corners, which change; `in`: those that exist. */
LANE_INLINE void setup_triangles(lmb_batch *out, const lmb_setup_job *job, const setup_sides *sides, lane_mask in,
                                 setup_corner *a, setup_corner *b, setup_corner *c, int k)
{
    setup_box box;
    const uint32_t bits = setup_find_box(&box, &out->sets, job, sides, in, a, b, c, k);
    if (bits != 0) {
        out->sets.small |= bits << k;
        setup_edges(out, job, &box, a, b, c, k);
    }
}

#if LANES > 1 && defined(LANE_PLAIN)
#include "setup_plain.inl"
#elif LANES > 1
/* A separate function: in KERNEL(setup)'s loop compilers would keep the invariants, two dozen vectors, on the stack. */
NOINLINE void setup_lanes(lmb_batch *out, const lmb_setup_job *job, const setup_corners *corners, int k)
{
    const lane_mask in = mask_of_bits(out->sets.in >> k);
    setup_sides sides = {in, mask_not(in), {in, in, in, in, in}};
    setup_corner a = setup_transform(&sides, job, corners->position[0], k),
                 b = setup_transform(&sides, job, corners->position[1], k),
                 c = setup_transform(&sides, job, corners->position[2], k);
    setup_triangles(out, job, &sides, in, &a, &b, &c, k);
}

static void KERNEL(setup)(lmb_batch *out, const lmb_setup_job *job, const lmb_mesh *mesh, uint32_t first,
                          uint32_t count)
{
    setup_corners corners;
    setup_begin(&out->sets, setup_fetch(&corners, mesh, first, count));
    for (int k = 0; k < LMB_BATCH && out->sets.in >> k != 0; k += LANES) {
        setup_lanes(out, job, &corners, k);
    }
}
#else
/* One at a time, triangles share two corners in three with recent ones. A corner stays transformed until another vertex
 * takes its place in the cache. */
enum { SETUP_INSANE = 1, SETUP_OUTSIDE = 62 }; /* bits 1 .. 5 of is_out: one a plane */

static void setup_keep(lmb_batch_corner *out, const lmb_setup_job *job, const lmb_mesh *mesh, uint32_t vertex)
{
    const lmb_vec3 p = mesh_position(mesh, vertex);
    setup_point at;
    lane_mask side[5];
    const lane_mask sane = setup_project(&at, side, job, lane3_splat(p.x, p.y, p.z));
    out->vertex = vertex + 1;
    out->is_out = (~mask_bits(sane) & SETUP_INSANE) | mask_bits(side[0]) << 1 | mask_bits(side[1]) << 2 |
                  mask_bits(side[2]) << 3 | mask_bits(side[3]) << 4 | mask_bits(side[4]) << 5;
    if (out->is_out == 0) {
        const setup_corner c = setup_snap(job, &at, mask_of_bits(1));
        lanei_store(&out->x, c.x);
        lanei_store(&out->y, c.y);
        lane_store(&out->d, c.d);
    }
}

/* Finds a corner in the cache or transforms it. Returns 0 if the mesh has no such vertex. */
static int setup_find(lmb_batch_corner *out, lmb_batch_sets *b, const lmb_setup_job *job, const lmb_mesh *mesh,
                      uint32_t vertex)
{
    lmb_batch_corner *own = &b->kept[vertex % LMB_BATCH_CORNERS];
    if (vertex >= mesh->vertex_count) {
        return 0;
    }
    if (own->vertex != vertex + 1) {
        setup_keep(own, job, mesh, vertex);
    }
    *out = *own;
    return 1;
}

LANE_INLINE setup_corner setup_of(const lmb_batch_corner *c)
{
    setup_corner r;
    r.x = lanei_splat(c->x);
    r.y = lanei_splat(c->y);
    r.d = lane_splat(c->d);
    return r;
}

/* Triangle k of the batch. Returns 1 and the corners if they are sane and no plane cuts it; otherwise updates the
 * sets. */
static int setup_whole(setup_corner corner[3], lmb_batch_sets *out, const lmb_setup_job *job, const lmb_mesh *mesh,
                       uint32_t triangle, uint32_t k)
{
    lmb_batch_corner c[3];
    uint32_t vertex[3];
    mesh_triangle(mesh, triangle, vertex);
    if (!setup_find(&c[0], out, job, mesh, vertex[0]) || !setup_find(&c[1], out, job, mesh, vertex[1]) ||
        !setup_find(&c[2], out, job, mesh, vertex[2])) {
        return 0;
    }
    const uint32_t any = c[0].is_out | c[1].is_out | c[2].is_out, all = c[0].is_out & c[1].is_out & c[2].is_out;
    out->in |= 1u << k;
    if (any != 0) {
        out->dropped |= (any & SETUP_INSANE) << k;
        out->other |= (uint32_t)((any & SETUP_INSANE) == 0 && (all & SETUP_OUTSIDE) == 0) << k;
        return 0;
    }
    for (int i = 0; i < 3; ++i) {
        corner[i] = setup_of(&c[i]);
    }
    return 1;
}

/* The sides of a triangle inside all planes. */
LANE_INLINE setup_sides setup_inside(void)
{
    const lane_mask in = mask_of_bits(1), none = mask_of_bits(0);
    const setup_sides inside = {in, none, {none, none, none, none, none}};
    return inside;
}

static void KERNEL(setup)(lmb_batch *out, const lmb_setup_job *job, const lmb_mesh *mesh, uint32_t first,
                          uint32_t count)
{
    const setup_sides inside = setup_inside();
    setup_corner c[3];
    setup_begin(&out->sets, 0);
    for (uint32_t k = 0; k < count; ++k) {
        if (setup_whole(c, &out->sets, job, mesh, first + k, k)) {
            setup_triangles(out, job, &inside, inside.sane, &c[0], &c[1], &c[2], (int)k);
        }
    }
}
#endif
