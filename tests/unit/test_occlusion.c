/* test_occlusion.c: occlusion between a tile and a point, against all triangles in binary64; light must not leak. */
#include <math.h>
#include <stdlib.h>

#include "../../src/occlusion/traversal.h"
#include "../world.h"

void test_occlusion(void);

static uint32_t memory[1 << 19];

/* Builds the BVH of the world's triangles. */
static lmb_bvh bvh_of_world(void)
{
    lmb_bvh b;
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_bvh_init(&b, world.count, memory, sizeof memory) == LMB_OK);
    CHECK(lmb_bvh_build(&b, &world.scene) == LMB_OK);
    return b;
}

static void minus(double out[3], const float a[3], lmb_vec3 b)
{
    out[0] = (double)a[0] - (double)b.x;
    out[1] = (double)a[1] - (double)b.y;
    out[2] = (double)a[2] - (double)b.z;
}

/* Relative certainty that a segment crosses a triangle: > 0 crosses, < 0 does not; near 0 either result is right. */
static double crosses(float tri[3][3], lmb_vec3 from, lmb_vec3 to)
{
    const float end[3] = {to.x, to.y, to.z};
    double p[3][3], d[3], n[3], e[3], vol = 0.0;
    minus(d, end, from);
    for (int i = 0; i < 3; ++i) {
        minus(p[i], tri[i], from);
    }
    for (int i = 0; i < 3; ++i) {
        const double *a = p[(i + 1) % 3], *b = p[(i + 2) % 3];
        double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        double length = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
        e[i] = (c[0] * d[0] + c[1] * d[1] + c[2] * d[2]) / (length > 0.0 ? length : 1.0);
        vol += i == 0 ? c[0] * p[0][0] + c[1] * p[0][1] + c[2] * p[0][2] : 0.0;
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
    }
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), side = vol < 0.0 ? -1.0 : 1.0;
    const double ahead = fabs(vol) / length, past = side * (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]) / length - ahead;
    double min = fmin(ahead, past);
    for (int i = 0; i < 3; ++i) {
        min = fmin(min, side * e[i]);
    }
    return min;
}

static lmb_vec3 random_point(test_rng *r, float half)
{
    const float x = test_uniform(r, -half, half), y = test_uniform(r, -half, half);
    return vec3(x, y, test_uniform(r, -half, half));
}

static void fill_tile(lmb_tile *tile, lmb_vec3 middle, float half, test_rng *r)
{
    memset(tile, 0, sizeof *tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_plane(tile->position, k, add3(middle, random_point(r, half)));
    }
}

/* For a traversal without history. */
static float noise_of(const lmb_tile *tile, uint64_t pixels, lmb_vec3 at)
{
    return lmb_tile_noise(tile, pixels) + lmb_place_noise(at, 0.0f);
}

static uint64_t occluded_fresh(const lmb_bvh *b, const lmb_tile *tile, uint64_t pixels, lmb_vec3 at)
{
    lmb_traversal traversal;
    memset(&traversal, 0, sizeof traversal);
    return lmb_occluded_tile(picked_kernels(), &traversal, b, tile, pixels, at, noise_of(tile, pixels, at));
}

/* A few large triangles, many smaller ones, or many small ones. */
static lmb_bvh random_triangles(test_rng *r, int scene)
{
    const float size = scene % 3 == 0 ? 2.0f : scene % 3 == 1 ? 0.3f : 0.05f;
    world_begin(1, 1, 1);
    for (int i = 0; i < (scene % 3 == 0 ? 6 : 300); ++i) {
        const lmb_vec3 at = random_point(r, 1.0f);
        const lmb_vec3 b = add3(at, random_point(r, size)), c = add3(at, random_point(r, size));
        world_triangle(at, b, c);
    }
    return bvh_of_world();
}

/* Random triangles and tiles of all sizes: each pixel's result equals a test of every triangle. */
static void every_triangle(void)
{
    test_rng r = {77};
    int occluded = 0, open = 0, wrong = 0;
    for (int scene = 0; scene < 12; ++scene) {
        lmb_bvh b = random_triangles(&r, scene);
        lmb_traversal again;
        uint32_t own[LMB_TILE_PIXELS];
        memset(&again, 0, sizeof again);
        memset(own, scene % 2 == 0 ? 0 : 0xa5, sizeof own); /* numbers of no triangle change nothing */
        for (int round = 0; round < 40; ++round) {
            lmb_tile tile;
            const lmb_vec3 at = random_point(&r, 1.5f);
            const float half = round % 2 ? 0.01f : 0.7f;
            fill_tile(&tile, random_point(&r, 1.0f), half, &r);
            const uint64_t asked = round % 3 == 0 ? ~UINT64_C(0) : (uint64_t)test_random(&r) << 21;
            const uint64_t got = occluded_fresh(&b, &tile, asked, at);
            CHECK((got & ~asked) == 0);
            CHECK(lmb_occluded_again(picked_kernels(), &again, own, &b, &tile, asked, at, noise_of(&tile, asked, at)) ==
                  got);
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                double surest = -1.0;
                for (uint32_t i = 0; i < world.count; ++i) {
                    surest = fmax(surest, crosses(world.corners[i], at, plane_vec(tile.position, k)));
                }
                if ((asked >> k & 1u) != 0 && fabs(surest) > 3e-5) {
                    const int is = (int)(got >> k & 1u);
                    wrong += is != (surest > 0.0);
                    occluded += is;
                    open += !is;
                }
            }
        }
    }
    CHECK_MSG(wrong == 0, "%d wrong", wrong);
    CHECK_MSG(occluded > 2000 && open > 2000, "%d blocked, %d open", occluded, open);
}

