/* hard_whole.c: hard cases of the whole: one room under every hard condition; bounced light against rays.
 *
 * The room has a floor, two walls, a ceiling and a crate under a spot. The reference divides triangles into cells and
 * sums the light that they reflect, in double. Cells are coarse near a corner, so receivers keep a distance from
 * others. */
#include <math.h>
#include <string.h>

#include "hard.h"

#define PI 3.14159265358979323846

enum { SIDE = 32, CELLS = 10, STRIDE = 5, MAP = 256 };

static const double ALBEDO = 0.6;

/* If `apart`, the left wall is a separate part. */
static void put_room(hard_stage *s, dvec o, double crate, int apart)
{
    hard_quad(s, o, dvec_of(2, 0, 0), dvec_of(0, 0, -2));
    hard_quad(s, dvec_add(o, dvec_of(0, 1.5, -2)), dvec_of(2, 0, 0), dvec_of(0, 1.5, 0));
    hard_quad(s, dvec_add(o, dvec_of(0, 3, 0)), dvec_of(2, 0, 0), dvec_of(0, 0, 2));
    hard_box(s, dvec_add(o, dvec_of(0.3, 0.4 + crate, -0.3)), dvec_of(0.4, 0.4, 0.4));
    if (apart) {
        hard_part(s, ALBEDO);
    }
    hard_quad(s, dvec_add(o, dvec_of(-2, 1.5, 0)), dvec_of(0, 0, -2), dvec_of(0, 1.5, 0));
}

static void light_room(hard_stage *s, dvec o)
{
    hard_spot(s, dvec_add(o, dvec_of(0.4, 2.8, 0.6)), dvec_add(o, dvec_of(-0.2, 0, -0.4)), 40.0, 20.0);
}

static void see_room(hard_stage *s, dvec o)
{
    hard_look(s, dvec_add(o, dvec_of(1.6, 1.7, 3.2)), dvec_add(o, dvec_of(-0.2, 1.0, -0.6)), 55.0, SIDE);
}

static void make_room(hard_stage *s, dvec o, double crate)
{
    hard_begin(s, ALBEDO);
    put_room(s, o, crate, 0);
    light_room(s, o);
    hard_end(s);
    see_room(s, o);
}

/* Is another surface within `min`? Cells there are too coarse for a reference. */
static int is_close(const hard_stage *s, dvec at, dvec normal, uint32_t id, double min)
{
    for (int i = 0; i < 8; ++i) {
        const double a = i * PI / 4.0;
        const dvec across = fabs(normal.y) < 0.9 ? dvec_unit(dvec_cross(normal, dvec_of(0, 1, 0))) : dvec_of(1, 0, 0);
        const dvec along = dvec_cross(normal, across);
        const dvec way = dvec_add(dvec_mul(normal, 0.3), dvec_add(dvec_mul(across, cos(a)), dvec_mul(along, sin(a))));
        if (hard_occluded(s, at, dvec_add(at, dvec_mul(way, min)), id, 0)) {
            return 1;
        }
    }
    return 0;
}

typedef struct room_errors {
    double rmse, pixels;
} room_errors;

/* Light of a spot so near to the wall at x = -2 that half of its power arrives there, reflected from that point. */
static double from_spot(const hard_stage *s, dvec at, dvec normal, uint32_t id)
{
    const dvec from = dvec_of(-2, (double)s->light.position.y, (double)s->light.position.z), way = dvec_sub(from, at);
    const double d2 = dvec_dot(way, way), cosine = dvec_dot(way, normal), out = at.x + 2.0;
    if (cosine <= 0.0 || out <= 1e-6 || hard_occluded(s, at, from, id, 0)) {
        return 0.0;
    }
    return 2.0 * PI * (double)s->light.intensity[0] * ALBEDO / PI * cosine * out / (d2 * d2);
}

/* Bounced irradiance. If the light is at the wall, part 1, the wall's reflection comes from one point. */
static double truth_at(hard_stage *s, dvec at, dvec normal, uint32_t id)
{
    const float albedo = s->material[1].albedo[0];
    if (s->parts == 1) {
        return hard_true_bounce(s, at, normal, id, CELLS);
    }
    s->material[1].albedo[0] = 0.0f;
    const double others = hard_true_bounce(s, at, normal, id, CELLS);
    s->material[1].albedo[0] = albedo;
    return others + from_spot(s, at, normal, id);
}

