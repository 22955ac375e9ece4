/* hard_sheet.c: rooms under one bent sheet lit from above, so the inside is dark. Sheets of all curvatures, of few and
 * many facets, under each kind of light, randomly rotated. */
#include <math.h>

#include "hard.h"

#define PI 3.14159265358979323846
#define HIGH 2.5 /* m above the floor: the sheet's base */

enum { WAVES, RIPPLES, DOME, BOWL, TENT, GUTTER, CONE, FUNNEL, BARREL, BODY, CRUMPLED, SHEETS };
enum { SUN, SPOT, POINT, LIGHTS };
enum { SIDE = 32, MAP = 64, MOST = 31 }; /* wide texels, so that many pixels are near a fold */

typedef struct sheet {
    int kind, rows, columns;
    double size, phase; /* size: maximum distance from a plane, m */
    dvec axis[3], move;
} sheet;

/* Height of a sheet above the plane, relative to its size; x and z: -1 .. 1. */
static double rise_of(const sheet *s, double x, double z)
{
    const double r = sqrt(x * x + z * z);
    switch (s->kind) {
    case WAVES: return sin(24 * x + s->phase);
    case RIPPLES: return sin(9 * x + s->phase) * cos(7 * z);
    case DOME: return (1 - x * x) * (1 - z * z);
    case BOWL: return (x * x - 1) * (1 - z * z);
    case TENT: return 1 - fabs(x + 0.2 * sin(s->phase));
    case GUTTER: return fabs(x + 0.2 * sin(s->phase));
    case CONE: return fmax(0.0, 1 - r);
    case FUNNEL: return fmin(0.0, r - 1);
    case BARREL: return sqrt(1.2 - x * x);
    case BODY: return sqrt(sqrt(1.1 - x * x * x * x)) * (1 - 0.5 * z * z) + 0.15 * tanh(12 * (z - 0.3 * x));
    default: return sin(31 * x + s->phase) * sin(17 * z + 2 * x) + 0.5 * sin(41 * z - 23 * x);
    }
}

static dvec placed(const sheet *s, double x, double y, double z)
{
    const dvec level = dvec_add(dvec_mul(s->axis[0], x), dvec_mul(s->axis[2], z));
    return dvec_add(level, dvec_add(dvec_mul(s->axis[1], y), s->move));
}

/* The point in column i of row j; `down`: on the floor below. */
static dvec place_of(const sheet *s, int i, int j, int down)
{
    const double x = 2.0 * i / s->columns - 1, z = 2.0 * j / s->rows - 1;
    return placed(s, 2 * x, down ? 0.0 : HIGH + s->size * rise_of(s, x, z), 2 * z);
}

static void put_four(hard_stage *h, dvec a, dvec b, dvec c, dvec d, int other)
{
    hard_triangle(h, a, b, other ? d : c);
    hard_triangle(h, other ? b : a, c, d);
}

/* Adds the wall below a rim edge, and the floor from there to the middle: vertices coincide. */
static void put_wall(hard_stage *h, const sheet *s, int i0, int j0, int i1, int j1)
{
    const dvec from = place_of(s, i0, j0, 1), to = place_of(s, i1, j1, 1);
    put_four(h, place_of(s, i0, j0, 0), place_of(s, i1, j1, 0), to, from, 0);
    hard_triangle(h, from, to, placed(s, 0, 0, 0));
}

/* Sets the identity, or a random rotation and translation. */
static void set_place(sheet *s, uint64_t *rng, int turned)
{
    s->axis[0] = dvec_of(1, 0, 0), s->axis[1] = dvec_of(0, 1, 0), s->axis[2] = dvec_of(0, 0, 1);
    s->move = dvec_of(0, 0, 0);
    if (turned) {
        s->axis[0] = hard_direction(rng);
        s->axis[1] = dvec_unit(dvec_cross(s->axis[0], hard_direction(rng)));
        s->axis[2] = dvec_cross(s->axis[0], s->axis[1]);
        s->move = dvec_mul(hard_direction(rng), 3);
    }
}