static uint64_t occluded_sun_seen(const lmb_bvh *b, const lmb_tile *tile, uint64_t pixels, lmb_vec3 to, int eye_kind,
                                  lmb_vec3 eye)
{
    lmb_traversal traversal;
    memset(&traversal, 0, sizeof traversal);
    traversal.eye_kind = eye_kind;
    traversal.eye = eye;
    return lmb_occluded_sun(picked_kernels(), &traversal, b, tile, pixels, to);
}

static uint64_t occluded_sun_fresh(const lmb_bvh *b, const lmb_tile *tile, uint64_t pixels, lmb_vec3 to)
{
    return occluded_sun_seen(b, tile, pixels, to, LMB_EYE_NONE, Y);
}

/* The same for directional light, sometimes along an axis, and for all kinds of eyes. */
static void every_triangle_of_suns(void)
{
    test_rng r = {78}, eyes = {79};
    int occluded = 0, open = 0, wrong = 0;
    for (int scene = 0; scene < 12; ++scene) {
        lmb_bvh b = random_triangles(&r, scene);
        for (int round = 0; round < 40; ++round) {
            lmb_tile tile;
            const lmb_vec3 any = random_point(&r, 1.0f), to = round % 7 == 0 ? Y : mul3(any, 1.0f / length3(any));
            fill_tile(&tile, random_point(&r, 1.0f), round % 2 ? 0.01f : 0.7f, &r);
            const uint64_t asked = round % 3 == 0 ? ~UINT64_C(0) : (uint64_t)test_random(&r) << 21;
            const uint64_t got = occluded_sun_seen(&b, &tile, asked, to, round % 5 % 3, random_point(&eyes, 2.0f));
            CHECK((got & ~asked) == 0);
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                const lmb_vec3 from = plane_vec(tile.position, k), end = add3(from, mul3(to, 1000.0f));
                double surest = -1.0;
                for (uint32_t i = 0; i < world.count; ++i) {
                    surest = fmax(surest, crosses(world.corners[i], from, end));
                }
                if ((asked >> k & 1u) != 0 && (surest > 0.03 || surest < -0.03)) {
                    const int is = (int)(got >> k & 1u);
                    wrong += is != (surest > 0.0);
                    occluded += is;
                    open += !is;
                }
            }
        }
    }
    CHECK_MSG(wrong == 0, "%d wrong", wrong);
    CHECK_MSG(occluded > 2000 && open > 2000, "%d blocked, %d open", occluded, open);
}

/* A finely tessellated sphere has no gaps: no point inside is visible from outside, and points on it see the light
 * above. */
static void no_gap_no_acne(void)
{
    test_rng r = {5};
    lmb_tile tile;
    uint64_t leaks = 0, acne = 0;
    world_begin(1, 1, 1);
    world_sphere(vec3(0.3f, 0.1f, -0.2f), 1.0f, 48, 96);
    lmb_bvh b = bvh_of_world();
    for (int round = 0; round < 400; ++round) {
        const lmb_vec3 out = normalize3(random_point(&r, 1.0f));
        fill_tile(&tile, vec3(0.3f, 0.1f, -0.2f), 0.3f, &r);
        leaks |= ~occluded_fresh(&b, &tile, ~UINT64_C(0), mul3(out, 4.0f));
        float(*t)[3] = world.corners[test_random(&r) % world.count];
        const lmb_vec3 a = vec3(t[0][0], t[0][1], t[0][2]), u = sub3(vec3(t[1][0], t[1][1], t[1][2]), a),
                       v = sub3(vec3(t[2][0], t[2][1], t[2][2]), a);
        const lmb_vec3 n = normalize3(sub3(add3(a, mul3(add3(u, v), 0.33f)), vec3(0.3f, 0.1f, -0.2f)));
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) { /* up to the edges */
            const float s = (float)(k % 8) / 7.0f, q = (float)(k / 8) / 7.0f * (1.0f - s);
            set_plane(tile.position, k, add3(a, add3(mul3(u, s), mul3(v, q))));
        }
        acne |= occluded_fresh(&b, &tile, ~UINT64_C(0), add3(a, mul3(n, 3.0f)));
    }
    CHECK(leaks == 0);
    CHECK(acne == 0);
}

/* An empty tree, a full one, too little memory, and triangles that no cut can separate. */
static void capacities(void)
{
    lmb_bvh b;
    lmb_tile tile;
    lmb_traversal traversal;
    test_rng r = {9};
    memset(&traversal, 0, sizeof traversal);
    world_begin(1, 1, 1);
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_bvh_init(&b, 8, memory, lmb_bvh_bytes(8)) == LMB_OK);
    CHECK(lmb_bvh_build(&b, &world.scene) == LMB_OK && b.node_count == 0);
    fill_tile(&tile, vec3(0, 0, 0), 0.1f, &r);
    CHECK(occluded_fresh(&b, &tile, ~UINT64_C(0), vec3(0, 1, 0)) == 0);
    for (int i = 0; i < 9; ++i) {
        world_triangle(vec3(-1, 0.5f, -1), vec3(2, 0.5f, -1), vec3(-1, 0.5f, 2));
    }
    world.first = 0;
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_bvh_build(&b, &world.scene) == LMB_ERR_CAPACITY);
    CHECK(occluded_fresh(&b, &tile, ~UINT64_C(0), vec3(0, 1, 0)) == 0);
    CHECK(lmb_bvh_init(&b, 9, memory, lmb_bvh_bytes(9)) == LMB_OK);
    CHECK(lmb_bvh_build(&b, &world.scene) == LMB_OK && b.triangle_count == 9 && b.node_count >= 1);
    CHECK(occluded_fresh(&b, &tile, 5, vec3(0, 1, 0)) == 5);
    CHECK(lmb_occluded_tile(picked_kernels(), &traversal, NULL, &tile, 5, vec3(0, 1, 0), 0.0f) == 0);
    CHECK(lmb_occluded_tile(NULL, &traversal, &b, &tile, 5, vec3(0, 1, 0), 0.0f) == 0);
    CHECK(lmb_occluded_tile(picked_kernels(), &traversal, &b, NULL, 5, vec3(0, 1, 0), 0.0f) == 0);
    CHECK(lmb_occluded_tile(picked_kernels(), NULL, &b, &tile, 5, vec3(0, 1, 0), 0.0f) == 0);
    CHECK(lmb_bvh_init(&b, 9, memory, lmb_bvh_bytes(9) - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_bvh_init(&b, 9, (char *)memory + 1, sizeof memory - 1) == LMB_ERR_ALIGN);
    CHECK(lmb_bvh_init(&b, 0, memory, sizeof memory) == LMB_ERR_ARG);
    CHECK(lmb_bvh_build(NULL, &world.scene) == LMB_ERR_ARG);
}

