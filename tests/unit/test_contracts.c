/* test_contracts.c: refused arguments, failed frames, guaranteed termination: each promise of the headers. */
#include <lambent/lambent.h>

#include <string.h>

#include "../../tools/demo/demo_scene.h"
#include "../test.h"

enum { W = 64, H = 48, MAP = 64, SIDE = MAP / 8, ENOUGH = 600 };

void test_contracts(void);

static uint32_t map_memory[MAP * MAP * 2];
static float depth_memory[W * H], out_memory[W * H * 3], twice_memory[W * H * 3];
static uint32_t id_memory[W * H];
static lmb_groups groups;
static lmb_band_scratch scratch;
static lmb_render render;
LMB_POINTS_ARRAY(points, ENOUGH, SIDE);

static lmb_frame demo_frame(const lmb_scene *scene)
{
    lmb_frame f;
    memset(&f, 0, sizeof f);
    f.kernels = picked_kernels();
    f.scene = scene;
    f.view = demo_view(W, H);
    f.show = LMB_SHOW_INDIRECT;
    f.shadow_map = MAP;
    f.grouping.groups = 40;
    f.occlusion = LMB_OCCLUSION_VIEW;
    f.map_memory = map_memory;
    f.map_bytes = sizeof map_memory;
    f.points = points;
    f.groups = &groups;
    f.scratch = &scratch;
    lmb_surface_init(&f.eye.depth, LMB_DEPTH32F, W, H, depth_memory, sizeof depth_memory);
    lmb_surface_init(&f.eye.id, LMB_ID32, W, H, id_memory, sizeof id_memory);
    lmb_surface_init(&f.out, LMB_RGB32F, W, H, out_memory, sizeof out_memory);
    return f;
}

/* A failed frame stays failed and draws no band. */
static void test_failed_frame(void)
{
    lmb_frame f = demo_frame(demo_scene());
    lmb_status status;
    f.points.cap = 3;
    memset(&groups, 0x7f, sizeof groups);
    CHECK(lmb_render_begin(&render, &f) == LMB_OK);
    while ((status = lmb_render_step(&render, 100)) == LMB_MORE) {
    }
    CHECK(status == LMB_ERR_CAPACITY);
    CHECK(lmb_render_step(&render, 100) == LMB_ERR_CAPACITY);
    CHECK(lmb_render_band(&render, &scratch, &f.eye, &f.out, 0) == LMB_ERR_CAPACITY);
    f = demo_frame(demo_scene());
    f.map_bytes = 16;
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_CAPACITY);
    CHECK(lmb_render_step(&render, 1) == LMB_ERR_CAPACITY);
}

/* lmb_render_begin refuses errors that a stage would otherwise meet later. */
static void test_begin_refuses(void)
{
    lmb_frame good = demo_frame(demo_scene()), f;
    CHECK(lmb_render_begin(&render, &good) == LMB_OK);
    f = good;
    f.view.half_width = -1.0f;
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_ARG);
    f = good;
    f.view.back.x += 2.0f;
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_ARG);
    f = good;
    f.out.layout = LMB_TILED;
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_FORMAT);
    f = good;
    f.out.stride_bytes = W * 12 + 2;
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_ARG);
    f = good;
    f.eye.depth.stride_bytes = 3;
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_ARG);
    f = good;
    f.eye.id.data = NULL;
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_ARG);
    f = good;
    f.points.data = NULL; /* direct light only: allowed */
    CHECK(lmb_render_begin(&render, &f) == LMB_OK);
}

