/* voxelize.c: triangles -> the share of a leaf that they cover, seen along each axis. Layer 6. [M6] */
#include <string.h>

#include "../raster/resolve.h"
#include "octree.h"

#if LMB_VOXELS

enum {
    MAX_POLYGON_CORNERS = 12 /* a triangle cut by six planes has nine */,
    OPACITY_SAMPLES = 4,
    MAX_LEAF_FACES = 32 /* leaf faces a leaf */
};

/* Areas are multiples of this, so sums up to MAX_LEAF_FACES are exact and do not depend on the order of triangles. */
static const float unit_area = 1.0f / 262144.0f;

/* A convex polygon, in leaves. */
typedef struct polygon {
    int count;
    float at[MAX_POLYGON_CORNERS][3];
} polygon;

typedef struct voxel_builder {
    lmb_voxels *v;
    const int32_t *in; /* the worlds of the part */
    float share;       /* opaque share of the triangle */
    float front;       /* 1; -1 if the instance is mirrored */
    int twice;         /* double-sided */
    int full;
} voxel_builder;

/* --- cutting ------------------------------------------------------------------------------------------------------ */

static void put_corner(polygon *p, const float at[3])
{
    if (p->count < MAX_POLYGON_CORNERS) {
        memcpy(p->at[p->count++], at, sizeof p->at[0]);
    }
}

/* Splits the polygon at the plane axis = `cut`. Edges are cut from their lower end, so that two polygons that share an
 * edge get the same corner. */
static void split(polygon *below, polygon *above, const polygon *p, int axis, float cut)
{
    below->count = above->count = 0;
    for (int i = 0; i < p->count; ++i) {
        const float *a = p->at[i], *b = p->at[i + 1 < p->count ? i + 1 : 0];
        if (a[axis] <= cut) {
            put_corner(below, a);
        }
        if (a[axis] >= cut) {
            put_corner(above, a);
        }
        if ((a[axis] < cut && b[axis] > cut) || (a[axis] > cut && b[axis] < cut)) {
            const float *low = a[axis] < b[axis] ? a : b, *high = low == a ? b : a;
            const float t = (cut - low[axis]) / (high[axis] - low[axis]);
            float at[3];
            for (int k = 0; k < 3; ++k) {
                at[k] = k == axis ? cut : low[k] + (high[k] - low[k]) * t;
            }
            put_corner(below, at);
            put_corner(above, at);
        }
    }
}

typedef struct cell_span {
    int32_t first, last; /* cells */
} cell_span;

/* Clips the polygon to the cube along an axis; returns the range of cells of the rest. */
static cell_span span_of_polygon(polygon *p, int axis, int32_t side)
{
    polygon whole, rest;
    float low = 3e38f, high = -3e38f;
    cell_span s;
    for (int i = 0; i < p->count; ++i) {
        low = minf(low, p->at[i][axis]);
        high = maxf(high, p->at[i][axis]);
    }
    if (low < 0.0f) {
        whole = *p;
        split(&rest, p, &whole, axis, 0.0f);
    }
    if (high > (float)side) {
        whole = *p;
        split(p, &rest, &whole, axis, (float)side);
    }
    s.first = (int32_t)clampf(low, 0.0f, (float)side);
    s.last = mini((int32_t)clampf(high, -1.0f, (float)side), side - 1);
    return s;
}

/* Takes the part below cell + 1 off `rest`. */
static void take_slab(polygon *out, polygon *rest, int axis, int32_t cell, int32_t last)
{
    if (cell == last) {
        *out = *rest;
        return;
    }
    const polygon whole = *rest;
    split(out, rest, &whole, axis, (float)(cell + 1));
}

/* --- adding up ---------------------------------------------------------------------------------------------------- */

/* Half the sum of the fan's cross products: the signed area seen along each axis. */
static lmb_vec3 area_of_polygon(const polygon *p)
{
    lmb_vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    const float *o = p->at[0];
    for (int i = 1; i + 1 < p->count; ++i) {
        const float *a = p->at[i], *b = p->at[i + 1];
        const lmb_vec3 to_a = vec3(a[0] - o[0], a[1] - o[1], a[2] - o[2]),
                       to_b = vec3(b[0] - o[0], b[1] - o[1], b[2] - o[2]);
        sum = add3(sum, cross3(to_a, to_b));
    }
    return mul3(sum, 0.5f);
}

