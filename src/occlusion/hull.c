/* hull.c: convex rooms, where what is inside sees all that is inside. Floor 4.
 *
 * A triangle blocks where both ends of a segment are farther than `noise` from its plane, on two sides (blocked.c). So
 * none does where both are on the front of every plane, or not far behind. With L the largest coordinate, noise is
 * 2^-18 L. A plane stands for triangles whose normal is its own, bit by bit or turned, and whose corners are within
 * noise / 4 of it; points are held against planes in binary64, and may be noise / 4 behind. So a point that is held is
 * at most noise / 2 = 2^-19 L behind the plane of a triangle. What blocks a segment is asked in binary32: two dot
 * products of a unit normal with differences of points, each wrong by at most 4 x 2^-24 of the sum of its terms'
 * sizes, which is at most 2 sqrt(3) L (1 + 2^-10): together under 1.7 x 2^-20 L. That is less than what is left of
 * noise, 2^-19 L: no triangle blocks. */
#include <lambent/occlusion.h>

#include "../base/vec.h"
#include "../raster/tile.h"
#include "../raster/triangle.h"
#include "walk.h"

#if LMB_TREES

#define ROOM 1.0009765625f /* 1 + 2^-10: how far over the largest coordinate rounding may lift a point */

static double above(lmb_vec3 normal, lmb_vec3 at, lmb_vec3 p)
{
    return (double)normal.x * ((double)p.x - (double)at.x) + (double)normal.y * ((double)p.y - (double)at.y) +
           (double)normal.z * ((double)p.z - (double)at.z);
}

static int is_same(lmb_vec3 a, lmb_vec3 b, float sign)
{
    return a.x == sign * b.x && a.y == sign * b.y && a.z == sign * b.z;
}

/* Triangle `id` and its normal; 0 where it blocks nothing. */
static int take(lmb_triangle *t, lmb_vec3 *normal, const lmb_scene *scene, uint32_t id)
{
    float area;
    return lmb_triangle_fetch(t, scene, id) && lmb_triangle_shape(normal, &area, t);
}

/* Do a triangle's normal and corners lie in plane k? */
static int lies_in(const lmb_hull *h, int k, const lmb_triangle *t, lmb_vec3 normal)
{
    int in = is_same(normal, h->normal[k], 1.0f) || is_same(normal, h->normal[k], -1.0f);
    for (int i = 0; i < 3 && in; ++i) {
        const double d = above(h->normal[k], h->at[k], t->corner[i]);
        in = d <= (double)h->slack && d >= -(double)h->slack;
    }
    return in;
}

/* Sets reach, and slack by it. */
static void measure(lmb_hull *out, const lmb_scene *scene, uint32_t triangles)
{
    lmb_triangle t;
    lmb_vec3 normal;
    float largest = 0.0f;
    for (uint32_t id = 1; id <= triangles; ++id) {
        const int corners = take(&t, &normal, scene, id) ? 3 : 0;
        for (int c = 0; c < corners; ++c) {
            largest = maxf(largest, largest3(t.corner[c]));
        }
    }
    out->reach = largest * ROOM;
    out->slack = largest * LMB_BLOCKER_NOISE * 0.25f;
}

/* Every plane once. 0 where there are too many. */
static int find_planes(lmb_hull *out, const lmb_scene *scene, uint32_t triangles)
{
    lmb_triangle t;
    lmb_vec3 normal;
    for (uint32_t id = 1; id <= triangles; ++id) {
        int k = 0;
        if (!take(&t, &normal, scene, id)) {
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

/* Turn plane k's front to the scene; 0 where that lies on both its sides. */
static int turn_plane(lmb_hull *h, int k, const lmb_scene *scene, uint32_t triangles)
{
    lmb_triangle t;
    lmb_vec3 normal;
    double low = 0.0, high = 0.0;
    for (uint32_t id = 1; id <= triangles && (high <= (double)h->slack || low >= -(double)h->slack); ++id) {
        const int corners = take(&t, &normal, scene, id) ? 3 : 0;
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
    out->count = 0;
    measure(out, scene, triangles);
    is_convex = find_planes(out, scene, triangles);
    for (int k = 0; k < out->count && is_convex; ++k) {
        is_convex = turn_plane(out, k, scene, triangles);
    }
    out->count = is_convex ? out->count : 0;
}

int lmb_hull_holds(const lmb_hull *h, lmb_vec3 at)
{
    int in = h->count > 0 && largest3(at) <= h->reach;
    for (int k = 0; k < h->count && in; ++k) {
        in = above(h->normal[k], h->at[k], at) >= -(double)h->slack;
    }
    return in;
}

uint64_t lmb_hull_pixels(const lmb_hull *h, const lmb_tile *tile, uint64_t pixels)
{
    uint64_t out = 0;
    for (uint64_t bits = h->count > 0 ? pixels : 0; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        out |= (uint64_t)lmb_hull_holds(h, tile_vec(tile->position, k)) << k;
    }
    return out;
}

#endif