static void test_raster_refuses(void)
{
    lmb_frame f = demo_frame(demo_scene());
    lmb_target t = f.eye;
    lmb_surface_clear(&t.depth);
    lmb_surface_clear(&t.id);
    CHECK(lmb_draw(&t, f.kernels, &f.view, f.scene, 0, 5, 0, NULL) == LMB_ERR_ARG);
    CHECK(lmb_resolve_tile(&scratch.tile, f.kernels, &f.view, f.scene, &t, 0, 0) == LMB_OK);
    memset(&t.depth, 0, sizeof t.depth);
    CHECK(lmb_resolve_tile(&scratch.tile, f.kernels, &f.view, f.scene, &t, 0, 0) == LMB_ERR_ARG);
    t = f.eye;
    t.id.stride_bytes += 1;
    CHECK(lmb_draw(&t, f.kernels, &f.view, f.scene, 1, 5, 0, NULL) == LMB_ERR_ARG);
    CHECK(lmb_shadow_map_bytes(1, 64, 99) == 0 && lmb_shadow_map_bytes(1, 60, LMB_ID16) == 0 &&
          lmb_shadow_map_bytes(7, 64, LMB_ID16) == 0 && lmb_shadow_map_bytes(6, 64, LMB_ID16) == 6 * 64 * 64 * 6);
    CHECK(lmb_points_bytes(100, 8) == 100 * sizeof(lmb_point) + 65 * 4 && lmb_points_bytes(1, LMB_MAX_SIDE + 1) == 0);
    if (sizeof(size_t) == 4) {
        CHECK(lmb_points_bytes(48806447u, 8) == 0);
    }
}

