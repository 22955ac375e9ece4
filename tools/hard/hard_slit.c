/* hard_slit.c: closed rooms with a narrow slit in the roof: light that the lit strip of the floor reflects, in closed
 * form, and the work in a room that is dark. Slits narrower than a texel of the map, along the axes of the map, have
 * most of the error: the map shows them one texel wide, or not at all.
 *
 * The roof is a sheet and the room is empty and convex, so the sun lights a parallelogram of the floor, which each
 * point of the walls sees wholly. A wide ground outside is lit too, and no point of the room sees it. */
#include <math.h>
#include <string.h>

#include "hard.h"

#define PI 3.14159265358979323846
#define ALBEDO 0.7
#define SUN 10.0   /* W/m2 perpendicular to the rays */
#define LONG 4.0   /* m: the room along x, */
#define HIGH 2.5   /* y, */
#define DEEP 3.0   /* and z */
#define GROUND 6.0 /* m beyond the walls */

enum { SIDE = 40, MAP = 512, TREE = 128 };

typedef struct slit {
    double from, wide, first, last; /* m: along x; along z */
    dvec axis[3], along;
} slit;

static dvec put(const slit *s, double x, double y, double z)
{
    return dvec_add(dvec_mul(s->axis[0], x), dvec_add(dvec_mul(s->axis[1], y), dvec_mul(s->axis[2], z)));
}

static void quad(hard_stage *h, const slit *s, dvec low, dvec u, dvec v)
{
    const dvec a = put(s, low.x, low.y, low.z), b = put(s, u.x, u.y, u.z), c = put(s, v.x, v.y, v.z);
    hard_quad(h, dvec_add(a, dvec_mul(dvec_add(b, c), 0.5)), dvec_mul(b, 0.5), dvec_mul(c, 0.5));
}

/* The floor has triangles 1 and 2. */
static void put_room(hard_stage *h, const slit *s)
{
    const dvec x = dvec_of(LONG, 0, 0), y = dvec_of(0, HIGH, 0), z = dvec_of(0, 0, DEEP);
    quad(h, s, dvec_of(0, 0, 0), z, x);
    quad(h, s, dvec_of(0, 0, 0), x, y);
    quad(h, s, z, y, x);
    quad(h, s, dvec_of(0, 0, 0), y, z);
    quad(h, s, x, z, y);
    quad(h, s, y, dvec_of(s->from, 0, 0), z);
    quad(h, s, dvec_of(s->from + s->wide, HIGH, 0), dvec_of(LONG - s->from - s->wide, 0, 0), z);
    if (s->wide > 0.0) {
        quad(h, s, dvec_of(s->from, HIGH, 0), dvec_of(s->wide, 0, 0), dvec_of(0, 0, s->first));
        quad(h, s, dvec_of(s->from, HIGH, s->last), dvec_of(s->wide, 0, 0), dvec_of(0, 0, DEEP - s->last));
    }
    quad(h, s, dvec_of(-GROUND, -0.02, -GROUND), dvec_of(0, 0, DEEP + 2 * GROUND), dvec_of(LONG + 2 * GROUND, 0, 0));
}

/* wide: m; 0: none. */
static void make_slit(slit *s, hard_stage *h, double wide, uint64_t *rng)
{
    const double lean = hard_uniform(rng, -0.5, 0.5), aside = hard_uniform(rng, -0.3, 0.3);
    const int turned = (int)(hard_random(rng) % 3);
    memset(s, 0, sizeof *s);
    s->axis[0] = dvec_of(1, 0, 0), s->axis[1] = dvec_of(0, 1, 0), s->axis[2] = dvec_of(0, 0, 1);
    if (turned > 0) {
        s->axis[0] = hard_direction(rng);
        s->axis[1] = dvec_unit(dvec_cross(s->axis[0], hard_direction(rng)));
        s->axis[2] = dvec_cross(s->axis[0], s->axis[1]);
    }
    s->wide = wide;
    s->from = fmax(0.0, -lean) * HIGH + hard_uniform(rng, 0.02, 1.0);
    s->first = fmax(0.0, -aside) * HIGH + 0.1;
    s->last = s->first + 1.8;
    s->along = dvec_of(lean, -1, aside);
    hard_begin(h, ALBEDO);
    put_room(h, s);
    hard_sun(h, put(s, lean, -1, aside), SUN);
    hard_end(h);
}

/* Light that arrives from the strip, W/m2. */
static double truth_at(const slit *s, dvec at, dvec normal)
{
    const dvec d = s->along;
    dvec c[4];
    for (int i = 0; i < 4; ++i) {
        c[i] = put(s, s->from + (i == 1 || i == 2 ? s->wide : 0.0) + d.x * HIGH, 0.0,
                   (i < 2 ? s->first : s->last) + d.z * HIGH);
    }
    return SUN * ALBEDO / dvec_length(d) * hard_true_factor(at, normal, c, 4);
}

