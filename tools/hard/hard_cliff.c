/* hard_cliff.c: scenes that need far more visibility tests than a room with as many triangles, also randomly rotated.
 * Tests are counted, not timed. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hard.h"

#define PI 3.14159265358979323846

enum { NEEDLES, PLANES, SPECKS, BALLS, HAIR, SLIVERS, ALL_HOLES, HALF_HOLES, SCENES, ROOM = SCENES, STACK };
enum { TRIANGLES = 2000, MANY = 12000, CALLS = 100, MANY_CALLS = 300, BOXES = TRIANGLES / 12, SIDE = 4 };
enum { PICTURE = 16 /* px a side */, MAP = 256 };

/* A random rotation, or the identity. */
typedef struct frame {
    dvec x, y, z;
} frame;

/* The counts: tests per call, and calls with coarse visibility. */
typedef struct counted {
    double each;
    uint32_t coarse;
} counted;

static dvec unit(uint64_t *rng)
{
    const double z = hard_uniform(rng, -1, 1), a = hard_uniform(rng, 0, 2 * PI), s = sqrt(1 - z * z);
    return dvec_of(s * cos(a), s * sin(a), z);
}

static dvec place(uint64_t *rng, double half)
{
    const double x = hard_uniform(rng, -half, half), y = hard_uniform(rng, -half, half);
    return dvec_of(x, y, hard_uniform(rng, -half, half));
}

static dvec turned(const frame *f, dvec v)
{
    return dvec_add(dvec_add(dvec_mul(f->x, v.x), dvec_mul(f->y, v.y)), dvec_mul(f->z, v.z));
}

static frame frame_of(int is_turned, uint64_t *rng)
{
    frame f = {dvec_of(1, 0, 0), dvec_of(0, 1, 0), dvec_of(0, 0, 1)};
    if (is_turned) {
        f.x = unit(rng);
        f.y = dvec_unit(dvec_cross(f.x, unit(rng)));
        f.z = dvec_cross(f.x, f.y);
    }
    return f;
}

/* Adds triangle i of TRIANGLES. */
static void put_triangle(hard_stage *s, int scene, int i, const frame *f, uint64_t *rng)
{
    const dvec d = unit(rng), at = place(rng, 1), e = dvec_mul(unit(rng), scene == SPECKS ? 0.005 : 0.002);
    const double a = PI * (i / 2) / (TRIANGLES / 2), x = cos(a), y = sin(a), turn = 2 * PI * i / (TRIANGLES / 8);
    const dvec along = dvec_of(0.6, 0.5, 0.4), pole = dvec_of(0, 0, 0.8 + 0.02 * (i % 8));
    const dvec side = dvec_of(0.3 * cos(turn), 0.3 * sin(turn), 0);
    switch (scene) {
    case NEEDLES:
        hard_triangle(s, turned(f, dvec_mul(d, -1)), turned(f, dvec_add(d, e)), turned(f, dvec_sub(d, e)));
        break;
    case PLANES:
        hard_triangle(s, turned(f, dvec_of(-x, -y, -1)), turned(f, dvec_of(x, y, i & 1 ? 1 : -1)),
                      turned(f, i & 1 ? dvec_of(-x, -y, 1) : dvec_of(x, y, 1)));
        break;
    case HAIR: /* parallel, oblique to all boxes */
        hard_triangle(s, turned(f, dvec_sub(dvec_mul(at, 0.5), along)),
                      turned(f, dvec_add(dvec_add(dvec_mul(at, 0.5), along), e)),
                      turned(f, dvec_sub(dvec_add(dvec_mul(at, 0.5), along), e)));
        break;
    case SLIVERS: /* eight nested balls, of strips from pole to pole */
        hard_triangle(s, turned(f, dvec_sub(side, pole)), turned(f, dvec_add(side, pole)),
                      turned(f, dvec_add(dvec_mul(side, 1.01), pole)));
        break;
    default:
        hard_triangle(s, turned(f, at), turned(f, dvec_add(at, e)), turned(f, dvec_add(at, dvec_mul(d, 0.005))));
    }
}

static void put_scene(hard_stage *s, int scene, int count, const frame *f, uint64_t *rng)
{
    for (int i = 0; i < (scene == BALLS ? 40 : 0); ++i) {
        hard_ball(s, turned(f, dvec_mul(unit(rng), 0.5)), 0.4, 5);
    }
    for (int i = 0; i < (scene == ROOM ? BOXES : 0); ++i) {
        const double deep = hard_uniform(rng, 0.05, 0.2); /* not in the call, whose arguments have no order */
        hard_box(s, turned(f, place(rng, 1.4)), dvec_of(0.05, 0.1, deep));
    }
    for (int i = 0; i < (scene == ALL_HOLES || scene == HALF_HOLES ? count / 2 : 0); ++i) {
        const dvec d = unit(rng), e = dvec_unit(dvec_cross(d, unit(rng)));
        hard_quad(s, turned(f, place(rng, 0.1)), turned(f, d), turned(f, e));
    }
    for (int i = 0; i < (scene == STACK ? count / 2 : 0); ++i) {
        hard_quad(s, turned(f, dvec_of(0.001 * (i % 1000) - 0.5, 0, 0)), turned(f, dvec_of(0, 1, 0)),
                  turned(f, dvec_of(0, 0, 1)));
    }
    for (int i = 0; i < (scene <= SPECKS || scene == HAIR || scene == SLIVERS ? count : 0); ++i) {
        put_triangle(s, scene, i, f, rng);
    }
}

