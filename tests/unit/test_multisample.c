/* test_multisample.c: frame.samples: edges weighted by pixel coverage, bounced light once per surface, and always the
 * same bytes. */
#include <lambent/lambent.h>

#include <stdio.h>
#include <stdlib.h>

#include "../../tools/demo/demo_scene.h"
#include "../laid_out.h"
#include "../world.h"

void test_multisample(void);

#if LMB_MULTISAMPLE

static lmb_render render;
static lmb_stats stats;
static lmb_band_scratch other_scratch;

static lmb_frame_settings settings_of(const lmb_scene *scene, lmb_view view, int32_t samples)
{
    lmb_frame_settings s = draft_settings(scene, view);
    s.samples = samples;
    return s;
}

/* With separate counts. */
static void lay_out_counting(const lmb_frame_settings *s)
{
    lay_out(s);
    memset(&stats, 0, sizeof stats);
    frame.stats = &stats;
}

static float pixel(int32_t x, int32_t y, int c)
{
    return ((const float *)(const void *)((const uint8_t *)frame.out.data + y * frame.out.stride_bytes))[3 * x + c];
}

/* --- coverage ----------------------------------------------------------------------------------------------------- */

enum { SIDE = 64 };

/* Pixels of a centimetre, viewed along -Z. */
static lmb_view flat_view(void)
{
    lmb_view v;
    memset(&v, 0, sizeof v);
    v.eye = vec3(0, 0, 1);
    v.right = X;
    v.up = Y;
    v.back = Z;
    v.half_width = v.half_height = 0.01f * SIDE / 2;
    v.near_m = 0.1f;
    v.far_m = 10.0f;
    v.kind = LMB_ORTHOGRAPHIC;
    v.frame_width = v.frame_height = SIDE;
    return v;
}

/* Share of the pixel's square on the far side of a line through the centre, from 64 x 64 points if the line is near. */
static double covered(int32_t x, int32_t y, double angle)
{
    const double s = sin(angle), c = cos(angle), far = (x + 0.5 - SIDE / 2) * s - (SIDE / 2 - y - 0.5) * c;
    int inside = 0;
    if (fabs(far) > 0.75) { /* more than half a diagonal */
        return far > 0.0 ? 1.0 : 0.0;
    }
    for (int k = 0; k < 64 * 64; ++k) {
        const double px = x + (k % 64 + 0.5) / 64.0 - SIDE / 2, py = SIDE / 2 - y - (k / 64 + 0.5) / 64.0;
        inside += px * s - py * c > 0.0;
    }
    return inside / 4096.0;
}

/* RMS error of the coverage of pixels on an edge, over angles. The surface emits 1 W/(sr m2). */
static double edge_error(int32_t samples)
{
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < 6; ++i) {
        const double angle = 0.13 + i * PI / 6.0;
        const lmb_vec3 along = vec3((float)cos(angle), (float)sin(angle), 0), out = vec3(along.y, -along.x, 0);
        world_begin(0, 0, 0);
        world_quad(mul3(out, 2.0f), mul3(along, 2.0f), mul3(out, 2.0f));
        world.material[0].emission[0] = 1.0f;
        CHECK(world_end() == LMB_OK);
        const lmb_frame_settings s = settings_of(&world.scene, flat_view(), samples);
        lay_out(&s);
        CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
        for (int32_t y = 0; y < SIDE; ++y) {
            for (int32_t x = 0; x < SIDE; ++x) {
                const double truth = covered(x, y, angle), error = (double)pixel(x, y, 0) - truth;
                if (truth > 0.0 && truth < 1.0) {
                    sum += error * error;
                    ++count;
                } else {
                    CHECK(fabs(error) < 1e-5);
                }
            }
        }
    }
    return sqrt(sum / count);
}

static void test_edges(void)
{
    const double e1 = edge_error(1), e4 = edge_error(4), e8 = edge_error(8), e16 = edge_error(16);
    printf("  edge's coverage by 1, 4, 8 and 16 samples: RMS error %.3f, %.3f, %.3f, %.3f\n", e1, e4, e8, e16);
    CHECK(e1 > 0.2 && e4 < 0.12 && e8 < 0.07 && e16 < 0.05);
}

