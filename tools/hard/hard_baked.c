/* hard_baked.c: hard cases of baked light and of live light: light leaks, compared with cuts of the same scenes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../bake/bake.h"
#include "hard.h"

enum { SIDE = 48, FLOATS = SIDE * SIDE * 3, MAP = 256, LEAVES = 16 };
enum { ELEMENTS = 1024, FEW_RECEIVERS = 1500, MANY_RECEIVERS = 4500 };

static const double ALBEDO = 0.6;

#define EXACT 0.002f
#define DRAFT 0.06f

/* --- scenes, all lit by a spot; the floor is y = 0 ---------------------------------------------------------------- */

/* A closed room, 4 x 2.4 x 4 m. */
static void begin_room(hard_stage *s)
{
    hard_begin(s, ALBEDO);
    hard_box(s, dvec_of(0, 1.2, 0), dvec_of(2, 1.2, 2));
}

static int end_room(hard_stage *s, dvec light, dvec towards)
{
    hard_spot(s, light, towards, 40.0, 20.0);
    return hard_end(s);
}

/* A wall without thickness in the middle; the light is at x > 0. */
static int thin_wall(hard_stage *s)
{
    begin_room(s);
    hard_quad(s, dvec_of(0, 1.2, 0), dvec_of(0, 0, 2), dvec_of(0, 1.2, 0));
    return end_room(s, dvec_of(0.9, 2.2, 0.3), dvec_of(0.5, 0, 0));
}

/* A closed cupboard of thin boards. */
static int cupboard(hard_stage *s)
{
    begin_room(s);
    hard_box(s, dvec_of(-1.2, 0.6, -1.2), dvec_of(0.4, 0.6, 0.4));
    return end_room(s, dvec_of(0.9, 2.2, 0.9), dvec_of(0, 0, 0));
}

static int box_on_floor(hard_stage *s)
{
    begin_room(s);
    hard_box(s, dvec_of(-0.2, 0.3, -0.4), dvec_of(0.3, 0.3, 0.3));
    return end_room(s, dvec_of(1.2, 2.2, 1.0), dvec_of(0.6, 0, 0.4));
}

/* A board on the wall with a book on it. */
static int book_on_shelf(hard_stage *s)
{
    begin_room(s);
    hard_box(s, dvec_of(0, 1.0, -1.85), dvec_of(0.8, 0.015, 0.149));
    hard_box(s, dvec_of(0.2, 1.14, -1.86), dvec_of(0.02, 0.125, 0.09));
    return end_room(s, dvec_of(0.6, 2.2, 0.6), dvec_of(0, 0.6, -2));
}

/* A screen between lamp and floor; every other square of it is a hole. */
static int leaves(hard_stage *s)
{
    static uint8_t texels[4 * LEAVES * LEAVES];
    begin_room(s);
    const uint32_t k = hard_part(s, ALBEDO);
    hard_quad(s, dvec_of(0, 1.2, 0), dvec_of(0, 0, 1.2), dvec_of(1.2, 0, 0));
    hard_holes(s, k, texels, LEAVES);
    return end_room(s, dvec_of(0.3, 2.3, 0.2), dvec_of(0, 0, 0));
}

/* --- baking and drawing ------------------------------------------------------------------------------------------- */

typedef struct baked {
    file_bytes file;
    lmb_transfer transfer;
    void *memory;
} baked;

/* Bakes the scene. `eyes` are the positions of the pictures, so that no visible surface is culled as the inside of a
 * solid. */
static int bake_it(baked *out, hard_stage *s, const lmb_vec3 *eyes, uint32_t count, uint32_t receivers)
{
    const bake_settings set = {
        .error = 0.00014f, .division = 0.008f, .elements = ELEMENTS, .receivers = receivers, .threads = 2};
    bake b;
    report r = {""};
    memset(&b, 0, sizeof b);
    memset(out, 0, sizeof *out);
    int ok = bake_begin(&b, &s->scene, &set, &r) && bake_reach(&b, eyes, count, &r) && bake_receivers(&b, &r) &&
             bake_clusters(&b, &r) && bake_bounces(&b, &r) && bake_code_all(&b, &r) && bake_file(&out->file, &b, &r) &&
             lmb_transfer_open(&out->transfer, out->file.data, out->file.size) == LMB_OK;
    bake_free(&b);
    const size_t bytes = ok ? lmb_transfer_light_bytes(&out->transfer) : 0;
    out->memory = bytes > 0 ? malloc(bytes) : NULL;
    ok = ok && out->memory != NULL &&
         lmb_transfer_light_init(&s->transfer_light, &out->transfer, out->memory, bytes) == LMB_OK &&
         lmb_transfer_materials(&s->transfer_light, &out->transfer, &s->scene) == LMB_OK;
    s->transfer = ok ? &out->transfer : NULL;
    return ok;
}

