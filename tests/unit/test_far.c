/* test_far.c: large, small and distant worlds: rounding limits, the fine core of a scene, the faces of a sun's map. */
#include "../world.h"

#include <stdlib.h>

void test_far(void);

enum { MEMORY = 4 << 20 };
static uint8_t *memory;

static lmb_vec3 somewhere(test_rng *r, lmb_vec3 middle, lmb_vec3 half)
{
    return add3(middle, vec3(test_uniform(r, -half.x, half.x), test_uniform(r, -half.y, half.y),
                             test_uniform(r, -half.z, half.z)));
}

static lmb_bvh build(void)
{
    lmb_bvh b;
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_bvh_init(&b, world.count, memory, MEMORY) == LMB_OK);
    CHECK(lmb_bvh_build(&b, &world.scene) == LMB_OK);
    return b;
}

static uint64_t occluded(const lmb_bvh *b, const lmb_tile *tile, uint64_t pixels, lmb_vec3 at, float noise)
{
    lmb_traversal traversal;
    memset(&traversal, 0, sizeof traversal);
    return lmb_occluded_tile(picked_kernels(), &traversal, b, tile, pixels, at, noise);
}

/* --- convex rooms: hull.c's proof --------------------------------------------------------------------------------- */

/* A box with 2 x n x n triangles per side. */
static void put_box(lmb_vec3 middle, lmb_vec3 half, int n)
{
    const lmb_vec3 axis[3] = {vec3(half.x, 0, 0), vec3(0, half.y, 0), vec3(0, 0, half.z)};
    for (int side = 0; side < 6; ++side) {
        const lmb_vec3 u = mul3(axis[(side / 2 + 1) % 3], 1.0f / (float)n),
                       v = mul3(axis[(side / 2 + 2) % 3], 1.0f / (float)n),
                       out = mul3(axis[side / 2], side % 2 ? -1.0f : 1.0f);
        for (int i = 0; i < n * n; ++i) {
            const float x = (float)(2 * (i % n) + 1 - n), y = (float)(2 * (i / n) + 1 - n);
            world_quad(add3(add3(middle, out), add3(mul3(u, x), mul3(v, y))), u, v);
        }
    }
}

/* A point on a wall, off it by the largest rounding, or anywhere. */
static lmb_vec3 near_wall(test_rng *r, const lmb_hull *h, lmb_vec3 middle, lmb_vec3 half)
{
    lmb_vec3 p = somewhere(r, middle, half);
    const float off = test_uniform(r, -2.0f, 2.0f) * h->slack, side = test_random(r) & 1u ? 1.0f : -1.0f;
    switch (test_random(r) % 4u) {
    case 0: p.x = middle.x + side * (half.x + off); break;
    case 1: p.y = middle.y + side * (half.y + off); break;
    case 2: p.z = middle.z + side * (half.z + off); break;
    default: break;
    }
    return p;
}

/* Nothing blocks between points inside a hull, if there is no other noise, and points on the walls count as inside. */
static void test_hull(void)
{
    test_rng r = {81};
    int held = 0, wrong = 0, bare = 0;
    for (int round = 0; round < 40; ++round) {
        const lmb_vec3 far = mul3(vec3(test_uniform(&r, -1, 1), test_uniform(&r, -1, 1), test_uniform(&r, -1, 1)),
                                  round % 2 ? 10000.0f : 3.0f);
        const lmb_vec3 middle = vec3(floorf(far.x), floorf(far.y), floorf(far.z)),
                       half = vec3(0.25f * (float)(4 + test_random(&r) % 40u), 1.5f, 0.5f + 0.25f * (float)(round % 9));
        world_begin(1, 1, 1);
        put_box(middle, half, 1 << round % 4);
        lmb_bvh b = build();
        CHECK(b.hull.count == 6 && b.noise >= 4.0f * b.hull.slack);
        for (int i = 0; i < 50; ++i) {
            lmb_tile tile;
            memset(&tile, 0, sizeof tile);
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                set_plane(tile.position, k, near_wall(&r, &b.hull, middle, half));
            }
            const lmb_vec3 at = near_wall(&r, &b.hull, middle, half);
            const uint64_t in = lmb_hull_holds(&b.hull, at) ? lmb_hull_pixels(&b.hull, &tile, ~UINT64_C(0)) : 0;
            lmb_bvh without = b;
            without.noise = 0.0f;
            held += in != 0;
            wrong += in != 0 && occluded(&b, &tile, in, at, 0.0f) != 0;
            bare += in != 0 && occluded(&without, &tile, in, at, 0.0f) != 0;
        }
    }
    CHECK_MSG(wrong == 0 && held > 1000, "%d of %d blocked", wrong, held);
    CHECK_MSG(bare > 100, "%d of %d: without the room's noise this would prove nothing", bare, held);
}