static void add_area(float *to, float area)
{
    *to = minf(*to + floorf(area * (1.0f / unit_area) + 0.5f) * unit_area, (float)MAX_LEAF_FACES);
}

/* During the build a voxel stores area by the direction of the front, +x -x +y -y +z -z: first single-sided surfaces,
 * then double-sided ones. */
static void add_leaf(voxel_builder *b, const polygon *p, octree_cell c)
{
    if (p->count < 3) {
        return;
    }
    const lmb_vec3 sum = mul3(area_of_polygon(p), b->share * b->front);
    const float area[3] = {sum.x, sum.y, sum.z};
    const uint32_t at = lmb_octree_leaf(b->v, c);
    if (at == 0) {
        b->full = 1;
        return;
    }
    b->v->area += (double)length3(sum);
    for (int32_t w = 0; w < b->v->worlds; ++w) {
        float *cover = b->v->cover[w] + (size_t)at * LMB_VOXEL_COVER + (b->twice ? 6 : 0);
        for (int k = 0; k < 3 && b->in[w]; ++k) {
            add_area(&cover[2 * k + (area[k] < 0.0f)], absf(area[k]));
        }
    }
}

static void add_polygon_row(voxel_builder *b, polygon *rest, octree_cell c)
{
    const cell_span s = span_of_polygon(rest, 0, 1 << b->v->depth);
    polygon p;
    for (c.x = s.first; c.x <= s.last && !b->full; ++c.x) {
        take_slab(&p, rest, 0, c.x, s.last);
        add_leaf(b, &p, c);
    }
}

static void add_slice(voxel_builder *b, polygon *rest, octree_cell c)
{
    const cell_span s = span_of_polygon(rest, 1, 1 << b->v->depth);
    polygon p;
    for (c.y = s.first; c.y <= s.last && !b->full; ++c.y) {
        take_slab(&p, rest, 1, c.y, s.last);
        if (p.count > 0) {
            add_polygon_row(b, &p, c);
        }
    }
}

static void add_polygon(voxel_builder *b, polygon *rest)
{
    const cell_span s = span_of_polygon(rest, 2, 1 << b->v->depth);
    octree_cell c = {0, 0, 0};
    polygon p;
    for (c.z = s.first; c.z <= s.last && !b->full; ++c.z) {
        take_slab(&p, rest, 2, c.z, s.last);
        if (p.count > 0) {
            add_slice(b, &p, c);
        }
    }
}

/* --- triangles ---------------------------------------------------------------------------------------------------- */

/* Opaque share of a masked triangle, from four points: the centroid, and half way from there to each corner. */
static float opaque_share(const lmb_triangle *t, const lmb_scene *scene)
{
    static const float at[OPACITY_SAMPLES][2] = {
        {1.0f / 3.0f, 1.0f / 3.0f}, {2.0f / 3.0f, 1.0f / 6.0f}, {1.0f / 6.0f, 2.0f / 3.0f}, {1.0f / 6.0f, 1.0f / 6.0f}};
    int n = 0;
    for (int i = 0; i < OPACITY_SAMPLES; ++i) {
        n += lmb_triangle_opaque(t, scene, at[i][0], at[i][1]);
    }
    return (float)n / OPACITY_SAMPLES;
}

static void add_triangle(voxel_builder *b, const lmb_scene *scene, uint32_t id)
{
    lmb_triangle t;
    polygon p;
    if (!lmb_triangle_fetch(&t, scene, id)) {
        return;
    }
    p.count = 3;
    for (int k = 0; k < 3; ++k) {
        if (!is_sane(t.corner[k].x) || !is_sane(t.corner[k].y) || !is_sane(t.corner[k].z)) {
            return;
        }
        const lmb_vec3 at = octree_place(b->v, t.corner[k]);
        p.at[k][0] = at.x;
        p.at[k][1] = at.y;
        p.at[k][2] = at.z;
    }
    b->share = opaque_share(&t, scene);
    b->front = is_mirrored(&t.instance->to_world) ? -1.0f : 1.0f;
    b->twice = (t.material->flags & LMB_DOUBLE_SIDED) != 0;
    add_polygon(b, &p);
}