/* A view with shifted samples equals one from an eye shifted by the same amount. */
static void test_aside(void)
{
    lmb_view there = flat_view(), aside = there;
    aside.sample_x = 64;
    aside.sample_y = -32;
    there.eye = add3(there.eye, vec3(0.0025f, 0.00125f, 0));
    world_begin(0, 0, 0);
    world_sphere(vec3(0, 0, 0), 0.2f, 6, 12);
    world.material[0].emission[0] = 1.0f;
    CHECK(world_end() == LMB_OK);
    uint8_t seen[SIDE * SIDE];
    int inside = 0;
    for (int i = 0; i < 2; ++i) {
        lmb_frame_settings s = settings_of(&world.scene, i == 0 ? there : aside, 1);
        s.show = LMB_SHOW_DIRECT;
        lay_out(&s);
        CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
        for (int k = 0; k < SIDE * SIDE; ++k) {
            const uint8_t now = pixel(k % SIDE, k / SIDE, 0) > 0.0f;
            inside += now;
            CHECK(i == 0 || seen[k] == now);
            seen[k] = now;
        }
    }
    CHECK(inside > 2000 && inside < 4000);
    there.sample_x = 128;
    const lmb_frame_settings s = settings_of(&world.scene, there, 1);
    lay_out(&s);
    CHECK(lmb_render_begin(&render, &frame) == LMB_ERR_ARG);
}

/* --- bounced light ------------------------------------------------------------------------------------------------ */

/* Light is gathered again only at edges that no neighbour explains; far from edges the pictures agree. */
static void test_gathers_once(void)
{
    static float one[80 * 60];
    lmb_frame_settings s = settings_of(demo_scene(), demo_view(80, 60), 1);
    s.show = LMB_SHOW_IRRADIANCE;
    lay_out_counting(&s);
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
    const double pairs = (double)stats.pairs;
    for (int k = 0; k < 80 * 60; ++k) {
        one[k] = pixel(k % 80, k / 80, 1);
    }
    s.samples = 4;
    lay_out_counting(&s);
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
    int same = 0;
    for (int k = 0; k < 80 * 60; ++k) {
        same += absf(pixel(k % 80, k / 80, 1) - one[k]) < 1e-5f;
    }
    printf("  gallery, 4 samples: %.3f of the pairs by one, %.1f %% of the pixels as they were\n",
           (double)stats.pairs / pairs, 100.0 * same / (80 * 60));
    CHECK((double)stats.pairs < 1.4 * pairs && same > 80 * 60 * 85 / 100);
}

enum { FLOOR_ALONE, STEPS, GROOVES, BOARDS };

/* Pairs of pixels and lights for `samples` of a floor, lit by a lit wall behind the eye. Each pixel column has its
 * centres on a separate strip. Between two strips is nothing, a board above the floor, or the two sides of a groove; or
 * a board covers the first column of each tile and a bit of the tile before. */
static double floor_pairs(int between, int32_t samples)
{
    const float px = 0.01f, half_gap = between == FLOOR_ALONE || between == BOARDS ? 0.0f : 0.2f * px;
    world_begin(0.8f, 0.8f, 0.8f);
    world_quad(vec3(0, 0, 2), vec3(-2, 0, 0), Y);
    world_part();
    for (int i = 0; i <= SIDE; ++i) {
        const float x = ((float)i - SIDE / 2) * px;
        for (int k = 0; k < 4; ++k) {
            const lmb_vec3 at = vec3(x, ((float)k - 1.5f) * 16 * px, -0.5f), along = vec3(0, 8 * px, 0);
            world_quad(add3(at, vec3(0.5f * px, 0, 0)), vec3(0.5f * px - half_gap, 0, 0), along);
            if (between == BOARDS && i % LMB_TILE == 0) {
                world_quad(add3(at, vec3(0.5f * px, 0, 2 * px)), vec3(0.7f * px, 0, 0), along);
            } else if (between == STEPS) {
                world_quad(add3(at, vec3(0, 0, 2 * px)), vec3(half_gap, 0, 0), along);
            } else if (between == GROOVES) {
                world_quad(sub3(at, vec3(0.5f * half_gap, 0, half_gap)), vec3(0.5f * half_gap, 0, -half_gap), along);
                world_quad(sub3(at, vec3(-0.5f * half_gap, 0, half_gap)), vec3(0.5f * half_gap, 0, half_gap), along);
            }
        }
    }
    CHECK(world_end() == LMB_OK);
    lmb_light lamp = spot(vec3(0, 0, 0.5f), Z, 30, 40);
    lamp.intensity[0] = lamp.intensity[1] = lamp.intensity[2];
    world.scene.lights = &lamp;
    world.scene.light_count = 1;
    lmb_frame_settings s = settings_of(&world.scene, flat_view(), samples);
    s.show = LMB_SHOW_INDIRECT;
    lay_out_counting(&s);
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
    for (int32_t k = 0; k < SIDE * SIDE; ++k) { /* everything is grey, so the light is too */
        const int32_t x = k % SIDE, y = k / SIDE;
        CHECK(pixel(x, y, 0) > 0.0f && pixel(x, y, 0) == pixel(x, y, 1) && pixel(x, y, 1) == pixel(x, y, 2));
    }
    return (double)stats.pairs;
}