/* Groups of five triangles far apart need more nodes than there are: the rest lies in large boxes, with the same
 * results. The results do not depend on the blockers found before, right or wrong. */
static void few_nodes(void)
{
    test_rng r = {31};
    int wrong = 0, occluded = 0, other = 0;
    lmb_traversal traversal;
    memset(&traversal, 0, sizeof traversal);
    world_begin(1, 1, 1);
    for (int i = 0; i < 256; ++i) { /* a grid: 16 in each box of the root, one in each of theirs */
        const lmb_vec3 at = vec3((float)(i % 16) / 8.0f - 1.0f, (float)(i / 16) / 8.0f - 1.0f, 0.0f);
        for (int k = 0; k < 5; ++k) {
            world_triangle(add3(at, random_point(&r, 0.05f)), add3(at, random_point(&r, 0.05f)),
                           add3(at, random_point(&r, 0.05f)));
        }
    }
    lmb_bvh b = bvh_of_world(), all = b;
    CHECK_MSG(b.node_count == b.node_cap, "%u of %u nodes", (unsigned)b.node_count, (unsigned)b.node_cap);
    static lmb_boxes one; /* one box around all triangles */
    all.node = &one;
    memset(&one, 0, sizeof one);
    for (int i = 0; i < LMB_BOXES; ++i) {
        for (int c = 0; c < 3; ++c) {
            one.low[c][i] = i == 0 ? -9.0f : 3e38f;
            one.high[c][i] = i == 0 ? 9.0f : -3e38f;
        }
    }
    one.count[0] = b.triangle_count;
    for (int round = 0; round < 60; ++round) {
        lmb_tile tile;
        const lmb_vec3 at = random_point(&r, 1.5f);
        fill_tile(&tile, random_point(&r, 1.0f), round % 2 ? 0.01f : 0.7f, &r);
        const uint64_t got = occluded_fresh(&b, &tile, ~UINT64_C(0), at);
        wrong += got != occluded_fresh(&all, &tile, ~UINT64_C(0), at);
        traversal.first = (uint32_t)round * 13 % (b.triangle_count + 1);
        other += got != lmb_occluded_tile(picked_kernels(), &traversal, &b, &tile, ~UINT64_C(0), at,
                                          noise_of(&tile, ~UINT64_C(0), at));
        occluded += got != 0 && ~got != 0;
    }
    CHECK_MSG(wrong == 0 && other == 0 && occluded > 10, "%d and %d of 60 wrong, %d mixed", wrong, other, occluded);
    CHECK(traversal.last[0] != 0);
}

/* A masked triangle blocks only where it is opaque. */
static void holes(void)
{
    static const uint8_t half_open[8] = {255, 255, 255, 255, 255, 255, 255, 0};
    lmb_tile tile;
    memset(&tile, 0, sizeof tile);
    world_begin(1, 1, 1);
    world.texture.texels = half_open;
    world.texture.width = 2;
    world.texture.height = 1;
    world.texture.levels = 1;
    world.material[0].texture = 0;
    world.material[0].flags |= LMB_ALPHA_MASK;
    world.material[0].alpha_cutoff = 0.5f;
    world_quad(vec3(0, 1, 0), Z, X);
    lmb_bvh b = bvh_of_world();
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_plane(tile.position, k,
                  vec3(0.5f * ((float)(k % 8) - 3.5f) / 4.0f, 0, 0.9f * ((float)(k / 8) - 3.5f) / 4.0f));
    }
    /* From above, points of the plane are over the pixels; u increases with z. */
    const uint64_t occluded = occluded_fresh(&b, &tile, ~UINT64_C(0), vec3(0, 1000, 0));
    CHECK_MSG(occluded == UINT64_C(0xffffffff), "%08x%08x", (unsigned)(occluded >> 32), (unsigned)occluded);
    CHECK(occluded_sun_fresh(&b, &tile, ~UINT64_C(0), Y) == occluded);
    CHECK(occluded_sun_fresh(&b, &tile, ~UINT64_C(0), mul3(Y, -1)) == 0);
}

