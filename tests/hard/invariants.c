/* invariants.c: what must not matter to a picture, over random scenes: the back end, the order of triangles, whole
 * pixels, powers of two, left and right, what no path meets, and how a surface is cut into triangles.
 *
 * Thread counts and slices are tests/golden/main_orders.c's. A failure names its scene: its number is its seed. */
#include <math.h>
#include <string.h>

#include "hard_test.h"

enum { SIDE = 32, MAP = 64, SCENES = 1 + 5 / HARD_FEWER, TRIANGLES = 100 / HARD_FEWER };
enum { FLAT = HARD_SIDE, HALF = FLAT / 2 };

static float first[SIDE * SIDE * 3];

/* --- random scenes ------------------------------------------------------------------------------------------------ */

static dvec somewhere(uint64_t *rng, double reach)
{
    return dvec_of(hard_uniform(rng, -reach, reach), hard_uniform(rng, 0.1, 2.0), hard_uniform(rng, -reach, reach));
}

/* Corners in steps of 2^-10 m, so that powers of two and mirrors are exact. */
static dvec on_grid(dvec v)
{
    return dvec_mul(dvec_of(floor(v.x * 1024), floor(v.y * 1024), floor(v.z * 1024)), 1.0 / 1024);
}

static void add_random(hard_stage *s, uint64_t *rng)
{
    hard_quad(s, dvec_of(0, 0, 0), dvec_of(2, 0, 0), dvec_of(0, 0, -2));
    hard_quad(s, dvec_of(0, 1.5, -2), dvec_of(2, 0, 0), dvec_of(0, 1.5, 0));
    for (int i = 0; i < 3; ++i) {
        hard_box(s, on_grid(somewhere(rng, 1.5)), dvec_of(0.125, 0.25, 0.1875));
    }
    for (int i = 0; i < 20; ++i) {
        const dvec at = somewhere(rng, 1.5);
        hard_triangle(s, on_grid(at), on_grid(dvec_add(at, hard_direction(rng))),
                      on_grid(dvec_add(at, dvec_mul(hard_direction(rng), 0.5))));
    }
}

/* Lit by each kind of light in turn. */
static void light_random(hard_stage *s, uint64_t *rng, int kind)
{
    const dvec at = on_grid(dvec_of(hard_uniform(rng, -1, 1), 2.875, hard_uniform(rng, 0, 1)));
    if (kind == 0) {
        hard_spot(s, at, on_grid(somewhere(rng, 0.5)), 40.0, 16.0);
    } else if (kind == 1) {
        hard_point(s, at, 8.0);
    } else {
        hard_sun(s, dvec_of(hard_uniform(rng, -0.5, 0.5), -1, hard_uniform(rng, -0.8, 0)), 2.0);
    }
}

static void make_scene(hard_stage *s, int number)
{
    uint64_t rng = (uint64_t)number + 1;
    hard_begin(s, 0.5);
    add_random(s, &rng);
    light_random(s, &rng, number % 3);
    CHECK_MSG(hard_end(s), "scene %d is refused", number);
    hard_look(s, dvec_of(0.75, 1.5, 3.5), dvec_of(0, 0.75, 0), 55.0, SIDE);
}

static double unlike(const hard_stage *s, double times)
{
    double n = 0.0;
    for (int i = 0; i < SIDE * SIDE * 3; ++i) {
        n += (double)s->out[i] != (double)first[i] * times;
    }
    return n;
}

static double sum_of(const float *v)
{
    double sum = 0.0;
    for (int i = 0; i < SIDE * SIDE * 3; ++i) {
        sum += (double)v[i];
    }
    return sum;
}

static void draw_first(hard_stage *s)
{
    CHECK(hard_frame(s, LMB_SHOW_FULL, MAP, 0.05f) == LMB_OK);
    memcpy(first, s->out, sizeof first);
    CHECK(sum_of(first) > 0.0);
}

static void check_same(hard_stage *s, int number, const char *what)
{
    CHECK(hard_frame(s, LMB_SHOW_FULL, MAP, 0.05f) == LMB_OK);
    const double n = unlike(s, 1.0);
    CHECK_MSG(n == 0.0, "scene %d, %s: %g values differ", number, what, n);
}

/* --- whole frames ------------------------------------------------------------------------------------------------- */

static void back_ends(hard_stage *s, int number)
{
    const lmb_kernels *best = s->kernels;
    for (int32_t i = 0; lmb_kernels_at(i) != NULL; ++i) {
        s->kernels = lmb_kernels_at(i);
        check_same(s, number, lmb_kernels_name(s->kernels));
    }
    s->kernels = best;
}