/* Exactly opposed normals may have a cosine below -1: grouping into one group must still terminate. */
static void test_grouping_ends(void)
{
    test_rng r = {5};
    for (int n = 0; n < 400; ++n) {
        lmb_grouping g = {LMB_GROUP_ZONES, 8, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
        lmb_vec3 a = {test_uniform(&r, -1, 1), test_uniform(&r, -1, 1), test_uniform(&r, -1, 1)};
        float length = test_uniform(&r, 0.9999f, 1.0001f), d = a.x * a.x + a.y * a.y + a.z * a.z, s = 1.0f;
        for (int i = 0; i < 20; ++i) {
            s = 0.5f * (s + d / s);
        }
        g.method = n & 1 ? LMB_GROUP_GREEDY : LMB_GROUP_ZONES;
        points.count = 2;
        points.faces = 2;
        memset(points.data, 0, 2 * sizeof *points.data);
        for (int i = 0; i < 2; ++i) {
            lmb_point *p = &points.data[i];
            float sign = i ? -length / s : length / s;
            p->normal = (lmb_vec3){a.x * sign, a.y * sign, a.z * sign};
            p->position = (lmb_vec3){100.0f * p->normal.x, 100.0f * p->normal.y, 100.0f * p->normal.z};
            p->flux[0] = 1.0f;
            p->axis_u.x = p->axis_v.y = 0.01f;
            p->face = (uint32_t)i + 1;
        }
        lmb_status status = lmb_group_points(&groups, &points, &g, NULL);
        CHECK(status == LMB_OK && groups.count == 1 && groups.members[0] == 2 && groups.flux[0][0] == 2.0f);
    }
}

/* A point in the plane of a near quad, lifted by rounding, sees the quad edge-on: no light, no bright specks. A point
 * really above the quad sees it fill half the sky. */
static void test_flat_quads(void)
{
    const lmb_vec3 up = {0, 1, 0}, u = {0.01f, 0, 0}, v = {0, 0, 0.01f}, centre = {3, 1, -2};
    const lmb_vec3 tilted = {0.0998334f, 0.9950042f, 0}; /* 0.1 rad off the quad: the next facet of a curve */
    for (int i = -3; i <= 3; ++i) {
        lmb_vec3 at = {3.002f, 1.0f + (float)i * 1e-6f, -2.003f};
        CHECK(lmb_quad_factor(at, up, up, centre, up, u, v) == 0.0f);
        CHECK(lmb_quad_factor(at, up, up, centre, up, v, u) == 0.0f);
        /* Above the plane by rounding, below a face with a horizon that dips under the plane: the whole quad would
         * count. */
        CHECK(lmb_quad_factor(at, tilted, tilted, centre, up, u, v) == 0.0f);
        CHECK(lmb_quad_factor(at, tilted, tilted, centre, up, v, u) == 0.0f);
    }
    lmb_vec3 over = {3, 1.001f, -2}, down = {0, -1, 0};
    float full = lmb_quad_factor(over, down, down, centre, up, u, v) * 4.0f * 1e-4f;
    CHECK_MSG(full > 0.95f && full <= 1.0f, "%g", (double)full);
    /* On an edge of the quad and of the room: the light does not stop within rounding of the quad's plane. */
    const lmb_vec3 wall = {1, 0, 0}, beyond = {-1, 0, 0}, corner[4] = {{2.99f, 1, -2.01f}, {2.99f, 1, -1.99f}, {3.01f, 1, -1.99f},
                                                                     {3.01f, 1, -2.01f}};
    const lmb_vec3 high = {2.99f, 1.0f + 3e-5f, -2.001f};
    const float want = lmb_quad_factor(high, wall, wall, centre, up, u, v) * 4.0f * 1e-4f;
    CHECK_MSG(want > 0.4f && want < 0.5f, "%g", (double)want);
    for (int i = 1; i <= 3; ++i) {
        const lmb_vec3 at = {2.99f, 1.0f + (float)i * 1e-6f, -2.001f};
        const float near[3] = {lmb_quad_factor(at, wall, wall, centre, up, u, v) * 4.0f * 1e-4f,
                               lmb_polygon_factor(at, wall, wall, corner, 4, up),
                               lmb_triangle_factor(at, wall, wall, corner, up) * 2.0f * 1e-4f};
        CHECK_MSG(near[0] > 0.97f * want && near[0] < 1.03f * want, "%g", (double)near[0]);
        CHECK_MSG(near[1] > 0.97f * want && near[1] < 1.03f * want, "%g", (double)near[1]);
        CHECK_MSG(near[2] > 0.3f * want && near[2] < 1.03f * want, "%g", (double)near[2]);
        CHECK(lmb_quad_factor(at, beyond, beyond, centre, up, u, v) == 0.0f); /* a convex edge */
    }
}

/* Doubling the light doubles every gathered pixel, however dim it is, also between black walls. */
static void test_doubling(float watts, int method)
{
    lmb_scene scene = *demo_scene();
    lmb_light light = scene.lights[0];
    lmb_material black[16];
    int wrong = 0;
    double sum = 0.0;
    memcpy(black, scene.materials, scene.material_count * sizeof *black);
    memset(black[1].albedo, 0, sizeof black[1].albedo);
    scene.materials = black;
    scene.lights = &light;
    for (int twice = 0; twice < 2; ++twice) {
        for (int c = 0; c < 3; ++c) {
            light.intensity[c] = watts * (float)(3 - c) * (twice ? 2.0f : 1.0f);
        }
        lmb_frame f = demo_frame(&scene);
        f.grouping.method = method;
        f.grouping.groups = 8;
        lmb_surface_init(&f.out, LMB_RGB32F, W, H, twice ? twice_memory : out_memory, sizeof out_memory);
        CHECK(lmb_render_frame(&render, &f) == LMB_OK);
    }
    for (int i = 0; i < W * H * 3; ++i) {
        wrong += twice_memory[i] != 2.0f * out_memory[i];
        sum += (double)out_memory[i];
    }
    CHECK_MSG(wrong == 0 && sum > 0.0, "%g W/sr, method %d: %d values are not doubled", (double)watts, method, wrong);
}

void test_contracts(void)
{
    test_failed_frame();
    test_begin_refuses();
    test_raster_refuses();
    test_grouping_ends();
    test_flat_quads();
    for (int method = LMB_GROUP_ZONES; method <= LMB_GROUP_GREEDY; ++method) {
        test_doubling(1000.0f, method);
        test_doubling(1.0f, method);
        test_doubling(1e-12f, method);
        test_doubling(1e-14f, method); /* dimmer light puts texels at the cone's edge below the limit of 2^-80 W */
    }
}
