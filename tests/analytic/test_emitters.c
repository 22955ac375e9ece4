/* test_emitters.c: light of emitting surfaces, direct and after one reflection: a partly emitting panel against a form
 * factor, and a Cornell box with an emitting lamp against brute force. */
enum { FRAME = 32, MAP = 64, FACES = 1, ELEMENTS = 4096, BVH = 64, SIDE = 64, LIT = 38 /* columns of the panel */ };

#include <stdlib.h>

#include "../bounce_frame.h"
#include "facing.h"

void test_emitters(void);

/* --- part of a panel ---------------------------------------------------------------------------------------------- */

static uint32_t texels[SIDE * SIDE * 2];

/* The part x < PART of a unit square at height h emits light down on another square; no element ends at PART. */
#define PART (LIT / (double)SIDE)
static void make_part_panel(double h)
{
    static const uint8_t black[4] = {0, 0, 0, 255}, white[4] = {255, 255, 255, 255};
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0.5f, 0, 0.5f), vec3(0, 0, 0.5f), vec3(0.5f, 0, 0));
    world_part();
    world_quad(vec3(0.5f, (float)h, 0.5f), vec3(0.5f, 0, 0), vec3(0, 0, 0.5f)); /* u along x */
    for (int i = 0; i < SIDE * SIDE; ++i) {
        memcpy(&texels[i], i % SIDE < LIT ? white : black, 4);
    }
    world.texture.texels = (const uint8_t *)texels;
    world.texture.width = world.texture.height = SIDE;
    world.texture.levels = (uint8_t)lmb_texture_level_count(SIDE, SIDE);
    world.texture.filter = LMB_TRILINEAR;
    world.texture.wrap_s = world.texture.wrap_t = LMB_WRAP_CLAMP;
    CHECK(lmb_texture_mips((uint8_t *)texels, SIDE, SIDE, world.texture.levels) == LMB_OK);
    for (int i = 0; i < 2; ++i) {
        for (int c = 0; c < 3; ++c) {
            world.material[i].albedo[c] = 0.0f; /* only direct light */
        }
    }
    world.material[1].flags = 0;
    world.material[1].emission[1] = 4.0f;
    world.material[1].emission_map = 1;
    CHECK(world_end() == LMB_OK);
}

/* Form factor of the part 0 .. PART x 0 .. 1. */
static double part_factor(double x, double z, double h)
{
    return parallel_corner(x, z, h) + parallel_corner(PART - x, z, h) + parallel_corner(x, 1 - z, h) +
           parallel_corner(PART - x, 1 - z, h);
}

static void check_part_panel(double h, double bar)
{
    const double eye = 0.4 * h, half = 0.45;
    const lmb_view v = look(vec3(0.5f, (float)eye, 0.5f), vec3(0.5f, 0, 0.5f), 2.0 * atan(half / eye) * 180.0 / PI,
                            FRAME);
    double max = 0.0, mean = 0.0, peak = 0.0;
    make_part_panel(h);
    lmb_frame f = bounce_frame(&v, 1);
    f.show = LMB_SHOW_IRRADIANCE;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
    for (int i = 0; i < FRAME * FRAME; ++i) {
        const double sx = half * ((i % FRAME + 0.5) / FRAME * 2.0 - 1.0),
                     sy = half * (1.0 - (i / FRAME + 0.5) / FRAME * 2.0);
        const double x = 0.5 + (double)v.right.x * sx + (double)v.up.x * sy,
                     z = 0.5 + (double)v.right.z * sx + (double)v.up.z * sy;
        const double want = PI * 4.0 * part_factor(x, z, h), off = (double)picture[3 * i + 1] - want;
        max = fmax(max, fabs(off));
        mean += off / (FRAME * FRAME);
        peak = fmax(peak, want);
    }
    printf("  part of a panel at height %-4g %+.3f %% of the brightest in the mean, %.3f %% at most\n", h,
           mean / peak * 100, max / peak * 100);
    CHECK_MSG(max < bar * peak && fabs(mean) < 0.005 * peak, "height %g: %g, %g of %g", h, max, mean, peak);
}

