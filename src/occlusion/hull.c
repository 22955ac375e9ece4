/* hull.c: convex rooms, in which every point sees every other. Layer 4.
 *
 * A triangle blocks a segment only if both ends are farther than some noise from the triangle's plane, on different
 * sides (occluded.c). So none blocks if both ends are in front of every plane, or slightly behind. Let R be the largest
 * distance along an axis from the centre of the room's box, and L the largest coordinate. The noise is at least N =
 * 2^-18 R + 2^-21 L: build.c ensures this for convex rooms only, in which no occluder could be missed. A plane stands
 * for triangles with the same normal, bit by bit or negated, and corners within N / 4 of the plane. Points are tested
 * against planes in binary64 and may be N / 4 behind; 2^-23 L of that allows for the rounding of coordinates. So an
 * accepted point is at most N / 2 behind the plane of a triangle. The blocking test is in binary32: two dot products of
 * a unit normal with differences of points, which are within R (1 + 2^-10) of the centre along each axis. A difference
 * is wrong by 2^-24 of itself, and a product and its sums by 3 x 2^-24 more, for terms that sum up to at most 2 sqrt(3)
 * R (1 + 2^-10). Both together are below 1.74 x 2^-20 R, which is less than the rest of N, at least 2^-19 R: no
 * triangle blocks. A room far from the origin has the same R; only L grows. */
#include <lambent/occlusion.h>

#include "../base/vec.h"
#include "../raster/tile.h"
#include "../raster/triangle.h"
#include "traversal.h"

#if LMB_TREES

#define ROUNDING_MARGIN   1.0009765625f /* 1 + 2^-10: how far rounding may move a point out of the box */
#define COORDINATE_WEIGHT 0.125f        /* weight of a coordinate relative to a distance in the room */

static double above(lmb_vec3 normal, lmb_vec3 at, lmb_vec3 p)
{
    return (double)normal.x * ((double)p.x - (double)at.x) + (double)normal.y * ((double)p.y - (double)at.y) +
           (double)normal.z * ((double)p.z - (double)at.z);
}

static int is_same_plane(lmb_vec3 a, lmb_vec3 b, float sign)
{
    return a.x == sign * b.x && a.y == sign * b.y && a.z == sign * b.z;
}

/* Triangle `id` and its normal. Returns 0 if it blocks nothing. */
static int take_drawable(lmb_triangle *t, lmb_vec3 *normal, const lmb_scene *scene, uint32_t id)
{
    float area;
    return lmb_triangle_fetch(t, scene, id) && lmb_triangle_shape(normal, &area, t);
}

/* 1 if the normal and the corners of a triangle match plane k. */
static int lies_in(const lmb_hull *h, int k, const lmb_triangle *t, lmb_vec3 normal)
{
    int in = is_same_plane(normal, h->normal[k], 1.0f) || is_same_plane(normal, h->normal[k], -1.0f);
    for (int i = 0; i < 3 && in; ++i) {
        const double d = above(h->normal[k], h->at[k], t->corner[i]);
        in = d <= (double)h->slack && d >= -(double)h->slack;
    }
    return in;
}

/* Sets middle, reach and slack. */
static void measure_hull(lmb_hull *out, const lmb_scene *scene, uint32_t triangles)
{
    lmb_triangle t;
    lmb_vec3 normal, low = vec3(3e38f, 3e38f, 3e38f), high = vec3(-3e38f, -3e38f, -3e38f);
    for (uint32_t id = 1; id <= triangles; ++id) {
        const int corners = take_drawable(&t, &normal, scene, id) ? 3 : 0;
        for (int c = 0; c < corners; ++c) {
            low = min3(low, t.corner[c]);
            high = max3(high, t.corner[c]);
        }
    }
    out->middle = mul3(add3(low, high), 0.5f);
    const float step = maxf(largest3(sub3(high, out->middle)), largest3(sub3(low, out->middle)));
    out->reach = step * ROUNDING_MARGIN;
    out->slack = (step + COORDINATE_WEIGHT * maxf(largest3(low), largest3(high))) * (LMB_NOISE_HULL * 0.25f);
}