static void end_baked(baked *b, hard_stage *s)
{
    s->transfer = NULL;
    free(b->memory);
    file_free(&b->file);
}

/* Mean bounced light of a picture from `from`, with s->transfer and s->gather_step; HUGE_VAL if it cannot be drawn. */
static double mean_seen(hard_stage *s, dvec from, dvec target, float error)
{
    double sum = 0.0;
    hard_look(s, from, target, 90.0, SIDE);
    if (hard_frame(s, LMB_SHOW_IRRADIANCE, MAP, error) != LMB_OK) {
        return HUGE_VAL;
    }
    for (int i = 0; i < FLOATS; ++i) {
        sum += (double)s->out[i];
    }
    return sum / FLOATS;
}

/* The same with live light, at draft settings. */
static double mean_of_live(hard_stage *s, dvec from, dvec target)
{
    s->gather_step = LMB_GATHER_LIVE;
    const double mean = mean_seen(s, from, target, DRAFT);
    s->gather_step = 0;
    return mean;
}

static lmb_vec3 eye_at(dvec v)
{
    float f[3];
    dvec_write(f, v);
    return (lmb_vec3){f[0], f[1], f[2]};
}

/* Mean light in the dark part as % of that in the lit part: baked, live, and by cuts. */
static void put_leak(hard_list *l, int (*make)(hard_stage *), const char *name, dvec dark, dvec to, double bound)
{
    static const char unit[] = "% of the lit side";
    hard_stage *s = l->stage;
    const dvec lit = dvec_of(1.0, 1.6, 1.0), at = dvec_of(1.0, 0, 0);
    const lmb_vec3 eyes[2] = {eye_at(dark), eye_at(lit)};
    baked b;
    if (!make(s) || !bake_it(&b, s, eyes, 2, FEW_RECEIVERS)) {
        hard_put(l, HARD_MEASURED, name, HUGE_VAL, bound, unit);
        return;
    }
    const double by_bake = 100.0 * hard_share(mean_seen(s, dark, to, EXACT), mean_seen(s, lit, at, EXACT));
    end_baked(&b, s);
    const double exact = mean_seen(s, lit, at, EXACT);
    hard_put(l, HARD_MEASURED, name, by_bake, bound, unit);
    hard_put(l, HARD_MEASURED, "by live light", 100.0 * hard_share(mean_of_live(s, dark, to), exact), 0.001, unit);
    hard_put(l, HARD_MEASURED, "by cuts", 100.0 * hard_share(mean_seen(s, dark, to, EXACT), exact), 0.001, unit);
}

/* A closed dome of small triangles on a ground that continues outside, in the sun. */
static int make_dome(hard_stage *s)
{
    enum { ROWS = 24, COLUMNS = 49 };
    static const double radius = 1.5, pi = 3.14159265358979323846;
    dvec p[2][2];
    hard_begin(s, ALBEDO);
    for (int k = 0; k < ROWS * COLUMNS; ++k) {
        for (int i = 0; i < 4; ++i) {
            const int row = k / COLUMNS + i / 2, column = (k + i % 2) % COLUMNS;
            const double down = 0.5 * pi * row / ROWS, around = 2.0 * pi * column / COLUMNS;
            p[i / 2][i % 2] = dvec_of(radius * sin(down) * cos(around), row == ROWS ? 0 : radius * cos(down),
                                      radius * sin(down) * sin(around));
        }
        hard_triangle(s, p[0][0], p[0][1], p[1][1]);
        hard_triangle(s, p[0][0], p[1][1], p[1][0]);
    }
    hard_quad(s, dvec_of(0, 0, 0), dvec_of(0, 0, 8), dvec_of(8, 0, 0));
    hard_sun(s, dvec_of(0.5, -0.6, 0.3), 10.0);
    return hard_end(s);
}

