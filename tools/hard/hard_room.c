/* hard_room.c: sealed rooms in direct light from outside, so the inside is dark: walls of few and many facets, flat and
 * bent, on a ground that continues outside, under each kind of light, randomly rotated. And a room with a gap under a
 * door, which is lit through the gap. */
#include <math.h>

#include "hard.h"

#define PI 3.14159265358979323846

enum { BOX, TILED, CLOSED, WAVY, BALL, DOME, CONE, TENT, ROOMS };
enum { SUN, SPOT, POINT, LIGHTS };
enum { SIDE = HARD_SIDE, MAP = 256, MOST = 24 };

typedef struct sealed_room {
    int kind, facets, part; /* part: of the walls */
    double bend, waves, phase, ridge;
    dvec half, axis[3], move;
} sealed_room;

static dvec room_place(const sealed_room *r, dvec p)
{
    const dvec level = dvec_add(dvec_mul(r->axis[0], p.x), dvec_mul(r->axis[2], p.z));
    return dvec_add(level, dvec_add(dvec_mul(r->axis[1], p.y), r->move));
}

/* Parts 0 to 3: walls; 4: the roof; 5: the floor. u, v: 0 .. 1; v: upwards. */
static dvec box_point(const sealed_room *r, double u, double v)
{
    const double a = (2 * u - 1), x = r->half.x, y = 2 * r->half.y, z = r->half.z;
    return r->part == 4   ? dvec_of(a * x, y, (2 * v - 1) * z)
           : r->part == 5 ? dvec_of(a * x, 0, (2 * v - 1) * z)
           : r->part < 2  ? dvec_of(r->part == 0 ? -x : x, v * y, a * z)
                          : dvec_of(a * x, v * y, r->part == 2 ? -z : z);
}

static dvec wavy_point(const sealed_room *r, double u, double v)
{
    const dvec p = box_point(r, u, v);
    const double k = r->waves;
    return dvec_of(p.x + r->bend * sin(k * p.y + 1.3 * k * p.z + r->phase),
                   p.y + r->bend * sin(k * p.x + 0.7 * k * p.z),
                   p.z + r->bend * sin(1.1 * k * p.x - 0.4 * k * p.y));
}

/* Surfaces of revolution; u: once around. */
static dvec round_point(const sealed_room *r, double u, double v)
{
    const double around = u < 1 ? 2 * PI * u : 0, high = 2 * r->half.y, down = r->kind == BALL ? PI * v : 0.5 * PI * v;
    const double wide = r->half.x * (r->kind == CONE ? v : v == 1 && r->kind == DOME ? 1 : sin(down));
    const double y = v == 1 && r->kind != BALL ? 0
                     : r->kind == CONE         ? high * (1 - v)
                     : r->kind == DOME         ? r->half.x * cos(down)
                                               : r->half.x * (1 + cos(down)) + 0.01;
    return dvec_of(wide * cos(around), y, wide * sin(around));
}

/* Parts 0 and 1: the roof's sides; 2 and 3: the gables. */
static dvec tent_point(const sealed_room *r, double u, double v)
{
    const double x = r->half.x, left = -x + v * (r->ridge + x), right = x + v * (r->ridge - x), y = 2 * v * r->half.y;
    if (r->part < 2) {
        return dvec_of(r->part == 0 ? left : right, y, (2 * u - 1) * r->half.z);
    }
    const double across = u == 0 ? left : u == 1 ? right : left + u * (right - left);
    return dvec_of(across, y, r->part == 2 ? -r->half.z : r->half.z);
}

static dvec wall_point(const sealed_room *r, double u, double v)
{
    return room_place(r, r->kind == WAVY                                              ? wavy_point(r, u, v)
                         : r->kind == BALL || r->kind == DOME || r->kind == CONE ? round_point(r, u, v)
                         : r->kind == TENT                                            ? tent_point(r, u, v)
                                                                                      : box_point(r, u, v));
}