/* The scene in a closed box, which is another part; is_open: without the box. */
static int make_scene(hard_stage *s, int scene, int count, int is_open, const frame *f, uint64_t *rng)
{
    static uint8_t texels[4 * SIDE * SIDE];
    hard_begin(s, 0.5);
    put_scene(s, scene, count, f, rng);
    if (scene == ALL_HOLES || scene == HALF_HOLES || scene == STACK) {
        hard_holes(s, 0, texels, SIDE);
        for (int i = 0; i < SIDE * SIDE && scene == ALL_HOLES; ++i) {
            texels[4 * i + 3] = 0;
        }
    }
    if (!is_open) {
        (void)hard_part(s, 0.5);
        hard_box(s, dvec_of(0, 0, 0), dvec_of(2, 2, 2));
    }
    return hard_end(s);
}

static void put_tile(hard_stage *s)
{
    memset(&s->tile, 0, sizeof s->tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        s->tile.position[0][k] = 1.5f + 0.02f * (float)(k % 8);
        s->tile.position[1][k] = 0.02f * (float)(k / 8);
    }
}

static int make_bvh(lmb_bvh *b, void **memory, const hard_stage *s)
{
    const size_t bytes = lmb_bvh_bytes(s->count);
    *memory = malloc(bytes + 1);
    return *memory != NULL && bytes > 0 && lmb_bvh_init(b, s->count, *memory, bytes) == LMB_OK &&
           lmb_bvh_build(b, &s->scene) == LMB_OK;
}

/* Tests points around a small tile with one traversal; `bounded` as for a tile of a picture. */
static counted ask(hard_stage *s, const lmb_bvh *b, lmb_traversal *t, int bounded, int calls, uint64_t *rng)
{
    counted r = {HUGE_VAL, 0};
    put_tile(s);
    memset(t, 0, sizeof *t);
    t->bounded = bounded;
    t->left = LMB_TRAVERSAL_FIRST;
    for (int i = 0; i < calls; ++i) {
        const lmb_vec3 to = {-1.5f, (float)hard_uniform(rng, -1.5, 1.5), (float)hard_uniform(rng, -1.5, 1.5)};
        (void)lmb_occluded_tile(s->kernels, t, b, &s->tile, ~UINT64_C(0), to, 1e-6f);
    }
    r.each = (double)t->spent / calls;
    r.coarse = t->coarse;
    return r;
}

static counted tests(hard_stage *s, int scene, int is_turned, int bounded)
{
    uint64_t rng = 41;
    lmb_bvh b;
    counted r = {HUGE_VAL, 0};
    lmb_traversal *t = malloc(sizeof *t);
    const frame f = frame_of(is_turned, &rng);
    void *memory = NULL;
    if (t != NULL && make_scene(s, scene, bounded ? MANY : TRIANGLES, 0, &f, &rng) && make_bvh(&b, &memory, s)) {
        r = ask(s, &b, t, bounded, bounded ? MANY_CALLS : CALLS, &rng);
    }
    free(memory);
    free(t);
    return r;
}

/* The same of rays to the points of a slow curve at infinity. *wrong: share of pixels with another answer than without
 * a bound. */
static counted sun_tests(hard_stage *s, double *wrong, int scene)
{
    uint64_t rng = 41;
    lmb_bvh b;
    counted r = {HUGE_VAL, 0};
    lmb_traversal *t = calloc(2, sizeof *t);
    const frame f = frame_of(0, &rng);
    void *memory = NULL;
    *wrong = HUGE_VAL;
    if (t != NULL && make_scene(s, scene, scene == ROOM ? MANY : TRIANGLES, scene != ROOM, &f, &rng) &&
        make_bvh(&b, &memory, s)) {
        put_tile(s);
        t[0].bounded = 1;
        t[0].left = LMB_TRAVERSAL_FIRST;
        *wrong = 0;
        for (int i = 0; i < MANY_CALLS; ++i) {
            const double a = PI * i / MANY_CALLS, y = 0.6 * cos(a), z = 0.6 * sin(a);
            const dvec d = dvec_unit(dvec_of(-1, y, z));
            const lmb_vec3 to = {(float)d.x, (float)d.y, (float)d.z};
            uint64_t dark[2] = {0, 0};
            for (int k = 0; k < 2; ++k) {
                dark[k] = lmb_occluded_sun(s->kernels, &t[k], &b, &s->tile, ~UINT64_C(0), to);
            }
            for (uint64_t bits = dark[0] ^ dark[1]; bits != 0; bits &= bits - 1) {
                *wrong += 1.0 / (LMB_TILE_PIXELS * MANY_CALLS);
            }
        }
        r.each = (double)t->spent / MANY_CALLS;
        r.coarse = t->coarse;
    }
    free(memory);
    free(t);
    return r;
}

