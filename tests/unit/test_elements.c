/* test_elements.c: a scene as elements: the whole area in any capacity; the same light in any steps, parts and on any
 * machine; refused input. */
enum { ELEMENTS = 1024, MAP = 32, FRAME = 24, FACES = 1, BVH = 64 };

#include "../bounce_frame.h"

void test_elements(void);

static double area_of(uint32_t i)
{
    float(*c)[3] = world.corners[i];
    double u[3], v[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = (double)c[1][k] - (double)c[0][k];
        v[k] = (double)c[2][k] - (double)c[0][k];
    }
    return 0.5 * sqrt(pow(u[1] * v[2] - u[2] * v[1], 2) + pow(u[2] * v[0] - u[0] * v[2], 2) +
                      pow(u[0] * v[1] - u[1] * v[0], 2));
}

static double world_area(uint32_t from, uint32_t to)
{
    double area = 0.0;
    for (uint32_t i = from; i < to; ++i) {
        area += area_of(i);
    }
    return area;
}

static double element_area(const lmb_elements *e)
{
    double area = 0.0;
    for (uint32_t i = 0; i < e->count; ++i) {
        area += (double)e->data[i].area;
    }
    return area;
}

static lmb_elements build(uint32_t n)
{
    lmb_elements e;
    memset(&e, 0, sizeof e);
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_elements_init(&e, n, element_memory, sizeof element_memory) == LMB_OK);
    CHECK(lmb_elements_build(&e, &world.scene, NULL) == LMB_OK);
    return e;
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