static void put_walls(hard_stage *h, sealed_room *r, uint64_t *rng)
{
    const int is_round = r->kind == BALL || r->kind == DOME || r->kind == CONE;
    const int parts = is_round ? 1 : r->kind == TENT ? 4 : r->kind == CLOSED || r->kind == WAVY ? 6 : 5;
    const int columns = is_round ? 2 * r->facets + 1 : r->facets, rows = r->facets + (r->kind == BALL);
    for (r->part = 0; r->part < parts; ++r->part) {
        for (int k = 0; k < rows * columns; ++k) {
            const double u0 = (double)(k % columns) / columns, u1 = (double)(k % columns + 1) / columns;
            const double v0 = (double)(k / columns) / rows, v1 = (double)(k / columns + 1) / rows;
            const dvec a = wall_point(r, u0, v0), b = wall_point(r, u1, v0);
            const dvec c = wall_point(r, u1, v1), d = wall_point(r, u0, v1);
            const int other = (int)(hard_random(rng) & 1u);
            hard_triangle(h, a, b, other ? d : c);
            hard_triangle(h, other ? b : a, c, d);
        }
    }
}

static void put_level(hard_stage *h, const sealed_room *r, double x0, double x1, double z0, double z1, double y)
{
    const dvec a = room_place(r, dvec_of(x0, y, z0)), b = room_place(r, dvec_of(x0, y, z1));
    const dvec c = room_place(r, dvec_of(x1, y, z1)), d = room_place(r, dvec_of(x1, y, z0));
    hard_triangle(h, a, b, c);
    hard_triangle(h, a, c, d);
}