/* Compares bounced irradiance at every STRIDE-th pixel that is not close to another surface. */
static room_errors judge(hard_stage *s)
{
    double want_sum = 0.0, square = 0.0;
    room_errors e = {HUGE_VAL, 0};
    if (hard_frame(s, LMB_SHOW_INDIRECT, MAP, 0.002f) != LMB_OK) {
        return e;
    }
    for (int32_t i = 0; i < SIDE * SIDE; i += STRIDE) {
        const uint32_t id = s->id[hard_at(s, i % SIDE, i / SIDE)];
        dvec normal, at;
        if (id == 0) {
            continue;
        }
        at = hard_surface(&normal, s, i % SIDE, i / SIDE, id);
        if (!is_close(s, at, normal, id, 0.5)) {
            const double want = truth_at(s, at, normal, id), got = (double)s->out[3 * i] * PI / ALBEDO;
            want_sum += want;
            square += (got - want) * (got - want);
            ++e.pixels;
        }
    }
    e.rmse = sqrt(square / e.pixels) / (want_sum / e.pixels);
    return e;
}

static void put_room_case(hard_list *l, const char *name, double bound)
{
    const room_errors e = judge(l->stage);
    hard_put(l, HARD_MEASURED, name, e.pixels > 20 ? 100.0 * e.rmse : HUGE_VAL, bound, "% rmse");
}

/* --- the room under conditions ------------------------------------------------------------------------------------ */

static void conditions(hard_list *l)
{
    hard_stage *s = l->stage;
    const dvec o = dvec_of(0, 0, 0);
    make_room(s, o, 0.0);
    put_room_case(l, "a room, against rays in double", 2.5);
    make_room(s, dvec_of(1e4, 0, -1e4), 0.0);
    put_room_case(l, "10 km from the origin", 2.5);
    make_room(s, dvec_of(1e5, 0, 1e5), 0.0);
    put_room_case(l, "100 km", 3);
    make_room(s, dvec_of(1e6, 0, -1e6), 0.0);
    put_room_case(l, "1000 km, where binary32 steps by 6 cm", 22);
    make_room(s, o, 0.001);
    put_room_case(l, "a gap of 1 mm under the crate", 2.5);
    make_room(s, o, 0.0);
    s->view.kind = LMB_ORTHOGRAPHIC;
    s->view.half_width = s->view.half_height = 2.0f;
    s->view.near_m = 0.1f;
    s->view.far_m = 20.0f;
    put_room_case(l, "by an orthographic camera", 2.5);
    make_room(s, o, 0.0);
    hard_look(s, dvec_of(1.9, 2.0, 0.5), dvec_of(-0.5, 3.0, 0.5), 50.0, SIDE);
    put_room_case(l, "every lit surface off screen", 2.5);
    make_room(s, o, 0.0);
    hard_sun(s, dvec_of(-0.3, -0.08, -0.95), 20.0);
    hard_end(s);
    put_room_case(l, "a sun at 85 degrees from the floor's normal", 3);
    hard_begin(s, ALBEDO);
    put_room(s, o, 0.0, 1);
    hard_point(s, dvec_of(-1.999, 1.5, 0.3), 2.0);
    hard_end(s);
    see_room(s, o);
    put_room_case(l, "a light 1 mm from the wall", 1.2);
}

/* --- the same room, described differently ------------------------------------------------------------------------- */

/* Mirrors both the mesh and the matrix: the same corners in another order. */
static void mirrored(hard_list *l)
{
    hard_stage *s = l->stage;
    float *m;
    hard_begin(s, ALBEDO);
    put_room(s, dvec_of(0, 0, 0), 0.0, 0);
    m = s->instance[0].to_world.m;
    m[0] = -1.0f, m[5] = 2.0f, m[10] = 0.5f;
    for (uint32_t i = 0; i < 3 * s->count; ++i) {
        float *c = s->corner[i / 3][i % 3];
        c[0] = -c[0], c[1] *= 0.5f, c[2] *= 2.0f;
    }
    light_room(s, dvec_of(0, 0, 0));
    hard_end(s);
    see_room(s, dvec_of(0, 0, 0));
    put_room_case(l, "placed by a mirrored, uneven matrix", 2.5);
}

static float first[HARD_SIDE * HARD_SIDE * 3];

/* Counts values that differ from the first room's. */
static double unlike_first(hard_stage *s)
{
    double unlike = 0.0;
    if (hard_frame(s, LMB_SHOW_FULL, MAP, 0.002f) != LMB_OK) {
        return HUGE_VAL;
    }
    for (int i = 0; i < SIDE * SIDE * 3; ++i) {
        unlike += s->out[i] != first[i];
    }
    return unlike;
}

static void said_differently(hard_list *l)
{
    hard_stage *s = l->stage;
    make_room(s, dvec_of(0, 0, 0), 0.0);
    hard_frame(s, LMB_SHOW_FULL, MAP, 0.002f);
    memcpy(first, s->out, sizeof first);
    put_room(s, dvec_of(0, 0, 0), 0.0, 0);
    hard_end(s);
    hard_put(l, HARD_EXACT, "every face twice: other bits", unlike_first(s), 0, "values");
    make_room(s, dvec_of(0, 0, 0), 0.0);
    hard_box(s, dvec_of(-1.9, 2.9, -1.9), dvec_of(0, 0, 0));
    hard_end(s);
    hard_put(l, HARD_EXACT, "triangles without area added: other bits", unlike_first(s), 0, "values");
    make_room(s, dvec_of(0, 0, 0), 0.0);
    for (int i = 0; i < 3; ++i) {
        hard_triangle(s, dvec_of(0, 0, 0), dvec_of(1, 0, 0), dvec_of(0, 1, 0));
        s->corner[s->count - 1][i][i] = i == 0 ? NAN : i == 1 ? INFINITY : 1e30f;
    }
    hard_end(s);
    hard_put(l, HARD_EXACT, "corners of NaN, infinity and 1e30 added: other bits", unlike_first(s), 0, "values");
}