/* --- noise -------------------------------------------------------------------------------------------------------- */

/* A board a hand's breadth above a floor, tested from close by: a triangle 100 km away must not make the board leak or
 * the traversal miss its box. */
static void test_stray_blocks_nothing(void)
{
    test_rng r = {82};
    int differ = 0, some = 0;
    for (int round = 0; round < 200; ++round) {
        uint64_t got[2];
        const lmb_vec3 at = vec3(test_uniform(&r, -1, 1), 0.11f, test_uniform(&r, -1, 1));
        lmb_tile tile;
        memset(&tile, 0, sizeof tile);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            set_plane(tile.position, k, vec3(test_uniform(&r, -1, 1), 0.09f, test_uniform(&r, -1, 1)));
        }
        for (int stray = 0; stray < 2; ++stray) {
            world_begin(1, 1, 1);
            world_quad(vec3(0, 0, 0), X, Z);
            world_quad(vec3(0, 0.1f, 0), mul3(X, 0.5f), mul3(Z, 0.5f));
            if (stray) {
                const lmb_vec3 far = vec3(60000, 30000, -70000);
                world_triangle(far, add3(far, vec3(1, 0, 0)), add3(far, vec3(0, 1, 0)));
            }
            lmb_bvh b = build();
            got[stray] = occluded(&b, &tile, ~UINT64_C(0), at, lmb_tile_noise(&tile, ~UINT64_C(0)));
        }
        differ += got[0] != got[1];
        some += got[0] != 0;
    }
    CHECK_MSG(differ == 0 && some > 100, "%d differ, %d block", differ, some);
}

static void test_noise(void)
{
    lmb_tile tile;
    memset(&tile, 0, sizeof tile);
    CHECK(lmb_place_noise(vec3(0, 0, 0), 0.0f) == 0.0f);
    CHECK(lmb_place_noise(vec3(-16, 3, 4), 0.0f) == ldexpf(1.0f, -18));
    CHECK(lmb_place_noise(vec3(0, 0, 0), 4.0f) == ldexpf(1.0f, -18));
    tile.position[0][9] = -16.0f;
    tile.depth[8] = -8.0f; /* in front of the eye of a sun's face */
    CHECK(lmb_tile_noise(&tile, UINT64_C(1) << 9) == ldexpf(1.0f, -18));
    CHECK(lmb_tile_noise(&tile, ~UINT64_C(0)) == ldexpf(1.0f, -17));
    CHECK(lmb_tile_noise(&tile, 0) == 0.0f);
}

/* --- the fine core of a scene ------------------------------------------------------------------------------------- */

static lmb_core core_of_world(void)
{
    lmb_core c;
    CHECK(world_end() == LMB_OK);
    lmb_scene_core(&c, &world.scene);
    world.scene.core = c;
    CHECK(lmb_scene_check(&world.scene) == LMB_OK);
    return c;
}

static int is_near(lmb_vec3 a, lmb_vec3 b) { return length3(sub3(a, b)) < 1e-6f * (length3(a) + length3(b)); }

static void put_room(lmb_vec3 at, float size)
{
    put_box(at, mul3(vec3(2, 1.5f, 2.5f), size), 4);
    put_box(add3(at, mul3(vec3(0.5f, -1, 0), size)), mul3(vec3(0.25f, 0.5f, 0.25f), size), 1);
}

