/* test_probe_cache.c: when objects' cubes are recomputed, and which slots are reused. Requirements S18-S20. */
#include <lambent/lambent.h>

#include <math.h>
#include <string.h>

#include "../../src/base/vec.h"
#include "../test.h"

void test_probe_cache(void);

static lmb_probe_cache make(int32_t slots, float radius_m, int32_t every)
{
    const lmb_probe_policy policy = {radius_m, every};
    lmb_probe_cache c;
    CHECK(lmb_probe_cache_init(&c, slots, &policy) == LMB_OK);
    return c;
}

static lmb_probe_answer ask(lmb_probe_cache *c, uint32_t owner, float x, uint32_t frame)
{
    lmb_probe_answer a;
    CHECK(lmb_probe_cache_ask(&a, c, owner, vec3(x, 0.0f, 0.0f), 7u, frame) == LMB_OK);
    return a;
}

/* S18: a slowly moving object is recomputed each time it is farther than the radius from the last place. */
static void by_radius(void)
{
    lmb_probe_cache c = make(4, 0.15f, 0);
    int computed = 0;
    for (uint32_t i = 0; i <= 100; ++i) {
        const lmb_probe_answer a = ask(&c, 1, 0.01f * (float)i, i);
        CHECK(a.slot == 0 && fabsf(a.place.x - 0.01f * (float)i) <= 0.15f);
        computed += a.compute;
    }
    CHECK_MSG(computed == 7, "%d", computed); /* at 0, then every sixteenth: 0.16 .. 0.96 */
    CHECK(c.computed == 7 && c.kept == 94);
}

/* Every n frames while the object moves; if n is 0, each frame until it rests. */
static void by_time(void)
{
    lmb_probe_cache c = make(4, 100.0f, 5);
    int computed = 0;
    for (uint32_t i = 0; i < 20; ++i) {
        computed += ask(&c, 1, 0.01f * (float)(i < 10 ? i : 10), i + 0xfffffff8u).compute; /* the frame number wraps */
    }
    CHECK_MSG(computed == 3, "%d", computed); /* 0, 5, 10; at rest from then on */
    c = make(4, 0.0f, 0);
    computed = 0;
    for (uint32_t i = 0; i < 20; ++i) {
        computed += ask(&c, 1, 0.01f * (float)(i < 10 ? i : 10), i).compute;
    }
    CHECK_MSG(computed == 11, "%d", computed);
}

/* S19: a named place serves all objects near it, the nearest place first, and is computed once. S20: until the world
 * changes. */
static void named(void)
{
    lmb_probe_cache c = make(4, 1.0f, 1);
    CHECK(lmb_probe_cache_name(&c, vec3(10.0f, 0.0f, 0.0f)) == 0 && lmb_probe_cache_name(&c, vec3(11, 0, 0)) == 1);
    lmb_probe_answer a = ask(&c, 1, 10.4f, 0);
    CHECK(a.slot == 0 && a.compute && a.place.x == 10.0f);
    a = ask(&c, 2, 10.3f, 1);
    CHECK(a.slot == 0 && !a.compute && a.place.x == 10.0f);
    a = ask(&c, 2, 10.6f, 2);
    CHECK(a.slot == 1 && a.compute && a.place.x == 11.0f);
    a = ask(&c, 2, 13.0f, 3); /* out of range: a separate slot */
    CHECK(a.slot == 2 && a.compute && a.place.x == 13.0f);
    CHECK(lmb_probe_cache_ask(&a, &c, 1, vec3(10.0f, 0.0f, 0.0f), 8u, 4) == LMB_OK && a.slot == 0 && a.compute);
    CHECK(lmb_probe_cache_ask(&a, &c, 2, vec3(13.0f, 0.0f, 0.0f), 8u, 4) == LMB_OK && a.slot == 2 && a.compute);
    CHECK(lmb_probe_cache_ask(&a, &c, 2, vec3(13.0f, 0.0f, 0.0f), 8u, 5) == LMB_OK && !a.compute);
    CHECK(lmb_probe_cache_name(&c, vec3(0, 0, 0)) == 2 && lmb_probe_cache_name(&c, vec3(1, 1, 1)) == -1);
    a = ask(&c, 2, 13.0f, 6); /* the slot was reused: another one */
    CHECK(a.slot == 3 && a.compute);
}

/* If the cache is full, the slot used longest ago is replaced. */
static void full(void)
{
    lmb_probe_cache c = make(3, 1.0f, 0);
    CHECK(ask(&c, 1, 0, 0).slot == 0 && ask(&c, 2, 5, 0).slot == 1 && ask(&c, 3, 9, 1).slot == 2);
    CHECK(!ask(&c, 1, 0, 2).compute);
    lmb_probe_answer a = ask(&c, 4, 20, 3);
    CHECK(a.slot == 1 && a.compute);
    a = ask(&c, 2, 5, 4);
    CHECK(a.slot == 2 && a.compute);
    CHECK(!ask(&c, 1, 0, 5).compute && !ask(&c, 4, 20, 5).compute);
}

static void refusals(void)
{
    const lmb_probe_policy good = {0.15f, 0}, bad[] = {{-1.0f, 0}, {NAN, 0}, {0.1f, -1}};
    lmb_probe_cache c = make(2, 0.15f, 0), before = c;
    lmb_probe_answer a;
    memset(&a, 0x3c, sizeof a);
    const lmb_probe_answer same = a;
    for (int i = 0; i < 3; ++i) {
        CHECK(lmb_probe_cache_init(&c, 2, &bad[i]) == LMB_ERR_ARG);
    }
    CHECK(lmb_probe_cache_init(&c, 0, &good) == LMB_ERR_ARG && lmb_probe_cache_init(&c, 2, NULL) == LMB_ERR_ARG);
    CHECK(lmb_probe_cache_init(&c, LMB_MAX_PROBES + 1, &good) == LMB_ERR_ARG);
    CHECK(lmb_probe_cache_init(NULL, 2, &good) == LMB_ERR_ARG && lmb_probe_cache_name(NULL, vec3(0, 0, 0)) == -1);
    CHECK(lmb_probe_cache_name(&c, vec3(NAN, 0, 0)) == -1);
    CHECK(lmb_probe_cache_ask(&a, &c, 1, vec3(0, 2e6f, 0), 0, 0) == LMB_ERR_ARG);
    CHECK(lmb_probe_cache_ask(NULL, &c, 1, vec3(0, 0, 0), 0, 0) == LMB_ERR_ARG);
    CHECK(memcmp(&a, &same, sizeof a) == 0 && memcmp(&c, &before, sizeof c) == 0);
}

void test_probe_cache(void)
{
    by_radius();
    by_time();
    named();
    full();
    refusals();
}