/* Fully transparent triangles are left out, whether by the texture, the visible part of it, or their vertex alpha. */
static void all_hole(void)
{
    static const uint8_t half_clear[8 * 4 * 4] = {
#define CLEAR 9, 9, 9, 100
#define SOLID 9, 9, 9, 255
        SOLID, CLEAR, CLEAR, CLEAR, CLEAR, CLEAR, CLEAR, SOLID, SOLID, CLEAR, CLEAR, CLEAR, CLEAR, CLEAR, CLEAR, SOLID,
        SOLID, CLEAR, CLEAR, CLEAR, CLEAR, CLEAR, CLEAR, SOLID, SOLID, CLEAR, CLEAR, CLEAR, CLEAR, CLEAR, CLEAR, SOLID};
    static const struct {
        float low, high, alpha;
        uint32_t left;
    } row[] = {{0.45f, 0.55f, 1.0f, 0}, {0.05f, 0.55f, 1.0f, 2}, {1.45f, 1.55f, 1.0f, 0}, {0.0f, 1.0f, 1.0f, 2},
               {0.0f, 1.0f, 0.4f, 0},   {0.0f, 0.1f, 1.0f, 2},   {0.45f, 1.55f, 1.0f, 2}, {-0.55f, -0.45f, 1.0f, 0}};
    for (size_t i = 0; i < sizeof row / sizeof *row; ++i) {
        world_begin(1, 1, 1);
        world.texture.texels = half_clear;
        world.texture.width = 8;
        world.texture.height = 4;
        world.texture.levels = 1;
        world.texture.filter = LMB_BILINEAR;
        world.material[0].texture = 0;
        world.material[0].flags |= LMB_ALPHA_MASK;
        world.material[0].alpha = row[i].alpha;
        world.material[0].alpha_cutoff = 0.5f;
        world_quad(vec3(0, 1, 0), Z, X);
        for (uint32_t k = 0; k < 6; ++k) {
            world.uvs[k / 3][k % 3][0] = world.uvs[k / 3][k % 3][0] > 0.5f ? row[i].high : row[i].low;
        }
        const lmb_bvh b = bvh_of_world();
        CHECK_MSG(b.triangle_count == row[i].left, "row %d: %u", (int)i, (unsigned)b.triangle_count);
    }
}

/* A star of slivers; and one in a room. */
static void open_star(test_rng *r, int needles)
{
    world_begin(1, 1, 1);
    for (int i = 0; i < needles; ++i) {
        const lmb_vec3 far = mul3(normalize3(random_point(r, 1.0f)), 0.9f), wide = random_point(r, 0.002f);
        world_triangle(mul3(far, -1.0f), add3(far, wide), sub3(far, wide));
    }
}

static void star(test_rng *r, int needles)
{
    open_star(r, needles);
    for (int axis = 0; axis < 3; ++axis) {
        const lmb_vec3 at[3] = {X, Y, Z};
        world_quad(at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3]);
        world_quad(mul3(at[axis], -1.0f), at[(axis + 2) % 3], at[(axis + 1) % 3]);
    }
}

/* Points on slivers in a closed room: walls block them all and are found before all slivers have been tested. */
static void walls_before_needles(void)
{
    test_rng r = {91};
    lmb_traversal traversal;
    int open = 0;
    star(&r, 2000);
    lmb_bvh b = bvh_of_world();
    memset(&traversal, 0, sizeof traversal);
    for (int round = 0; round < 20; ++round) {
        lmb_tile tile;
        fill_tile(&tile, vec3(0, 0, 0), 0.5f, &r);
        open += ~lmb_occluded_sun(picked_kernels(), &traversal, &b, &tile, ~UINT64_C(0),
                                  normalize3(random_point(&r, 1.0f))) != 0;
    }
    CHECK(open == 0);
    CHECK_MSG(traversal.asked < 20 * 200, "%u boxes", (unsigned)traversal.asked);
}

/* A few pixels far apart among leaves: together they test no more boxes than one by one, with the same results. */
static void far_apart_among_leaves(void)
{
    test_rng r = {81};
    uint32_t together = 0, alone = 0;
    int other = 0, occluded = 0;
    world_begin(1, 1, 1);
    for (int i = 0; i < 5000; ++i) {
        const lmb_vec3 at = random_point(&r, 1.0f);
        world_triangle(at, add3(at, random_point(&r, 0.03f)), add3(at, random_point(&r, 0.03f)));
    }
    lmb_bvh b = bvh_of_world();
    for (int round = 0; round < 200; ++round) {
        const uint64_t asked = 0x1010008004002u; /* five */
        const lmb_vec3 at = random_point(&r, 1.0f);
        lmb_tile tile;
        lmb_traversal traversal;
        uint64_t each = 0;
        fill_tile(&tile, vec3(0, 0, 0), 1.0f, &r);
        const float noise = noise_of(&tile, asked, at);
        memset(&traversal, 0, sizeof traversal);
        const uint64_t all = lmb_occluded_tile(picked_kernels(), &traversal, &b, &tile, asked, at, noise);
        together += traversal.asked;
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            memset(&traversal, 0, sizeof traversal);
            each |= lmb_occluded_tile(picked_kernels(), &traversal, &b, &tile, asked & (uint64_t)1 << k, at, noise);
            alone += traversal.asked;
        }
        other += all != each;
        occluded += all != 0;
    }
    CHECK_MSG(other == 0 && occluded > 50, "%d others, %d blocked", other, occluded);
    CHECK_MSG(together <= alone, "%u boxes together, %u alone", (unsigned)together, (unsigned)alone);
}

/* A whole tile among leaves: its pyramid is abandoned, and later points trace one segment per pixel, with the same
 * results. */