/* Flat ground of n x n squares, `half` m to each side. */
static void put_ground(float half, int n)
{
    const float side = half / (float)n;
    for (int i = 0; i < n * n; ++i) {
        world_quad(vec3((float)(2 * (i % n) + 1 - n) * side, -1.51f, (float)(2 * (i / n) + 1 - n) * side),
                   vec3(side, 0, 0), vec3(0, 0, -side));
    }
}

static void test_rooms_have_none(void)
{
    world_begin(1, 1, 1);
    CHECK(core_of_world().faces == 0); /* no triangle */
    world_triangle(X, Y, Z);
    CHECK(core_of_world().faces == 0);
    put_room(vec3(0, 0, 0), 1.0f);
    CHECK(core_of_world().faces == 0);
    world_begin(1, 1, 1);
    put_room(vec3(0, 0, 0), 1.0f);
    world_sphere(vec3(-1, -1, 1), 0.125f, 24, 48); /* a fine object that a map of the room still resolves well */
    CHECK(core_of_world().faces == 0);
    world_begin(1, 1, 1);
    put_ground(500.0f, 40);
    CHECK(core_of_world().faces == 0);
}

/* Strays anywhere, also a bird of a hundred triangles: the room is the core, the scene the other face. */
static void test_strays(void)
{
    test_rng r = {83};
    for (int i = 0; i < 30; ++i) {
        const float far = i % 3 == 0 ? 60.0f : i % 3 == 1 ? 2000.0f : 1e5f;
        const lmb_vec3 at = mul3(normalize3(vec3(test_uniform(&r, -1, 1), test_uniform(&r, -1, 1), 0.3f)), far);
        world_begin(1, 1, 1);
        put_room(vec3(0, 0, 0), 1.0f);
        if (i % 2) {
            world_sphere(at, 0.05f, 6, 12);
        } else {
            world_triangle(at, add3(at, vec3(0.01f, 0, 0)), add3(at, vec3(0, 0.01f, 0)));
        }
        const lmb_core c = core_of_world();
        CHECK_MSG(c.faces == 2 && is_near(c.low, vec3(-2, -1.5f, -2.5f)) && is_near(c.high, vec3(2, 1.5f, 2.5f)),
                  "%g m: %d faces", (double)far, (int)c.faces);
        CHECK(is_near(c.wide_low, c.low) && is_near(c.wide_high, c.high));
    }
}

/* A house on a terrain, also with a stray; scaling by a power of two scales everything. */
static void test_house(void)
{
    for (int i = 0; i < 4; ++i) {
        const float size = i < 2 ? 1.0f : i < 3 ? 0.0009765625f : 64.0f;
        world_begin(1, 1, 1);
        put_ground(2000.0f * size, 40);
        put_room(vec3(0, 0, 0), size);
        if (i == 1) {
            world_triangle(vec3(90000, 0, 0), vec3(90000.1f, 0, 0), vec3(90000, 0.1f, 0));
        }
        const lmb_core c = core_of_world();
        CHECK_MSG(c.faces == (i == 1 ? 5 : 4), "%d: %d faces", i, (int)c.faces);
        CHECK(c.low.x == -2.0f * size && c.high.y == 1.5f * size && c.high.z == 2.5f * size);
        CHECK(is_near(c.wide_high, vec3(2000.0f * size, c.wide_high.y, 2000.0f * size)));
    }
}

static void test_bad_cores(void)
{
    world_begin(1, 1, 1);
    put_ground(2000.0f, 40);
    put_room(vec3(0, 0, 0), 1.0f);
    const lmb_core good = core_of_world();
    world.scene.core.faces = LMB_CORE_FACES + 1;
    CHECK(lmb_scene_check(&world.scene) == LMB_ERR_ARG);
    world.scene.core = good;
    world.scene.core.faces = -1;
    CHECK(lmb_scene_check(&world.scene) == LMB_ERR_ARG);
    world.scene.core = good;
    world.scene.core.low.y = good.high.y + 1.0f;
    CHECK(lmb_scene_check(&world.scene) == LMB_ERR_ARG);
    world.scene.core = good;
    world.scene.core.wide_high.z = NAN;
    CHECK(lmb_scene_check(&world.scene) == LMB_ERR_ARG);
    world.scene.core = good;
    CHECK(lmb_scene_check(&world.scene) == LMB_OK);
}