static void test_memory(void)
{
    lmb_elements e;
    static const uint32_t bad[] = {0, 1, 16, 63, 65, 128, 1 << 25, 1 << 26, 0xffffffffu};
    for (int i = 0; i < COUNT(bad); ++i) {
        CHECK_MSG(lmb_elements_bytes(bad[i]) == 0, "%u", (unsigned)bad[i]);
        CHECK(lmb_elements_init(&e, bad[i], element_memory, sizeof element_memory) == LMB_ERR_ARG);
    }
    const size_t bytes = lmb_elements_bytes(64);
    CHECK(bytes >= 64 * 164 && bytes <= 64 * 176 + sizeof(lmb_target));
    CHECK(lmb_elements_init(NULL, 64, element_memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_elements_init(&e, 64, NULL, bytes) == LMB_ERR_ARG);
    CHECK(lmb_elements_init(&e, 64, (uint8_t *)element_memory + 2, bytes) == LMB_ERR_ALIGN);
    CHECK(lmb_elements_init(&e, 64, element_memory, bytes - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_elements_init(&e, 64, element_memory, bytes) == LMB_OK && e.cap == 64 && e.count == 0);
    CHECK(lmb_elements_tiles(&e) == 0 && lmb_elements_tiles(NULL) == 0);
    CHECK(lmb_elements_build(&e, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_elements_build(NULL, &world.scene, NULL) == LMB_ERR_ARG);
    CHECK(lmb_elements_send(&e, 0) == LMB_ERR_ARG); /* not built */
}

/* --- area --------------------------------------------------------------------------------------------------------- */

static lmb_vec3 random_point(test_rng *r, float half)
{
    const float x = test_uniform(r, -half, half), y = test_uniform(r, -half, half);
    return vec3(x, y, test_uniform(r, -half, half));
}

/* Large, small and thin triangles that intersect. */
static void make_soup(uint32_t count, float span)
{
    test_rng r = {5};
    world_begin(0.5f, 0.5f, 0.5f);
    for (uint32_t i = 0; i < count; ++i) {
        const float size = span * (i % 7 == 0 ? 1.0f : 0.02f);
        const lmb_vec3 at = random_point(&r, span);
        lmb_vec3 p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = add3(at, random_point(&r, size));
        }
        p[2] = i % 11 == 0 ? add3(p[0], mul3(sub3(p[1], p[0]), 0.499f)) : p[2];
        world_triangle(p[0], p[1], p[2]);
    }
}

static void check_area(const char *name, uint32_t n, double want)
{
    lmb_elements e = build(n);
    const double got = element_area(&e);
    int sorted = 1;
    CHECK_MSG(e.count <= n && fabs(got / want - 1.0) < 1e-4, "%s, %u: %u elements of %g for %g", name, (unsigned)n,
              (unsigned)e.count, got, want);
    for (uint32_t i = 1; i < e.count; ++i) {
        sorted &= e.data[i - 1].key <= e.data[i].key;
    }
    CHECK(sorted);
    for (uint32_t i = 0; i < e.count; ++i) {
        for (int k = 0; k < 3; ++k) {
            const lmb_vec3 d = sub3(e.data[i].corner[(k + 1) % 3], e.data[i].corner[k]);
            CHECK_MSG(length3(d) <= e.side * 1.0001f, "edge %g over %g", (double)length3(d), (double)e.side);
        }
    }
}

/* A box of 4 m on a ground of 40 m, of two triangles or of 800: elements on the box are small, those of the ground grow
 * with the distance. */
static void test_core(void)
{
    for (int small = 0; small < 2; ++small) {
        float on_box = 0.0f, far_off = 0.0f;
        lmb_elements e;
        world_begin(0.5f, 0.5f, 0.5f);
        world_box(vec3(0, 2, 0), 2.0f);
        for (int i = 0; i < (small ? 400 : 1); ++i) {
            const lmb_vec3 at = vec3(2.0f * (float)(i % 20) - 19.0f, 0, 2.0f * (float)(i / 20) - 19.0f);
            world_quad(small ? at : vec3(0, 0, 0), mul3(Z, small ? 1.0f : 20.0f), mul3(X, small ? 1.0f : 20.0f));
        }
        CHECK(world_end() == LMB_OK);
        world.scene.core.low = world.scene.core.wide_low = vec3(-2, 0, -2);
        world.scene.core.high = world.scene.core.wide_high = vec3(2, 4, 2);
        world.scene.core.faces = 2;
        memset(&e, 0, sizeof e);
        CHECK(lmb_elements_init(&e, ELEMENTS, element_memory, sizeof element_memory) == LMB_OK);
        CHECK(lmb_elements_build(&e, &world.scene, NULL) == LMB_OK);
        for (uint32_t i = 0; i < e.count; ++i) {
            const lmb_element *own = &e.data[i];
            if (own->id <= 12) {
                on_box = maxf(on_box, own->area);
            } else if (fabsf(own->corner[0].x) > 15.0f) {
                far_off = maxf(far_off, own->area);
            }
        }
        CHECK_MSG(on_box < 1.5f && far_off > 4.0f * on_box, "%d: areas of %g and %g m2, side %g", small,
                  (double)on_box, (double)far_off, (double)e.side);
        const double want = 2.0 * world_area(0, world.count);
        CHECK_MSG(fabs(element_area(&e) / want - 1.0) < 1e-4, "%g for %g m2", element_area(&e), want);
        memset(&world.scene.core, 0, sizeof world.scene.core);
    }
}

/* Triangles of six sides at 16 doublings of the distance from a small core, and the fewest elements: the side stays
 * finite, because cells that grow with the distance have few sizes. */
static void test_far(void)
{
    lmb_elements e;
    world_begin(0.5f, 0.5f, 0.5f);
    for (int i = 0; i < 16; ++i) {
        world_box(vec3(i == 0 ? 0.0f : 0.75f + ldexpf(0.65f, i), 0, 0), 0.2f);
    }
    CHECK(world_end() == LMB_OK);
    world.scene.core.low = vec3(-0.5f, -0.5f, -0.5f);
    world.scene.core.high = vec3(0.5f, 0.5f, 0.5f);
    world.scene.core.wide_low = world.scene.bounds_min;
    world.scene.core.wide_high = world.scene.bounds_max;
    world.scene.core.faces = 2;
    memset(&e, 0, sizeof e);
    CHECK(lmb_elements_init(&e, 64, element_memory, sizeof element_memory) == LMB_OK);
    CHECK(lmb_elements_build(&e, &world.scene, NULL) == LMB_OK);
    CHECK_MSG(e.side < 1e6f && e.count > 16, "%u elements, side %g", (unsigned)e.count, (double)e.side);
    memset(&world.scene.core, 0, sizeof world.scene.core);
}

static void test_area(void)
{
    static const uint32_t counts[] = {64, 256, ELEMENTS};
    for (int i = 0; i < COUNT(counts); ++i) {
        make_soup(700, 3.0f);
        check_area("soup", counts[i], 2.0 * world_area(0, 700));
        make_soup(700, 300000.0f);
        check_area("huge soup", counts[i], 2.0 * world_area(0, 700));
        world_begin(0.5f, 0.5f, 0.5f);
        world_sphere(vec3(100, 0, 0), 0.001f, 48, 90); /* 8460 triangles for 64 elements */
        check_area("sphere", counts[i], 2.0 * world_area(0, world.count));
        world_begin(0.5f, 0.5f, 0.5f);
        world_box(vec3(0, 0, 0), 1.0f);
        check_area("box", counts[i], 48.0);
    }
    CHECK_MSG(build(ELEMENTS).count > ELEMENTS / 3, "capacity is used");
}

/* Divided as finely as the box, 1000 km would give two million pieces, each with an area too small for binary32. */
static void test_sliver(void)
{
    world_begin(0.5f, 0.5f, 0.5f);
    world_box(vec3(0, 0, 0), 1.0f);
    world_triangle(vec3(0, 0, 0), vec3(1e6f, 0, 0), vec3(0, 1e-23f, 0));
    check_area("sliver", 64, 48.0);
    const lmb_elements e = build(64);
    CHECK_MSG(e.side > 1e6f / (64 * 64), "%g m", (double)e.side);
}

/* Triangles that lmb_draw drops, and those without area, are left out; an empty scene is dark. */
static void test_dropped(void)
{
    world_begin(0.5f, 0.5f, 0.5f);
    world_triangle(vec3(0, 0, 0), vec3(NAN, 0, 0), vec3(0, 1, 0));
    world_triangle(vec3(0, 0, 0), vec3(2e6f, 0, 0), vec3(0, 1, 0));
    world_triangle(vec3(1, 2, 3), vec3(1, 2, 3), vec3(0, 1, 0));
    lmb_elements e = build(64);
    CHECK(e.count == 0 && e.level == 0.0f && lmb_elements_tiles(&e) == 0 && lmb_elements_send(&e, 1) == LMB_OK);
}

/* --- sides, holes, colours ---------------------------------------------------------------------------------------- */

static double lit_above(const lmb_elements *e, float y)
{
    double area = 0.0;
    for (uint32_t i = 0; i < e->count; ++i) {
        area += e->data[i].key >> 27 == (y > 0.0f ? 2u : 3u) ? (double)e->data[i].area : 0.0;
    }
    return area;
}

static void test_sides(void)
{
    world_begin(0.5f, 0.5f, 0.5f);
    world.material[0].flags = 0;
    world.material[0].emission[1] = 2.0f;
    world_quad(vec3(0, 0, 0), Z, X); /* front: up */
    lmb_elements e = build(256);
    CHECK(fabs(lit_above(&e, 1) - 4.0) < 1e-5 && lit_above(&e, -1) == 0.0);
    double flux = 0.0;
    for (uint32_t i = 0; i < e.cap; ++i) {
        flux += (double)e.tree.texel[i].flux[1];
    }
    CHECK_MSG(fabs(flux / (PI * 2.0 * 4.0) - 1.0) < 1e-5, "%g W", flux);
    CHECK_MSG(fabs((double)e.level - PI * 2.0) < 1e-4, "%g W/m2", (double)e.level);
    world.instance[0].to_world.m[0] = -1.0f; /* mirroring keeps the front side */
    CHECK(lmb_elements_build(&e, &world.scene, NULL) == LMB_OK);
    CHECK(fabs(lit_above(&e, 1) - 4.0) < 1e-5 && lit_above(&e, -1) == 0.0);
    world.instance[0].to_world.m[0] = 1.0f;
    world.material[0].flags = LMB_DOUBLE_SIDED;
    CHECK(lmb_elements_build(&e, &world.scene, NULL) == LMB_OK);
    CHECK(fabs(lit_above(&e, 1) - 4.0) < 1e-5 && fabs(lit_above(&e, -1) - 4.0) < 1e-5);
}

/* Left half white and opaque, right half black and transparent. */
static void test_texture(void)
{
    static uint32_t texels[64];
    for (int i = 0; i < 64; ++i) {
        const uint8_t code[4] = {i % 8 < 4 ? 255 : 0, 255, 255, i % 8 < 4 ? 255 : 0};
        memcpy(&texels[i], code, 4);
    }
    world_begin(0.5f, 0.5f, 0.5f);
    world.texture.texels = (const uint8_t *)texels;
    world.texture.width = world.texture.height = 8;
    world.texture.levels = 1;
    world.material[0].texture = 0;
    world_quad(vec3(0, 0, 0), Z, X);
    lmb_elements e = build(ELEMENTS);
    double red = 0.0;
    for (uint32_t i = 0; i < e.count; ++i) {
        red += (double)(e.data[i].albedo[0] * e.data[i].area);
    }
    CHECK_MSG(fabs(red - 0.5 * 4.0) < 0.02, "%g", red);
    world.material[0].flags |= LMB_ALPHA_MASK;
    world.material[0].alpha_cutoff = 0.5f;
    CHECK(lmb_elements_build(&e, &world.scene, NULL) == LMB_OK);
    CHECK_MSG(fabs(element_area(&e) - 4.0) < 0.02, "%g", element_area(&e));
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

static float first_picture[FRAME * FRAME * 3];

static lmb_frame make_frame(int32_t bounces)
{
    const lmb_view view = look(vec3(0.2f, 0.3f, 0.9f), vec3(-0.1f, -0.2f, 0), 75, FRAME);
    return bounce_frame(&view, bounces);
}

static void make_room(int emits)
{
    static lmb_light light;
    light = spot(vec3(0.2f, 0.8f, 0.1f), vec3(0, -1, 0), 20, 40);
    world_begin(0.7f, 0.6f, 0.5f);
    world_box(vec3(0, 0, 0), 1.0f);
    world_box(vec3(0.3f, -0.7f, -0.2f), 0.25f);
    world_part();
    world_quad(vec3(-0.5f, 0.9f, 0), vec3(0.2f, 0, 0), vec3(0, 0, 0.2f));
    world.material[1].emission[2] = emits ? 3.0f : 0.0f;
    world.scene.lights = &light;
    world.scene.light_count = 1;
    CHECK(world_end() == LMB_OK);
}

static void check_same(const char *how)
{
    CHECK_MSG(memcmp(picture, first_picture, sizeof picture) == 0, "%s: another picture", how);
}

static void render_parts(lmb_frame *f, int32_t parts)
{
    lmb_status status = lmb_render_begin(&render, f);
    while (status >= 0 && render.stage < LMB_STAGE_BANDS) {
        if (lmb_render_has_parts(&render)) {
            for (int32_t i = parts - 1; i >= 0; --i) {
                CHECK(lmb_render_part(&render, &scratch, i, parts, NULL) == LMB_OK);
            }
            status = lmb_render_parts_done(&render, parts);
        } else {
            status = lmb_render_step(&render, 3);
        }
    }
    while (status == LMB_MORE) {
        status = lmb_render_step(&render, 1);
    }
    CHECK(status == LMB_OK);
}

/* In one go, in small steps, in parts, on every backend, and as another view of the solved light. */
static void test_ways(void)
{
    lmb_frame f;
    make_room(1);
    f = make_frame(3);
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
    memcpy(first_picture, picture, sizeof picture);
    f = make_frame(3);
    render_parts(&f, 3);
    check_same("parts");
    f = make_frame(3);
    CHECK(lmb_render_begin(&render, &f) == LMB_OK);
    while (lmb_render_step(&render, 1) == LMB_MORE) {
        const char *name;
        const float done = lmb_render_progress(&name, &render);
        CHECK(done >= 0.0f && done <= 1.0f);
    }
    check_same("steps");
    memset(picture, 0, sizeof picture);
    CHECK(lmb_render_again(&render, &f) == LMB_OK);
    while (lmb_render_step(&render, 100) == LMB_MORE) {
    }
    check_same("again");
    f.visibility = 0.3f; /* the other settings solved the elements' light */
    CHECK(lmb_render_again(&render, &f) == LMB_ERR_ARG);
    f = make_frame(3);
    f.occlusion = LMB_OCCLUSION_NONE;
    CHECK(lmb_render_again(&render, &f) == LMB_ERR_ARG);
    for (int32_t i = 0; lmb_kernels_at(i) != NULL; ++i) {
        f = make_frame(3);
        f.kernels = lmb_kernels_at(i);
        CHECK(lmb_render_frame(&render, &f) == LMB_OK);
        check_same(lmb_kernels_name(f.kernels));
    }
}

static double mean_of_picture(void)
{
    double sum = 0.0;
    for (int i = 0; i < FRAME * FRAME * 3; ++i) {
        sum += (double)picture[i] / (FRAME * FRAME * 3);
    }
    return sum;
}

/* One bounce is the same as without elements; each further bounce adds less light. */
static void test_counts(void)
{
    double mean[5];
    lmb_frame f;
    make_room(0);
    f = make_frame(1);
    memset(&f.elements, 0, sizeof f.elements);
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
    memcpy(first_picture, picture, sizeof picture);
    for (int32_t b = 0; b < 5; ++b) {
        f = make_frame(b);
        CHECK(lmb_render_frame(&render, &f) == LMB_OK);
        mean[b] = mean_of_picture();
        if (b <= 1) {
            check_same("one bounce");
        }
    }
    CHECK_MSG(mean[2] > 1.05 * mean[1] && mean[3] - mean[2] > 0.2 * (mean[2] - mean[1]) &&
                  mean[3] - mean[2] < 0.8 * (mean[2] - mean[1]) && mean[4] - mean[3] < 0.8 * (mean[3] - mean[2]),
              "%g %g %g %g", mean[1], mean[2], mean[3], mean[4]);
}

static void test_refusals(void)
{
    lmb_frame f;
    lmb_cut_params cut_params;
    const lmb_element_scratch own = {picked_kernels(), &scratch.gather.cut, &scratch.tile, &scratch.direct,
                                     &scratch.indirect};
    make_room(0);
    f = make_frame(-1);
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_ARG);
    f = make_frame(2);
    memset(&f.elements, 0, sizeof f.elements);
    CHECK(lmb_render_begin(&render, &f) == LMB_ERR_ARG);
    f.show = LMB_SHOW_DIRECT; /* no bounced light */
    CHECK(lmb_render_begin(&render, &f) == LMB_OK);
    world.material[1].emission[0] = -1.0f;
    CHECK(lmb_scene_check(&world.scene) == LMB_ERR_ARG);
    world.material[1].emission[0] = INFINITY;
    CHECK(lmb_scene_check(&world.scene) == LMB_ERR_ARG);
    world.material[1].emission[0] = 0.0f;
    f = make_frame(2);
    CHECK(lmb_elements_build(&f.elements, &world.scene, NULL) == LMB_OK);
    memset(&cut_params, 0, sizeof cut_params);
    cut_params.error = cut_params.visibility = 0.1f;
    const int32_t tiles = lmb_elements_tiles(&f.elements);
    CHECK(lmb_elements_receive(&f.elements, &own, NULL, &cut_params, 0, tiles + 1) == LMB_ERR_ARG);
    CHECK(lmb_elements_receive(&f.elements, &own, NULL, &cut_params, -1, tiles) == LMB_ERR_ARG);
    CHECK(lmb_elements_receive(&f.elements, &own, NULL, &cut_params, 1, 0) == LMB_ERR_ARG);
    CHECK(lmb_elements_receive(&f.elements, &own, NULL, &cut_params, 0, -1) == LMB_ERR_ARG);
    CHECK(lmb_elements_receive(&f.elements, &own, NULL, NULL, 0, tiles) == LMB_ERR_ARG);
    CHECK(lmb_elements_receive(&f.elements, NULL, NULL, &cut_params, 0, tiles) == LMB_ERR_ARG);
    CHECK(lmb_elements_receive(&f.elements, &own, NULL, &cut_params, 0, tiles) == LMB_OK);
}

/* A wall beside an emissive floor: two rows lie below the floor's plane and are not tested for visibility. */
static void test_asked(void)
{
    lmb_bvh bvh;
    lmb_cut_params cut_params;
    lmb_stats stats;
    lmb_tile *wall = &scratch.tile;
    world_begin(0.5f, 0.5f, 0.5f);
    world.material[0].flags = 0;
    world.material[0].emission[1] = 2.0f;
    world_quad(vec3(0, 0, 0), Z, X);
    lmb_elements e = build(64);
    CHECK(lmb_bvh_init(&bvh, BVH, bvh_memory, sizeof bvh_memory) == LMB_OK);
    CHECK(lmb_bvh_build(&bvh, &world.scene) == LMB_OK);
    memset(wall, 0, sizeof *wall);
    wall->hits = LMB_TILE_PIXELS;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        wall->position[0][k] = 3.0f;
        wall->position[1][k] = 0.1f * ((float)(k / LMB_TILE) - 1.5f);
        wall->position[2][k] = 0.1f * (float)(k % LMB_TILE);
        wall->normal[0][k] = wall->face[0][k] = -1.0f;
        wall->depth[k] = 1.0f;
        wall->id[k] = 1;
    }
    memset(&stats, 0, sizeof stats);
    memset(&cut_params, 0, sizeof cut_params);
    memset(&scratch.indirect, 0, sizeof scratch.indirect);
    cut_params.error = cut_params.visibility = 100.0f; /* one node for everything */
    cut_params.bvh = &bvh;
    cut_params.stats = &stats;
    CHECK(lmb_gather_cut(&scratch.indirect, picked_kernels(), &scratch.gather.cut, wall, &e.tree, &cut_params) ==
          LMB_OK);
    CHECK_MSG(stats.segments == 6 * LMB_TILE && stats.pairs == stats.segments, "%u segments, %u pairs",
              (unsigned)stats.segments, (unsigned)stats.pairs);
}

/* An emissive surface shows its radiance, with every way of grouping. */
static void test_emission(void)
{
    lmb_frame f;
    int lit = 0;
    make_room(1);
    f = make_frame(1);
    f.view = look(vec3(-0.5f, 0.2f, 0), vec3(-0.5f, 0.9f, 0), 20, FRAME);
    f.show = LMB_SHOW_DIRECT;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
    for (int i = 0; i < FRAME * FRAME; ++i) {
        lit += picture[3 * i + 2] >= 3.0f;
    }
    CHECK_MSG(lit == FRAME * FRAME, "%d pixels are lit", lit);
}

void test_elements(void)
{
    test_memory();
    test_area();
    test_core();
    test_far();
    test_sliver();
    test_dropped();
    test_sides();
    test_texture();
    test_ways();
    test_counts();
    test_refusals();
    test_asked();
    test_emission();
}