/* A black box inside a box that nothing sees into; the bounds stay. */
static void black_object(hard_stage *s, int number)
{
    const float *c = s->corner[4][0];
    dvec low = dvec_read(c), high = low;
    for (int i = 0; i < 36; ++i) {
        const dvec p = dvec_read(s->corner[4 + i / 3][i % 3]);
        low = dvec_of(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        high = dvec_of(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    hard_part(s, 0.0);
    hard_box(s, dvec_mix(low, high, 0.5), dvec_of(0.03125, 0.03125, 0.03125));
    CHECK(hard_end(s));
    check_same(s, number, "a black box inside a box");
}

/* Scene and distances times 2^k, light times 2^2k (a sun's not at all): the same radiance. */
static void powers_of_two(hard_stage *s, int number, int k)
{
    make_scene(s, number);
    for (uint32_t i = 0; i < 9 * s->count; ++i) {
        float *v = &s->corner[i / 9][i / 3 % 3][i % 3];
        *v = (float)ldexp((double)*v, k);
    }
    const int sun = s->light.kind == LMB_LIGHT_DIRECTIONAL;
    s->light.position.x = (float)ldexp((double)s->light.position.x, k);
    s->light.position.y = (float)ldexp((double)s->light.position.y, k);
    s->light.position.z = (float)ldexp((double)s->light.position.z, k);
    for (int c = 0; c < 3; ++c) {
        s->light.intensity[c] = (float)ldexp((double)s->light.intensity[c], sun ? 0 : 2 * k);
    }
    s->view.eye.x = (float)ldexp((double)s->view.eye.x, k);
    s->view.eye.y = (float)ldexp((double)s->view.eye.y, k);
    s->view.eye.z = (float)ldexp((double)s->view.eye.z, k);
    s->view.near_m = (float)ldexp((double)s->view.near_m, k);
    CHECK(hard_end(s));
    check_same(s, number, k > 0 ? "everything larger" : "everything smaller");
}

static void brighter(hard_stage *s, int number)
{
    make_scene(s, number);
    for (int c = 0; c < 3; ++c) {
        s->light.intensity[c] *= 1024.0f;
    }
    CHECK(hard_end(s));
    CHECK(hard_frame(s, LMB_SHOW_FULL, MAP, 0.05f) == LMB_OK);
    CHECK_MSG(unlike(s, 1024.0) == 0.0, "scene %d: %g values", number, unlike(s, 1024.0));
}

/* Triangles in another order: the same depths, and the same triangle where two do not lie equally deep. */
static void triangle_order(hard_stage *s, int number)
{
    static uint32_t depth[SIDE * SIDE], id[SIDE * SIDE];
    make_scene(s, number);
    hard_draw(s, 0, UINT32_MAX);
    memcpy(depth, s->depth, sizeof depth);
    memcpy(id, s->id, sizeof id);
    for (uint32_t i = 0; i < s->count / 2; ++i) {
        float other[3][3];
        memcpy(other, s->corner[i], sizeof other);
        memcpy(s->corner[i], s->corner[s->count - 1 - i], sizeof other);
        memcpy(s->corner[s->count - 1 - i], other, sizeof other);
    }
    CHECK(hard_end(s));
    hard_draw(s, 0, UINT32_MAX);
    int apart = 0, another = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        apart += depth[i] != s->depth[i];
        another += (id[i] != 0) != (s->id[i] != 0) || (id[i] != 0 && id[i] + s->id[i] != s->count + 1);
    }
    CHECK_MSG(apart == 0 && another == 0, "scene %d: %d depths, %d ids", number, apart, another);
}

/* --- triangles on the screen, in 1/256 px ------------------------------------------------------------------------- */

typedef struct place {
    int64_t x, y;
} place;

static place random_place(uint64_t *rng)
{
    const int64_t reach = 24 << 8, step = hard_random(rng) & 1u ? 1 : 64; /* many on centres and rims */
    place p;
    p.x = ((int64_t)(hard_random(rng) % (uint32_t)(2 * reach)) - reach) / step * step;
    p.y = ((int64_t)(hard_random(rng) % (uint32_t)(2 * reach)) - reach) / step * step;
    return p;
}

static void put(hard_stage *s, place a, place b, place c)
{
    const dvec z = {0, 0, -1.5};
    hard_triangle(s, dvec_add(z, dvec_of((double)a.x / 256, -(double)a.y / 256, 0)),
                  dvec_add(z, dvec_of((double)b.x / 256, -(double)b.y / 256, 0)),
                  dvec_add(z, dvec_of((double)c.x / 256, -(double)c.y / 256, 0)));
}

/* How often each pixel is covered by the triangles of the scene, each by itself. */
static void count_cover(uint8_t out[FLAT * FLAT], hard_stage *s)
{
    hard_end(s);
    memset(out, 0, FLAT * FLAT);
    for (uint32_t t = 0; t < s->count; ++t) {
        hard_draw(s, t, 1);
        for (int32_t i = 0; i < FLAT * FLAT; ++i) {
            out[i] = (uint8_t)(out[i] + (s->id[hard_at(s, i % FLAT, i / FLAT)] != 0));
        }
    }
}

/* Is a pixel's centre on the line of an edge? */
static int on_edge(const place t[3], int32_t x, int32_t y)
{
    const int64_t px = ((int64_t)x - HALF) * 256 + 128, py = ((int64_t)y - HALF) * 256 + 128;
    int on = 0;
    for (int i = 0; i < 3; ++i) {
        const place *a = &t[i], *b = &t[(i + 1) % 3];
        on |= (b->x - a->x) * (py - a->y) == (b->y - a->y) * (px - a->x);
    }
    return on;
}

static void mirrors(hard_stage *s, uint64_t *rng)
{
    static uint8_t cover[FLAT * FLAT], turned[FLAT * FLAT];
    const place t[3] = {random_place(rng), random_place(rng), random_place(rng)};
    int differ = 0;
    hard_begin(s, 1.0);
    put(s, t[0], t[1], t[2]);
    count_cover(cover, s);
    hard_begin(s, 1.0);
    put(s, (place){-t[0].x, t[0].y}, (place){-t[1].x, t[1].y}, (place){-t[2].x, t[2].y});
    count_cover(turned, s);
    for (int32_t i = 0; i < FLAT * FLAT; ++i) {
        const int32_t x = i % FLAT, y = i / FLAT;
        differ += cover[i] != turned[y * FLAT + FLAT - 1 - x] && !on_edge(t, x, y);
    }
    CHECK_MSG(differ == 0, "%d pixels on no edge", differ);
}

/* By whole pixels, up and down, left and right. */
static void moves(hard_stage *s, uint64_t *rng)
{
    static uint8_t cover[FLAT * FLAT], moved[FLAT * FLAT];
    const place t[3] = {random_place(rng), random_place(rng), random_place(rng)};
    const int32_t dx = (int32_t)(hard_random(rng) % 15) - 7, dy = (int32_t)(hard_random(rng) % 15) - 7;
    int differ = 0;
    hard_begin(s, 1.0);
    put(s, t[0], t[1], t[2]);
    count_cover(cover, s);
    hard_begin(s, 1.0);
    put(s, (place){t[0].x + 256 * dx, t[0].y + 256 * dy}, (place){t[1].x + 256 * dx, t[1].y + 256 * dy},
        (place){t[2].x + 256 * dx, t[2].y + 256 * dy});
    count_cover(moved, s);
    for (int32_t i = 0; i < FLAT * FLAT; ++i) {
        const int32_t x = i % FLAT + dx, y = i / FLAT + dy;
        differ += x >= 0 && y >= 0 && x < FLAT && y < FLAT && cover[i] != moved[y * FLAT + x];
    }
    CHECK_MSG(differ == 0, "%d pixels", differ);
}

/* In three at a point inside, and in two at the middle of an edge where that is on the grid. */
static void splits(hard_stage *s, uint64_t *rng)
{
    static uint8_t cover[FLAT * FLAT], parts[FLAT * FLAT];
    place t[3] = {random_place(rng), random_place(rng), random_place(rng)};
    for (int i = 0; i < 3; ++i) {
        t[i].x &= ~(int64_t)1, t[i].y &= ~(int64_t)1;
    }
    const place inside = {(t[0].x + t[1].x + t[2].x) / 3, (t[0].y + t[1].y + t[2].y) / 3},
                middle = {(t[0].x + t[1].x) / 2, (t[0].y + t[1].y) / 2};
    hard_begin(s, 1.0);
    put(s, t[0], t[1], t[2]);
    count_cover(cover, s);
    hard_begin(s, 1.0);
    for (int i = 0; i < 3; ++i) {
        put(s, inside, t[i], t[(i + 1) % 3]);
    }
    count_cover(parts, s);
    /* A centre of gravity that was rounded leaves a sliver, so the thinnest are left out. */
    const int64_t area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
    CHECK((area > -65536 && area < 65536) || memcmp(cover, parts, sizeof cover) == 0);
    hard_begin(s, 1.0);
    put(s, t[0], middle, t[2]);
    put(s, middle, t[1], t[2]);
    count_cover(parts, s);
    CHECK(memcmp(cover, parts, sizeof cover) == 0);
}

void hard_invariants(hard_stage *s)
{
    uint64_t rng = 7;
    for (int i = 0; i < SCENES; ++i) {
        make_scene(s, i);
        draw_first(s);
        back_ends(s, i);
        black_object(s, i);
        powers_of_two(s, i, 2);
        powers_of_two(s, i, -3);
        brighter(s, i);
        triangle_order(s, i);
    }
    hard_look_flat(s, FLAT);
    for (int i = 0; i < TRIANGLES; ++i) {
        mirrors(s, &rng);
        moves(s, &rng);
        splits(s, &rng);
    }
}