static void wide_among_leaves(void)
{
    test_rng r = {82};
    lmb_tile tile;
    lmb_traversal kept;
    int other = 0, alone = 0, blocked = 0;
    world_begin(1, 1, 1);
    for (int i = 0; i < 5000; ++i) {
        const lmb_vec3 at = random_point(&r, 1.0f);
        world_triangle(at, add3(at, random_point(&r, 0.03f)), add3(at, random_point(&r, 0.03f)));
    }
    lmb_bvh b = bvh_of_world();
    fill_tile(&tile, vec3(0, 0, 0), 1.0f, &r);
    memset(&kept, 0, sizeof kept);
    for (int round = 0; round < 40; ++round) {
        const lmb_vec3 at = random_point(&r, 1.0f);
        const float noise = noise_of(&tile, ~UINT64_C(0), at);
        uint64_t each = 0;
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            lmb_traversal traversal;
            memset(&traversal, 0, sizeof traversal);
            each |= lmb_occluded_tile(picked_kernels(), &traversal, &b, &tile, (uint64_t)1 << k, at, noise);
        }
        alone += kept.alone > 0;
        other += each != lmb_occluded_tile(picked_kernels(), &kept, &b, &tile, ~UINT64_C(0), at, noise);
        blocked += each != 0;
    }
    CHECK_MSG(other == 0 && blocked > 20, "%d others, %d blocked", other, blocked);
    CHECK_MSG(alone > 20, "%d points traced alone at once", alone);
}

/* From a point near the tile, or towards infinity along the direction from the origin to the point. */
static uint64_t trace(const lmb_bvh *b, const lmb_tile *tile, uint64_t pixels, lmb_vec3 at, int is_sun,
                      lmb_traversal *kept)
{
    return is_sun ? lmb_occluded_sun(picked_kernels(), kept, b, tile, pixels, normalize3(at))
                  : lmb_occluded_tile(picked_kernels(), kept, b, tile, pixels, at, noise_of(tile, pixels, at));
}

/* Far from the origin boxes overlap, and a single pixel would meet nearly all of them. After the first such pixel all
 * are therefore traced together: the box tests stay near those of one pixel, with the same results. */
static void overlapping_boxes(void)
{
    test_rng r = {83};
    const lmb_vec3 away = vec3(1e6f, 1e6f, 1e6f);
    lmb_tile tile;
    world_begin(1, 1, 1);
    for (int i = 0; i < 6000; ++i) {
        const lmb_vec3 at = add3(away, random_point(&r, 1.0f));
        world_triangle(at, add3(at, random_point(&r, 0.2f)), add3(at, random_point(&r, 0.2f)));
    }
    const lmb_bvh b = bvh_of_world();
    fill_tile(&tile, away, 1.0f, &r);
    for (int is_sun = 0; is_sun < 2; ++is_sun) {
        uint32_t together = 0, alone = 0;
        int other = 0, open = 0;
        for (int round = 0; round < 20; ++round) {
            const lmb_vec3 way = random_point(&r, 1.0f);
            lmb_traversal kept;
            uint64_t each = 0;
            memset(&kept, 0, sizeof kept);
            const uint64_t all = trace(&b, &tile, ~UINT64_C(0), add3(away, way), is_sun, &kept);
            together += kept.asked;
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                memset(&kept, 0, sizeof kept);
                each |= trace(&b, &tile, (uint64_t)1 << k, add3(away, way), is_sun, &kept);
                alone += kept.asked;
            }
            other += count_bits_64(all ^ each);
            open += count_bits_64(~each);
        }
        /* A sun's rays allow for the rounding of all requested pixels, so single pixels can differ. */
        CHECK_MSG(other <= is_sun * open / 16 && open > 200, "%d others, %d open", other, open);
        CHECK_MSG(together < alone / 8, "%u boxes together, %u alone", (unsigned)together, (unsigned)alone);
    }
}

/* Returns whether a pixel `below` a square that is `away` along an axis is shadowed by light from above. */
static int is_under(int axis, float away, float depth, float below)
{
    const lmb_vec3 axes[3] = {X, Y, Z}, at = mul3(axes[axis], away), up = axes[(axis + 1) % 3];
    lmb_tile tile;
    world_begin(1, 1, 1);
    world_quad(at, mul3(axes[axis], 0.5f), mul3(axes[(axis + 2) % 3], 0.5f));
    lmb_bvh b = bvh_of_world();
    b.noise = 0.0f; /* as in a convex room */
    memset(&tile, 0, sizeof tile);
    set_plane(tile.position, 5, sub3(at, mul3(up, below)));
    tile.depth[5] = depth;
    return occluded_sun_fresh(&b, &tile, 1u << 5, up) != 0;
}

/* A surface does not shadow a pixel that rounding put below it: up to 2^-22 of the largest coordinate plus 2^-20 of the
 * distance from the eye. Pixels further below are shadowed. */
static void rounding_of_suns(void)
{
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = -1; side <= 1; side += 2) {
            const float away = (float)side * 1024.0f, place = 0x1p-12f, way = 0x1p-10f;
            CHECK(!is_under(axis, away, 0.0f, 0.9f * place) && is_under(axis, away, 0.0f, 1.1f * place));
            CHECK(!is_under(axis, away, 1024.0f, 0.9f * (place + way)));
            CHECK(is_under(axis, away, 1024.0f, 1.1f * (place + way)));
        }
        CHECK(!is_under(axis, 0.0f, 1024.0f, 0x1.ep-11f) && is_under(axis, 0.0f, 1024.0f, 0x1.2p-10f));
    }
}