/* A sample takes the light of a nearby pixel centre if the surface continues, whatever its triangles. If the surface
 * steps or turns, light is gathered for parts that no centre shows, and kept: four times as many samples need no
 * more. */
static void test_goes_on(void)
{
    CHECK(floor_pairs(FLOOR_ALONE, 1) > 1000 && floor_pairs(FLOOR_ALONE, 16) == floor_pairs(FLOOR_ALONE, 1));
    const double one = floor_pairs(STEPS, 1), four = floor_pairs(STEPS, 4), more = floor_pairs(STEPS, 16);
    CHECK_MSG(four > 1.3 * one && more < 1.02 * four, "steps: %g pairs, by 4 samples %g, by 16 %g", one, four, more);
    const double flat = floor_pairs(GROOVES, 1), sides = floor_pairs(GROOVES, 4);
    CHECK_MSG(sides > 2 * flat, "grooves: %g pairs, by 4 samples %g", flat, sides);
    /* A tile has no access to the next tile's centres and must not use those of the first column instead. */
    const double boards = floor_pairs(BOARDS, 1), edges = floor_pairs(BOARDS, 4);
    CHECK_MSG(edges > 1.05 * boards && edges < 1.5 * boards, "boards: %g pairs, by 4 samples %g", boards, edges);
}

/* Metal has no diffuse part: only its lobe shows the lit wall behind the eye. At the metal's edge the lobe counts by
 * pixel coverage, whatever the pixel's centre shows. */
static void test_metal_edge(void)
{
    const double angle = 0.4;
    const lmb_vec3 along = vec3((float)cos(angle), (float)sin(angle), 0), out = vec3(along.y, -along.x, 0);
    world_begin(0.8f, 0.8f, 0.8f);
    world_quad(vec3(0, 0, 2), vec3(-2, 0, 0), Y);
    world_part();
    world_quad(mul3(out, 2.0f), mul3(along, 2.0f), mul3(out, 2.0f));
    memset(world.material[1].albedo, 0, sizeof world.material[1].albedo);
    world.material[1].roughness = 0.8f;
    for (int c = 0; c < 3; ++c) {
        world.material[1].specular[c] = 0.9f;
    }
    CHECK(world_end() == LMB_OK);
    lmb_light lamp = spot(vec3(0, 0, 0.5f), Z, 30, 40);
    world.scene.lights = &lamp;
    world.scene.light_count = 1;
    lmb_frame_settings s = settings_of(&world.scene, flat_view(), 16);
    s.show = LMB_SHOW_INDIRECT;
    s.quality = LMB_QUALITY_DEFAULT;
    lay_out(&s);
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
    double sum = 0.0;
    int count = 0;
    for (int32_t x = 4; x < SIDE - 4; ++x) {
        for (int32_t y = 4; y < SIDE - 4; ++y) {
            const double truth = covered(x, y, angle), whole = (double)pixel(x, y + 3, 1);
            if (truth > 0.0 && truth < 1.0) {
                const double error = (double)pixel(x, y, 1) / whole - truth;
                sum += error * error;
                ++count;
                CHECK(whole > 0.01);
            }
        }
    }
    printf("  metal's edge, 16 samples: RMS error %.3f of %d pixels\n", sqrt(sum / count), count);
    CHECK(count > 40 && sqrt(sum / count) < 0.1);
}

/* --- the same bytes ----------------------------------------------------------------------------------------------- */

static uint64_t rows_hash;

static int add_rows(void *user, const lmb_surface *rows, int32_t y)
{
    (void)user;
    (void)y;
    for (int32_t row = 0; row < rows->height; ++row) {
        const uint8_t *data = (const uint8_t *)rows->data + (ptrdiff_t)row * rows->stride_bytes;
        for (int32_t i = 0; i < rows->width * 12; ++i) {
            rows_hash = (rows_hash ^ data[i]) * UINT64_C(0x100000001b3);
        }
    }
    return 0;
}

