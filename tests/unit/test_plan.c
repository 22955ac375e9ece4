/* test_plan.c: layer 8: work that a frame skips: the same bytes as with it, counted as skipped, and not skipped on a
 * near miss. */
#include <lambent/lambent.h>

#include "../world.h"

enum { FRAME = 32, MAP = 16, FACES = 14, ELEMENTS = 64, BVH = 96 };
#include "../bounce_frame.h"
#include "../live_frame.h"

void test_plan(void);

#if LMB_PLAN && LMB_TREES

static float whole[FRAME * FRAME * 3];
static lmb_light lights[2];

/* A closed room of 2 m around the origin. */
static void set_room(void)
{
    world_begin(0.7f, 0.6f, 0.5f);
    world_quad(vec3(0, -1, 0), Z, X);
    world_quad(vec3(0, 1, 0), X, Z);
    world_quad(vec3(0, 0, -1), X, Y);
    world_quad(vec3(0, 0, 1), Y, X);
    world_quad(vec3(-1, 0, 0), Y, Z);
    world_quad(vec3(1, 0, 0), Z, Y);
}

static lmb_frame frame_of(uint32_t light_count)
{
    const lmb_view v = look(vec3(0.1f, 0.2f, 0.9f), vec3(-0.1f, -0.2f, -1), 70, FRAME);
    world.scene.lights = lights;
    world.scene.light_count = light_count;
    CHECK(world_end() == LMB_OK);
    lmb_frame f = bounce_frame(&v, 1);
    f.error = f.visibility = 0.1f;
    return f;
}

/* Draws as planned into `render` and `picture`; returns 1 if run_all gives the same bytes. */
static int same_as_everything(const lmb_frame *frame)
{
    lmb_frame f = *frame;
    f.run_all = 1;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK && render.skips == 0 && render.reuses == 0);
    memcpy(whole, picture, sizeof whole);
    memset(picture, 0x5a, sizeof picture);
    CHECK(lmb_render_frame(&render, frame) == LMB_OK);
    return memcmp(whole, picture, sizeof whole) == 0;
}

static int planes_of(void)
{
    lmb_hull h;
    lmb_hull_find(&h, &world.scene);
    return h.count;
}

/* --- a convex room ------------------------------------------------------------------------------------------------ */

static void test_convex(void)
{
    lights[0] = spot(vec3(0.3f, 0.8f, 0.1f), vec3(-0.2f, -1, -0.1f), 25, 40);
    set_room();
    lmb_frame f = frame_of(1);
    CHECK(same_as_everything(&f) && planes_of() == 6 && render.frame.bvh.hull.count == 6);
    CHECK(render.skips == 0 && picture[0] > 0.0f);
    /* When rotated, the triangles' normals are rounded: each quad has two planes. */
    world.instance[0].to_world.m[0] = world.instance[0].to_world.m[10] = 0.8f;
    world.instance[0].to_world.m[2] = -0.6f;
    world.instance[0].to_world.m[8] = 0.6f;
    lmb_scene_bounds(&world.scene.bounds_min, &world.scene.bounds_max, &world.scene);
    CHECK(same_as_everything(&f));
    CHECK_MSG(planes_of() >= 6 && planes_of() <= 12, "%d", planes_of());
}

/* No traversal: the BVH may contain a wall right through the room. */
static void test_no_traversal(void)
{
    lmb_tile tile;
    memset(&tile, 0, sizeof tile);
    set_room();
    lmb_frame f = frame_of(1);
    CHECK(lmb_bvh_build(&f.bvh, &world.scene) == LMB_OK && f.bvh.hull.count == 6);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_plane(tile.position, k, vec3(-1, -0.9f + 0.02f * (float)k, 0.01f * (float)k));
    }
    CHECK(lmb_hull_pixels(&f.bvh.hull, &tile, ~UINT64_C(0)) == ~UINT64_C(0));
    CHECK(lmb_hull_pixels(&f.bvh.hull, &tile, UINT64_C(0x50)) == UINT64_C(0x50));
    CHECK(lmb_hull_holds(&f.bvh.hull, vec3(1, 1, 1)) && lmb_hull_holds(&f.bvh.hull, vec3(0, -1, 0)));
    /* Beyond a wall by more than rounding, for each axis. */
    CHECK(!lmb_hull_holds(&f.bvh.hull, vec3(1.00001f, 0, 0)));
    CHECK(!lmb_hull_holds(&f.bvh.hull, vec3(0, 0, -1.1f)));
    tile.position[1][5] = -1.00001f;
    CHECK(lmb_hull_pixels(&f.bvh.hull, &tile, ~UINT64_C(0)) == ~(UINT64_C(1) << 5));
}