/* Boxes extend beyond their contents on each side, so that rounding does not make a segment along a face miss. */
static void boxes_are_wider(void)
{
    test_rng r = {5};
    const lmb_bvh b = random_triangles(&r, 1);
    const float least = 0x1p-19f * largest3(sub3(world.scene.bounds_max, world.scene.bounds_min));
    CHECK(b.node_count > 0);
    lmb_vec3 low = vec3(1e9f, 1e9f, 1e9f), high = vec3(-1e9f, -1e9f, -1e9f);
    for (int i = 0; i < LMB_BOXES; ++i) {
        if (b.node[0].low[0][i] <= b.node[0].high[0][i]) { /* not a free one */
            low = min3(low, vec3(b.node[0].low[0][i], b.node[0].low[1][i], b.node[0].low[2][i]));
            high = max3(high, vec3(b.node[0].high[0][i], b.node[0].high[1][i], b.node[0].high[2][i]));
        }
    }
    const lmb_vec3 below = sub3(world.scene.bounds_min, low), past = sub3(high, world.scene.bounds_max);
    /* A box of a part of the scene grows by a share of the part's size: here at least an eighth of it, and 2^-20 of the
     * coordinates. */
    CHECK_MSG(minf(below.x, minf(below.y, below.z)) > least / 8 && minf(past.x, minf(past.y, past.z)) > least / 8,
              "%g %g %g, %g %g %g", (double)below.x, (double)below.y, (double)below.z, (double)past.x, (double)past.y,
              (double)past.z);
}

/* --- the tree ----------------------------------------------------------------------------------------------------- */

/* Facts about a tree: nodes, leaves that hold each triangle, the largest leaf, triangles outside their boxes. */
typedef struct tree_facts {
    uint8_t in_leaves[WORLD_TRIANGLES];
    uint32_t nodes, largest, outside;
} tree_facts;

/* Returns whether a triangle's corners are in a box. */
static int is_in(const lmb_boxes *node, int i, const lmb_bvh_triangle *t)
{
    int in = 1;
    for (int k = 0; k < 3; ++k) {
        const float at[3] = {t->corner[k].x, t->corner[k].y, t->corner[k].z};
        for (int c = 0; c < 3; ++c) {
            in = in && node->low[c][i] < at[c] && at[c] < node->high[c][i];
        }
    }
    return in;
}

/* Returns the levels from a node down and checks that each box above a triangle contains it. */
static uint32_t walk_tree(tree_facts *f, const lmb_bvh *b, uint32_t at, const lmb_boxes *above[], const int in[],
                          int deep)
{
    uint32_t levels = 0;
    ++f->nodes;
    for (int i = 0; i < LMB_BOXES && deep < LMB_TRAVERSAL_LEVELS; ++i) {
        const lmb_boxes *node = &b->node[at];
        const lmb_boxes *way[LMB_TRAVERSAL_LEVELS];
        int box[LMB_TRAVERSAL_LEVELS];
        for (int k = 0; k < deep; ++k) {
            way[k] = above[k];
            box[k] = in[k];
        }
        way[deep] = node;
        box[deep] = i;
        if (node->low[0][i] > node->high[0][i]) {
            continue;
        }
        if (node->count[i] == 0) {
            const uint32_t below = walk_tree(f, b, node->first[i], way, box, deep + 1);
            levels = below > levels ? below : levels;
        }
        for (uint32_t k = 0; k < node->count[i]; ++k) {
            ++f->in_leaves[node->first[i] + k];
            for (int up = 0; up <= deep; ++up) {
                f->outside += !is_in(way[up], box[up], &b->triangle[node->first[i] + k]);
            }
        }
        f->largest = node->count[i] > f->largest ? node->count[i] : f->largest;
    }
    return levels + 1;
}

/* The tree holds every triangle once, in each box above it, in leaves of up to four unless the nodes ran out. */
static uint32_t check_tree(const char *name, uint32_t dropped)
{
    static tree_facts f;
    static uint8_t seen[WORLD_TRIANGLES + 1];
    const lmb_bvh b = bvh_of_world();
    uint32_t wrong = 0, not_once = 0;
    memset(&f, 0, sizeof f);
    memset(seen, 0, sizeof seen);
    CHECK_MSG(b.triangle_count == world.count - dropped && b.node_count > 0, "%s: %u triangles, %u nodes", name,
              (unsigned)b.triangle_count, (unsigned)b.node_count);
    const uint32_t levels = walk_tree(&f, &b, 0, NULL, NULL, 0);
    for (uint32_t i = 0; i < b.triangle_count; ++i) {
        const lmb_bvh_triangle *t = &b.triangle[i];
        const uint32_t id = t->id & ~LMB_BVH_MASKED;
        not_once += f.in_leaves[i] != 1 || seen[id]++ != 0;
        wrong += id == 0 || id > world.count || memcmp(t->corner, world.corners[id - 1], sizeof t->corner) != 0 ||
                 !(absf(length3(t->normal) - 1.0f) < 1e-5f);
    }
    CHECK_MSG(not_once == 0 && wrong == 0 && f.outside == 0, "%s: %u not once, %u wrong, %u outside", name,
              (unsigned)not_once, (unsigned)wrong, (unsigned)f.outside);
    CHECK_MSG(f.nodes == b.node_count && (f.largest <= 4 || b.node_count == b.node_cap),
              "%s: %u nodes of %u, a leaf of %u", name, (unsigned)f.nodes, (unsigned)b.node_count, (unsigned)f.largest);
    return levels;
}

static void small_triangle(lmb_vec3 at, float size, test_rng *r)
{
    world_triangle(at, add3(at, random_point(r, size)), add3(at, random_point(r, size)));
}