/* Pixels inside the dome over a hundredth of the sun's light. */
static void put_dome(hard_list *l)
{
    hard_stage *s = l->stage;
    const dvec inside = dvec_of(0.1, 0.6, -0.2), outside = dvec_of(3.0, 2.0, 3.0);
    const lmb_vec3 eyes[2] = {eye_at(inside), eye_at(outside)};
    double lit = 0.0;
    baked b;
    const int ok = make_dome(s) && bake_it(&b, s, eyes, 2, FEW_RECEIVERS);
    for (int turn = 0; ok && turn < 12; ++turn) {
        const dvec to = dvec_of(cos(0.6 * turn), turn % 3 - 1.0, sin(0.6 * turn));
        hard_look(s, inside, dvec_add(inside, to), 80.0, SIDE);
        if (hard_frame(s, LMB_SHOW_FULL, MAP, EXACT) != LMB_OK) {
            lit = HUGE_VAL;
        }
        for (int i = 0; i < SIDE * SIDE; ++i) {
            lit += s->out[3 * i] > 0.01f * 10.0f * (float)(ALBEDO / 3.1416);
        }
    }
    if (ok) {
        end_baked(&b, s);
    }
    hard_put(l, HARD_MEASURED, "a sealed dome in the sun: lit pixels", ok ? lit : HUGE_VAL, 0, "px");
}

/* RMSE of a picture against s->out, %. */
static double rmse_of(const hard_stage *s, const float *picture)
{
    double off = 0.0, all = 0.0;
    for (int i = 0; i < FLOATS; ++i) {
        const double d = (double)picture[i] - (double)s->out[i];
        off += d * d;
        all += (double)s->out[i];
    }
    return 100.0 * hard_share(sqrt(off / FLOATS), all / FLOATS);
}

/* Compares baked light, and live light, with nearly exact cuts. */
static void put_beside(hard_list *l, int (*make)(hard_stage *), const char *name, dvec from, dvec to,
                       uint32_t receivers, double bound, double live_bound)
{
    static float by_bake[FLOATS], by_live[FLOATS];
    hard_stage *s = l->stage;
    const lmb_vec3 eyes[1] = {eye_at(from)};
    baked b;
    int ok = make(s) && bake_it(&b, s, eyes, 1, receivers) && mean_seen(s, from, to, EXACT) < HUGE_VAL;
    if (ok) {
        memcpy(by_bake, s->out, sizeof by_bake);
        end_baked(&b, s);
        ok = mean_of_live(s, from, to) < HUGE_VAL;
        memcpy(by_live, s->out, sizeof by_live);
    }
    ok = ok && mean_seen(s, from, to, EXACT) < HUGE_VAL;
    hard_put(l, HARD_MEASURED, name, ok ? rmse_of(s, by_bake) : HUGE_VAL, bound, "% rmse");
    hard_put(l, HARD_MEASURED, "by live light", ok ? rmse_of(s, by_live) : HUGE_VAL, live_bound, "% rmse");
}

void hard_baked(hard_list *l)
{
    put_dome(l);
    put_leak(l, thin_wall, "baked: behind a thin wall", dvec_of(-1.0, 1.2, 0.5), dvec_of(-0.4, 0.8, -1), 1.0);
    put_leak(l, cupboard, "baked: in a closed cupboard", dvec_of(-1.2, 0.6, -1.1), dvec_of(-1.3, 0.3, -1.5), 1.2);
    put_beside(l, box_on_floor, "baked: a box on a floor, against cuts", dvec_of(0.8, 0.9, 0.8),
               dvec_of(-0.2, 0.1, -0.4), FEW_RECEIVERS, 7.5, 10.0);
    put_beside(l, book_on_shelf, "a book on a shelf", dvec_of(0.5, 1.3, -1.0), dvec_of(0.1, 1.05, -1.9), MANY_RECEIVERS,
               8.5, 12.5);
    put_beside(l, leaves, "under a screen of leaves", dvec_of(1.5, 0.6, 1.5), dvec_of(0, 0.2, 0), MANY_RECEIVERS, 5.5,
               15.0);
}
