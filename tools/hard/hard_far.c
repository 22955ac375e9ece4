/* hard_far.c: hard cases of large, small and distant worlds: a stray triangle, other scales, a room far from the
 * origin, a house on a terrain. */
#include <math.h>
#include <string.h>

#include "hard.h"

#define PI 3.14159265358979323846

enum { SIDE = 48, PIXELS = SIDE * SIDE, MAP = 256, GRID = 44 }; /* of the terrain's pictures */
enum { ROOM = 24, ROOM_PIXELS = ROOM * ROOM, ROOM_MAP = 128 };    /* of the room's */
enum { SUN, SPOT, LAMP, KINDS };

typedef struct pictures {
    float direct[3 * ROOM_PIXELS], bounced[3 * ROOM_PIXELS];
} pictures;

/* --- one room ----------------------------------------------------------------------------------------------------- */

/* Position and size of a room. Coordinates are rounded to binary32 there, and then moved by -back. */
typedef struct place {
    dvec at, back;
    double size;
} place;

static dvec put(const place *p, double x, double y, double z)
{
    float held[3];
    dvec_write(held, dvec_add(p->at, dvec_mul(dvec_of(x, y, z), p->size)));
    return dvec_sub(dvec_of((double)held[0], (double)held[1], (double)held[2]), p->back);
}

/* Adds two triangles; the corners are in order. */
static void put_quad(hard_stage *s, dvec a, dvec b, dvec c, dvec d)
{
    hard_triangle(s, a, b, c);
    hard_triangle(s, a, c, d);
}