/* --- the faces of a sun's map ------------------------------------------------------------------------------------- */

static double area_of(const lmb_view *v) { return 4.0 * (double)v->half_width * (double)v->half_height; }

/* Each point of the sun's plane belongs to one face: a face's power excludes exactly the area of the finer face. Each
 * face is as deep as the scene, so that it contains all blockers. */
static void check_faces(const lmb_light *sun, int32_t size)
{
    lmb_shadow_map map;
    const size_t bytes = lmb_shadow_map_bytes(lmb_shadow_map_faces(sun, &world.scene), size, LMB_ID32);
    CHECK(lmb_shadow_map_faces(sun, &world.scene) == world.scene.core.faces);
    CHECK(lmb_shadow_map_init(&map, sun, &world.scene, size, LMB_ID32, memory, MEMORY) == LMB_OK && bytes <= MEMORY);
    for (int32_t f = 0; f < map.faces; ++f) {
        const double finer = f > 0 ? area_of(&map.view[f - 1]) : 0.0;
        double sum = 0.0;
        for (int32_t i = 0; i < size * size; ++i) {
            float power[3];
            lmb_light_texel_power(power, sun, &map, f, i % size, i / size);
            sum += (double)power[0] / (double)sun->intensity[0];
        }
        const double off = fabs(area_of(&map.view[f]) - finer - sum);
        CHECK_MSG(off <= 1e-3 * finer + 1e-5 * sum, "face %d: %g m2 too much or too little beside %g", (int)f, off,
                  finer);
    }
    for (int32_t f = 0; f < map.faces; ++f) {
        const lmb_view *v = &map.view[f];
        for (int corner = 0; corner < 8; ++corner) {
            const lmb_scene *s = &world.scene;
            const lmb_vec3 p = vec3(corner & 1 ? s->bounds_max.x : s->bounds_min.x,
                                    corner & 2 ? s->bounds_max.y : s->bounds_min.y,
                                    corner & 4 ? s->bounds_max.z : s->bounds_min.z);
            const float w = -dot3(v->back, sub3(p, v->eye));
            CHECK(w >= v->near_m && w <= v->far_m);
        }
        CHECK(f == 0 || map.view[f - 1].half_width < v->half_width);
    }
}

static void test_faces(void)
{
    test_rng r = {84};
    world_begin(1, 1, 1);
    put_ground(2000.0f, 40);
    put_room(vec3(0, 0, 0), 1.0f);
    CHECK(core_of_world().faces == 4);
    for (int i = 0; i < 12; ++i) {
        const lmb_vec3 along = vec3(test_uniform(&r, -1, 1), test_uniform(&r, -1, -0.1f), test_uniform(&r, -1, 1));
        const lmb_light sun = make_light(LMB_LIGHT_DIRECTIONAL, vec3(0, 0, 0), along);
        check_faces(&sun, 256);
    }
}

/* A box with any dimensions along any axes, one piece per side. */
static void put_turned_room(test_rng *r)
{
    const lmb_vec3 a = normalize3(somewhere(r, X, vec3(0.9f, 0.9f, 0.9f))),
                   b = normalize3(cross3(a, somewhere(r, Y, a)));
    const lmb_vec3 axis[3] = {mul3(a, 3.0f), mul3(b, 1.5f), mul3(cross3(a, b), 2.0f)};
    for (int i = 0; i < 6; ++i) {
        const lmb_vec3 out = mul3(axis[i / 2], i & 1 ? -1.0f : 1.0f);
        world_quad(add3(vec3(4, 1, -2), out), axis[(i / 2 + 1) % 3], axis[(i / 2 + 2) % 3]);
    }
}

/* Extent of points along a map's right, up and back axes; all must lie in the map. */
typedef struct reach {
    lmb_vec3 low, high;
} reach;