/* All in one place, in a row, one far away, slivers, and at the limit of coordinates. */
static void hostile_trees(void)
{
    test_rng r = {101};
    uint32_t levels;
    world_begin(1, 1, 1);
    for (int i = 1; i <= 9000; ++i) { /* one centre, different sizes: no bin separates them */
        const float s = (float)i;
        world_triangle(vec3(-s, -s, 0), vec3(s, -s, 0), vec3(0, s, 0));
    }
    CHECK_MSG((levels = check_tree("one middle", 0)) <= 4, "%u levels", (unsigned)levels);
    world_begin(1, 1, 1);
    for (int i = 0; i < 9000; ++i) {
        world_triangle(vec3(1, 2, 3), vec3(2, 2, 3), vec3(1, 4, 3));
    }
    CHECK_MSG((levels = check_tree("one triangle", 0)) <= 4, "%u levels", (unsigned)levels);
    world_begin(1, 1, 1);
    for (int i = 0; i < 9000; ++i) { /* a dense speck, and a few at the limits of the world */
        const float far = i % 3000 == 1 ? 1e6f : 0.0f;
        small_triangle(add3(vec3(i & 1 ? far : -far, far, 0), random_point(&r, 1e-3f)), far > 0.0f ? 9.0f : 1e-3f, &r);
    }
    CHECK_MSG((levels = check_tree("a speck", 0)) <= 8, "%u levels", (unsigned)levels);
    world_begin(1, 1, 1);
    for (int i = 0; i < 9000; ++i) { /* clusters, each a quarter of the one before: the largest box is cut first */
        float s = 5e5f;
        for (int k = 0; k < i % 30; ++k) {
            s *= 0.25f;
        }
        small_triangle(vec3(s, s, s), 0.5f * s, &r);
    }
    CHECK_MSG((levels = check_tree("by quarters", 0)) == LMB_TRAVERSAL_LEVELS, "%u levels", (unsigned)levels);
    world_begin(1, 1, 1);
    for (int i = 0; i < 3000; ++i) {
        const lmb_vec3 at = random_point(&r, 1e6f), long_way = random_point(&r, 1e4f);
        world_triangle(at, add3(at, long_way), add3(at, add3(long_way, random_point(&r, 1.0f))));
    }
    CHECK_MSG((levels = check_tree("needles", 0)) <= 8, "%u levels", (unsigned)levels);
    world_begin(1, 1, 1);
    for (int i = 0; i < 64; ++i) { /* a third has no area, a third lies out of bounds */
        const lmb_vec3 at = random_point(&r, 1.0f), far = vec3(2e6f, 0, 0);
        world_triangle(at, add3(at, X), i % 3 == 0 ? add3(at, mul3(X, 2)) : i % 3 == 1 ? far : add3(at, Y));
    }
    world.scene.bounds_max = vec3(1, 1, 1);
    check_tree("left out", 43);
    world_begin(1, 1, 1);
    small_triangle(vec3(0, 0, 0), 1.0f, &r);
    CHECK(check_tree("one", 0) == 1);
}

/* Every machine builds this tree bit for bit: a hash of boxes and ids. A wider cut or another order changes the
 * hash. */
static void one_tree_everywhere(void)
{
    test_rng r = {103};
    uint32_t hash = 2166136261u;
    world_begin(1, 1, 1);
    for (int i = 0; i < 2000; ++i) {
        small_triangle(random_point(&r, i % 5 == 0 ? 10.0f : 1.0f), i % 7 == 0 ? 1.0f : 0.05f, &r);
    }
    const lmb_bvh b = bvh_of_world();
    for (uint32_t i = 0; i < b.node_count; ++i) {
        uint32_t word[sizeof *b.node / 4];
        memcpy(word, &b.node[i], sizeof word);
        for (size_t k = 0; k < sizeof word / 4; ++k) {
            hash = (hash ^ word[k]) * 16777619u;
        }
    }
    for (uint32_t i = 0; i < b.triangle_count; ++i) {
        hash = (hash ^ b.triangle[i].id) * 16777619u;
    }
    CHECK_MSG(hash == 0x3be78654u, "%08x", (unsigned)hash);
}

/* More triangles than 16 bits count: eight stacks in a row keep their ids, each at the position of its instance. */
static void many_ids(void)
{
    enum { EACH = 9000, STACKS = 8, ALL = EACH * STACKS };
    test_rng r = {105};
    lmb_instance stack[STACKS];
    lmb_bvh b;
    const size_t bytes = lmb_bvh_bytes(ALL);
    void *room = malloc(bytes);
    uint8_t *seen = calloc(ALL + 1, 1);
    uint32_t wrong = 0;
    world_begin(1, 1, 1);
    for (int i = 0; i < EACH; ++i) {
        small_triangle(random_point(&r, 1.0f), 0.05f, &r);
    }
    CHECK(world_end() == LMB_OK && room != NULL && seen != NULL);
    lmb_scene scene = world.scene;
    for (uint32_t i = 0; i < STACKS; ++i) {
        stack[i] = world.instance[0];
        stack[i].to_world.m[12] = 4.0f * (float)i;
        stack[i].first_id = 1 + EACH * i;
    }
    scene.instances = stack;
    scene.instance_count = STACKS;
    CHECK(lmb_bvh_init(&b, ALL, room, bytes) == LMB_OK && lmb_bvh_build(&b, &scene) == LMB_OK);
    for (uint32_t i = 0; i < b.triangle_count; ++i) {
        const uint32_t id = b.triangle[i].id, own = (id - 1) % EACH, at = (id - 1) / EACH;
        if (id == 0 || id > ALL || seen[id]++ != 0) {
            ++wrong;
        } else {
            wrong += b.triangle[i].corner[0].x != world.corners[own][0][0] + 4.0f * (float)at;
        }
    }
    CHECK_MSG(b.triangle_count == ALL && wrong == 0, "%u triangles, %u wrong", (unsigned)b.triangle_count,
              (unsigned)wrong);
    free(seen);
    free(room);
}