/* Rooms that are nearly convex and empty. */
static void test_not_convex(void)
{
    set_room();
    world_box(vec3(0, 0, 0), 1e-3f);
    frame_of(1);
    CHECK(planes_of() == 0); /* a speck in the centre */
    set_room();
    world.corners[0][0][1] += 1e-4f;
    frame_of(1);
    CHECK(planes_of() == 0); /* a lifted corner of the floor: the other half continues below */
    set_room();
    world.corners[2][1][0] = 1.0001f;
    frame_of(1);
    CHECK(planes_of() == 0); /* the ceiling continues behind a wall */
    set_room();
    world_quad(vec3(0, -0.9999f, 0), mul3(Z, 0.1f), mul3(X, 0.1f));
    frame_of(1);
    CHECK(planes_of() == 0); /* a mat on the floor */
    world_begin(0.5f, 0.5f, 0.5f);
    world_sphere(vec3(0, 0, 0), 1.0f, 8, 8);
    frame_of(1);
    CHECK(planes_of() == 0); /* convex, with more planes than the capacity */
    world_begin(0.5f, 0.5f, 0.5f);
    frame_of(1);
    CHECK(planes_of() == 0);
}

/* --- lights ------------------------------------------------------------------------------------------------------- */

static uint32_t faces_drawn(int light)
{
    uint32_t n = 0;
    for (uint32_t bits = render.maps[light].drawn; bits != 0; bits >>= 1) {
        n += bits & 1u;
    }
    return n;
}

static void test_lights(void)
{
    set_room();
    lights[0] = point_light(vec3(0.2f, 0.4f, 0.3f));
    lights[1] = point_light(vec3(0, 0, 0));
    memset(lights[1].intensity, 0, sizeof lights[1].intensity);
    lmb_frame f = frame_of(LMB_MAX_LIGHTS > 1 ? 2 : 1);
    CHECK(same_as_everything(&f) && faces_drawn(0) == 6);
    CHECK(LMB_MAX_LIGHTS == 1 || (render.light_state[1] == LMB_LIGHT_DARK && faces_drawn(1) == 0));
    lights[1].intensity[2] = 1e-6f; /* a little is not zero */
    CHECK(same_as_everything(&f) && (LMB_MAX_LIGHTS == 1 || (render.light_state[1] == 0 && faces_drawn(1) == 6)));
}

/* A light above a floor and in front of a wall: some of the map's faces see neither. */
static void test_faces(void)
{
    world_begin(0.7f, 0.6f, 0.5f);
    world_quad(vec3(0, 0, 0), Z, X);
    world_quad(vec3(0, 0.5f, -1), X, mul3(Y, 0.5f));
    lights[0] = point_light(vec3(0, 3, 0));
    lmb_frame f = frame_of(1);
    CHECK(same_as_everything(&f) && render.maps[0].drawn == 1u << 3);
    lights[0].position.y = 2.1f; /* the wall is 1 m high at 1 m: the top is just below the pyramid's side */
    CHECK(same_as_everything(&f) && render.maps[0].drawn == 1u << 3);
    lights[0].position.y = 1.98f; /* and just inside */
    CHECK(same_as_everything(&f) && (render.maps[0].drawn >> 5 & 1u) == 1u);
    lights[0] = spot(vec3(0, 3, 0), vec3(0, 1, 0), 10, 30); /* away from everything */
    CHECK(same_as_everything(&f) && render.maps[0].drawn == 0 && render.skips == LMB_SKIP_BOUNCE);
    lights[0] = spot(vec3(0, 3, 0), vec3(1, -1, 0), 10, 40);
    CHECK(same_as_everything(&f) && render.maps[0].drawn == 1 && render.skips == 0);
}

/* --- materials ---------------------------------------------------------------------------------------------------- */

static void test_black(void)
{
    set_room();
    lights[0] = point_light(vec3(0.2f, 0.4f, 0.3f));
    lmb_frame f = frame_of(1);
    memset(world.material[0].albedo, 0, sizeof world.material[0].albedo);
    CHECK(same_as_everything(&f) && render.skips == LMB_SKIP_BOUNCE); /* the other material has no triangle */
    f.show = LMB_SHOW_IRRADIANCE;
    CHECK(same_as_everything(&f) && picture[0] == 0.0f);
    world.material[0].albedo[1] = 1e-3f;
    CHECK(same_as_everything(&f) && render.skips == 0 && picture[1] > 0.0f);
    world.material[0].albedo[1] = 0.0f;
    world.material[0].emission[0] = 1.0f;
    CHECK(same_as_everything(&f) && render.skips == 0 && render.emits == 1 && picture[0] > 0.0f);
}

