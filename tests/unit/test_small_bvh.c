/* test_small_bvh.c: a BVH of small nodes blocks the same segments as one of large nodes, and its boxes contain their
 * triangles. */
#include "../world.h"

#include "../../src/lane/kernels.h"
#include "../../src/live/live_part.h"
#include "../../src/occlusion/small.h"
#include "../../src/occlusion/traversal.h"

void test_small_bvh(void);

enum { SCENES = 60, PACKETS = 40 };

static uint64_t wide_memory[1 << 18], small_memory[1 << 14];
static lmb_live_scratch small_scratch, wide_scratch;
static lmb_bvh wide, small;

/* --- scenes ------------------------------------------------------------------------------------------------------- */

static lmb_vec3 within(test_rng *r, float half)
{
    const float x = test_uniform(r, -half, half), y = test_uniform(r, -half, half);
    return vec3(x, y, test_uniform(r, -half, half));
}

/* A room with loose triangles, needles, boxes and a mesh, at a place and of a size that differ from scene to scene. */
static void random_scene(int number, test_rng *r)
{
    static const float sizes[4] = {1.0f, 0.01f, 300.0f, 20.0f};
    const float size = sizes[number % 4];
    const lmb_vec3 middle = number % 3 == 0 ? vec3(0, 0, 0) : within(r, number % 3 == 1 ? 5.0f * size : 200.0f * size);
    const int loose = number % 5 == 0 ? 0 : (int)(test_random(r) % 200);
    world_begin(0.5f, 0.5f, 0.5f);
    world_box(middle, size);
    for (int i = 0; i < loose; ++i) {
        const lmb_vec3 at = add3(middle, within(r, size));
        const float extent = test_uniform(r, 0.001f, i % 4 == 0 ? 1.0f : 0.2f) * size;
        lmb_vec3 u = within(r, extent), v = within(r, i % 7 == 0 ? 0.01f * extent : extent);
        u.y = i % 3 == 0 ? 0.0f : u.y; /* flat along an axis */
        v.y = i % 3 == 0 ? 0.0f : v.y;
        world_triangle(at, add3(at, u), add3(at, v));
    }
    for (int i = 0; i < number % 4; ++i) {
        world_box(add3(middle, within(r, 0.8f * size)), test_uniform(r, 0.01f, 0.2f) * size);
    }
    for (int i = 0; i < number % 7 * 20; ++i) { /* many middles in one place */
        const lmb_vec3 u = within(r, 0.3f * size);
        world_triangle(add3(middle, u), sub3(middle, u), add3(middle, vec3(u.y, 0.0f, 0.0f)));
    }
    CHECK(world_end() == LMB_OK);
}

static void build_both(void)
{
    CHECK(lmb_bvh_bytes(world.count) <= sizeof wide_memory && lmb_bvh_small_bytes(world.count) <= sizeof small_memory);
    CHECK(lmb_bvh_init(&wide, world.count, wide_memory, lmb_bvh_bytes(world.count)) == LMB_OK);
    CHECK(lmb_bvh_small_init(&small, world.count, small_memory, lmb_bvh_small_bytes(world.count)) == LMB_OK);
    CHECK(lmb_bvh_build(&wide, &world.scene) == LMB_OK && lmb_bvh_build(&small, &world.scene) == LMB_OK);
    CHECK(small.triangle_count == wide.triangle_count && small.node_count == 0);
    lmb_live_forget(&small_scratch);
    lmb_live_forget(&wide_scratch);
}

/* --- segments ----------------------------------------------------------------------------------------------------- */

static lmb_vec3 on_triangle(uint32_t i, test_rng *r, int at_corner)
{
    const float(*p)[3] = (const float(*)[3])world.corners[i];
    float s = at_corner ? 0.0f : test_uniform(r, 0.0f, 1.0f), t = at_corner ? 0.0f : test_uniform(r, 0.0f, 1.0f - s);
    s = at_corner == 2 ? 0.5f : s; /* on an edge */
    return vec3(p[0][0] + s * (p[1][0] - p[0][0]) + t * (p[2][0] - p[0][0]),
                p[0][1] + s * (p[1][1] - p[0][1]) + t * (p[2][1] - p[0][1]),
                p[0][2] + s * (p[1][2] - p[0][2]) + t * (p[2][2] - p[0][2]));
}

/* Segments from a point of the scene to others: across, along walls, and in the planes of triangles. */
static uint64_t random_packet(lmb_live_receiver *at, lmb_live_rays *rays, test_rng *r)
{
    const uint32_t own = test_random(r) % world.count;
    const lmb_vec3 eye = on_triangle(test_random(r) % world.count, r, 0);
    memset(at, 0, sizeof *at);
    memset(rays, 0, sizeof *rays);
    at->position = on_triangle(own, r, (int)(test_random(r) % 3));
    at->id = test_random(r) % 4 == 0 ? 0 : own + 1;
    at->to_eye = sub3(eye, at->position);
    at->noise = lmb_place_noise(at->position, length3(at->to_eye));
    rays->segments.at = at->position;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const uint32_t other = test_random(r) % 4 == 0 ? own : test_random(r) % world.count;
        lmb_vec3 to = sub3(on_triangle(other, r, (int)(test_random(r) % 3)), at->position);
        to.x = k % 16 == 3 ? 0.0f : to.x;
        to.y = k % 16 == 4 || k % 16 == 5 ? 0.0f : to.y;
        to.z = k % 16 == 5 ? 0.0f : to.z;
        const float d[3] = {to.x, to.y, to.z};
        for (int h = 0; h < 3; ++h) {
            rays->to[h][k] = d[h];
            rays->segments.per[h][k] = absf(d[h]) > 1e-20f ? 1.0f / d[h] : d[h] < 0.0f ? -1e20f : 1e20f;
        }
        rays->id[k] = other + 1;
    }
    return test_random(r) % 8 == 0 ? (uint64_t)test_random(r) << 32 | test_random(r) : ~(uint64_t)0;
}