/* Five triangles in two crossing pairs: no axis plane gives the best cut. The tree's boxes are those of the pairs. */
static void few_by_every_cut(void)
{
    world_begin(1, 1, 1);
    for (int i = 0; i < 6; ++i) { /* three long, thin ones along x at y = 0 and three along y at x = 0, centres mixed */
        const float at = 0.01f * (float)(i / 2);
        if (i & 1) {
            world_triangle(vec3(at, -5, at), vec3(at, 5, at), vec3(at + 0.001f, 5, at));
        } else {
            world_triangle(vec3(-5, at, at), vec3(5, at, at), vec3(5, at + 0.001f, at));
        }
    }
    world.count = 5;
    const lmb_bvh b = bvh_of_world();
    CHECK(b.node_count == 1);
    int boxes = 0;
    for (int i = 0; i < LMB_BOXES; ++i) {
        if (b.node[0].count[i] > 0) {
            const int wide = b.node[0].high[0][i] - b.node[0].low[0][i] > 9.0f,
                      high = b.node[0].high[1][i] - b.node[0].low[1][i] > 9.0f;
            CHECK_MSG(wide != high, "box %d holds both kinds", i);
            ++boxes;
        }
    }
    CHECK_MSG(boxes >= 2, "%d boxes", boxes);
}

/* A room's planes accept points behind them up to the rounding bound, a quarter of N in hull.c, and no more. */
static void hull_is_tight(void)
{
    lmb_hull hull;
    world_begin(1, 1, 1);
    world_box(vec3(0, 0, 0), 1.0f);
    CHECK(world_end() == LMB_OK);
    lmb_hull_find(&hull, &world.scene);
    const float n = 0x1p-18f + 0x1p-21f;
    CHECK(hull.count == 6 && hull.slack <= 0.25f * n && hull.slack >= 0.24f * n);
    CHECK(lmb_hull_holds(&hull, vec3(0, -1.0f - 0.2f * n, 0)) && !lmb_hull_holds(&hull, vec3(0, -1.0f - 0.5f * n, 0)));
    CHECK(!lmb_hull_holds(&hull, vec3(1.0f + 0.5f * n, 0, 0)) && lmb_hull_holds(&hull, vec3(1, 1, 1)));
}

/* Traces many points in one traversal from an initial budget and returns a hash of the blocked pixels. */
static uint64_t by_points(const lmb_kernels *kernels, lmb_traversal *t, const lmb_bvh *b, int is_sun, int is_bounded)
{
    enum { CALLS = 200 };
    test_rng r = {17};
    lmb_tile tile;
    uint64_t hash = 0;
    fill_tile(&tile, vec3(0, 0, 0), 0.3f, &r);
    memset(t, 0, sizeof *t);
    t->bounded = is_bounded;
    t->left = LMB_TRAVERSAL_FIRST;
    for (int i = 0; i < CALLS; ++i) {
        const lmb_vec3 at = random_point(&r, 0.3f);
        hash = hash * 31 + (is_sun ? lmb_occluded_sun(kernels, t, b, &tile, ~UINT64_C(0), normalize3(at))
                                   : lmb_occluded_tile(kernels, t, b, &tile, ~UINT64_C(0), at,
                                                       noise_of(&tile, ~UINT64_C(0), at)));
    }
    const uint32_t first = is_sun ? LMB_TRAVERSAL_SUN_FIRST : LMB_TRAVERSAL_FIRST,
                   call = is_sun ? 65 * LMB_TRAVERSAL_SUN_EACH : 65 * LMB_TRAVERSAL_EACH + LMB_TRAVERSAL_COARSE,
                   most = 2 * first + CALLS * call;
    CHECK_MSG(!is_bounded || t->spent <= most, "%u tests", (unsigned)t->spent);
    CHECK_MSG((t->coarse > 0) <= (t->spent + CALLS > first), "%u coarse", (unsigned)t->coarse);
    return hash;
}

/* A bounded traversal stays within its tests, counts the coarse calls, and gives the same result on every backend. With
 * few triangles it equals an unbounded one. */
static void bounded_tests(void)
{
    for (int is_sun = 0; is_sun < 2; ++is_sun) {
        for (int many = 0; many < 2; ++many) {
            test_rng r = {29};
            lmb_traversal whole, bound, plain;
            open_star(&r, many ? 9000 : 40);
            const lmb_bvh b = bvh_of_world();
            const uint64_t free_hash = by_points(picked_kernels(), &whole, &b, is_sun, 0);
            const uint64_t hash = by_points(picked_kernels(), &bound, &b, is_sun, 1);
            CHECK(by_points(lmb_kernels_named("scalar"), &plain, &b, is_sun, 1) == hash);
            CHECK(plain.spent == bound.spent && plain.coarse == bound.coarse && whole.coarse == 0);
            CHECK(many || (hash == free_hash && bound.spent == whole.spent && bound.coarse == 0));
            CHECK_MSG(!many || (bound.coarse > 0 && bound.spent < whole.spent), "%u coarse, %u of %u tests",
                      (unsigned)bound.coarse, (unsigned)bound.spent, (unsigned)whole.spent);
        }
    }
}

void test_occlusion(void)
{
    bounded_tests();
    boxes_are_wider();
    hull_is_tight();
    hostile_trees();
    one_tree_everywhere();
    many_ids();
    few_by_every_cut();
    far_apart_among_leaves();
    wide_among_leaves();
    overlapping_boxes();
    rounding_of_suns();
    every_triangle();
    every_triangle_of_suns();
    no_gap_no_acne();
    capacities();
    few_nodes();
    holes();
    all_hole();
    walls_before_needles();
}