static sealed_room make_room(hard_stage *h, int kind, uint64_t *rng, int turned)
{
    sealed_room r = {kind, 0, 0, 0, 0, 0, 0, {0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    if (turned) {
        r.axis[0] = hard_direction(rng);
        r.axis[1] = dvec_unit(dvec_cross(r.axis[0], hard_direction(rng)));
        r.axis[2] = dvec_cross(r.axis[0], r.axis[1]);
        r.move = dvec_mul(hard_direction(rng), 4);
    }
    const double x = hard_uniform(rng, 0.8, 2.5), y = hard_uniform(rng, 0.8, 1.5), z = hard_uniform(rng, 0.8, 2.5);
    r.half = dvec_of(x, y, z);
    r.facets = kind == BOX ? 1 : 2 + (int)pow(MOST, hard_uniform(rng, 0, 1));
    r.bend = 0.2 * pow(10, hard_uniform(rng, -1.5, 0));
    r.waves = hard_uniform(rng, 2, 14);
    r.phase = hard_uniform(rng, 0, 6);
    r.ridge = hard_uniform(rng, -0.4, 0.4) * x;
    hard_begin(h, 0.8);
    put_walls(h, &r, rng);
    const double wide = hard_uniform(rng, 4, 15);
    put_level(h, &r, -wide, wide, -wide, wide, kind == CLOSED ? -0.01 : kind == WAVY ? -0.3 : 0);
    return r;
}

static void put_lamp(hard_stage *h, const sealed_room *r, int light, uint64_t *rng)
{
    const double high = hard_uniform(rng, 0.15, 1.4), around = hard_uniform(rng, 0, 2 * PI);
    const dvec up = dvec_of(cos(high) * cos(around), sin(high), cos(high) * sin(around));
    const dvec aim = room_place(r, dvec_of(0, 0.5, 0));
    const dvec at = room_place(r, dvec_add(dvec_of(0, 0.5, 0), dvec_mul(up, hard_uniform(rng, 6, 10))));
    if (light == SUN) {
        hard_sun(h, dvec_sub(aim, at), 10.0);
    } else if (light == SPOT) {
        hard_spot(h, at, aim, 40.0, 500.0);
    } else {
        hard_point(h, at, 500.0);
    }
}

static void look_around(hard_stage *h, const sealed_room *r, uint64_t *rng)
{
    const int is_round = r->kind == BALL || r->kind == DOME || r->kind == CONE;
    const double y = r->kind == BALL ? r->half.x : r->kind == DOME ? 0.4 * r->half.x : 0.7 * r->half.y;
    const double x = hard_uniform(rng, -0.3, 0.3) * r->half.x, share = hard_uniform(rng, -0.3, 0.3);
    const dvec eye = dvec_of(x, y, share * (is_round ? r->half.x : r->half.z));
    hard_look(h, room_place(r, eye), room_place(r, dvec_add(eye, hard_direction(rng))), 75.0, SIDE);
    h->view.near_m = 0.01f;
}

static double count_lit(const hard_stage *h)
{
    double lit = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        lit += !(h->out[3 * i] <= 0.0f);
    }
    return lit;
}

/* Lit pixels if direct light is another picture of a frame with all light that traced nothing. */
static double count_lit_again(hard_stage *h)
{
    lmb_frame f = h->render.frame;
    f.show = LMB_SHOW_FULL;
    f.occlusion = LMB_OCCLUSION_NONE;
    f.bvh.node_count = 0;
    lmb_status status = lmb_render_frame(&h->render, &f);
    f.show = LMB_SHOW_DIRECT;
    status = status == LMB_OK ? lmb_render_again(&h->render, &f) : status;
    for (status = status == LMB_OK ? LMB_MORE : status; status == LMB_MORE;) {
        status = lmb_render_step(&h->render, 1 << 20);
    }
    return status == LMB_OK ? count_lit(h) : HUGE_VAL;
}

/* Lit pixels of a frame of direct light inside a room, and *again of another picture of a full frame. */
static double lit_pixels(double *again, hard_stage *h, int kind, int light, uint64_t seed)
{
    uint64_t rng = seed * 2654435761u + (uint64_t)(kind * LIGHTS + light);
    const sealed_room r = make_room(h, kind, &rng, seed % 3 != 0);
    put_lamp(h, &r, light, &rng);
    look_around(h, &r, &rng);
    if (!hard_end(h) || hard_frame(h, LMB_SHOW_DIRECT, MAP, 0.05f) != LMB_OK) {
        return HUGE_VAL;
    }
    const double lit = count_lit(h);
    *again += count_lit_again(h);
    return lit;
}

/* Adds pixels whose bounced light exceeds 1e-4 of the irradiance outside, inside a room. */
static double bounced_pixels(hard_stage *h, int kind, int light, uint64_t seed)
{
    uint64_t rng = seed * 2654435761u + (uint64_t)(kind * LIGHTS + light);
    const sealed_room r = make_room(h, kind, &rng, seed % 3 != 0);
    const double outside = light == SUN ? 10.0 : 500.0 / 64;
    double over = 0;
    put_lamp(h, &r, light, &rng);
    look_around(h, &r, &rng);
    h->gather_step = LMB_GATHER_LIVE;
    const lmb_status status = hard_end(h) ? hard_frame(h, LMB_SHOW_INDIRECT, MAP, 0.05f) : LMB_ERR_CAPACITY;
    h->gather_step = 0;
    for (int i = 0; i < SIDE * SIDE && status == LMB_OK; ++i) {
        over += !((double)h->out[3 * i] * PI / 0.8 <= 1e-4 * outside);
    }
    return status == LMB_OK ? over : HUGE_VAL;
}

/* Pixels that are lit through a gap under a door: by rays, and of these by the library. */
typedef struct through_gap {
    double lit, lost, found; /* found: lit by the library only */
} through_gap;

static void look_through_gap(through_gap *out, hard_stage *h, double gap, uint64_t seed)
{
    uint64_t rng = seed * 2654435761u;
    sealed_room r = {BOX, 1, 0, 0, 0, 0, 0, {1.5, 1.2, 1.5}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    const double low = hard_uniform(&rng, 0.05, 0.5), turn = hard_uniform(&rng, -0.6, 0.6);
    hard_begin(h, 0.8);
    put_walls(h, &r, &rng);
    h->count -= 4; /* the walls are in order: the last but the roof is the door's */
    for (int i = 0; i < 5; ++i) { /* roof, wall left and right of the door, above the gap */
        const double x0 = i == 1 ? -1.5 : i == 2 ? 0.45 : -0.45, x1 = i == 1 ? -0.45 : i == 2 ? 1.5 : 0.45;
        if (i == 0) {
            put_level(h, &r, -1.5, 1.5, -1.5, 1.5, 2.4);
        } else if (i < 4) {
            const double y = i == 3 ? gap : 0;
            hard_quad(h, dvec_of((x0 + x1) / 2, (2.4 + y) / 2, 1.5), dvec_of((x1 - x0) / 2, 0, 0),
                      dvec_of(0, (2.4 - y) / 2, 0));
        }
    }
    put_level(h, &r, -8, 8, -8, 8, 0);
    hard_sun(h, dvec_of(sin(turn) * cos(low), -sin(low), -cos(turn) * cos(low)), 10.0);
    const double z = hard_uniform(&rng, -1.2, 0), y = hard_uniform(&rng, 0.3, 1.5), x = hard_uniform(&rng, -1, 1);
    hard_look(h, dvec_of(x, y, z), dvec_of(0, 0, 1.45), 60.0, SIDE);
    h->view.near_m = 0.01f;
    if (!hard_end(h) || hard_frame(h, LMB_SHOW_DIRECT, HARD_MAP, 0.05f) != LMB_OK) {
        out->lost = HUGE_VAL;
        return;
    }
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const uint32_t id = h->id[hard_at(h, i % SIDE, i / SIDE)];
        if (id != 0) {
            dvec normal;
            const dvec at = hard_surface(&normal, h, i % SIDE, i / SIDE, id);
            const int want = hard_true_direct(h, at, normal, id) > 0.0, got = h->out[3 * i] > 0.0f;
            out->lit += want;
            out->lost += want && !got;
            out->found += got && !want;
        }
    }
}

/* Two rooms with one floor and one roof, a wall of no thickness between them, and a point light in the first one.
 * Returns the brightest pixel of bounced light at the wall's foot in the second one, relative to the light 3 m away. */
static double beside_wall(hard_stage *h, uint64_t seed)
{
    uint64_t rng = seed * 2654435761u;
    sealed_room r = {CLOSED, 1 + (int)(seed % 2) * 3, 0, 0, 0, 0, 0, {3, 1.2, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                     {0, 0, 0}};
    r.half.z = hard_uniform(&rng, 1.2, 3.0);
    if (seed % 3 != 0) {
        r.axis[0] = hard_direction(&rng);
        r.axis[1] = dvec_unit(dvec_cross(r.axis[0], hard_direction(&rng)));
        r.axis[2] = dvec_cross(r.axis[0], r.axis[1]);
    }
    hard_begin(h, 0.8);
    put_walls(h, &r, &rng);
    const dvec foot[2] = {room_place(&r, dvec_of(0, 0, -r.half.z)), room_place(&r, dvec_of(0, 0, r.half.z))};
    const dvec top[2] = {room_place(&r, dvec_of(0, 2.4, -r.half.z)), room_place(&r, dvec_of(0, 2.4, r.half.z))};
    hard_triangle(h, foot[0], foot[1], top[1]);
    hard_triangle(h, foot[0], top[1], top[0]);
    const double x = hard_uniform(&rng, -2.5, -0.2), y = hard_uniform(&rng, 0.4, 2.0);
    hard_point(h, room_place(&r, dvec_of(x, y, hard_uniform(&rng, -1, 1))), 100.0);
    const double z = hard_uniform(&rng, -1, 1), aim = hard_uniform(&rng, -1, 1);
    hard_look(h, room_place(&r, dvec_of(0.6, 0.5, z)), room_place(&r, dvec_of(0, 0, aim)), 60.0, SIDE);
    h->view.near_m = 0.01f;
    if (!hard_end(h) || hard_frame(h, LMB_SHOW_INDIRECT, HARD_MAP, 0.02f) != LMB_OK) {
        return HUGE_VAL;
    }
    double worst = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const double e = (double)h->out[3 * i] * PI / 0.8 / (100.0 / 9);
        worst = e <= worst ? worst : e;
    }
    return worst;
}

/* Segments of a frame that shows balls of small triangles from outside, in light. */
static double segments_of_balls(hard_stage *h, int light, uint64_t seed)
{
    uint64_t rng = seed * 2654435761u + (uint64_t)light;
    const uint64_t before = h->stats.corner_segments;
    sealed_room r = make_room(h, BALL, &rng, seed % 2 != 0);
    put_lamp(h, &r, light, &rng);
    const double around = hard_uniform(&rng, 0, 2 * PI);
    hard_look(h, room_place(&r, dvec_of(5 * cos(around), 4, 5 * sin(around))), room_place(&r, dvec_of(0, 1, 0)), 60.0,
              SIDE);
    return hard_end(h) && hard_frame(h, LMB_SHOW_DIRECT, MAP, 0.05f) == LMB_OK
               ? (double)(h->stats.corner_segments - before)
               : HUGE_VAL;
}

void hard_room(hard_list *list)
{
    static const char *const name[ROOMS] = {
        "sealed boxes on a ground that continues: lit pixels",
        "with walls of many facets",
        "with a floor",
        "with wavy walls",
        "balls",
        "domes on the ground",
        "cones on the ground",
        "tents on the ground"};
    enum { SEEDS = 6, LIVE_SEEDS = 3, WALLS = 8, GAPS = 12 };
    through_gap gap = {0, 0, 0};
    double again = 0;
    for (int kind = 0; kind < ROOMS; ++kind) {
        double lit = 0;
        for (int i = 0; i < SEEDS * LIGHTS; ++i) {
            lit += lit_pixels(&again, list->stage, kind, i % LIGHTS, (uint64_t)(1 + i / LIGHTS));
        }
        hard_put(list, HARD_MEASURED, name[kind], lit, 0, "px");
    }
    hard_put(list, HARD_MEASURED, "all of them as another picture of a full frame", again, 0, "px");
    double over = 0;
    for (int k = 0; k < ROOMS * LIVE_SEEDS * LIGHTS; ++k) {
        over += bounced_pixels(list->stage, k / (LIVE_SEEDS * LIGHTS), k % LIGHTS,
                               (uint64_t)(1 + k % (LIVE_SEEDS * LIGHTS) / LIGHTS));
    }
    hard_put(list, HARD_MEASURED, "all of them in bounced light at single points: pixels over 1e-4",
             100 * over / (ROOMS * LIVE_SEEDS * LIGHTS * SIDE * SIDE), 0.02, "%");
    double beside = 0;
    for (int i = 0; i < WALLS; ++i) {
        const double worst = beside_wall(list->stage, (uint64_t)(17 + i));
        beside = worst <= beside ? beside : worst;
    }
    hard_put(list, HARD_MEASURED, "gathered light beside a wall on one floor: worst pixel", beside, 1e-4,
             "of the lit side's");
    beside = beside_wall(list->stage, 78);
    hard_put(list, HARD_MEASURED, "the same, a texel's middle snapped past the wall", beside, 1e-3,
             "of the lit side's");
    double segments = 0;
    for (int i = 0; i < SEEDS * LIGHTS; ++i) {
        segments += segments_of_balls(list->stage, i % LIGHTS, (uint64_t)(1 + i / LIGHTS));
    }
    hard_put(list, HARD_MEASURED, "balls from outside: segments traced", segments / (SEEDS * LIGHTS), 30,
             "a picture");
    for (int i = 0; i < GAPS; ++i) {
        look_through_gap(&gap, list->stage, 0.01, (uint64_t)(1 + i));
    }
    hard_put(list, HARD_MEASURED, "a gap of 1 cm under a door: light lost", 100 * hard_share(gap.lost, gap.lit), 0,
             "%");
    hard_put(list, HARD_MEASURED, "light beside it", 100 * hard_share(gap.found, gap.lit), 0, "%");
}