/* --- a Cornell box ------------------------------------------------------------------------------------------------ */

enum { CORNERS = 3 * 64 };
static uint8_t colours[CORNERS * 4];

/* Sets the albedo of the next two triangles. */
static void paint(uint8_t red, uint8_t green, uint8_t blue)
{
    const uint8_t code[4] = {red, green, blue, 255};
    for (uint32_t i = 3 * (world.count - 2); i < 3 * world.count; ++i) {
        memcpy(colours + 4 * i, code, 4);
    }
}

/* A red wall at the left, a green one at the right, no front, two blocks, and a lamp of 0.5 x 0.5 m at the ceiling. */
static void make_cornell(void)
{
    memset(colours, 179, sizeof colours);
    world_begin(1, 1, 1);
    world_quad(vec3(-1, 0, 0), Y, Z);
    paint(153, 13, 13);
    world_quad(vec3(1, 0, 0), Z, Y);
    paint(26, 128, 26);
    world_quad(vec3(0, -1, 0), Z, X);
    world_quad(vec3(0, 1, 0), X, Z);
    world_quad(vec3(0, 0, -1), X, Y);
    world_box(vec3(-0.4f, -0.5f, -0.35f), 0.25f);
    world_box(vec3(0.45f, -0.7f, 0.25f), 0.3f);
    world_part();
    world_quad(vec3(0, 0.98f, 0), mul3(X, 0.25f), mul3(Z, 0.25f)); /* front face: down */
    world.mesh[0].colours = colours;
    world.material[1].albedo[0] = world.material[1].albedo[1] = world.material[1].albedo[2] = 0.5f;
    world.material[1].flags = 0;
    world.material[1].emission[0] = 17.0f;
    world.material[1].emission[1] = 12.0f;
    world.material[1].emission[2] = 4.0f;
    CHECK(world_end() == LMB_OK);
}

static lmb_vec3 corner(uint32_t i, int k)
{
    return vec3(world.corners[i][k][0], world.corners[i][k][1], world.corners[i][k][2]);
}

/* Returns the first triangle hit by the ray from p along d, or -1; *t is the distance. */
static int hit(float *t, lmb_vec3 p, lmb_vec3 d)
{
    int nearest = -1;
    *t = 1e30f;
    for (uint32_t i = 0; i < world.count; ++i) {
        const lmb_vec3 a = corner(i, 0), e1 = sub3(corner(i, 1), a), e2 = sub3(corner(i, 2), a), q = cross3(d, e2);
        const float det = dot3(e1, q);
        const lmb_vec3 s = sub3(p, a), k = cross3(s, e1);
        const float u = dot3(s, q) / det, v = dot3(d, k) / det, w = dot3(e2, k) / det;
        if (u >= 0.0f && v >= 0.0f && u + v <= 1.0f && w > 1e-4f && w < *t) {
            nearest = (int)i;
            *t = w;
        }
    }
    return nearest;
}

/* Irradiance at p of a lamp of radiance 1, from `points` x `points` samples. */
static double straight(lmb_vec3 p, lmb_vec3 n, int points)
{
    double sum = 0.0;
    for (int i = 0; i < points * points; ++i) {
        const lmb_vec3 at = vec3(0.5f * (((float)(i % points) + 0.5f) / (float)points - 0.5f), 0.98f,
                                 0.5f * (((float)(i / points) + 0.5f) / (float)points - 0.5f));
        const lmb_vec3 to = sub3(at, p);
        const float d2 = dot3(to, to), cosines = dot3(n, to) * to.y;
        float t;
        if (cosines > 0.0f && dot3(n, to) > 0.0f && hit(&t, p, to) >= (int)world.first && t > 0.999f) {
            sum += (double)(cosines / (d2 * d2)) * 0.25 / (points * points);
        }
    }
    return sum;
}

/* The normal of triangle i on the side that d comes from. */
static lmb_vec3 normal_towards(int i, lmb_vec3 d)
{
    const lmb_vec3 a = corner((uint32_t)i, 0),
                   n = normalize3(cross3(sub3(corner((uint32_t)i, 1), a), sub3(corner((uint32_t)i, 2), a)));
    return dot3(n, d) > 0.0f ? mul3(n, -1.0f) : n;
}