static void begin_voxels(lmb_voxels *v, int32_t depth)
{
    v->leaf *= (float)(1 << (v->depth - depth));
    v->depth = depth;
    v->count = OCTREE_SPARSE;
    v->area = 0.0;
    memset(v->child, 0, OCTREE_SPARSE * sizeof *v->child);
    for (int32_t w = 0; w < v->worlds; ++w) {
        memset(v->cover[w], 0, OCTREE_SPARSE * LMB_VOXEL_COVER * sizeof(float));
    }
}

/* Returns 1 if everything fits. */
static int add_scene_parts(lmb_voxels *v, const lmb_voxel_part *parts, int32_t count)
{
    voxel_builder b = {v, NULL, 1.0f, 1.0f, 0, 0};
    for (int32_t i = 0; i < count && !b.full; ++i) {
        const lmb_voxel_part *p = &parts[i];
        const uint32_t all = lmb_scene_triangles(p->scene);
        b.in = p->in;
        for (uint32_t n = 0; n < p->count && p->first_id + n <= all && !b.full; ++n) {
            add_triangle(&b, p->scene, p->first_id + n);
        }
    }
    return !b.full;
}

/* Converts areas to coverage. A double-sided object thinner than a voxel shows one side at a time, so the larger of
 * both areas counts. The loop starts at the last axis, because the normal overwrites the areas of later axes. */
static void finish_cover(float *cover, uint32_t count)
{
    for (int k = 2; k >= 0; --k) {
        float *c = cover;
        for (uint32_t i = 0; i < count; ++i, c += LMB_VOXEL_COVER) {
            const float plus = c[6 + 2 * k], minus = c[7 + 2 * k], max = maxf(plus, minus);
            c[6 + 2 * k] = c[7 + 2 * k] = 0.0f;
            c[8 + k] = plus - minus;
            c[2 * k] += max;
            c[2 * k + 1] += max;
        }
    }
}

static int parts_are_valid(const lmb_voxel_part *parts, int32_t count)
{
    int valid = 1;
    for (int32_t i = 0; i < count; ++i) {
        valid &= parts[i].scene != NULL && parts[i].first_id > 0;
    }
    return valid;
}

/* The box starts a twelfth of the cube's side from the cube's corner; along the longest axis it ends at the same
 * distance from the other face. So walls on the box lie 1/3 or 2/3 into their voxels on every level except the coarsest
 * three. There rounding cannot move their light into other voxels. Walls at the outer faces of voxels would be read too
 * late on every level (see cone.c). */
static void set_voxel_cube(lmb_voxels *v, const lmb_vec3 *low, const lmb_vec3 *high, int32_t depth)
{
    const float side = maxf(largest3(sub3(*high, *low)), 1e-6f) * 1.2f, margin = side / 12.0f;
    v->asked = v->depth = depth;
    v->leaf = side / (float)(1 << depth);
    v->low = sub3(*low, vec3(margin, margin, margin));
}

lmb_status lmb_voxels_build(lmb_voxels *v, const lmb_vec3 *low, const lmb_vec3 *high, int32_t depth,
                            const lmb_voxel_part *parts, int32_t count)
{
    if (v == NULL || v->child == NULL || low == NULL || high == NULL || parts == NULL || count < 0 ||
        depth < LMB_VOXEL_MIN_DEPTH || depth > LMB_VOXEL_MAX_DEPTH || !(low->x <= high->x) || !(low->y <= high->y) ||
        !(low->z <= high->z) || !is_sane(largest3(*low)) || !is_sane(largest3(*high)) ||
        !parts_are_valid(parts, count)) {
        return LMB_ERR_ARG;
    }
    set_voxel_cube(v, low, high, depth);
    for (begin_voxels(v, depth); !add_scene_parts(v, parts, count);) {
        begin_voxels(v, v->depth - 1);
    }
    v->area *= (double)v->leaf * (double)v->leaf;
    for (int32_t w = 0; w < v->worlds; ++w) {
        lmb_octree_mean(v, v->cover[w], LMB_VOXEL_COVER);
        finish_cover(v->cover[w], v->count);
    }
    for (int32_t f = 0; f < (v->worlds == 1 ? LMB_VOXELS_ONE : LMB_VOXELS_THREE); ++f) {
        lmb_voxels_dark(v, f);
    }
    return LMB_OK;
}

#endif