/* --- finer than a texel ------------------------------------------------------------------------------------------- */

/* Mean bounced light on a ceiling over a black and white checkered floor of `cells` per side, against uniform grey. */
static double checkers(hard_stage *s, int cells)
{
    static uint8_t texels[1024 * 1024 * 4];
    double sum[2] = {0, 0};
    for (int i = 0; i < cells * cells; ++i) {
        memset(texels + 4 * i, ((i % cells) ^ (i / cells)) & 1 ? 255 : 0, 3);
        texels[4 * i + 3] = 255;
    }
    for (int plain = 0; plain < 2; ++plain) {
        hard_begin(s, plain ? 0.5 : 1.0);
        hard_quad(s, dvec_of(0, 0, 0), dvec_of(1.5, 0, 0), dvec_of(0, 0, -1.5));
        hard_part(s, 0.5);
        hard_quad(s, dvec_of(1.6, 1, 0), dvec_of(0, 0, 1.5), dvec_of(0, 1, 0));
        if (!plain) {
            s->texture.texels = texels;
            s->texture.width = s->texture.height = (uint16_t)cells;
            s->texture.levels = 1;
            s->material[0].texture = 0;
        }
        hard_spot(s, dvec_of(-0.1, 2.5, 0.1), dvec_of(-0.1, 0, 0), 25.0, 10.0);
        hard_end(s);
        hard_look(s, dvec_of(-1.4, 1.5, 0), dvec_of(1.6, 1, 0), 40.0, SIDE);
        hard_frame(s, LMB_SHOW_INDIRECT, MAP, 0.002f);
        for (int i = 0; i < SIDE * SIDE; ++i) {
            sum[plain] += s->id[hard_at(s, i % SIDE, i / SIDE)] > 2 ? (double)s->out[3 * i] : 0.0;
        }
    }
    return fabs(sum[0] / sum[1] - 1.0);
}

/* W of all texels of a shadow map with one face. */
static double root_flux(const hard_stage *s)
{
    const lmb_tree *t = &s->render.frame.tree;
    return (double)t->node[(t->size * t->size - 1) / 3 - 1].flux[0];
}

/* Slats of half a texel, moved in steps of an eighth. */
static void slats(hard_list *l)
{
    hard_stage *s = l->stage;
    double min = HUGE_VAL, max = 0.0, sum = 0.0;
    const double width = 0.5 * 4.0 / MAP;
    for (int step = 0; step < 8; ++step) {
        const double off = step * 0.125 * 4.0 / MAP;
        hard_begin(s, 0.5);
        for (int i = -15; i <= 15; ++i) {
            hard_quad(s, dvec_of(0.1037 * i + off, 0, 0), dvec_of(0.5 * width, 0, 0), dvec_of(0, 0, -1));
        }
        hard_part(s, 0.0);
        hard_quad(s, dvec_of(0, -1, 0), dvec_of(2, 0, 0), dvec_of(0, 0, -2));
        hard_sun(s, dvec_of(0, -1, 0), 1.0);
        hard_end(s);
        hard_look(s, dvec_of(0, 2, 3), dvec_of(0, 0, 0), 50.0, SIDE);
        hard_frame(s, LMB_SHOW_INDIRECT, MAP, 0.002f);
        const double flux = root_flux(s);
        min = fmin(min, flux), max = fmax(max, flux), sum += flux;
    }
    hard_put(l, HARD_MEASURED, "lit slats of half a texel over a black floor: flux off",
             100.0 * fabs(sum / 8.0 / (0.5 * 31.0 * width * 2.0) - 1.0), 1, "%");
    hard_put(l, HARD_MEASURED, "moved by eighths of a texel: flux changes by", 100.0 * (max - min) / (sum / 8.0), 10,
             "%");
}

static void finer(hard_list *l)
{
    hard_put(l, HARD_MEASURED, "checkers of two texels: mean light off", 100.0 * checkers(l->stage, 64), 0.05, "%");
    hard_put(l, HARD_MEASURED, "of a third of a texel", 100.0 * checkers(l->stage, 1000), 0.1, "%");
    slats(l);
}

void hard_whole(hard_list *l)
{
    conditions(l);
    mirrored(l);
    said_differently(l);
    finer(l);
}