static void test_unused(void)
{
    set_room();
    lights[0] = point_light(vec3(0.2f, 0.4f, 0.3f));
    lmb_frame f = frame_of(1);
    world.material[1].emission[0] = world.material[1].specular[0] = 1.0f;
    world.material[1].roughness = 0.5f;
    CHECK(same_as_everything(&f) && render.emits == 0 && render.is_glossy == 0);
    world.material[0].specular[1] = 0.01f;
    world.material[0].roughness = 0.5f;
    CHECK(same_as_everything(&f) && render.emits == 0 && render.is_glossy == 1);
}

/* --- any scene ---------------------------------------------------------------------------------------------------- */

static void random_scene(test_rng *rng)
{
    if (test_random(rng) % 3 == 0) {
        set_room();
    } else {
        world_begin(test_uniform(rng, 0, 1), 0.5f, 0.2f);
    }
    for (uint32_t n = test_random(rng) % 12; n > 0; --n) {
        const lmb_vec3 at = vec3(test_uniform(rng, -1, 1), test_uniform(rng, -1, 1), test_uniform(rng, -1, 0.5f));
        world_triangle(at, add3(at, vec3(test_uniform(rng, -1, 1), test_uniform(rng, -1, 1), 0.1f)),
                       add3(at, vec3(0.3f, test_uniform(rng, -1, 1), test_uniform(rng, -1, 1))));
    }
    for (int i = 0; i < 2; ++i) {
        const lmb_vec3 at = vec3(test_uniform(rng, -3, 3), test_uniform(rng, -3, 3), test_uniform(rng, -3, 3));
        lights[i] = test_random(rng) % 2 == 0 ? point_light(at) : spot(at, mul3(at, -1.0f), 10, 45);
        lights[i].intensity[0] *= (float)(test_random(rng) % 3);
        if (test_random(rng) % 4 == 0) {
            memset(lights[i].intensity, 0, sizeof lights[i].intensity);
        }
    }
}

/* Half of the frames are drawn by LMB_GATHER_LIVE. */
static void test_random_scenes(void)
{
    static const int32_t shows[] = {LMB_SHOW_FULL, LMB_SHOW_INDIRECT, LMB_SHOW_IRRADIANCE};
    test_rng rng = {11};
    int skipped = 0, faces = 0;
    for (int i = 0; i < 60; ++i) {
        random_scene(&rng);
        lmb_frame f = frame_of(LMB_MAX_LIGHTS > 1 ? 2 : 1);
        f.show = shows[i % 3];
        if (i % 2 != 0) {
            gather_live(&f);
        }
        f.bounces = 1 + i % 4 / 3;
        CHECK_MSG(same_as_everything(&f), "scene %d", i);
        skipped += render.skips != 0;
        faces += faces_drawn(0) < (uint32_t)render.maps[0].faces;
    }
    CHECK_MSG(skipped > 2 && faces > 5, "%d %d", skipped, faces);
}

#if LMB_LIVE
/* A sky of live light counts with its suns. */
static void test_sky_memory(void)
{
    static lmb_plan plan;
    lmb_live_sky sky;
    test_rng rng = {12};
    random_scene(&rng);
    lmb_frame f = frame_of(1);
    gather_live(&f);
    memset(&sky, 0, sizeof sky);
    sky.sun_cap = 9;
    CHECK(lmb_render_begin(&render, &f) == LMB_OK && lmb_plan_frame(&plan, &render, 0.0, 0.0) == LMB_OK);
    const uint64_t before = plan.row[LMB_PLAN_POINTS].bytes;
    render.frame.live_sky = &sky;
    CHECK(lmb_plan_frame(&plan, &render, 0.0, 0.0) == LMB_OK);
    CHECK(plan.row[LMB_PLAN_POINTS].bytes - before == lmb_live_sky_bytes(9) + sizeof sky);
}
#else
static void test_sky_memory(void) { }
#endif

void test_plan(void)
{
    test_sky_memory();
    test_convex();
    test_no_traversal();
    test_not_convex();
    test_lights();
    test_faces();
    test_black();
    test_unused();
    test_random_scenes();
}

#else

void test_plan(void) {}

#endif