static void take_place(reach *inout, const lmb_view *v, lmb_vec3 p)
{
    const lmb_vec3 to = sub3(p, v->eye), at = vec3(dot3(v->right, to), dot3(v->up, to), dot3(v->back, to));
    CHECK(absf(at.x) < v->half_width && absf(at.y) < v->half_height && -at.z > v->near_m && -at.z < v->far_m);
    inout->low = min3(inout->low, at);
    inout->high = max3(inout->high, at);
}

/* A map with one face is as wide as the geometry, however the world is rotated, and covers wider bounds if they are
 * given. */
static void test_turned_rooms(void)
{
    test_rng r = {85};
    double worst = 0.0;
    for (int i = 0; i < 40; ++i) {
        reach all = {{1e9f, 1e9f, 1e9f}, {-1e9f, -1e9f, -1e9f}};
        lmb_shadow_map map;
        world_begin(1, 1, 1);
        put_turned_room(&r);
        CHECK(core_of_world().faces == 0);
        const lmb_light sun = make_light(LMB_LIGHT_DIRECTIONAL, vec3(0, 0, 0), somewhere(&r, vec3(0, -1, 0), X));
        CHECK(lmb_shadow_map_init(&map, &sun, &world.scene, 64, LMB_ID32, memory, MEMORY) == LMB_OK && map.faces == 1);
        const lmb_view *v = &map.view[0];
        for (uint32_t k = 0; k < 3 * world.count; ++k) {
            const float *p = world.corners[k / 3][k % 3];
            take_place(&all, v, vec3(p[0], p[1], p[2]));
        }
        const lmb_vec3 size = sub3(all.high, all.low);
        worst = fmax(worst, fmax(2.0 * (double)v->half_width / (double)size.x,
                                 2.0 * (double)v->half_height / (double)size.y));
        worst = fmax(worst, (double)(v->far_m - v->near_m) / (double)size.z);
        world.scene.bounds_max = add3(world.scene.bounds_max, vec3(1, 2, 3));
        CHECK(lmb_shadow_map_init(&map, &sun, &world.scene, 64, LMB_ID32, memory, MEMORY) == LMB_OK);
        for (int k = 0; k < 8; ++k) {
            const lmb_vec3 low = world.scene.bounds_min, high = world.scene.bounds_max;
            take_place(&all, v, vec3(k & 1 ? low.x : high.x, k & 2 ? low.y : high.y, k & 4 ? low.z : high.z));
        }
    }
    CHECK_MSG(worst < 1.01, "%g times as wide as the room", worst);
}

/* --- later bounces ------------------------------------------------------------------------------------------------ */

/* Number of distinct positions of a scene's elements on the sorting curve. */
static int places_of_elements(void)
{
    lmb_elements e;
    int places = 0;
    CHECK(lmb_elements_init(&e, 4096, memory, MEMORY) == LMB_OK);
    CHECK(lmb_elements_build(&e, &world.scene, NULL) == LMB_OK);
    for (uint32_t i = 1; i < e.count; ++i) {
        places += e.data[i].key != e.data[i - 1].key;
    }
    return places;
}

/* A stray must not put a whole room into one cell: the elements would have no order, and the tree no nodes. */
static void test_stray_elements(void)
{
    world_begin(1, 1, 1);
    put_room(vec3(0, 0, 0), 1.0f);
    core_of_world();
    const int without = places_of_elements();
    world_triangle(vec3(0, 2000, 0), vec3(0.01f, 2000, 0), vec3(0, 2000, 0.01f));
    core_of_world();
    const int with = places_of_elements();
    CHECK_MSG(with > without - without / 20 && without > 1000, "%d places, %d without it", with, without);
}

void test_far(void)
{
    memory = malloc(MEMORY);
    if (memory == NULL) {
        SKIP("no memory");
        return;
    }
    test_hull();
    test_stray_blocks_nothing();
    test_noise();
    test_rooms_have_none();
    test_strays();
    test_house();
    test_bad_cores();
    test_faces();
    test_turned_rooms();
    test_stray_elements();
    free(memory);
}