/* 1 if there are more normals than planes in a hull. In most scenes a few triangles decide this. */
static int has_many_normals(lmb_hull *scratch, const lmb_scene *scene, uint32_t triangles)
{
    lmb_triangle t;
    lmb_vec3 normal;
    int count = 0;
    for (uint32_t id = 1; id <= triangles; ++id) {
        int k = 0;
        if (!take_drawable(&t, &normal, scene, id)) {
            continue;
        }
        while (k < count && !is_same_plane(normal, scratch->normal[k], 1.0f) &&
               !is_same_plane(normal, scratch->normal[k], -1.0f)) {
            ++k;
        }
        if (k == LMB_HULL_PLANES) {
            return 1;
        }
        scratch->normal[k] = normal;
        count = maxi(count, k + 1);
    }
    return 0;
}

/* Stores every plane once. Returns 0 if there are too many. */
static int find_planes(lmb_hull *out, const lmb_scene *scene, uint32_t triangles)
{
    lmb_triangle t;
    lmb_vec3 normal;
    for (uint32_t id = 1; id <= triangles; ++id) {
        int k = 0;
        if (!take_drawable(&t, &normal, scene, id)) {
            continue;
        }
        while (k < out->count && !lies_in(out, k, &t, normal)) {
            ++k;
        }
        if (k == LMB_HULL_PLANES) {
            return 0;
        }
        if (k == out->count) {
            out->normal[k] = normal;
            out->at[k] = t.corner[0];
            ++out->count;
        }
    }
    return 1;
}

/* Turns the front of plane k towards the scene. Returns 0 if the scene lies on both sides. */
static int turn_plane(lmb_hull *h, int k, const lmb_scene *scene, uint32_t triangles)
{
    lmb_triangle t;
    lmb_vec3 normal;
    double low = 0.0, high = 0.0;
    for (uint32_t id = 1; id <= triangles && (high <= (double)h->slack || low >= -(double)h->slack); ++id) {
        const int corners = take_drawable(&t, &normal, scene, id) ? 3 : 0;
        for (int c = 0; c < corners; ++c) {
            const double d = above(h->normal[k], h->at[k], t.corner[c]);
            low = d < low ? d : low;
            high = d > high ? d : high;
        }
    }
    if (high <= (double)h->slack) {
        h->normal[k] = mul3(h->normal[k], -1.0f);
    }
    return high <= (double)h->slack || low >= -(double)h->slack;
}

void lmb_hull_find(lmb_hull *out, const lmb_scene *scene)
{
    const uint32_t triangles = lmb_scene_triangles(scene);
    int is_convex = 1;
    if (out == NULL) {
        return;
    }
    out->count = 0;
    if (has_many_normals(out, scene, triangles)) {
        return;
    }
    measure_hull(out, scene, triangles);
    is_convex = find_planes(out, scene, triangles);
    for (int k = 0; k < out->count && is_convex; ++k) {
        is_convex = turn_plane(out, k, scene, triangles);
    }
    out->count = is_convex ? out->count : 0;
}

int lmb_hull_holds(const lmb_hull *h, lmb_vec3 at)
{
    int in = h != NULL && h->count > 0 && largest3(sub3(at, h->middle)) <= h->reach;
    for (int k = 0; in && k < h->count; ++k) {
        in = above(h->normal[k], h->at[k], at) >= -(double)h->slack;
    }
    return in;
}

uint64_t lmb_hull_pixels(const lmb_hull *h, const lmb_tile *tile, uint64_t pixels)
{
    uint64_t out = 0;
    for (uint64_t bits = h != NULL && tile != NULL && h->count > 0 ? pixels : 0; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        out |= (uint64_t)lmb_hull_holds(h, tile_vec(tile->position, k)) << k;
    }
    return out;
}

#endif