/* Bounced light of a small picture: the pixels times the nodes that light them, and the segments tested. */
static double picture_work(hard_stage *s, int scene)
{
    uint64_t rng = 41;
    const frame f = frame_of(1, &rng);
    const uint64_t before = s->stats.pairs + s->stats.segments;
    if (!make_scene(s, scene, TRIANGLES, 0, &f, &rng)) {
        return HUGE_VAL;
    }
    hard_point(s, dvec_of(0.3, 1.7, 0.2), 10.0);
    hard_end(s);
    hard_look(s, dvec_of(0.3, 0.2, 1.8), dvec_of(0.3, 0.2, 0), 70.0, PICTURE);
    return hard_frame(s, LMB_SHOW_INDIRECT, MAP, 0.02f) == LMB_OK
               ? (double)(s->stats.pairs + s->stats.segments - before)
               : HUGE_VAL;
}

/* Each pixel of needles lies on another surface and needs a separate cut. */
static void put_pictures(hard_list *list)
{
    static const struct {
        int scene;
        const char *name;
        double bound;
    } row[] = {{NEEDLES, "2,000 needles: light and visibility of a picture, of a room's", 0.6},
               {HAIR, "2,000 hairs: light and visibility of a picture, of a room's", 0.425},
               {HALF_HOLES, "1,000 quads with holes: light and visibility of a picture, of a room's", 0.12}};
    const double room = picture_work(list->stage, ROOM);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; ++i) {
        hard_put(list, HARD_MEASURED, row[i].name, hard_share(picture_work(list->stage, row[i].scene), room),
                 row[i].bound, "times");
    }
}

void hard_cliff(hard_list *list)
{
    static const char *const name[SCENES][2] = {
        {"2,000 needles through a point: tests, of a room's", "2,000 needles, turned"},
        {"1,000 planes through a line: tests, of a room's", "1,000 planes, turned"},
        {"2,000 specks: tests, of a room's", "2,000 specks, turned"},
        {"40 balls in one another: tests, of a room's", "40 balls, turned"},
        {"2,000 parallel hairs: tests, of a room's", "2,000 hairs, turned"},
        {"balls of 2,000 slivers: tests, of a room's", "2,000 slivers, turned"},
        {"1,000 quads, entirely holes: tests, of a room's", "1,000 quads of holes, turned"},
        {"1,000 quads with holes: tests, of a room's", "1,000 quads with holes, turned"}};
    static const double bound[SCENES] = {420, 8, 1.5, 2, 350, 33, 0.1, 17};
    for (int turn = 0; turn < 2; ++turn) {
        const double room = tests(list->stage, ROOM, turn, 0).each;
        for (int i = 0; i < SCENES; ++i) {
            hard_put(list, HARD_MEASURED, name[i][turn], hard_share(tests(list->stage, i, turn, 0).each, room),
                     bound[i], "times");
        }
    }
    const double limit = 2.0 * LMB_TRAVERSAL_FIRST / MANY_CALLS + LMB_TRAVERSAL_COARSE;
    hard_put(list, HARD_BOUNDED, "12,000 needles: tests a call of a bounded tile",
             tests(list->stage, NEEDLES, 1, 1).each, limit, "tests");
    hard_put(list, HARD_BOUNDED, "12,000 hairs: tests a call of a bounded tile", tests(list->stage, HAIR, 1, 1).each,
             limit, "tests");
    hard_put(list, HARD_BOUNDED, "12,000 triangles with holes, 1 mm apart: tests a call of a bounded tile",
             tests(list->stage, STACK, 0, 1).each, limit, "tests");
    hard_put(list, HARD_EXACT, "a room: coarse calls of a bounded tile", (double)tests(list->stage, ROOM, 1, 1).coarse,
             0, "calls");
    double wrong;
    const double sun_limit = 2.0 * LMB_TRAVERSAL_SUN_FIRST / MANY_CALLS + 65 * LMB_TRAVERSAL_SUN_EACH;
    hard_put(list, HARD_BOUNDED, "2,000 triangles with holes, 1 mm apart: tests of rays to a sun",
             sun_tests(list->stage, &wrong, STACK).each, sun_limit, "tests");
    hard_put(list, HARD_MEASURED, "the same: rays with another answer than without a bound", wrong, 0.05, "of all");
    hard_put(list, HARD_EXACT, "a room: coarse rays to a sun", (double)sun_tests(list->stage, &wrong, ROOM).coarse, 0,
             "calls");
    hard_put(list, HARD_EXACT, "a room: rays to a sun with another answer than without a bound", wrong, 0, "of all");
    put_pictures(list);
}
