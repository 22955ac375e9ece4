/* test_search_bounds.c: searches for free space and lines of sight in a bake have a bounded number of tests in any
 * scene. */
#include "../test.h"

#include <string.h>

#include "../../src/base/vec.h"
#include "../../src/occlusion/traversal.h"
#include "../../tools/bake/bake.h"
#include "../../tools/play/play_space.h"

void test_search_bounds(void);

enum { FEW = 30, MANY = 9000, CALLS = 500, PLACES = 16 };

/* Slivers through the origin. */
typedef struct star {
    float corner[9 * MANY];
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    lmb_scene scene;
} star;

static lmb_vec3 random_point(test_rng *r, float half)
{
    const float x = test_uniform(r, -half, half), y = test_uniform(r, -half, half);
    return vec3(x, y, test_uniform(r, -half, half));
}

static void put(float *out, lmb_vec3 v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

static void open_star(star *s, uint32_t needles, test_rng *r)
{
    memset(s, 0, sizeof *s);
    for (uint32_t i = 0; i < needles; ++i) {
        const lmb_vec3 end = mul3(normalize3(random_point(r, 1.0f)), 2.0f), side = random_point(r, 0.002f);
        put(s->corner + 9 * i, mul3(end, -1.0f));
        put(s->corner + 9 * i + 3, add3(end, side));
        put(s->corner + 9 * i + 6, sub3(end, side));
    }
    s->mesh.positions = s->corner;
    s->mesh.vertex_count = 3 * needles;
    s->mesh.triangle_count = needles;
    s->material.texture = -1;
    s->material.alpha = 1.0f;
    s->material.flags = LMB_DOUBLE_SIDED;
    for (int i = 0; i < 4; ++i) {
        s->instance.to_world.m[5 * i] = 1.0f;
    }
    s->instance.first_id = 1;
    s->scene.meshes = &s->mesh;
    s->scene.materials = &s->material;
    s->scene.instances = &s->instance;
    s->scene.mesh_count = s->scene.material_count = s->scene.instance_count = 1;
    lmb_scene_bounds(&s->scene.bounds_min, &s->scene.bounds_max, &s->scene);
}

static void holds_bound(const char *what, const lmb_traversal *t, uint32_t calls, uint32_t places, uint32_t needles)
{
    const uint32_t most = 2 * LMB_TRAVERSAL_FIRST +
                          calls * ((1 + places) * LMB_TRAVERSAL_EACH + LMB_TRAVERSAL_COARSE);
    CHECK_MSG(t->spent <= most, "%s: %u tests, at most %u", what, (unsigned)t->spent, (unsigned)most);
    CHECK_MSG((t->coarse > 0) == (needles == MANY), "%s, %u needles: %u coarse calls", what, (unsigned)needles,
              (unsigned)t->coarse);
}

/* A search by play: paths from a point between the slivers to places around it, and visible distances from there. */
static void space_is_bounded(star *s, uint32_t needles, test_rng *r)
{
    play_space space;
    report why = {""};
    CHECK_MSG(play_space_make(&space, &s->scene, lmb_kernels_pick(), &why), "%s", why.text);
    for (int i = 0; i < CALLS; ++i) {
        lmb_vec3 place[PLACES];
        for (int k = 0; k < PLACES; ++k) {
            place[k] = random_point(r, 0.3f);
        }
        (void)play_space_sees(&space, random_point(r, 0.3f), place, PLACES);
    }
    holds_bound("play", &space.traversal, CALLS, PLACES, needles);
    play_space_free(&space);
}

/* The lines of sight of one bake step, which counts them at its end. */
static void sights_are_bounded(star *s, uint32_t needles, test_rng *r)
{
    play_space space;
    bake_sight sight;
    bake b;
    uint32_t coarse = 0;
    report why = {""};
    memset(&b, 0, sizeof b);
    CHECK(play_space_make(&space, &s->scene, lmb_kernels_pick(), &why) && bake_sight_begin(&sight, &why));
    b.bvh = space.bvh;
    b.kernels = space.kernels;
    b.coarse = &coarse;
    b.set.smallest_m = 0.01f;
    for (int i = 0; i < 4 * CALLS; ++i) {
        const lmb_vec3 from = random_point(r, 0.2f);
        (void)bake_sees(&sight, &b, from, random_point(r, 0.2f), vec3(0, 1, 0));
    }
    holds_bound("bake", &sight.traversal, 4 * CALLS, 1, needles);
    const uint32_t counted = sight.traversal.coarse;
    bake_sight_end(&sight, &b);
    CHECK(coarse == counted);
    play_space_free(&space);
}

/* A tile whose budget of sun rays is spent repeats the last answer. A pixel that was asked then gets its own answer. Any
 * other pixel gets the answer of the next asked one, in the order of the tile and around. */
static void spent_suns_repeat(void)
{
    static lmb_bvh bvh;
    static lmb_tile tile;
    lmb_traversal t;
    memset(&t, 0, sizeof t);
    t.bounded = 1;
    t.sun_spent = 0x10000000;
    t.sun_asked = (uint64_t)1 << 2 | (uint64_t)1 << 10 | (uint64_t)1 << 40;
    t.sun_dark = (uint64_t)1 << 2 | (uint64_t)1 << 10;
    bvh.node_count = 1;
    const uint64_t all = ~(uint64_t)0, dark = lmb_occluded_sun(lmb_kernels_pick(), &t, &bvh, &tile, all, vec3(0, 1, 0));
    CHECK_MSG(dark == (0x7ff | all << 41), "%#llx", (unsigned long long)dark);
    CHECK(lmb_occluded_sun(lmb_kernels_pick(), &t, &bvh, &tile, 0x900, vec3(0, 1, 0)) == 0x100);
    CHECK(t.coarse == 2 && t.spent == 0);
    t.sun_asked = 0; /* nothing was asked: nothing is dark */
    t.sun_dark = 0;
    CHECK(lmb_occluded_sun(lmb_kernels_pick(), &t, &bvh, &tile, all, vec3(0, 1, 0)) == 0 && t.coarse == 3);
}

void test_search_bounds(void)
{
    spent_suns_repeat();
    static star s;
    for (int many = 0; many < 2; ++many) {
        test_rng r = {57};
        const uint32_t needles = many ? MANY : FEW;
        open_star(&s, needles, &r);
        space_is_bounded(&s, needles, &r);
        sights_are_bounded(&s, needles, &r);
    }
}