/* 4 to about 2,000 facets. */
static sheet make_sheet(hard_stage *h, int kind, uint64_t *rng, int turned)
{
    const int is_strip = kind == WAVES || kind == TENT || kind == GUTTER || kind == BARREL;
    const int many = (int)pow(MOST, hard_uniform(rng, 0, 1));
    sheet s;
    s.kind = kind;
    s.columns = kind == TENT || kind == GUTTER ? 2 * many : 1 + many;
    s.rows = is_strip ? 1 + (int)(hard_random(rng) % 3) : 1 + many;
    s.size =
        pow(10.0, hard_uniform(rng, -2.5, -0.2)) * (kind == WAVES || kind == RIPPLES || kind == CRUMPLED ? 0.3 : 1);
    s.phase = hard_uniform(rng, 0, 6);
    set_place(&s, rng, turned);
    hard_begin(h, 0.8);
    for (int j = 0; j < s.rows; ++j) {
        for (int i = 0; i < s.columns; ++i) {
            put_four(h, place_of(&s, i, j, 0), place_of(&s, i, j + 1, 0), place_of(&s, i + 1, j + 1, 0),
                     place_of(&s, i + 1, j, 0), (int)(hard_random(rng) & 1u));
        }
    }
    for (int i = 0; i < s.columns; ++i) {
        put_wall(h, &s, i, 0, i + 1, 0);
        put_wall(h, &s, i, s.rows, i + 1, s.rows);
    }
    for (int j = 0; j < s.rows; ++j) {
        put_wall(h, &s, 0, j, 0, j + 1);
        put_wall(h, &s, s.columns, j, s.columns, j + 1);
    }
    return s;
}

/* Adds the light. Returns the irradiance in the middle of a flat sheet. */
static double put_light(hard_stage *h, const sheet *s, int light, uint64_t *rng)
{
    const double x = hard_uniform(rng, -1, 1), z = hard_uniform(rng, -1, 1), high = hard_uniform(rng, 1, 3);
    const dvec at = placed(s, x, HIGH + s->size + high, z), middle = placed(s, 0, HIGH, 0);
    const dvec way = dvec_unit(dvec_sub(middle, at));
    const double cosine = -dvec_dot(way, s->axis[1]), d = dvec_length(dvec_sub(middle, at));
    if (light == SUN) {
        hard_sun(h, way, 10.0);
        return 10.0 * cosine;
    }
    if (light == SPOT) {
        hard_spot(h, at, middle, 55.0, 60.0);
    } else {
        hard_point(h, at, 60.0);
    }
    return 60.0 * cosine / (d * d);
}

/* Pixels on the dark side. */
typedef struct dark {
    double worst, over, pixels; /* relative to the lit side's irradiance; over: number above a millionth */
} dark;

static void look_up(hard_stage *h, const sheet *s, uint64_t *rng)
{
    const double ez = hard_uniform(rng, -1.8, 1.8), ey = hard_uniform(rng, 0.3, 1.5);
    const double ex = hard_uniform(rng, -1.8, 1.8), tz = hard_uniform(rng, -1, 1);
    const double tx = hard_uniform(rng, -1, 1);
    hard_look(h, placed(s, ex, ey, ez), placed(s, tx, HIGH, tz), 75.0, SIDE);
    h->view.near_m = 0.01f;
}

static void count_dark(dark *out, hard_stage *h, int kind, int light, uint64_t seed, float error)
{
    uint64_t rng = seed * 2654435761u + (uint64_t)(kind * LIGHTS + light);
    const sheet s = make_sheet(h, kind, &rng, seed % 3 != 0);
    const double lit = put_light(h, &s, light, &rng);
    hard_end(h);
    look_up(h, &s, &rng);
    if (hard_frame(h, LMB_SHOW_INDIRECT, MAP, error) != LMB_OK) {
        out->worst = HUGE_VAL;
        return;
    }
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const double e = (double)h->out[3 * i] * PI / 0.8 / lit;
        out->worst = e <= out->worst ? out->worst : e;
        out->over += !(e <= 1e-6);
        ++out->pixels;
    }
}

void hard_sheet(hard_list *list)
{
    static const char *const name[SHEETS] = {
        "under waves: worst pixel", "ripples", "a dome",   "a bowl",       "a tent",          "a gutter",
        "a cone",                   "a funnel", "a barrel", "a car's body", "a crumpled sheet"};
    enum { SEEDS = 6 };
    static const uint64_t seeds[SEEDS] = {2, 5, 7, 10, 12, 33};
    dark all = {0, 0, 0};
    for (int kind = 0; kind < SHEETS; ++kind) {
        dark d = {0, 0, 0};
        for (int i = 0; i < SEEDS * LIGHTS; ++i) {
            count_dark(&d, list->stage, kind, i % LIGHTS, seeds[i / LIGHTS], 0.05f);
        }
        hard_put(list, HARD_BOUNDED, name[kind], d.worst, 1e-4, "of the lit side's");
        all.over += d.over;
        all.pixels += d.pixels;
    }
    hard_put(list, HARD_BOUNDED, "under all of these: pixels over a millionth of it",
             100 * hard_share(all.over, all.pixels), 0.02, "%");
}