/* Irradiance at p: direct light, plus 20 x 20 cosine-distributed rays to surfaces that reflect their direct light. The
 * lamp's albedo is included, although its face is never lit. */
static void brute(double out[3], lmb_vec3 p, lmb_vec3 n)
{
    enum { RINGS = 20 };
    const double direct = straight(p, n, 12), lamp[3] = {17, 12, 4};
    const lmb_vec3 u = normalize3(cross3(n, absf(n.y) < 0.9f ? Y : X)), v = cross3(n, u);
    for (int c = 0; c < 3; ++c) {
        out[c] = direct * lamp[c];
    }
    for (int i = 0; i < RINGS * RINGS; ++i) {
        const double r2 = (i / RINGS + 0.5) / RINGS, a = (i % RINGS + 0.5) / RINGS * 2 * PI, r = sqrt(r2);
        const lmb_vec3 d = add3(mul3(n, (float)sqrt(1 - r2)),
                                add3(mul3(u, (float)(r * cos(a))), mul3(v, (float)(r * sin(a)))));
        float t;
        const int to = hit(&t, p, d);
        if (to < 0 || to >= (int)world.first) {
            continue;
        }
        const double there = straight(add3(p, mul3(d, t)), normal_towards(to, d), 4) / (RINGS * RINGS);
        for (int c = 0; c < 3; ++c) {
            out[c] += there * lamp[c] * colours[12 * to + c] / 255.0;
        }
    }
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Tests every second pixel in x and y, with the default number of reflections. */
static void check_cornell(void)
{
    enum { STEP = 2, COUNT = FRAME / STEP * (FRAME / STEP) };
    static double off[3 * COUNT];
    const lmb_view v = look(vec3(0, 0, 3.2f), vec3(0, 0, 0), 38, FRAME);
    const double half = tan(19 * PI / 180);
    double mean = 0.0, got = 0.0, error = 0.0;
    int n = 0;
    make_cornell();
    lmb_frame f = bounce_frame(&v, 0);
    f.show = LMB_SHOW_IRRADIANCE;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
    for (int i = 0; i < FRAME * FRAME; ++i) {
        const double sx = half * ((i % FRAME + 0.5) / FRAME * 2.0 - 1.0),
                     sy = half * (1.0 - (i / FRAME + 0.5) / FRAME * 2.0);
        const lmb_vec3 d = vec3((float)sx, (float)sy, -1.0f);
        double want[3];
        float t;
        if (i % FRAME % STEP != 0 || i / FRAME % STEP != 0) {
            continue;
        }
        const int to = hit(&t, v.eye, d);
        if (to < 0 || to >= (int)world.first) {
            continue;
        }
        /* Start slightly in front of the wall. On an edge, rays into the other wall would start behind that wall. */
        brute(want, add3(v.eye, mul3(d, 0.9995f * t)), normal_towards(to, d));
        for (int c = 0; c < 3; ++c) {
            mean += want[c];
            got += (double)picture[3 * i + c];
            off[n++] = fabs((double)picture[3 * i + c] - want[c]);
        }
    }
    qsort(off, (size_t)n, sizeof *off, by_size);
    for (int i = 0; i < n * 99 / 100; ++i) {
        error += off[i] * off[i] / n;
    }
    error = sqrt(error) / (mean / n);
    printf("  Cornell's lamp as an emitter, %d pixels: %.4f of the light, off by %.4f (trim)\n", n / 3, got / mean,
           error);
    CHECK_MSG(n > 500 && fabs(got / mean - 1.0) < 0.015 && error < 0.03, "%d, %g, %g", n, got / mean, error);
}

void test_emitters(void)
{
    if (LMB_MAX_CUT < 8192) {
        SKIP("emitters: cuts of %d nodes are too coarse for 1 %%", LMB_MAX_CUT);
        return;
    }
    check_part_panel(1.0, 0.01);
    check_part_panel(0.3, 0.02);
    check_cornell();
}