static void same_segments(void)
{
    test_rng r = {77};
    uint32_t blocked = 0, open = 0;
    for (int number = 0; number < SCENES; ++number) {
        random_scene(number, &r);
        build_both();
        for (int i = 0; i < PACKETS; ++i) {
            lmb_live_receiver at;
            const uint64_t asked = random_packet(&at, &wide_scratch.rays, &r);
            small_scratch.rays = wide_scratch.rays;
            const uint64_t by_wide = lmb_live_blocked(picked_kernels(), &wide_scratch, &wide, &at, asked),
                           by_small = lmb_live_blocked(picked_kernels(), &small_scratch, &small, &at, asked);
            CHECK_MSG(by_wide == by_small, "scene %d, packet %d: %d segments differ", number, i,
                      count_bits_64(by_wide ^ by_small));
            blocked += (uint32_t)count_bits_64(by_small);
            open += (uint32_t)count_bits_64(asked & ~by_small);
        }
    }
    CHECK_MSG(blocked > 20000 && open > 20000, "%u blocked, %u open", (unsigned)blocked, (unsigned)open);
}

/* --- nodes -------------------------------------------------------------------------------------------------------- */

static int holds(const lmb_small_node *n, lmb_vec3 low, lmb_vec3 high)
{
    const float from[3] = {low.x, low.y, low.z}, to[3] = {high.x, high.y, high.z};
    int in = 1;
    for (int h = 0; h < 3; ++h) {
        in &= lmb_small_side(&small, h, n->low[h]) < from[h] && lmb_small_side(&small, h, n->high[h]) > to[h];
    }
    return in;
}

/* Checks the nodes below one. Returns the number of their triangles. */
static uint32_t check_below(uint32_t at, lmb_vec3 *low, lmb_vec3 *high)
{
    const lmb_small_node *n = &small.small[at];
    uint32_t count = n->count;
    *low = vec3(3e38f, 3e38f, 3e38f);
    *high = vec3(-3e38f, -3e38f, -3e38f);
    CHECK(at < small.small_count && n->count <= 4);
    for (uint32_t i = 0; i < n->count; ++i) {
        lmb_bvh_triangle t;
        CHECK(lmb_small_triangle(&t, &world.scene, small.small_id[n->first + i]));
        const float widened = triangle_margin(&t);
        for (int k = 0; k < 3; ++k) {
            *low = min3(*low, sub3(t.corner[k], vec3(widened, widened, widened)));
            *high = max3(*high, add3(t.corner[k], vec3(widened, widened, widened)));
        }
    }
    if (n->count == 0) {
        lmb_vec3 a, b;
        CHECK(n->first > at + 1);
        count = check_below(at + 1, low, high) + check_below(n->first, &a, &b);
        *low = min3(*low, a);
        *high = max3(*high, b);
    }
    CHECK_MSG(holds(n, *low, *high), "node %u", (unsigned)at);
    return count;
}

static void boxes_contain(void)
{
    test_rng r = {5};
    for (int number = 0; number < SCENES; ++number) {
        lmb_vec3 low, high;
        random_scene(number, &r);
        build_both();
        CHECK(check_below(0, &low, &high) == small.triangle_count && small.small_count <= world.count);
    }
}

/* Each triangle occurs once. */
static void all_triangles(void)
{
    static uint8_t seen[WORLD_TRIANGLES + 1];
    memset(seen, 0, sizeof seen);
    world_begin(0.5f, 0.5f, 0.5f);
    world_sphere(vec3(0, 1, 0), 1.0f, 48, 96);
    world_triangle(vec3(1, 1, 1), vec3(1, 1, 1), vec3(2, 2, 2)); /* without area */
    CHECK(world_end() == LMB_OK);
    build_both();
    for (uint32_t i = 0; i < small.triangle_count; ++i) {
        ++seen[small.small_id[i]];
    }
    for (uint32_t i = 0; i < wide.triangle_count; ++i) {
        CHECK(seen[wide.triangle[i].id] == 1);
    }
    CHECK(small.triangle_count == world.count - 1);
}

static void small_refusals(void)
{
    lmb_bvh b;
    CHECK(lmb_bvh_small_bytes(0) == 0 && lmb_bvh_small_bytes(65536) == 0 && lmb_bvh_small_bytes(65535) > 0);
    CHECK(lmb_bvh_small_bytes(4884) <= 4884 * 10 + 2048 + 64);
    CHECK(lmb_bvh_small_init(NULL, 9, small_memory, sizeof small_memory) == LMB_ERR_ARG);
    CHECK(lmb_bvh_small_init(&b, 9, NULL, sizeof small_memory) == LMB_ERR_ARG);
    CHECK(lmb_bvh_small_init(&b, 9, small_memory, lmb_bvh_small_bytes(9) - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_bvh_small_init(&b, 9, (uint8_t *)small_memory + 1, sizeof small_memory - 1) == LMB_ERR_ALIGN);
    CHECK(lmb_bvh_small_init(&b, world.count - 1, small_memory, sizeof small_memory) == LMB_OK);
    CHECK(lmb_bvh_build(&b, &world.scene) == LMB_ERR_CAPACITY && b.small_count == 0);
}

void test_small_bvh(void)
{
    same_segments();
    boxes_contain();
    all_triangles();
    small_refusals();
}