/* Relative to the mean truth. worst: of a pixel, relative to the truth plus a twentieth of the mean. */
typedef struct slit_error {
    double rmse, worst, mean;
} slit_error;

static void measure(slit_error *out, hard_stage *h, double wide, uint64_t seed, int32_t gather_step)
{
    uint64_t rng = seed * 2654435761u;
    slit s;
    double square = 0.0, sum = 0.0, all = 0.0, worst = 0.0;
    static double want[SIDE * SIDE], got[SIDE * SIDE];
    int count = 0;
    make_slit(&s, h, wide, &rng);
    const double z = hard_uniform(&rng, 0.3, 2.7), x = hard_uniform(&rng, 3.4, 3.8);
    hard_look(h, put(&s, x, 1.6, z), put(&s, 0.6, 0.7, 1.5), 75, SIDE);
    h->tree_size = TREE;
    h->gather_step = gather_step;
    const lmb_status status = hard_frame(h, LMB_SHOW_INDIRECT, MAP, 0.02f);
    h->tree_size = h->gather_step = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const uint32_t id = h->id[hard_at(h, i % SIDE, i / SIDE)];
        if (id > 2) {
            dvec normal;
            const dvec at = hard_surface(&normal, h, i % SIDE, i / SIDE, id);
            want[count] = truth_at(&s, at, normal);
            got[count] = (double)h->out[3 * i + 1] * PI / ALBEDO;
            all += got[count];
            sum += want[count++];
        }
    }
    for (int i = 0; i < count; ++i) {
        const double off = got[i] - want[i];
        square += off * off;
        worst = fmax(worst, got[i] / (want[i] + 0.05 * sum / count));
    }
    out->rmse = status == LMB_OK ? sqrt(square / count) * count / sum : HUGE_VAL;
    out->worst = worst;
    out->mean = all / sum;
}

typedef struct slit_row {
    int32_t gather_step;
    uint64_t seed;
    const char *name[3];
    double bound[3];
} slit_row;

/* Means of the errors over slits of 2 to 10 cm, and the worst pixel. A texel of the map is 3 cm wide. */
static void put_row(hard_list *list, const slit_row *r)
{
    enum { SLITS = 6 };
    slit_error all = {0, 0, 0};
    for (int i = 0; i < SLITS; ++i) {
        slit_error one;
        measure(&one, list->stage, 0.02 * pow(5.0, (double)i / (SLITS - 1)), r->seed + (uint64_t)i, r->gather_step);
        all.rmse += one.rmse / SLITS;
        all.mean += fabs(one.mean - 1.0) / SLITS;
        all.worst = fmax(all.worst, one.worst);
    }
    hard_put(list, HARD_MEASURED, r->name[0], all.rmse, r->bound[0], "");
    hard_put(list, HARD_MEASURED, r->name[1], all.mean, r->bound[1], "");
    hard_put(list, HARD_MEASURED, r->name[2], all.worst, r->bound[2], "times");
}

/* Segments of a pixel in a room without a slit, where no light ends the search. */
static double work_in_the_dark(hard_stage *h, uint64_t seed)
{
    uint64_t rng = seed * 2654435761u;
    slit s;
    make_slit(&s, h, 0.0, &rng);
    hard_look(h, put(&s, 3.6, 1.6, 1.4), put(&s, 0.6, 0.7, 1.5), 75, SIDE);
    memset(&h->stats, 0, sizeof h->stats);
    const lmb_status status = hard_frame(h, LMB_SHOW_INDIRECT, MAP / 2, 0.004f);
    return status == LMB_OK ? (double)h->stats.segments / (SIDE * SIDE) : HUGE_VAL;
}

void hard_slit(hard_list *list)
{
    static const slit_row rows[] = {
        {0, 1, {"walls lit through a slit: rmse", "mean off", "brightest pixel"}, {0.19, 0.1, 2.45}},
        {0, 101, {"held out slits: rmse", "mean off", "brightest pixel"}, {0.69, 0.39, 1.9}},
        {LMB_GATHER_LIVE, 1, {"live light through a slit: rmse", "mean off", "brightest pixel"}, {0.6, 0.152, 22.5}},
        {LMB_GATHER_LIVE, 101, {"held out live light: rmse", "mean off", "brightest pixel"}, {1.05, 0.425, 76}},
    };
    double largest = 0.0;
    for (int i = 0; i < 4; ++i) {
        put_row(list, &rows[i]);
    }
    for (uint64_t seed = 1; seed <= 3; ++seed) {
        largest = fmax(largest, work_in_the_dark(list->stage, seed));
    }
    hard_put(list, HARD_MEASURED, "a dark room: segments", largest, 14400, "a pixel");
}