/* Adds a box between two corners. */
static void put_box(hard_stage *s, const place *p, dvec low, dvec high)
{
    static const int side[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    dvec c[8];
    for (int i = 0; i < 8; ++i) {
        c[i] = put(p, i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    }
    for (int i = 0; i < 6; ++i) {
        put_quad(s, c[side[i][0]], c[side[i][1]], c[side[i][2]], c[side[i][3]]);
    }
}

/* A floor, two walls and a pillar, open above, lit by a sun, a spot or a point light. */
static void put_room(hard_stage *s, const place *p, int kind)
{
    const double watts = 12.0 * p->size * p->size;
    hard_begin(s, 0.6);
    put_quad(s, put(p, -2, 0, 2), put(p, 2, 0, 2), put(p, 2, 0, -2), put(p, -2, 0, -2));
    put_quad(s, put(p, -2, 0, -2), put(p, 2, 0, -2), put(p, 2, 2.5, -2), put(p, -2, 2.5, -2));
    put_quad(s, put(p, -2, 0, 2), put(p, -2, 0, -2), put(p, -2, 2.5, -2), put(p, -2, 2.5, 2));
    put_box(s, p, dvec_of(0.1, 0.01, -0.8), dvec_of(0.7, 1.2, -0.2));
    if (kind == SUN) {
        hard_sun(s, dvec_of(-0.5, -0.7, -0.35), 3.0);
    } else if (kind == SPOT) {
        hard_spot(s, put(p, 1.5, 2.25, 1.5), put(p, -0.25, 0, -0.5), 40.0, watts);
    } else {
        hard_point(s, put(p, 1.25, 2.0, 1.0), watts);
    }
}

static void draw(pictures *out, hard_stage *s, const place *p)
{
    hard_end(s);
    hard_look(s, put(p, 1.5, 1.75, 3.5), put(p, -0.25, 0.75, -0.5), 55.0, ROOM);
    s->view.near_m = (float)(0.0625 * p->size);
    hard_frame(s, LMB_SHOW_DIRECT, ROOM_MAP, 0.002f);
    memcpy(out->direct, s->out, sizeof out->direct);
    hard_frame(s, LMB_SHOW_INDIRECT, ROOM_MAP, 0.002f);
    memcpy(out->bounced, s->out, sizeof out->bounced);
}

/* rmse / mean, %. */
static double change(const float *a, const float *b)
{
    double square = 0.0, sum = 0.0;
    for (int i = 0; i < 3 * ROOM_PIXELS; ++i) {
        square += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
        sum += (double)b[i];
    }
    return 100.0 * sqrt(square / (3 * ROOM_PIXELS)) / hard_share(sum, 3 * ROOM_PIXELS);
}

/* --- a stray triangle --------------------------------------------------------------------------------------------- */

/* Maximum change by a triangle of one centimetre at a distance of 500 m, 2 km and 100 km. */
static void stray(double worst[2], hard_stage *s, int kind, dvec way)
{
    static const double far[3] = {500.0, 2000.0, 100000.0};
    static pictures without, with;
    const place home = {{0, 0, 0}, {0, 0, 0}, 1.0};
    put_room(s, &home, kind);
    draw(&without, s, &home);
    worst[0] = worst[1] = 0.0;
    for (int i = 0; i < 3; ++i) {
        const dvec at = dvec_mul(way, far[i]);
        put_room(s, &home, kind);
        hard_triangle(s, at, dvec_add(at, dvec_of(0.01, 0, 0)), dvec_add(at, dvec_of(0, 0.01, 0)));
        draw(&with, s, &home);
        worst[0] = fmax(worst[0], change(with.direct, without.direct));
        worst[1] = fmax(worst[1], change(with.bounced, without.bounced));
    }
}

static void strays(hard_list *l)
{
    static const char *const name[KINDS] = {"a stray triangle up to 100 km off, a sun: bounced light changes by",
                                            "a spot", "a point light"};
    double direct = 0.0;
    uint64_t rng = 71;
    for (int kind = 0; kind < KINDS; ++kind) {
        double bounced = 0.0;
        for (int i = 0; i < 3; ++i) {
            double worst[2];
            /* The first one lies towards the sun and must not move the map's eye away. */
            stray(worst, l->stage, kind, i == 0 ? dvec_unit(dvec_of(0.5, 0.7, 0.351)) : hard_direction(&rng));
            direct = fmax(direct, worst[0]);
            bounced = fmax(bounced, worst[1]);
        }
        hard_put(l, HARD_MEASURED, name[kind], bounced, kind == SUN ? 1.0 : 0.01, "% rmse");
    }
    hard_put(l, HARD_BOUNDED, "direct light changes by", direct, 1e-4, "% rmse");
}

/* --- scales and places -------------------------------------------------------------------------------------------- */

/* The same room as a speck and as a mountain, with the light scaled by the area: the number of pictures that differ. */
static void scales(hard_list *l)
{
    static const double size[3] = {1.0 / 131072.0, 1.0 / 1024.0, 1024.0};
    static pictures first, other;
    double differ = 0.0;
    for (int kind = 0; kind < KINDS; ++kind) {
        const place home = {{0, 0, 0}, {0, 0, 0}, 1.0};
        put_room(l->stage, &home, kind);
        draw(&first, l->stage, &home);
        for (int i = 0; i < 3; ++i) {
            const place scaled = {{0, 0, 0}, {0, 0, 0}, size[i]};
            put_room(l->stage, &scaled, kind);
            draw(&other, l->stage, &scaled);
            differ += memcmp(first.direct, other.direct, sizeof first.direct) != 0;
            differ += memcmp(first.bounced, other.bounced, sizeof first.bounced) != 0;
        }
    }
    hard_put(l, HARD_EXACT, "2^-17, 2^-10 and 2^10 times the size: pictures that differ", differ, 0, "of 18");
}

/* 10 km from the origin coordinates are a millimetre apart, and a pixel that close to the foot of a wall may lie behind
 * it. Such pixels, with less than half or more than twice the light, are replaced from the other picture. Returns the
 * number of pixels. */
static int take_lost(float *a, const float *b)
{
    int count = 0;
    for (int i = 0; i < ROOM_PIXELS; ++i) {
        const float is = a[3 * i] + a[3 * i + 1] + a[3 * i + 2], was = b[3 * i] + b[3 * i + 1] + b[3 * i + 2];
        if (is < 0.5f * was || is > 2.0f * was) {
            memcpy(a + 3 * i, b + 3 * i, 3 * sizeof *a);
            ++count;
        }
    }
    return count;
}

/* Compares a room 10 km from the origin with one at the origin that has the same coordinate rounding. */
static void moved(hard_list *l)
{
    static pictures there, here;
    double direct = 0.0, bounced = 0.0;
    int lost = 0;
    uint64_t rng = 73;
    for (int i = 0; i < 2 * KINDS; ++i) {
        const dvec way = dvec_mul(hard_direction(&rng), 10000.0);
        const dvec at = dvec_of(floor(way.x), floor(way.y), floor(way.z));
        const place far = {at, {0, 0, 0}, 1.0}, home = {at, at, 1.0};
        put_room(l->stage, &home, i % KINDS);
        draw(&here, l->stage, &home);
        put_room(l->stage, &far, i % KINDS);
        draw(&there, l->stage, &far);
        direct = fmax(direct, change(there.direct, here.direct));
        lost += take_lost(there.bounced, here.bounced);
        bounced = fmax(bounced, change(there.bounced, here.bounced));
    }
    hard_put(l, HARD_MEASURED, "10 km from the origin: direct light changes by", direct, 4, "% rmse");
    hard_put(l, HARD_MEASURED, "bounced light changes by", bounced, 0.5, "% rmse");
    hard_put(l, HARD_MEASURED, "pixels whose bounced light is lost", lost, KINDS / 2, "of 3456");
}

/* --- a house on a terrain ----------------------------------------------------------------------------------------- */

/* Height of a 4 x 4 km terrain: flat within 300 m, with valleys beyond, below the horizon as seen from the middle. */
static double height(int x, int z)
{
    const double px = (x - GRID / 2) * 4000.0 / GRID, pz = (z - GRID / 2) * 4000.0 / GRID, r = sqrt(px * px + pz * pz);
    return r < 300.0 ? 0.0 : -30.0 * (1.0 - cos((r - 300.0) * 0.01));
}

static dvec ground(int x, int z)
{
    return dvec_of((x - GRID / 2) * 4000.0 / GRID, height(x, z), (z - GRID / 2) * 4000.0 / GRID);
}

static void put_terrain(hard_stage *s)
{
    for (int z = 0; z < GRID; ++z) {
        for (int x = 0; x < GRID; ++x) {
            put_quad(s, ground(x, z), ground(x, z + 1), ground(x + 1, z + 1), ground(x + 1, z));
        }
    }
}

/* Walls, 6 x 5 m and 3 m high, with a window of 1.2 x 1 m in the one that faces +z, and a roof. */
static void put_house(hard_stage *s)
{
    static const double x[4] = {-3, -0.6, 0.6, 3}, y[4] = {0.02, 1.2, 2.2, 3};
    for (int i = 0; i < 9; ++i) {
        const double x0 = x[i % 3], x1 = x[i % 3 + 1], y0 = y[i / 3], y1 = y[i / 3 + 1];
        if (i != 4) {
            put_quad(s, dvec_of(x0, y0, 2.5), dvec_of(x1, y0, 2.5), dvec_of(x1, y1, 2.5), dvec_of(x0, y1, 2.5));
        }
    }
    put_quad(s, dvec_of(-3, 0.02, -2.5), dvec_of(3, 0.02, -2.5), dvec_of(3, 3, -2.5), dvec_of(-3, 3, -2.5));
    put_quad(s, dvec_of(-3, 0.02, -2.5), dvec_of(-3, 0.02, 2.5), dvec_of(-3, 3, 2.5), dvec_of(-3, 3, -2.5));
    put_quad(s, dvec_of(3, 0.02, -2.5), dvec_of(3, 0.02, 2.5), dvec_of(3, 3, 2.5), dvec_of(3, 3, -2.5));
    put_quad(s, dvec_of(-3, 3, -2.5), dvec_of(3, 3, -2.5), dvec_of(3, 3, 2.5), dvec_of(-3, 3, 2.5));
    put_quad(s, dvec_of(-3, 0.02, -2.5), dvec_of(3, 0.02, -2.5), dvec_of(3, 0.02, 2.5), dvec_of(-3, 0.02, 2.5));
}

static const dvec sunward = {0.3, 0.8, 0.52};
static const double SUNLIGHT = 4.0;

/* The house, of reflectance 0.5, then the terrain. */
static void put_land(hard_stage *s, double albedo)
{
    hard_begin(s, 0.5);
    put_house(s);
    hard_part(s, albedo);
    put_terrain(s);
    hard_sun(s, dvec_mul(sunward, -1.0), SUNLIGHT);
    hard_end(s);
}

/* Pixels with direct light that differs from rays in double by over a hundredth of the sun's. */
static double wrong_direct(hard_stage *s)
{
    double wrong = 0.0;
    hard_frame(s, LMB_SHOW_DIRECT, MAP, 0.002f);
    for (int32_t i = 0; i < PIXELS; ++i) {
        const uint32_t id = s->id[hard_at(s, i % SIDE, i / SIDE)];
        dvec normal;
        if (id != 0) {
            const dvec at = hard_surface(&normal, s, i % SIDE, i / SIDE, id);
            const double want = hard_true_direct(s, at, normal, id);
            const double albedo = (double)s->material[id > s->first[1]].albedo[0];
            wrong += fabs((double)s->out[3 * i] * PI - want * albedo) > 0.01 * SUNLIGHT * albedo;
        }
    }
    return wrong;
}

/* Relative error of bounced light on the house's surfaces that face +z, where `wanted` is positive. */
static double against(hard_stage *s, double (*wanted)(dvec at, dvec normal))
{
    double square = 0.0, sum = 0.0, pixels = 0.0;
    hard_frame(s, LMB_SHOW_INDIRECT, MAP, 0.002f);
    for (int32_t i = 0; i < PIXELS; ++i) {
        const uint32_t id = s->id[hard_at(s, i % SIDE, i / SIDE)];
        dvec normal;
        if (id != 0 && id <= s->first[1]) {
            const dvec at = hard_surface(&normal, s, i % SIDE, i / SIDE, id);
            const double want = normal.z > 0.9 ? wanted(at, normal) : 0.0, got = (double)s->out[3 * i] * PI / 0.5;
            if (want > 0.0) {
                square += (got - want) * (got - want);
                sum += want;
                pixels += 1.0;
            }
        }
    }
    return 100.0 * sqrt(hard_share(square, pixels)) / hard_share(sum, pixels);
}

/* The outer wall sees lit ground in half of the hemisphere. Surfaces behind the window are skipped. */
static double from_ground(dvec at, dvec normal)
{
    (void)normal;
    return at.z < 2.0 ? 0.0 : 0.5 * 0.3 * SUNLIGHT * sunward.y / dvec_length(sunward);
}

/* The sun's patch on the floor: the window's corners projected along the sunlight. */
static double from_patch(dvec at, dvec normal)
{
    static const double window[4][2] = {{-0.6, 1.2}, {0.6, 1.2}, {0.6, 2.2}, {-0.6, 2.2}};
    dvec c[4];
    for (int i = 0; i < 4; ++i) {
        const double along = (window[i][1] - 0.02) / sunward.y;
        c[i] = dvec_sub(dvec_of(window[i][0], window[i][1], 2.5), dvec_mul(sunward, along));
    }
    return 0.5 * SUNLIGHT * sunward.y / dvec_length(sunward) * hard_true_factor(at, normal, c, 4);
}

static void terrain(hard_list *l)
{
    hard_stage *s = l->stage;
    put_land(s, 0.3);
    hard_look(s, dvec_of(1.5, 1.8, 16), dvec_of(0, 1.7, 0), 40.0, SIDE);
    hard_put(l, HARD_BOUNDED, "a house on 4 x 4 km of terrain, from outside: direct light wrong", wrong_direct(s), 2,
             "pixels");
    hard_put(l, HARD_MEASURED, "its sunny wall, which sees one half ground: bounced light off by",
             against(s, from_ground), 1, "% rmse");
    hard_look(s, dvec_of(0, 60, 900), dvec_of(0, 0, 0), 40.0, SIDE);
    hard_put(l, HARD_BOUNDED, "from a hill 900 m off: direct light wrong", wrong_direct(s), 2, "pixels");
    put_land(s, 0.0);
    hard_look(s, dvec_of(1.5, 1.8, 2.2), dvec_of(-1, 1.0, -2), 80.0, SIDE);
    s->view.near_m = 0.02f;
    hard_put(l, HARD_BOUNDED, "from inside: direct light wrong", wrong_direct(s), 2, "pixels");
    hard_put(l, HARD_MEASURED, "its far wall, lit by the sun's patch on the floor: bounced light off by",
             against(s, from_patch), 3, "% rmse");
}

void hard_far(hard_list *l)
{
    strays(l);
    scales(l);
    moved(l);
    terrain(l);
}