static uint64_t hash_of(void)
{
    rows_hash = 1;
    add_rows(NULL, &frame.out, 0);
    return rows_hash;
}

static uint64_t drawn(const lmb_frame_settings *s)
{
    lay_out(s);
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
    return hash_of();
}

/* Bands from last to first, with noise in the scratch, using the second thread's samples. */
static uint64_t drawn_backwards(lmb_frame_settings s)
{
    s.threads = 2;
    lay_out(&s);
    lmb_multisample *own = frame.scratch[1].multisample;
    CHECK(own != NULL && own != frame.scratch[0].multisample && lmb_render_begin(&render, &frame) == LMB_OK);
    while (render.stage < LMB_STAGE_BANDS && lmb_render_step(&render, 1) == LMB_MORE) {
    }
    const lmb_target eye = own->eye;
    for (int32_t band = (frame.view.frame_height - 1) / 8; band >= 0; --band) {
        memset(&other_scratch, 0x3c, sizeof other_scratch);
        memset(own, 0x3c, sizeof *own);
        own->eye = eye;
        other_scratch.multisample = own;
        CHECK(lmb_render_band(&render, &other_scratch, &frame.eye, &frame.out, band) == LMB_OK);
    }
    return hash_of();
}

static uint64_t drawn_by_bands(lmb_frame_settings s)
{
    s.by_bands = 1;
    lay_out(&s);
    frame.callback = add_rows;
    rows_hash = 1;
    CHECK(lmb_render_frame(&render, &frame) == LMB_OK);
    return rows_hash;
}

/* The centre of a view at three times the size: small frames of the whole scene consist only of edges. */
static lmb_view near_view(int32_t width, int32_t height)
{
    lmb_view v = demo_view(width, height);
    v.half_width *= 1.0f / 3.0f;
    v.half_height *= 1.0f / 3.0f;
    return v;
}

static void test_same_bytes(int32_t width, int32_t height, int32_t samples)
{
    const lmb_frame_settings s = settings_of(demo_scene(), near_view(width, height), samples);
    const uint64_t whole = drawn(&s);
    CHECK(drawn_backwards(s) == whole);
    CHECK(drawn_by_bands(s) == whole);
    for (int32_t i = 1; lmb_kernels_at(i) != NULL; ++i) {
        lmb_frame_settings by = s;
        by.kernels = lmb_kernels_at(i);
        CHECK_MSG(drawn(&by) == whole, "%s", lmb_kernels_name(by.kernels));
    }
}

static void test_refused(void)
{
    static const int32_t wrong[] = {-1, 2, 3, 5, 32};
    lmb_frame_settings s = settings_of(demo_scene(), demo_view(40, 30), 1);
    for (int i = 0; i < COUNT(wrong); ++i) {
        s.samples = wrong[i];
        CHECK(lmb_frame_bytes(&s) == 0);
    }
    s.samples = 1;
    lay_out(&s);
    frame.samples = 4;
    CHECK(lmb_render_begin(&render, &frame) == LMB_ERR_ARG); /* no memory for samples */
    s.samples = 4;
    lay_out(&s);
    CHECK(lmb_render_begin(&render, &frame) == LMB_OK);
    frame.samples = 8;
    CHECK(lmb_render_begin(&render, &frame) == LMB_ERR_ARG); /* memory for 4 */
    for (int i = 0; i < 5; ++i) {
        lay_out(&s);
        lmb_multisample *m = frame.scratch[0].multisample;
        m->eye.id.data = i == 0 ? NULL : m->eye.id.data;
        m->eye.depth.width -= i == 1;
        m->eye.depth.height -= i == 2;
        frame.view.sample_x = i == 3;
        frame.view.sample_y = i == 4;
        CHECK_MSG(lmb_render_begin(&render, &frame) == LMB_ERR_ARG, "%d", i);
    }
    lay_out(&s);
    frame.samples = 0;
    CHECK(lmb_render_begin(&render, &frame) == LMB_OK && render.frame.samples == 1);
}

void test_multisample(void)
{
    test_edges();
    test_aside();
    test_gathers_once();
    test_goes_on();
    test_metal_edge();
    test_same_bytes(27, 19, 4);
    test_same_bytes(9, 9, 8);
    test_same_bytes(1, 9, 16);
    test_refused();
    free_laid_out();
}

#else
void test_multisample(void) {}
#endif
